"""One pasture of the study: run, and its herds measured."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.catalogue import load_model

SETTINGS: dict[str, dict[str, Any]] = {
    "participation 4": {},
    "participation 0": {"participation": 0.0},
    "participation 40": {"participation": 40.0},
    "nobody joins": {"sight": 0.0},
}
"""The model, what a herd adds to minds taken away or multiplied, and leaders that none can see."""
BEGIN = 500
"""Ticks that levels leave out: the first herds form."""
EVERY = 10
"""Ticks between two looks: a herd that passes within them goes unseen."""


def lived(
    setting: str, seed: int, ticks: int
) -> tuple[dict[str, Any], list[dict[str, Any]], list[dict[str, Any]]]:
    """Run a pasture and measure its herds.

    Args:
        setting: one of `SETTINGS`.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        A row for the pasture, one for each herd, and one for each tick looked at.
    """
    model = load_model("herds")(seed, **SETTINGS[setting])
    key = {"setting": setting, "seed": seed}
    begun: dict[int, int] = {}
    seen: dict[int, int] = {}
    largest: dict[int, int] = {}
    looks, apart, to_leader = [], [], []
    for tick in range(EVERY, ticks + 1, EVERY):
        model.advance(EVERY)
        herds, leading = model.cows.herd, model.cows.leading
        for herd in herds[leading].tolist():
            begun.setdefault(herd, tick)
            seen[herd] = tick
            largest[herd] = max(largest.get(herd, 0), int((herds == herd).sum()))
        looks.append(
            {
                **key, "tick": tick, "herds": model.herds, "in_herds": model.in_herds,
                "largest": model.largest,
            }
        )  # fmt: skip
        if tick > BEGIN:
            distances = between(model.cows.x, model.cows.y, model.world.size)
            apart.append(distances[np.triu_indices(len(herds), 1)].mean())
            to_leader += follower_distances(distances, herds, leading)
    rows = [
        {
            **key, "herd": herd, "founded": tick, "life": seen[herd] - tick + EVERY,
            "ended": seen[herd] < ticks, "largest": largest[herd],
        }
        for herd, tick in begun.items()
    ]  # fmt: skip
    settled = [look for look in looks if look["tick"] > BEGIN]
    ended = sum(row["ended"] for row in rows)
    pasture = {
        **key,
        "herds": float(np.mean([look["herds"] for look in settled])),
        "two_or_more": float(np.mean([look["herds"] > 1 for look in settled])),
        "in_herds": float(np.mean([look["in_herds"] for look in settled]) / len(model.cows)),
        "largest": float(np.mean([look["largest"] for look in settled])),
        "founded": len(rows) / ticks * 1000,
        "ended": ended / ticks * 1000,
        "life": sum(row["life"] for row in rows) / ended if ended else math.nan,
        "apart": float(np.mean(apart)),
        "to_leader": float(np.mean(to_leader)) if to_leader else math.nan,
        "cows": len(model.cows),
        "energy": float(model.cows.energy.mean()),
    }
    return pasture, rows, looks


def between(x: NDArray[Any], y: NDArray[Any], size: int) -> NDArray[np.float64]:
    """Return the distances of all cows, two by two, the short way round a torus."""

    def short(values: NDArray[Any]) -> NDArray[np.float64]:
        apart = np.abs(np.subtract.outer(values, values))
        return np.minimum(apart, size - apart)

    return np.hypot(short(x), short(y))


def follower_distances(
    distances: NDArray[np.float64], herds: NDArray[Any], leading: NDArray[Any]
) -> list[float]:
    """Return how far each follower of a herd is from the leader, of herds that have one."""
    found = []
    for leader in np.flatnonzero(leading):
        followers = (herds == herds[leader]) & ~leading
        found += distances[leader, followers].tolist()
    return found
