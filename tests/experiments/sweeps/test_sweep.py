"""Sweeps: equal whatever their workers and whatever stopped them; failures that stay alone."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, Sweep, designs, remake_run, resume_sweep, sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.leading import SweepInterrupted
from socialmind.experiments.sweeps.tables import window
from socialmind.experiments.sweeps.tables.store import Store
from socialmind.learning.lessons.keys import seed_for

DESIGN = {"largest_gift": [0.5, 1.0, 2.0], "n": [3, 6, 9]}
MEASURES = {"unequal": "gini(agents.money)", "late": "mean(richest[-3:])"}
OPTIONS = {
    "ticks": 30, "seeds": range(3), "every": 10, "agents": "last", "compiled": False,
    "measures": MEASURES, "workers": 1,
}  # fmt: skip


@pytest.fixture
def one_by_one(monkeypatch):
    """Jobs of one run, each written at once."""
    monkeypatch.setattr(leading, "JOB_SECONDS", 0.0)
    monkeypatch.setattr(window, "WINDOW_SECONDS", (0.0, 0.0))


@pytest.fixture(scope="module")
def whole(gifts, tmp_path_factory):
    """An undisturbed sweep."""
    out = tmp_path_factory.mktemp("whole") / "sweep"
    return sweep(gifts, pd.DataFrame(DESIGN), out=out, **OPTIONS)


def test_its_tables_say_what_runs_come_to(gifts, whole):
    found = Sweep(whole)
    runs = found.runs
    assert list(runs) == [
        "run", "point", "replicate", "largest_gift", "n", "seed", "status", "error", "ticks",
        "richest", "poor", "unequal", "late",
    ]  # fmt: skip
    assert runs["run"].tolist() == list(range(9))
    assert set(runs["status"]) == {"finished"} and set(runs["ticks"]) == {30}
    assert found.design["point"].tolist() == [0, 1, 2]
    row = runs.iloc[5]
    assert (row["point"], row["replicate"], row["n"]) == (1, 2, 6)
    society = load_model(gifts)(seed=int(row["seed"]), compiled=False, largest_gift=1.0, n=6)
    richest = []
    for _ in range(3):
        society.advance(10)
        richest.append(society.series()["richest"])
    assert row["richest"] == richest[-1] and row["late"] == np.mean(richest)
    series = found.series[found.series["run"] == 5]
    assert series["tick"].tolist() == [0, 10, 20, 30]
    assert series["richest"].tolist()[1:] == richest
    agents = found.agents[found.agents["run"] == 5]
    assert agents["money"].tolist() == society.walkers.money.tolist()


def test_seeds_are_common_or_each_point_s_own(gifts, whole, tmp_path):
    runs = Sweep(whole).runs
    assert runs["seed"].nunique() == 9
    assert runs["seed"][4] == seed_for("sweep", 1, 1)
    common = sweep(gifts, DESIGN, common=True, out=tmp_path / "s", **OPTIONS)
    assert Sweep(common).runs["seed"].tolist() == [0, 1, 2] * 3


def test_two_workers_come_to_the_same(gifts, whole, contents, tmp_path):
    options = {**OPTIONS, "workers": 2}
    assert contents(sweep(gifts, DESIGN, out=tmp_path / "s", **options)) == contents(whole)


def test_a_run_is_made_again_to_the_last_bit(whole, tmp_path):
    run = Run(remake_run(whole, 7, tmp_path / "run"))
    series = Sweep(whole).series
    own = series[series["run"] == 7].drop(columns="run").reset_index(drop=True)
    pd.testing.assert_frame_equal(run.series, own, check_exact=True)
    assert run.seed == Sweep(whole).runs["seed"][7]
    with pytest.raises(SocialmindError, match=r"no run 9; its runs are 0 … 8"):
        remake_run(whole, 9, tmp_path / "other")


class Enough(Exception):
    pass


def stopped_at(count):
    def tell(done, _):
        if done >= count:
            raise Enough

    return tell


@pytest.mark.parametrize("count", [1, 4, 8])
def test_what_was_stopped_goes_on_to_the_same(gifts, whole, contents, tmp_path, count, one_by_one):
    out = tmp_path / "s"
    with pytest.raises(Enough):
        sweep(gifts, DESIGN, out=out, on_progress=stopped_at(count), **OPTIONS)
    assert Sweep(out).runs["run"].tolist() == list(range(9))
    assert 1 <= (Sweep(out).runs["status"] == "finished").sum() < 9
    told = []
    resume_sweep(out, workers=1, on_progress=lambda done, total: told.append((done, total)))
    assert told[0][0] >= 1 and told[-1] == (9, 9)
    assert contents(out) == contents(whole)
    assert not (out / "parts").exists()


KILLED = """
import os, random, signal, sys, threading
from pathlib import Path

