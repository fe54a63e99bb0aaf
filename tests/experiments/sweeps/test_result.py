"""Reading a sweep that is going on, was stopped, or was killed."""

import subprocess
import sys
import time

import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import Sweep, resume_sweep, sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.replicates import Replicates, Until
from socialmind.experiments.sweeps.tables.rows import RunRows
from socialmind.experiments.sweeps.tables.store import Store

GOING_ON = """
import sys
from socialmind.experiments import sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.tables import window

leading.JOB_SECONDS = 0.0
window.WINDOW_SECONDS = (0.0, 0.0)
if __name__ == "__main__":
    workers = int(sys.argv[3])
    sweep(sys.argv[1], {"how": ["well", "well", "sleeps", "well"]}, 1, seeds=range(1),
          compiled=False, workers=workers, out=sys.argv[2])
"""


def statuses(folder):
    return Sweep(folder).runs["status"].tolist()


@pytest.mark.parametrize("workers", [1, 2])
def test_what_is_in_hand_is_running_until_all_is_killed(slow, tmp_path, workers):
    script, out = tmp_path / "going_on.py", tmp_path / "s"
    script.write_text(GOING_ON)
    words = [sys.executable, script, slow, out, str(workers)]
    with subprocess.Popen(words, start_new_session=True) as process:
        last = "pending" if workers == 1 else "finished"
        expected = ["finished", "finished", "running", last]
        try:
            end = time.monotonic() + 60
            while time.monotonic() < end:
                time.sleep(0.1)
                if (out / "manifest.json").is_file() and statuses(out) == expected:
                    break
            assert statuses(out) == expected
            with pytest.raises(SocialmindError, match="another process is running in this folder"):
                resume_sweep(out, workers=1)
        finally:
            process.kill()
            process.wait()
    expected[2] = "pending"
    assert statuses(out) == expected


def test_what_runs_in_this_process_is_running_too(slow, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(leading, "JOB_SECONDS", 0.0)
    noted = leading.Store.note_running

    def note(self, runs):
        noted(self, runs)
        if runs:
            seen.append(statuses(self.folder))

    monkeypatch.setattr(leading.Store, "note_running", note)
    sweep(slow, {"note": [1, 2, 3]}, 2, compiled=False, workers=1, out=tmp_path / "s")
    assert seen[0] == ["running", "pending", "pending"]
    assert seen[-1][-1] == "running"
    assert statuses(tmp_path / "s") == ["finished"] * 3


def test_what_is_said_of_running_ones_is_read_again(tmp_path):
    one = Store(tmp_path)
    one.begin()
    assert one.running() == set()
    one.note_running([7, 3, 4, 5, 5])
    assert (tmp_path / "parts/running.json").read_text() == "[[3, 5], [7, 7]]"
    assert one.running() == {3, 4, 5, 7}
    one.note_running([])
    assert one.running() == set()


def test_what_a_number_says_of_runs_that_are_not_done():
    replicates = Replicates((0, 1), until=Until(1.0, "x"), most=9)
    rows = RunRows(["price"], [(1.5,), (2.5,)], replicates)
    found = [(row["run"], row["price"], row["status"]) for row in rows.missing({0}, {1, 3, 12})]
    assert found == [
        (1, 1.5, "running"), (3, 1.5, "running"), (9, 2.5, "pending"), (10, 2.5, "pending"),
        (12, 2.5, "running"),
    ]  # fmt: skip
    assert rows.of(10) == {
        "run": 10, "point": 1, "replicate": 1, "price": 2.5, "seed": replicates.seed_of(10),
    }  # fmt: skip
