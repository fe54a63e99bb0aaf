"""Agents with hierarchies in a model: both speeds, births, deaths, states, and runs on disk."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import Run, replay, resume, run
from socialmind.mind import Hierarchy, MindDescription
from socialmind.mind.files.layout import layout_file
from socialmind.mind.kernel.layout import LIVES, NOT_KEPT
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import changes_since

CHECKOUT = Path(__file__).parents[2]
SHOWN = ("id", "x", "y", "plan", "mother", "ml", "mr", "herd", "followed")


def shown(society):
    """All that shows of the herd, to the last bit."""
    walkers = society.walkers
    seen = {name: getattr(walkers, name).tobytes() for name in SHOWN if name != "plan"}
    seen["plan"] = society.plans(society.tables["walkers"])
    seen["alarm"] = society.watchers.alarm.tobytes()
    seen["tired"] = walkers.cogniton("Tired").tobytes()
    return seen


def inside(society):
    """The arrays of the hierarchies of those who live, to the last bit; slots in order of birth."""
    seen = {}
    for name, table in society.tables.items():
        state, slots = table.minds.state, table.slots
        for part, array in zip(state._fields, state, strict=True):
            if part in NOT_KEPT:
                continue
            by_slot = part in LIVES or (part == "genome" and table.minds.own_genomes)
            seen[name, part] = (array[slots] if by_slot else array).tobytes()
        for number, nested in enumerate(table.minds.societies):
            seen[name, f"values {number}"] = nested.minds.values[slots].tobytes()
            seen[name, f"draws {number}"] = nested.minds.draws[slots].tobytes()
    return seen


@pytest.fixture(scope="module")
def made(herd):
    """Makes the herd and lets it run."""

    def make(ticks=0, seed=3, **settings):
        society = herd.Herd(seed, **settings)
        society.advance(ticks)
        return society

    return make


BUSY = {"births": 0.08, "deaths": 0.15}
GROWING = {"births": 0.1, "deaths": 0.01}


@pytest.mark.parametrize(
    "settings", [{}, BUSY, GROWING, {"n_walkers": 1}], ids=["calm", "busy", "growing", "one"]
)
def test_compiled_and_interpreted_are_equal_to_the_last_bit(made, settings):
    ticks = 25 if settings == GROWING else 60
    fast, slow = (made(ticks, compiled=compiled, **settings) for compiled in (True, False))
    assert shown(fast) == shown(slow)
    assert inside(fast) == inside(slow)
    if settings == GROWING:
        assert len(fast.tables["walkers"].rows) > 256  # room was made twice
    if settings == BUSY:
        assert fast.walkers.id.max() > 60
        assert fast.walkers.id.min() > 5


def test_both_kinds_of_mind_decide(made):
    society = made(60)
    plans = set(shown(society)["plan"])
    assert plans == {"Roam", "Stay"}
    followed = society.walkers.followed
    assert {0.0, 1.0} == set(followed.tolist())  # the scheme inside the hierarchy chooses
    assert 0 < society.watchers.alarm[0] < 1


def test_runs_depend_on_the_seed_and_on_nothing_else(made):
    first = shown(made(40))
    assert shown(made(40)) == first
    assert shown(made(40, seed=4)) != first
    in_steps = made()
    for ticks in (1, 0, 2, 30, 7):
        in_steps.advance(ticks)
    assert shown(in_steps) == first
    assert shown(in_steps.fresh()) == shown(made())


def test_speeds_may_alternate_over_one_state(made):
    whole = made(60, **BUSY)
    part = made(20, **BUSY)
    other = made(compiled=False, **BUSY)
    other.restore(part.state())
    other.advance(20)
    last = made(**BUSY)
    last.restore(other.state())
    last.advance(20)
    assert shown(last) == shown(whole)
    assert inside(last) == inside(whole)


def test_a_state_is_a_copy_and_goes_back_from_anywhere(made):
    society = made(30, **BUSY)
    kept = society.state()
    society.advance(10)
    after = inside(society)
    society.advance(25)
    society.restore(kept)
    society.advance(10)
    assert inside(society) == after
    small = made(0, n_walkers=1)  # with less room
    small.restore(kept)
    small.context["births"], small.context["deaths"] = BUSY["births"], BUSY["deaths"]
    small.advance(10)
    assert shown(small) == shown(society)


# Births and deaths --------------------------------------------------------------------------------


def table_of(society, name="walkers"):
    return society.tables[name]


def of(table, agent, part):
    return getattr(table.minds.state, part)[agent._slot]


def test_a_child_has_its_parent_s_state_and_weights_but_no_group(made):
    society = made(12, compiled=False)
    table = table_of(society)
    mother = society.walkers[society.walkers.id[2]]
    table.minds.set_genome("Tune", np.full((1, 87), 0.125), [mother._slot])
    mother.hierarchy.join_group("herd", 2, 0.75)
    child = mother.hatch()
    lives = ("values", "before", "command", "memory", "sensors", "signals", "past", "totals",
             "remembered", "actuators", "output", "sent", "fresh", "clock", "genome")  # fmt: skip
    for part in lives:
        assert of(table, child, part).tobytes() == of(table, mother, part).tobytes()
    assert of(table, child, "group").tolist() == [[-1]]
    assert of(table, mother, "group").tolist() == [[2]]
    nested = table.minds.societies[0]
    assert (nested.minds.values[child._slot] == nested.minds.values[mother._slot]).all()
    # From here on each lives its own life.
    before = of(table, mother, "values").copy()
    child.hierarchy.set_variable("Slow", 0.875)
    table.minds.set_genome("Tune", np.zeros((1, 87)), [child._slot])
    assert (of(table, mother, "values") == before).all()
    assert (of(table, mother, "genome") == 0.125).all()


def test_one_created_in_the_place_of_the_dead_shows_no_trace_of_them(made, herd):
    society = made(20, compiled=False)
    table = table_of(society)
    dead = [society.walkers[identity] for identity in society.walkers.id[:4].tolist()]
    slots = {agent._slot for agent in dead}
    for agent in dead:
        table.minds.set_genome("Tune", np.full((1, 87), 9.0), [agent._slot])
        agent.hierarchy.join_group("herd", 2, 0.125)
        agent.die()
    table.settle()
    fresh = herd.Herd(9, compiled=False, n_walkers=1)
    first = fresh.walkers[0]
    first.hierarchy.leave_group("herd")
    fresh.tables["walkers"].minds.state.participation[:] = 1.0
    for _ in range(4):
        born = society.walkers.create()
        slots.discard(born._slot)
        for part in ("values", "before", "command", "memory", "sensors", "signals", "totals",
                     "output", "sent", "drive_influence", "drive_command", "drive_weight",
                     "actuators", "remembered", "fresh", "group", "participation",
                     "genome"):  # fmt: skip
            found, expected = of(table, born, part), of(table_of(fresh), first, part)
            assert found.tobytes() == expected.tobytes(), part
        assert table.minds.societies[0].minds.values[born._slot].tolist() == [0.0, 0.3]
        # And what it kept of sensors shows nowhere: the history begins anew.
        born.hierarchy.set_sensor("L", 0.25)
        born.hierarchy.set_sensor("R", 0.5)
        born.hierarchy.evaluate()
        past = of(table, born, "past")
        assert (past == 0.25).all()
    assert not slots  # all the old places were taken


def test_weights_are_inherited_and_never_found_in_a_slot(made):
    society = made(0, **BUSY)
    table = table_of(society)
    founders = np.random.default_rng(4).uniform(-1, 1, (20, 87))
    table.minds.set_genome("Tune", founders, np.arange(20))
    society.advance(20)
    assert (table.slots < society.walkers.id).any()  # slots are used again
    first = table.minds.state.first_genome[0].tobytes()
    strains = {first, *(row.tobytes() for row in founders)}
    families = set()
    for agent in society.walkers:
        weights = of(table, agent, "genome").tobytes()
        assert weights in strains
        families.add(weights)
        if agent.id >= 20 and agent.mother < 0:
            assert weights == first
        if agent.id < 20:
            assert weights == founders[agent.id].tobytes()
    assert len(families) > 2


def test_the_new_born_begin_with_the_weights_set_for_all(made):
    society = made(5, compiled=False)
    table = table_of(society)
    table.minds.set_genome("Tune", np.full(87, 0.25))
    table.minds.set_genome("Tune", np.full((2, 87), 0.75), [0, 1])
    born = society.walkers.create()
    assert (of(table, born, "genome") == 0.25).all()
    society.advance(3)
    assert {0.25, 0.75} >= set(np.unique(table.minds.state.genome[table.slots]).tolist())


def test_own_weights_steer_each_agent_at_both_speeds(made):
    seen = []
    for compiled in (True, False):
        society = made(0, compiled=compiled)
        rng = np.random.default_rng(0)
        weights = rng.uniform(-1, 1, (20, 87))
        table_of(society).minds.set_genome("Tune", weights, np.arange(20))
        society.advance(20)
        seen.append((shown(society), inside(society)))
    assert seen[0] == seen[1]
    assert seen[0][0] != shown(made(20))


def test_what_rules_see_is_what_a_hierarchy_alone_gives(herd):
    society = herd.Herd(11, compiled=False, n_walkers=1, births=0.0, deaths=0.0)
    single = Hierarchy(herd.WATCHER)
    hierarchy = society.watchers[0].hierarchy
    for crowd in (0.1, 0.9, 0.4, 0.4):
        hierarchy.set_sensor("Crowd", crowd)
        hierarchy.evaluate()
        assert single.evaluate({"Crowd": crowd}) == {"Alarm": hierarchy.actuator("Alarm")}
        assert single.variables() == {"Fear": hierarchy.variable("Fear")}
        assert single.influences()["Cry"] == hierarchy.influence("Cry")
    hierarchy.restart()
    single.reset()
    hierarchy.set_sensor("Crowd", 0.7)
    hierarchy.evaluate()
    assert single.evaluate({"Crowd": 0.7}) == {"Alarm": hierarchy.actuator("Alarm")}


# Failures -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "interpreted"])
def test_a_program_that_fails_is_found_at_its_line(made, herd_folder, compiled):
    with pytest.raises(SocialmindError) as raised:
        made(40, failing=14, births=0.0, deaths=0.0, compiled=compiled)
    if "tick 14" not in str(raised.value):  # it followed, or stayed, in that tick
        pytest.fail(str(raised.value))
    message = str(raised.value)
    assert "\n" not in message
    text = (herd_folder / "model.py").read_text().splitlines()
    line = next(n for n, one in enumerate(text, 1) if "turn = 0.25 /" in one)
    assert message.startswith(f"{herd_folder / 'model.py'}:{line}: ZeroDivisionError")
    assert message.endswith("in tick 14, agent 3 of 'walkers'")


# Runs on disk -------------------------------------------------------------------------------------


def tables(folder):
    return {
        name: (Path(folder) / f"{name}.parquet").read_bytes() for name in ("series", "agents")
    } | {"hashes": json.dumps(Run(folder).manifest.tables)}


SLOW = """
    def series(self):
        time.sleep(float(os.environ.get("PACE", "0")))
        return super().series()
