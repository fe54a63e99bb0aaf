"""Whether the arrays of a society hold indices of something, before the kernel trusts them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py import kernel
from coglogo_py.arrays import Ints, MindArrays
from coglogo_py.streams import LOW_32


def odd_stack(slots: NDArray[Any], capacity: int) -> bool:
    """Return whether slots are not different ones of so many.

    >>> odd_stack(np.array([2, 0]), 3), odd_stack(np.array([2, 2]), 3), odd_stack(np.array([3]), 3)
    (False, True, True)
    """
    if not len(slots):
        return False
    if slots.min() < 0 or slots.max() >= capacity:
        return True
    return bool(np.bincount(slots, minlength=capacity).max() > 1)


def oddity(minds: MindArrays, nesting: Ints, roles: int) -> str | None:
    """Return the name of the first array that no society can have, or None.

    Args:
        minds: arrays of the right types and shapes.
        nesting: the scheme's `group_within`.
        roles: how many its groups have together.
    """
    capacity, instances = len(minds.mind_id), len(minds.instance_id)
    counters = minds.counters
    vacant, unused = int(counters[kernel.FREE_MINDS]), int(counters[kernel.FREE_INSTANCES])
    key = counters[[kernel.SEED_LOW, kernel.SEED_HIGH]]
    if not (
        0 <= vacant <= capacity
        and 0 <= unused <= instances
        and counters[kernel.ALIVE] == capacity - vacant
        and counters.min() >= 0
        and key.max() <= LOW_32
    ):
        return "counters"
    free, idle = minds.free_minds[:vacant], minds.free_instances[:unused]
    taken, used = minds.mind_id >= 0, minds.instance_id >= 0
    if odd_stack(free, capacity) or taken[free].any() or taken.sum() != capacity - vacant:
        return "free_minds"
    if odd_stack(idle, instances) or used[idle].any() or used.sum() != instances - unused:
        return "free_instances"
    bounds = {
        "mind_id": int(counters[kernel.NEXT_MIND]),
        "group_slot": instances,
        "role": roles,
        "asked_id": int(counters[kernel.NEXT_GROUP]),
        "asked_role": roles,
        "instance_id": int(counters[kernel.NEXT_GROUP]),
        "within": instances,
        "instance_group": minds.group_slot.shape[1],
    }
    for name, end in bounds.items():
        array = getattr(minds, name)
        if array.size and not -1 <= array.min() <= array.max() < end:
            return name
    inner = np.flatnonzero(minds.within >= 0)
    around = nesting[minds.instance_group[inner], 0] if len(inner) else inner
    if (minds.instance_group[minds.within[inner]] != around).any() or (around < 0).any():
        return "within"
    if (minds.draws < 0).any():
        return "draws"
    return "members" if (minds.members < 0).any() else None
