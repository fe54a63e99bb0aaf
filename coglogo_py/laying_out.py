"""Laying out a scheme, and a society without minds yet, as the arrays that the kernel works on."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

from coglogo_py import kernel
from coglogo_py.arrays import Floats, Ints, MindArrays, SchemeArrays
from coglogo_py.border.errors import SchemeError
from coglogo_py.decision import BUILT_IN
from coglogo_py.parts import Cogniton, Culturon, Group, Scheme, check_nesting
from coglogo_py.scheme import CognitiveScheme
from coglogo_py.streams import LOW_32


@dataclass(frozen=True)
class GroupType:
    """A type of group as all breeds of a culture see it.

    A scheme says which culturons of a role act on its own plans. That a group has a role, and a
    culturon with a value, holds for all breeds that share it: these are united. Links, colours and
    which roles hold a culturon differ without harm; a value has one start wherever it is named.

    Args:
        name: the group's.
        roles: in the order in which the schemes first name them.
        culturons: their values in a group just created, in the same order.
        attributes: likewise.
        within: the type and the role that its instances may lie in.
    """

    name: str
    roles: list[str] = field(default_factory=list)
    culturons: dict[str, float] = field(default_factory=dict)
    attributes: dict[str, float] = field(default_factory=dict)
    within: tuple[str, str] | None = field(default=None, repr=False)


def culturons_of(group: Group) -> tuple[Culturon, ...]:
    """Return the distinct culturons of a group, in the order in which its roles first name them."""
    by_name: dict[str, Culturon] = {}
    for role in group.roles:
        for culturon in role.culturons:
            by_name.setdefault(culturon.name, culturon)
    return tuple(by_name.values())


def group_types(schemes: Iterable[Scheme]) -> tuple[GroupType, ...]:
    """Return the groups that some schemes name, those of the same name as one.

    Args:
        schemes: of the breeds that share them; often one alone.

    Raises:
        SchemeError: a culturon or an attribute starts at different values in two of them, or a
            group lies within different ones.

    >>> from coglogo_py import Role
    >>> one = CognitiveScheme("cows", groups=(Group("herd", (Role("leader"),)),))
    >>> two = CognitiveScheme("bulls", groups=(Group("herd", (Role("guard"),)),))
    >>> group_types((one, two))
    (GroupType(name='herd', roles=['leader', 'guard'], culturons={}, attributes={}),)
    """
    found: dict[str, GroupType] = {}
    named_by: dict[tuple[str, str, str], str] = {}
    for scheme in schemes:
        for group in scheme.groups:
            kind = found.setdefault(group.name, GroupType(group.name))
            if group.within is not None:
                kind = found[group.name] = _nested(kind, group.within, scheme.name)
            kind.roles.extend(one.name for one in group.roles if one.name not in kind.roles)
            named = [("culturon", one.name, one.start_value) for one in culturons_of(group)]
            named += [("attribute", name, start) for name, start in group.attributes]
            for part, name, start in named:
                known = kind.culturons if part == "culturon" else kind.attributes
                first = named_by.setdefault((part, group.name, name), scheme.name)
                if known.setdefault(name, start) != start:
                    raise SchemeError(
                        f"{part} {name!r} of group {group.name!r} starts at {start:g} in scheme "
                        f"{scheme.name!r}",
                        f"{known[name]:g}, as in scheme {first!r}, which shares the group",
                        "it has one value for all: write the same start in both",
                    )
    check_nesting({name: (kind.roles, kind.within) for name, kind in found.items()})
    return tuple(found.values())


def _nested(kind: GroupType, within: tuple[str, str], scheme: str) -> GroupType:
    if kind.within not in (None, within):
        raise SchemeError(
            f"group {kind.name!r} within {' as '.join(within)} in scheme {scheme!r}",
            f"{' as '.join(kind.within or ())}, as in another scheme that shares the group",
            "write the same in both",
        )
    return replace(kind, within=within)


Within = tuple[tuple[GroupType, ...], int, int]
"""The types of groups of a culture, the most cognitons of a breed, and which breed this is."""


def scheme_arrays(scheme: CognitiveScheme, within: Within | None = None) -> SchemeArrays:
    """Return the arrays of a scheme.

    Args:
        scheme: the description.
        within: the culture that its breed shares with others, and the breed's number there.

    Returns:
        Read-only arrays; plans, cognitons, groups, roles and culturons in the scheme's order. In a
        culture groups, roles and culturons come in its order, and behind the cognitons stand as
        many without links as the breed with most of them has more, then the breed's own number.
    """
    types, own, breed = within or (group_types((scheme,)), len(scheme.cognitons), None)
    n_cognitons = own if breed is None else own + 1
    plans = {name: position for position, name in enumerate(scheme.plans)}
    described = {group.name: group for group in scheme.groups}
    rows: list[tuple[int, Cogniton | Culturon]] = list(enumerate(scheme.cognitons))
    starts: list[float] = []
    role_group: list[int] = []
    group_culturons = np.zeros((len(types), 2), np.int64)
    held: list[tuple[int, int]] = []
    for position, kind in enumerate(types):
        first, first_role = len(starts), len(role_group)
        columns = {name: first + k for k, name in enumerate(kind.culturons)}
        # Attributes are columns that no role holds and no link leads from.
        starts += (*kind.culturons.values(), *kind.attributes.values())
        role_group += [position] * len(kind.roles)
        group_culturons[position] = first, len(starts)
        if kind.name in described:
            group = described[kind.name]
            rows += [(n_cognitons + columns[one.name], one) for one in culturons_of(group)]
            held += [
                (first_role + kind.roles.index(role.name), columns[one.name])
                for role in group.roles
                for one in role.culturons
            ]
    role_culturons = np.zeros((len(role_group), len(starts)), np.bool_)
    for place in held:
        role_culturons[place] = True
    size = n_cognitons + len(starts), len(plans)
    influence, reinforcement = np.zeros(size), np.zeros(size)
    conditional = np.zeros(size, np.bool_)
    for row, holder in rows:
        for plan, weight in holder.influence.items():
            influence[row, plans[plan]] = weight
        for plan in holder.conditional:
            conditional[row, plans[plan]] = True
        for plan, weight in holder.reinforcement.items():
            reinforcement[row, plans[plan]] = weight
    start = np.full(n_cognitons, np.nan)
    start[: len(scheme.cognitons)] = [
        one.start_value if one.starting else np.nan for one in scheme.cognitons
    ]
    if breed is not None:
        start[own] = breed

    linked = (influence[:n_cognitons] != 0.0) | conditional[:n_cognitons]
    # Of the transposed array the places come plan by plan, cognitons in the scheme's order.
    plan_of, cogniton_of = np.nonzero(linked.T)
    arrays = SchemeArrays(
        influence=influence,
        conditional=conditional,
        reinforcement=reinforcement,
        start=start,
        culturon_start=np.array(starts, np.float64),
        role_group=np.array(role_group, np.int64),
        role_culturons=role_culturons,
        group_culturons=group_culturons,
        group_within=_group_within(types),
        link_begin=np.concatenate([[0], np.cumsum(linked.sum(axis=0))]).astype(np.int64),
        link_cogniton=cogniton_of.astype(np.uint64),
        link_weight=influence[cogniton_of, plan_of],
        link_opens=conditional[cogniton_of, plan_of],
        chances=_chances(scheme),
        maker=maker_code(scheme),
    )
    for array in arrays:
        array.flags.writeable = False
    return arrays


def _chances(scheme: CognitiveScheme) -> Floats:
    """Return the cognitons that chance decides on at birth; names are keys, wherever they stand."""
    rows = [
        (place, one.chance, one.inherited, zlib.crc32(one.name.encode()))
        for place, one in enumerate(scheme.cognitons)
        if one.chance < 1.0 or one.inherited < 1.0
    ]
    return np.array(rows, np.float64).reshape(len(rows), 4)


def _group_within(types: tuple[GroupType, ...]) -> Ints:
    """Return what `SchemeArrays.group_within` holds."""
    if all(kind.within is None for kind in types):
        return np.zeros((0, 2), np.int64)
    places = {kind.name: place for place, kind in enumerate(types)}
    first_role = np.cumsum([0, *(len(kind.roles) for kind in types)])
    found = np.full((len(types), 2), -1, np.int64)
    for place, kind in enumerate(types):
        if kind.within is not None:
            around = places[kind.within[0]]
            role = first_role[around] + types[around].roles.index(kind.within[1])
            found[place] = around, role
    return found


def maker_code(scheme: CognitiveScheme) -> Floats:
    """Return the code of the scheme's decision maker, and its bias (1 where it has none)."""
    maker = scheme.decision_maker
    code = kernel.CODES[maker.name] if type(maker) in BUILT_IN else kernel.MODELLERS_OWN
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
    counters[kernel.FREE_MINDS] = capacity
    counters[kernel.FREE_INSTANCES] = instances
    counters[kernel.SEED_LOW] = seed & LOW_32
    counters[kernel.SEED_HIGH] = seed >> 32
    counters[kernel.STREAM] = stream
    return MindArrays(
        mind_id=np.full(capacity, -1, np.int64),
        values=np.full((capacity, len(scheme.start)), np.nan),
        draws=np.zeros(capacity, np.int64),
        group_slot=np.full((capacity, groups), -1, np.int64),
        role=np.full((capacity, groups), -1, np.int64),
        participation=np.zeros((capacity, groups)),
        asked_id=np.full((capacity, groups), -1, np.int64),
        asked_role=np.full((capacity, groups), -1, np.int64),
        instance_id=np.full(instances, -1, np.int64),
        instance_group=np.full(instances, -1, np.int64),
        members=np.zeros(instances, np.int64),
        culturons=np.zeros((instances, len(scheme.culturon_start))),
        within=np.full(instances if len(scheme.group_within) else 0, -1, np.int64),
        free_minds=np.arange(capacity - 1, -1, -1, dtype=np.int64),
        free_instances=np.arange(instances - 1, -1, -1, dtype=np.int64),
        instance_chains=np.full((instances, 2), -1, np.int64),
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
        (larger.free_minds, minds.free_minds, kernel.FREE_MINDS),
        (larger.free_instances, minds.free_instances, kernel.FREE_INSTANCES),
    ):
        free = int(minds.counters[count])
        added = len(stack) - len(old)
        stack[:added] = np.arange(len(stack) - 1, len(old) - 1, -1)
        stack[added : added + free] = old[:free]
        stack[added + free :] = 0
        larger.counters[count] = added + free
    kernel.index_instances(larger)
    return larger


def _kinds() -> dict[str, tuple[str, int]]:
    scheme = scheme_arrays(CognitiveScheme("empty"))
    arrays = scheme._asdict() | mind_arrays(scheme, 1, seed=0)._asdict()
    # NumPy 1 has no `np.bool`.
    kinds = {name: array.dtype.name.replace("bool", "bool_") for name, array in arrays.items()}
    return {name: (kind, arrays[name].ndim) for name, kind in kinds.items()}


ENGINE_ARRAYS = _kinds()
"""NumPy type and dimensions of each of `SchemeArrays` and `MindArrays`."""
