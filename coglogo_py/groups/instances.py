"""Instances of groups: found by identity, founded, joined, left; what they hold.

Operations of the kernel, which says what their arguments are.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from coglogo_py.arrays import FREE_INSTANCES, NEXT_GROUP
from coglogo_py.compiled.borrow import borrowed
from coglogo_py.compiled.machine_code import kept, key_of_file
from coglogo_py.streams import LOW_32

if TYPE_CHECKING:
    from coglogo_py.arrays import MindArrays, SchemeArrays

FIRST, NEXT = 0, 1
"""Columns of `MindArrays.instance_chains`: the first row of a chain; the row behind one in its."""

_KEY = key_of_file("coglogo_groups", __file__)
_operation = kept(_KEY, no_cfunc_wrapper=True)
_inlined = kept(_KEY, no_cfunc_wrapper=True, forceinline=True)
_inner = kept(_KEY, no_cfunc_wrapper=True, no_cpython_wrapper=True, forceinline=True)

# --------------------------------------------------------------------------- by identity


@_inner
def _chain(minds: MindArrays, identity: int) -> int:
    """Return the chain that an identity is in: scattered, so that chains are short."""
    scattered = (identity & 0x7FFFFFFF) * 2654435769 & LOW_32
    return (scattered * minds.instance_chains.shape[0]) >> 32


@_inner
def _into_chain(minds: MindArrays, row: int) -> None:
    """Put a row into the chain of its identity."""
    chain = _chain(minds, minds.instance_id[row])
    minds.instance_chains[row, NEXT] = minds.instance_chains[chain, FIRST]
    minds.instance_chains[chain, FIRST] = row


@_inner
def _out_of_chain(minds: MindArrays, row: int) -> None:
    """Take a row out of the chain of its identity."""
    chains = minds.instance_chains
    chain = _chain(minds, minds.instance_id[row])
    behind = chains[row, NEXT]
    one = chains[chain, FIRST]
    if one == row:
        chains[chain, FIRST] = behind
        return
    while chains[one, NEXT] != row:
        one = chains[one, NEXT]
    chains[one, NEXT] = behind


@_operation
def index_instances(minds: MindArrays) -> None:
    """Make the chains anew, which tell the row of an identity."""
    minds = borrowed(minds)
    for row in range(minds.instance_chains.shape[0]):
        minds.instance_chains[row, FIRST] = -1
    for row in range(minds.instance_chains.shape[0]):
        if minds.instance_id[row] >= 0:
            _into_chain(minds, row)


@_operation
def find_group(minds: MindArrays, group: int, identity: int) -> int:
    """Return the row of the living instance of a group with this identity, or -1."""
    minds = borrowed(minds)
    rows = minds.instance_id.shape[0]
    if identity < 0 or identity >= minds.counters[NEXT_GROUP]:
        return -1
    # Until a first group dissolves, identities and rows are the same.
    if identity < rows and minds.instance_id[identity] == identity:
        return identity if minds.instance_group[identity] == group else -1
    row = minds.instance_chains[_chain(minds, identity), FIRST]
    while row >= 0 and minds.instance_id[row] != identity:
        row = minds.instance_chains[row, NEXT]
    return row if row >= 0 and minds.instance_group[row] == group else -1


# --------------------------------------------------------------------------- groups in groups


@_inlined
def standing(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int
) -> tuple[int, int, int]:
    """Return where a mind stands in a type of group: the instance's row, the role, and by what.

    That is the type itself, where the mind is a member; else the first of its own groups, in the
    scheme's order, that lies in such an instance, at once or further out, without passing a type
    that the mind is itself in a group of. The row is -1 where it stands nowhere.
    """
    row = minds.group_slot[slot, group]
    role = minds.role[slot, group]
    if row >= 0 or scheme.group_within.shape[0] == 0:
        return row, role, group
    for own in range(minds.group_slot.shape[1]):
        row = minds.group_slot[slot, own]
        at = own
        while row >= 0 and at != group:
            role = scheme.group_within[at, 1]
            at = scheme.group_within[at, 0]
            row = minds.within[row]
            if row >= 0 and at != group and minds.group_slot[slot, at] >= 0:
                row = -1
        if row >= 0:
            return row, role, own
    return -1, -1, group


@_inner
def _lay(minds: MindArrays, row: int, around: int) -> None:
    """Let an instance lie in another, as a member of it."""
    minds.within[row] = around
    minds.members[around] += 1


@_inner
def _lose_member(minds: MindArrays, row: int) -> None:
    """Let an instance have a member less; without any it ends, and what it lies in loses it."""
    counters = minds.counters
    while row >= 0:
        minds.members[row] -= 1
        if minds.members[row] > 0:
            return
        _out_of_chain(minds, row)
        minds.instance_id[row] = -1
        minds.instance_group[row] = -1
        for culturon in range(minds.culturons.shape[1]):
            minds.culturons[row, culturon] = 0.0
        minds.free_instances[counters[FREE_INSTANCES]] = row
        counters[FREE_INSTANCES] += 1
        around = -1
        if minds.within.shape[0] > 0:
            around = minds.within[row]
            minds.within[row] = -1
        row = around


@_operation
def enclose_group(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, identity: int
) -> bool:
    """Let the instance that the mind is in lie in the one with this identity.

    False, and nothing changes, when the mind is in none, or its instance lies in one already.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    if scheme.group_within.shape[0] == 0 or scheme.group_within[group, 0] < 0:
        raise ValueError("enclose_group: groups of this type lie in no others")
    around = find_group(minds, scheme.group_within[group, 0], identity)
    if around < 0:
        raise ValueError("enclose_group: no living group of the type around it has this id")
    row = minds.group_slot[slot, group]
    if row < 0 or minds.within[row] >= 0:
        return False
    _lay(minds, row, around)
    return True


