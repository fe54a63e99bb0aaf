"""Fits as folders: equal whatever their workers and whatever stopped them, and what they tell."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from socialmind.catalogue import load_model
from socialmind.cli import app
from socialmind.errors import SocialmindError
from socialmind.experiments import Fit, FitInterrupted, fit, resume_fit
from socialmind.experiments.calibration.reporting import pictures

STATISTICS = {"start": (0.6, 0.02), "place": (2.0, 0.05)}
OPTIONS = {
    "vary": {"first": (0.0, 2.0), "pace": None}, "budget": 32, "seeds": 2, "recover": 2, "every": 1,
    "measures": {"start": "first(place)"}, "compiled": False, "workers": 1,
}  # fmt: skip


@pytest.fixture(scope="module")
def whole(hill, tmp_path_factory):
    """An undisturbed fit."""
    return fit(hill, STATISTICS, out=tmp_path_factory.mktemp("whole") / "fit", **OPTIONS)


@pytest.fixture
def undrawn(monkeypatch):
    """Leave the figures out, which take longer than all else."""
    monkeypatch.setattr(pictures, "figures_of", lambda _: {})


@pytest.fixture(scope="module")
def contents():
    """Return the bytes of all files of a fit that say what came of it."""

    def read(folder):
        kinds = ("*.parquet", "best*", "report.md", "target.csv")
        return {one.name: one.read_bytes() for kind in kinds for one in sorted(folder.glob(kind))}

    return read


def test_its_folder_tells_all_of_it(whole, contents):
    assert set(contents(whole.folder)) == {
        "best.csv", "best.json", "best_runs.parquet", "profiles.parquet", "recovery.parquet",
        "report.md", "target.csv", "trials.parquet",
    }  # fmt: skip
    for name in re.findall(r"figures/\w+", (whole.folder / "report.md").read_text()):
        for suffix in (".pdf", ".png"):
            assert (whole.folder / f"{name}{suffix}").stat().st_size > 2000
    assert not (whole.folder / "log.jsonl").exists()
    assert whole.manifest.status == "finished" and whole.manifest.method == "cmaes"
    assert whole.manifest.runs == 3 * (32 + 20) + 2 * 20
    trials = whole.trials
    assert trials.groupby("search").size().tolist() == [16, 16, 16]
    best = trials[trials["search"] == 0].sort_values("distance").iloc[0]
    assert whole.values == {"first": best["first"], "pace": best["pace"]}
    assert list(whole.recovery["parameter"]) == ["first", "pace"] * 2
    assert whole.profiles.groupby("parameter")["trials"].sum().tolist() == [16, 16]
    assert len(whole.best_runs) == 20 and list(whole.best_runs) == ["run", "seed", *STATISTICS]
    assert "<table" in whole._repr_html_()


def test_a_run_on_a_new_seed_is_the_model_s(whole, hill):
    runs = whole.best_runs
    society = load_model(hill)(seed=int(runs["seed"][3]), compiled=False, **whole.values)
    assert runs["start"][3] == society.series()["place"]
    society.advance(4)
    assert runs["place"][3] == society.series()["place"]


def test_two_workers_come_to_the_same(whole, hill, contents, tmp_path, undrawn):
    again = fit(hill, STATISTICS, out=tmp_path / "fit", **{**OPTIONS, "workers": 2})
    assert contents(again.folder) == contents(whole.folder)


def test_a_stop_is_heard_and_gone_on_with(whole, hill, contents, tmp_path, undrawn):
    def tell(done, _):
        if done >= 41:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(FitInterrupted) as stop:
        fit(hill, STATISTICS, out=tmp_path / "fit", on_progress=tell, **OPTIONS)
    assert stop.value.done >= 41 and stop.value.total == whole.manifest.runs
    with pytest.raises(SocialmindError, match=r"interrupted.*socialmind fit --resume"):
        Fit(tmp_path / "fit")
    counted = []
    resume_fit(tmp_path / "fit", workers=1, on_progress=lambda done, _: counted.append(done))
    assert counted[0] >= 12 and counted[-1] == whole.manifest.runs
    assert contents(tmp_path / "fit") == contents(whole.folder)


KILLED = """
import os
import signal
import sys

import cmaes, pandas, scipy.stats  # at once, rather than in each fork

from socialmind.experiments import fit, resume_fit
from socialmind.experiments.calibration.reporting import pictures

