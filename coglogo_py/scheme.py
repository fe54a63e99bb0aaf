"""Cognitive schemes: what the minds of a breed have in common, as immutable descriptions.

A scheme names cognitons, groups with their roles and culturons, and a decision maker. Plans have no
description of their own: they are the names that links lead to (thesis, section 3.2).

- influence link: value × weight is added to the plan's weight;
- conditional link: an active cogniton, or a culturon of one's role, makes the plan available;
- reinforcement link: feed-back from the plan changes the value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeVar

from coglogo_py.decision import DecisionMaker, MaximumWeight
from coglogo_py.errors import SchemeError, shown
from coglogo_py.files.checks import (
    checked_colour,
    checked_name,
    checked_names,
    checked_number,
    checked_position,
    checked_weights,
)
from coglogo_py.files.reading import text_in
from coglogo_py.numbers import is_truth

if TYPE_CHECKING:
    from coglogo_py.lint import Finding

GREY = (128, 128, 128)

Described = TypeVar("Described")


@dataclass(frozen=True)
class Cogniton:
    """A drive, belief, skill or trait: a value of one mind that pushes plans up and down.

    Args:
        name: unique in the scheme.
        starting: whether a mind has it at birth; else it is inactive until activated.
        start_value: the value at birth; a cogniton activated later begins at 0.
        colour: red, green, blue, each 0 … 255; for drawings.
        position: x and y in the drawing of the scheme, or None.
        influence: plan → weight of the influence link.
        conditional: the plans that it makes available while active.
        reinforcement: plan → weight of the reinforcement link.

    Raises:
        SchemeError: a field holds something else.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> hunger.influence["eat"]
    2.0
    """

    name: str
    starting: bool = True
    start_value: float = 0.0
    colour: tuple[int, int, int] = GREY
    position: tuple[int, int] | None = None
    influence: Mapping[str, float] = field(default_factory=dict)
    conditional: tuple[str, ...] = ()
    reinforcement: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        where = f"cogniton {self.name!r}"
        if not is_truth(self.starting):
            raise SchemeError(f"starting {shown(self.starting)} of {where}", "True or False")
        _set(self, "starting", bool(self.starting))
        _check_links(self, where)

    def __hash__(self) -> int:
        return hash(self.name)

    def __reduce__(self) -> tuple[type[Cogniton], tuple[object, ...]]:
        return type(self), _plain_fields(self)


@dataclass(frozen=True)
class Culturon:
    """A norm or shared belief: a value of a group, which pushes the plans of a role's members.

    Args:
        name: unique in its role. Named by several roles of one group, it is one culturon.
        start_value: the value when a group is created.
        colour: red, green, blue, each 0 … 255; for drawings.
        position: x and y in the drawing of the scheme, or None.
        influence: plan → weight of the influence link, times participation and value.
        conditional: the plans that it makes available to those who play the role.
        reinforcement: plan → weight of the reinforcement link.

    Raises:
        SchemeError: a field holds something else.

    >>> Culturon("Peace", start_value=1, influence={"trade": 0.5}).start_value
    1.0
    """

    name: str
    start_value: float = 0.0
    colour: tuple[int, int, int] = GREY
    position: tuple[int, int] | None = None
    influence: Mapping[str, float] = field(default_factory=dict)
    conditional: tuple[str, ...] = ()
    reinforcement: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        _check_links(self, f"culturon {self.name!r}")

    def __hash__(self) -> int:
        return hash(self.name)

    def __reduce__(self) -> tuple[type[Culturon], tuple[object, ...]]:
        return type(self), _plain_fields(self)

    def joined(self, other: Culturon) -> Culturon:
        """Return the one culturon that two descriptions of the same name stand for.

        Links are united; where both say something, the other's word counts.

        >>> peace = Culturon("Peace", 1, influence={"trade": 0.5, "raid": -1})
        >>> both = peace.joined(Culturon("Peace", 3, influence={"trade": 2}))
        >>> both.start_value, dict(both.influence)
        (3.0, {'trade': 2.0, 'raid': -1.0})
        """
        return one_culturon([self, other])


def one_culturon(described: list[Culturon]) -> Culturon:
    """Return the one culturon that several descriptions stand for, as `Culturon.joined` does.

    Their links are gathered first and joined once: there may be thousands.
    """
    first, last = described[0], described[-1]
    if len(described) == 1:
        return first
    influence: dict[str, float] = {}
    reinforcement: dict[str, float] = {}
    conditional: list[str] = []
    for one in described:
        influence.update(one.influence)
        conditional.extend(one.conditional)
        reinforcement.update(one.reinforcement)
    position = next((one.position for one in reversed(described) if one.position), None)
    return Culturon(
        first.name,
        last.start_value,
        last.colour,
        position,
        influence,
        tuple(conditional),
        reinforcement,
    )


@dataclass(frozen=True)
class Role:
    """A role in a group, and the culturons that its players are under.

    Args:
        name: unique in its group.
        culturons: each named once.

    Raises:
        SchemeError: two culturons have one name, or something is no culturon.
    """

    name: str
    culturons: tuple[Culturon, ...] = ()

    def __post_init__(self) -> None:
        where = f"role {self.name!r}"
        checked_name(self.name, "a role")
        _set(self, "culturons", _described(self.culturons, Culturon, "culturon", where))


@dataclass(frozen=True)
class Group:
    """A type of group, of which a society creates instances, and the roles in it.

    Args:
        name: unique in the scheme.
        roles: each named once. Roles that name the same culturon hold the same description
            afterwards: links united, the last value and colour.

    Raises:
        SchemeError: two roles have one name, or something is no role.

    >>> chief = Role("chief", (Culturon("Peace", 1, influence={"talk": 1}),))
    >>> other = Role("villager", (Culturon("Peace", 5, influence={"trade": 2}),))
    >>> Group("village", (chief, other)).roles[0].culturons[0].start_value
    5.0
    """

    name: str
    roles: tuple[Role, ...] = ()

    def __post_init__(self) -> None:
        checked_name(self.name, "a group")
        roles = _described(self.roles, Role, "role", f"group {self.name!r}")
        described: dict[str, list[Culturon]] = {}
        for role in roles:
            for culturon in role.culturons:
                described.setdefault(culturon.name, []).append(culturon)
        shared = {name: one_culturon(several) for name, several in described.items()}
        one_each = tuple(Role(r.name, tuple(shared[c.name] for c in r.culturons)) for r in roles)
        _set(self, "roles", one_each)


@dataclass(frozen=True, eq=False)
class CognitiveScheme:
    """What the minds of one or more breeds have in common.

    Two schemes are equal if their descriptions are and their plans come in the same order, since
    the order decides between plans of equal weight.

    Args:
        name: of the scheme; CogLogo knows it by the breed's name.
        cognitons: each named once.
        groups: each named once.
        decision_maker: how a mind picks a plan.
        breeds: the further breeds linked with the scheme, as the modeller spells them.
        plan_positions: plan → x and y in the drawing of the scheme.
        plan_order: the plans in the order that decides between equals; None: the order in which
            they first appear in the links.
        repeated: what the file, which the scheme was read from, wrote more than once and the reader
            put together; reported by `check`, no part of the description.

    Raises:
        SchemeError: a name stands twice, or a field holds something else.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> CognitiveScheme("cows", (hunger,)).plans
    ('eat',)
    """

    name: str
    cognitons: tuple[Cogniton, ...] = ()
    groups: tuple[Group, ...] = ()
    decision_maker: DecisionMaker = field(default_factory=MaximumWeight)
    breeds: tuple[str, ...] = ()
    plan_positions: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    plan_order: tuple[str, ...] | None = None
    repeated: tuple[str, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        checked_name(self.name, "a scheme")
        where = f"scheme {self.name!r}"
        _set(self, "cognitons", _described(self.cognitons, Cogniton, "cogniton", where))
        _set(self, "groups", _described(self.groups, Group, "group", where))
        if not isinstance(self.decision_maker, DecisionMaker):
            raise SchemeError(
                f"decision maker {self.decision_maker!r} of {where}",
                "a decision maker such as MaximumWeight()",
            )
        _set(self, "breeds", checked_names(self.breeds, f"breeds of {where}"))
        _set(self, "repeated", checked_names(self.repeated, f"repeated names of {where}"))
        if not isinstance(self.plan_positions, Mapping):
            raise SchemeError(f"{self.plan_positions!r} as plan positions", "plan → (x, y)")
        positions = {
            checked_name(plan, "a plan"): checked_position(xy, f"plan {plan!r}")
            for plan, xy in self.plan_positions.items()
        }
        _set(self, "plan_positions", MappingProxyType(positions))
        if self.plan_order is not None:
            order = checked_names(self.plan_order, f"plan_order of {where}")
            if len(set(order)) < len(order):
                raise SchemeError(f"plan_order {list(order)} of {where}", "each plan once")
            _set(self, "plan_order", order)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CognitiveScheme):
            return NotImplemented
        described = (
            "name",
            "cognitons",
            "groups",
            "decision_maker",
            "breeds",
            "plan_positions",
            "plans",
        )
        return all(getattr(self, each) == getattr(other, each) for each in described)

    def __hash__(self) -> int:
        return hash((self.name, self.plans))

    def __reduce__(self) -> tuple[type[CognitiveScheme], tuple[object, ...]]:
        return type(self), _plain_fields(self)

    @cached_property
    def linked_plans(self) -> tuple[str, ...]:
        """The plans that links lead to, in the order of first appearance.

        Cognitons come first, then culturons group by group and role by role; within each its
        influence, its conditional and its reinforcement links.
        """
        return tuple(dict.fromkeys(plan for holder in self._holders() for plan in _links(holder)))

    @cached_property
    def plans(self) -> tuple[str, ...]:
        """All plans, in the order that decides between equals.

        That is `plan_order`, then the linked plans it does not name.
        """
        return tuple(dict.fromkeys((*(self.plan_order or ()), *self.linked_plans)))

    @classmethod
    def load(
        cls, path: str | Path, decision_makers: Iterable[type[DecisionMaker]] = ()
    ) -> CognitiveScheme:
        """Read a scheme from a file.

        Args:
            path: a .yaml or .yml file in the form of docs/schemes.md; any other is read as a
                CogLogo file.
            decision_makers: decision makers of the modeller's own that the file may name.

        Raises:
            SchemeError: the file cannot be read as a scheme; says where and why.
        """
        # Here, since the readers of both forms build what this file describes.
        from coglogo_py.files import cogscheme_file, yaml_file

        reader = yaml_file if Path(path).suffix.lower() in (".yaml", ".yml") else cogscheme_file
        return reader.parse(text_in(Path(path), latin_1=True), path, decision_makers)

    def save(self, path: str | Path) -> None:
        """Write the scheme to a file, in the form that the suffix names; replaces what was there.

        Args:
            path: ends in .cogscheme, .yaml or .yml.

        Raises:
            SchemeError: another suffix, the form cannot hold the scheme, or the file cannot be
                written.
        """
        from coglogo_py.files import cogscheme_file, yaml_file

        suffix = Path(path).suffix.lower()
        if suffix in (".yaml", ".yml"):
            text = yaml_file.written(self)
        elif suffix == ".cogscheme":
            try:
                text = cogscheme_file.written(self)
            except SchemeError as error:
                raise error.at(path) from None
        else:
            raise SchemeError(
                f"the suffix {suffix!r}", ".cogscheme, .yaml or .yml", "change the name", path
            )
        try:
            Path(path).write_text(text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise _not_done("written", error, path) from None

    def check(self, plans: Iterable[str] | None = None) -> list[Finding]:
        """Return what the linter finds odd in the scheme; see `coglogo_py.lint`.

        Args:
            plans: the plans that the model carries out; None: those of `plan_order`, if written.

        >>> CognitiveScheme("cows", (Cogniton("Mood"),)).check()[0].kind
        'cogniton without effect'
        """
        from coglogo_py.lint import findings

        return findings(self, plans)

    def _holders(self) -> Iterator[Cogniton | Culturon]:
        yield from self.cognitons
        for group in self.groups:
            for role in group.roles:
                yield from role.culturons


def _links(holder: Cogniton | Culturon) -> tuple[str, ...]:
    """Return the plans that a cogniton or culturon is linked with, in order, some repeated."""
    return (*holder.influence, *holder.conditional, *holder.reinforcement)


def _not_done(done: str, error: OSError, path: str | Path) -> SchemeError:
    reason = error.strerror or type(error).__name__
    return SchemeError(f"the file cannot be {done} ({reason})", remedy="check the path", file=path)


def _set(described: object, name: str, value: object) -> None:
    object.__setattr__(described, name, value)


def _plain_fields(described: Cogniton | Culturon | CognitiveScheme) -> tuple[object, ...]:
    """Return the values of all fields, read-only mappings as dictionaries, which can be pickled."""
    values = (getattr(described, each.name) for each in fields(described))
    return tuple(dict(v) if isinstance(v, MappingProxyType) else v for v in values)


def _check_links(holder: Cogniton | Culturon, where: str) -> None:
    """Check and settle the fields that cognitons and culturons have in common."""
    checked_name(holder.name, f"a {where.split()[0]}")
    _set(holder, "start_value", checked_number(holder.start_value, f"start_value of {where}"))
    _set(holder, "colour", checked_colour(holder.colour, where))
    if holder.position is not None:
        _set(holder, "position", checked_position(holder.position, where))
    for links in ("influence", "reinforcement"):
        weights = checked_weights(getattr(holder, links), f"{links} links of {where}")
        _set(holder, links, weights)
    plans = checked_names(holder.conditional, f"conditional links of {where}")
    _set(holder, "conditional", tuple(dict.fromkeys(plans)))


def _described(
    values: object, kind: type[Described], noun: str, where: str
) -> tuple[Described, ...]:
    """Return descriptions as a tuple, after checking that each is one and no name stands twice."""
    if isinstance(values, str | Mapping) or not isinstance(values, Iterable):
        raise SchemeError(f"{values!r} in {where}", f"several {noun}s", f"write ({noun},) for one")
    found: dict[str, Described] = {}
    for value in values:
        if not isinstance(value, kind):
            raise SchemeError(f"{value!r} in {where}", f"a {kind.__name__}")
        name: str = value.name  # type: ignore[attr-defined]  # every kind handed over has one
        if name in found:
            raise SchemeError(
                f"{where} has two {noun}s called {name!r}", remedy="rename one or join them"
            )
        found[name] = value
    return tuple(found.values())
