"""Division of labour by thresholds, over many seeds: castes, specialists, and their absence.

    python -m analysis.thresholds.study
    python -m analysis.thresholds.study --seeds 10 --out /tmp/thresholds

Writes answers.csv, castes.csv, specialists.csv and absences.csv (a row for each colony), tables.md,
and the figure as study.pdf and .png.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of
from socialmind.work.side_by_side import side_by_side

from .colonies import (
    AFTER,
    MAJORS,
    MINORS,
    absence,
    answering,
    caste,
    expected,
    specialists,
    works,
)
from .plots import draw

HERE = Path(__file__).parent / "results"
STIMULI = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
SHARES = (0, 5, 10, 20, 30, 40, 50, 60, 70, 80, 90, 95, 100)
SIZES = (5, 20)
ABSENCES = (0, 30, 100, 200, 300, 500, 1000, 3000)
COURSE = {
    "task_0": "specialists of task 0, at the end",
    "task_1": "specialists of task 1, at the end",
    "none": "specialists of none, at the end",
    "last_distance": "workers away from 2 : 2 : 1, last quarter",
    "specialised": "share of workers specialised, last quarter",
    "agents_to_tasks": "division of labour, workers to tasks",
    "agents_to_tasks_by_chance": "the same by luck alone",
    "tasks_to_agents": "division of labour, tasks to workers",
    "role_changes": "role changes of a worker in 10,000 ticks while settled",
    "settling_ticks": "ticks until settled, of those that settle",
}
ABSENT = {
    "stayed_before": "θ for the task, of those who stayed, at the removal",
    "stayed_return": "at the return",
    "stand_ins": "specialists of it among them, then",
    "change": f"change of all θ, {AFTER:,} ticks after it",
    "other_role": "workers with another role",
    "lost_role": "of those who were away",
    "stayed_other_role": "of those who stayed",
}


def run(seeds: int, ticks: int, workers: int | None) -> dict[str, pd.DataFrame]:
    """Run all colonies and return a table for each part."""
    each = range(seeds)
    parts = {
        "answers": (
            answering,
            [(threshold, stimulus, seed, ticks // 20) for threshold in (MINORS, MAJORS)
             for stimulus in STIMULI for seed in each],
        ),
        "castes": (caste, [(majors, seed, ticks // 5) for majors in SHARES for seed in each]),
        "specialists": (
            specialists,
            [(size, learns, seed, ticks) for size in SIZES for learns in (True, False)
             for seed in each],
        ),
        "absences": (
            absence,
            [(size, forgets, away, seed) for size in SIZES for forgets in (True, False)
             for away in ABSENCES for seed in each],
        ),
    }  # fmt: skip
    tables = {}
    for name, (function, calls) in parts.items():
        tables[name] = pd.DataFrame(list(side_by_side(function, calls, workers, together=20)))
        print(f"{name}: {len(calls)} colonies")
    return tables


def cell(values: pd.Series, digits: int = 2) -> str:
    """Return a mean with its interval, of what is known."""
    known = values[np.isfinite(values)]
    if not len(known):
        return "–"
    one = interval_of(known)
    form = f",.{digits}f"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def as_markdown(tables: dict[str, pd.DataFrame]) -> str:
    """Return all four parts as tables: means, in brackets intervals of 95 %."""
    castes, special, away = (tables[name] for name in ("castes", "specialists", "absences"))
    answers = tables["answers"].pivot_table(index=["stimulus", "seed"], columns="threshold")["work"]
    seeds = special["seed"].nunique()
    lines = [
        f"{seeds} seeds; means, in brackets intervals of 95 % over seeds.",
        "",
        "## Share of time at work, by the stimulus, fixed thresholds",
        "",
        "| stimulus | θ = 1 | T / (T + p) | θ = 8 | T / (T + p) |",
        "|---|---|---|---|---|",
    ]
    for stimulus, rows in answers.groupby("stimulus"):
        cells = []
        for threshold in (MINORS, MAJORS):
            cells += [cell(rows[threshold], 3), f"{works(float(stimulus), threshold):.3f}"]
        lines.append(f"| {stimulus:g} | {' | '.join(cells)} |")
    lines += [
        "",
        "## Castes, fixed thresholds",
        "",
        "| majors of 100 | work of a major | in an endless colony | work of a minor "
        "| in an endless colony |",
        "|---|---|---|---|---|",
    ]
    for majors, rows in castes.groupby("majors"):
        ideal = expected(float(majors) / 100)
        lines.append(
            f"| {majors} | {cell(rows['major_work'], 3)} | {ideal[0] if majors else '–'} "
            f"| {cell(rows['minor_work'], 3)} | {ideal[1] if majors < 100 else '–'} |"
        )
    columns = list(special.groupby(["workers", "learns"], sort=False))
    heads = [f"{n} workers, {'learned' if learns else 'fixed'}" for (n, learns), _ in columns]
    lines += ["", "## Specialists out of equals", "", f"| | {' | '.join(heads)} |"]
    lines.append("|---|" + "---|" * len(columns))
    for name, title in COURSE.items():
        digits = 0 if name == "settling_ticks" else 2
        cells = [cell(rows[name], digits) for _, rows in columns]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    settled = [int(np.isfinite(rows["settling_ticks"]).sum()) for _, rows in columns]
    lines.append(f"| colonies that settle, of {seeds} | {' | '.join(map(str, settled))} |")
    lines += ["", "## Specialists away and back"]
    for (size, forgets), part in away.groupby(["workers", "forgets"], sort=False):
        what = "forget" if forgets else "keep their thresholds"
        lines += [
            "",
            f"{size} workers, those away {what}; shares of the range of θ, and of workers:",
            "",
            f"| ticks away | {' | '.join(ABSENT.values())} | settled at 2 : 2 : 1 again |",
            "|---|" + "---|" * (len(ABSENT) + 1),
        ]
        for ticks, rows in part.groupby("away"):
            cells = [cell(rows[name], 3) for name in ABSENT]
            again = np.isfinite(rows["settled_again"])
            lines.append(
                f"| {ticks:,} | {' | '.join(cells)} | {int(again.sum())} of {len(rows)}: "
                f"{cell(rows['settled_again'], 0)} ticks |"
            )
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=60)
    parser.add_argument("--ticks", type=int, default=20_000, help="of colonies of equals")
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2 or arguments.ticks < 10_000:
        parser.error("at least two seeds and 10,000 ticks")
    tables = run(arguments.seeds, arguments.ticks, arguments.workers)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, table in tables.items():
        table.to_csv(arguments.out / f"{name}.csv", index=False, float_format="%.5g")
    text = as_markdown(tables)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(tables)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
