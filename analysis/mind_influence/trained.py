"""Figure 6.6 from the trained robot: `mind_constant` of `collect`, in its world.

A run is searched for what the thesis tells: the robot approaches an object, comes near an obstacle
and leaves the wheels to Avoid, gives them back step by step, and at last picks the object up.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from socialmind.catalogue import load_model, model_folder
from socialmind.errors import SocialmindError
from socialmind.experiments import run
from socialmind.experiments.pictures.picture_page import Style
from socialmind.experiments.pictures.rendering import draw_moments
from socialmind.mind import MindDescription

MIND = model_folder("collect") / "mind_constant"
SEEDS = range(1, 31)
"""Of the runs that are searched, one after another."""
TICKS = 3000
"""Of a run."""
NONE, MUCH = 0.1, 0.6
"""Avoid's part of what GoToObject+Avoid sends: up to which it has no say, and from which most."""
APPROACH = 40
"""Ticks before Avoid has most of the influence, for the first step."""
LONGEST = 400
"""Ticks from there to the object in the claw."""
AROUND, TRAIL, PIXELS = 22.0, 200, 1400
"""Units drawn around the robot, ticks of its path, and the width of a bitmap."""
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
        gripped = one.carrying and not moments[place - 1].carrying
        if not gripped:
            continue
        way = [each for each in moments[max(0, place - LONGEST) : place] if not each.carrying]
        most = [at for at, each in enumerate(way) if each.avoiding >= MUCH]
        if not most or most[-1] < APPROACH:
            continue
        peak = most[-1]
        before, after = way[peak - APPROACH], way[peak:]
        clear = next((at for at, each in enumerate(after) if each.avoiding <= NONE), None)
        if before.avoiding > NONE or clear is None or clear < 2:
            continue
        return before.tick, after[0].tick, after[clear // 2].tick, after[clear].tick, one.tick + 2
    return None


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
        A PDF and a PNG, and the influences as CSV.
    """
    seed, ticks = found()
    out.mkdir(parents=True, exist_ok=True)
    style = Style(mind=True, around=AROUND, trail=TRAIL, plane_first=True)
    styles = {".pdf": style, ".png": replace(style, width=PIXELS)}
    captions = [f"Step {number}: {told}." for number, told in enumerate(TOLD, 1)]
    model: Any = load_model("collect")
    with TemporaryDirectory() as folder:
        made = run(model, ticks[-1], seed, hierarchy=MIND, out=Path(folder) / "run")
        written = [
            draw_moments(made, out / f"figure-6.6{end}", ticks, one, captions=captions)
            for end, one in styles.items()
        ]
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
