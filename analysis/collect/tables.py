"""Tables 6.1, 6.2 and 6.3: ours beside the thesis's."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from socialmind.experiments.measures.intervals import Interval

from .curricula import EVEN_MORE, MORE, STILL_MORE
from .standings import Benchmark, Standing, Structure

ENDS = Benchmark("a collision ends the run", "collect")
GOES_ON = Benchmark("no interruption", "collect", on_collision="continue")
POWER = Benchmark(
    "a collision or a flat battery ends the run",
    "collect_power",
    note="A run of ours has 20,000 ticks, twice those of tables 6.1 and 6.2, so that a battery "
    "runs flat within it; how long the thesis's runs are it does not say, so **neither numbers of "
    "objects nor shares of a run can be compared with the thesis's**, only their order. In place "
    "of the thesis's retrained Avoid ours have all five skills below Collect retrained in context: "
    "the mind of `collect_retrained`, attempt 2 of `in_context`, which by its finals was not the "
    "best one. Attempts of one number share their draws.",
)
BOTH = ("objects", "survived")


@dataclass(frozen=True)
class Block:
    """A part of a table: structures in a benchmark."""

    benchmark: Benchmark
    measures: tuple[str, ...]
    structures: tuple[Structure, ...]


@dataclass(frozen=True)
class Table:
    """A table of the thesis."""

    name: str
    title: str
    blocks: tuple[Block, ...]

    @property
    def plans(self) -> tuple[str, ...]:
        """The trainings that it stands on."""
        return tuple(dict.fromkeys(one.plan for block in self.blocks for one in block.structures))


BUDGETS = {
    "hierarchical, curriculum": "1,000 generations a skill, 1,500 in figures 6.4 and 6.5",
    "Avoid as in the curriculum": "1,000 generations of Avoid",
    "Avoid with more ticks": "2,500 generations of Avoid",
    "Avoid in context": "1,500 generations of Avoid, from nothing",
    "monolithic, curriculum": "the same curriculum, how long is not told",
    "monolithic": "the same curriculum, how long is not told",
}
"""What the thesis gave an attempt, by the structure's name."""


def _structure(
    name: str, plan: str, after: str, objects: float | None = None, survived: float | None = None
) -> Structure:
    thesis = {"objects": objects, "survived": survived}
    reported = {k: v for k, v in thesis.items() if v is not None}
    budget = BUDGETS.get(name, "not told") if reported else ""
    return Structure(name, plan, after, reported, budget)


def _structures(
    level: str = "", lessons: Sequence[str] = ("Collect",), further: Sequence[str] = ()
) -> tuple[Block, ...]:
    """Return the blocks of table 6.1.

    Args:
        level: how the trainings' names end.
        lessons: of the curriculum after which minds are scored; the last one stands beside the
            thesis's.
        further: lessons behind these that the monolith alone has.
    """
    alone = f"{level}_at_once"
    *earlier, after = lessons
    others = (
        *(
            _structure(f"{kind}, after {lesson}", f"{plan}{level}", lesson)
            for lesson in earlier
            for kind, plan in (("hierarchical", "hierarchy"), ("monolithic", "monolith"))
        ),
        *(
            _structure(f"monolithic, with {lesson}", f"monolith{level}", lesson)
            for lesson in further
        ),
    )
    return (
        Block(
            ENDS,
            BOTH,
            (
                _structure("hierarchical, curriculum", f"hierarchy{level}", after, 4.63, 0.54),
                _structure("monolithic, curriculum", f"monolith{level}", after, 5.19, 0.68),
                _structure("hierarchical, final task only", f"hierarchy{alone}", "All at once",
                           0.06, 0.51),
                _structure("monolithic, final task only", f"monolith{alone}", "All at once",
                           0.31, 0.80),
                *others,
            ),
        ),
        Block(
            GOES_ON,
            ("objects",),
            (
                _structure("hierarchical, curriculum", f"hierarchy{level}", after, 9.55),
                _structure("monolithic, curriculum", f"monolith{level}", after, 7.70),
                _structure("hierarchical, final task only", f"hierarchy{alone}", "All at once",
                           0.18),
                _structure("monolithic, final task only", f"monolith{alone}", "All at once", 0.39),
                *others,
            ),
        ),
    )  # fmt: skip


