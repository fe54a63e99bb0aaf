"""Figure 6.6 from the trained robot: `mind_constant` of `collect`, in its world.

A run is searched for what the thesis tells: the robot approaches an object, comes near an obstacle
and leaves the wheels to Avoid, gives them back step by step, and at last picks the object up.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from socialmind.catalogue import load_model, model_folder
from socialmind.errors import SocialmindError
from socialmind.experiments import run
from socialmind.experiments.pictures.picture_page import Style
from socialmind.experiments.pictures.rendering import draw_steps
from socialmind.mind import MindDescription

MIND = model_folder("collect") / "mind_constant"
SEEDS = range(1, 31)
"""Of the runs that are searched, one after another."""
TICKS = 3000
"""Of a run."""
SHARED, ALONE = 0.6, 0.9
"""Avoid's part of what GoToObject and Avoid receive: up to which they share it, and from which
Avoid has it alone."""
APPROACH = 30
"""Ticks before Avoid has it alone, for the first step."""
LASTS = 10
"""Ticks that Avoid has it alone at least."""
ANSWER = 2
"""Ticks until what a mind makes of its sensors is done."""
LONGEST = 400
"""Ticks of the way to the object that are looked at."""
AROUND, TRAIL = 22.0, 200
"""Units drawn around the robot, and ticks of its path."""
CHOICE = "GoToObject+Avoid"
SENT = (
    CHOICE, "GoToDropZone+Avoid", "GoToObject", "GoToDropZone", "Avoid",
    "moveForward", "moveBackwards", "turnLeft", "turnRight",
)  # fmt: skip
"""Skills whose influence is told."""
TOLD = (
    "it approaches an object",
    "it is too close to an obstacle",
    "some distance is recovered",
    "the front is clear",
    "the object is picked up",
)


@dataclass(frozen=True)
class Moment:
    """A tick of a run.

    Attributes:
        tick: which.
        carrying: whether the robot holds the object.
        links: what GoToObject+Avoid sends to GoToObject, and to Avoid.
    """

    tick: int
    carrying: bool
    links: tuple[float, float]

    @property
    def avoiding(self) -> float:
        """Avoid's part of it."""
        total = sum(self.links)
        return self.links[1] / total if total > 0 else 0.0


def watched(seed: int, ticks: int = TICKS) -> list[Moment]:
    """Return a run of the trained robot, tick by tick."""
    model: Any = load_model("collect")(seed=seed, hierarchy=MindDescription.load(MIND))
    robot = model.tables["robots"][0]
    found = []
    while model.tick < ticks and model.over is None:
        model.advance(1)
        # Without an object nothing else sends influence to these two.
        sent = [float(robot.hierarchy.influence(name)) for name in ("GoToObject", "Avoid")]
        found.append(Moment(model.tick, robot.carrying >= 0, (sent[0], sent[1])))
    return found


def steps_of(moments: Sequence[Moment]) -> tuple[int, ...] | None:
    """Return the ticks of the five steps, the first time that they follow each other, or None."""
    for place, one in enumerate(moments):
        if not one.carrying or moments[place - 1].carrying:
            continue
        way = [each for each in moments[max(0, place - LONGEST) : place] if not each.carrying]
        blocks = [
            (begin, end)
            for alone, begin, end in _stretches([each.avoiding >= ALONE for each in way])
            if alone and end - begin >= LASTS
        ]
        if not blocks:
            continue
        begin, end = blocks[-1]
        shared = next((at for at in range(end, len(way)) if way[at].avoiding <= SHARED), None)
        if shared is None or begin < APPROACH or way[begin - APPROACH].avoiding > SHARED:
            continue
        shown = begin - APPROACH, (begin + end) // 2, shared, (shared + len(way)) // 2
        return *(way[at].tick for at in shown), one.tick + ANSWER
    return None


def _stretches(values: Sequence[bool]) -> list[tuple[bool, int, int]]:
    """Return stretches of equal values: the value, where it begins and where the next one does."""
    found, begin = [], 0
    for at in range(1, len(values) + 1):
        if at == len(values) or values[at] != values[begin]:
            found.append((values[begin], begin, at))
            begin = at
    return found


def found(seeds: Sequence[int] = SEEDS) -> tuple[int, tuple[int, ...]]:
    """Return the first run in which all steps follow each other: its seed, and their ticks.

    Raises:
        SocialmindError: there is none.
    """
    for seed in seeds:
        ticks = steps_of(watched(seed))
        if ticks is not None:
            return seed, ticks
    raise SocialmindError(f"in none of {len(seeds)} runs the robot avoids on its way to an object")


def write_steps(out: Path) -> list[Path]:
    """Draw the five steps, the arena on the left and the hierarchy on the right.

    Args:
        out: the folder.

    Returns:
        Three steps and two, each a PDF and a PNG, and the influences as CSV.
    """
    seed, ticks = found()
    out.mkdir(parents=True, exist_ok=True)
    style = Style(mind=True, around=AROUND, trail=TRAIL, inputs=False, plane_first=True)
    captions = [f"Step {number}: {told}." for number, told in enumerate(TOLD, 1)]
    model: Any = load_model("collect")
    with TemporaryDirectory() as folder:
        made = run(model, ticks[-1], seed, hierarchy=MIND, out=Path(folder) / "run")
        written = draw_steps(made, out / "figure-6.6", ticks, style, captions, rows=3)
    return [*written, write_numbers(seed, ticks, out)]


def write_numbers(seed: int, ticks: Sequence[int], out: Path) -> Path:
    """Write what each skill receives in each step as CSV."""
    model: Any = load_model("collect")(seed=seed, hierarchy=MindDescription.load(MIND))
    robot = model.tables["robots"][0]
    rows = []
    for number, tick in enumerate(ticks, 1):
        model.advance(tick - model.tick)
        mind = robot.hierarchy
        rows.append(
            {
                "seed": seed,
                "step": number,
                "tick": tick,
                **{name: round(float(mind.influence(name)), 4) for name in SENT},
                "carrying": int(robot.carrying >= 0),
            }
        )
    path = out / "figure-6.6.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return path
