"""Schemes as far as CogLogo's files can hold them, and what they cannot."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

from coglogo_py.decision import (
    BiasedWeightedStochastic,
    DecisionMaker,
    MaximumWeight,
    WeightedStochastic,
)
from coglogo_py.files.cogscheme_file import KEYWORDS, OF_YAML_ALONE
from coglogo_py.files.renaming import fitting, listed, renamed_in_words
from coglogo_py.parts import Cogniton, Culturon, Group, Role
from coglogo_py.scheme import CognitiveScheme

COGLOGO = (MaximumWeight, WeightedStochastic, BiasedWeightedStochastic)
"""The decision makers that CogLogo has."""

Holder = TypeVar("Holder", Cogniton, Culturon)


def for_coglogo(scheme: CognitiveScheme) -> tuple[CognitiveScheme, tuple[str, ...]]:
    """Return a scheme that a CogLogo file can hold, and what of this one it cannot, in sentences.

    >>> hunger = Cogniton("Hunger", conditional=("eat",), type="need", chance=0.5)
    >>> _, lost = for_coglogo(CognitiveScheme("cows", (hunger,)))
    >>> lost
    ("cogniton 'Hunger': 'type' and 'chance' are left out",)
    """
    lost: list[str] = []
    left_of_equals = {*scheme.plan_positions}
    for one in _holders(scheme):
        left_of_equals |= {*one.influence, *one.reinforcement}
    plans = fitting(
        dict.fromkeys((*scheme.plan_positions, *scheme.plans)),
        lambda name: _line(name.replace("=", "_") if name in left_of_equals else name),
    )
    cogniton_names = fitting((one.name for one in scheme.cognitons), _line)
    lost += renamed_in_words("plan", plans) + renamed_in_words("cogniton", cogniton_names)
    cognitons = []
    for one in scheme.cognitons:
        plain = Cogniton(one.name, one.starting, one.start_value)
        gone = [name for name in OF_YAML_ALONE if getattr(one, name) != getattr(plain, name)]
        if gone:
            are = "are" if len(gone) > 1 else "is"
            lost.append(f"cogniton {one.name!r}: {listed(gone)} {are} left out")
        without = replace(one, **{name: getattr(plain, name) for name in gone})
        cognitons.append(_relinked(without, cogniton_names[one.name], plans))
    group_names = fitting((one.name for one in scheme.groups), _line)
    lost += renamed_in_words("group", group_names)
    groups = tuple(_group(one, group_names[one.name], plans, lost) for one in scheme.groups)
    names = fitting((scheme.name, *scheme.breeds), _line)
    lost += renamed_in_words("breed", names)
    made = CognitiveScheme(
        names[scheme.name],
        tuple(cognitons),
        groups,
        _maker(scheme.decision_maker, lost),
        tuple(names[one] for one in scheme.breeds),
        {plans[plan]: place for plan, place in scheme.plan_positions.items()},
    )
    if tuple(plans[one] for one in scheme.plans) != made.plans:
        lost.append(f"the order of plans, {list(scheme.plans)}, becomes {list(made.plans)}")
    if groups and not cognitons:
        lost.append("groups without a cogniton: CogLogo 1.18.1 takes them for breeds")
    return made, tuple(lost)


def _group(group: Group, name: str, plans: Mapping[str, str], lost: list[str]) -> Group:
    where = f"group {group.name!r}"
    if group.attributes:
        names = [attribute for attribute, _ in group.attributes]
        lost.append(f"{where}: its attributes {listed(names)} are left out")
    if group.within is not None:
        lost.append(f"{where}: that it lies in {group.within[0]!r} is left out")
    if group != group.without_positions():
        lost.append(f"{where}: its place in the drawing and those of its roles are left out")
    roles = fitting((one.name for one in group.roles), _line)
    culturons = fitting((held.name for one in group.roles for held in one.culturons), _line)
    lost += renamed_in_words(f"{where}: role", roles)
    lost += renamed_in_words(f"{where}: culturon", culturons)
    return Group(
        name,
        tuple(
            Role(
                roles[one.name],
                tuple(_relinked(held, culturons[held.name], plans) for held in one.culturons),
            )
            for one in group.roles
        ),
    )


def _relinked(holder: Holder, name: str, plans: Mapping[str, str]) -> Holder:
    return replace(
        holder,
        name=name,
        influence={plans[plan]: weight for plan, weight in holder.influence.items()},
        conditional=tuple(plans[plan] for plan in holder.conditional),
        reinforcement={plans[plan]: weight for plan, weight in holder.reinforcement.items()},
    )


def _maker(maker: DecisionMaker, lost: list[str]) -> DecisionMaker:
    if isinstance(maker, COGLOGO):
        return maker
    lost.append(f"the decision maker {maker.name}, which CogLogo lacks, becomes MaximumWeight")
    return MaximumWeight(maker.bias)


def _holders(scheme: CognitiveScheme) -> list[Cogniton | Culturon]:
    roles = [role for group in scheme.groups for role in group.roles]
    return [*scheme.cognitons, *(one for role in roles for one in role.culturons)]


def _line(name: str) -> str:
    """Return a name that can be a line of the file."""
    plain = re.sub("[\0\r\n]", " ", name)
    return f"{plain}_" if plain in KEYWORDS else plain
