"""One pasture of the study: run, and its cows and wolves measured."""

from __future__ import annotations

from typing import Any

import numpy as np

from socialmind.catalogue import load_model

SETTINGS: dict[str, dict[str, Any]] = {
    "wolves": {},
    "fearless wolves": {"courage": 100.0},
    "no wolves": {"n_wolves": 0},
}
"""The model, wolves that no bull frightens, and none."""
BULLS = (0, 1, 2, 3, 5, 8)
EVERY = 20
"""Ticks between two looks."""
EARLY = 200
"""Ticks at the start in which few cows have been eaten yet."""


def lived(
    setting: str, bulls: int, seed: int, ticks: int
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Run a pasture and measure it.

    Args:
        setting: one of `SETTINGS`.
        bulls: their number.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        A row for the pasture and one for each tick looked at.
    """
    model = load_model("wolf_cow")(seed, n_bulls=bulls, **SETTINGS[setting])
    key = {"setting": setting, "bulls": bulls, "seed": seed}
    looks = [{**key, "tick": 0, "cows": len(model.cows)}]
    attacking, early = [], 0
    for tick in range(EVERY, ticks + 1, EVERY):
        model.advance(EVERY)
        looks.append({**key, "tick": tick, "cows": len(model.cows)})
        if tick <= EARLY:
            early = model.killed
            if len(model.wolves):
                attacking.append(model.attacking / len(model.wolves))
    half = [look["cows"] for look in looks if look["tick"] > ticks / 2]
    pasture = {
        **key,
        "cows": float(np.mean(half)),
        "survived": float(half[-1] > 0),
        "gone_at": next((look["tick"] for look in looks if not look["cows"]), None),
        "early_killed": early,
        "early_attacking": float(np.mean(attacking)) if attacking else 0.0,
        "killed": model.killed,
        "starved": model.starved,
        "born": model.born,
    }
    return pasture, looks
