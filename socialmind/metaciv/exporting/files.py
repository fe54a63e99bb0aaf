"""The files of a scheme's folder, as MetaCiv writes them; `reading` reads them back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar
from urllib.parse import quote_plus

from socialmind.metaciv.actions import ACTIONS
from socialmind.metaciv.description import Action, Argument, Cogniton, Group, Plan, Scheme, Trigger
from socialmind.metaciv.reading.arguments import CONSTANT, NO_CONSTANT, NUMBERS
from socialmind.metaciv.reading.files import SUFFIX
from socialmind.metaciv.reading.schemes import COMPARISONS

LONGEST = 80
"""Characters of a file's name that stand for what is inside."""
CODES = {comparison: code for code, comparison in COMPARISONS.items()}
GREY = -8355712
"""The colour of plans, as MetaCiv's editor writes it."""


class Named(Protocol):
    """What has a file of its own."""

    @property
    def name(self) -> str:
        """The name inside."""


OfScheme = TypeVar("OfScheme", bound=Named)


def scheme_files(scheme: Scheme) -> dict[str, bytes]:
    """Return the content of each file of a scheme's folder, by its path from `schemasCognitifs`."""
    home = file_names([scheme.name])[0]
    texts = {
        f"{home}/{home}{SUFFIX}": [
            f"Nom : {scheme.name}",
            "WeightInterval : __WIBOTH",
            f"WeightBound : {_bound(scheme)!r}",
        ]
    }
    for part, things in (
        ("attributes", [(one, [f"Name : {one.name}", f"Starting value : {one.start!r}"])
                        for one in scheme.attributes]),
        ("constants", [(one, [f"Name : {one.name}", f"Value : {one.value!r}"])
                       for one in scheme.constants]),
        ("cognitons", [(one, _cogniton(one)) for one in scheme.cognitons]),
        ("groups", [(one, _group(one)) for one in scheme.groups]),
        ("plans", [(one, _plan(one)) for one in scheme.plans]),
    ):  # fmt: skip
        names = file_names([one.name for one, _ in things])
        for file, (_, lines) in zip(names, things, strict=True):
            texts[f"{home}/{part}/{file}{SUFFIX}"] = lines
    return {file: ("\n".join(lines) + "\n").encode() for file, lines in texts.items()}


def file_names(names: Sequence[str]) -> list[str]:
    """Return what the files of things are called, so that sorted they come in this order.

    >>> file_names(["Eat", "Go on"]), file_names(["b", "a"]), file_names(["..", "A", "a"])
    (['Eat', 'Go+on'], ['1_b', '2_a'], ['1_%2E.', '2_A', '3_a'])
    """
    quoted = [quote_plus(one) for one in names]
    quoted = [f"%2E{one[1:]}" if one.startswith(".") else one for one in quoted]
    apart = len({one.lower() for one in quoted}) == len(quoted)
    sorted_already = sorted(quoted, key=lambda one: one + SUFFIX) == quoted
    if apart and sorted_already and all(len(one) <= LONGEST for one in quoted):
        return quoted
    digits = len(str(len(names)))
    return [f"{number:0{digits}}_{one[:LONGEST]}" for number, one in enumerate(quoted, start=1)]


def _bound(scheme: Scheme) -> float:
    """Return how far the editor's sliders go."""
    weights = [abs(link.weight) for one in scheme.cognitons for link in one.influences]
    return float(max(10, *weights)) if weights else 10.0


def _cogniton(one: Cogniton) -> list[str]:
    return [
        f"Nom : {one.name}",
        f"Description : {one.description}",
        f"Type : {one.type.upper()}",
        f"StartChance : {one.start_chance}",
        *([] if one.colour is None else [f"Couleur : {one.colour}"]),
        f"Initial : {int(one.initial)}",
        *(f"Permet : {link.plan}" for link in one.permits),
        *(f"Influence : {link.plan},{link.weight}" for link in one.influences),
        *(_trigger(trigger) for trigger in one.triggers),
    ]


def _trigger(one: Trigger) -> str:
    code, constant = CODES[one.comparison], one.constant or NO_CONSTANT
    return f"Trigger : {one.attribute},{one.threshold!r},{code},{constant}"


def _group(one: Group) -> list[str]:
    return [
        f"Name : {one.name}",
        *(f"Culturon : {role.name},{held}" for role in one.roles for held in role.culturons),
        f"AutoJoin : {'false,null' if one.auto_join is None else f'true,{one.auto_join}'}",
    ]


def _plan(one: Plan) -> list[str]:
    return [
        f"Nom : {one.name}",
        f"Birth : {str(one.kind == 'birth').lower()}",
        f"Self : {str(one.kind == 'self').lower()}",
        f"Couleur : {GREY}",
        *(line for action in one.actions for line in _action(action, 0)),
    ]


def _action(action: Action, depth: int) -> list[str]:
    parts = [action.written or action.name, *([action.direction] if action.direction else [])]
    kind = ACTIONS.get(action.name)
    heeds = [one.heeds_constants for one in kind.arguments] if kind else []
    for argument, heeding in zip(action.arguments, heeds, strict=True):
        parts.append(f"{argument.label}({_argument(argument, heeding)})")
    line = "\t" * depth + "Action : " + ",".join(parts)
    return [line, *(text for child in action.children for text in _action(child, depth + 1))]


def _argument(one: Argument, heeding: bool) -> str:
    value = f"{one.value}:{one.role}" if one.role is not None else one.value
    constant = f"{CONSTANT}{one.constant or NO_CONSTANT}"
    return f"{one.type} {value}{constant if heeding and one.type in NUMBERS else ''}"
