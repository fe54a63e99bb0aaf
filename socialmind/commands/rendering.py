"""`socialmind render`: pictures and films of runs on a plane."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from socialmind.commands.running import progress_bar
from socialmind.drawing.look import LOOKS
from socialmind.errors import SocialmindError
from socialmind.experiments.pictures.film import SUFFIXES
from socialmind.experiments.pictures.picture_page import Style
from socialmind.experiments.pictures.rendering import STILLS, draw_moments, film_run
from socialmind.experiments.pictures.repeating import Name


def render(
    folder: Path,
    out: Path,
    ticks: Sequence[int],
    begin: int | None,
    end: int | None,
    every: int | None,
    fps: float | None,
    look: str | None,
    mind: bool,
    agent: str | None,
    around: float | None,
    trail: int | None,
    width: int | None,
    quiet: bool,
    trust: bool = False,
    kept: bool = False,
) -> Path:
    """Draw moments of a run, or film a stretch of it; the options of `socialmind render`.

    Raises:
        SocialmindError: an option that the kind of file does not take, or a wrong value.
    """
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
    unfit = {"--tick": ticks or None} if suffix in SUFFIXES else filmed
    given = [name for name, value in unfit.items() if value is not None]
    if given:
        other = "a picture (.svg, .pdf, .png)" if suffix in SUFFIXES else "a film (.mp4, .gif)"
        raise SocialmindError(f"{', '.join(given)} with {out.name}; only {other} takes that")
    style = Style(look, mind, None if agent is None else robot_named(agent), around, trail, width)
    with progress_bar(quiet) as on_progress:
        if suffix in STILLS:
            return draw_moments(folder, out, ticks, style, on_progress, trust=trust, kept=kept)
        return film_run(folder, out, begin or 0, end, every, fps, style, on_progress, trust, kept)


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
