"""A scheme of ours as one of MetaCiv's, as far as that can hold it, and what it cannot."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    MaximumWeight,
    PositiveStochastic,
    WeightedStochastic,
)
from coglogo_py import Cogniton as OurCogniton
from coglogo_py import Group as OurGroup
from coglogo_py.conditions.condition import Condition
from coglogo_py.decision import DecisionMaker
from coglogo_py.files.renaming import apart, fitting, listed, renamed_in_words
from coglogo_py.parts import Culturon
from socialmind.metaciv.description import (
    Action,
    Attribute,
    Cogniton,
    Constant,
    Group,
    Influence,
    Permit,
    Place,
    Plan,
    Role,
    Scheme,
    Trigger,
)
from socialmind.metaciv.reading.record import INT, LONGEST_NAME
from socialmind.metaciv.reading.schemes import COMPARISONS, TYPES

NOWHERE = Place("", 1)
"""Where parts stand that are not written yet."""
LONGEST = LONGEST_NAME - 10
"""Characters of a name, with room for a number behind it."""
LARGEST_FACTOR = 10_000
"""By what weights are multiplied at most to become whole numbers."""
MAKERS: dict[type[DecisionMaker], tuple[str, bool]] = {
    MaximumWeight: ("MaxWeightDecisionMaker", True),
    PositiveStochastic: ("WeightedStochasticDecisionMaker", True),
    WeightedStochastic: ("WeightedStochasticDecisionMaker", False),
    BiasedWeightedStochastic: ("WeightedStochasticDecisionMaker", False),
}
"""MetaCiv's class for a decision maker, and whether it decides alike."""

Key = tuple[str, ...]


@dataclass(frozen=True)
class Exported:
    """A scheme of MetaCiv's that stands for one of ours.

    Args:
        scheme: what its files say.
        lost: what they do not, in sentences.
        factor: by what the weights of influence were multiplied.
    """

    scheme: Scheme
    lost: tuple[str, ...]
    factor: int


