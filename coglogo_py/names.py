"""Where the names of a scheme stand in its arrays; the errors about a name that is not there."""

from __future__ import annotations

from collections.abc import Mapping

from coglogo_py.arrays import SchemeArrays
from coglogo_py.border.errors import MindError, nearest
from coglogo_py.laying_out import GroupType, group_types, scheme_arrays
from coglogo_py.parts import settle
from coglogo_py.scheme import CognitiveScheme


class Names:
    """The positions of a scheme's cognitons, plans, groups, roles and culturons, by name.

    Roles and culturons are counted over all groups, as in `SchemeArrays`.

    Args:
        scheme: the description.
        types: the groups of the culture that the scheme's breed shares; its own by default.

    >>> from coglogo_py import Cogniton
    >>> names = Names(CognitiveScheme("herd", (Cogniton("Hunger", influence={"eat": 1.0}),)))
    >>> names.cogniton("Hunger")
    0
    >>> names.plan("Eat")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    coglogo_py.border.errors.MindError: no plan 'Eat' in scheme 'herd'; did you mean 'eat'? ...
    """

    def __init__(self, scheme: CognitiveScheme, types: tuple[GroupType, ...] | None = None) -> None:
        types = group_types((scheme,)) if types is None else types
        self.scheme_name = scheme.name
        self.cognitons = {c.name: position for position, c in enumerate(scheme.cognitons)}
        self.plans = {plan: position for position, plan in enumerate(scheme.plans)}
        self.groups = {kind.name: position for position, kind in enumerate(types)}
        self.roles: dict[str, dict[str, int]] = {}
        self.culturons: dict[str, dict[str, int]] = {}
        self.attributes: dict[str, dict[str, int]] = {}
        roles = culturons = 0
        for kind in types:
            self.roles[kind.name] = {name: roles + k for k, name in enumerate(kind.roles)}
            roles += len(kind.roles)
            self.culturons[kind.name] = {n: culturons + k for k, n in enumerate(kind.culturons)}
            culturons += len(kind.culturons)
            self.attributes[kind.name] = {n: culturons + k for k, n in enumerate(kind.attributes)}
            culturons += len(kind.attributes)

    def cogniton(self, name: str) -> int:
        """Return the position of a cogniton; MindError when there is none of that name."""
        return self._position("cogniton", name, self.cognitons, f"scheme {self.scheme_name!r}")

    def plan(self, name: str) -> int:
        """Return the position of a plan; MindError when there is none of that name."""
        return self._position("plan", name, self.plans, f"scheme {self.scheme_name!r}")

    def group(self, name: str) -> int:
        """Return the position of a group; MindError when there is none of that name."""
        return self._position("group", name, self.groups, f"scheme {self.scheme_name!r}")

    def role(self, group: str, name: str) -> tuple[int, int]:
        """Return the positions of a group and of one of its roles."""
        position = self.group(group)
        return position, self._position("role", name, self.roles[group], f"group {group!r}")

    def culturon(self, group: str, name: str) -> tuple[int, int]:
        """Return the positions of a group and of a culturon of any of its roles."""
        position = self.group(group)
        return position, self._position("culturon", name, self.culturons[group], f"group {group!r}")

    def attribute(self, group: str, name: str) -> tuple[int, int]:
        """Return the positions of a group and of one of its attributes, among the culturons."""
        position = self.group(group)
        known = self.attributes[group]
        return position, self._position("attribute", name, known, f"group {group!r}")

    @staticmethod
    def _position(kind: str, name: object, known: Mapping[str, int], where: str) -> int:
        if isinstance(name, str) and name in known:
            return known[name]
        advice = nearest(name, known) if isinstance(name, str) else "names are strings"
        there = f"there are: {', '.join(known)}" if known else f"there are no {kind}s"
        raise MindError(f"no {kind} {name!r} in {where}; {f'{advice} ' if advice else ''}{there}")


def laid_out(scheme: CognitiveScheme) -> tuple[Names, SchemeArrays]:
    """Return the names and the arrays of a scheme, made once and shared by its societies."""
    known: tuple[Names, SchemeArrays] | None = vars(scheme).get("_laid_out")
    if known is None:
        known = Names(scheme), scheme_arrays(scheme)
        settle(scheme, "_laid_out", known)
    return known
