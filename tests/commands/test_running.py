"""`socialmind run`."""

import json
import os
import shutil
from pathlib import Path

import pytest

from socialmind.experiments import Run


def test_run_ends_with_the_folder_and_the_manifest_says_all(socialmind, grazers, tmp_path):
    result = socialmind("run", grazers, "--ticks", 12, "--interpreted", "--quiet")
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/runs/grazers-001\n"
    assert result.stderr == ""
    manifest = json.loads((tmp_path / "runs/grazers-001/manifest.json").read_text())
    assert manifest["status"] == "finished"
    assert manifest["model"]["path"] == str(grazers)
    assert manifest["schemes"]["grazers"]["file"] == "scheme.yaml"
    kept = tmp_path / "runs/grazers-001/scheme.yaml"
    assert kept.read_text() == (grazers / "scheme.yaml").read_text()


def test_run_options_reach_the_run(socialmind, grazers, tmp_path):
    words = ("--ticks", 30, "--seed", 9, "--set", "n_grazers=2", "--set", "n-grazers = 4")
    words += ("--every", 7, "--agents-every", 14, "--interpreted", "--out", "a/b")
    result = socialmind("run", grazers, *words)
    assert result.exit_code == 0, result.output
    run = Run(tmp_path / "a/b")
    assert run.seed == 9
    assert run.parameters["n_grazers"] == 4
    assert list(run.series["tick"]) == [0, 7, 14, 21, 28, 30]
    assert sorted(set(run.agents["tick"])) == [0, 14, 28, 30]
    assert "30 ticks in" in result.stderr


def test_tables_on_request_and_left_out(socialmind, refused, tmp_path):
    meeting = tmp_path / "meeting.py"
    meeting.write_text(MEETING)
    words = ("run", meeting, "--interpreted")
    for name, more, tables in (
        ("plain", (), {"events"}),
        ("both", ("--links",), {"events", "links"}),
        ("none", ("--no-links", "--no-events"), set()),
    ):
        assert socialmind(*words, *more, "--out", name).exit_code == 0
        assert socialmind("run", "--resume", name, "--ticks", 6).exit_code == 0
        assert set(Run(name).manifest.tables) == {"series", "agents"} | tables
        assert socialmind("replay", name).stdout == "equal\n"
    assert Run("both").links["tick"].max() == 6
    meeting.write_text(
        MEETING.replace("    ties = Network(people, Link)\n", "").replace(LINKING, "")
    )
    assert "has no networks; leave them out" in refused(*words, "--links", "--out", "lonely")


LINKING = "    model.ties.link(person, model.people[0])\n"
MEETING = f"""from socialmind import Agent, Link, Model, Network, Population, each
class Person(Agent):
    pass
def meet(person, model, rng):
    if person.id != 0:
        person.die()
        return
    person = person.hatch()
{LINKING}
class Meeting(Model):
    ticks = 4
    people = Population(Person, 3)
    ties = Network(people, Link)
    schedule = (each(people, meet),)
"""


def test_a_scheme_of_ones_own_is_kept_with_the_run(socialmind, grazers, tmp_path):
    mine = tmp_path / "mine.yaml"
    mine.write_text((grazers / "scheme.yaml").read_text().replace("start: 2", "start: 5"))
    words = ("run", grazers, "--ticks", 40, "--seed", 4, "--interpreted", "--every", 1)
    for name, more in (("own", ()), ("mine", ("--scheme", mine))):
        assert socialmind(*words, *more, "--out", name).exit_code == 0
    mine.unlink()
    assert Run("mine").scheme.cognitons[1].start_value == 5
    assert not Run("mine").agents.equals(Run("own").agents)
    assert socialmind("replay", "mine").stdout == "equal\n"