def for_metaciv(
    scheme: CognitiveScheme,
    starts: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> Exported:
    """Return a scheme as MetaCiv can hold it.

    Weights that are not whole are all multiplied by one power of ten, which changes no decision.

    Args:
        scheme: ours.
        starts: what fields of agents begin with, by name; 0 where it is not said.
        parameters: what parameters of the model are, likewise.

    >>> hunger = OurCogniton("Hunger", start_value=1, influence={"eat": 0.5}, conditional=("eat",))
    >>> exported = for_metaciv(CognitiveScheme("cows", (hunger,)))
    >>> exported.scheme.cognitons[0].influences[0].weight, exported.factor
    (5, 10)
    """
    return _Export(scheme, starts or {}, parameters or {}).made()


class _Export:
    """One scheme on its way."""

    def __init__(
        self,
        scheme: CognitiveScheme,
        starts: Mapping[str, float],
        parameters: Mapping[str, float],
    ) -> None:
        self.scheme, self.starts, self.parameters = scheme, starts, parameters
        self.lost: list[str] = []
        self.attributes: dict[str, float] = {}
        self.constants: dict[str, float] = {}
        self.plans = fitting(scheme.plans, _fit)
        self.culturons: dict[Key, Culturon] = {}
        """Those that need a cogniton of their own."""
        self.standing: dict[tuple[str, str], Key] = {}
        """Which cogniton stands for a culturon, by group and name."""
        for group in scheme.groups:
            for one in (culturon for role in group.roles for culturon in role.culturons):
                key = self._standing_for(group.name, one)
                self.standing[group.name, one.name] = key
                if key[0] == "culturon":
                    self.culturons.setdefault(key, one)
        self.names = self._names()
        self.holders: list[OurCogniton | Culturon] = [*scheme.cognitons, *self.culturons.values()]
        self.factor = _factor(weight for one in self.holders for weight in one.influence.values())

    def made(self) -> Exported:
        """Return the scheme, and what was lost."""
        scheme, name = self.scheme, _fit(self.scheme.name)
        self.lost += renamed_in_words("scheme", {scheme.name: name})
        self.lost += renamed_in_words("plan", self.plans)
        if self.factor > 1:
            self.lost.append(
                f"weights are multiplied by {self.factor}, since MetaCiv's are whole numbers; "
                "that changes no decision"
            )
        cognitons = [self._cogniton(one) for one in scheme.cognitons]
        groups = [self._group(one) for one in scheme.groups]
        culturons = [self._culturon(key, one) for key, one in self.culturons.items()]
        culturons += [_empty(name) for key, name in self.names.items() if key[0] == "role"]
        self._of_all()
        made = Scheme(
            name,
            tuple(Attribute(one, start, NOWHERE) for one, start in self.attributes.items()),
            tuple(Constant(one, value, NOWHERE) for one, value in self.constants.items()),
            (*cognitons, *culturons),
            tuple(groups),
            tuple(
                Plan(one, "plan", (Action("A_DoNothing", (), (), NOWHERE),), NOWHERE)
                for one in self.plans.values()
            ),
            NOWHERE,
        )
        return Exported(made, tuple(self.lost), self.factor)

    def _names(self) -> dict[Key, str]:
        """Return what cognitons are called, and what stands for culturons and for empty roles.

        The key of a cogniton is ("cogniton", name), of a culturon ("culturon", group, name), of an
        empty role ("role", group, name).
        """
        wanted: dict[Key, str] = {("cogniton", one.name): one.name for one in self.scheme.cognitons}
        taken = [*wanted.values(), *(one.name for one in self.culturons.values())]
        for key, culturon in self.culturons.items():
            alone = taken.count(culturon.name) == 1
            wanted[key] = culturon.name if alone else f"{key[1]} {culturon.name}"
        for one in self.scheme.groups:
            empty = [role.name for role in one.roles if not role.culturons]
            wanted |= {("role", one.name, role): f"{one.name} {role}" for role in empty}
        found = apart(wanted, _fit)
        for key, new in found.items():
            what = "cogniton" if key[0] == "cogniton" else f"group {key[1]!r}: culturon"
            if key[0] != "role":
                self.lost += renamed_in_words(what, {key[-1]: new})
        return found

    def _cogniton(self, one: OurCogniton) -> Cogniton:
        where = f"cogniton {one.name!r}"
        if one.type is not None and one.type not in TYPES:
            self.lost.append(f"{where}: the type {one.type} becomes belief")
        if one.chance != 1:
            self.lost.append(f"{where}: its chance {one.chance:g} is left out")
        triggers = self._triggers(one, where)
        self._holder(where, one)
        return Cogniton(
            self.names["cogniton", one.name],
            "-",
            one.type if one.type in TYPES and one.type is not None else "belief",
            one.starting and not triggers,
            0,
            _rgb(one.colour),
            self._permits(one),
            self._influences(one, where),
            triggers,
            NOWHERE,
        )

    def _standing_for(self, group: str, one: Culturon) -> Key:
        """Return which cogniton stands for a culturon: one that is alike, or its own."""
        if any(own.name == one.name and _alike(own, one) for own in self.scheme.cognitons):
            return ("cogniton", one.name)
        known = (key for key, other in self.culturons.items()
                 if other.name == one.name and _alike(other, one))  # fmt: skip
        return next(known, ("culturon", group, one.name))

    def _culturon(self, key: Key, one: Culturon) -> Cogniton:
        where = f"group {key[1]!r}: culturon {key[2]!r}"
        self._holder(where, one)
        return Cogniton(
            self.names[key],
            "-",
            "culturon",
            False,
            0,
            _rgb(one.colour),
            self._permits(one),
            self._influences(one, where),
            (),
            NOWHERE,
        )

    def _holder(self, where: str, one: OurCogniton | Culturon) -> None:
        """Note what of a cogniton or culturon is lost."""
        if one.start_value != 1:
            self.lost.append(f"{where}: its start value {one.start_value:g} becomes 1")
        if one.reinforcement:
            plans = listed(one.reinforcement)
            self.lost.append(f"{where}: its reinforcement by {plans} is left out")

    def _permits(self, one: OurCogniton | Culturon) -> tuple[Permit, ...]:
        return tuple(Permit(self.plans[plan], NOWHERE) for plan in one.conditional)

    def _influences(self, one: OurCogniton | Culturon, where: str) -> tuple[Influence, ...]:
        found = []
        for plan, weight in one.influence.items():
            whole = min(max(round(weight * self.factor), INT[0]), INT[1])
            if abs(whole - weight * self.factor) > 1e-9 * abs(whole):
                said = f"{where}: its weight {weight!r} on {plan!r}"
                self.lost.append(f"{said} becomes {whole / self.factor!r}")
            found.append(Influence(self.plans[plan], whole, NOWHERE))
        return tuple(found)

    def _triggers(self, one: OurCogniton, where: str) -> tuple[Trigger, ...]:
        """Return the trigger that stands for a cogniton's condition, if one can."""
        for field in ("activated_when", "deactivated_when"):
            if getattr(one, field):
                self.lost.append(f"{where}: {field} is left out; a trigger holds both ways")
        if len(one.active_while) > 1:
            several = " and ".join(map(str, one.active_while))
            self.lost.append(f"{where}: {several} is left out; of two triggers the last decides")
        if len(one.active_while) != 1:
            return ()
        (condition,) = one.active_while
        comparison = next((two for two in COMPARISONS.values() if two == condition.operator), None)
        if comparison is None:
            self.lost.append(f"{where}: {condition} is left out; no trigger asks !=")
            return ()
        self.attributes[condition.field] = self._value(
            "attribute", condition.field, self.starts, self.attributes
        )
        threshold, constant = self._bound(condition)
        return (Trigger(condition.field, threshold, comparison, constant, NOWHERE),)

    def _bound(self, condition: Condition) -> tuple[float, str | None]:
        if not isinstance(condition.bound, str):
            return float(condition.bound), None
        name = condition.bound
        self.constants[name] = self._value("constant", name, self.parameters, self.constants)
        return self.constants[name], name

    def _value(
        self, what: str, name: str, known: Mapping[str, float], said: Mapping[str, float]
    ) -> float:
        if name not in known and name not in said:
            self.lost.append(f"the {what} {name!r} is 0, since the scheme does not say its value")
        return known.get(name, 0.0)

    def _group(self, one: OurGroup) -> Group:
        where = f"group {one.name!r}"
        if one.attributes:
            names = [name for name, _ in one.attributes]
            self.lost.append(f"{where}: its attributes {listed(names)} are left out")
        if one.within is not None:
            self.lost.append(f"{where}: that it lies in {one.within[0]!r} is left out")
        groups = fitting((group.name for group in self.scheme.groups), _fit)
        roles = fitting((role.name for role in one.roles), lambda name: _fit(name, ":"))
        self.lost += renamed_in_words("group", {one.name: groups[one.name]})
        self.lost += renamed_in_words(f"{where}: role", roles)
        made = []
        for role in one.roles:
            held = tuple(
                self.names[self.standing[one.name, culturon.name]] for culturon in role.culturons
            )
            if not held:
                held = (self.names["role", one.name, role.name],)
                self.lost.append(
                    f"{where}: role {role.name!r} has a culturon {held[0]!r} without effect, since "
                    "MetaCiv knows roles by their culturons"
                )
            made.append(Role(roles[role.name], held, NOWHERE))
        if not one.roles:
            self.lost.append(f"{where}: nobody can join it, since it has no role")
        return Group(groups[one.name], tuple(made), None, NOWHERE)

    def _of_all(self) -> None:
        """Note what no scheme of MetaCiv's holds."""
        scheme = self.scheme
        name, alike = MAKERS.get(type(scheme.decision_maker), ("MaxWeightDecisionMaker", False))
        said = f"the decision maker {scheme.decision_maker.name} stands in parametres.metaciv"
        same = "" if alike else ", the nearest that there is"
        self.lost.append(f"{said}: DecisionMaker : {name}{same}")
        if scheme.plans:
            self.lost.append("what plans do is no part of a scheme: each does A_DoNothing")
        if scheme.breeds:
            self.lost.append("breeds are left out: a civilisation names its scheme")
        if scheme.plan_order is not None and scheme.plan_order != scheme.linked_plans:
            self.lost.append("between equals MetaCiv takes the plan that was permitted first")
        drawn = [*self.holders, *scheme.groups, *(r for g in scheme.groups for r in g.roles)]
        if scheme.plan_positions or any(one.position is not None for one in drawn):
            self.lost.append("places in the drawing are left out")
        untyped = [one.name for one in scheme.cognitons if one.type is None]
        if untyped:
            self.lost.append(f"beliefs, since no type is said, are {listed(untyped)}")
        if any(one.inherited > 0 for one in scheme.cognitons):
            self.lost.append("children begin with the initial cognitons, and inherit nothing")


def _alike(one: OurCogniton | Culturon, other: Culturon) -> bool:
    """Return whether the same cogniton of MetaCiv's can stand for both."""
    return (one.influence, one.conditional, one.reinforcement, one.start_value) == (
        other.influence, other.conditional, other.reinforcement, other.start_value
    )  # fmt: skip


def _empty(name: str) -> Cogniton:
    return Cogniton(name, "-", "culturon", False, 0, _rgb((128, 128, 128)), (), (), (), NOWHERE)


def _factor(weights: Iterable[float]) -> int:
    """Return the power of ten that makes all weights whole, or else the largest."""
    values = list(weights)
    factor = 1
    while factor < LARGEST_FACTOR and any(
        abs(one * factor - round(one * factor)) > 1e-9 * max(1.0, abs(one * factor))
        for one in values
    ):
        factor *= 10
    while factor > 1 and any(abs(one * factor) > INT[1] for one in values):
        factor //= 10
    return factor


def _rgb(colour: tuple[int, int, int]) -> int:
    """Return an opaque colour as Java's signed whole number."""
    red, green, blue = colour
    return (red << 16 | green << 8 | blue) - 2**24


def _fit(name: str, forbidden: str = "") -> str:
    """Return a name that a line of MetaCiv's can hold."""
    plain = "".join(
        one if one.isprintable() and one not in f",{forbidden}" else "_" for one in name
    )
    plain = re.sub(" +:(?= |$)", ":", plain).strip()[:LONGEST].strip()
    return plain or "unnamed"