from socialmind.catalogue import load_model
from socialmind.experiments import resume_sweep, sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.tables import window

window.WINDOW_SECONDS = (0.0, 0.0)
leading.JOB_SECONDS = 0.0
model, folder = load_model(sys.argv[1]), Path(sys.argv[2])
DESIGN = {"largest_gift": [i / 50 for i in range(100)]}
OPTIONS = {"every": 5, "measures": {"unequal": "gini(agents.money)"}, "agents": "last"}


def part(out, die_at):
    # The process is killed when so many runs are done, and a little later: within a write, often.
    def tell(done, total):
        if done >= die_at:
            threading.Timer(random.uniform(0, 0.02), os.kill, (os.getpid(), 9)).start()

    if out.exists():
        resume_sweep(out, workers=1, on_progress=tell)
    else:
        sweep(model, DESIGN, 20, range(2), compiled=False, workers=1, out=out, on_progress=tell,
              **OPTIONS)


def in_a_fork(out, die_at):
    child = os.fork()
    if child == 0:
        random.seed(die_at)
        part(out, die_at)
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


print(in_a_fork(folder / "whole", 1000))
for die_at in (0, 3, 17, 60, 61, 100, 150, 195, 199, 200, 1000):
    print(in_a_fork(folder / "killed", die_at))
