"""A scheme and the minds of a society as arrays, the form that the kernel works on.

- `SchemeArrays`: what all minds share, read-only;
- `MindArrays`: what each mind and each group instance holds.

Sizes: C cognitons, P plans, G groups, R roles over all groups, K culturons over all groups,
B cognitons that chance decides on, N minds, M = max(1, N·G) group instances: room for each mind to
be alone in a group of every type.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
UnsignedInts = NDArray[np.uint64]

NEXT_MIND = 0
NEXT_GROUP = 1
FREE_MINDS = 2
FREE_INSTANCES = 3
ALIVE = 4
SEED_LOW = 5
SEED_HIGH = 6
STREAM = 7
"""Positions in `MindArrays.counters`."""


class SchemeArrays(NamedTuple):
    """A cognitive scheme as read-only arrays; link rows are the cognitons, then the culturons."""

    influence: Floats
    """(C+K, P) weight of the influence link, 0 where there is none."""
    conditional: Bools
    """(C+K, P) whether a conditional link leads to the plan."""
    reinforcement: Floats
    """(C+K, P) weight of the reinforcement link, 0 where there is none."""
    start: Floats
    """(C,) value at birth; NaN: inactive at birth."""
    culturon_start: Floats
    """(K,) value in a group just created."""
    role_group: Ints
    """(R,) the group that the role belongs to."""
    role_culturons: Bools
    """(R, K) whether the role holds the culturon."""
    group_culturons: Ints
    """(G, 2) first culturon of the group, and the one after its last."""
    group_within: Ints
    """(G, 2) the group that an instance may lie in an instance of, and the role there; -1: none.
    (0, 2) where no group lies in another."""
    link_begin: Ints
    """(P+1,) each plan's first link from a cogniton, and the end of the last plan's."""
    link_cogniton: UnsignedInts
    """(L,) the cogniton of each link, plan by plan; influence and conditional are one link here."""
    link_weight: Floats
    """(L,) weight of its influence, 0 where it is conditional only."""
    link_opens: Bools
    """(L,) whether it makes the plan available."""
    chances: Floats
    """(B, 4) the cognitons that chance decides on: which, how likely a mind has it at birth, how
    likely it is inherited, and the key of its name."""
    maker: Floats
    """(2,) code of the decision maker, and its bias."""


class MindArrays(NamedTuple):
    """The minds of a society and its group instances; the kernel writes them in place."""

    mind_id: Ints
    """(N,) identity of the mind in this slot; -1: the slot is free."""
    values: Floats
    """(N, C) value of each cogniton; NaN: inactive."""
    draws: Ints
    """(N,) decisions taken so far."""
    group_slot: Ints
    """(N, G) row of the group instance that the mind is in; -1: none."""
    role: Ints
    """(N, G) the role it plays there; -1: none."""
    participation: Floats
    """(N, G) its degree of participation there."""
    asked_id: Ints
    """(N, G) identity of the instance that the mind asks to join, which may be gone; -1: none."""
    asked_role: Ints
    """(N, G) the role that it asks for; -1: none."""
    instance_id: Ints
    """(M,) identity of the group instance; -1: the row is free."""
    instance_group: Ints
    """(M,) the group that it is an instance of; -1: the row is free."""
    members: Ints
    """(M,) number of its members; the instances that lie in it are members too."""
    culturons: Floats
    """(M, K) value of each culturon; only those of its own group count."""
    within: Ints
    """(M,) row of the instance that it lies in; -1: none. (0,) where no group lies in another."""
    free_minds: Ints
    """(N,) stack of free mind slots, the next one on top."""
    free_instances: Ints
    """(M,) stack of free instance rows, the next one on top."""
    instance_chains: Ints
    """(M, 2) rows by identity: the first row of each chain, and the row behind each in its own."""
    counters: Ints
    """(8,) next mind id, next group id, free minds, free instances, alive, seed (two), stream."""


INDEX = ("instance_chains",)
"""Those of `MindArrays` that are no state: they follow from the others."""
STATE = tuple(name for name in MindArrays._fields if name not in INDEX)
"""Those that are."""
ASKED = ("asked_id", "asked_role")
"""Those of them that a state may lack: it does where nobody asks for anything."""
