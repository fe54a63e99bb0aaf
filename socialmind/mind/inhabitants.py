"""The hierarchies of skills of a model's populations, read and laid out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.mind.arrays import Assembly, assemble, master_of
from socialmind.mind.description import MindDescription

if TYPE_CHECKING:
    from socialmind.population import Population


def assemblies_of(
    populations: Mapping[str, Population], folder: Path, given: Any, name: str
) -> dict[str, Assembly]:
    """Read the hierarchies of a model's populations and lay them out.

    Args:
        populations: the model's.
        folder: the model's, which names of files are relative to.
        given: a mind in place of the model's own: a folder, a YAML file, a `MindDescription`; or
            a mapping from populations to these.
        name: the model's name, for errors.

    Raises:
        SocialmindError: a mind is given for a model that has none, or several.
        ModelError: a mind's files are wrong.
    """
    minded = {key: one for key, one in populations.items() if one.hierarchy is not None}
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
    assemblies = {}
    for key, one in minded.items():
        source: Any = (given or {}).get(key, one.hierarchy)
        if not isinstance(source, MindDescription | str | Path):
            raise SocialmindError(
                f"the hierarchy of {key!r} in {name}: found {source!r}; expected a mind's folder, "
                "its YAML file, or a MindDescription"
            )
        if not isinstance(source, MindDescription):
            own = given is None or key not in given
            source = MindDescription.load(folder / source if own else Path(source).expanduser())
        master = master_of(source, one.master)
        assemblies[key] = assemble(source, master, one.drive is not None)
    return assemblies
