"""The types of groups that minds can be in: what the schemes that share them say, put together.

A scheme says which culturons of a role act on its own plans. That a group has a role, and a
culturon with a value, holds for all breeds that share the group: these are united. What differs
without harm differs (links, colours, which roles hold a culturon); a culturon has one value, so its
start must be the same wherever it is named.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from coglogo_py.border.errors import SchemeError
from coglogo_py.parts import Culturon, Group
from coglogo_py.scheme import CognitiveScheme


@dataclass(frozen=True)
class GroupType:
    """A type of group as all breeds of a culture see it.

    Args:
        name: the group's.
        roles: in the order in which the schemes first name them.
        culturons: their values in a group just created, in the same order.
    """

    name: str
    roles: list[str] = field(default_factory=list)
    culturons: dict[str, float] = field(default_factory=dict)


def culturons_of(group: Group) -> tuple[Culturon, ...]:
    """Return the distinct culturons of a group, in the order in which its roles first name them."""
    by_name: dict[str, Culturon] = {}
    for role in group.roles:
        for culturon in role.culturons:
            by_name.setdefault(culturon.name, culturon)
    return tuple(by_name.values())


def group_types(schemes: Iterable[CognitiveScheme]) -> tuple[GroupType, ...]:
    """Return the groups that some schemes name, those of the same name as one.

    Args:
        schemes: of the breeds that share them; often one alone.

    Raises:
        SchemeError: a culturon starts at different values in two of them.

    >>> from coglogo_py import Role
    >>> one = CognitiveScheme("cows", groups=(Group("herd", (Role("leader"),)),))
    >>> two = CognitiveScheme("bulls", groups=(Group("herd", (Role("guard"),)),))
    >>> group_types((one, two))
    (GroupType(name='herd', roles=['leader', 'guard'], culturons={}),)
    """
    found: dict[str, GroupType] = {}
    named_by: dict[tuple[str, str], str] = {}
    for scheme in schemes:
        for group in scheme.groups:
            kind = found.setdefault(group.name, GroupType(group.name))
            kind.roles.extend(one.name for one in group.roles if one.name not in kind.roles)
            for culturon in culturons_of(group):
                start = kind.culturons.setdefault(culturon.name, culturon.start_value)
                first = named_by.setdefault((group.name, culturon.name), scheme.name)
                if start != culturon.start_value:
                    raise SchemeError(
                        f"culturon {culturon.name!r} of group {group.name!r} starts at "
                        f"{culturon.start_value:g} in scheme {scheme.name!r}",
                        f"{start:g}, as in scheme {first!r}, which shares the group",
                        "a culturon has one value: write the same start in both",
                    )
    return tuple(found.values())