"""
RUN_WITH_MANY_CHECKPOINTS = """
from socialmind.catalogue import load_model
from socialmind.experiments import run
run(load_model("./herd"), 60, seed=3, every=1, agents_every=5, out="out", compiled=False,
    checkpoint_every=0.01)
"""


def command(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "socialmind.cli", *map(str, words)],
        cwd=cwd, env=os.environ | {"PYTHONPATH": str(CHECKOUT)}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip


@pytest.fixture(scope="module")
def whole(herd, tmp_path_factory):
    """A run of the herd of 60 ticks, never stopped."""
    out = tmp_path_factory.mktemp("whole") / "run"
    return run(herd.Herd, 60, seed=3, every=1, agents_every=5, out=out)


def test_a_run_keeps_its_minds_and_replays(whole, herd):
    capsule = Run(whole)
    assert set(capsule.minds) == {"walkers", "watchers"}
    for name, own in (("walkers", herd.WALKER), ("watchers", herd.WATCHER)):
        kept = capsule.minds[name]
        assert isinstance(kept, MindDescription)
        assert set(kept.skills) == set(own.skills)
        for skill in own.skills.values():
            if skill.genome is not None:
                assert kept.skills[skill.name].genome.tobytes() == skill.genome.tobytes()
    found = replay(whole)
    assert found.equal
    assert found.exact


def test_resuming_makes_the_run_that_was_never_stopped(whole, herd, tmp_path):
    part = run(herd.Herd, 23, seed=3, every=1, agents_every=5, out=tmp_path / "part")
    resume(part, 41, compiled=False)
    resume(part, 60)
    assert tables(part)["hashes"] == tables(whole)["hashes"]


def test_killed_and_resumed_is_uninterrupted(herd_folder, whole, tmp_path):
    """SIGKILL in the middle, wherever that is; the tables are those of one run, byte by byte."""
    shutil.copytree(herd_folder, tmp_path / "herd", ignore=shutil.ignore_patterns("__pycache__"))
    model = tmp_path / "herd" / "model.py"
    text = model.read_text().replace("import math\n", "import math\nimport os\nimport time\n", 1)
    model.write_text(text + SLOW)
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-c", RUN_WITH_MANY_CHECKPOINTS],
        cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(CHECKOUT), "PACE": "0.2"},
    )  # fmt: skip
    limit = time.monotonic() + 60
    while process.poll() is None and not (out.exists() and Run(out).manifest.ticks_done):
        assert time.monotonic() < limit
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    manifest = Run(out).manifest
    assert manifest.status == "running"
    assert 0 < manifest.ticks_done < 60
    ended = command("run", "--resume", "out", "--quiet", cwd=tmp_path)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert Run(out).manifest.status == "finished"
    assert tables(out)["hashes"] == tables(whole)["hashes"]


@pytest.fixture
def other_mind(herd, tmp_path):
    """The watchers' mind in a folder, with other weights."""
    hierarchy = Hierarchy(herd.WATCHER)
    hierarchy.randomise(5)
    folder = tmp_path / "Other"
    hierarchy.save(folder)
    return folder


