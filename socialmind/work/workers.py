"""Who does many jobs side by side: this thread, threads, processes, or a Dask cluster.

What comes out is the same for all of them, and for any number. Jobs may be without number: they
are taken a few at a time, as the ones before are done.
"""

from __future__ import annotations

import os
import pickle
import tempfile
import threading
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from concurrent import futures
from hashlib import sha256
from importlib import import_module
from typing import Any, Protocol, Self

from coglogo_py.border.numbers import whole_number
from socialmind.errors import ModelError, SocialmindError
from socialmind.work.packing import packed, unpacked
from socialmind.work.processes import LostProcessError, ProcessExecutor

LOOK_SECONDS = 0.2
"""How long it may take until a wish to stop is heard."""
LOST_AGAIN = 5
"""How often a job that a lost worker had is done again before it counts as the job's fault."""
AHEAD = 4
"""Jobs for each worker that are taken before their turn, so that none is ever idle."""

Stop = Callable[[], bool]
Instead = Callable[[Any, BaseException], Any]
"""Gives what comes of a job whose worker was lost: of the job, and the error that says so."""
Job = tuple[int, Any]
"""A job and its number."""


class Stopped(Exception):  # noqa: N818  # no error
    """The user wants to stop: what was in hand is dropped."""


class MissingDaskError(SocialmindError, ImportError):
    """The library `distributed` is not installed."""


class Worker(Protocol):
    """Does one job of a task after another."""

    def do(self, job: Any) -> Any:
        """Do a job and return what came of it."""

    def stop(self) -> None:
        """Drop the job in hand soon; called from another thread."""


class Task(Protocol):
    """What many jobs have in common. It is pickled for other processes."""

    def worker(self) -> Worker:
        """Return a worker, with all that it keeps from one job to the next."""


def never() -> bool:
    """Do not stop."""
    return False


class Workers(ABC):
    """Workers who share out jobs. They are let go at the end of a `with`."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    @property
    @abstractmethod
    def count(self) -> int:
        """How many they are at this moment."""

    @abstractmethod
    def close(self) -> None:
        """Let them go."""

    @abstractmethod
    def in_hand(self) -> list[Any]:
        """Return the jobs that they are at, as far as can be known here."""

    def results(self, task: Task, jobs: Iterable[Any], stop: Stop = never) -> Iterator[Any]:
        """Yield what comes of each job, in the order of the jobs.

        Args:
            task: what the jobs have in common.
            jobs: any number of them.
            stop: asked now and then whether to drop the work.

        Raises:
            Stopped: `stop` said so.
            SocialmindError: a job's workers were lost again and again.
            ModelError: other processes cannot find a part of the task.
        """
        return (result for _, result in self._done(task, jobs, stop, in_order=True))

    def finished(
        self, task: Task, jobs: Iterable[Any], stop: Stop = never, instead: Instead | None = None
    ) -> Iterator[Job]:
        """Yield the number of each job, from 0, and what came of it, as they are done.

        Jobs may be added while others are done: an iterator that has no more is asked again.

        Args:
            task: what the jobs have in common.
            jobs: any number of them.
            stop: asked now and then whether to drop the work.
            instead: gives what comes of a job whose worker was lost; by default it is done again.
        """
        return self._done(task, jobs, stop, False, instead)

    @abstractmethod
    def _done(
        self,
        task: Task,
        jobs: Iterable[Any],
        stop: Stop,
        in_order: bool,
        instead: Instead | None = None,
    ) -> Iterator[tuple[int, Any]]:
        """Yield the number of each job and what came of it."""


class _Pool(Workers):
    """Workers who are given jobs ahead, and may be lost."""

    lost: tuple[type[BaseException], ...] = ()
    """The errors that say that a worker was lost."""

    def __init__(self) -> None:
        self._given: dict[futures.Future[Any], Job] = {}

    def in_hand(self) -> list[Any]:
        """Return the jobs that were given first: they are taken up in this order."""
        return [job for _, job in self._given.values()][: self.count]

    def _done(
        self,
        task: Task,
        jobs: Iterable[Any],
        stop: Stop,
        in_order: bool,
        instead: Instead | None = None,
    ) -> Iterator[tuple[int, Any]]:
        self._take_on(task)
        coming = enumerate(jobs)
        again: list[Job] = []
        losses: Counter[int] = Counter()
        given = self._given = {}
        done: dict[int, Any] = {}
        following = 0
        try:
            while True:
                while len(given) + len(done) < AHEAD * self.count:
                    job = again.pop() if again else next(coming, None)
                    if job is None:
                        break
                    given[self._submit(task, job[1])] = job
                if not given:
                    return
                finished, _ = futures.wait(given, LOOK_SECONDS, futures.FIRST_COMPLETED)
                if stop():
                    raise Stopped
                self._check()
                for future in finished:
                    job = given.pop(future)
                    try:
                        done[job[0]] = future.result()
                    except self.lost as error:
                        self._check()
                        if instead is not None:
                            done[job[0]] = instead(job[1], error)
                        else:
                            _put_back(job, again, losses)
                while done and (not in_order or following in done):
                    number = following if in_order else next(iter(done))
                    yield number, done.pop(number)
                    following += 1
        finally:
            self._drop(given)

    @abstractmethod
    def _submit(self, task: Task, job: Any) -> futures.Future[Any]:
        """Have a job done."""

    @abstractmethod
    def _take_on(self, task: Task) -> None:
        """Make ready for a task's jobs."""

    def _check(self) -> None:  # most are replaced one by one
        """Raise when there is nobody any more to do the work."""

    def _drop(self, given: Iterable[futures.Future[Any]]) -> None:
        """Give up jobs that are not done."""
        for one in given:
            one.cancel()


