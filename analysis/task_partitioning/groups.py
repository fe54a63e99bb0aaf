"""The groups of the study: evolved ones and programmed ones, judged alike in worlds for reporting.

Worlds are of three kinds, and none is of two: trainings draw theirs, 64 bits each, from a hash of
their seed; the attempt whose mind the model has is chosen in `CHOOSING`; results tell of
`REPORTED`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pandas as pd

from socialmind.catalogue import load_model
from socialmind.experiments.measures.division import (
    division_by_chance,
    division_of_labour,
    share_specialised,
    works_of,
)
from socialmind.experiments.trainings.plans import attempts_of
from socialmind.learning import Training
from socialmind.mind import MindDescription

CHOOSING = range(3001, 3021)
REPORTED = range(6001, 6021)
GROUNDS: Mapping[str, float] = {"slope": 1.0, "flat": 0.0}
"""The gradient of each ground."""
NAMES: Mapping[str, str] = {"slope": "the slope", "flat": "flat ground"}
PRIMITIVES, BLOCKS = "primitives", "building blocks"
EVOLVED: Mapping[str, tuple[str, str]] = {
    "slope": (PRIMITIVES, "slope"),
    "flat": (PRIMITIVES, "flat"),
    "blocks_slope": (BLOCKS, "slope"),
    "blocks_flat": (BLOCKS, "flat"),
}
"""What the minds of each training begin with, and the ground on which they evolve."""
ROBOTS = 4
DEALS = 20
"""How often work is dealt out anew for what luck alone gives."""
KEYS = ["group", "attempt", "ground", "world"]
JUDGED = [
    "delivered", "shared", "slid", "division", "by_chance", "specialised",
]  # fmt: skip


@dataclass(frozen=True)
class Group:
    """Four robots that are judged.

    Attributes:
        name: how they came to do what they do.
        attempt: which of several; 0 where nothing evolved.
        mind: theirs; None where they are programmed.
        parameters: of the model, but for the gradient.
    """

    name: str
    attempt: int = 0
    mind: MindDescription | None = None
    parameters: Mapping[str, int] = field(default_factory=dict)


def mix(generalists: int, droppers: int, collectors: int) -> Group:
    """Return a programmed group."""
    numbers = {
        "n_generalists": generalists, "n_droppers": droppers, "n_collectors": collectors,
    }  # fmt: skip
    words = (
        f"{number} {word}{'s' if number > 1 else ''}"
        for number, word in zip(
            numbers.values(), ("generalist", "dropper", "collector"), strict=True
        )
        if number
    )
    return Group(", ".join(words), parameters=numbers)


GENERALISTS, HALVES = mix(ROBOTS, 0, 0), mix(0, ROBOTS // 2, ROBOTS // 2)


def mixes() -> Iterator[Group]:
    """Yield every group of four programmed robots."""
    for generalists in range(ROBOTS, -1, -1):
        for droppers in range(ROBOTS - generalists, -1, -1):
            yield mix(generalists, droppers, ROBOTS - generalists - droppers)


def evolved(trainings: Mapping[str, Training | None]) -> Iterator[Group]:
    """Yield all attempts that are finished.

    Args:
        trainings: by name.
    """
    for name, attempt, mind in attempts_of(trainings):
        yield Group(evolved_from(*EVOLVED[name]), attempt, mind)


def evolved_from(start: str, ground: str) -> str:
    """Return the name of the groups that evolved from a start on a ground.

    >>> evolved_from("primitives", "flat")
    'from primitives, on flat ground'
    """
    return f"from {start}, on {NAMES[ground]}"


def evolved_there(table: pd.DataFrame, start: str, ground: str) -> pd.DataFrame:
    """Return the rows of the groups that evolved on a ground, judged on it.

    Args:
        table: of `judge_all`.
        start: what their minds began with.
        ground: one of `GROUNDS`.
    """
    own = table["group"] == evolved_from(start, ground)
    return table[own & (table["ground"] == ground)]


def judged(group: Group, ground: str, worlds: Sequence[int]) -> pd.DataFrame:
    """Return what a group comes to, a row for each world.

    Args:
        group: the robots.
        ground: one of `GROUNDS`.
        worlds: their seeds.
    """
    model = load_model("task_partitioning")
    rows = []
    for world in worlds:
        arena = model(
            world, hierarchy=group.mind, n_robots=ROBOTS, gradient=GROUNDS[ground],
            **group.parameters,
        )  # fmt: skip
        arena.advance(model.ticks)
        key = dict(zip(KEYS, (group.name, group.attempt, ground, world), strict=True))
        rows.append(key | measured(arena))
    return pd.DataFrame(rows)


def measured(arena: Any) -> dict[str, float]:
    """Return the measures of a run that has come to its end.

    Returns:
        `delivered`: items brought home. `shared`: the share of them that more than one robot had
        (the paper's degree of task partitioning); `slid`: the share that slid down. `division`:
        I / H(tasks), the tasks being to take an item from the source and to bring one home;
        `by_chance`: the same when the work is dealt out at random. `specialised`: the share of
        robots of whose work 80 % is one of these tasks. NaN where nothing was done.
    """
    home = arena.delivered
    robots = arena.robots
    done = pd.concat(
        [
            pd.DataFrame({"tick": arena.tick, "agent": robots.id, "task": task, "amount": amount})
            for task, amount in (("fetch", robots.fetched), ("deliver", robots.delivered))
        ]
    )
    present = pd.DataFrame({"tick": arena.tick, "agent": robots.id})
    works = works_of(done)
    return {
        "delivered": home,
        "shared": arena.shared / home if home else math.nan,
        "slid": arena.slid / home if home else math.nan,
        "division": division_of_labour(works).agents_to_tasks,
        "by_chance": division_by_chance(works, DEALS).agents_to_tasks,
        "specialised": float(share_specialised(done, present).iloc[-1]),
    }


def judge_all(trainings: Mapping[str, Training | None], worlds: Sequence[int]) -> pd.DataFrame:
    """Return what all attempts and all programmed groups come to, on either ground.

    Args:
        trainings: by name.
        worlds: their seeds.
    """
    groups = [*evolved(trainings), *mixes()]
    tables = [judged(group, ground, worlds) for group in groups for ground in GROUNDS]
    return pd.concat(tables, ignore_index=True)


def best_attempt(training: Training) -> int:
    """Return the attempt that brings most home on the slope, in the worlds for choosing."""
    found = {
        group.attempt: judged(group, "slope", CHOOSING)["delivered"].mean()
        for group in evolved({"slope": training})
    }
    return max(found, key=lambda attempt: found[attempt])
