"""Births and deaths as a table of a run: whole however it is stopped, and only where asked."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from socialmind import Agent, Model, Population, SocialmindError, each
from socialmind.catalogue import load_model
from socialmind.experiments import Run, replay, resume, run
from socialmind.runs import loop
from socialmind.runs.tables import growing
from socialmind.runs.tables.files import content_of
from socialmind.runs.verification import compare

CHECKOUT = Path(__file__).parents[2]
NAMES = ("series", "agents", "events")
HOW = {"ticks": 120, "seed": 4, "every": 1, "agents_every": 5}


def bytes_of(folder):
    return {name: (folder / f"{name}.parquet").read_bytes() for name in NAMES}


@pytest.fixture(scope="module")
def kind():
    return load_model("wolves_sheep")


@pytest.fixture(scope="module")
def whole(kind, tmp_path_factory):
    return run(kind, out=tmp_path_factory.mktemp("whole") / "run", **HOW)


def test_events_and_founders_give_the_series_and_the_agents(kind, whole):
    done = Run(whole)
    events = done.events
    assert events.columns.tolist() == ["tick", "population", "agent", "event", "parent"]
    living = {
        name: set(done.agents.query("tick == 0 and population == @name")["agent"])
        for name in ("sheep", "wolves")
    }
    at = dict(iter(events.groupby("tick")))
    agents = dict(iter(done.agents.groupby("tick")))
    for row in done.series.itertuples():
        for _, one in at.get(row.tick, events[:0]).iterrows():
            there = living[one["population"]]
            if one["event"] == "born":
                assert one["parent"] in there and one["agent"] not in there
                there.add(one["agent"])
            else:
                assert np.isnan(one["parent"])
                there.remove(one["agent"])
        assert (len(living["sheep"]), len(living["wolves"])) == (row.sheep, row.wolves)
        if row.tick in agents:
            found = agents[row.tick]
            for name, one in living.items():
                assert set(found["agent"][found["population"] == name]) == one
    assert len(events) > 1000


def test_the_types_of_the_columns_are_fixed(whole, tmp_path):
    expected = {
        "tick": "int64", "population": "string", "agent": "int64", "event": "string",
        "parent": "int64",
    }  # fmt: skip
    assert Run(whole).manifest.tables["events"]["columns"] == expected
    none = run(load_model("wolves_sheep"), ticks=0, out=tmp_path / "run", compiled=False)
    assert Run(none).manifest.tables["events"] == {
        "rows": 0, "columns": expected, "sha256": content_of(none / "events.parquet").sha256,
    }  # fmt: skip
    assert not len(Run(none).events)


def test_both_speeds_and_any_chunks_and_parts_give_the_same_table(
    kind, whole, tmp_path, monkeypatch
):
    plain = run(kind, out=tmp_path / "plain", compiled=False, **HOW)
    assert bytes_of(plain) == bytes_of(whole)
    monkeypatch.setattr(loop, "CHUNK_SECONDS", 1e-9)  # one tick at a time
    monkeypatch.setattr(growing, "WAITING_ROWS", 100)
    parts = run(kind, out=tmp_path / "parts", checkpoint_every=0.0, **HOW)
    assert bytes_of(parts) == bytes_of(whole)


def test_a_run_made_longer_has_the_events_of_one_never_stopped(kind, whole, tmp_path):
    folder = run(kind, out=tmp_path / "run", **{**HOW, "ticks": 63})
    resume(folder, 91)
    resume(folder, 120, compiled=False)
    assert bytes_of(folder) == bytes_of(whole)
    assert replay(folder).equal


KILLED = """
import os, signal, sys
sys.path.insert(0, {checkout!r})
from socialmind.catalogue import load_model
from socialmind.experiments import run
from socialmind.runs import checkpoint, continuing, loop
from socialmind.runs.tables import growing
def die(*_, **__):
    os.kill(os.getpid(), signal.SIGKILL)
def die_after(calls, owner, name):
    real, left = getattr(owner, name), [calls]
    def replaced(*args, **options):
        left[0] -= 1
        return die() if left[0] < 0 else real(*args, **options)
    setattr(owner, name, replaced)
