"""What a scheme is made of: cognitons, and groups with their roles and culturons."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Protocol, TypeVar

from coglogo_py.border.errors import SchemeError, nearest, shown
from coglogo_py.border.numbers import is_truth
from coglogo_py.conditions.condition import Conditions, conditions_in
from coglogo_py.decision import DecisionMaker
from coglogo_py.files import checks

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

GREY = (128, 128, 128)

TYPES = ("belief", "need", "percept", "skill", "trait", "meme")
"""What a cogniton may be said to be."""

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
        active_while: a comparison of a field of the agent with a number or a parameter of the
            model, as "energy < 5", or several, which must all hold: it is active exactly while
            they do, and begins with the start value each time.
        activated_when: likewise; it becomes active, with the start value, when they hold.
        deactivated_when: likewise; it is inactive when they hold, whatever else does.
        type: what it is, one of `TYPES`; None where it is not said.
        chance: how likely a mind has it at birth, 0 … 1.
        inherited: how likely a hatched mind has of it what its parent has, active with its value
            or inactive, 0 … 1; else it has what a new mind has.

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
    active_while: Conditions = ()
    activated_when: Conditions = ()
    deactivated_when: Conditions = ()
    type: str | None = None
    chance: float = 1.0
    inherited: float = 1.0

    def __post_init__(self) -> None:
        where = f"cogniton {self.name!r}"
        if not is_truth(self.starting):
            raise SchemeError(f"starting {shown(self.starting)} of {where}", "True or False")
        settle(self, "starting", bool(self.starting))
        _check_links(self, where)
        for name in ("active_while", "activated_when", "deactivated_when"):
            settle(self, name, conditions_in(getattr(self, name), f"{name} of {where}"))
        if self.type is not None and self.type not in TYPES:
            hint = nearest(self.type, TYPES) if isinstance(self.type, str) else None
            raise SchemeError(
                f"{shown(self.type)} as the type of {where}", f"one of {', '.join(TYPES)}", hint
            )
        for name in ("chance", "inherited"):
            settle(self, name, checks.checked_share(getattr(self, name), f"{name} of {where}"))
        _check_becoming(self, where)

    @property
    def conditions(self) -> Conditions:
        """All its conditions."""
        return (*self.active_while, *self.activated_when, *self.deactivated_when)

    def __hash__(self) -> int:
        return hash(self.name)

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), plain_fields(self)


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
        return type(self), plain_fields(self)

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
    position = next((one.position for one in reversed(described) if one.position), None)
    return Culturon(first.name, last.start_value, last.colour, position, *links_together(described))


def links_together(
    described: Sequence[Cogniton | Culturon],
) -> tuple[dict[str, float], tuple[str, ...], dict[str, float]]:
    """Return the influence, conditional and reinforcement links of several descriptions."""
    influence: dict[str, float] = {}
    reinforcement: dict[str, float] = {}
    conditional: list[str] = []
    for one in described:
        influence.update(one.influence)
        conditional.extend(one.conditional)
        reinforcement.update(one.reinforcement)
    return influence, tuple(conditional), reinforcement


@dataclass(frozen=True)
class Role:
    """A role in a group, and the culturons that its players are under.

    Args:
        name: unique in its group.
        culturons: each named once.
        position: x and y in the drawing of the scheme, or None.

    Raises:
        SchemeError: two culturons have one name, or something is no culturon or position.
    """

    name: str
    culturons: tuple[Culturon, ...] = ()
    position: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        where = f"role {self.name!r}"
        checks.checked_name(self.name, "a role")
        settle(self, "culturons", described_once(self.culturons, Culturon, "culturon", where))
        _settle_position(self, where)


@dataclass(frozen=True)
class Group:
    """A type of group, of which a society creates instances, and the roles in it.

    Args:
        name: unique in the scheme.
        roles: each named once. Roles that name the same culturon hold the same description
            afterwards: links united, the last value and colour.
        attributes: further numbers of an instance, which act on no plan: pairs of a name and the
            value when it is created, or a mapping.
        within: the type of group that an instance may lie in an instance of, and the role whose
            culturons all in it are under there; None for none.
        position: x and y in the drawing of the scheme, or None.

    Raises:
        SchemeError: two roles have one name, or something is no role, number or position.

    >>> chief = Role("chief", (Culturon("Peace", 1, influence={"talk": 1}),))
    >>> other = Role("villager", (Culturon("Peace", 5, influence={"trade": 2}),))
    >>> Group("village", (chief, other)).roles[0].culturons[0].start_value
    5.0
    """

    name: str
    roles: tuple[Role, ...] = ()
    attributes: tuple[tuple[str, float], ...] = ()
    within: tuple[str, str] | None = None
    position: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        checks.checked_name(self.name, "a group")
        _settle_position(self, f"group {self.name!r}")
        if self.within is not None:
            around = checks.checked_names(self.within, f"what group {self.name!r} is within")
            if len(around) != 2:
                raise SchemeError(
                    f"{around!r} as what group {self.name!r} is within",
                    "a group and one of its roles",
                    'write within=("clan", "member")',
                )
            settle(self, "within", around)
        attributes = checks.checked_attributes(
            self.attributes, f"attributes of group {self.name!r}"
        )
        settle(self, "attributes", attributes)
        roles = described_once(self.roles, Role, "role", f"group {self.name!r}")
        described: dict[str, list[Culturon]] = {}
        for role in roles:
            for culturon in role.culturons:
                described.setdefault(culturon.name, []).append(culturon)
        shared = {name: one_culturon(several) for name, several in described.items()}
        one_each = (replace(r, culturons=tuple(shared[c.name] for c in r.culturons)) for r in roles)
        settle(self, "roles", tuple(one_each))

    def without_positions(self) -> Group:
        """Return it without its own place in a drawing and those of its roles."""
        roles = tuple(replace(role, position=None) for role in self.roles)
        return replace(self, roles=roles, position=None)


def check_nesting(groups: Mapping[str, tuple[Iterable[str], tuple[str, str] | None]]) -> None:
    """Refuse groups within others that there are not, or that lie within themselves.

    Args:
        groups: the roles of each, and what it is within.

    Raises:
        SchemeError: says which.

    >>> check_nesting({"family": (["parent"], ("clan", "member")), "clan": (["member"], None)})
    """
    for name, (_, within) in groups.items():
        if within is None:
            continue
        around, role = within
        if around not in groups:
            known = ", ".join(groups)
            raise SchemeError(f"group {name!r} within {around!r}", f"a group of: {known}")
        if role not in groups[around][0]:
            known = ", ".join(groups[around][0]) or "it has none"
            raise SchemeError(
                f"group {name!r} within the role {role!r} of {around!r}", f"a role of it: {known}"
            )
        passed = [name]
        while within is not None:
            passed.append(within[0])
            if within[0] == name:
                raise SchemeError(f"groups within each other: {' in '.join(passed)}")
            if len(passed) > len(groups):
                break  # a circle further out, which its own groups tell
            within = groups[within[0]][1] if within[0] in groups else None


class Scheme(Protocol):
    """What a file or the linter takes of a scheme; `CognitiveScheme` has it."""

    @property
    def name(self) -> str:
        """The scheme's own."""

    @property
    def cognitons(self) -> tuple[Cogniton, ...]:
        """In order."""

    @property
    def groups(self) -> tuple[Group, ...]:
        """With their roles and culturons."""

    @property
    def decision_maker(self) -> DecisionMaker:
        """How a mind picks a plan."""

    @property
    def breeds(self) -> tuple[str, ...]:
        """The further breeds linked with it."""

    @property
    def plan_positions(self) -> Mapping[str, tuple[int, int]]:
        """Plan → x and y in the drawing."""

    @property
    def plan_order(self) -> tuple[str, ...] | None:
        """As it was written out, or None."""

    @property
    def repeated(self) -> tuple[str, ...]:
        """What a file wrote more than once."""

    @property
    def linked_plans(self) -> tuple[str, ...]:
        """In the order in which links name them."""

    @property
    def plans(self) -> tuple[str, ...]:
        """In the order that decides between equals."""


