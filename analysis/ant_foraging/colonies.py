"""One colony of the study: run, and measured."""

from __future__ import annotations

from typing import Any

from socialmind.catalogue import load_model

DROP = 0.3
"""Pheromone of a step on the bridge, outward and homeward."""
DROPS = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0)
SHORT, LONG, LITTLE_LONGER = 2, 12, 5
"""Detours of 20, 40 and 26 steps."""
BOTH_WAYS = {"bridge": True, "outward": DROP, "homeward": DROP}
BRIDGES: dict[str, dict[str, Any]] = {
    "20 and 40 steps": {**BOTH_WAYS, "detour_north": SHORT, "detour_south": LONG},
    "40 and 20 steps": {**BOTH_WAYS, "detour_north": LONG, "detour_south": SHORT},
    "20 and 26 steps": {**BOTH_WAYS, "detour_north": SHORT, "detour_south": LITTLE_LONGER},
    "20 and 20 steps": {**BOTH_WAYS, "detour_north": SHORT, "detour_south": SHORT},
    "no pheromone": {
        "bridge": True, "outward": 0.0, "homeward": 0.0,
        "detour_north": SHORT, "detour_south": LONG,
    },
    "marked homeward only": {
        "bridge": True, "outward": 0.0, "homeward": 2 * DROP,
        "detour_north": SHORT, "detour_south": LONG,
    },
}  # fmt: skip
"""The northern and the southern way; where one of them is shorter it is the northern one, but for
one setting. The last two are of 20 and 40 steps."""
LAST = 1_000
"""Ticks at the end over which traffic is counted."""

FIELDS: dict[str, dict[str, Any]] = {
    "one pile": {"n_piles": 1, "pile_food": 900},
    "three piles": {"n_piles": 3, "pile_food": 300},
    "a hundred crumbs": {"n_piles": 100, "pile_food": 9},
}
"""The same 900 pieces, gathered or scattered, 14 patches from the nest."""
ALL = 900
HALF = ALL // 2
EVERY = 10
"""Ticks between two looks at a field."""


def crossed(setting: str, drop: float, seed: int, ticks: int) -> dict[str, Any]:
    """Let a colony forage over the bridge, and count who passes either way.

    Args:
        setting: one of `BRIDGES`.
        drop: pheromone of a step in place of `DROP`.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        A row: the share that passed on the northern way in the last `LAST` ticks, whether that is
        more than half, and the food brought home in all.
    """
    options = dict(BRIDGES[setting])
    for name in ("outward", "homeward"):
        options[name] *= drop / DROP
    colony = load_model("ant_foraging")(seed, **options)
    colony.advance(ticks - LAST)
    before = colony.passed_north, colony.passed_south
    colony.advance(LAST)
    north, south = colony.passed_north - before[0], colony.passed_south - before[1]
    share = north / (north + south)
    return {
        "setting": setting, "drop": drop, "seed": seed, "north": share,
        "wins": float(share > 0.5), "decided": float(max(share, 1 - share) > 0.9),
        "brought": colony.brought,
    }  # fmt: skip


def gathered(field: str, marks: bool, seed: int, ticks: int) -> list[dict[str, Any]]:
    """Let a colony forage in a field, and look at what it has brought home.

    Args:
        field: one of `FIELDS`.
        marks: whether ants lay pheromone.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        A row for each tick looked at.
    """
    options = FIELDS[field] if marks else {**FIELDS[field], "homeward": 0.0}
    colony = load_model("ant_foraging")(seed, **options)
    rows = []
    for tick in range(0, ticks + 1, EVERY):
        colony.advance(tick - colony.tick)
        rows.append(
            {"field": field, "marks": marks, "seed": seed, "tick": tick, "brought": colony.brought}
        )
    return rows
