"""Branches: equal to the run until something changes, and runs of their own from there."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from coglogo_py import SchemeError
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Change, Run, Shock, branch, replay, resume, run
from socialmind.interventions.shock import function_in
from socialmind.runs import loop
from socialmind.runs.branching.repeating import explain
from socialmind.runs.capsule import Capsule

CHECKOUT = Path(__file__).parents[3]
HAMLET = Path(__file__).parent / "hamlet"
HAPPENS = HAMLET / "what_happens.py"
TICKS = 40


def happening(name):
    return function_in(f"{HAPPENS}:{name}")


@pytest.fixture(scope="module")
def hamlet():
    return load_model(HAMLET)


@pytest.fixture(scope="module")
def whole(hamlet, tmp_path_factory):
    """A run of forty ticks, interpreted, with a famine at tick 12."""
    out = tmp_path_factory.mktemp("whole") / "run"
    shocks = [Shock(12, happening("famine"))]
    return run(hamlet, TICKS, 5, every=3, agents_every=6, out=out, compiled=False,
               interventions=shocks)  # fmt: skip


def same(one, other):
    """Whether two finished runs have the same tables, byte for byte, and end in the same state."""
    tables = {path.name: path.read_bytes() for path in Path(one).glob("*.parquet")}
    assert tables == {path.name: path.read_bytes() for path in Path(other).glob("*.parquet")}
    states = [np.load(Path(each) / "checkpoint.npz") for each in (one, other)]
    names = [name for name in states[0].files if name.startswith("state/")]
    assert names == [name for name in states[1].files if name.startswith("state/")]
    return all(bits(states[0][name]) == bits(states[1][name]) for name in names)


def bits(array):
    """What an array holds, without the bytes between the fields of its records."""
    fields = array.dtype.names
    return [array[name].tobytes() for name in fields] if fields else array.tobytes()


# Nothing changes ----------------------------------------------------------------------------------


@settings(max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(at=st.integers(0, TICKS))
def test_a_branch_without_a_change_is_the_run(whole, tmp_path_factory, at):
    assert same(branch(whole, at, out=tmp_path_factory.mktemp("b") / "run"), whole)


@pytest.mark.parametrize(
    ("model", "ticks", "parameters"),
    [
        ("wolf_cow", 30, {}),  # births and deaths, two breeds
        ("herds", 25, {}),  # groups
        ("collect", 40, {}),  # a plane and a hierarchy of skills
        ("farmer_artisan", 60, {"n_agents": 6}),
        ("farmers_artisans_traders", 30, {}),
    ],
)
def test_so_it_is_for_models_that_ship(tmp_path, model, ticks, parameters):
    first = run(load_model(model), ticks, 3, parameters, every=4, out=tmp_path / "run",
                compiled=False)  # fmt: skip
    assert same(branch(first, ticks // 2 + 1, out=tmp_path / "branch"), first)


def test_compiled_and_interpreted_branches_are_equal(hamlet, whole, tmp_path):
    how = {"settings": {"yields": 2.0, "start.hunger": 2}, "do": [happening("move_minds")]}
    one = branch(whole, 20, out=tmp_path / "interpreted", **how)
    other = branch(whole, 20, out=tmp_path / "compiled", compiled=True, **how)
    assert same(one, other)


def test_the_run_that_is_left_stays_as_it_is(whole, tmp_path):
    before = {path: path.read_bytes() for path in whole.rglob("*") if path.is_file()}
    branch(whole, 20, {"yields": 0.1}, out=tmp_path / "run")
    assert {path: path.read_bytes() for path in whole.rglob("*") if path.is_file()} == before


# What changes -------------------------------------------------------------------------------------


def test_what_changes_shows_after_its_tick_only(whole, tmp_path):
    changed = Run(branch(whole, 21, {"yields": 9.0}, out=tmp_path / "run"))
    one, other = Run(whole).series, changed.series
    assert one[one["tick"] <= 21].equals(other[other["tick"] <= 21])
    assert not one.equals(other)
    said = changed.manifest.branch
    assert said["run"] == str(whole) and said["tick"] == 21 and said["change"] == ["yields=9.0"]
    assert changed.parameters["yields"] == 1.0  # with which it began


def test_everything_can_change_at_once(whole, tmp_path):
    scheme = tmp_path / "other.yaml"
    text = (HAMLET / "scheme.yaml").read_text()
    scheme.write_text(text.replace("  greed:", "  envy:\n    influence: {trade: 1}\n  greed:"))
    made = branch(
        whole, 15, {"yields": "3", "influence.greed.trade": "2"}, scheme,
        [happening("move_minds"), happening("exodus")], 50, tmp_path / "run",
    )  # fmt: skip
    kept = Run(made)
    assert kept.ticks == 50
    (change,) = [one for one in kept.manifest.interventions if "parameters" in one]
    text = (made / change["schemes"]["people"]["file"]).read_text()
    assert "influence: {trade: 2}" in text and "envy" in text
    died = kept.events.query("event == 'died' and tick == 16")
    assert len(died) >= 2
    assert kept.manifest.branch["change"] == [
        "yields=3.0", "scheme of people: other.yaml", "people.influence.greed.trade=2",
        "do move_minds", "do exodus",
    ]  # fmt: skip


def test_a_branch_is_a_run_with_the_same_done_to_it(hamlet, whole, tmp_path):
    made = branch(whole, 20, {"yields": 2.0}, do=[happening("gift")], out=tmp_path / "branch")
    done = [
        Shock(12, happening("famine")),
        Change(20, {"yields": 2.0}),
        Shock(20, happening("gift")),
    ]
    straight = run(hamlet, TICKS, 5, every=3, agents_every=6, out=tmp_path / "run", compiled=False,
                   interventions=done)  # fmt: skip
    assert same(made, straight)
    assert Run(made).manifest.identity() == Run(straight).manifest.identity()


# Runs of their own --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def changed(whole, tmp_path_factory):
    out = tmp_path_factory.mktemp("changed") / "run"
    how = {"settings": {"yields": 2.0, "influence.zeal.work": 0.2}, "do": [happening("gift")]}
    return branch(whole, 20, out=out, **how)


def test_a_branch_is_replayed_and_made_longer(changed, whole, tmp_path):
    assert replay(changed).equal
    longer = shutil.copytree(changed, tmp_path / "longer")
    resume(longer, ticks=60)
    assert replay(longer).equal
    how = {"settings": {"yields": 2.0, "influence.zeal.work": 0.2}, "do": [happening("gift")]}
    assert same(longer, branch(whole, 20, ticks=60, out=tmp_path / "at once", **how))


@pytest.mark.parametrize("at", [7, 20, 33])
def test_a_branch_is_branched(changed, tmp_path, at):
    again = branch(changed, at, out=tmp_path / "again")
    assert same(again, changed)
    other = branch(changed, at, {"yields": 0.0}, out=tmp_path / "other")
    assert replay(other).equal
    assert Run(other).manifest.branch["identity"] == Run(changed).manifest.identity()


def test_a_decision_is_explained_as_it_was_taken(changed):
    agents = Run(changed).agents
    agent = int(agents[agents["tick"] == 36]["agent"].iloc[0])
    told = explain(Capsule(changed), agent, 30)
    plan = agents.query("tick == 30 and agent == @agent")["plan"].item()
    assert told.choice == plan
    assert "zeal" in str(told)


@pytest.mark.parametrize("moment", ["before the first checkpoint", "on the way", "at the end"])
def test_a_killed_branch_goes_on(changed, whole, tmp_path, moment):
    kills = {
        "before the first checkpoint": "checkpoint.Checkpoint.save = die",
        "on the way": "progress = lambda done, length: done >= 27 and die()",
        "at the end": "continuing.merge = die",
    }[moment]
    script = f"""
