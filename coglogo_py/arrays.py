"""A scheme and the minds of a society as arrays, the form that the kernel works on.

- `SchemeArrays`: what all minds share, read-only; `scheme_arrays` makes it from a scheme.
- `MindArrays`: what each mind and each group instance holds; `mind_arrays` makes it empty, `grown`
  gives it more room.

Sizes: C cognitons, P plans, G groups, R roles over all groups, K culturons over all groups,
N minds, M = max(1, N·G) group instances: room for each mind to be alone in a group of every type.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from coglogo_py.decision import BiasedWeightedStochastic, MaximumWeight, WeightedStochastic
from coglogo_py.kernel import (
    BIASED_WEIGHTED_STOCHASTIC,
    FREE_INSTANCES,
    FREE_MINDS,
    MAXIMUM_WEIGHT,
    MODELLERS_OWN,
    SEED_HIGH,
    SEED_LOW,
    STREAM,
    WEIGHTED_STOCHASTIC,
)
from coglogo_py.streams import LOW_32

if TYPE_CHECKING:
    from coglogo_py.scheme import CognitiveScheme, Cogniton, Culturon, Group

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
UnsignedInts = NDArray[np.uint64]


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
    link_begin: Ints
    """(P+1,) each plan's first link from a cogniton, and the end of the last plan's."""
    link_cogniton: UnsignedInts
    """(L,) the cogniton of each link, plan by plan; influence and conditional are one link here."""
    link_weight: Floats
    """(L,) weight of its influence, 0 where it is conditional only."""
    link_opens: Bools
    """(L,) whether it makes the plan available."""
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
    instance_id: Ints
    """(M,) identity of the group instance; -1: the row is free."""
    instance_group: Ints
    """(M,) the group that it is an instance of; -1: the row is free."""
    members: Ints
    """(M,) number of its members."""
    culturons: Floats
    """(M, K) value of each culturon; only those of its own group count."""
    free_minds: Ints
    """(N,) stack of free mind slots, the next one on top."""
    free_instances: Ints
    """(M,) stack of free instance rows, the next one on top."""
    counters: Ints
    """(8,) next mind id, next group id, free minds, free instances, alive, seed (two), stream."""


def culturons_of(group: Group) -> tuple[Culturon, ...]:
    """Return the distinct culturons of a group, in the order in which its roles first name them."""
    by_name: dict[str, Culturon] = {}
    for role in group.roles:
        for culturon in role.culturons:
            by_name.setdefault(culturon.name, culturon)
    return tuple(by_name.values())


def scheme_arrays(scheme: CognitiveScheme) -> SchemeArrays:
    """Return the arrays of a scheme.

    Args:
        scheme: the description.

    Returns:
        Read-only arrays; plans, cognitons, groups, roles and culturons in the scheme's order.
    """
    plans = {name: position for position, name in enumerate(scheme.plans)}
    culturons = [culturon for group in scheme.groups for culturon in culturons_of(group)]
    holders: list[Cogniton | Culturon] = [*scheme.cognitons, *culturons]
    influence = np.zeros((len(holders), len(plans)))
    conditional = np.zeros((len(holders), len(plans)), np.bool_)
    reinforcement = np.zeros((len(holders), len(plans)))
    for row, holder in enumerate(holders):
        for plan, weight in holder.influence.items():
            influence[row, plans[plan]] = weight
        for plan in holder.conditional:
            conditional[row, plans[plan]] = True
        for plan, weight in holder.reinforcement.items():
            reinforcement[row, plans[plan]] = weight

    role_group = np.array(
        [position for position, group in enumerate(scheme.groups) for _ in group.roles], np.int64
    )
    role_culturons = np.zeros((len(role_group), len(culturons)), np.bool_)
    group_culturons = np.zeros((len(scheme.groups), 2), np.int64)
    first = role_row = 0
    for position, group in enumerate(scheme.groups):
        columns = {culturon.name: first + k for k, culturon in enumerate(culturons_of(group))}
        group_culturons[position] = first, first + len(columns)
        first += len(columns)
        for role in group.roles:
            for culturon in role.culturons:
                role_culturons[role_row, columns[culturon.name]] = True
            role_row += 1

    own = len(scheme.cognitons)
    linked = (influence[:own] != 0.0) | conditional[:own]
    # Of the transposed array the places come plan by plan, cognitons in the scheme's order.
    plan_of, cogniton_of = np.nonzero(linked.T)
    arrays = SchemeArrays(
        influence=influence,
        conditional=conditional,
        reinforcement=reinforcement,
        start=np.array(
            [c.start_value if c.starting else np.nan for c in scheme.cognitons], np.float64
        ),
        culturon_start=np.array([c.start_value for c in culturons], np.float64),
        role_group=role_group,
        role_culturons=role_culturons,
        group_culturons=group_culturons,
        link_begin=np.concatenate([[0], np.cumsum(linked.sum(axis=0))]).astype(np.int64),
        link_cogniton=cogniton_of.astype(np.uint64),
        link_weight=influence[cogniton_of, plan_of],
        link_opens=conditional[cogniton_of, plan_of],
        maker=maker_code(scheme),
    )
    for array in arrays:
        array.flags.writeable = False
    return arrays


def maker_code(scheme: CognitiveScheme) -> Floats:
    """Return the code of the scheme's decision maker, and its bias (1 where it has none)."""
    maker = scheme.decision_maker
    if type(maker) is BiasedWeightedStochastic:
        return np.array([BIASED_WEIGHTED_STOCHASTIC, maker.bias], np.float64)
    codes: dict[type, int] = {
        MaximumWeight: MAXIMUM_WEIGHT,
        WeightedStochastic: WEIGHTED_STOCHASTIC,
    }
    return np.array([codes.get(type(maker), MODELLERS_OWN), maker.bias], np.float64)


