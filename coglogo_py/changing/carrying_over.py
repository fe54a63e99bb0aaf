"""The minds of a society under another scheme: what both have keeps its place by its name.

Cognitons that the other scheme lacks are forgotten; those that it has more begin as they do in a
mind that is born. Groups, roles and their instances stay; there may be more of them.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from coglogo_py import kernel
from coglogo_py.arrays import MindArrays
from coglogo_py.border.errors import CogLogoError
from coglogo_py.laying_out import mind_arrays
from coglogo_py.names import Names
from coglogo_py.society import Society

State = Mapping[str, NDArray[np.generic]]
BY_INSTANCE = ("instance_id", "instance_group", "members", "within")
BY_GROUP = ("group_slot", "role", "participation", "asked_id", "asked_role")
ROLES = ("role", "asked_role")


def carried_over(state: State, old: Society, new: Society) -> dict[str, NDArray[np.generic]]:
    """Return the state of minds as a society with another scheme takes it.

    Args:
        state: of `old`, as `Society.state` gives it.
        old: with its culture, if it shares one.
        new: of another scheme, in a culture of as many breeds.

    Returns:
        What `new.restore` takes; the same arrays where the names of both schemes are the same.

    Raises:
        CogLogoError: the other scheme lacks a group or a role, or its culture is another one.
    """
    breeds = list(zip(old.sharing or (old,), new.sharing or (new,), strict=False))
    if len(old.sharing) != len(new.sharing):
        raise CogLogoError(
            f"scheme {new.scheme.name!r} shares groups with other breeds than {old.scheme.name!r}"
        )
    if bool(len(old.arrays.group_within)) != bool(len(new.arrays.group_within)):
        raise CogLogoError(f"scheme {new.scheme.name!r} nests groups otherwise than before")
    if all(_names(a.names) == _names(b.names) for a, b in breeds):
        return dict(state)
    was, now = old.names, new.names
    _refuse_fewer(was, now, new.scheme.name)
    made = mind_arrays(new.arrays, len(state["mind_id"]), seed=0)
    for name in ("mind_id", "draws", "free_minds", "counters"):
        getattr(made, name)[:] = state[name]
    _carry_values(made, state, breeds)
    groups = [now.groups[name] for name in was.groups]
    roles = np.full(1 + sum(map(len, was.roles.values())), -1, np.int64)  # the last stands for none
    for group, known in was.roles.items():
        for name, place in known.items():
            roles[place] = now.roles[group][name]
    for name in BY_GROUP:
        if name in state:
            found = state[name]
            getattr(made, name)[:, groups] = roles[found] if name in ROLES else found
    _carry_instances(made, state, np.array([*groups, -1]))
    columns = [
        (place, theirs[group][name])
        for mine, theirs in ((was.culturons, now.culturons), (was.attributes, now.attributes))
        for group, known in mine.items()
        for name, place in known.items()
        if name in theirs[group]
    ]
    rows = len(state["instance_id"])
    made.culturons[:] = new.arrays.culturon_start
    for before, after in columns:
        made.culturons[:rows, after] = state["culturons"][:, before]
    return {name: array for name, array in made._asdict().items() if name in state}


def _names(names: Names) -> tuple[object, ...]:
    """Return what says where the values of minds and groups stand, in its order."""
    inner = [
        [(group, list(known)) for group, known in one.items()]
        for one in (names.roles, names.culturons, names.attributes)
    ]
    return list(names.cognitons), list(names.groups), *inner


def _refuse_fewer(was: Names, now: Names, scheme: str) -> None:
    for group, roles in was.roles.items():
        if group not in now.groups:
            raise CogLogoError(
                f"scheme {scheme!r} lacks the group {group!r}, which minds may be in"
            )
        for role in roles:
            if role not in now.roles[group]:
                raise CogLogoError(
                    f"scheme {scheme!r} lacks the role {role!r} of group {group!r}, which minds "
                    "may play"
                )


def _carry_values(made: MindArrays, state: State, breeds: list[tuple[Society, Society]]) -> None:
    """Fill the cognitons of all minds, breed by breed."""
    living = made.mind_id >= 0
    for before, after in breeds:
        rows = living
        if before.breed is not None:
            rows = living & (state["values"][:, -1] == before.breed)
        slots = np.flatnonzero(rows)
        made.values[slots] = after.arrays.start
        if len(after.arrays.chances):
            for slot in slots.tolist():
                kernel.draw_at_birth(after.arrays, made, slot, -1)
        for name, place in after.names.cognitons.items():
            if name in before.names.cognitons:
                column = before.names.cognitons[name]
                made.values[slots, place] = state["values"][slots, column]


def _carry_instances(made: MindArrays, state: State, groups: NDArray[np.int64]) -> None:
    """Fill the rows of instances; those that are more are taken after those that were free."""
    rows, more = len(state["instance_id"]), len(made.instance_id) - len(state["instance_id"])
    for name in BY_INSTANCE:
        array = getattr(made, name)
        if name in state and len(array):
            array[:rows] = state[name]
    made.instance_group[:rows] = groups[state["instance_group"]]
    free = int(state["counters"][kernel.FREE_INSTANCES])
    made.free_instances[:more] = np.arange(rows + more - 1, rows - 1, -1)
    made.free_instances[more : more + free] = state["free_instances"][:free]
    made.free_instances[more + free :] = 0
    made.counters[kernel.FREE_INSTANCES] = free + more