def _put_back(job: Job, again: list[Job], losses: Counter[int]) -> None:
    """Have a job done again whose worker was lost."""
    losses[job[0]] += 1
    if losses[job[0]] > LOST_AGAIN:
        raise SocialmindError(
            f"a worker's process was ended, {losses[job[0]]} times at the same work; is there "
            "memory enough? fewer workers need less"
        )
    again.append(job)


class Alone(Workers):
    """This thread, that does one job after another as it is asked for what came of them."""

    count = 1

    def __init__(self) -> None:
        self._at: list[Any] = []

    def in_hand(self) -> list[Any]:
        """Return the job in hand, if there is one."""
        return self._at

    def _done(
        self,
        task: Task,
        jobs: Iterable[Any],
        stop: Stop,
        in_order: bool,
        instead: Instead | None = None,
    ) -> Iterator[tuple[int, Any]]:
        worker = task.worker()
        for number, job in enumerate(jobs):
            if stop():
                raise Stopped
            self._at = [job]
            result = worker.do(job)
            self._at = []
            yield number, result

    def close(self) -> None:
        """Nobody is to be let go."""


class Threads(_Pool):
    """Threads of this process, for what runs in compiled code.

    Args:
        count: how many.
    """

    def __init__(self, count: int) -> None:
        super().__init__()
        self._count = count
        self._executor = futures.ThreadPoolExecutor(count)
        self._task: Task | None = None
        self._making = threading.Lock()
        self._free: list[Worker] = []
        self._busy: list[Worker] = []

    @property
    def count(self) -> int:
        """How many they are."""
        return self._count

    def _take_on(self, task: Task) -> None:
        if task is not self._task:
            self._task, self._free = task, []

    def _submit(self, task: Task, job: Any) -> futures.Future[Any]:
        return self._executor.submit(self._do, task, job)

    def _do(self, task: Task, job: Any) -> Any:
        with self._making:
            worker = self._free.pop() if self._free else task.worker()
            self._busy.append(worker)
        try:
            return worker.do(job)
        finally:
            with self._making:
                self._busy.remove(worker)
                self._free.append(worker)

    def _drop(self, given: Iterable[futures.Future[Any]]) -> None:
        running = [one for one in given if not one.cancel()]
        if running:
            self._stop()
            futures.wait(running)

    def _stop(self) -> None:
        with self._making:
            self._task = None  # who was stopped begins no other job
            for worker in self._busy:
                worker.stop()

    def close(self) -> None:
        """Let them go; what they have in hand is dropped."""
        self._stop()
        self._executor.shutdown(cancel_futures=True)


