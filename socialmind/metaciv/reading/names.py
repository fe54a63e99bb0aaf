"""The names that a model declares, gathered before anything is read that uses them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from socialmind.metaciv.reading.record import Record


@dataclass(frozen=True, slots=True)
class WorldNames:
    """What all schemes may name.

    Args:
        records: the files of "objects", "facilities", "terrains", "pheromones", "effects" and
            "civilisations" by name.
        own_actions: the names of the model's own Java classes.
        older: whether the folder is of the format of 2014.
    """

    records: Mapping[str, Mapping[str, Record]]
    own_actions: frozenset[str]
    older: bool


@dataclass(frozen=True, slots=True)
class SchemeNames:
    """What a scheme's own parts may name.

    Args:
        records: the files of "attributes", "constants", "cognitons", "groups" and "plans" by name.
        roles: the roles of each group.
    """

    records: Mapping[str, Mapping[str, Record]]
    roles: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
