"""Facilities: places with a stock that belong to an agent, to a group, or to everybody.

A facility is an agent of a population of its own, which inherits from `Facility`. MetaCiv's
amenagements (thesis, chapter 3).
"""

from __future__ import annotations

from typing import Any

from socialmind.agents.agent import Agent


class Facility(Agent):
    """The base of facilities; unless it is given an owner or a group, it is public.

    Attributes:
        owner: the identity of the agent to which it belongs, or -1.
        group: the identity of the group to which it belongs, as `get_group_id` gives it, or -1.
    """

    owner: int = -1
    group: int = -1


def stand_at(facility: Any, agent: Any) -> None:
    """Put a facility where an agent is; without more it is public."""
    facility.x = agent.x
    facility.y = agent.y


def build_private(facility: Any, agent: Any) -> None:
    """Put a new facility where an agent is, to which it belongs."""
    stand_at(facility, agent)
    facility.owner = agent.id


def build_for_group(facility: Any, agent: Any, group: int) -> None:
    """Put a new facility where an agent is; it belongs to a group, by its identity."""
    stand_at(facility, agent)
    facility.group = group


def may_use(agent: Any, facility: Any, group: int) -> bool:
    """Return whether an agent may use a facility.

    Args:
        agent: the agent.
        facility: the facility.
        group: the identity of the agent's group, -1 for none.
    """
    if facility.owner >= 0:
        return facility.owner == agent.id
    if facility.group >= 0:
        return facility.group == group
    return True


def facility_here(model: Any, facilities: Any, agent: Any) -> int:
    """Return the identity of the first facility on an agent's patch, -1 for none."""
    for facility in facilities:
        if model.world.is_on(agent, facility.x, facility.y):
            return facility.id
    return -1


def nearest_usable(model: Any, facilities: Any, agent: Any, group: int) -> int:
    """Return the identity of the nearest facility that an agent may use, -1 for none.

    Args:
        model: the model.
        facilities: a population of facilities, `model.barns`.
        agent: the agent.
        group: the identity of its group, -1 for none.
    """
    found = -1
    least = 0.0
    for facility in facilities:
        if may_use(agent, facility, group):
            away = model.world.distance(agent, facility.x, facility.y)
            if found < 0 or away < least:
                found = facility.id
                least = away
    return found


def clear_ownerless(facilities: Any, agents: Any) -> None:
    """Let the private facilities go whose owner has died; once a tick."""
    for facility in facilities:
        if facility.owner >= 0 and not agents.contains(facility.owner):
            facility.die()


def clear_deserted(facilities: Any, agents: Any, group: str) -> None:
    """Let the facilities of groups go that have no members any more; once a tick.

    Args:
        facilities: a population of facilities.
        agents: the population of the members.
        group: the type of the groups, as in their scheme.
    """
    for facility in facilities:
        if facility.group >= 0 and len(agents.members_of(group, facility.group)) == 0:
            facility.die()
