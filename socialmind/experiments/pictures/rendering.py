"""Pictures and films of runs on a plane.

A run's folder records numbers now and then; a picture needs all of a moment: what each sensor saw,
what each skill sent. So the run is repeated from its seed, parameters and minds, tick by tick.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.pictures import film
from socialmind.experiments.pictures.picture_page import Page, Style
from socialmind.experiments.pictures.repeating import Progress, Repeated
from socialmind.names import several
from socialmind.runs.capsule import Capsule

STILLS = (".svg", ".pdf", ".png")
"""How the files of pictures end."""
FRAMES = {".mp4": 900, ".gif": 300}
"""How many frames a film has at most, unless it is said how many ticks lie between two."""
FPS = {".mp4": 30.0, ".gif": 20.0}
"""Frames a second."""
PLAIN = Style()


def draw_moments(
    folder: str | Path,
    out: str | Path,
    ticks: Sequence[int] = (),
    style: Style = PLAIN,
    on_progress: Progress | None = None,
    captions: Sequence[str] = (),
    trust: bool = False,
    kept: bool = False,
) -> Path:
    """Draw moments of a run, one below the other, with the path up to each.

    Args:
        folder: the run's.
        out: the file, which ends in .svg, .pdf or .png.
        ticks: of the moments, ascending; the last one of the run by default.
        style: how.
        on_progress: called with the ticks done and the length.
        captions: what is said above each moment; nothing by default.
        trust: run programs that this user has neither named nor run before.
        kept: take the copies of the model's source that the run keeps.

    Returns:
        The file.

    Raises:
        SocialmindError: the run cannot be repeated, or its world is no plane; a tick that the run
            has not done; no such robot; more or fewer captions than moments.
    """
    path = Path(out)
    if path.suffix.lower() not in STILLS:
        raise SocialmindError(f"{path}: found {path.suffix!r}; expected {' or '.join(STILLS)}")
    capsule = Capsule(folder)
    done = capsule.manifest.ticks_done
    wanted = sorted(set(ticks)) or [done]
    for tick in wanted:
        _check_tick(tick, "tick", done)
    captions = several(captions, "captions")
    if captions and len(captions) != len(wanted):
        raise SocialmindError(f"{len(captions)} captions; expected one for each of {len(wanted)}")
    repeated = Repeated(capsule, style.robot, style.mind, trust, kept)
    with paper.style():
        page = Page(repeated, style, path.suffix.lower(), len(wanted), captions)
        for _ in repeated.at(wanted, on_progress):
            page.draw()
        path.parent.mkdir(parents=True, exist_ok=True)
        page.save(path)
    return path


def draw_steps(
    folder: str | Path,
    out: str | Path,
    ticks: Sequence[int],
    style: Style,
    captions: Sequence[str],
    rows: int = 2,
) -> list[Path]:
    """Draw moments of a run as figures of a paper, some on a page.

    Args:
        folder: the run's.
        out: the first file without its suffix; where there is more than one page, the others have
            ``-2`` and so on behind it.
        ticks: of the moments, ascending.
        style: how.
        captions: what is said above each moment.
        rows: moments on a page.

    Returns:
        For each page a PDF and a PNG.

    Raises:
        SocialmindError: as for `draw_moments`.
    """
    written = []
    style = replace(style, rows=rows)  # on the last page they are as large as on the others
    for number, begin in enumerate(range(0, len(ticks), rows), 1):
        page = f"{out}-{number}" if number > 1 else str(out)
        part = slice(begin, begin + rows)
        written += [
            draw_moments(folder, f"{page}{suffix}", ticks[part], style, captions=captions[part])
            for suffix in (".pdf", ".png")
        ]
    return written


def film_run(
    folder: str | Path,
    out: str | Path,
    begin: int = 0,
    end: int | None = None,
    every: int | None = None,
    fps: float | None = None,
    style: Style = PLAIN,
    on_progress: Progress | None = None,
    trust: bool = False,
    kept: bool = False,
) -> Path:
    """Make a film of a run.

    Args:
        folder: the run's.
        out: the file, which ends in .mp4 or .gif.
        begin: the first tick shown.
        end: the last one; that of the run by default. Where an interruption ends the episode
            before, the film ends too.
        every: ticks between two frames, 1 or more; by default so many that there are at most 900
            frames, 300 of a GIF. The last tick is always shown.
        fps: frames a second; 30 by default, 20 of a GIF.
        style: how.
        on_progress: called with the ticks done and the length.
        trust: run programs that this user has neither named nor run before.
        kept: take the copies of the model's source that the run keeps.

    Returns:
        The file.

    Raises:
        SocialmindError: as for `draw_moments`; or there is no ffmpeg to write an MP4.
    """
    path = Path(out)
    suffix = path.suffix.lower()
    capsule = Capsule(folder)
    done = capsule.manifest.ticks_done
    last = done if end is None else end
    _check_tick(begin, "from", done)
    _check_tick(last, "to", done)
    if begin > last:
        raise SocialmindError(f"from tick {begin} to {last}; expected a stretch, first tick first")
    if fps is not None and not 0 < fps <= 120:
        raise SocialmindError(f"fps {fps:g}; expected frames a second, above 0 and up to 120")
    if every is not None and every < 1:
        raise SocialmindError(f"every {every}; expected a number of ticks, 1 or more")
    # An unknown kind of file, or a missing ffmpeg, is told before the run is repeated.
    written = film.Film(path, fps or FPS.get(suffix, 30.0))
    step = every or max(1, math.ceil((last - begin) / (FRAMES[suffix] - 1)))
    ticks = sorted({*range(begin, last, step), last})
    repeated = Repeated(capsule, style.robot, style.mind, trust, kept)
    with paper.style(), written:
        page = Page(repeated, style, suffix)
        page.draw()
        for _ in repeated.at(ticks, on_progress):
            frame = page.redraw()
            written.write(frame)
            if repeated.scene.over:
                # Nothing moves any more: a second to see how it ended.
                for _ in range(round(written.fps)):
                    written.write(frame)
                break
    return path


def _check_tick(tick: int, name: str, done: int) -> None:
    if not 0 <= tick <= done:
        raise SocialmindError(
            f"{name} {tick}; expected 0 … {done}, the ticks that the run has done"
        )
