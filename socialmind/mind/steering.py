"""The hierarchies of skills of a model's populations, read and laid out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from socialmind.errors import SocialmindError
from socialmind.mind.description import MindDescription
from socialmind.mind.evaluation.arrays import Assembly, assemble, master_of
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.modules import Skill


class Steered(Protocol):
    """What is asked of a population; `socialmind.Population` has it."""

    body: Any
    actuators: Any
    hierarchy: Any
    master: Any
    drive: Any


@dataclass(frozen=True)
class Steering:
    """Who steers the agents of a population: a mind, its master skill and its drive module.

    Wherever a model takes a mind, it takes one of these.

    Attributes:
        mind: a mind's folder, its YAML file, or a `MindDescription`.
        master: the name of the master skill; None for the population's own, or the only one that
            no other skill influences.
        drive: a drive module (thesis, 5.1.3); None for the population's own.
    """

    mind: str | Path | MindDescription
    master: str | None = None
    drive: Callable[..., None] | None = None

    @property
    def assembly(self) -> Assembly:
        """The mind laid out in arrays.

        Raises:
            ModelError: it has no such master, or several to choose from.
        """
        if not isinstance(self.mind, MindDescription):
            return Steering(MindDescription.load(self.mind), self.master, self.drive).assembly
        return assemble(self.mind, master_of(self.mind, self.master), self.drive is not None)


def _idle(name: str, population: Steered) -> MindDescription:
    """Return a mind that reads nothing and commands 0.5."""
    if population.body is None:
        raise SocialmindError(
            f"no hierarchies for {name!r}, whose agents are no robots; only those are steered "
            "from outside"
        )
    actuators = list(population.actuators)
    outputs = [f"MO:{one}" for one in actuators]
    idle = Skill("Idle", [], outputs, Perceptron(layers=0), [0.5] * len(outputs))
    return MindDescription("idle", [], actuators, skills=[idle])


def steerings_of(
    populations: Mapping[str, Steered],
    folder: Path,
    given: Any,
    name: str,
    load: Callable[[Path], MindDescription] = MindDescription.load,
) -> dict[str, Steering]:
    """Read the hierarchies of a model's populations.

    Args:
        populations: the model's.
        folder: the model's, which names of files are relative to.
        given: a mind in place of the model's own: a folder, a YAML file, a `MindDescription`, a
            `Steering`; or a mapping from populations to these; or False for robots that are
            steered from outside, whose minds do nothing.
        name: the model's name, for errors.
        load: reads a mind's folder or file.

    Raises:
        SocialmindError: a mind is given for a model that has none, or several.
        ModelError: a mind's files are wrong.
    """
    minded = {key: one for key, one in populations.items() if one.hierarchy is not None}
    if given is False:
        return {key: Steering(_idle(key, one)) for key, one in minded.items()}
    if given is not None and not isinstance(given, Mapping):
        if len(minded) != 1:
            raise SocialmindError(
                f"a hierarchy for {name}, which has {len(minded)} populations with hierarchies; "
                f"give a mapping from {', '.join(minded) or 'their names'}"
            )
        given = {next(iter(minded)): given}
    for key in given or {}:
        if key not in minded:
            raise SocialmindError(
                f"a hierarchy for {key!r}, which has none; "
                f"{name} has {', '.join(minded) or 'no populations with hierarchies'}"
            )
    steerings = {}
    for key, one in minded.items():
        source: Any = (given or {}).get(key, one.hierarchy)
        master, drive = one.master, one.drive
        if isinstance(source, Steering):
            master, drive = source.master or master, source.drive or drive
            source = source.mind
        if not isinstance(source, MindDescription | str | Path):
            raise SocialmindError(
                f"the hierarchy of {key!r} in {name}: found {source!r}; expected a mind's folder, "
                "its YAML file, or a MindDescription"
            )
        if not isinstance(source, MindDescription):
            own = given is None or key not in given
            source = load(folder / source if own else Path(source).expanduser())
        steerings[key] = Steering(source, master, drive)
    return steerings
