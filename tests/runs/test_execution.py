"""A run's folder: what is recorded, and that stopping anywhere changes nothing."""

import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import filelock
import numpy as np
import pyarrow.parquet as pq
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import Interrupted, Run, replay, resume, run
from socialmind.runs import loop
from socialmind.runs.capsule import Capsule
from socialmind.runs.checkpoint import Checkpoint
from socialmind.sources.folders import catalogue

CHECKOUT = Path(__file__).parents[2]

OF_EACH_KIND = ("farmer_artisan_learned", "fields_and_flocks", "foraging", "schelling", "wolf_cow")
"""Of the models that ship; the others, which tell little more, are gone through as a study."""


def tables_of(folder):
    """The bytes of both tables: the files of equal runs are equal, not only their content."""
    return {name: (Path(folder) / f"{name}.parquet").read_bytes() for name in ("series", "agents")}


@pytest.fixture(scope="module")
def whole(drifters, tmp_path_factory):
    """A run of 1003 ticks that was never stopped, recorded every 4 and 20 ticks."""
    out = tmp_path_factory.mktemp("whole") / "run"
    return run(drifters, ticks=1003, seed=3, every=4, agents_every=20, out=out)


@pytest.mark.skipif(not hasattr(signal, "SIGXFSZ"), reason="no limit of files here")
@pytest.mark.parametrize("room", [1_000, 3_000])
def test_a_full_disk_stops_a_run_that_goes_on_when_there_is_room(drifters, whole, tmp_path, room):
    import resource

    out = tmp_path / "run"
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)

    def fill(tick, length):
        if tick > 300:
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))

    try:
        with pytest.raises(SocialmindError, match=r"File too large at tick \d+; .* with --resume"):
            run(drifters, 1003, 3, every=4, agents_every=20, out=out, on_progress=fill)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert not list(out.glob("*.partial"))
    resume(out, model_class=drifters)
    assert tables_of(out) == tables_of(whole)


@pytest.mark.parametrize("seed", [0, 2**32, 2**63, 2**64 - 1, np.uint64(2**64 - 1)])
def test_every_seed_is_kept_as_it_is(drifters, tmp_path, seed):
    folder = run(drifters, np.int64(20), seed, every=np.int16(2), out=tmp_path / "run")
    assert Run(folder).seed == int(seed)
    resume(folder, 30, model_class=drifters)
    assert replay(folder, drifters).equal


def test_a_wrong_record_names_the_models_line(drifters, tmp_path):
    class Listing(drifters):
        def series(self):
            return {"prices": [1.0, 2.0]}

    line = Listing.series.__code__.co_firstlineno
    with pytest.raises(SocialmindError) as caught:
        run(Listing, 5, out=tmp_path / "run")
    assert str(caught.value).startswith(
        f"{__file__}:{line}: series() at tick 0: column prices: values of type list; expected"
    )


def test_rows_are_recorded_on_the_grid_and_at_the_last_tick(whole):
    done = Run(whole)
    assert list(done.series["tick"]) == [*range(0, 1001, 4), 1003]
    assert sorted(set(done.agents["tick"])) == [*range(0, 1001, 20), 1003]
    assert list(done.series.columns[:2]) == ["tick", "population"]
    first = done.agents[done.agents["tick"] == 20]
    assert len(first) == done.series.set_index("tick")["population"][20]


def test_the_two_grids_need_not_fall_together(drifters, tmp_path):
    done = Run(run(drifters, 13, every=4, agents_every=6, out=tmp_path / "run"))
    assert list(done.series["tick"]) == [0, 4, 8, 12, 13]
    assert sorted(set(done.agents["tick"])) == [0, 6, 12, 13]


@pytest.mark.parametrize(
    ("ticks", "every", "agents_every"), [(0, 1, 10), (7, 1, 10), (500, 1, 10), (1001, 3, 30)]
)
def test_about_five_hundred_rows_by_default(drifters, tmp_path, ticks, every, agents_every):
    done = Run(run(drifters, ticks=ticks, out=tmp_path / "run"))
    assert (done.manifest.every, done.manifest.agents_every) == (every, agents_every)
    expected = list(range(0, ticks + 1, every))
    assert list(done.series["tick"]) == expected + ([ticks] if ticks % every else [])


def test_the_model_has_a_length_of_its_own(drifters, tmp_path):
    assert Run(run(drifters, out=tmp_path / "run")).ticks == 1000


