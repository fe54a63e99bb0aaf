"""Figures 8.3 and 8.4 of the thesis: eight steps of a robot that forages with others.

A run is searched for a robot that does what the thesis tells of its robot: it searches, sees
objects, grips one, leaves their sight with it, brings it home, turns to a signal that it hears,
comes nearer, and sees objects again.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import run
from socialmind.experiments.pictures.picture_page import Style
from socialmind.experiments.pictures.rendering import draw_steps

SEEDS = range(1, 21)
"""Of the runs that are searched, one after another."""
EVERY = 5
"""Ticks between two looks at the robots."""
ANSWER = 2
"""Ticks until what a mind makes of its sensors is done."""
BEFORE = 100
"""Ticks before it sees objects, for the first step."""
AROUND = 60.0
"""Units of the arena that are drawn around the robot, each way: about half of it."""
TRAIL = 400
"""Ticks of the path that are drawn."""
SKILLS = ("Search+Avoid", "ReachSignal", "Collect", "EmitSignal", "Idle")
"""Below Forage."""
TOLD = (
    "it sees no object and hears no signal",
    "it sees objects, and emits a signal",
    "it has gripped one",
    "it leaves the sight of the objects, and its signal ends",
    "it has brought the object home",
    "it turns to a signal",
    "it comes nearer to the signal",
    "it sees objects again",
)


@dataclass(frozen=True)
class Steps:
    """A robot's eight steps.

    Attributes:
        seed: of the run.
        robot: the robot's identity.
        ticks: of the steps.
    """

    seed: int
    robot: int
    ticks: tuple[int, ...]


def found(seeds: Sequence[int] = SEEDS, ticks: int | None = None) -> Steps:
    """Return the first robot of the first run that goes through all steps.

    Args:
        seeds: of the runs.
        ticks: of a run; the model's by default.

    Raises:
        SocialmindError: none does.
    """
    for seed in seeds:
        records = _recorded(seed, ticks)
        several = [
            (moments, robot)
            for robot in range(len(records[0][1]))
            if (moments := _steps_of([(tick, rows[robot]) for tick, rows in records]))
        ]
        if several:
            moments, robot = min(several)
            return Steps(seed, robot, tuple(tick + ANSWER for tick in moments))
    raise SocialmindError(
        f"none of the robots of {len(seeds)} runs brought an object home and came back to a signal"
    )


def _recorded(seed: int, ticks: int | None) -> list[tuple[int, list[dict[str, bool]]]]:
    """Return what each robot of a run sees, hears and holds, moment by moment."""
    model_class = load_model("foraging")
    model: Any = model_class(seed=seed)
    names = list(model_class.populations["robots"].sensors)
    rows = model.tables["robots"].rows
    places = {name: names.index(name) for name in ("ACTOBJ", "ACTSIG", "HOLDS")}
    records = []
    while model.tick < (ticks or model_class.ticks):
        model.advance(EVERY)
        told = [
            {name: bool(row["readings"][place] > 0.5) for name, place in places.items()}
            for row in rows
        ]
        records.append((model.tick, told))
    return records


def _steps_of(records: Sequence[tuple[int, dict[str, bool]]]) -> tuple[int, ...] | None:
    """Return the ticks of the eight steps of a robot, or None."""
    wanted: tuple[tuple[str, bool], ...] = (
        ("ACTOBJ", True), ("HOLDS", True), ("ACTOBJ", False), ("HOLDS", False), ("ACTSIG", True),
        ("ACTOBJ", True),
    )  # fmt: skip
    moments: list[int] = []
    at = 0
    for name, value in wanted:
        while at < len(records) and records[at][1][name] is not value:
            at += 1
        if at == len(records):
            return None
        moments.append(records[at][0])
    sees, grips, leaves, home, hears, again = moments
    turned = hears + (again - hears) // 3
    nearer = hears + 2 * (again - hears) // 3
    if sees <= BEFORE or again - hears < 6 * EVERY:
        return None
    return sees - BEFORE, sees, grips, leaves, home, turned, nearer, again


def draw(out: Path, steps: Steps) -> list[Path]:
    """Draw the steps, the plane on the left and the robot's hierarchy on the right.

    Args:
        out: the folder.
        steps: which.

    Returns:
        A PDF and a PNG for each two, a page that tells of them, and what Forage sends in each step
        as CSV.
    """
    out.mkdir(parents=True, exist_ok=True)
    style = Style(mind=True, robot=("robots", steps.robot), around=AROUND, trail=TRAIL,
                  inputs=False, plane_first=True)  # fmt: skip
    captions = [f"Step {n}: {told}." for n, told in enumerate(TOLD, 1)]
    files = []
    with TemporaryDirectory() as folder:
        made = run(load_model("foraging"), steps.ticks[-1], steps.seed, out=Path(folder) / "run")
        for name, part in (("8.3", slice(0, 4)), ("8.4", slice(4, 8))):
            files += draw_steps(
                made, out / f"figure-{name}", steps.ticks[part], style, captions[part]
            )
    lines = [
        "# Figures 8.3 and 8.4: a robot forages with others",
        "",
        f"Robot {steps.robot} of the run with seed {steps.seed}; "
        "by `socialmind reproduce figure-8.3`.",
        "",
    ]
    lines += [
        f"{number}. Tick {tick:,}: {text}."
        for number, (tick, text) in enumerate(zip(steps.ticks, TOLD, strict=True), 1)
    ]
    page, numbers = out / "figure-8.3.md", out / "figure-8.3.csv"
    page.write_text("\n".join(lines) + "\n", "utf-8")
    with numbers.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["seed", "robot", "step", "tick", *SKILLS],
                                lineterminator="\n")  # fmt: skip
        writer.writeheader()
        writer.writerows(influences(steps))
    return [*files, page, numbers]


def influences(steps: Steps) -> list[dict[str, float]]:
    """Return what Forage sends each skill below it in each step, a row each.

    Args:
        steps: which.
    """
    model: Any = load_model("foraging")(seed=steps.seed)
    robot = model.tables["robots"][steps.robot]
    rows = []
    for number, tick in enumerate(steps.ticks, 1):
        model.advance(tick - model.tick)
        mind = robot.hierarchy
        sent = {name: round(float(mind.influence(name)), 4) for name in SKILLS}
        rows.append(
            {"seed": steps.seed, "robot": steps.robot, "step": number, "tick": tick, **sent}
        )
    return rows
