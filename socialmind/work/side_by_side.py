"""One function called with many arguments, in other processes, a few at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any

from socialmind.work.workers import Alone, Processes, workers_here


@dataclass(frozen=True, eq=False)
class _Calls:
    """Calls of a function, several to a job; the task and its worker in one."""

    function: Callable[..., Any]

    def worker(self) -> _Calls:
        return self

    def do(self, job: list[tuple[Any, ...]]) -> list[Any]:
        return [self.function(*arguments) for arguments in job]

    def stop(self) -> None:
        """A call that has begun comes to its end."""


def side_by_side(
    function: Callable[..., Any],
    calls: Iterable[tuple[Any, ...]],
    workers: int | None = None,
    together: int = 1,
) -> Iterator[Any]:
    """Call a function with each of many arguments, some at a time, and yield the results in order.

    The results are the same for any number of processes. Calls are taken as results are, so there
    may be more of them than memory holds.

    Args:
        function: of a module that can be imported, or of a file of a model or a study.
        calls: the arguments of each call; plain values, which another process can be told.
        workers: processes; one for each processor by default. With 1 all is done here.
        together: how many calls a process is given at once; several where they are short.

    Yields:
        What each call returns, in the order of the calls.

    Raises:
        SocialmindError: processes were killed again and again.

    >>> list(side_by_side(divmod, [(7, 2), (9, 4)], workers=1))
    [(3, 1), (2, 1)]
    """
    coming = iter(calls)
    jobs = iter(lambda: list(islice(coming, together)), [])
    count = workers_here(workers)
    first = list(islice(jobs, count))
    with Alone() if min(count, len(first)) <= 1 else Processes(len(first)) as hired:
        for results in hired.results(_Calls(function), chain(first, jobs)):
            yield from results
