"""`socialmind render`: pictures and films of runs on a plane."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError
from socialmind.work.progress import progress_bar

if TYPE_CHECKING:
    from socialmind.experiments.pictures.repeating import Name


def render(
    folder: options.Folder,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE", help="Film (.mp4, .gif) or picture (.svg, .pdf, .png) to write."
        ),
    ],
    tick: Annotated[
        list[int] | None,
        typer.Option(
            **options.FROM_0, help="Moment of a picture (the last); may be repeated, for rows."
        ),
    ] = None,
    begin: Annotated[
        int | None, typer.Option("--from", **options.FROM_0, help="First tick of a film (0).")
    ] = None,
    end: Annotated[
        int | None, typer.Option("--to", **options.FROM_0, help="Last tick of a film (the run's).")
    ] = None,
    every: Annotated[
        int | None,
        typer.Option(
            **options.FROM_1, help="Ticks between two frames (for 900 frames, 300 of a GIF)."
        ),
    ] = None,
    fps: Annotated[float | None, typer.Option(help="Frames a second (30, 20 for a GIF).")] = None,
    mind: Annotated[
        bool, typer.Option("--mind", help="Draw the robot's hierarchy of skills beside it.")
    ] = False,
    agent: Annotated[
        str | None,
        typer.Option(metavar="[POPULATION=]ID", help="Robot for --mind and --around (the first)."),
    ] = None,
    around: Annotated[
        float | None,
        typer.Option(metavar="DISTANCE", help="Show only what is so near to the robot."),
    ] = None,
    trail: Annotated[
        int | None,
        typer.Option(
            **options.FROM_0 | {"metavar": "TICKS"}, help="Length of the path drawn (all)."
        ),
    ] = None,
    look: Annotated[
        str | None,
        typer.Option(
            metavar="thesis|paper", help="Dark, or on white (films dark, pictures white)."
        ),
    ] = None,
    width: Annotated[
        int | None,
        typer.Option(**options.FROM_1, help="Width in pixels; of SVG and PDF in millimetres."),
    ] = None,
    source: options.Source = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Draw a run on a plane: robots, what they see, where they go; on request their minds."""
    from socialmind.drawing.look import LOOKS
    from socialmind.experiments.pictures.film import SUFFIXES
    from socialmind.experiments.pictures.picture_page import Style
    from socialmind.experiments.pictures.rendering import STILLS, draw_moments, film_run

    suffix = out.suffix.lower()
    if suffix not in (*STILLS, *SUFFIXES):
        raise SocialmindError(
            f"--out {out}: found {suffix or 'no ending'!r}; expected a name that ends in "
            f"{', '.join(SUFFIXES)} for a film, {', '.join(STILLS)} for a picture"
        )
    if look is not None and look not in LOOKS:
        raise SocialmindError(f"--look {look}; expected {' or '.join(LOOKS)}")
    if around is not None and not 0 < around < 1e6:
        raise SocialmindError(f"--around {around:g}; expected a distance, above 0")
    if width is not None and not 20 <= width <= 8192:
        raise SocialmindError(f"--width {width}; expected 20 … 8192")
    filmed = {"--from": begin, "--to": end, "--every": every, "--fps": fps}
    unfit = {"--tick": tick or None} if suffix in SUFFIXES else filmed
    given = [name for name, value in unfit.items() if value is not None]
    if given:
        other = "a picture (.svg, .pdf, .png)" if suffix in SUFFIXES else "a film (.mp4, .gif)"
        raise SocialmindError(f"{', '.join(given)} with {out.name}; only {other} takes that")
    style = Style(look, mind, None if agent is None else robot_named(agent), around, trail, width)
    with progress_bar(options.seen(quiet), "ticks", "run") as on_progress:
        if suffix in STILLS:
            path = draw_moments(
                folder,
                out,
                tick or [],
                style,
                on_progress,
                trust=trust,
                kept=options.is_kept(source),
            )
        else:
            path = film_run(
                folder, out, begin or 0, end, every, fps, style, on_progress, trust,
                options.is_kept(source),
            )  # fmt: skip
    typer.echo(path)


def robot_named(text: str) -> Name:
    """Return the robot that `--agent` names.

    Raises:
        SocialmindError: it is no identity.

    >>> robot_named("3"), robot_named("scouts=0")
    ((None, 3), ('scouts', 0))
    """
    population, _, identity = text.rpartition("=")
    if not identity.isascii() or not identity.isdigit():
        raise SocialmindError(f"--agent {text}; expected an identity, or POPULATION=IDENTITY")
    return population or None, int(identity)