TABLES = (
    Table(
        "table-6.1",
        "Hierarchical or monolithic, by curriculum or by the final task alone",
        _structures(),
    ),
    Table(
        "table-6.1-equal-ticks",
        "Hierarchical or monolithic, with the same ticks in each lesson",
        _structures("_level", ("Collect", MORE, STILL_MORE), (EVEN_MORE,)),
    ),
    Table(
        "table-6.2",
        "More resources for Avoid, or Avoid learned in the context of Collect",
        (
            Block(
                ENDS,
                BOTH,
                (
                    _structure("monolithic", "monolith", "Collect", 5.19, 0.68),
                    _structure("monolithic, more of Collect", "monolith", "More of Collect"),
                    _structure("Avoid as in the curriculum", "hierarchy", "Collect", 4.63, 0.54),
                    _structure("Avoid with more ticks", "longer_avoid", "Collect", 5.31, 0.56),
                    _structure("Avoid in context", "hierarchy", "Avoid in context", 6.03, 0.90),
                    _structure(
                        "choices in context (best attempt)", "in_context", "Choices in context"
                    ),
                    _structure(
                        "all skills in context (best attempt)", "in_context", "All in context"
                    ),
                ),
            ),
            Block(
                GOES_ON,
                ("objects",),
                (
                    _structure("monolithic", "monolith", "Collect"),
                    _structure("monolithic, more of Collect", "monolith", "More of Collect"),
                    _structure("Avoid as in the curriculum", "hierarchy", "Collect"),
                    _structure("Avoid with more ticks", "longer_avoid", "Collect"),
                    _structure("Avoid in context", "hierarchy", "Avoid in context"),
                    _structure(
                        "choices in context (best attempt)", "in_context", "Choices in context"
                    ),
                    _structure(
                        "all skills in context (best attempt)", "in_context", "All in context"
                    ),
                ),
            ),
        ),
    ),
    Table(
        "table-6.3",
        "Power management: a new master in place of the old one, or above it",
        (
            Block(
                POWER,
                BOTH,
                (
                    _structure(
                        "Retrained, original Avoid", "power_retrained_original", "CollectPower",
                        1.73, 0.28,
                    ),
                    _structure(
                        "Encapsulated, original Avoid", "power_encapsulated_original",
                        "CollectPower", 1.62, 0.36,
                    ),
                    _structure(
                        "Retrained, all skills in context", "power_retrained", "CollectPower",
                        3.99, 0.69,
                    ),
                    _structure(
                        "Encapsulated, all skills in context", "power_encapsulated", "CollectPower",
                        3.73, 0.90,
                    ),
                ),
            ),
        ),
    ),
)  # fmt: skip
"""With what the thesis reports."""


# Writing ----------------------------------------------------------------------------------------


def write_table(
    table: Table, standings: Sequence[Standing], made: Sequence[str], out: Path
) -> list[Path]:
    """Write a table for readers (Markdown), its numbers, and those of each attempt (CSV).

    Args:
        table: which.
        standings: of its blocks' structures, in order.
        made: how it came about, a line each.
        out: the folder, made where it is missing.

    Returns:
        The files written.
    """
    out.mkdir(parents=True, exist_ok=True)
    paths = [out / f"{table.name}{suffix}" for suffix in (".md", ".csv", "-attempts.csv")]
    paths[0].write_text(text(table, standings, made), encoding="utf-8")
    write_rows(paths[1], [row for one in standings for row in rows_of(one, table)])
    write_rows(paths[2], [row for one in standings for row in one.by_attempt()])
    return paths


