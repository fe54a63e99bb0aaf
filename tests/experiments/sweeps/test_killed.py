"""Sweeps whose processes are killed at random moments: resumed, they end as an undisturbed one."""

import os
import random
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

from socialmind.experiments import sweep

POINTS = {"largest_gift": [i / 50 for i in range(100)]}
OPTIONS = {
    "ticks": 40, "seeds": range(4), "every": 5, "compiled": False, "agents": "last",
    "measures": {"unequal": "gini(agents.money)"},
}  # fmt: skip

LED = '''
"""Begins a sweep or goes on with it, and tells how many runs are done."""

import os, sys
from pathlib import Path

from socialmind.experiments import resume_sweep, sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.tables import merging, window

model, out, workers, cluster, pieces = sys.argv[1:]
leading.JOB_SECONDS, window.WINDOW_SECONDS = 0.05, (0.05, 0.05)
OPTIONS = eval(Path(__file__).with_name("options.txt").read_text())
WORKERS = {"cluster": cluster} if cluster else {"workers": int(workers)}
update = merging.ContentDigest.update


def killed(self, rows):
    """The end comes while tables are merged, before this piece is written."""
    global pieces
    update(self, rows)
    pieces = int(pieces) - 1
    if pieces == 0:
        os.kill(os.getpid(), 9)


def tell(done, total):
    print(done, flush=True)


if __name__ == "__main__":
    merging.ContentDigest.update = killed
    if Path(out).exists():
        resume_sweep(out, on_progress=tell, **WORKERS)
    else:
        points, options = OPTIONS
        sweep(model, points, out=out, on_progress=tell, **WORKERS, **options)
'''

CLUSTER = """
import sys, time
import distributed

if __name__ == "__main__":
    distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50,
        scheduler_port=int(sys.argv[1]), local_directory=sys.argv[2],
    )
    print("ready", flush=True)
    time.sleep(3600)
"""


class Led:
    """A sweep that is begun and resumed by one process after another.

    Args:
        folder: for scripts.
        model: the model's.
        out: the sweep's.
        rng: says when what is killed.
    """

    def __init__(self, folder, model, out, rng):
        self.script, self.model, self.out, self.rng = folder / "led.py", model, out, rng
        self.script.write_text(LED)
        (folder / "options.txt").write_text(repr((POINTS, OPTIONS)))
        self.done, self.said, self.kills = 0, "", 0

    def go(self, kills=(), cluster="", merge=0):
        """Go on to the end, or until something kills it.

        Args:
            kills: called with the process, one after another, at random moments.
            cluster: the address of workers; else so many processes as chance says.
            merge: the piece of the sorted tables at which it ends itself; 0 for none.
        """
        words = [sys.executable, self.script, self.model, self.out, self.rng.choice([1, 2, 3])]
        words += [cluster, merge]
        kills, at = list(kills), self.rng.randint(2, 25)
        with subprocess.Popen(
            [str(one) for one in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as process:
            for count, _ in enumerate(process.stdout):
                if kills and count >= at:
                    at += self.rng.randint(1, 10)
                    time.sleep(self.rng.uniform(0, 0.1))
                    self.kills += bool(kills.pop(0)(process.pid))
            self.said = process.stderr.read()
        self.kills += process.returncode == -signal.SIGKILL and bool(merge)
        return process.returncode


def children(process):
    """Return the processes that a process began, and theirs."""
    found = []
    for path in Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, path.read_text().split()):
            found += [child, *children(child)]
    return found


def named(processes, word):
    """Return those processes whose command line has a word."""
    found = []
    for one in processes:
        try:
            if word in Path(f"/proc/{one}/cmdline").read_text():
                found.append(one)
        except OSError:
            continue
    return found


def kill(process):
    os.kill(process, signal.SIGKILL)
    return True


def kill_a_worker(rng):
    def one(process):
        workers = named(children(process), "spawn_main")
        return bool(workers) and kill(rng.choice(workers))

    return one


@contextmanager
def cluster_at(folder, port):
    """Have a cluster of two workers, in a process of its own."""
    script = folder / "cluster.py"
    script.write_text(CLUSTER)
    words = [sys.executable, script, str(port), folder / "dask"]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True
    ) as process:
        try:
            assert process.stdout.readline() == "ready\n"
            yield process
        finally:
            with_it = children(process.pid)
            for one in (process.pid, *with_it):
                try:
                    kill(one)
                except ProcessLookupError:
                    continue


@pytest.fixture(scope="module")
def undisturbed(gifts, tmp_path_factory):
    out = tmp_path_factory.mktemp("undisturbed") / "sweep"
    return sweep(gifts, POINTS, workers=1, out=out, **OPTIONS)


def killed(folder, gifts, rng, rounds, merges):
    """Kill a sweep in many rounds, in every other a worker before, and then while it merges."""
    led = Led(folder, gifts, folder / "killed, ünd wö", rng)
    for number in range(rounds):
        code = led.go([kill_a_worker(rng), kill] if number % 2 == 0 else [kill])
        assert code == -signal.SIGKILL, led.said
    for _ in range(merges):
        assert led.go(merge=rng.randint(1, 3)) == -signal.SIGKILL, led.said
    assert led.go() == 0, led.said
    return led


def test_killed_at_random_moments_it_ends_equal(gifts, undisturbed, contents, tmp_path):
    led = killed(tmp_path, gifts, random.Random(3), 1, 1)
    assert led.kills >= 2
    assert contents(led.out) == contents(undisturbed)


@pytest.mark.study
def test_killed_twenty_times_it_ends_equal(gifts, undisturbed, contents, tmp_path):
    led = killed(tmp_path, gifts, random.Random(20), 11, 5)
    assert led.kills >= 20
    assert contents(led.out) == contents(undisturbed)


@pytest.mark.study
def test_killed_on_a_cluster_whose_scheduler_dies_too_it_ends_equal(
    gifts, undisturbed, contents, tmp_path
):
    pytest.importorskip("distributed")
    rng, deaths = random.Random(7), 0
    led = Led(tmp_path, gifts, tmp_path / "out", rng)
    for number in range(4):
        port = 28_700 + number
        with cluster_at(tmp_path, port) as cluster:

            def kill_a_dask_worker(_, cluster=cluster):
                workers = named(children(cluster.pid), "spawn_main")
                return bool(workers) and kill(rng.choice(workers))

            def kill_the_scheduler(_, cluster=cluster):
                return kill(cluster.pid)

            kills = {
                0: [kill_a_dask_worker, kill],
                1: [kill_the_scheduler],
                2: [kill_a_dask_worker, kill_the_scheduler],
                3: [],
            }[number]
            code = led.go(kills, f"tcp://127.0.0.1:{port}")
        if number in (1, 2):
            assert code == 1 and "the Dask scheduler answers no more" in led.said, led.said
            deaths += 1
    assert code == 0 and deaths == 2 and led.kills == 5
    assert contents(led.out) == contents(undisturbed)
