"""Workers: results in the order of the jobs or as they come, jobs without end, lost workers."""

import itertools
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import pytest

from socialmind.errors import SocialmindError
from socialmind.sources.loading import load_file
from socialmind.work.workers import (
    AHEAD,
    Alone,
    Cluster,
    Processes,
    Stopped,
    Threads,
    hired,
)


class Square:
    """A task whose worker is itself."""

    def __init__(self):
        self.begun = []
        self.stopped = threading.Event()

    def worker(self):
        return self

    def do(self, job):
        self.begun.append(job)
        time.sleep(0.02 if job == 0 else 0)
        return job * job

    def stop(self):
        self.stopped.set()


class Endless(Square):
    """A job that goes on until it is stopped."""

    def do(self, job):
        self.begun.append(job)
        self.stopped.wait()


@pytest.fixture
def killed(tmp_path):
    """A task of a file, whose jobs end their process as often as a file says."""
    (tmp_path / "killed.py").write_text(
        """import os
from pathlib import Path


class Killed:
    def __init__(self, folder):
        self.folder = folder

    def worker(self):
        return self

    def do(self, job):
        sign = Path(self.folder) / f"{job}"
        if sign.exists():
            left = int(sign.read_text())
            sign.write_text(str(left - 1))
            if left > 0:
                os.kill(os.getpid(), 9)
        return job

    def stop(self):
        pass
"""
    )
    return load_file(tmp_path / "killed.py").Killed(str(tmp_path))


@pytest.mark.parametrize("kind", [Alone, lambda: Threads(1), lambda: Threads(3)])
def test_results_come_in_the_order_of_the_jobs(kind):
    with kind() as workers:
        assert list(workers.results(Square(), range(20))) == [n * n for n in range(20)]
        assert dict(workers.finished(Square(), range(20))) == {n: n * n for n in range(20)}
        assert list(workers.results(Square(), [])) == []


@pytest.mark.parametrize("in_order", [True, False])
def test_jobs_without_end_are_taken_as_they_are_done(in_order):
    task, taken = Square(), itertools.count()
    with Threads(2) as workers:
        found = (workers.results if in_order else workers.finished)(task, taken)
        for _ in range(30):
            next(found)
        found.close()
    assert next(taken) <= 30 + 2 * AHEAD + 2


def test_processes_do_again_what_a_lost_one_had(killed, tmp_path):
    (tmp_path / "3").write_text("1")
    with Processes(2) as workers:
        assert list(workers.results(killed, range(9))) == list(range(9))
        assert (tmp_path / "3").read_text() != "1"


def test_a_job_that_ends_each_of_its_processes_is_given_up(killed, tmp_path, monkeypatch):
    monkeypatch.setattr("socialmind.work.workers.LOST_AGAIN", 1)
    (tmp_path / "0").write_text("9")
    with Processes(1) as workers, pytest.raises(SocialmindError, match="2 times at the same work"):
        list(workers.results(killed, [0]))


def test_a_lost_process_takes_one_job_with_it(killed, tmp_path):
    (tmp_path / "3").write_text("9")
    lost = []

    def instead(job, error):
        lost.append((job, error.code))
        return "lost"

    with Processes(2) as workers:
        found = dict(workers.finished(killed, range(9), instead=instead))
    assert found == {n: "lost" if n == 3 else n for n in range(9)}
    assert lost == [(3, -9)]


def test_jobs_can_be_added_while_others_are_done(killed):
    class Coming:
        def __init__(self):
            self.waiting = [1]

        def __iter__(self):
            return self

        def __next__(self):
            if not self.waiting:
                raise StopIteration
            return self.waiting.pop()

    for kind in (Alone, lambda: Processes(2)):
        jobs, found = Coming(), []
        with kind() as workers:
            for _, result in workers.finished(killed, jobs):
                found.append(result)
                if result < 4:
                    jobs.waiting.append(result + 1)
        assert found == [1, 2, 3, 4]


def test_who_stops_is_heard_and_so_are_the_workers():
    task = Endless()
    with Threads(2) as workers, pytest.raises(Stopped):
        list(workers.results(task, range(9), lambda: len(task.begun) == 2))
    assert task.begun == [0, 1]


def test_threads_that_are_let_go_drop_what_they_have_in_hand():
    task = Endless()
    with pytest.raises(KeyboardInterrupt), Threads(2) as workers:
        left = workers.results(task, range(9), lambda: False)
        threading.Thread(target=lambda: next(left, None), daemon=True).start()
        while len(task.begun) < 2:
            time.sleep(0.01)
        raise KeyboardInterrupt
    assert task.stopped.is_set()


def test_who_does_the_work():
    with hired(2) as some:
        assert (type(some), some.count) == (Processes, 2)
    with hired(2, threads=True) as some:
        assert (type(some), some.count) == (Threads, 2)


def test_wrong_numbers_and_addresses_are_refused():
    with pytest.raises(SocialmindError, match="workers: found 0; expected a whole number, 1 or"):
        hired(0)
    with pytest.raises(SocialmindError, match="give one of both"):
        hired(2, cluster="tcp://x:1")
    pytest.importorskip("distributed")
    with pytest.raises(SocialmindError, match="no Dask scheduler answers"):
        Cluster("nonsense://x:1")


def test_a_cluster_whose_scheduler_has_ended_is_said_to_be_gone():
    cluster = Cluster.__new__(Cluster)
    cluster._address, cluster._client = "tcp://10.0.0.5:8786", SimpleNamespace(status="running")
    cluster._check()
    cluster._client.status = "closed"
    with pytest.raises(
        SocialmindError, match=r"tcp://10\.0\.0\.5:8786: the Dask scheduler answers"
    ):
        cluster._check()


def test_a_cluster_whose_connection_breaks_is_said_to_be_gone():
    def broken():
        raise ConnectionResetError(104, "Connection reset by peer")

    cluster = Cluster.__new__(Cluster)
    cluster._address, cluster._client = "tcp://10.0.0.5:8786", SimpleNamespace(ncores=broken)
    with pytest.raises(SocialmindError, match=r"10\.0\.0\.5:8786: the Dask scheduler answers no"):
        cluster.count  # noqa: B018


SIDE_BY_SIDE = """
from socialmind.work.side_by_side import side_by_side
print(list(side_by_side(abs, [(-1,), (-2,)], 2)))
"""
SWEEP = """
from socialmind.catalogue import load_model
from socialmind.experiments import sweep
sweep(load_model("tutorial"), seeds=range(20), ticks=5, out="swept", workers=2, progress=False)
"""


@pytest.mark.parametrize("text", [SIDE_BY_SIDE, SWEEP])
def test_a_script_without_a_main_guard_is_told_of_it(text, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(text)
    ended = subprocess.run(
        [sys.executable, script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ended.returncode != 0
    assert 'put what begins the work under `if __name__ == "__main__":`' in ended.stderr
