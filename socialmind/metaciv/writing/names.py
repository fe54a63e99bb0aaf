"""Names as MetaCiv's files have them, made identifiers of Python, each its own."""

from __future__ import annotations

import builtins
import keyword
import re
import unicodedata
from collections.abc import Iterable

from socialmind.agents.agent import Agent
from socialmind.language.refusals import MODULES
from socialmind.model import Model
from socialmind.society.population import TAKEN_NAMES
from socialmind.society.table import Table
from socialmind.terrain import Ground
from socialmind.worlds.grid.geometry import COMMANDS
from socialmind.worlds.grid.one_per_patch import OnePerPatch
from socialmind.worlds.grid.patches import TAKEN_NAMES as PATCH_NAMES

TAKEN_BY_AGENTS = frozenset(
    (*dir(Table), *TAKEN_NAMES, *Agent.__annotations__, "civilisation", "l", "plan_step", "stride")
)
"""What a field of an agent cannot be called."""
TAKEN_BY_MODELS = frozenset((*dir(Model), "humans", "messages", "world"))
"""What a parameter or a population cannot be called."""
TAKEN_BY_PATCHES = frozenset(
    (*dir(OnePerPatch), *PATCH_NAMES, *COMMANDS, *Ground.__annotations__, *["x", "y", "terrain"])
)
"""What a field of patches cannot be called."""
TAKEN_BY_FILES = [
    "human",
    "model",
    "rng",
    "child",
    "other",
    "own",
    "patch",
    "here",
    "group",
    "spot",
    "most",
    "many",
    "message",
    "live",
    "begin",
    "create_founders",
    "strengthen",
    "come_to",
    "go_to",
    "in_reach",
    "living",
    "is_asked_for",
    "is_attacked",
    "ask_around",
    "is_stranger",
    "nearest_of_group",
    "give_birth",
    "any_facility_here",
    "come_into_being",
    "step_ahead",
    "step_towards",
    "wear_off",
    "renew",
    "clear",
    "lay_ground",
    "pass_away",
    "build_private",
    "build_for_group",
    "each",
    "once",
    "parameter",
    "sequence",
    "repeat",
    "when",
    "until",
    "place_around",
    "math",
    "Agent",
    "Civilisation",
    "Facility",
    "Grid",
    "Ground",
    "Human",
    "Land",
    "Looks",
    "Message",
    "Messages",
    "Model",
    "Patch",
    "Population",
    "Request",
    "LEAST_VALUE",
    "SMELL",
    "ATTACK",
    "TRADE",
    "HIRING",
    "MADE",
    "MET",
    "SERVED",
    "EASIEST",
    "PASSABILITY",
    "IMPASSABLE",
    "PERIOD",
    "TERRAINS",
    "clear_ownerless",
    "clear_deserted",
]
"""What nothing of a file can be called but what it stands for."""


def identifier(name: str) -> str:
    """Return a name in small letters, digits and lines below, as Python has names.

    >>> identifier("Quantité de Blé"), identifier("AvanceAleatoire"), identifier("2 houes")
    ('quantite_de_ble', 'avance_aleatoire', 'n2_houes')
    """
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", plain)
    made = re.sub(r"[^a-z0-9]+", "_", parted.lower()).strip("_") or "unnamed"
    return f"n{made}" if made[0].isdigit() else made


def class_name(name: str) -> str:
    """Return a name as that of a class.

    >>> class_name("one_plan"), class_name("cereales-artisanat-vin2(v2.0)")
    ('OnePlan', 'CerealesArtisanatVin2V20')
    """
    return "".join(part[:1].upper() + part[1:] for part in identifier(name).split("_"))


def plural(name: str) -> str:
    """Return what several of a thing are called, in English and French alike.

    >>> plural("maison"), plural("bois"), plural("hutte_de_chef")
    ('maisons', 'bois', 'huttes_de_chef')
    """
    first, *more = name.split("_", 1)
    many = first if first[-1] in "sxz" else f"{first}s"
    return "_".join((many, *more))


class Names:
    """The names of one namespace: no two things have the same.

    Args:
        taken: names that nothing may have.
    """

    def __init__(self, taken: Iterable[str]) -> None:
        self._others = frozenset((*taken, *keyword.kwlist, *dir(builtins), *MODULES))
        self._taken = set(self._others)

    def own(self, *wanted: str) -> str:
        """Return the first of some names that is free, and take it.

        >>> names = Names(["die"])
        >>> names.own("or"), names.own("die", "die_carried"), names.own("corn"), names.own("corn")
        ('or_', 'die_carried', 'corn', 'corn_2')
        """
        last = wanted[-1]
        for name in (*wanted, *([f"{last}_"] if last in self._others else [])):
            if name not in self._taken:
                self._taken.add(name)
                return name
        number = 2
        while f"{last}_{number}" in self._taken:
            number += 1
        return self.own(f"{last}_{number}")
