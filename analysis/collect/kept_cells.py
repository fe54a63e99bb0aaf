"""What the kept tables of chapter 6 say, in numbers and words, for the findings of `thesis.py`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.catalogue import load_model
from socialmind.experiments.judging import (
    Finding,
    in_brackets,
)
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.overview import row_of, rows_of
from socialmind.learning import Training

if TYPE_CHECKING:
    import pandas as pd

KEPT = Path(__file__).parent / "results"
TRAININGS = KEPT / "trainings"
ATTEMPTS = 10
"""Of each structure."""
ENDS, GOES_ON = "a collision ends the run", "no interruption"
FLAT = "a collision or a flat battery ends the run"
"""What the tables call their benchmarks."""
KINDS = {"hierarchical": "hierarchy", "monolithic": "monolith"}
"""Of structures, with what they are called here and the training of each."""
LEVEL = "table-6.1-equal-ticks"
"""The table of trainings with equal ticks in each lesson."""
BASE_SKILLS = ("GoToObject", "GoToDropZone", "Avoid")
MODELS = {ENDS: "collect", GOES_ON: "collect", FLAT: "collect_power"}
"""The model of each benchmark."""


def cell(table: str, structure: str, measure: str, benchmark: str = ENDS) -> dict[str, str]:
    """Return the row of a measure of a structure."""
    return row_of(
        KEPT / f"{table}.csv", structure=structure, benchmark=benchmark, measure=measure
    )  # fmt: skip


def interval(row: dict[str, str]) -> Interval:
    """Return our number with its interval over attempts; a bound the table lacks is NaN."""
    return Interval(*(float(row[name] or "nan") for name in ("mean", "low", "high")))


def form(measure: str, signed: bool = False) -> str:
    """Return how a measure is written."""
    return ("+" if signed else "") + (".0%" if measure == "survived" else ".2f")


def told(table: str, structure: str, measure: str, benchmark: str = ENDS) -> str:
    """Return what our table says of a measure of a structure."""
    return in_brackets(interval(cell(table, structure, measure, benchmark)), form(measure))


def reported(table: str, structure: str, measure: str, benchmark: str = ENDS) -> str:
    """Return what the thesis says of it."""
    return format(float(cell(table, structure, measure, benchmark)["thesis"]), form(measure))


def by_attempt(
    table: str, structure: str, measure: str, benchmark: str = ENDS
) -> dict[str, float]:  # fmt: skip
    """Return a measure of each attempt."""
    return {
        row["attempt"]: float(row[measure])
        for row in rows_of(KEPT / f"{table}-attempts.csv")
        if row["structure"] == structure and row["benchmark"] == benchmark
    }


def gained(table: str, before: str, after: str, measure: str, benchmark: str = ENDS) -> Interval:
    """Return by how much attempts of the same number differ, with an interval over attempts."""
    one, other = (by_attempt(table, structure, measure, benchmark) for structure in (before, after))
    return interval_of([other[number] - one[number] for number in one if number in other])


def in_pairs(gain: Interval, measure: str) -> str:
    """Return a difference of attempts of the same number, in words."""
    return f"{in_brackets(gain, form(measure, signed=True))}, attempt by attempt"


def more(
    table: str, before: str, after: str, measure: str, benchmark: str = ENDS
) -> Interval:  # fmt: skip
    """Return how much more one structure comes to than another, attempts taken as they come."""
    one, other = (
        list(by_attempt(table, structure, measure, benchmark).values())
        for structure in (before, after)
    )
    return compared(other, one, paired=False).difference


def untold(benchmark: str) -> str:
    """Return why numbers of objects and shares of a run cannot be compared."""
    return (
        f"ours are runs of {load_model(MODELS[benchmark]).ticks:,} ticks, how long the thesis's "
        "are it does not tell"
    )


def after_what(structure: str) -> str:
    """Return the lesson after which a structure with equal ticks is scored."""
    rows = rows_of(KEPT / f"{LEVEL}-attempts.csv")
    (lesson,) = {row["after"] for row in rows if row["structure"] == structure}
    return lesson


def with_equal_ticks(kind: str, measure: str, benchmark: str = ENDS) -> str:
    """Return what a structure comes to with equal ticks after each lesson that is kept.

    Args:
        kind: ``hierarchical`` or ``monolithic``.
        measure: which.
        benchmark: where.
    """
    known = dict.fromkeys(row["structure"] for row in rows_of(KEPT / f"{LEVEL}.csv"))
    here, before = f"{kind}, curriculum", f"{kind}, "
    lessons = {one: one.removeprefix(before) for one in known if one.startswith(f"{before}after ")}
    lessons[here] = f"after {after_what(here)}"
    return ", ".join(
        f"{told(LEVEL, one, measure, benchmark)} {after}" for one, after in lessons.items()
    )


def with_seeds(kind: str) -> str:
    """Return how many attempts with equal ticks there are, and that they are not independent."""
    number = cell(LEVEL, f"{kind}, curriculum", "objects")["attempts"]
    return f"{number} attempts, with the seeds of `{KINDS[kind]}`"


def unfinished(*kinds: str) -> str:
    """Return which structures with equal ticks lack attempts, or nothing."""
    counts = {
        kind: int(cell(LEVEL, f"{kind}, curriculum", "objects")["attempts"]) for kind in kinds
    }
    return "; ".join(
        f"{kind}: {count} of {ATTEMPTS} attempts so far"
        for kind, count in counts.items()
        if count < ATTEMPTS
    )


def measured(
    measure: str, table: str, structure: str, name: str = "", ours: str = "", benchmark: str = ENDS
) -> Finding:
    """Return what a structure comes to, which depends on how long a run is: it is not comparable.

    Args:
        measure: ``objects`` or ``survived``.
        table: in which it stands.
        structure: which.
        name: what it is called; as in the table by default.
        ours: what is told of ours; what the table says by default.
        benchmark: where.
    """
    given = table, structure, measure, benchmark
    what = "objects" if measure == "objects" else "share of the run survived"
    return Finding(
        f"{name or structure}: {what}",
        reported(*given),
        ours or told(*given),
        apart=untold(benchmark),
    )


def scores(plan: str) -> pd.DataFrame:
    """Return what a kept training's attempts came to in the finals of each lesson.

    Args:
        plan: of the training.

    Returns:
        A row for each attempt and a column for each lesson, in the order of teaching.
    """
    lessons = Training(TRAININGS / plan).lessons
    table = lessons.pivot(index="attempt", columns="lesson", values="score")
    return table[list(dict.fromkeys(lessons["lesson"]))]


def spent_in(table: str, names: Sequence[str]) -> str:
    """Return the budgets of structures, from the table."""
    parts = {}
    for row in rows_of(KEPT / f"{table}.csv"):
        if row["structure"] in names:
            parts[row["structure"]] = (
                f"{row['structure']} {float(row['generations']):,.0f} generations, "
                f"{float(row['million_ticks']):,.0f} million ticks"
            )
    return "; ".join(parts.values())