def test_compiled_and_interpreted_runs_are_equal(socialmind, grazers, done, tmp_path):
    out = tmp_path / "compiled"
    words = ("--ticks", 40, "--seed", 4, "--set", "n_grazers=3", "--out", out)
    assert socialmind("run", grazers, *words).exit_code == 0
    assert Run(out).manifest.tables == Run(done).manifest.tables


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["farmer_artizan"], "no model called farmer_artizan; did you mean 'farmer_artisan'?"),
        (["./nowhere"], "nowhere: no such folder; a model is a folder with a model.py"),
        ([], "which model? give a name (`socialmind list` shows them) or a folder"),
        (["tutorial", "--set", "rewards=2"], "no parameter called rewards; did you mean 'reward'?"),
        (["tutorial", "--set", "reward"], "--set reward: expected NAME=VALUE"),
        (["tutorial", "--set", "reward=-1"], "parameter reward: found -1; expected 0 or more"),
        (["tutorial", "--set", "reward=big"], "parameter reward: found 'big'; expected a number"),
        (["tutorial", "--set", "n_turtles=1.5"], "n_turtles: found 1.5; expected a whole number"),
        (["tutorial", "--set", "reward=nan"], "parameter reward: found nan"),
        (["tutorial", "--scheme", "none.yaml"], "none.yaml: no such file"),
        (["--resume", "none"], "none: no such folder"),
        (["tutorial", "--resume", "none", "--seed", "1"], "--resume with MODEL, --seed"),
    ],
)
def test_run_refuses_in_one_line(refused, words, message):
    line = refused("run", *words)
    assert line.startswith("socialmind: ")
    assert message in line
    assert not Path("runs").exists()


def test_a_folder_in_use_is_refused(refused, done, tmp_path):
    assert "holds a run; go on with it by --resume" in refused("run", "tutorial", "--out", done)
    (tmp_path / "notes.txt").write_text("mine")
    assert "is not empty" in refused("run", "tutorial", "--out", tmp_path)
    assert "is a file" in refused("run", "tutorial", "--out", tmp_path / "notes.txt")
    line = refused("run", "tutorial", "--interpreted", "--out", tmp_path / "notes.txt" / "run")
    assert "notes.txt" in line


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is unwritable for root")
def test_an_unwritable_folder_is_named(refused, tmp_path):
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o555)
    line = refused("run", "tutorial", "--ticks", 1, "--interpreted", "--out", closed / "run")
    assert "closed" in line
    assert "Permission denied" in line


def broken(grazers, tmp_path, old, new):
    shutil.copytree(grazers, tmp_path / "broken")
    model = tmp_path / "broken" / "model.py"
    text = model.read_text()
    assert old in text
    model.write_text(text.replace(old, new))
    return model, text.split(old)[0].count("\n") + 1


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("class Grazer(Agent):", "class Grazer(Agent:", "not valid Python"),
        ("class Grazer(Agent):", "import grasses\nclass Grazer(Agent):", "ModuleNotFoundError"),
        ("class Grazer(Agent):", "1 / 0\nclass Grazer(Agent):", "ZeroDivisionError"),
        ("class Grazer(Agent):", "import scheme_\nclass Grazer(Agent):", "install scheme_"),
    ],
)
def test_a_model_that_cannot_be_loaded_is_named_by_line(
    refused, grazers, tmp_path, old, new, message
):
    model, line = broken(grazers, tmp_path, old, new)
    found = refused("run", tmp_path / "broken")
    assert found.startswith(f"socialmind: {model}:{line}: ")
    assert message in found


def test_a_rule_that_fails_is_named_by_line(refused, grazers, tmp_path):
    model, line = broken(
        grazers, tmp_path, "    grazer.energy -= 0.2\n", "    grazer.energy /= 0\n"
    )
    found = refused("run", tmp_path / "broken", "--interpreted", "--out", "out")
    assert f"{model}:{line}" in found
    assert Run("out").manifest.status == "failed"


def test_idle_agents_are_warned_of(socialmind, grazers, tmp_path):
    mine = tmp_path / "mine.yaml"
    text = (grazers / "scheme.yaml").read_text()
    mine.write_text(text.replace("at_birth: true", "at_birth: false"))
    words = ("--scheme", mine, "--set", "n_grazers=1", "--ticks", 5, "--interpreted", "--quiet")
    result = socialmind("run", grazers, *words)
    assert result.exit_code == 0, result.output
    assert result.stderr == (
        "warning: 5 times an agent found no available plan and did nothing, first agent 0 at "
        "tick 0; `socialmind explain` shows why\n"
    )
