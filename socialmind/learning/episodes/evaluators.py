"""Who judges individuals: threads here, processes here, or a Dask cluster.

What comes out is the same for all of them, and for any number of workers.
"""

from __future__ import annotations

import os
import queue
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.learning.episodes.evaluation import (
    PYMUNK,
    Genomes,
    Ground,
    Judged,
    PackedGround,
    Piece,
    judged,
    judged_elsewhere,
    pieces_of,
)
from socialmind.mind.modules import Skill
from socialmind.work.processes import dismiss, pool

LOOK_SECONDS = 0.2
"""How long it may take until a wish to stop is heard."""
LOST_AGAIN = 5
"""How often what a lost worker had in hand is done again before it counts as the task's fault."""
LANES = 64
"""How many episodes the compiled engine runs side by side; fewer in a piece would leave it idle."""

Stop = Callable[[], bool]


class Stopped(Exception):  # noqa: N818  # no error
    """The user wants to stop: what was in hand is dropped."""


class MissingDaskError(SocialmindError, ImportError):
    """The library `distributed` is not installed."""


class Workers(ABC):
    """Workers who judge a generation together.

    Subclasses say how many they are, and how a list of pieces is judged.
    """

    @property
    @abstractmethod
    def count(self) -> int:
        """How many they are at this moment."""

    @abstractmethod
    def judge_pieces(self, ground: Ground, pieces: list[Piece], stop: Stop) -> list[Judged]:
        """Return what came of each piece, in order."""

    @abstractmethod
    def close(self) -> None:
        """Let them go."""

    def cut(self, individuals: int, worlds: int) -> int:
        """Return into how many pieces so much work is cut, a few for each worker."""
        return 4 * self.count

    def judge(
        self,
        ground: Ground,
        genomes: Genomes | Sequence[Skill],
        seeds: Sequence[int],
        stop: Stop = lambda: False,
    ) -> Judged:
        """Judge all individuals on the same worlds.

        Args:
            ground: where.
            genomes: shape (k, genome size); or one skill for each individual.
            seeds: of the worlds.
            stop: asked now and then whether to drop the work.

        Raises:
            Stopped: `stop` said so.
            ModelError: the environment failed.
        """
        pieces = pieces_of(genomes, seeds, self.cut(len(genomes), len(seeds)))
        score = np.zeros((len(genomes), len(seeds)))
        ticks = np.zeros(score.shape, np.int64)
        for piece, one in zip(pieces, self.judge_pieces(ground, pieces, stop), strict=True):
            score[piece.individuals, piece.worlds] = one.score
            ticks[piece.individuals, piece.worlds] = one.ticks
        return Judged(score, ticks)


class Threads(Workers):
    """Threads of this process, for episodes that run in compiled code.

    Args:
        count: how many.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._executor = ThreadPoolExecutor(count)
        self._ground: Ground | None = None
        self._free: queue.SimpleQueue[Any] = queue.SimpleQueue()

    @property
    def count(self) -> int:
        """How many they are."""
        return self._count

    def cut(self, individuals: int, worlds: int) -> int:
        """Return two pieces for each worker, or one where the lanes would not be filled."""
        return self._count * (2 if individuals * worlds >= 4 * LANES * self._count else 1)

    def judge_pieces(self, ground: Ground, pieces: list[Piece], stop: Stop) -> list[Judged]:
        """Return what came of each piece, in order."""
        if ground is not self._ground and not isinstance(pieces[0].genomes, tuple):
            self._free = queue.SimpleQueue()
            for _ in range(self._count):
                self._free.put(ground.episodes())
            self._ground = ground
        futures = [self._executor.submit(self._judged, ground, piece) for piece in pieces]
        try:
            _wait(futures, stop)
        except BaseException:
            # Compiled code cannot be broken off, but what has not begun need not begin.
            for one in futures:
                one.cancel()
            wait(futures)
            raise
        return [one.result() for one in futures]

    def _judged(self, ground: Ground, piece: Piece) -> Judged:
        if isinstance(piece.genomes, tuple):
            return judged(ground, piece)
        episodes = self._free.get()
        try:
            return judged(ground, piece, episodes)
        finally:
            self._free.put(episodes)

    def close(self) -> None:
        """Let them go."""
        self._executor.shutdown(cancel_futures=True)


class Processes(Workers):
    """Processes of this machine, for episodes that run in Python.

    Args:
        count: how many.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._executor = self._started()
        self._packed: tuple[Ground, PackedGround] | None = None

    def _started(self) -> ProcessPoolExecutor:
        return pool(self._count)

    @property
    def count(self) -> int:
        """How many they are."""
        return self._count

    def judge_pieces(self, ground: Ground, pieces: list[Piece], stop: Stop) -> list[Judged]:
        """Return what came of each piece, in order; what a killed process had is done again."""
        if self._packed is None or self._packed[0] is not ground:
            self._packed = (ground, ground.packed())

        def executor() -> Executor:
            return self._executor

        def again() -> None:
            self._executor.shutdown(wait=False, cancel_futures=True)
            self._executor = self._started()

        return _done_elsewhere(executor, again, self._packed[1], pieces, (BrokenExecutor,), stop)

    def close(self) -> None:
        """Let them go, whatever they are at."""
        dismiss(self._executor)