def test_another_mind_from_a_folder(herd, whole, other_mind, tmp_path):
    given = {"watchers": other_mind}
    out = run(herd.Herd, 20, seed=3, hierarchy=given, every=1, agents_every=5, out=tmp_path / "r")
    kept = Run(out).minds["watchers"]
    for name, skill in MindDescription.load(other_mind).skills.items():
        assert kept.skills[name].genome.tobytes() == skill.genome.tobytes()
    # The folder may change or go; the run has its own copy.
    shutil.rmtree(other_mind)
    resume(out, 40)
    assert replay(out).equal
    straight = herd.Herd(3, hierarchy={"watchers": kept})
    straight.advance(40)
    assert Run(out).manifest.ticks_done == 40
    assert straight.watchers.alarm.tobytes() != Run(whole).minds  # weights differ from the model's
    society = herd.Herd(3)
    society.advance(40)
    assert straight.watchers.alarm.tolist() != society.watchers.alarm.tolist()


@pytest.mark.parametrize("deed", ["weight", "skill", "added", "gone"])
def test_a_copy_that_was_changed_is_refused(herd, whole, tmp_path, deed):
    shutil.copytree(whole, tmp_path / "run")
    minds = tmp_path / "run" / "minds"
    if deed == "weight":
        file = next(minds.rglob("Tune.genome"))
        file.write_text(file.read_text().replace("0.1", "0.8"))
    elif deed == "skill":
        file = next(minds.rglob("Cry.ades"))
        file.write_text(file.read_text() + "\n# a word\n")
    elif deed == "added":
        (minds / "walkers" / "more.txt").write_text("")
    else:
        shutil.rmtree(minds / "watchers")
    with pytest.raises(SocialmindError) as raised:
        resume(tmp_path / "run", 70)
    message = str(raised.value)
    assert "\n" not in message
    assert str(minds) in message
    assert ("missing" if deed == "gone" else "changed") in message
    if deed == "gone":
        with pytest.raises(SocialmindError, match="no such folder"):
            replay(tmp_path / "run")
    else:
        found = replay(tmp_path / "run")
        assert any("copy of its mind was changed" in note for note in found.notes)
        assert found.equal == (deed != "weight")


def test_a_copy_whose_boxes_were_put_elsewhere_is_the_same(herd, whole, tmp_path):
    shutil.copytree(whole, tmp_path / "run")
    layout_file(tmp_path / "run" / "minds" / "walkers").write_text("SKILLS\nTune:1:2\n")
    assert changes_since(Capsule(tmp_path / "run"), herd.Herd) is None


def test_the_command_line_takes_and_refuses_minds(tmp_path, other_mind, herd_folder, whole):
    wanted = (
        (("--mind", "nowhere"), "nowhere: no such"),
        (("--mind", str(other_mind)), "which has 2 populations with hierarchies"),
    )
    for words, message in wanted:
        ended = command("run", herd_folder, "--ticks", 1, *words, cwd=tmp_path)
        assert ended.returncode == 2
        (line,) = ended.stderr.splitlines()
        assert message in line
    assert not (tmp_path / "runs").exists()