import os, signal, sys
from socialmind.experiments import branch
from socialmind.interventions.shock import function_in
from socialmind.runs import checkpoint, continuing, loop
loop.CHECKPOINT_COST = loop.PROGRESS_SECONDS = loop.CHUNK_SECONDS = 0.0
progress = None
def die(*_, **__): os.kill(os.getpid(), signal.SIGKILL)
{kills}
branch({str(whole)!r}, 20, {{"yields": 2.0, "influence.zeal.work": 0.2}},
       do=[function_in({f"{HAPPENS}:gift"!r})], out={str(tmp_path / "run")!r},
       checkpoint_every=0.0, on_progress=progress)
"""
    environment = {**os.environ, "PYTHONPATH": str(CHECKOUT)}
    words = [sys.executable, "-c", script]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=300, env=environment)
    assert ended.returncode == -signal.SIGKILL, ended.stderr
    assert same(resume(tmp_path / "run"), changed)


def test_a_branch_needs_neither_the_run_nor_the_files_of_its_shocks(hamlet, tmp_path):
    own = shutil.copytree(HAMLET, tmp_path / "own")
    (own / "helping.py").write_text("HARVEST = 1.5\n")
    text = HAPPENS.read_text().replace("HARVEST = 2.5", "from helping import HARVEST")
    (own / "what_happens.py").write_text(text)
    do = function_in(f"{own}/what_happens.py:gift")
    first = run(hamlet, 20, 1, out=tmp_path / "run", compiled=False)
    made = branch(first, 10, {"influence.greed.trade": 4}, do=[do], out=tmp_path / "branch")
    shutil.rmtree(own)
    shutil.rmtree(first)
    assert replay(made).equal
    resume(made, ticks=30)
    assert replay(made).equal


def test_an_unfinished_run_is_branched_from_what_is_safe(hamlet, whole, tmp_path, monkeypatch):
    monkeypatch.setattr(loop, "CHUNK_SECONDS", 1e-9)
    monkeypatch.setattr(loop, "CHECKPOINT_COST", 0)
    monkeypatch.setattr(loop, "PROGRESS_SECONDS", 0.0)

    def stop(done, _length):
        if done >= 25:
            raise MemoryError

    with pytest.raises(SocialmindError):
        run(hamlet, TICKS, 5, every=3, agents_every=6, out=tmp_path / "run", compiled=False,
            interventions=[Shock(12, happening("famine"))], on_progress=stop,
            checkpoint_every=0.0)  # fmt: skip
    done = Run(tmp_path / "run").ticks
    assert 20 <= done < TICKS
    assert same(branch(tmp_path / "run", 17, out=tmp_path / "branch"), whole)
    with pytest.raises(SocialmindError, match=f"tick {done + 1}; expected 0 … {done}"):
        branch(tmp_path / "run", done + 1)


# Refused in one line, before a folder is made -----------------------------------------------------


@pytest.mark.parametrize(
    ("how", "error", "message"),
    [
        ({"at": 41}, SocialmindError, "tick 41; expected 0 … 40, the ticks that the run has done"),
        ({"ticks": 10}, SocialmindError, "ticks: 10 in all, and the branch begins at tick 20"),
        ({"settings": {"n": 3}}, SocialmindError, "n: says how large 'people' is at the start"),
        ({"settings": {"yields": 11}}, SocialmindError, "parameter yields: found 11"),
        ({"settings": {"yeilds": 1}}, SocialmindError, "no parameter called yeilds; did you mean"),
        ({"settings": {"influence.zeal.rest": 1}}, SchemeError, "no plan 'rest' in scheme 'folk'"),
        ({"settings": {"cows.start.zeal": 1}}, SocialmindError, "no population 'cows' with a sch"),
        ({"settings": {"colour.zeal": 1}}, SocialmindError, "neither a parameter of hamlet nor a"),
        ({"scheme": {"cows": HAMLET / "scheme.yaml"}}, SocialmindError, "scheme of 'cows' in"),
        ({"scheme": HAMLET / "none.yaml"}, SchemeError, "none.yaml"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(whole, tmp_path, how, error, message):
    with pytest.raises(error, match=message) as caught:
        branch(whole, **{"at": 20, "out": tmp_path / "run", **how})
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_failing_shock_leaves_a_run_that_says_so(hamlet, tmp_path):
    with pytest.raises(SocialmindError, match=r"what_happens\.py:\d+: the shock fails at tick 8: "):
        run(hamlet, 20, out=tmp_path / "run", compiled=False,
            interventions=[Shock(8, happening("fails"))])  # fmt: skip
    manifest = json.loads((tmp_path / "run/manifest.json").read_text())
    assert manifest["status"] == "failed" and "what_happens.py" in manifest["error"]


def test_a_run_keeps_functions_of_files_alone(hamlet, tmp_path):
    with pytest.raises(
        SocialmindError, match="not at the top of a file, so a run could not repeat"
    ):
        run(hamlet, 20, out=tmp_path / "run", interventions=[Shock(8, lambda society: None)])


def test_a_copy_of_a_shock_that_was_changed_is_refused(whole, tmp_path):
    copy = shutil.copytree(whole, tmp_path / "run")
    (file,) = copy.glob("interventions/*/source/model/what_happens.py")
    file.write_text(file.read_text() + "\n# another\n")
    with pytest.raises(SocialmindError, match="is not the file that the run was made with"):
        replay(copy)


def test_unknown_programs_of_shocks_are_not_run_unasked(whole, tmp_path, monkeypatch):
    monkeypatch.setenv("SOCIALMIND_DATA_DIR", str(tmp_path / "data"))
    with pytest.raises(SocialmindError, match=r"holds programs .* run them with --trust"):
        replay(whole)
