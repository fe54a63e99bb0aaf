"""Bars that say how far work has come, with its pace and the time left, where somebody looks.

tqdm draws them: on a terminal, in Jupyter with or without widgets, and in marimo as marimo's own.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

Told = Callable[[int, int], None]
"""Is given what is done, and how much there is."""
BAR = (
    "{desc}{n_fmt} of {total_fmt}{unit} |{bar}| {percentage:.0f} %, {rate_noinv_fmt}, "
    "{remaining} left"
)
WORDS = "{desc}"
WAIT = 0.5
"""Seconds that work may take before a bar is drawn."""
INTERVAL = 0.1
"""Seconds between two drawings of a bar."""
NARROW = (80, 24)
"""Columns and rows of a terminal that says nothing of its size."""
LARGE = 1_000_000
"""Such numbers are shortened."""


@contextmanager
def progress_bar(
    progress: bool | None, unit: str, kind: str, told: Told | None = None
) -> Iterator[Told | None]:
    """A bar with what is done a second and the time left.

    Args:
        progress: whether one is drawn; None where somebody looks, and no caller is told.
        unit: what is counted.
        kind: what runs, by which the time that compiling takes is remembered.
        told: the caller's own, who is told as well.

    Yields:
        Who is to be told; None where nobody looks. Where no bar is wanted, somebody who shows
        nothing is told, so that whoever is called with it draws none of its own.
    """
    drawn = None if progress is None and told is not None else _drawn_by(progress)
    if drawn is None:
        yield _nobody if told is None and progress is False else told
        return
    from socialmind.work.compile_times import told_of_compiling

    bar = _Bar(drawn, BAR, f" {unit}")

    def tell(done: int, length: int) -> None:
        bar.tell(done, length)
        if told is not None:
            told(done, length)

    with bar, told_of_compiling(kind, bar.say):
        yield tell


def _nobody(done: int, length: int) -> None:
    """Hear what is done, and show nothing."""


@contextmanager
def progress_line(
    progress: bool | None, kind: str, idle: str
) -> Iterator[Callable[[str, int, int], None] | None]:
    """A line of words that change; where only bars can be drawn, a bar.

    Args:
        progress: whether one is shown; None where somebody looks.
        kind: what runs, by which the time that compiling takes is remembered.
        idle: the words while there is no news after compiling.

    Yields:
        What takes the words, what is done, and how much there is; None where nobody looks.
    """
    drawn = _drawn_by(progress)
    if drawn is None:
        yield None
        return
    from socialmind.work.compile_times import told_of_compiling

    bar = _Bar(drawn, WORDS, "")

    def tell(words: str, done: int, length: int) -> None:
        if bar.takes_words:
            bar.say(words)
        else:
            bar.tell(done, length)

    with bar, told_of_compiling(kind, lambda said: bar.say(said or idle)):
        yield tell


def _drawn_by(progress: bool | None) -> Any:
    """Return the class of bars that can be seen here; None where nobody looks."""
    if progress is False:
        return None
    marimo: Any = sys.modules.get("marimo")
    if marimo is not None and marimo.running_in_notebook():
        from tqdm import notebook

        return notebook.tqdm  # in whose place marimo puts its own
    ipython: Any = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    if getattr(shell, "kernel", None) is not None:
        with warnings.catch_warnings():  # without ipywidgets it draws with characters
            warnings.simplefilter("ignore")
            from tqdm import autonotebook

        return autonotebook.tqdm
    if progress or sys.stderr.isatty():
        from tqdm import std

        return std.tqdm
    return None


def _width() -> dict[str, Any]:
    """Return how wide tqdm draws: as the terminal is, unless it says that it is 0 wide."""
    if sys.stderr.isatty():
        with suppress(OSError, ValueError):
            if os.get_terminal_size(sys.stderr.fileno()).columns == 0:
                return {"ncols": NARROW[0], "nrows": NARROW[1]}
    return {"dynamic_ncols": True}


class _Bar:
    """One bar, made when there is something to show.

    Args:
        drawn: the class of tqdm, or of marimo, that draws it.
        looks: how, in tqdm's words.
        unit: of what is counted.
    """

    def __init__(self, drawn: Any, looks: str, unit: str) -> None:
        self._drawn, self._looks, self._unit = drawn, looks, unit
        self._bar: Any = None
        self._done = 0
        self._length: int | None = None

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *error: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def tell(self, done: int, length: int) -> None:
        """Show how much is done of how much."""
        if self._bar is None:
            self._make(done, length)
        elif self._length != length:
            self._set_total(done, length)
        self._bar.update(done - self._done)
        self._done = done

    def say(self, words: str) -> None:
        """Show words; none, to take them away."""
        if self._bar is None and self.takes_words:
            self._make(0, None)
        if self.takes_words:
            self._bar.set_description_str(f"{words}  " if words else "")

    @property
    def takes_words(self) -> bool:
        """Whether it is tqdm's own; marimo's shows no words."""
        return hasattr(self._drawn, "set_description_str")

    def _make(self, done: int, length: int | None) -> None:
        self._done, self._length = done, length
        if self.takes_words:
            self._bar = self._drawn(
                total=length, initial=done, unit=self._unit, unit_scale=(length or 0) >= LARGE,
                bar_format=self._looks, delay=WAIT, leave=False, mininterval=INTERVAL,
                file=sys.stderr, **_width(),
            )  # fmt: skip
        else:
            self._bar = self._drawn(total=length)
            self._done = 0

    def _set_total(self, done: int, length: int) -> None:
        """Take another length; while there was none, the time was that of compiling."""
        if not self.takes_words:
            self._bar.close()
            self._make(done, length)
            return
        self._length = length
        bar, begin = self._bar, None if self._bar.total is None else self._bar.start_t
        bar.reset(total=length)
        bar.initial, bar.n, bar.unit_scale = (done, done, length >= LARGE)
        if begin is not None:
            bar.start_t, bar.initial = begin, 0
        self._done = done
