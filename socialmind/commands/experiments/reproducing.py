"""`socialmind reproduce`: the figures and tables of the thesis, made again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from socialmind.commands.listing import indented
from socialmind.errors import SocialmindError
from socialmind.experiments.studies import reproduce, studies_in, topics


def print_studies() -> None:
    """Print the studies of each topic, with what they show.

    Raises:
        SocialmindError: there are none, or one cannot be loaded.
    """
    for position, (topic, folder) in enumerate(topics().items()):
        if position:
            typer.echo()
        rows = [(study.name, study.about) for study in studies_in(folder)]
        typer.echo("\n".join([topic, *indented(rows)]))


def make(names: Sequence[str], out: Path, quick: bool, kept: bool) -> None:
    """Make studies and print the files that were written.

    Args:
        names: of studies or topics.
        out: the folder for what is made.
        quick: whether smaller versions will do.
        kept: whether they are to be made from results that stand beside the studies.

    Raises:
        SocialmindError: no names, an unknown one, or a study that fails.
    """
    if not names:
        raise SocialmindError("which study? `socialmind reproduce --list` shows them")
    for path in reproduce(names, out, quick, kept):
        typer.echo(path)


def make_overview(names: Sequence[str], out: Path, otherwise: bool) -> None:
    """Write the overview of the thesis's results beside ours, and print its files.

    Args:
        names: of studies; the overview takes none.
        out: the folder.
        otherwise: whether another version of it is asked for; there is none.

    Raises:
        SocialmindError: names or another version are given, or a kept table is missing.
    """
    from socialmind.experiments.overview import write_overview

    if names or otherwise:
        raise SocialmindError(
            "--overview is of all results, from kept tables; expected no names, --quick or --kept"
        )
    for path in write_overview(out):
        typer.echo(path)