def rows_of(standing: Standing, table: Table) -> list[dict[str, Any]]:
    """Return a row for each measure of a standing."""
    (measures,) = (
        block.measures
        for block in table.blocks
        if block.benchmark == standing.benchmark and standing.structure in block.structures
    )
    rows = []
    for measure in measures:
        row: dict[str, Any] = {
            "benchmark": standing.benchmark.title,
            "structure": standing.structure.name,
            "measure": measure,
            "thesis": standing.structure.thesis.get(measure, ""),
            "attempts": standing.attempts,
            "worlds": standing.worlds,
            "seed": standing.seed,
            "generations": _known(standing.spent[0]),
            "million_ticks": _known(standing.spent[1]),
            "thesis_budget": standing.structure.budget,
        }
        parts = {
            "": standing.over_attempts, "worlds_": standing.over_worlds, "best_": standing.of_best,
        }  # fmt: skip
        for prefix, of in parts.items():
            record = of(measure).record() if standing.attempts else {}
            row |= {
                f"{prefix}{name}": "" if (value := record.get(name)) is None else round(value, 4)
                for name in ("mean", "low", "high")
            }
        rows.append({**row, "best_attempt": standing.best if standing.attempts else ""})
    return rows


def text(table: Table, standings: Sequence[Standing], made: Sequence[str]) -> str:
    """Return a table as Markdown."""
    number = table.name.removeprefix("table-").replace("-", ", ", 1).replace("-", " ")
    lines = [f"# Table {number}: {table.title[0].lower()}{table.title[1:]}", "", *made]
    for block in table.blocks:
        own = [one for one in standings if one.benchmark == block.benchmark]
        percent = " (share of the run survived)" if "survived" in block.measures else ""
        title = block.benchmark.title
        lines += [
            "",
            f"## {title[0].upper()}{title[1:]}: objects{percent}",
            "",
            *([block.benchmark.note, ""] if block.benchmark.note else []),
            "| structure | thesis | attempts | ours [over attempts] | [over worlds] "
            "| best attempt [over worlds] | budget of an attempt | thesis's budget |",
            "|---|---|---|---|---|---|---|---|",
        ]
        lines += [f"| {' | '.join(_cells(one, block.measures))} |" for one in own]
    return "\n".join([*lines, ""])


def _cells(standing: Standing, measures: Sequence[str]) -> list[str]:
    thesis = standing.structure.thesis
    reported = _joined([_number(one, thesis.get(one)) for one in measures if one in thesis])
    cells = [standing.structure.name, reported, str(standing.attempts)]
    if not standing.attempts:
        return [*cells, "not trained", "", "", "", standing.structure.budget]
    return [
        *cells,
        _joined([_interval(one, standing.over_attempts(one)) for one in measures]),
        _joined([_bounds(one, standing.over_worlds(one)) for one in measures]),
        _joined([_interval(one, standing.of_best(one)) for one in measures]),
        _budget(standing.spent),
        standing.structure.budget or "–",
    ]


def _budget(spent: tuple[float, float]) -> str:
    """Return generations and ticks.

    >>> _budget((340.0, 321.6))
    '340 generations, 322 million ticks'
    """
    generations, ticks = spent
    if math.isnan(generations):
        return "–"
    return f"{generations:,.0f} generations, {ticks:,.0f} million ticks"


def _known(value: float) -> float | str:
    return "" if math.isnan(value) else round(value, 1)


def _joined(parts: Sequence[str]) -> str:
    """Return a number, with the second one in brackets as the thesis has it.

    >>> _joined(["4.63", "54 %"])
    '4.63 (54 %)'
    """
    return parts[0] + "".join(f" ({one})" for one in parts[1:]) if parts else "–"


def _number(measure: str, value: float | None, sign: bool = True) -> str:
    if value is None or not math.isfinite(value):
        return "–"
    if measure == "survived":
        return f"{100 * value:.0f}" + (" %" if sign else "")
    return f"{value:.2f}"


def _bounds(measure: str, interval: Interval) -> str:
    low, high = (_number(measure, one, sign=False) for one in (interval.low, interval.high))
    return f"[{low} to {high}]"


def _interval(measure: str, interval: Interval) -> str:
    return f"{_number(measure, interval.mean)} {_bounds(measure, interval)}"


def write_rows(path: Path, rows: Sequence[dict[str, Any]]) -> Path:
    """Write rows as CSV, with the columns of the first one."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]) if rows else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return path