class Cluster(Workers):
    """The workers of a Dask cluster; they need socialmind and the model as here.

    Args:
        address: of its scheduler, such as `tcp://10.0.0.5:8786`.

    Raises:
        SocialmindError: `distributed` is not installed, or nobody answers.
    """

    def __init__(self, address: str) -> None:
        try:
            distributed: Any = import_module("distributed")
        except ImportError:
            raise MissingDaskError(
                "a cluster needs Dask: pip install 'socialmind[cluster]'"
            ) from None
        try:
            self._client = distributed.Client(address, set_as_default=False)
        except (OSError, ValueError) as error:
            raise SocialmindError(f"{address}: no Dask scheduler answers ({error})") from None
        self._executor: Executor = self._client.get_executor(pure=False, retries=LOST_AGAIN)
        self._lost = (distributed.KilledWorker, CancelledError)
        self._packed: tuple[Ground, PackedGround] | None = None

    @property
    def count(self) -> int:
        """How many threads its workers have now, 1 at least."""
        return max(1, sum(self._client.ncores().values()))

    def judge_pieces(self, ground: Ground, pieces: list[Piece], stop: Stop) -> list[Judged]:
        """Return what came of each piece, in order; what a killed worker had is done again."""
        if self._packed is None or self._packed[0] is not ground:
            self._packed = (ground, ground.packed())
        return _done_elsewhere(
            lambda: self._executor, lambda: None, self._packed[1], pieces, self._lost, stop
        )

    def close(self) -> None:
        """Let them go; the cluster stays."""
        self._executor.shutdown(wait=False)
        self._client.close()


def _done_elsewhere(
    executor: Callable[[], Executor],
    again: Callable[[], None],
    packed: PackedGround,
    pieces: list[Piece],
    lost: tuple[type[BaseException], ...],
    stop: Stop,
) -> list[Judged]:
    """Have pieces judged in other processes; those of lost workers once more.

    Args:
        executor: gives what runs them.
        again: called after workers were lost.
        packed: where.
        pieces: whom, and on which worlds.
        lost: the errors that say that a worker was lost.
        stop: asked now and then whether to drop the work.
    """
    done: dict[int, Judged] = {}
    for _ in range(LOST_AGAIN + 1):
        futures: dict[int, Future[Judged]] = {}
        try:
            for number, piece in enumerate(pieces):
                if number not in done:
                    futures[number] = executor().submit(judged_elsewhere, packed, piece)
            _wait(list(futures.values()), stop)
        except lost:  # a worker died while the others were given their pieces
            pass
        except BaseException:
            for one in futures.values():
                one.cancel()
            raise
        for number, future in futures.items():
            try:
                done[number] = future.result()
            except lost:
                continue
        if len(done) == len(pieces):
            return [done[number] for number in range(len(pieces))]
        again()
    raise SocialmindError(
        f"workers were lost {LOST_AGAIN + 1} times in one generation; is there memory enough?"
    )


def _wait(futures: Sequence[Future[Any]], stop: Stop) -> None:
    """Wait until all is done or one has failed.

    Raises:
        Stopped: `stop` said so.
    """
    waiting = set(futures)
    while waiting:
        finished, waiting = wait(waiting, LOOK_SECONDS, "FIRST_EXCEPTION")
        if stop():
            raise Stopped
        for one in finished:
            error = None if one.cancelled() else one.exception()
            if error is not None:
                raise error


def cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def hired(engine: str, count: int | None = None, cluster: str | None = None) -> Iterator[Workers]:
    """Have workers for a while.

    Args:
        engine: of the episodes: threads for `compiled`, processes for `pymunk`.
        count: how many; one for each processor by default.
        cluster: the address of a Dask scheduler, whose workers it is then.

    Raises:
        SocialmindError: nobody answers there, or a number of workers below 1.
    """
    if count is not None and count < 1:
        raise SocialmindError(f"{count} workers; expected 1 or more")
    if cluster is not None:
        if count is not None:
            raise SocialmindError("workers and a cluster; a cluster has its own, give one of both")
        workers: Workers = Cluster(cluster)
    elif engine == PYMUNK:
        workers = Processes(count or cores())
    else:
        workers = Threads(count or cores())
    try:
        yield workers
    finally:
        workers.close()
