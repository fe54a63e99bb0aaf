"""Who is in a group, asked of all agents: for interpreted rules, and by users between ticks."""

from __future__ import annotations

from typing import Any

from coglogo_py import kernel
from coglogo_py.border.numbers import whole_number
from socialmind.errors import SocialmindError, ValueRefusedError


def members_of(table: Any, group: str, identity: int) -> list[Any]:
    """Return the agents in an instance of a group, in order of birth; none once it has ended.

    Args:
        table: the population.
        group: the group's type.
        identity: the instance's, as `mind.get_group_id` gives it.

    Raises:
        MindError: the minds know no such group.
    """
    place = _group_of(table, group)
    identity = whole_number(identity, f"members_of {group!r}, id", error=ValueRefusedError)
    minds, slots = table.society.minds, table.slots
    row = kernel.find_group(minds, place, identity)
    if row < 0:
        return []
    inside = minds.group_slot[table.columns["_mind"][slots], place] == row
    return [table.row_class(table, slot) for slot in slots[inside].tolist()]


QUESTIONS = {"members_of": members_of}
FUNCTIONS = {f"_agents_{name}": function for name, function in QUESTIONS.items()}
"""What interpreted rules call."""


def _group_of(table: Any, group: str) -> int:
    if table.society is None:
        raise SocialmindError(f"the agents of {table.shape.name!r} have no minds, so no groups")
    place: int = table.society.names.group(group)
    return place