@_operation
def release_group(minds: MindArrays, slot: int, group: int) -> None:
    """Let the instance that the mind is in lie in no other any more."""
    minds = borrowed(minds)
    row = minds.group_slot[slot, group]
    if row >= 0 and minds.within.shape[0] > 0 and minds.within[row] >= 0:
        around = minds.within[row]
        minds.within[row] = -1
        _lose_member(minds, around)


@_operation
def get_enclosing_group_id(minds: MindArrays, slot: int, group: int) -> int:
    """Return the identity of the instance that the mind's instance lies in, or -1."""
    minds = borrowed(minds)
    row = minds.group_slot[slot, group]
    if row < 0 or minds.within.shape[0] == 0 or minds.within[row] < 0:
        return -1
    return minds.instance_id[minds.within[row]]


# --------------------------------------------------------------------------- membership


@_inner
def enter(minds: MindArrays, slot: int, group: int, role: int, row: int) -> None:
    """Make a mind a member of the instance in `row`, taking part in full."""
    minds = borrowed(minds)
    minds.group_slot[slot, group] = row
    minds.role[slot, group] = role
    minds.participation[slot, group] = 1.0
    minds.members[row] += 1
    _forget_request(minds, slot, group)


@_operation
def create_and_join_group(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, role: int
) -> bool:
    """Create an instance of a group and join it; False when already in a group of this type."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if scheme.role_group[role] != group:
        raise ValueError("create_and_join_group: the role is of another group")
    if minds.group_slot[slot, group] >= 0:
        return False
    counters = minds.counters
    counters[FREE_INSTANCES] -= 1
    row = minds.free_instances[counters[FREE_INSTANCES]]
    minds.instance_id[row] = counters[NEXT_GROUP]
    counters[NEXT_GROUP] += 1
    _into_chain(minds, row)
    minds.instance_group[row] = group
    for culturon in range(scheme.group_culturons[group, 0], scheme.group_culturons[group, 1]):
        minds.culturons[row, culturon] = scheme.culturon_start[culturon]
    if scheme.group_within.shape[0] > 0 and scheme.group_within[group, 0] >= 0:
        around = standing(scheme, minds, slot, scheme.group_within[group, 0])[0]
        if around >= 0:
            _lay(minds, row, around)
    enter(minds, slot, group, role, row)
    return True


@_operation
def join_group(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, role: int, identity: int
) -> bool:
    """Join the instance with this identity; False when already in a group of this type."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if scheme.role_group[role] != group:
        raise ValueError("join_group: the role is of another group")
    row = find_group(minds, group, identity)
    if row < 0:
        raise ValueError("join_group: no living group of this type has this id")
    if minds.group_slot[slot, group] >= 0:
        return False
    enter(minds, slot, group, role, row)
    return True


