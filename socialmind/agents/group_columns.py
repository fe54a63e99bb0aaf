"""Groups as a run records them: what each agent is in, and a table of the instances of groups."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from socialmind.agents.running import Running

PARTS = ("group_", "role_", "participation_")
"""What the names of the columns of memberships begin with; the group's type follows."""
OWN = ("populations", "group", "instance", "members")
"""The columns of the table of groups beside the tick, before those of culturons."""
WITHIN = "within"
"""That of the instance which one lies in, behind them in models whose schemes nest groups."""


def memberships(table: Any, taken: Mapping[str, Any]) -> dict[str, list[Any]]:
    """Return in which groups the living of a population are, in which role, and how much.

    Args:
        table: a population with minds.
        taken: names that fields have; a column of such a name begins with ``mind.``.

    Returns:
        For each type of group identity, role and participation, None outside; in order of birth.
    """
    society = table.society
    minds, slots = society.minds, table.columns["_mind"][table.slots]
    columns: dict[str, list[Any]] = {}
    for place, group in enumerate(society.names.groups):
        rows = minds.group_slot[slots, place]
        inside = rows >= 0
        identities = minds.instance_id[np.where(inside, rows, 0)]
        called = {at: role for role, at in society.names.roles[group].items()}
        roles = [called.get(at) for at in minds.role[slots, place].tolist()]
        shares = minds.participation[slots, place]
        for part, values in zip(PARTS, (identities, roles, shares), strict=True):
            name = f"{part}{group}"
            known = zip(np.asarray(values, object).tolist(), inside.tolist(), strict=True)
            columns[f"mind.{name}" if name in taken else name] = [
                value if member else None for value, member in known
            ]
    return columns


def has_groups(model: Any) -> bool:
    """Return whether the minds of a model can form groups."""
    tables = getattr(model, "tables", {}).values()
    return any(table.society is not None and table.society.names.groups for table in tables)


def group_instances(model: Running) -> dict[str, list[Any]]:
    """Return the instances of groups that live, as columns.

    Args:
        model: a running model whose minds can form groups.

    Returns:
        The populations that share them, the group's type, identity and number of members, and a
        column for each culturon and attribute with its value, None where the group has none of that
        name; in order of founding, those of one culture after those of another.
    """
    sharing: dict[int, list[str]] = {}
    for name, table in model.tables.items():
        if table.society is not None and table.society.names.groups:
            sharing.setdefault(id(table.society.minds), []).append(name)
    cultures = {", ".join(names): model.tables[names[0]].society for names in sharing.values()}
    numbers = [
        f"{part}_{name}"
        for society in cultures.values()
        for part, groups in _parts(society.names)
        for of in groups.values()
        for name in of
    ]
    nested = any(len(society.arrays.group_within) for society in cultures.values())
    own = (*OWN, WITHIN) if nested else OWN
    columns: dict[str, list[Any]] = {name: [] for name in dict.fromkeys((*own, *numbers))}
    for populations, society in cultures.items():
        minds, groups = society.minds, list(society.names.groups)
        rows = np.flatnonzero(minds.instance_id >= 0)
        rows = rows[np.argsort(minds.instance_id[rows])]
        types = minds.instance_group[rows]
        columns["populations"] += [populations] * len(rows)
        columns["group"] += [groups[place] for place in types.tolist()]
        columns["instance"] += minds.instance_id[rows].tolist()
        columns["members"] += minds.members[rows].tolist()
        if nested:
            columns[WITHIN] += _around(minds, rows)
        begin = len(columns["group"]) - len(rows)
        for name in dict.fromkeys(numbers):
            columns[name] += [None] * len(rows)
        for place, group in enumerate(groups):
            those = np.flatnonzero(types == place)
            for part, of in _parts(society.names):
                for name, at in of[group].items():
                    values = minds.culturons[rows[those], at].tolist()
                    for row, value in zip((begin + those).tolist(), values, strict=True):
                        columns[f"{part}_{name}"][row] = value
    return columns


def _around(minds: Any, rows: Any) -> list[int | None]:
    """Return the identities of the instances that others lie in, None for none."""
    around = minds.within[rows] if len(minds.within) else rows * 0 - 1
    found = minds.instance_id[around].tolist()
    return [one if row >= 0 else None for one, row in zip(found, around.tolist(), strict=True)]


def _parts(names: Any) -> tuple[tuple[str, Any], ...]:
    return ("culturon", names.culturons), ("attribute", names.attributes)
