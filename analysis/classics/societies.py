"""The societies of the study: each is run and measured here."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.signal import convolve2d
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from socialmind.catalogue import load_model

LINK = 3.0
"""Patches at most between two birds that hold a flock together."""
MOMENTS = (0, 20, 50, 100, 300)
LATER = 500
TICKS = 2000
"""Length of a society of wolves and sheep."""
BEGIN = 100
"""Ticks that the start is given to be forgotten, before numbers are averaged."""


def flock(sight: float, seed: int) -> list[dict[str, Any]]:
    """Let 200 birds fly in a world of 100 × 100.

    Args:
        sight: in patches.
        seed: of the society.

    Returns:
        A row for each moment.
    """
    society = load_model("flocking")(seed, sight=sight)
    rows = []
    for tick in MOMENTS:
        society.advance(tick - society.tick)
        birds = society.birds
        largest = largest_flock(np.array([birds.x, birds.y]).T, society.world_size)
        row = {"sight": sight, "seed": seed, "tick": tick}
        rows.append(row | {"polarisation": society.series()["polarisation"], "largest": largest})
    return rows


def largest_flock(places: np.ndarray, size: float) -> float:
    """Return the share of birds in the largest flock: birds linked by at most `LINK`.

    Args:
        places: x and y of each bird.
        size: side of the world, which wraps.

    >>> places = np.array([[-49.0, 0.0], [49.0, 0.0], [48.0, 2.0], [0.0, 0.0]])
    >>> largest_flock(places, 100)
    0.75
    """
    tree = cKDTree(np.mod(places, size), boxsize=size)
    links = tree.sparse_distance_matrix(tree, LINK)
    # Birds on the same place are linked as well, but by a 0, which a sparse matrix leaves out.
    links.update(dict.fromkeys(tree.query_pairs(LINK), 1.0))
    return float(np.bincount(connected_components(links)[1]).max() / len(places))


def segregated(minimum: int, seed: int) -> list[dict[str, Any]]:
    """Let 1,000 persons settle in a world of 40 × 40, among eight neighbours.

    Args:
        minimum: neighbours of its own kind that a person wants.
        seed: of the society.

    Returns:
        A row after the ticks of a run, and one much later.
    """
    society = load_model("schelling")(seed, minimum=minimum)
    rows = []
    for tick in (society.ticks, LATER):
        society.advance(tick - society.tick)
        row = {"minimum": minimum, "seed": seed, "tick": tick}
        happy = society.people.happy.mean()
        rows.append(row | {"happy": happy, "alike": share_alike(society)})
    return rows


def share_alike(society: Any) -> float:
    """Return the share of neighbours that are of one's own kind, over all pairs of neighbours."""
    people, world = society.people, society.world
    places = (people.x.astype(int) - world.low_x, people.y.astype(int) - world.low_y)
    around = np.ones((3, 3))
    around[1, 1] = 0
    kinds = np.zeros((2, world.width, world.height))
    for kind in (0, 1):
        kinds[kind][places] = people.kind == kind
    near = [convolve2d(one, around, mode="same") for one in kinds]
    alike = sum((near[kind] * kinds[kind]).sum() for kind in (0, 1))
    return float(alike / ((near[0] + near[1]) * (kinds[0] + kinds[1])).sum())


def wolves_and_sheep(regrowth: int, seed: int) -> list[dict[str, Any]]:
    """Let 60 sheep and 40 wolves live in a world of 25 × 25.

    Args:
        regrowth: ticks until grass is grown again.
        seed: of the society.

    Returns:
        One row: when a kind died out, mean numbers and cycles where both live.
    """
    society = load_model("wolves_sheep")(seed, regrowth=regrowth)
    numbers = []
    for _ in range(TICKS):
        society.advance(1)
        numbers.append((len(society.sheep), len(society.wolves)))
    sheep, wolves = np.array(numbers, float).T
    row: dict[str, Any] = {"regrowth": regrowth, "seed": seed}
    for name, count in (("sheep", sheep), ("wolves", wolves)):
        row[f"{name}_end"] = int(np.argmin(count)) + 1 if count.min() == 0 else None
    if row["sheep_end"] is None and row["wolves_end"] is None:
        sheep, wolves = sheep[BEGIN:], wolves[BEGIN:]
        cycle, strength = cycle_of(sheep)
        row |= {"sheep": sheep.mean(), "wolves": wolves.mean(), "cycle": cycle}
        row |= {"strength": strength, "delay": delay_of(sheep, wolves)}
    return [row]


def correlations(one: np.ndarray, other: np.ndarray, lags: int) -> np.ndarray:
    """Return how the one goes with the other so many ticks later, for lags from 0 on."""
    one, other = (values - values.mean() for values in (one, other))
    scale = one.std() * other.std()
    return np.array([(one[: len(one) - lag] * other[lag:]).mean() / scale for lag in range(lags)])


def cycle_of(numbers: np.ndarray) -> tuple[float, float]:
    """Return the length of a cycle, and how much (at most 1) numbers go with those a cycle later.

    A cycle is over where they go with themselves best, once they did not.

    It is looked for up to 120 ticks; NaN for both where they go with themselves all that time.

    >>> length, strength = cycle_of(np.sin(np.arange(1000) * 2 * np.pi / 50))
    >>> length, round(strength, 3)
    (50.0, 1.0)
    """
    found = correlations(numbers, numbers, 121)
    if not (found < 0).any():
        return float("nan"), float("nan")
    apart = int(np.argmax(found < 0))
    cycle = apart + int(np.argmax(found[apart:]))
    return float(cycle), float(found[cycle])


def delay_of(sheep: np.ndarray, wolves: np.ndarray) -> float:
    """Return after how many ticks the wolves go best with the sheep, of up to 60.

    >>> sheep = np.random.default_rng(1).random(1000)
    >>> delay_of(sheep, np.roll(sheep, 25))
    25.0
    """
    return float(np.argmax(correlations(sheep, wolves, 61)))
