"""Patches that are more or less easy to cross, and the roads that those who walk leave on them."""

from __future__ import annotations

from typing import Any

from socialmind.worlds.grid.grid import Patch


class Ground(Patch):
    """The base of patches that agents walk over.

    Attributes:
        passability: what it takes to cross it; 20 … 29 is a patch a tick (`step_ahead`).
        impassable: whether nobody can enter it.
        effort: what a way over it costs (`step_towards`): infinite where nobody can enter it.
        passage: how often it was trodden, less what has worn off.
        road: whether that has left a road.
    """

    passability: int = 20
    impassable: bool = False
    effort: float = 20.0
    passage: int = 0
    road: bool = False


def tread(agent: Any, model: Any, creation: int) -> None:
    """Tread on the patch where an agent stands, which may become a road.

    Args:
        agent: the agent.
        model: the model.
        creation: a patch trodden more often than this is a road, whose ways cost half; 0 or less
            for no roads.
    """
    ground = model.world.patch(agent.x, agent.y)
    ground.passage += 1
    if ground.passage > creation > 0 and not ground.road:
        ground.road = True
        ground.effort = ground.passability / 2


def wear_off(model: Any, evaporation: int) -> None:
    """Let the ground recover, and roads go that are trodden no more.

    Args:
        model: the model.
        evaporation: what each patch loses of its passage; a road with less than that is gone.
    """
    for ground in model.world.patches:
        if ground.passage > 0:
            ground.passage = max(ground.passage - evaporation, 0)
            if ground.road and ground.passage < evaporation:
                ground.road = False
                ground.effort = float(ground.passability)
