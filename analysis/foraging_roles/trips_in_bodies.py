"""How long trips of bodies take, and how far objects are when they set out.

python -m analysis.foraging_roles.trips_in_bodies

Measured of nine programmed robots in worlds for choosing; `economy_like_bodies` has numbers near
these. What comes of it is kept in `results/trips_in_bodies.csv`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file

from .economy_like_bodies import SHARES
from .trainings import MODEL
from .worlds import CHOOSING

RULES = load_file(MODEL / "by_deliveries.py")
OUT = Path(__file__).parent / "results" / "trips_in_bodies.csv"
WORLDS, TICKS, EVERY = 8, 40_000, 10
REACH = 100.0
"""Units over which distances are read."""
STUCK = 1600
"""Ticks from which on a trip counts as one on which a robot was stuck."""
LAGS = (0, 100, 300, 1000, 3000)
"""Ticks between two robots' setting out."""


def trips(seed: int, ticks: int = TICKS) -> pd.DataFrame:
    """Return the trips of a world's robots.

    Args:
        seed: of the world.
        ticks: how long.

    Returns:
        A row for each delivery: `seed`, `robot`, `tick`, `kind`, `took`, whether it was the robot's
        `first`, and the readings `a` and `b` of the distances with which it sets out again.
    """
    model: Any = RULES.ForagingByDeliveries(seed=seed, programmed=1.0)
    rows, since = [], {}
    before = np.zeros((2, len(model.robots)))
    for tick in range(EVERY, ticks + 1, EVERY):
        model.advance(tick - model.tick)
        robots = model.robots
        now = np.array([robots.delivered_a, robots.delivered_b])
        for robot in np.flatnonzero((now > before).any(axis=0)).tolist():
            x, y = float(robots.x[robot]), float(robots.y[robot])
            rows.append(
                {
                    "seed": seed,
                    "robot": robot,
                    "tick": tick,
                    "kind": "A" if now[0, robot] > before[0, robot] else "B",
                    "took": tick - since.get(robot, 0),
                    "first": robot not in since,
                    "a": reading(model.objects_a, x, y),
                    "b": reading(model.objects_b, x, y),
                }
            )
            since[robot] = tick
        before = now
    return pd.DataFrame(rows)


def reading(objects: Any, x: float, y: float) -> float:
    """Return how far the nearest object that nobody carries is, as robots read it."""
    free = np.asarray(objects.carrier_kind) < 0
    away = np.hypot(np.asarray(objects.x)[free] - x, np.asarray(objects.y)[free] - y)
    return float(away.min() / REACH)


def together(table: pd.DataFrame, since: float, until: float) -> float:
    """Return how alike readings are of two robots that set out some ticks after each other.

    Args:
        table: of trips.
        since, until: the ticks between them.

    Returns:
        The correlation of what they read beyond their world's mean.
    """
    pairs = []
    for _, world in table.groupby("seed"):
        ticks, robots = world["tick"].to_numpy(), world["robot"].to_numpy()
        later = ticks[None, :] - ticks[:, None]
        met = (later > since) & (later <= until) & (robots[None, :] != robots[:, None])
        first, second = np.nonzero(met)
        for kind in "ab":
            read = (world[kind] - world[kind].mean()).to_numpy()
            pairs.append((read[first], read[second]))
    one, other = (np.concatenate(part) for part in zip(*pairs, strict=True))
    return float(np.corrcoef(one, other)[0, 1])


def measured(table: pd.DataFrame) -> pd.DataFrame:
    """Return what trips are like: `what` and its `value`."""
    later = table[~table["first"]]
    going = later.loc[later["took"] < STUCK, "took"]
    readings = table[["a", "b"]].to_numpy()
    ends = later.groupby(["seed", "kind"])["took"].mean().unstack()
    by_world = table.groupby("seed")[["a", "b"]]
    rows: list[tuple[str, float]] = [
        *((f"trip, share {one:g}", going.quantile(one)) for one in SHARES),
        ("trips with a robot stuck", (later["took"] >= STUCK).mean()),
        ("first trip beside later ones, median",
         table.loc[table["first"], "took"].median() / going.median()),
        ("uneven, at most", (np.log(ends["A"] / ends["B"]) / 2).abs().max()),
        *((f"reading, share {one:g}", np.quantile(readings, one)) for one in SHARES),
        ("reading, mean", readings.mean()),
        ("reading, deviation between worlds", by_world.mean().std().mean()),
        ("reading, deviation in a world", by_world.std().to_numpy().mean()),
        *((f"readings of two robots, up to {until} ticks apart, correlation",
           together(table, since, until)) for since, until in pairwise(LAGS)),
    ]  # fmt: skip
    return pd.DataFrame(rows, columns=["what", "value"])


def measure(worlds: Sequence[int] = CHOOSING[:WORLDS], ticks: int = TICKS) -> pd.DataFrame:
    """Return what trips are like in some worlds."""
    return measured(pd.concat([trips(seed, ticks) for seed in worlds], ignore_index=True))


if __name__ == "__main__":
    found = measure()
    found.to_csv(OUT, index=False, float_format="%.4g", lineterminator="\n")
    print(found.to_string(index=False))