"""


def test_killed_at_many_moments_it_ends_equal(gifts, contents, tmp_path):
    script = tmp_path / "killed.py"
    script.write_text(KILLED)
    words = [sys.executable, script, gifts, tmp_path]
    found = subprocess.run(words, capture_output=True, text=True, check=True)
    codes = [int(code) for code in found.stdout.split()]
    assert codes[0] == codes[-1] == 0
    assert codes.count(-signal.SIGKILL) >= 8
    assert contents(tmp_path / "killed") == contents(tmp_path / "whole")


def test_a_stop_is_heard_and_pending_runs_are_shown(gifts, whole, contents, tmp_path, one_by_one):
    def tell(done, _):
        if done == 2:
            os.kill(os.getpid(), signal.SIGINT)

    out = tmp_path / "s"
    with pytest.raises(SweepInterrupted) as stop:
        sweep(gifts, DESIGN, out=out, on_progress=tell, **OPTIONS)
    assert stop.value.done >= 2 and stop.value.total == 9
    manifest = json.loads((out / "manifest.json").read_text())
    assert manifest["status"] == "interrupted"
    shown = pd.read_parquet(out / "runs.parquet")
    assert shown["run"].tolist() == list(range(9))
    assert set(shown["status"]) == {"finished", "pending"}
    resume_sweep(out, workers=1)
    assert contents(out) == contents(whole)


def test_one_that_fails_is_recorded_and_can_be_retried(gifts, tmp_path):
    design = {"broken": [False, True, False], "n": [3, 4, 5]}
    out = sweep(gifts, design, 5, compiled=False, workers=1, out=tmp_path / "s")
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["finished", "failed", "finished"]
    assert runs["error"][1].startswith("run: ") and "model.py:21" in runs["error"][1]
    assert runs["error"].isna().tolist() == [True, False, True]
    assert Sweep(out).manifest.counts == {"failed": 1, "finished": 2}
    before = {path.name: path.read_bytes() for path in out.glob("*.parquet")}
    told = []
    resume_sweep(out, workers=1)  # only what is missing, and nothing is
    resume_sweep(out, retry=True, workers=1, on_progress=lambda *done: told.append(done))
    assert told == [(2, 3), (3, 3)]
    assert {path.name: path.read_bytes() for path in out.glob("*.parquet")} == before


def test_errors_name_their_stage(gifts, tmp_path):
    measures = {"odd": "richest[7]"}
    out = sweep(gifts, None, 5, compiled=False, workers=1, measures=measures, out=tmp_path / "s")
    (error,) = Sweep(out).runs["error"]
    assert error.startswith("measure: measure odd: 'richest[7]', column 1: index 7")


def test_what_a_table_cannot_hold_is_recorded_as_such(slow, tmp_path):
    out = sweep(slow, {"how": ["odd", "well"]}, 1, compiled=False, workers=1, out=tmp_path / "s")
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["failed", "finished"]
    assert runs["error"][0].startswith("record: series(): column tick_now: found [1]; expected")


def test_a_first_point_that_cannot_begin_is_recorded_where_others_can(slow, tmp_path):
    options = {"compiled": False, "workers": 1}
    out = sweep(slow, {"how": ["at once", "well"]}, 1, out=tmp_path / "s", **options)
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["failed", "finished"]
    assert re.search(r"model\.py:\d+: .*LookupError: nothing there", runs["error"][0])
    with pytest.raises(SocialmindError, match=r"model\.py:\d+: .*LookupError: nothing there"):
        sweep(slow, {"how": ["at once"]}, 1, out=tmp_path / "t", **options)
    assert not (tmp_path / "t").exists()


def test_one_that_hangs_is_timed_out_and_others_go_on(slow, tmp_path):
    design = {"how": ["well", "sleeps", "well"]}
    options = {"compiled": False, "workers": 1, "timeout": 2.0}
    out = sweep(slow, design, 1, out=tmp_path / "s", **options)
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["finished", "timed_out", "finished"]
    assert runs["error"][1] == "took longer than 2 s"


def test_one_that_ends_its_process_is_recorded_and_others_go_on(slow, tmp_path):
    design = {"how": ["well", "killed", "well", "well"]}
    out = sweep(slow, design, 1, compiled=False, workers=2, out=tmp_path / "s")
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["finished", "failed", "finished", "finished"]
    assert runs["error"][1].startswith("run: its process was ended by signal 9, 2 times")


def test_a_full_disk_stops_it_with_one_line(
    gifts, whole, contents, tmp_path, monkeypatch, one_by_one
):
    out, write, written = tmp_path / "s", Store.write, []

    def full(self, tables):
        written.append(1)
        if len(written) == 3:
            raise OSError(28, "No space left on device")
        write(self, tables)

    monkeypatch.setattr(Store, "write", full)
    with pytest.raises(SocialmindError, match=r"No space left .* go on with --resume"):
        sweep(gifts, DESIGN, out=out, **OPTIONS)
    resume_sweep(out, workers=1)
    assert contents(out) == contents(whole)


def test_replicates_are_added_until_intervals_are_narrow(gifts, contents, tmp_path):
    options = {**OPTIONS, "seeds": range(2), "until": "0.4:richest", "at_most": 40}
    design = {"largest_gift": [0.0, 1.0]}
    one = sweep(gifts, design, out=tmp_path / "one", **options)
    runs = Sweep(one).runs
    count = runs.groupby("point").size()
    assert count[0] == 5 and 5 < count[1] <= 40 and count[1] % 5 == 0
    assert runs["run"].tolist() == [*range(5), *range(40, 40 + count[1])]
    rich = runs.loc[runs["point"] == 1, "richest"]
    if count[1] < 40:
        half = 2.1 * rich.std() / np.sqrt(count[1])
        assert half < 0.45
    options["workers"] = 2
    assert contents(sweep(gifts, design, out=tmp_path / "two", **options)) == contents(one)


def test_a_csv_file_is_a_design(gifts, tmp_path):
    file = tmp_path / "points.csv"
    file.write_text("n,largest_gift\n3,0.5\n4,1.5\n")
    out = sweep(gifts, file, 2, compiled=False, workers=1, every=0, out=tmp_path / "s")
    assert Sweep(out).design.values.tolist() == [[0, 3, 0.5], [1, 4, 1.5]]
    assert not (out / "series.parquet").exists()
    with pytest.raises(SocialmindError, match="has no table of series; --every K keeps one"):
        Sweep(out).series  # noqa: B018
    file.write_text("n,largest_gift\n3,0.5\n4,9\n")
    with pytest.raises(SocialmindError, match=r"points\.csv:3: parameter largest_gift: found 9"):
        sweep(gifts, file, 2, out=tmp_path / "t")


def test_what_cannot_be_is_refused_before_a_run(gifts, tmp_path):
    def refused(message, design=None, **options):
        with pytest.raises(SocialmindError, match=message):
            sweep(gifts, design, out=tmp_path / "s", **{**OPTIONS, **options})
        assert not (tmp_path / "s").exists()

    refused("did you mean 'largest_gift'", {"largest_gif": [1.0]})
    refused("row 1 of the design: parameter n: found 99; expected 1 … 40", {"n": [3, 99]})
    refused("n is set twice", {"n": [3]}, fixed={"n": 4})
    refused("a measure called poor, as a column of the series", measures={"poor": "1"})
    refused("a measure called n, as what varies", {"n": [3]}, measures={"n": "1"})
    refused("no measure called 'rich'", until="1:rich", at_most=9)
    refused("until adds seeds after the last", seeds=[1, 3], until="1:richest", at_most=9)
    refused("one stands twice", seeds=[1, 1])
    refused("timeout: found 0; expected seconds above 0", timeout=0)
    refused("agents: found 'all'; expected none, last or a number", agents="all")
    refused("a design without points", {"n": []})


def test_a_model_that_was_changed_is_not_gone_on_with(gifts, tmp_path, one_by_one):
    folder = tmp_path / "model"
    folder.mkdir()
    text = (gifts / "model.py").read_text()
    (folder / "model.py").write_text(text)
    with pytest.raises(Enough):
        sweep(folder, DESIGN, out=tmp_path / "s", on_progress=stopped_at(2), **OPTIONS)
    (folder / "model.py").write_text(text.replace("uniform(0,", "uniform(0.1,"))
    with pytest.raises(SocialmindError, match=r"model\.py: is not the file"):
        resume_sweep(tmp_path / "s", workers=1)


def test_a_design_that_was_changed_is_not_gone_on_with(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "s")
    design = pd.read_parquet(tmp_path / "s" / "design.parquet")
    design.assign(n=4).to_parquet(tmp_path / "s" / "design.parquet")
    with pytest.raises(SocialmindError, match=r"design\.parquet: is not the design"):
        remake_run(tmp_path / "s", 0, tmp_path / "run")


def test_the_manifest_keeps_how_the_design_was_made(gifts, tmp_path):
    design = designs.lhs({"largest_gift": (0.0, 5.0), "n": (2, 9)}, 4, whole=["n"])
    out = sweep(gifts, design, 1, compiled=False, workers=1, out=tmp_path / "s")
    assert Sweep(out).manifest.design["name"] == "lhs"
    assert Sweep(out).manifest.design["ranges"] == {"largest_gift": [0.0, 5.0], "n": [2.0, 9.0]}


def test_a_cluster_comes_to_the_same(gifts, whole, contents, tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        options = {**OPTIONS, "workers": None, "cluster": cluster.scheduler_address}
        found = contents(sweep(gifts, DESIGN, out=tmp_path / "s", **options))
    assert found == contents(whole)
