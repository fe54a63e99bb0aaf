"""Saying that a command is compiling, and how long that usually takes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from hashlib import sha256
from typing import Any

from numba.core.event import Listener, install_listener

from coglogo_py.compiled import code_folder

TYPICAL = "10 to 60 s"
"""How long it takes where nothing was measured yet."""
WORTH_SAYING = 1.0
"""Seconds of compiling from which on the time is remembered."""


@contextmanager
def told_of_compiling(kind: str, say: Callable[[str], None]) -> Iterator[None]:
    """Say when compiling begins, and "" when it is over; remember how long it took.

    Args:
        kind: what is compiled; the time is remembered for it.
        say: is given the words.
    """
    listener = _Compiling(say, usual_time(kind))
    with install_listener("numba:compile", listener):
        yield
    if listener.seconds >= WORTH_SAYING:
        code_folder.keep("times", _name(kind), f"{listener.seconds:.1f}".encode())


def usual_time(kind: str) -> str:
    """Return how long compiling took the last time, or takes typically, in words."""
    kept = code_folder.read("times", _name(kind))
    return TYPICAL if kept is None else f"{max(1, round(float(kept)))} s"


def _name(kind: str) -> str:
    return sha256(kind.encode()).hexdigest()[:24]


class _Compiling(Listener):
    """Hears of every function that numba compiles; those within another count with it."""

    def __init__(self, say: Callable[[str], None], usual: str) -> None:
        self.seconds = 0.0
        self._say = say
        self._usual = usual
        self._depth = 0
        self._began = 0.0

    def on_start(self, event: Any) -> None:
        """Take down that a function is being compiled."""
        if self._depth == 0:
            self._began = time.perf_counter()
            self._say(f"compiling once, usually {self._usual}")
        self._depth += 1

    def on_end(self, event: Any) -> None:
        """Take down that it is compiled."""
        self._depth -= 1
        if self._depth == 0:
            self.seconds += time.perf_counter() - self._began
            self._say("")