loop.CHECKPOINT_COST = loop.CHUNK_SECONDS = 0.0
growing.WAITING_ROWS = 200
{moment}
run(load_model("wolves_sheep"), out={out!r}, checkpoint_every=0.0, **{how!r})
"""


@pytest.mark.parametrize(
    "moment",
    [
        "die_after(0, growing.EventTable, 'flush')",
        "die_after(9, growing.EventTable, 'flush')",
        "die_after(7, checkpoint.Checkpoint, 'save')",
        "die_after(2, continuing, 'merge')",
    ],
)
def test_killed_and_gone_on_with_it_is_as_if_never_killed(whole, tmp_path, moment):
    out = tmp_path / "run"
    script = KILLED.format(checkout=str(CHECKOUT), moment=moment, out=str(out), how=HOW)
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, check=False)
    assert ended.returncode == -signal.SIGKILL, ended.stderr.decode()
    resume(out)
    assert bytes_of(out) == bytes_of(whole)


def test_a_table_that_was_altered_is_named_by_the_replay(kind, tmp_path):
    folder = run(kind, out=tmp_path / "run", **{**HOW, "ticks": 20})
    table = pq.read_table(folder / "events.parquet")
    agents = table["agent"].to_pylist()
    agents[5] += 1000
    place = table.schema.get_field_index("agent")
    pq.write_table(table.set_column(place, "agent", [agents]), folder / "other.parquet")
    found = compare(folder / "events.parquet", folder / "other.parquet", "events")
    assert str(found).startswith("events: column agent first differs at tick 1: ")
    (folder / "other.parquet").replace(folder / "events.parquet")
    assert [one.table for one in replay(folder).differences] == ["events", "events"]


def test_runs_may_go_without_and_stay_without(kind, tmp_path):
    folder = run(kind, out=tmp_path / "run", events=False, **{**HOW, "ticks": 10})
    assert not (folder / "events.parquet").exists()
    with pytest.raises(SocialmindError, match=r"has no table of events; only runs of models in"):
        Run(folder).events  # noqa: B018
    resume(folder, 20)
    assert "events" not in Run(folder).manifest.tables
    assert replay(folder).equal

    class Quiet(kind):
        record_events = False

    assert "events" not in Run(run(Quiet, 3, out=tmp_path / "quiet")).manifest.tables
    asked = run(Quiet, 3, out=tmp_path / "asked", events=True)
    assert replay(asked, Quiet).equal and len(Run(asked).events)


def test_a_run_of_before_goes_on_without_events(kind, whole, tmp_path):
    """One whose manifest says nothing of what is recorded, and whose checkpoint has no events."""
    folder = run(kind, out=tmp_path / "run", events=False, **{**HOW, "ticks": 60})
    manifest = json.loads((folder / "manifest.json").read_text())
    del manifest["recorded"]
    (folder / "manifest.json").write_text(json.dumps(manifest))
    resume(folder, 120)
    assert not (folder / "events.parquet").exists()
    for name in ("series", "agents"):
        assert (folder / f"{name}.parquet").read_bytes() == bytes_of(whole)[name]
    assert replay(folder).equal


def test_what_is_recorded_is_remembered_before_the_first_checkpoint(kind, tmp_path):
    def stop(tick, length):
        raise KeyboardInterrupt

    for recorded in (True, False):
        out = tmp_path / str(recorded)
        with pytest.raises(KeyboardInterrupt):
            run(kind, out=out, events=recorded, on_progress=stop, **HOW)
        (out / "checkpoint.npz").unlink(missing_ok=True)
        resume(out, 120)
        assert ("events" in Run(out).manifest.tables) == recorded


class Fly(Agent):
    pass


def swarm(fly, model):
    if model.tick < 3:
        for _ in range(40):
            fly.hatch()
    elif fly.id % 2 == 0:
        fly.die()


class Swarm(Model):
    flies = Population(Fly, 5)
    schedule = (each(flies, swarm),)

    def agents(self):
        return {"agent": self.flies.id[:10]}


Swarm.__module__ = __name__


def test_more_births_in_a_tick_than_wait_in_memory(tmp_path):
    events = Run(run(Swarm, 5, out=tmp_path / "run")).events
    assert events.groupby(["tick", "event"]).size().to_dict() == {
        (1, "born"): 5 * 40, (2, "born"): 5 * 41 * 40, (3, "born"): 5 * 41**2 * 40,
        (4, "died"): 5 * 41**3 // 2 + 1,
    }  # fmt: skip
    assert events.query("event == 'born'")["parent"].notna().all()
