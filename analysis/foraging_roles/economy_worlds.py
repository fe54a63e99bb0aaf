"""Contestants in the economy without bodies: worlds in which they decide, and their minds.

Lessons count a robot by the role that it holds, or by what it brought home last, as they are paid.
Where ways are compared all are counted by what they bring, as they are in bodies.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MethodType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.catalogue import load_file
from socialmind.mind import MindDescription, Programmed
from socialmind.mind.minds import Minds

from . import scheme_evolution
from .contestants import Contestant
from .scheme_economy import WRITTEN, SchemeWorlds
from .threshold_scan import CONTROLLERS, Responders
from .trainings import ECONOMY, MODEL

DELIVERIES = load_file(MODEL / "deliveries.py")
ROLE = "ForageRole"


def counted_by_deliveries(worlds: Any) -> Any:
    """Let robots of worlds be counted by what they brought home last, as `Deliveries` does.

    Args:
        worlds: of the economy, at their beginning; they are returned.
    """
    worlds.brought, worlds.delivered = np.full(worlds.role.shape, -1), np.zeros(len(worlds.rows))
    worlds._off = MethodType(DELIVERIES.Deliveries._off, worlds)
    deliver = worlds._deliver

    def and_see(rows: NDArray[np.int64], who: NDArray[np.int64], minds: Any) -> None:
        robot, changes = who[rows], worlds.changes.copy()
        is_b = worlds.role[rows, robot] >= 0.5
        deliver(rows, who, minds)
        worlds.changes = changes  # of roles held
        DELIVERIES.Deliveries._see(worlds, rows, robot, is_b)

    worlds._deliver = and_see
    worlds.off_now = worlds._off()
    return worlds


def worlds_of(
    one: Contestant, terms: Mapping[str, Any], worlds: Sequence[int], ticks: int
) -> tuple[Any, Any]:
    """Return worlds of the economy in which robots decide, and their minds if they have some.

    Args:
        one: the robots.
        terms: of the economy.
        worlds: seeds.
        ticks: of a run.
    """
    given = ECONOMY.Terms(**terms)
    drawn = [ECONOMY.World(seed, given, ticks) for seed in worlds]
    if "programmed" in one.parameters:
        numbers = np.array([list(numbers_of_scheme(one).values())])
        return counted_by_deliveries(SchemeWorlds(drawn, worlds, numbers, ticks)), None
    if one.way in CONTROLLERS:
        return counted_by_deliveries(Responders(drawn, worlds, ticks, one.parameters)), None
    mind = one.mind or MindDescription.load(MODEL / "mind")
    if not learned_choice(mind):
        minds = with_genome(ECONOMY.thinking(mind, ROLE), mind, len(worlds))
        return counted_by_deliveries(ECONOMY.Worlds(drawn, 1, ticks)), minds
    drawn = [DELIVERIES.DeliveryWorld(seed, given, ticks) for seed in worlds]
    parts = DELIVERIES.thinking(mind, ROLE), DELIVERIES.choosing(mind, DELIVERIES.CHOICE)
    heads = DELIVERIES.Heads(*(with_genome(part, mind, len(worlds)) for part in parts))
    return DELIVERIES.Deliveries(drawn, 1, ticks, heads), heads


def learned_choice(mind: MindDescription) -> bool:
    """Say whether what ROLE means was learned."""
    return not isinstance(mind.skill(DELIVERIES.CHOICE).function, Programmed)


def with_genome(part: MindDescription, mind: MindDescription, agents: int) -> Minds:
    """Return a mind of one skill for many robots, with the weights that the whole mind has."""
    name = next(iter(part.skills))
    minds = Minds(part, agents=agents, own_genomes=True)
    minds.set_genome(name, np.tile(mind.skill(name).genome, (agents, 1)))
    return minds


def numbers_of_scheme(one: Contestant) -> Mapping[str, float]:
    """Return the numbers of a programmed contestant: those that evolved, or those written."""
    if one.way == scheme_evolution.NAME:
        evolved = scheme_evolution.kept()[one.attempt].tolist()
        return dict(zip(WRITTEN, evolved, strict=True))
    return {**WRITTEN, "tolerance": one.parameters.get("tolerance", WRITTEN["tolerance"])}