def test_the_manifest_tells_what_the_run_is(whole):
    manifest = Run(whole).manifest
    assert manifest.status == "finished"
    assert manifest.ticks_done == manifest.ticks == 1003
    assert manifest.seed == 3
    assert manifest.parameters["n"] == 5
    assert manifest.model["name"] == "Drifters"
    assert manifest.idle == {"count": 3, "first_agent": 1, "first_tick": 2}
    assert manifest.tables["series"]["rows"] == len(range(0, 1001, 4)) + 1
    assert manifest.tables["series"]["columns"] == {
        "tick": "int64",
        "population": "int64",
        "mean": "double",
        "late": "double",
        "whole_then_not": "double",
        "never": "null",
    }
    assert manifest.timings["seconds"] >= manifest.timings["loop_seconds"] > 0


def test_a_finished_folder_holds_no_leftovers(whole):
    names = {path.name for path in whole.iterdir()} - {".lock"}
    tables = {"series.parquet", "agents.parquet"}
    assert names == {"manifest.json", "checkpoint.npz", "source"} | tables
    assert [p.name for p in whole.parent.iterdir()] == [whole.name]


def test_tables_are_compressed_with_zstd(whole):
    column = pq.read_metadata(whole / "agents.parquet").row_group(0).column(2)
    assert column.compression == "ZSTD"


def test_chunks_do_not_show(drifters, whole, tmp_path, monkeypatch):
    monkeypatch.setattr(loop, "CHUNK_SECONDS", 1e-9)  # one tick at a time
    folder = run(drifters, ticks=1003, seed=3, every=4, agents_every=20, out=tmp_path / "run")
    assert tables_of(folder) == tables_of(whole)


def test_a_slow_model_is_driven_in_short_chunks(drifters, tmp_path):
    made = []

    class Slow(drifters):
        def __init__(self, **options):
            super().__init__(**options)
            made.append(self)

    run(Slow, ticks=300, parameters={"pause": 0.002}, every=300, out=tmp_path / "run")
    assert sum(made[0].advanced) == 300
    assert max(made[0].advanced) <= 0.25 / 0.002


def test_progress_is_reported_up_to_the_end(drifters, tmp_path):
    seen = []
    run(drifters, ticks=50, out=tmp_path / "run", on_progress=lambda *step: seen.append(step))
    assert seen[0] == (0, 50)
    assert seen[-1] == (50, 50)


class Leaping:
    """A clock that goes on by 10 ms whenever it is looked at, and now and then leaps by days."""

    def __init__(self, days, looks):
        self.now, self.seen, self.days, self.looks = 1e6, 0, days, looks

    def __call__(self):
        self.seen += 1
        self.now += self.days * 86_400 if self.seen % self.looks == 0 else 0.01
        return self.now


@pytest.mark.parametrize(("days", "looks"), [(-3, 20), (3, 20), (3, 21)])
def test_a_clock_that_leaps_changes_nothing(drifters, whole, tmp_path, monkeypatch, days, looks):
    saved, told = [], []
    save = Checkpoint.save
    monkeypatch.setattr(Checkpoint, "save", lambda one, path: (saved.append(one), save(one, path)))
    for name in ("time", "perf_counter", "monotonic"):
        monkeypatch.setattr(time, name, Leaping(days, looks))
    out = run(
        drifters, 1003, 3, every=4, agents_every=20, out=tmp_path / "run", checkpoint_every=0.5,
        on_progress=lambda tick, length: told.append(tick),
    )  # fmt: skip
    assert tables_of(out) == tables_of(whole)
    assert len(saved) > 5 and len(told) > 20  # after the first leap too
    assert all(one.seconds >= 0.0 and one.loop_seconds >= 0.0 for one in saved)
    resume(out, ticks=1010, model_class=drifters)
    timings = Run(out).manifest.timings
    assert timings["seconds"] >= 0.0 and timings["loop_seconds"] >= 0.0


# Stopping and going on


def stop_at(tick, deliver):
    """A progress callback that does `deliver` once at a tick or later."""
    left = [deliver]

    def callback(done, _length):
        if done >= tick and left:
            left.pop()()

    return callback