AScheme = TypeVar("AScheme", bound=Scheme)


def links_of(holder: Cogniton | Culturon) -> tuple[str, ...]:
    """Return the plans that a cogniton or culturon is linked with, in order, some repeated."""
    return (*holder.influence, *holder.conditional, *holder.reinforcement)


def memes_of(scheme: Scheme, learner: Scheme) -> list[tuple[int, int]]:
    """Return the memes of a scheme that another has as cognitons too: places in that, in the first.

    Args:
        scheme: that of the mind which is imitated.
        learner: that of the mind which imitates.
    """
    known = {one.name: place for place, one in enumerate(learner.cognitons)}
    return [
        (known[one.name], place)
        for place, one in enumerate(scheme.cognitons)
        if one.type == "meme" and one.name in known
    ]


def settle(described: object, name: str, value: object) -> None:
    """Set a field of a description that is otherwise frozen."""
    object.__setattr__(described, name, value)


def plain_fields(described: DataclassInstance) -> tuple[object, ...]:
    """Return the values of all fields, read-only mappings as dictionaries, which can be pickled."""
    values = (getattr(described, each.name) for each in fields(described))
    return tuple(dict(v) if isinstance(v, MappingProxyType) else v for v in values)


def _check_links(holder: Cogniton | Culturon, where: str) -> None:
    """Check and settle the fields that cognitons and culturons have in common."""
    checks.checked_name(holder.name, f"a {where.split()[0]}")
    settle(
        holder, "start_value", checks.checked_number(holder.start_value, f"start_value of {where}")
    )
    settle(holder, "colour", checks.checked_colour(holder.colour, where))
    _settle_position(holder, where)
    for links in ("influence", "reinforcement"):
        weights = checks.checked_weights(getattr(holder, links), f"{links} links of {where}")
        settle(holder, links, weights)
    plans = checks.checked_names(holder.conditional, f"conditional links of {where}")
    settle(holder, "conditional", tuple(dict.fromkeys(plans)))


def _settle_position(one: Cogniton | Culturon | Role | Group, where: str) -> None:
    if one.position is not None:
        settle(one, "position", checks.checked_position(one.position, where))


def _check_becoming(one: Cogniton, where: str) -> None:
    """Refuse what says twice, and not alike, when a cogniton is active."""
    if one.active_while and (one.activated_when or one.deactivated_when):
        other = "activated_when" if one.activated_when else "deactivated_when"
        found = f"active_while and {other} of {where}"
        raise SchemeError(found, None, "active_while says all: leave the other out")
    if one.chance < 1.0 and one.active_while:
        found = f"chance and active_while of {where}"
        raise SchemeError(found, None, "its conditions say when it is active: leave chance out")
    if one.chance < 1.0 and not one.starting:
        found = f"chance of {where}, which no mind has at birth"
        raise SchemeError(found, None, "leave chance out, or let it be active at birth")


def described_once(
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