HILL, OUT, KILLS = sys.argv[1], sys.argv[2], (0, 19, 61, 130, 196)
pictures.figures_of = lambda _: {}


def tell(at):
    def count(done, _):
        if done >= at:
            os.kill(os.getpid(), signal.SIGKILL)

    return count


for at in KILLS:
    child = os.fork()
    if child == 0:
        if os.path.exists(OUT):
            resume_fit(OUT, workers=1, on_progress=tell(at))
        else:
            fit(HILL, STATISTICS, out=OUT, on_progress=tell(at), **OPTIONS)
        os._exit(0)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    if os.path.exists(OUT + "/log.jsonl"):
        with open(OUT + "/log.jsonl", "ab") as file:
            file.write(b'{"search": 0, "kin')
resume_fit(OUT, workers=1)
"""


def test_killed_at_many_moments_it_ends_equal(whole, hill, contents, tmp_path):
    script = tmp_path / "killed.py"
    script.write_text(f"STATISTICS = {STATISTICS!r}\nOPTIONS = {OPTIONS!r}\n{KILLED}")
    words = [sys.executable, script, hill, tmp_path / "fit"]
    found = subprocess.run(words, capture_output=True, text=True, check=True)
    assert [int(code) for code in found.stdout.split()] == [-signal.SIGKILL] * 5
    assert contents(tmp_path / "fit") == contents(whole.folder)


def test_a_series_is_fitted_where_it_was_seen(hill, tmp_path, undrawn):
    society = load_model(hill)(seed=5, compiled=False, first=0.5, pace=0.25)
    society.advance(2)
    rows = {2: society.series()["place"]}
    society.advance(4)
    rows[6] = society.series()["place"]
    lines = ["tick,place", *(f"{tick},{place}" for tick, place in rows.items())]
    (tmp_path / "seen.csv").write_text("\n".join(lines))
    options = {**OPTIONS, "measures": None, "every": None, "recover": 0, "budget": 60}
    found = fit(hill, tmp_path / "seen.csv", out=tmp_path / "fit", **options)
    assert found.manifest.ticks == 6
    assert sorted(set(found.best_runs["tick"])) == [2, 6]
    assert found.values["first"] + 6 * found.values["pace"] == pytest.approx(2.0, abs=0.25)
    report = (found.folder / "report.md").read_text()
    assert "**It was not checked whether such data can tell these parameters**" in report
    assert set(found.parameters["verdict"]) == {"not checked"}


def test_runs_that_fail_or_have_no_number_count_as_the_worst(hill, tmp_path, undrawn):
    for mood, said in {
        "broken": "run: .*LookupError: lost the way",
        "nothing": "compare: height is nan",
    }.items():
        target = {"place": (2.0, 0.1), "height": (1.0, 0.1)}
        options = {**OPTIONS, "measures": None, "fixed": {"mood": mood}, "recover": 1}
        found = fit(hill, target, out=tmp_path / mood, **options)
        bad = found.trials[found.trials["pace"] > 0.5]
        assert len(bad) and np.isinf(bad["distance"]).all() and (bad["failed"] == 2).all()
        assert re.search(said, bad["error"].iloc[0])
        assert np.isfinite(found.trials[found.trials["pace"] <= 0.5]["distance"]).all()
        assert found.values["pace"] <= 0.5


def test_a_measure_that_no_run_has_stops_with_its_reason(hill, tmp_path):
    options = {**OPTIONS, "measures": {"start": "log(0 - first(place))"}, "recover": 0}
    with pytest.raises(SocialmindError, match=r"no trial came to its end: compare: start is nan"):
        fit(hill, {"start": (1, 1)}, out=tmp_path / "fit", **options)
    manifest = json.loads((tmp_path / "fit" / "manifest.json").read_text())
    assert manifest["status"] == "failed" and "start is nan" in manifest["error"]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"budget": 7}, "expected 8 trials or more where 2 things vary, a budget of 16"),
        ({"method": "cma"}, "no method called 'cma'; did you mean 'cmaes'"),
        ({"recover": -1}, "recover"),
        ({"vary": {"first": (2.0, 0.0)}}, "expected the lower end first"),
        ({"vary": {"frist": (0.0, 2.0)}}, "did you mean 'first'"),
        ({"fixed": {"first": 1.0}}, "first is set twice"),
        ({"measures": {"place": "first(place)"}}, "a measure called place, as a column of the"),
        ({"measures": {}}, "start: neither a measure nor a column of the series"),
        ({"target": "seen.csv", "ticks": 5}, "its last tick is 6, and runs end at 5"),
        ({"target": "seen.csv"}, "--every is for measures of statistics"),
    ],
)
def test_what_cannot_be_is_refused_before_a_folder_is_made(
    hill, tmp_path, monkeypatch, changes, said
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "seen.csv").write_text("tick,place\n6,1\n")
    given = {"target": STATISTICS, **OPTIONS, **changes}
    with pytest.raises(SocialmindError) as refused:
        fit(hill, out=tmp_path / "fit", **given)
    assert said in str(refused.value)
    assert not (tmp_path / "fit").exists()


def test_a_changed_model_or_target_is_not_gone_on_with(hill, tmp_path, monkeypatch):
    def stop(*_):
        raise RuntimeError

    copy = tmp_path / "hill"
    copy.mkdir()
    (copy / "model.py").write_text((hill / "model.py").read_text())
    with pytest.raises(RuntimeError):
        fit(copy, STATISTICS, out=tmp_path / "fit", on_progress=stop, **OPTIONS)
    with monkeypatch.context() as patch:
        patch.setattr(
            "socialmind.experiments.calibration.preparing.libraries", lambda _: {"cmaes": "0.0"}
        )
        with pytest.raises(SocialmindError, match=r"made with cmaes .*, this is 0\.0"):
            resume_fit(tmp_path / "fit", workers=1)
    target = tmp_path / "fit" / "target.csv"
    before = target.read_text()
    target.write_text(before.replace("0.02", "0.03"))
    with pytest.raises(SocialmindError, match="is not the target that the fit was begun with"):
        resume_fit(tmp_path / "fit", workers=1)
    target.write_text(before)
    (copy / "model.py").write_text((hill / "model.py").read_text().replace("0.01", "0.02"))
    with pytest.raises(SocialmindError, match=r"model\.py"):
        resume_fit(tmp_path / "fit", workers=1)


def test_link_weights_are_fitted_and_run(tmp_path, monkeypatch, undrawn):
    monkeypatch.chdir(tmp_path)
    words = (
        "fit farmer_artisan --target wheat=900±50 --vary influence.Farmer.GrowWheat=1:10 "
        "--vary tool_price=100:250 --set n_agents=3 --budget 8 --seeds 1 --ticks 20 --recover 1 "
        "--data-runs 1 --workers 1 --interpreted --out fit --method lhs"
    )
    result = CliRunner().invoke(app, shlex.split(words))
    assert result.exit_code == 0, result.output
    assert "in all 57 runs" in result.output and "report: " in result.output
    found = Fit("fit")
    seed = found.best_runs["seed"][0]
    monkeypatch.chdir(tmp_path / "fit")
    for kind, more in {"run": f"--seed {seed} --out r", "sweep": "--out s --workers 1"}.items():
        words = shlex.split(f"{found.best[kind]} {more} --interpreted --quiet")[1:]
        words = ["0:2" if word == "0:50" else word for word in words]
        result = CliRunner().invoke(app, words)
        assert result.exit_code == 0, result.output
    runs = pd.read_parquet("s/runs.parquet")
    assert runs["influence.Farmer.GrowWheat"].iloc[0] == found.values["influence.Farmer.GrowWheat"]
    seen = pd.read_parquet("r/series.parquet")["wheat"].iloc[-1]
    assert seen == found.best_runs["wheat"][0]


def test_the_command_says_what_is_wrong_in_one_line(hill, tmp_path, whole):
    for words, said in {
        f"fit {hill} --target place=1+-1 --vary pace": "give --budget",
        f"fit {hill} --budget 9 --vary pace": "expected a file of a series, or NAME=VALUE±ERROR",
        f"fit {hill} --target place=1 --vary pace --budget 9": "write place=1±ERROR",
        f"fit --resume {whole.folder} --budget 9": "--resume with --budget",
        f"fit --resume {hill}": "not a fit's folder",
        f"sweep --resume {whole.folder}": "`socialmind fit --resume` goes on with a fit",
    }.items():
        result = CliRunner().invoke(app, shlex.split(words))
        assert result.exit_code == 2
        assert said in result.output and result.output.count("\n") == 1, result.output
    result = CliRunner().invoke(app, ["fit", "--resume", str(whole.folder), "--quiet"])
    assert result.output.strip() == str(whole.folder)