@pytest.fixture
def frequent_progress(monkeypatch):
    monkeypatch.setattr(loop, "PROGRESS_SECONDS", 0.0)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_ctrl_c_leaves_a_capsule_that_goes_on(
    drifters, whole, tmp_path, frequent_progress, number, request
):
    out = tmp_path / "run"
    inherited = signal.signal(number, signal.default_int_handler)  # nohup leaves one ignored
    request.addfinalizer(lambda: signal.signal(number, inherited))
    before = signal.getsignal(number)
    with pytest.raises(Interrupted) as stopped:
        run(
            drifters, 1003, 3, every=4, agents_every=20, out=out,
            on_progress=stop_at(500, lambda: os.kill(os.getpid(), number)),
        )  # fmt: skip
    assert signal.getsignal(number) is before
    assert 500 <= stopped.value.tick < 1003
    half = Run(out)
    assert half.manifest.status == "interrupted"
    assert half.ticks == stopped.value.tick
    assert half.series["tick"].max() <= half.ticks  # readable as it stands
    resume(out, model_class=drifters)
    assert tables_of(out) == tables_of(whole)
    assert Run(out).manifest.tables == Run(whole).manifest.tables


def test_a_model_that_fails_keeps_its_last_checkpoint(drifters, tmp_path):
    out = tmp_path / "run"
    with pytest.raises(
        ModelError, match=r"drifters.py:\d+: the run at tick 60 stopped with ZeroDiv"
    ):
        run(drifters, 100, parameters={"fail_at": 60}, out=out, checkpoint_every=0.0)
    stopped = Run(out)
    assert stopped.manifest.status == "failed"
    assert "division by zero" in stopped.manifest.error
    assert 0 <= stopped.ticks < 60


def killed(tmp_path, body):
    """Run Python code that ends by SIGKILL; gives the folder it worked in."""
    script = f"""
import os, signal, sys
sys.path[:0] = [{str(CHECKOUT)!r}, {str(CHECKOUT / "tests/runs")!r}]
from drifters import Drifters
from socialmind.experiments import (run, resume)
from socialmind.runs import execution, loop
from socialmind.runs import arrays_file
from socialmind.runs import capsule
from socialmind.runs import checkpoint
from socialmind.runs import continuing
from socialmind.runs.tables import files
def die():
    os.kill(os.getpid(), signal.SIGKILL)
def die_after(calls, module, name):
    real, left = getattr(module, name), [calls]
    def replaced(*args, **options):
        left[0] -= 1
        if left[0] < 0:
            die()
        return real(*args, **options)
    setattr(module, name, replaced)
out = {str(tmp_path / "run")!r}
loop.CHECKPOINT_COST = loop.PROGRESS_SECONDS = 0.0
def start(**options):
    run(Drifters, 1003, 3, every=4, agents_every=20, out=out, **options)
{body}
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, timeout=60)
    assert ended.returncode == -signal.SIGKILL, ended.stderr.decode()
    return tmp_path / "run"


MOMENTS = {
    "before the first tick": "start(on_progress=lambda t, n: die())",
    "before the first checkpoint": "start(on_progress=lambda t, n: t > 500 and die())",
    "after several checkpoints": (
        "start(checkpoint_every=0.0, on_progress=lambda t, n: t > 900 and die())"
    ),
    "while a checkpoint is written": (
        "die_after(2, arrays_file.os, 'fsync'); start(checkpoint_every=0.0)"
    ),
    "between a part and its checkpoint": (
        "die_after(1, checkpoint.Checkpoint, 'save'); start(checkpoint_every=0.0)"
    ),
    "between a checkpoint and the manifest": (
        "die_after(2, capsule.Capsule, 'update'); start(checkpoint_every=0.0)"
    ),
    "before the merge": "die_after(0, continuing, 'merge'); start()",
    "between the two merges": "die_after(1, continuing, 'merge'); start()",
    "in a merge": "die_after(1, files.ContentDigest, 'update'); start()",
    "between the merge and the manifest": "die_after(1, capsule.Capsule, 'update'); start()",
    "before the parts are removed": "die_after(1, execution.shutil, 'rmtree'); start()",
}


@pytest.mark.parametrize("moment", MOMENTS)
def test_killed_and_resumed_equals_never_killed(drifters, whole, tmp_path, moment):
    folder = killed(tmp_path, MOMENTS[moment])
    assert resume(folder, model_class=drifters) == folder
    assert tables_of(folder) == tables_of(whole)
    assert Run(folder).manifest.tables == Run(whole).manifest.tables
    assert not (folder / "parts").exists()


def test_killed_again_and_again(drifters, whole, tmp_path):
    folder = killed(
        tmp_path, "start(checkpoint_every=0.0, on_progress=lambda t, n: t > 300 and die())"
    )
    for tick in (500, 700):
        body = f"""