def mind_arrays(scheme: SchemeArrays, capacity: int, seed: int, stream: int = 0) -> MindArrays:
    """Return arrays for a society without minds.

    Args:
        scheme: the arrays of the scheme.
        capacity: number of minds there is room for, at least 1.
        seed: 0 … 2⁶⁴ − 1, the key of all draws.
        stream: 0 … 65535, to keep several societies of one model apart.

    Returns:
        Arrays with every slot free; slot 0 is the first to be taken.
    """
    groups = len(scheme.group_culturons)
    instances = max(1, capacity * groups)
    counters = np.zeros(8, np.int64)
    counters[FREE_MINDS] = capacity
    counters[FREE_INSTANCES] = instances
    counters[SEED_LOW] = seed & LOW_32
    counters[SEED_HIGH] = seed >> 32
    counters[STREAM] = stream
    return MindArrays(
        mind_id=np.full(capacity, -1, np.int64),
        values=np.full((capacity, len(scheme.start)), np.nan),
        draws=np.zeros(capacity, np.int64),
        group_slot=np.full((capacity, groups), -1, np.int64),
        role=np.full((capacity, groups), -1, np.int64),
        participation=np.zeros((capacity, groups)),
        instance_id=np.full(instances, -1, np.int64),
        instance_group=np.full(instances, -1, np.int64),
        members=np.zeros(instances, np.int64),
        culturons=np.zeros((instances, len(scheme.culturon_start))),
        free_minds=np.arange(capacity - 1, -1, -1, dtype=np.int64),
        free_instances=np.arange(instances - 1, -1, -1, dtype=np.int64),
        counters=counters,
    )


def grown(scheme: SchemeArrays, minds: MindArrays, capacity: int) -> MindArrays:
    """Return a copy of a society's arrays with room for more minds.

    The slots and rows added are taken only after those that were free before, so which slot a mind
    gets does not depend on when the arrays grew.

    Args:
        scheme: the arrays of the scheme.
        minds: the arrays to copy.
        capacity: number of minds there shall be room for, at least as many as now.
    """
    larger = mind_arrays(scheme, capacity, seed=0)
    for array, old in zip(larger, minds, strict=True):
        array[: len(old)] = old
    for stack, old, count in (
        (larger.free_minds, minds.free_minds, FREE_MINDS),
        (larger.free_instances, minds.free_instances, FREE_INSTANCES),
    ):
        free = int(minds.counters[count])
        added = len(stack) - len(old)
        stack[:added] = np.arange(len(stack) - 1, len(old) - 1, -1)
        stack[added : added + free] = old[:free]
        stack[added + free :] = 0
        larger.counters[count] = added + free
    return larger
