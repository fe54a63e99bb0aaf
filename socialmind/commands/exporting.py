"""`socialmind export-scheme`: schemes of ours as files of MetaCiv's or CogLogo's."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from socialmind.errors import SocialmindError, nearest

if TYPE_CHECKING:
    from coglogo_py import CognitiveScheme
    from socialmind.model import Model

FORMATS = ("metaciv", "cogscheme")
SUFFIXES = (".yaml", ".yml", ".cogscheme")

Known: TypeAlias = "tuple[CognitiveScheme, Mapping[str, float], Mapping[str, float]]"
"""A scheme, what its agents' fields begin with, and what the model's parameters are."""


def export_scheme(
    source: Annotated[
        str,
        typer.Argument(metavar="FILE|MODEL", help="A scheme's file, or a model's name or folder."),
    ],
    format_: Annotated[
        str, typer.Option("--format", metavar="metaciv|cogscheme", help="What to write.")
    ],
    out: Annotated[
        Path,
        typer.Option(
            metavar="DIR|FILE",
            help="Folder of MetaCiv's schemes, or CogLogo's file (of several schemes, a folder).",
        ),
    ],
) -> None:
    """Write a scheme as MetaCiv's or CogLogo's files; say what these cannot hold."""
    if format_ not in FORMATS:
        raise SocialmindError(f"--format {format_}; {nearest(format_, FORMATS)}")
    for population, known in _schemes(source).items():
        write = _write_metaciv if format_ == "metaciv" else _write_cogscheme
        lost, path = write(known, out, population)
        for one in lost:
            typer.echo(f"lost: {one}", err=True)
        typer.echo(path)


def _schemes(source: str) -> dict[str, Known]:
    """Return the schemes that are meant: of a file one, of a model one for each population."""
    from coglogo_py import CognitiveScheme

    path = Path(source).expanduser()
    if path.suffix.lower() in SUFFIXES or (path.is_file() and path.suffix != ".py"):
        if not path.is_file():
            raise SocialmindError(f"{path}: no such file")
        return {"": (CognitiveScheme.load(path), {}, {})}
    from socialmind.catalogue import load_model

    found = _of_model(load_model(source))
    if not found:
        raise SocialmindError(f"{source}: none of its populations has a cognitive scheme")
    return found if len(found) > 1 else {"": next(iter(found.values()))}


def _of_model(model_class: type[Model]) -> dict[str, Known]:
    from coglogo_py import CognitiveScheme

    parameters = {
        name: float(one.default)
        for name, one in model_class.parameters.items()
        if not isinstance(one.default, str)
    }
    found: dict[str, Known] = {}
    for name, population in model_class.populations.items():
        scheme = population.mind
        if scheme is None:
            continue
        if not isinstance(scheme, CognitiveScheme):
            place = model_class.folder() / scheme
            scheme = CognitiveScheme.load(place, population.decision_makers)
        fields = model_class.shape.populations[name].fields.values()
        starts = {
            one.name: float(one.default)
            for one in fields
            if isinstance(one.default, int | float)  # neither an array nor none
        }
        found[name] = (scheme, starts, parameters)
    return found


def _write_metaciv(known: Known, out: Path, population: str) -> tuple[tuple[str, ...], Path]:
    """Write a scheme's folder below `out`; return what was lost, and the folder."""
    from socialmind.metaciv.exporting import for_metaciv, scheme_files

    exported = for_metaciv(*known)
    files = scheme_files(exported.scheme)
    folder = out / next(iter(files)).partition("/")[0]
    if folder.exists():
        raise SocialmindError(f"{folder}: is there already; give another folder, or remove it")
    for file, content in files.items():
        (out / file).parent.mkdir(parents=True, exist_ok=True)
        (out / file).write_bytes(content)
    return exported.lost, folder


def _write_cogscheme(known: Known, out: Path, population: str) -> tuple[tuple[str, ...], Path]:
    """Write CogLogo's file; return what was lost, and the file."""
    from coglogo_py.files.cogscheme_file import written
    from coglogo_py.files.cogscheme_losses import for_coglogo
    from socialmind.work.files import replace_file

    path = out / f"{population}.cogscheme" if population else out
    if path.suffix.lower() != ".cogscheme":
        raise SocialmindError(f"{path}: found {path.suffix or 'no suffix'}; expected .cogscheme")
    if path.exists():
        raise SocialmindError(f"{path}: is there already; give another file, or remove it")
    scheme, lost = for_coglogo(known[0])
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, written(scheme).encode())
    return lost, path
