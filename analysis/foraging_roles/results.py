"""What the minds of the trainings come to: in the economy, and in bodies."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.catalogue import load_file, load_model
from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, run, score
from socialmind.experiments.studies import write_figure
from socialmind.mind import MindDescription

from .trainings import (
    ATTEMPTS,
    ECONOMY,
    GENOMES,
    LESSONS,
    MODEL,
    genomes_of,
    kept,
    mind_of,
    train,
)

SEED = 82
WORLD = 1  # of the picture
EVERY = 50  # ticks between two records of it
SHOWN = 8000  # ticks that pictures of the arena show: some collapses
WORLDS = range(256)  # of the economy for each condition
OTHERS = WORLDS[128:]  # in the first half the model's mind may have been picked
HALF = 30_000
QUICK = 8  # generations of a small training

NINE = {"numbers": (9,), "ratios": (2 / 3,), "events": (ECONOMY.NOTHING,)}
IN_THE_ECONOMY: Mapping[str, Mapping[str, Any]] = {
    "nine robots": NINE,
    "wanted ratio turned round": {**NINE, "events": (ECONOMY.REVERSED,)},
    "three of one role taken away": {**NINE, "events": (ECONOMY.REMOVED,)},
    "three added": {**NINE, "events": (ECONOMY.ADDED,)},
    "six robots": {**NINE, "numbers": (6,)},
    "eighteen robots": {**NINE, "numbers": (18,)},
    "thirty-six robots": {**NINE, "numbers": (36,)},
}
IN_BODIES: Mapping[str, Mapping[str, Any]] = {
    "nine robots": {},
    "wanted ratio turned round": {"reverse_at": HALF},
    "three in A taken away": {"remove_at": HALF, "removed_role": 0},
    "three in B taken away": {"remove_at": HALF, "removed_role": 1},
    "three added": {"add_at": HALF},
    "six robots": {"foragers": 6},
    "eighteen robots": {"foragers": 18},
    "thirty-six robots": {"foragers": 36},
}


def genomes(
    names: Sequence[str], out: Path, quick: bool, from_kept: bool
) -> dict[str, list[NDArray[np.float64]]]:
    """Return what the attempts of trainings learned.

    Args:
        names: of the plans.
        out: where trainings are made.
        quick: whether they are small ones.
        from_kept: whether they are those that are kept.

    Raises:
        SocialmindError: one is not kept.
    """
    if from_kept:
        found = kept()
        for name in names:
            if name not in found:
                raise SocialmindError(
                    f"{GENOMES} has no training {name!r}; "
                    f"python -m analysis.foraging_roles.trainings {name} makes it"
                )
        return {name: found[name] for name in names}
    home = out / ("small_trainings" if quick else "trainings")
    size = {"generations": QUICK, "attempts": 1} if quick else {"attempts": ATTEMPTS}
    return {name: genomes_of(train(name, home / name, **size)) for name in names}


def judged(
    name: str,
    mind: MindDescription,
    several: Sequence[NDArray[np.float64]],
    worlds: Sequence[int],
) -> list[dict[str, Any]]:
    """Return what attempts come to in the economy, a row for each attempt and condition.

    Args:
        name: of the lesson.
        mind: that learned in it, with any weights.
        several: the attempts' genomes.
        worlds: their seeds.
    """
    rows = []
    for condition, terms in IN_THE_ECONOMY.items():
        economy = ECONOMY.Economy(dict(terms), mind, LESSONS.ROLE, LESSONS.ROLE)
        outcome = economy.run(np.array(several), worlds)
        for attempt in range(len(several)):
            fields = {key: values[attempt] for key, values in outcome.fields.items()}
            rows.append(
                {
                    "lesson": name,
                    "condition": condition,
                    "attempt": attempt + 1,
                    "within_one": float(fields["within"].mean()),
                    "changes": float(fields["changes"].mean()),
                }
            )
    return rows


def conditions(worlds: int) -> list[dict[str, Any]]:
    """Return what the model's own mind comes to in bodies, a row for each condition.

    Args:
        worlds: of each.
    """
    rows = []
    for condition, parameters in IN_BODIES.items():
        found = score(
            load_model("foraging_roles"), episodes=worlds, seed=SEED, parameters=parameters
        )
        row: dict[str, Any] = {"condition": condition, "worlds": worlds}
        for measure, interval in found.intervals.items():
            row |= {measure: interval.mean, f"{measure}_low": interval.low,
                    f"{measure}_high": interval.high}  # fmt: skip
        rows.append(row)
    return rows


def pictures(name: str, genome: NDArray[np.float64], ticks: int, out: Path) -> list[Path]:
    """Draw the roles of nine robots that begin undecided, in bodies.

    Args:
        name: of the plan.
        genome: of ForageRole.
        ticks: how long.
        out: the folder.

    Returns:
        The roles over time, as PDF, PNG and CSV, and pictures of the arena, as PDF and PNG.
    """
    figures = load_file(MODEL / "figures.py")
    model, mind = load_model("foraging_roles"), mind_of(name, genome)
    shown = min(ticks, SHOWN)
    with TemporaryDirectory() as folder, paper.style():
        long, short = (
            Run(run(model, length, WORLD, {"start": ECONOMY.UNDECIDED}, hierarchy=mind,
                    every=EVERY, agents_every=EVERY, out=Path(folder) / part))
            for part, length in (("long", ticks), ("short", shown))
        )  # fmt: skip
        # Who is in which role is counted at the end of a tick.
        series, agents = (one[one["tick"] > 0] for one in (long.series, long.agents))
        over_time = figures.roles(series, agents)
        steps = figures.steps(short)
        rows = series.to_dict("records")
    written = write_figure("figure-8.6", over_time, rows, out)
    return [*written, *paper.save({"figure-8.6-steps": steps}, out)]


def write_table(name: str, rows: Sequence[Mapping[str, Any]], out: Path) -> list[Path]:
    """Write a table as CSV, and as Markdown for reading.

    Args:
        name: of the files.
        rows: dictionaries with the same keys.
        out: the folder, made where it is missing.
    """
    out.mkdir(parents=True, exist_ok=True)
    table, text = out / f"{name}.csv", out / f"{name}.md"
    with table.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    cells = [list(rows[0])] + [
        [f"{one:.3g}" if isinstance(one, float) else str(one) for one in row.values()]
        for row in rows
    ]
    lines = ["| " + " | ".join(row) + " |" for row in cells]
    lines.insert(1, "|" + "---|" * len(cells[0]))
    text.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return [table, text]