@_operation
def change_role(scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, role: int) -> bool:
    """Play another role in the instance that the mind is in; False outside the group."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if scheme.role_group[role] != group:
        raise ValueError("change_role: the role is of another group")
    if minds.group_slot[slot, group] < 0:
        return False
    minds.role[slot, group] = role
    return True


@_operation
def set_participation(minds: MindArrays, slot: int, group: int, value: float) -> None:
    """Set the degree of participation; without effect outside the group."""
    minds = borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("set_participation: the value must be a finite number")
    if minds.group_slot[slot, group] >= 0:
        minds.participation[slot, group] = value


@_operation
def add_to_participation(minds: MindArrays, slot: int, group: int, value: float) -> None:
    """Add to the degree of participation; without effect outside the group."""
    minds = borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("add_to_participation: the value must be a finite number")
    if minds.group_slot[slot, group] >= 0:
        result = minds.participation[slot, group] + value
        if not math.isfinite(result):
            raise ValueError("add_to_participation: the sum is beyond the largest number")
        minds.participation[slot, group] = result


@_operation
def get_participation(minds: MindArrays, slot: int, group: int) -> float:
    """Return the degree of participation, 0.0 outside the group."""
    minds = borrowed(minds)
    return minds.participation[slot, group]


@_operation
def get_group_id(minds: MindArrays, slot: int, group: int) -> int:
    """Return the identity of the instance that the mind is in, -1 when in none of this type."""
    minds = borrowed(minds)
    row = minds.group_slot[slot, group]
    return minds.instance_id[row] if row >= 0 else -1


@_operation
def get_group_role_id(minds: MindArrays, slot: int, group: int, role: int) -> int:
    """Return the identity of the instance in which the mind plays this very role, or -1."""
    minds = borrowed(minds)
    return get_group_id(minds, slot, group) if minds.role[slot, group] == role else -1


@_operation
def leave_group(minds: MindArrays, slot: int, group: int) -> None:
    """Leave the group; an instance without members dissolves. Without effect outside it."""
    minds = borrowed(minds)
    row = minds.group_slot[slot, group]
    if row < 0:
        return
    minds.group_slot[slot, group] = -1
    minds.role[slot, group] = -1
    minds.participation[slot, group] = 0.0
    _lose_member(minds, row)


@_operation
def leave_all_groups(minds: MindArrays, slot: int) -> None:
    """Leave every group that the mind is in."""
    minds = borrowed(minds)
    for group in range(minds.group_slot.shape[1]):
        leave_group(minds, slot, group)


# --------------------------------------------------------------------------- asking for entry


@_inner
def _forget_request(minds: MindArrays, slot: int, group: int) -> None:
    """Let a mind ask for no instance of a group any more."""
    minds.asked_id[slot, group] = -1
    minds.asked_role[slot, group] = -1


@_inner
def forget_requests(minds: MindArrays, slot: int) -> None:
    """Let a mind ask for nothing any more."""
    for group in range(minds.asked_id.shape[1]):
        _forget_request(minds, slot, group)


@_operation
def ask_to_join(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, role: int, identity: int
) -> bool:
    """Ask to join the instance with this identity, instead of what was asked for before.

    False, and nothing changes, when no such instance lives or the mind is in a group of this type.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    if scheme.role_group[role] != group:
        raise ValueError("ask_to_join: the role is of another group")
    if minds.group_slot[slot, group] >= 0 or find_group(minds, group, identity) < 0:
        return False
    minds.asked_id[slot, group] = identity
    minds.asked_role[slot, group] = role
    return True