resume(out, model_class=Drifters, checkpoint_every=0.0,
       on_progress=lambda t, n: t > {tick} and die())
"""
        killed(tmp_path, body)
    resume(folder, model_class=drifters)
    assert tables_of(folder) == tables_of(whole)


def test_killed_by_the_clock(drifters, whole, tmp_path):
    """Whenever the kill comes, the folder is either not there or goes on."""
    script = f"""
import sys
sys.path[:0] = [{str(CHECKOUT)!r}, {str(CHECKOUT / "tests/runs")!r}]
from drifters import Drifters
from socialmind.experiments import run
run(Drifters, 1003, 3, every=4, agents_every=20, out=sys.argv[1], checkpoint_every=0.01)
"""
    for number, delay in enumerate((0.0, 0.01, 0.03, 0.08)):
        out = tmp_path / str(number)
        process = subprocess.Popen([sys.executable, "-c", script, str(out)])
        while not out.exists() and process.poll() is None:
            time.sleep(0.001)
        time.sleep(delay)
        process.kill()
        process.wait()
        resume(out, model_class=drifters)
        assert tables_of(out) == tables_of(whole)


# Making a run longer


@pytest.mark.parametrize("first", [0, 1, 500, 501, 1000])
def test_extended_equals_one_long_run(drifters, whole, tmp_path, first):
    folder = run(drifters, first, 3, every=4, agents_every=20, out=tmp_path / "run")
    resume(folder, ticks=1003, model_class=drifters)
    assert tables_of(folder) == tables_of(whole)
    assert Run(folder).manifest.ticks == 1003
    assert Run(folder).manifest.idle == Run(whole).manifest.idle


def test_the_time_of_all_stretches_is_added_up(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    path = Capsule(folder).checkpoint
    replace(Checkpoint.load(path), seconds=1000.0, loop_seconds=900.0).save(path)
    timings = Run(resume(folder, ticks=40, model_class=drifters)).manifest.timings
    assert 1000.0 < timings["seconds"] < 1900.0 and 900.0 <= timings["loop_seconds"] < 1800.0


def test_extended_twice_and_killed_while_reopened(drifters, whole, tmp_path):
    folder = run(drifters, 301, 3, every=4, agents_every=20, out=tmp_path / "run")
    resume(folder, ticks=702, model_class=drifters)
    before = tables_of(folder)
    for calls in (0, 1):  # before and after the manifest says that the run is longer
        killed(
            tmp_path,
            f"die_after({calls}, capsule.Capsule, 'update')\n"
            "resume(out, ticks=1003, model_class=Drifters)",
        )
        if calls == 0:
            assert tables_of(folder) == before
            assert resume(folder, model_class=drifters) == folder
            assert tables_of(folder) == before
    resume(folder, ticks=1003, model_class=drifters)
    assert tables_of(folder) == tables_of(whole)


def test_killed_before_the_merge_then_made_longer(drifters, whole, tmp_path):
    body = MOMENTS["before the merge"].replace("start()", "run(Drifters, 501, 3, every=4, "
        "agents_every=20, out=out)")  # fmt: skip
    folder = killed(tmp_path, body)
    resume(folder, ticks=1003, model_class=drifters)
    assert tables_of(folder) == tables_of(whole)


@pytest.mark.parametrize("said", [False, True])
def test_stopped_then_given_a_shorter_length(drifters, tmp_path, frequent_progress, said):
    out = tmp_path / "run"
    with pytest.raises(Interrupted) as stopped:
        run(
            drifters, 1003, 3, every=400, out=out,
            on_progress=stop_at(400, lambda: os.kill(os.getpid(), signal.SIGINT)),
        )  # fmt: skip
    done = stopped.value.tick
    if said:  # killed when the manifest had the length and the table not yet its last row
        Capsule(out).update(ticks=done)
    resume(out, ticks=done, model_class=drifters)  # its last row lies where it was stopped
    short = run(drifters, done, 3, every=400, out=tmp_path / "short")
    assert tables_of(out) == tables_of(short)


def test_made_longer_and_thought_better_of(drifters, tmp_path):
    """The row of a last tick off the grid went when the run was reopened, and comes back."""
    folder = run(drifters, 301, 3, every=4, agents_every=20, out=tmp_path / "run")
    before = tables_of(folder)
    with pytest.raises(Interrupted) as stopped:
        resume(
            folder, ticks=702, model_class=drifters,
            on_progress=stop_at(0, lambda: os.kill(os.getpid(), signal.SIGINT)),
        )  # fmt: skip
    assert stopped.value.tick == 301
    resume(folder, ticks=301, model_class=drifters)
    assert tables_of(folder) == before


def test_a_run_that_failed_and_went_on_tells_no_error(drifters, tmp_path):
    class Failing(drifters):
        broken = True

        def series(self):
            return {**super().series(), "one": 1 / (self.tick != 40 or not self.broken)}

    with pytest.raises(ModelError):
        run(Failing, 60, every=4, out=tmp_path / "run")
    Failing.broken = False
    failed = Run(tmp_path / "run").manifest
    assert (failed.status, "division by zero" in failed.error) == ("failed", True)
    finished = Run(resume(tmp_path / "run", model_class=Failing)).manifest
    assert (finished.status, finished.error) == ("finished", None)


def test_a_run_knows_all_machines_that_computed_it(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    here = Run(folder).manifest.platforms
    elsewhere = [{"machine": "elsewhere"}]
    Capsule(folder).update(platforms=elsewhere)
    for ticks in (30, 40):
        resume(folder, ticks, model_class=drifters)
        assert Run(folder).manifest.platforms == elsewhere + here


def test_a_checkpoint_of_another_tick_or_other_parameters_is_not_gone_on_from(
    drifters, tmp_path, monkeypatch
):
    taken = drifters.restore

    def altering(self, state):
        taken(self, state)
        self._parameters["n"] += 1

    altered = run(drifters, 20, out=tmp_path / "altered")
    with monkeypatch.context() as patched:
        patched.setattr(drifters, "restore", altering)
        with pytest.raises(SocialmindError, match="npz: it holds other parameters or another tick"):
            resume(altered, 30, model_class=drifters)
    moved = run(drifters, 20, out=tmp_path / "moved")
    path = Capsule(moved).checkpoint
    checkpoint = Checkpoint.load(path)
    replace(checkpoint, state={**checkpoint.state, "tick": np.array(18)}).save(path)
    with pytest.raises(SocialmindError, match=r"npz: it holds other parameters or another tick"):
        resume(moved, 30, model_class=drifters)
    # One of this run, but from before its end.
    replace(checkpoint, tick=18, state={**checkpoint.state, "tick": np.array(18)}).save(path)
    with pytest.raises(SocialmindError, match=r"checkpoint.npz is missing or of another run"):
        resume(moved, 30, model_class=drifters)


def test_going_on_with_a_finished_run_changes_nothing(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    before = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    assert resume(folder) == folder
    assert {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()} == before


def test_a_run_is_never_made_shorter(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    with pytest.raises(SocialmindError, match="20 ticks are done, 19 asked for"):
        resume(folder, ticks=19, model_class=drifters)


def test_a_finished_run_without_checkpoint_is_not_made_longer(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    (folder / "checkpoint.npz").unlink()
    with pytest.raises(SocialmindError, match="--ticks 30"):
        resume(folder, ticks=30, model_class=drifters)


def test_a_broken_checkpoint_is_named(drifters, tmp_path):
    folder = killed(tmp_path, MOMENTS["after several checkpoints"])
    (folder / "checkpoint.npz").write_bytes(b"PK but no more")
    with pytest.raises(SocialmindError, match=r"checkpoint.npz: not a whole checkpoint"):
        resume(folder, model_class=drifters)


# What is refused


def test_a_changed_model_is_not_gone_on_with(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    Capsule(folder).update(model={"name": "Drifters", "path": None, "source_sha256": "0" * 64})
    with pytest.raises(SocialmindError, match="is not the source the run was made with"):
        resume(folder, ticks=30, model_class=drifters)


def test_another_version_does_not_go_on(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    Capsule(folder).update(versions={"socialmind": "0.0.1"})
    with pytest.raises(SocialmindError, match=r"made by socialmind 0.0.1.*install 0.0.1, or start"):
        resume(folder, ticks=30, model_class=drifters)


def test_two_processes_cannot_work_in_one_folder(drifters, tmp_path):
    folder = run(drifters, 20, out=tmp_path / "run")
    with filelock.FileLock(folder / ".lock"), pytest.raises(SocialmindError, match="another proc"):
        resume(folder, ticks=30, model_class=drifters)


def test_the_lock_of_a_killed_process_does_not_block(drifters, tmp_path):
    folder = killed(tmp_path, MOMENTS["before the first checkpoint"])
    assert (folder / ".lock").exists()
    resume(folder, model_class=drifters)


def test_an_empty_folder_is_taken(drifters, tmp_path):
    out = tmp_path / "run"
    out.mkdir()
    assert run(drifters, 5, out=out) == out
    assert Run(out).ticks == 5


def test_the_current_folder_is_taken_when_empty(drifters, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(drifters, 5, out=".")
    assert Path("manifest.json").exists()  # the folder is still the same one


@pytest.mark.parametrize("content", ["notes.txt", "manifest.json"])
def test_a_folder_that_holds_something_is_left_alone(drifters, tmp_path, content):
    (tmp_path / content).write_text("mine")
    with pytest.raises(SocialmindError, match="holds a run" if "man" in content else "not empty"):
        run(drifters, 5, out=tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == [content]
    assert (tmp_path / content).read_text() == "mine"


def test_a_file_is_not_a_folder(drifters, tmp_path):
    (tmp_path / "run").write_text("mine")
    with pytest.raises(SocialmindError, match="is a file"):
        run(drifters, 5, out=tmp_path / "run")


def test_fresh_folders_are_numbered(drifters, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folders = [run(drifters, 5) for _ in range(2)]
    assert [f.relative_to(tmp_path).as_posix() for f in folders] == [
        "runs/Drifters-001",
        "runs/Drifters-002",
    ]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"ticks": -1}, "ticks: found -1"),
        ({"ticks": 1e3}, "ticks: found 1000.0"),
        ({"ticks": 5, "every": 0}, "every: found 0"),
        ({"ticks": 5, "agents_every": 0}, "agents_every: found 0"),
        ({"ticks": 5, "seed": -1}, "seed: found -1"),
        ({"ticks": 5, "seed": 2**64}, "seed: found 18446744073709551616"),
    ],
)
def test_numbers_out_of_range_are_refused(drifters, tmp_path, options, message):
    with pytest.raises(SocialmindError, match=message):
        run(drifters, out=tmp_path / "run", **options)
    assert not (tmp_path / "run").exists()


def test_runs_outside_the_main_thread(drifters, whole, tmp_path):
    out = tmp_path / "run"
    options = {"ticks": 1003, "seed": 3, "every": 4, "agents_every": 20, "out": out}
    thread = threading.Thread(target=run, args=(drifters,), kwargs=options)
    thread.start()
    thread.join()
    assert tables_of(out) == tables_of(whole)


def test_reading_what_is_no_run(tmp_path):
    with pytest.raises(SocialmindError, match="no such folder"):
        Run(tmp_path / "nowhere")
    with pytest.raises(SocialmindError, match=r"holds no manifest.json"):
        Run(tmp_path)
    (tmp_path / "manifest.json").write_text("{}")
    with pytest.raises(SocialmindError, match="format None; expected 1"):
        Run(tmp_path)
    (tmp_path / "manifest.json").write_text("{")
    with pytest.raises(SocialmindError, match="not a run's manifest"):
        Run(tmp_path)


@pytest.mark.parametrize(
    "name",
    [
        name if name in OF_EACH_KIND else pytest.param(name, marks=pytest.mark.study)
        for name in catalogue()
    ],
)
def test_every_model_that_ships_goes_on_as_if_never_stopped(tmp_path, frequent_progress, name):
    model = load_model(name)
    options = {"ticks": 700, "seed": 6, "every": 3, "agents_every": 50}
    whole = run(model, out=tmp_path / "whole", **options)
    out = tmp_path / "stopped"
    with pytest.raises(Interrupted):
        run(
            model, out=out, **options,
            on_progress=stop_at(300, lambda: os.kill(os.getpid(), signal.SIGINT)),
        )  # fmt: skip
    resume(out, ticks=500, compiled=False)  # a shorter run, in the other speed
    resume(out, ticks=700, compiled=True)
    assert tables_of(out) == tables_of(whole)
