"""Ctrl-C, heard between two pieces of work rather than in the middle of one."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

STOPS = (signal.SIGINT, signal.SIGTERM)
HEARD = (*STOPS, *([signal.SIGHUP] if hasattr(signal, "SIGHUP") else []))


@contextmanager
def deferred_signals() -> Iterator[list[int]]:
    """Collect Ctrl-C (SIGINT), requests to end (SIGTERM) and closed terminals (SIGHUP) in a block.

    The second one takes effect at once. Outside the main thread, where Python allows no handlers,
    nothing is collected.

    Yields:
        The numbers of the signals that came, a list that the block looks at when it can stop.
    """
    arrived: list[int] = []

    def note(number: int, _frame: object) -> None:
        if arrived:
            raise KeyboardInterrupt
        arrived.append(number)

    if threading.current_thread() is not threading.main_thread():
        yield arrived
        return
    before = {
        number: signal.signal(number, note)
        for number in HEARD
        # Who starts a program with nohup wants the end of the terminal unheard.
        if number in STOPS or signal.getsignal(number) is not signal.SIG_IGN
    }
    try:
        yield arrived
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
