"""Walking from patch to patch over ground that is more or less easy to cross.

MetaCiv's movement (TurtleKit's `fd` as its agents have it), from cell to cell. Patches are
`Ground`; agents that walk have a field `stride: int = 2`: how far they have crossed theirs.
"""

from __future__ import annotations

import math
from typing import Any

from socialmind.terrain.ground import tread

AROUND = ((0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1))
"""The eight neighbours, by headings of 0, 45, … 315 degrees."""


def step_ahead(agent: Any, model: Any, creation: int, rng: Any) -> bool:
    """Work one tick on crossing the patch, and enter the next one ahead when that is done.

    A patch of the passability p takes p div 10 - 2 ticks, one at least; below 20, two patches are
    crossed in one tick. Before what cannot be entered, the agent turns any way that is open. It
    leaves a trace on every patch that it enters.

    Args:
        agent: the agent.
        model: the model; its world's patches are `Ground`.
        creation: a patch trodden more often than this is a road; 0 or less for no roads.
        rng: the agent's stream.

    Returns:
        Whether it has entered a patch.
    """
    entered = False
    for _ in range(patches_ahead(agent, model)):
        entered = enter_next(agent, model, creation, rng) or entered
    return entered


def patches_ahead(agent: Any, model: Any) -> int:
    """Work one tick on crossing the patch; return how many that lets it enter: 0, 1 or 2."""
    count = 0
    effort = max(model.world.patch(agent.x, agent.y).passability // 10, 1)
    if agent.stride > effort:
        agent.stride -= effort
        count += 1
    if agent.stride < effort:
        agent.stride += 1
    if agent.stride == effort:
        agent.stride = 2
        count += 1
    return count


def enter_next(agent: Any, model: Any, creation: int, rng: Any) -> bool:
    """Enter the neighbouring patch ahead, or another that is open; return whether there is one."""
    dx, dy = AROUND[math.floor(agent.heading / 45 + 0.5) % 8]
    while model.world.patch(agent.x + dx, agent.y + dy).impassable:
        if all(model.world.patch(agent.x + i, agent.y + j).impassable for i, j in AROUND):
            return False
        agent.heading = rng.uniform(0, 360)
        dx, dy = AROUND[math.floor(agent.heading / 45 + 0.5) % 8]
    model.world.move_to(agent, agent.x + dx, agent.y + dy)
    tread(agent, model, creation)
    return True


def step_towards(
    agent: Any,
    model: Any,
    x: float,
    y: float,
    sight: int,
    beyond: float,
    creation: int,
    rng: Any,
) -> bool:
    """Work one tick on the cheapest way to a place, and go no further than there.

    Args:
        agent: the agent.
        model: the model; its world's patches have an effort.
        x: the place.
        y: the place.
        sight: how many patches far the agent knows the ground; 0 or less for all.
        beyond: the effort that it expects beyond.
        creation: as for `step_ahead`.
        rng: the agent's stream.

    Returns:
        Whether it has entered a patch.
    """
    heading = model.world.way("effort", agent.x, agent.y, x, y, sight, beyond)
    entered = False
    if heading >= 0:
        for before in range(patches_ahead(agent, model)):
            if before > 0:
                heading = model.world.way("effort", agent.x, agent.y, x, y, sight, beyond)
            if heading >= 0:
                agent.heading = heading
                entered = enter_next(agent, model, creation, rng) or entered
    return entered
