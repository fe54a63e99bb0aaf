"""Flocking, segregation, wolves and sheep over many seeds: what comes of the three classics.

    python -m analysis.classics.study
    python -m analysis.classics.study --seeds 5 --out /tmp/classics

Writes flocking.csv, schelling.csv and wolves_sheep.csv (a row for each society and moment or
setting) and tables.md.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import pandas as pd

from socialmind.experiments.measures.intervals import FEW, interval_of
from socialmind.work.side_by_side import side_by_side

from .societies import flock, segregated, wolves_and_sheep

HERE = Path(__file__).parent / "results"
SIGHTS = (5.0, 15.0)
MINIMA = range(8)
REGROWTHS = (10, 15, 20, 25, 30, 40)
PARTS = {
    "flocking": (flock, SIGHTS),
    "schelling": (segregated, MINIMA),
    "wolves_sheep": (wolves_and_sheep, REGROWTHS),
}


def run(seeds: int, workers: int | None) -> dict[str, pd.DataFrame]:
    """Run all societies and return a table for each model."""
    tables = {}
    for name, (function, settings) in PARTS.items():
        calls = [(setting, seed) for setting in settings for seed in range(seeds)]
        found = side_by_side(function, calls, workers, together=10)
        tables[name] = pd.DataFrame([row for rows in found for row in rows])
        print(f"{name}: {len(calls)} societies", flush=True)
    return tables


def cell(values: pd.Series, digits: int = 2) -> str:
    """Return a mean with its interval, of what is known; a few numbers one by one."""
    known, form = values.dropna(), f",.{digits}f"
    if len(known) < FEW:
        return "; ".join(f"{one:{form}}" for one in sorted(known)) or "–"
    one = interval_of(known)
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def as_markdown(tables: dict[str, pd.DataFrame]) -> str:
    """Return the three parts as tables: means, in brackets intervals of 95 %."""
    flocks, people, animals = (tables[name] for name in PARTS)
    lines = [
        f"{people['seed'].nunique()} seeds; means, in brackets intervals of 95 % over seeds. Fewer "
        f"than {FEW} numbers stand one by one.",
        "",
        "## Flocking",
        "",
        "| sight (patches) | tick | polarisation (0 … 1) | largest flock (share of birds) |",
        "|---|---|---|---|",
    ]
    for (sight, tick), rows in flocks.groupby(["sight", "tick"]):
        cells = f"{cell(rows['polarisation'])} | {cell(rows['largest'])}"
        lines.append(f"| {sight:g} | {tick:,} | {cells} |")
    lines += [
        "",
        "## Schelling",
        "",
        "| minimum | happy after 20 ticks (share) | neighbours of one's own kind (share) "
        "| happy after 500 ticks | neighbours of one's own kind |",
        "|---|---|---|---|---|",
    ]
    for minimum, rows in people.groupby("minimum"):
        cells = []
        for _, now in rows.groupby("tick"):
            cells += [cell(now["happy"], 3), cell(now["alike"], 3)]
        lines.append(f"| {minimum} | {' | '.join(cells)} |")
    lines += [
        "",
        "## Wolves and sheep",
        "",
        "| regrowth (ticks) | wolves die out, of societies | at tick | sheep die out, of societies "
        "| sheep (mean) | wolves (mean) | cycle of the sheep (ticks) | its strength (at most 1) "
        "| wolves after sheep (ticks) |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for regrowth, rows in animals.groupby("regrowth"):
        counts = [rows[name].notna().sum() for name in ("wolves_end", "sheep_end")]
        rest = [cell(rows[name], 1) for name in ("sheep", "wolves", "cycle")]
        rest += [cell(rows["strength"]), cell(rows["delay"], 1)]
        lines.append(
            f"| {regrowth} | {counts[0]} of {len(rows)} | {cell(rows['wolves_end'], 0)} "
            f"| {counts[1]} of {len(rows)} | {' | '.join(rest)} |"
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2:
        parser.error("at least two seeds")
    tables = run(arguments.seeds, arguments.workers)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, table in tables.items():
        table.to_csv(arguments.out / f"{name}.csv", index=False, float_format="%.4g")
    text = as_markdown(tables)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
