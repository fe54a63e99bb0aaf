"""`socialmind import`, and models of MetaCiv's that `socialmind run` runs at once."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.errors import SocialmindError
from socialmind.sources.folders import catalogue, is_metaciv

if TYPE_CHECKING:
    from socialmind.metaciv.findings import Finding

SAID = {"error": "error", "warning": "warning", "unsupported": "not supported"}
"""How lines of findings begin."""


def import_(
    folder: Annotated[
        Path,
        typer.Argument(metavar="FOLDER", help="A model of MetaCiv's: holds parametres.metaciv."),
    ],
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder to make.", show_default=False)],
    strict: Annotated[
        bool, typer.Option("--strict", help="Refuse what is not supported: exit code 2.")
    ] = False,
) -> None:
    """Write a model of MetaCiv's as a model of this toolkit; say all that is odd in it."""
    tell(_imported(folder, out, strict))
    typer.echo(out)


def names_metaciv(model: str) -> bool:
    """Return whether what `run` was given names a folder of MetaCiv's."""
    return model.replace("-", "_") not in catalogue() and is_metaciv(Path(model).expanduser())


@contextmanager
def imported_for_run(model: str, out: Path | None, quiet: bool) -> Iterator[Path]:
    """Make a run's folder that holds the imported model; it goes if the run does not begin.

    Args:
        model: the folder of MetaCiv's.
        out: the run's folder; None for the next free number.
        quiet: say nothing of what is odd but not wrong.

    Yields:
        The run's folder, with the model in `model/`.

    Raises:
        SocialmindError: the model has errors, which were said; or the folder is in use.
    """
    from socialmind.runs.capsule import Capsule
    from socialmind.runs.folders import MANIFEST, OWN_MODEL, make_folder, refuse_unless_free
    from socialmind.runs.sources import files_in
    from socialmind.work.files import remove

    folder = Path(model).expanduser()
    if out is not None:
        refuse_unless_free(out.expanduser())
    with tempfile.TemporaryDirectory(prefix="socialmind-import-") as place:
        findings = _imported(folder, Path(place) / OWN_MODEL, strict=False)
        files = files_in(Path(place))
    if not quiet:
        tell(findings)
    run = make_folder(out, Capsule.HOME, folder.resolve().name, files)
    try:
        yield run
    finally:
        if not (run / MANIFEST).is_file():
            remove(run)


def tell(findings: Iterable[Finding]) -> None:
    """Say on stderr what was found, a line each."""
    for one in findings:
        typer.echo(f"{SAID[one.severity]}: {one}", err=True)


def _imported(folder: Path, out: Path, strict: bool) -> tuple[Finding, ...]:
    from socialmind.metaciv.importing import ImportRefusedError, counted, import_model

    try:
        return import_model(folder, out, strict)
    except ImportRefusedError as error:
        tell(error.findings)
        counts = counted(error.findings)
        raise SocialmindError(f"{folder}: {counts}; nothing was written") from None
