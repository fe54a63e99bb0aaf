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
    return _found(table, group, identity, "members_of")


def asking(table: Any, group: str, identity: int) -> list[Any]:
    """Return the agents that ask to join an instance of a group, in order of birth.

    Args:
        table: the population.
        group: the group's type.
        identity: the instance's; none ask for one that has ended.

    Raises:
        MindError: the minds know no such group.
    """
    return _found(table, group, identity, "asking")


QUESTIONS = {"members_of": members_of, "asking": asking}
FUNCTIONS = {f"_agents_{name}": function for name, function in QUESTIONS.items()}
"""What interpreted rules call."""


def _found(table: Any, group: str, identity: int, what: str) -> list[Any]:
    if table.society is None:
        raise SocialmindError(f"the agents of {table.shape.name!r} have no minds, so no groups")
    place = table.society.names.group(group)
    identity = whole_number(identity, f"{what} {group!r}, id", error=ValueRefusedError)
    minds, slots = table.society.minds, table.slots
    row = kernel.find_group(minds, place, identity)
    if row < 0:
        return []
    of_minds, sought = (minds.asked_id, identity) if what == "asking" else (minds.group_slot, row)
    found = slots[of_minds[table.columns["_mind"][slots], place] == sought]
    return [table.row_class(table, slot) for slot in found.tolist()]