class _Elsewhere(_Pool):
    """Workers outside this process, who are told a task as bytes."""

    _executor: futures.Executor

    def __init__(self) -> None:
        super().__init__()
        self._task: Task | None = None
        self._bytes = _Bytes("", b"")

    def _take_on(self, task: Task) -> None:
        if task is self._task:
            return
        try:
            content = packed(task)
        except pickle.PicklingError as error:
            raise ModelError(
                f"what other processes cannot load: {error}",
                "a model, an environment and functions of files or cells",
                "write them into a model's model.py or lessons.py, or use one worker",
            ) from None
        self._task, self._bytes = task, _Bytes(sha256(content).hexdigest(), content)

    def _submit(self, task: Task, job: Any) -> futures.Future[Any]:
        return self._executor.submit(_do_elsewhere, self._bytes, job)


class Processes(_Elsewhere):
    """Processes of this machine, for what runs in Python.

    Args:
        count: how many.
    """

    lost = (LostProcessError,)

    def __init__(self, count: int) -> None:
        super().__init__()
        self._count = count
        self._folder = tempfile.TemporaryDirectory()
        self._executor: ProcessExecutor = ProcessExecutor(count, self._folder.name)

    def in_hand(self) -> list[Any]:
        """Return the jobs that processes are at."""
        return [self._given[one][1] for one in self._executor.in_hand() if one in self._given]

    @property
    def count(self) -> int:
        """How many they are."""
        return self._count

    def close(self) -> None:
        """Let them go, whatever they are at."""
        self._executor.shutdown()
        self._folder.cleanup()


class Cluster(_Elsewhere):
    """The workers of a Dask cluster; they need socialmind and the model as here.

    Args:
        address: of its scheduler, such as `tcp://10.0.0.5:8786`.

    Raises:
        SocialmindError: `distributed` is not installed, or nobody answers.
    """

    def __init__(self, address: str) -> None:
        super().__init__()
        self._address = address
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
        self._executor = self._client.get_executor(pure=False, retries=LOST_AGAIN)
        self.lost = (distributed.KilledWorker, futures.CancelledError)

    @property
    def count(self) -> int:
        """How many threads its workers have now, 1 at least.

        Raises:
            SocialmindError: the scheduler is gone.
        """
        try:
            return max(1, sum(self._client.ncores().values()))
        except OSError:  # Dask's own for a broken connection is one
            raise self._gone() from None

    def _check(self) -> None:
        if self._client.status in ("closing", "closed"):
            raise self._gone()

    def _gone(self) -> SocialmindError:
        return SocialmindError(f"{self._address}: the Dask scheduler answers no more")

    def close(self) -> None:
        """Let them go; the cluster stays."""
        self._executor.shutdown(wait=False)
        self._client.close()


class _Bytes:
    """A task as bytes, and a hash that says which.

    Args:
        key: the hash.
        content: the bytes.
    """

    def __init__(self, key: str, content: bytes) -> None:
        self.key, self.content = key, content


_standing = threading.local()
"""What a worker elsewhere keeps from one job to the next: making it may take longer than a job."""


def _do_elsewhere(task: _Bytes, job: Any) -> Any:
    """Do a job in another process."""
    if getattr(_standing, "key", None) != task.key:
        _standing.key = _standing.worker = None
        _standing.worker = unpacked(task.content).worker()
        _standing.key = task.key
    return _standing.worker.do(job)


def cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def workers_here(count: int | None) -> int:
    """Return how many workers of this machine are meant.

    Args:
        count: as the user gave it; None for one for each processor.

    Raises:
        SocialmindError: a number below 1.
    """
    return cores() if count is None else whole_number(count, "workers", 1, None, SocialmindError)


def hired(count: int | None = None, threads: bool = False, cluster: str | None = None) -> Workers:
    """Return workers.

    Args:
        count: how many; one for each processor by default.
        threads: whether threads do it, for work in compiled code; else processes.
        cluster: the address of a Dask scheduler, whose workers they are then.

    Raises:
        SocialmindError: nobody answers there, or a number of workers below 1.
    """
    here = workers_here(count)
    if cluster is not None:
        if count is not None:
            raise SocialmindError("workers and a cluster; a cluster has its own, give one of both")
        return Cluster(cluster)
    return Threads(here) if threads else Processes(here)
