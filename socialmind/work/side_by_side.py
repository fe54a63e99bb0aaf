"""A study's runs in other processes: one function, called with many arguments side by side.

What comes out is the same for any number of processes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.learning.episodes.evaluators import cores
from socialmind.work.importable import found, referred
from socialmind.work.processes import dismiss, pool

LOST = "a worker's process was ended; is there memory enough? fewer workers need less"
"""What is said when another process is gone without a word."""
WAITING = 2
"""Calls that each process has before it, so that none is ever idle."""


def side_by_side(
    function: Callable[..., Any], calls: Sequence[tuple[Any, ...]], workers: int | None = None
) -> Iterator[Any]:
    """Call a function with each of many arguments, some at a time, and yield the results in order.

    Args:
        function: of a module that can be imported, or of a file of a model or a study.
        calls: the arguments of each call; plain values, which another process can be told.
        workers: processes; one for each processor by default. With 1 all is done here.

    Yields:
        What each call returns, in the order of the calls.

    Raises:
        SocialmindError: a process was killed.

    >>> list(side_by_side(divmod, [(7, 2), (9, 4)], workers=1))
    [(3, 1), (2, 1)]
    """
    count = min(workers or cores(), len(calls))
    if count <= 1:
        for arguments in calls:
            yield function(*arguments)
        return
    hired = pool(count)
    try:
        reference = referred(function)
        waiting = [hired.submit(_called, reference, one) for one in calls[: WAITING * count]]
        for place in range(len(calls)):
            yield waiting.pop(0).result()
            following = place + WAITING * count
            if following < len(calls):
                waiting.append(hired.submit(_called, reference, calls[following]))
    except BrokenExecutor:
        raise SocialmindError(LOST) from None
    finally:
        dismiss(hired)


def _called(reference: Any, arguments: tuple[Any, ...]) -> Any:
    return found(reference)(*arguments)
