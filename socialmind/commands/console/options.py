"""Options that several commands take, each said once."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Annotated, Any

import typer

from socialmind.commands.console.whole_option import LARGEST_SEED, whole
from socialmind.errors import SocialmindError

FROM_0: dict[str, Any] = {"metavar": "N", "parser": whole(0)}
FROM_1: dict[str, Any] = {"metavar": "N", "parser": whole(1)}
SEED: dict[str, Any] = {"metavar": "N", "parser": whole(0, LARGEST_SEED)}
"""Options that are whole numbers, from 0, from 1, and of a seed: 0 … 2⁶⁴ − 1."""

_MODEL = typer.Argument(metavar="MODEL", help="A model's name, or its folder.")
Model = Annotated[str, _MODEL]
ModelUnlessResumed = Annotated[str | None, _MODEL]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A run's folder.", show_default=False)]
Parameters = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Value of a parameter; may be repeated."),
]
Minds = Annotated[
    list[str] | None,
    typer.Option(metavar="[POPULATION=]DIR", help="Hierarchy of skills in place of the model's."),
]
Seed = Annotated[int | None, typer.Option(**SEED, help="Seed of every draw (0).")]
Workers = Annotated[
    int | None, typer.Option(**FROM_1, help="How many work side by side (one a core).")
]
Source = Annotated[
    str | None,
    typer.Option(metavar="kept", help="Take the copies of the model's source that the run keeps."),
]
Out = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Folder to make (a fresh one under runs/).")
]
Trust = Annotated[
    bool, typer.Option("--trust", help="Run programs that you have neither named nor run before.")
]
Quiet = Annotated[bool, typer.Option("--quiet", help="Say nothing but the result.")]


def seen(quiet: bool) -> bool | None:
    """Whether a bar is shown: where somebody looks, unless the command is to be quiet."""
    return False if quiet else None


def is_kept(source: str | None) -> bool:
    """Whether a run's own copies are asked for."""
    if source not in (None, "kept"):
        raise SocialmindError(f"--source {source}; expected kept, the run's own copies")
    return source == "kept"


def refuse_with_resume(context: typer.Context, what: str, taken: Collection[str]) -> None:
    """Refuse what was given beside `--resume` and is settled since the start.

    Args:
        context: of the command.
        what: a run, or a training.
        taken: the parameters that the command takes all the same.

    Raises:
        SocialmindError: another one was given.
    """
    refuse_beside(context, "--resume", what, taken)


def refuse_beside(context: typer.Context, option: str, what: str, taken: Collection[str]) -> None:
    """Refuse what was given beside an option that settles it; arguments as above.

    Raises:
        SocialmindError: another one was given.
    """
    given = [
        one.opts[0] if one.opts[0].startswith("-") else one.opts[0].upper()
        for one in context.command.params
        if one.name not in taken and context.params[str(one.name)] not in (None, [], ())
    ]
    if given:
        raise SocialmindError(
            f"{option} with {', '.join(given)}: a {what} keeps what it was started with; "
            f"leave it out, or start another {what}"
        )