@_inner
def asked_row(minds: MindArrays, slot: int, group: int) -> int:
    """Return the row of the living instance that a mind asks to join, or -1."""
    return find_group(minds, group, minds.asked_id[slot, group])


@_operation
def get_asked_group_id(minds: MindArrays, slot: int, group: int) -> int:
    """Return the identity of the instance that the mind asks to join, -1 for none that lives."""
    minds = borrowed(minds)
    return minds.asked_id[slot, group] if asked_row(minds, slot, group) >= 0 else -1


@_inner
def _asks_into_mine(minds: MindArrays, slot: int, group: int, other: int) -> bool:
    """Return whether another mind asks to join the instance that this one is in."""
    row = minds.group_slot[slot, group]
    return row >= 0 and minds.asked_id[other, group] == minds.instance_id[row]


@_operation
def grant_entry(minds: MindArrays, slot: int, group: int, other: int) -> bool:
    """Let another mind join the instance that this one is in, in the role that it asks for.

    False, and nothing changes, when it does not ask for that very instance.
    """
    minds = borrowed(minds)
    if not _asks_into_mine(minds, slot, group, other):
        return False
    role = minds.asked_role[other, group]
    enter(minds, other, group, role, minds.group_slot[slot, group])
    return True


@_operation
def refuse_entry(minds: MindArrays, slot: int, group: int, other: int) -> bool:
    """End another mind's request to join the instance that this one is in; False without one."""
    minds = borrowed(minds)
    if not _asks_into_mine(minds, slot, group, other):
        return False
    _forget_request(minds, other, group)
    return True


@_operation
def expel(minds: MindArrays, slot: int, group: int, other: int) -> bool:
    """Let another mind leave the instance that both are in; False when it is not in it."""
    minds = borrowed(minds)
    row = minds.group_slot[slot, group]
    if row < 0 or minds.group_slot[other, group] != row:
        return False
    leave_group(minds, other, group)
    return True


# --------------------------------------------------------------------------- what they hold


@_operation
def set_culturon_value(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, culturon: int, value: float
) -> None:
    """Set a culturon of the instance that the mind stands in, for all its members."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("set_culturon_value: the value must be a finite number")
    row = standing(scheme, minds, slot, group)[0]
    if row >= 0:
        minds.culturons[row, culturon] = value


@_operation
def add_to_culturon_value(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, culturon: int, value: float
) -> None:
    """Add to a culturon of the instance that the mind stands in, for all its members."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("add_to_culturon_value: the value must be a finite number")
    row = standing(scheme, minds, slot, group)[0]
    if row >= 0:
        result = minds.culturons[row, culturon] + value
        if not math.isfinite(result):
            raise ValueError("add_to_culturon_value: the sum is beyond the largest number")
        minds.culturons[row, culturon] = result


@_operation
def get_culturon_value(
    scheme: SchemeArrays, minds: MindArrays, slot: int, group: int, culturon: int
) -> float:
    """Return a culturon's value in the instance that the mind stands in, 0.0 outside the group."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    row = standing(scheme, minds, slot, group)[0]
    return minds.culturons[row, culturon] if row >= 0 else 0.0


# Attributes are culturons that no role holds: they stand in the same array.
set_group_attribute = set_culturon_value
add_to_group_attribute = add_to_culturon_value
get_group_attribute = get_culturon_value
