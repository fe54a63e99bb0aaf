"""`socialmind sweep`: from words to tables; a run of it made again; what is refused."""

import os
import signal

import pandas as pd
import pytest

from socialmind.experiments import Run, Sweep
from socialmind.experiments.sweeps import leading

QUICK = ("--ticks", 10, "--interpreted", "--workers", 1)


@pytest.fixture(scope="module")
def swept(socialmind, grazers, tmp_path_factory):
    out = tmp_path_factory.mktemp("swept") / "sweep"
    words = ("--grid", "n_grazers=3,5", "--seeds", "0:2", "--every", 5, "--agents", "last")
    result = socialmind("sweep", grazers, *words, *QUICK, "--out", out)
    assert result.exit_code == 0, result.output
    assert result.stdout.strip() == str(out)
    first, last = result.stderr.splitlines()
    assert first == "2 points (grid) × 2 seeds = 4 runs of 10 ticks"
    assert last.startswith("4 runs in ")
    return out


def test_a_run_of_a_sweep_is_made_again(socialmind, swept, tmp_path):
    result = socialmind("run", "--from-sweep", swept, "--number", 3, "--out", "run", "--quiet")
    assert result.exit_code == 0, result.output
    run = Run("run")
    assert run.parameters["n_grazers"] == 5 and run.seed == Sweep(swept).runs["seed"][3]
    series = Sweep(swept).series
    own = series[series["run"] == 3].drop(columns="run").reset_index(drop=True)
    pd.testing.assert_frame_equal(run.series, own, check_exact=True)


def test_set_sample_measures_and_a_function_of_a_file(socialmind, grazers, tmp_path):
    (tmp_path / "mine.py").write_text("def twice(series):\n    return 2.0 * series['tick'][-1]\n")
    result = socialmind(
        "sweep", grazers, "--sample", "lhs:3", "--ranges", "n_grazers=2:9", "--every", 0,
        "--measure", "end=last(tick)", "--measure", "twice=mine.py:twice", "--quiet",
        *QUICK, "--out", "s",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    runs = Sweep("s").runs
    assert runs["end"].tolist() == [10] * 3 and runs["twice"].tolist() == [20.0] * 3
    assert runs["n_grazers"].between(2, 9).all()
    assert not (tmp_path / "s" / "series.parquet").exists()


def test_a_shock_strikes_each_run_as_in_run(socialmind, grazers, tmp_path):
    (tmp_path / "plague.py").write_text("def strike(society):\n    society.grazers[0].die()\n")
    words = ("--ticks", 10, "--every", 5, "--interpreted", "--quiet")
    shock = ("--shock", "4:plague.py:strike")
    result = socialmind("sweep", grazers, *words, *shock, "--seeds", "7:8", "--common", "--workers",
                        1, "--out", "s")  # fmt: skip
    assert result.exit_code == 0, result.output
    result = socialmind("run", grazers, *words, *shock, "--seed", 7, "--out", "run")
    assert result.exit_code == 0, result.output
    own = Sweep("s").series.drop(columns="run")
    pd.testing.assert_frame_equal(Run("run").series, own, check_exact=True)
    told = socialmind("methods", "s")
    assert "at tick 4 strike (plague.py, SHA-256 " in told.stdout, told.output
    told = socialmind("methods", "run")
    assert "at tick 4 strike (plague.py, SHA-256 " in told.stdout
    copy = tmp_path / "run/interventions/00-strike/source/model/plague.py"
    assert f"--shock 4:{copy}:strike`" in told.stdout
    refused = socialmind("sweep", "--resume", "s", *shock)
    assert refused.exit_code != 0 and "shock" in refused.stderr


def test_a_stopped_one_says_how_to_go_on(socialmind, grazers, tmp_path, monkeypatch):
    monkeypatch.setattr(leading, "JOB_SECONDS", 0.0)
    done = []
    take = leading.Lead._take

    def stopping(self, one):
        take(self, one)
        done.append(1)
        if len(done) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(leading.Lead, "_take", stopping)
    result = socialmind("sweep", grazers, "--seeds", "0:5", *QUICK, "--out", "s")
    assert result.exit_code == 130
    assert result.stderr.splitlines()[-1].startswith("socialmind: stopped after ")
    assert "`socialmind sweep --resume" in result.stderr
    assert set(Sweep("s").runs["status"]) == {"finished", "pending"}
    result = socialmind("sweep", "--resume", "s", "--workers", 1)
    assert result.exit_code == 0, result.output
    assert len(Sweep("s").runs) == 5


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--grid n_grazer=1", "did you mean 'n_grazers'?"),
        ("--grid n_grazers=1.5", "expected a whole number"),
        ("--grid n_grazers=2,2", "a value stands twice"),
        ("--grid n_grazers", "expected NAME=V1,V2,…"),
        ("--grid n_grazers=2 --sample lhs:3", "give one of them"),
        ("--sample lhs --ranges n_grazers=1:9", "expected lhs:SIZE, as lhs:256"),
        ("--sample sobel:8", "did you mean 'sobol'?"),
        ("--ranges n_grazers=1:9", "--ranges is for --sample"),
        ("--sample lhs:3 --ranges n_grazers=9", "expected n_grazers=LOW:HIGH"),
        ("--seeds 0", None),
        ("--seeds x", "--seeds 'x': expected a range as 0:50, or 1,5,9"),
        ("--measure mean(tick)", "expected NAME=EXPRESSION"),
        ("--measure a=mean(tock)", "column 6: no column 'tock' of the series"),
        ("--until 5:tock --at-most 9", "no measure called 'tock'"),
        ("--at-most 9", "--at-most is for --until"),
        ("--retry", "--retry is for --resume"),
        ("--timeout 0", "expected seconds above 0"),
        ("--design none.csv", "none.csv: No such file"),
    ],
)
def test_what_is_refused(socialmind, refused, grazers, words, said, tmp_path):
    if said is None:
        assert socialmind("sweep", grazers, *words.split(), *QUICK, "--quiet").exit_code == 0
        return
    assert said in refused("sweep", grazers, *words.split(), *QUICK, "--out", "s")
    assert not (tmp_path / "s").exists()


def test_what_does_not_go_together_is_refused(refused, swept, grazers, done):
    assert "--resume with --seeds: a sweep keeps" in refused(
        "sweep", "--resume", swept, "--seeds", "0:3"
    )
    assert "go together" in refused("run", "--from-sweep", swept)
    assert "--from-sweep with --seed" in refused(
        "run", "--from-sweep", swept, "--number", 0, "--seed", 3
    )
    assert "no run 4; its runs are 0 … 3" in refused("run", "--from-sweep", swept, "--number", 4)
    on = "`socialmind {} --resume` goes on with a {}"
    assert f"not a sweep's folder; {on.format('run', 'run')}" in refused("sweep", "--resume", done)
    assert f"not a run's folder; {on.format('sweep', 'sweep')}" in refused("run", "--resume", swept)
    assert "which model?" in refused("sweep")
