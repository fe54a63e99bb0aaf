"""Laying out a scheme, and a society without minds yet, as the arrays that the kernel works on."""

from __future__ import annotations

import numpy as np

from coglogo_py.arrays import Floats, MindArrays, SchemeArrays
from coglogo_py.decision import BUILT_IN
from coglogo_py.kernel import (
    CODES,
    FREE_INSTANCES,
    FREE_MINDS,
    MODELLERS_OWN,
    SEED_HIGH,
    SEED_LOW,
    STREAM,
)
from coglogo_py.parts import Cogniton, Culturon, Group
from coglogo_py.scheme import CognitiveScheme
from coglogo_py.streams import LOW_32


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
    code = CODES[maker.name] if type(maker) in BUILT_IN else MODELLERS_OWN
    return np.array([code, maker.bias], np.float64)


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


def _kinds() -> dict[str, tuple[str, int]]:
    scheme = scheme_arrays(CognitiveScheme("empty"))
    arrays = scheme._asdict() | mind_arrays(scheme, 1, seed=0)._asdict()
    # NumPy 1 has no `np.bool`.
    kinds = {name: array.dtype.name.replace("bool", "bool_") for name, array in arrays.items()}
    return {name: (kind, arrays[name].ndim) for name, kind in kinds.items()}


ENGINE_ARRAYS = _kinds()
"""NumPy type and dimensions of each of `SchemeArrays` and `MindArrays`."""
