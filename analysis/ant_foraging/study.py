"""Whether ants find the shorter of two ways, and what marking does for food in a field.

    python -m analysis.ant_foraging.study
    python -m analysis.ant_foraging.study --seeds 5 --out /tmp/ants

Writes bridges.csv, drops.csv and fields.csv (a row for each colony), tables.md, and the figure as
study.pdf and .png.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.work.side_by_side import side_by_side

from .colonies import ALL, BRIDGES, DROP, DROPS, EVERY, FIELDS, HALF, LAST, crossed, gathered
from .plots import draw

HERE = Path(__file__).parent / "results"
FIRST_SEED = 100
"""The parameters were chosen on other seeds, from 1,000 on."""
COMPARED = ("20 and 40 steps", "marked homeward only")
"""Bridges that are crossed with every drop."""


def run(seeds: int, ticks: int, workers: int | None) -> dict[str, pd.DataFrame]:
    """Run all colonies and return a table for each part."""
    each = range(FIRST_SEED, FIRST_SEED + seeds)
    parts = {
        "bridges": [(setting, DROP, seed, ticks) for setting in BRIDGES for seed in each],
        "drops": [
            (setting, drop, seed, ticks) for setting in COMPARED for drop in DROPS for seed in each
        ],
    }
    tables = {
        name: pd.DataFrame(list(side_by_side(crossed, calls, workers, together=10)))
        for name, calls in parts.items()
    }
    calls = [(field, marks, seed, ticks) for field in FIELDS for marks in (True, False)
             for seed in each]  # fmt: skip
    found = side_by_side(gathered, calls, workers, together=10)
    tables["looks"] = pd.DataFrame([row for rows in found for row in rows])
    tables["fields"] = times(tables["looks"])
    return tables


def times(looks: pd.DataFrame) -> pd.DataFrame:
    """Return when half and all of the food were home, a row for each colony; infinite for never."""
    rows = []
    for (field, marks, seed), own in looks.groupby(["field", "marks", "seed"], sort=False):
        row = {"field": field, "marks": marks, "seed": seed}
        for name, wanted in (("half", HALF), ("all", ALL)):
            there = own.loc[own["brought"] >= wanted, "tick"]
            row[name] = float(there.iloc[0]) if len(there) else math.inf
        rows.append(row)
    return pd.DataFrame(rows)


def shown(one: Interval, digits: int = 2) -> str:
    """Return a mean with its interval."""
    form = f",.{digits}f"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def time_shown(values: pd.Series, ticks: int) -> str:
    """Return a mean time with its interval; where some never come, how many do."""
    known = values[values < math.inf]
    if len(known) < len(values):
        return f"{len(known)} of {len(values)} within {ticks:,}"
    return shown(interval_of(known), 0)


def as_markdown(tables: dict[str, pd.DataFrame], ticks: int) -> str:
    """Return the three parts as tables: means, in brackets intervals of 95 %."""
    bridges, drops, fields = (tables[name] for name in ("bridges", "drops", "fields"))
    seeds = bridges["seed"].nunique()
    lines = [
        f"{seeds} seeds from {FIRST_SEED} on, {ticks:,} ticks; means, in brackets intervals of "
        "95 % over seeds.",
        "",
        "## Two ways between nest and food",
        "",
        f"The northern way and the southern; traffic of the last {LAST:,} ticks.",
        "",
        "| | northern way has more | share of traffic on it | nine of ten go one way "
        "| food brought home |",
        "|---|---|---|---|---|",
    ]
    for setting, rows in bridges.groupby("setting", sort=False):
        lines.append(
            f"| {setting} | {int(rows['wins'].sum())} of {len(rows)} "
            f"| {shown(interval_of(rows['north']), 3)} | {int(rows['decided'].sum())} "
            f"| {shown(interval_of(rows['brought']), 0)} |"
        )
    lines += [
        "",
        "## How much is laid, ways of 20 and 40 steps",
        "",
        "Laid a step, out and home; or twice as much homeward only.",
        "",
        "| pheromone | shorter has more, both ways marked | share of traffic on it "
        "| shorter has more, marked homeward only | share of traffic on it |",
        "|---|---|---|---|---|",
    ]
    for drop, both in drops.groupby("drop"):
        cells = []
        for setting in COMPARED:
            rows = both[both["setting"] == setting]
            cells.append(f"{int(rows['wins'].sum())} of {len(rows)}")
            cells.append(shown(interval_of(rows["north"]), 3))
        lines.append(f"| {drop:g} | {' | '.join(cells)} |")
    lines += [
        "",
        f"## Food in a field, {ALL} pieces; looked at every {EVERY} ticks",
        "",
        "| | half is home, marked (ticks) | not marked | all is home, marked | not marked "
        "| half: marked less not marked |",
        "|---|---|---|---|---|---|",
    ]
    for field, rows in fields.groupby("field", sort=False):
        marked, bare = rows[rows["marks"]], rows[~rows["marks"]]
        cells = [time_shown(one[name], ticks) for name in ("half", "all") for one in (marked, bare)]
        less = marked["half"].to_numpy() - bare["half"].to_numpy()
        lines.append(f"| {field} | {' | '.join(cells)} | {shown(interval_of(less), 0)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=50)
    parser.add_argument("--ticks", type=int, default=3_000)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2 or arguments.ticks <= LAST or arguments.ticks % EVERY:
        parser.error(f"at least two seeds, more than {LAST:,} ticks, a multiple of {EVERY}")
    tables = run(arguments.seeds, arguments.ticks, arguments.workers)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in ("bridges", "drops", "fields"):
        tables[name].to_csv(arguments.out / f"{name}.csv", index=False, float_format="%.5g")
    text = as_markdown(tables, arguments.ticks)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(tables)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
