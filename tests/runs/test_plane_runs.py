"""Runs of models on a plane: killed and gone on with, replayed, by either engine."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from socialmind.catalogue import load_model
from socialmind.cli import app
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, replay, resume, run
from socialmind.mind import MindDescription, Skill

CHECKOUT = Path(__file__).parents[2]
FOLDER = CHECKOUT / "tests" / "worlds" / "plane" / "menagerie"


@pytest.fixture(scope="module")
def menagerie():
    return load_model(str(FOLDER))


@pytest.fixture(scope="module")
def mind(tmp_path_factory):
    """A mind of the collectors, in a folder: they go ahead and grip what they can."""
    weights = [1, 0, 0, 0, 0.25, -1, 0, 0, 0, 1.25, 0, 0.8, 0, -1, 0.1]
    model = load_model(str(FOLDER))
    bare = model.populations["collectors"].hierarchy
    skill = bare.skill("Collect")
    skills = [Skill("Collect", skill.inputs, skill.outputs, skill.function, weights)]
    folder = tmp_path_factory.mktemp("minds") / "collector"
    MindDescription(bare.name, bare.sensors, bare.actuators, skills=skills).save(folder)
    return folder


def tables(folder):
    return Run(folder).manifest.tables


@pytest.mark.parametrize("engine", ["compiled", "pymunk"])
def test_a_run_gone_on_with_is_one_that_never_stopped(engine, menagerie, mind, tmp_path):
    whole, part = tmp_path / "whole", tmp_path / "part"
    given = {"seed": 5, "hierarchy": {"collectors": mind}, "every": 5, "engine": engine}
    run(menagerie, 90, out=whole, **given)
    run(menagerie, 40, out=part, **given)
    resume(part, 90)
    assert tables(part) == tables(whole)
    assert Run(whole).manifest.engine == engine
    assert replay(part).equal
    record = json.loads((part / "manifest.json").read_text())
    record["engine"] = {"compiled": "pymunk", "pymunk": "compiled"}[engine]
    (part / "manifest.json").write_text(json.dumps(record))
    assert not replay(part).equal  # the other engine parts from it at the first impacts


def test_interpreted_it_is_the_same(menagerie, mind, tmp_path):
    given = {"seed": 2, "hierarchy": {"collectors": mind}, "every": 5}
    for compiled in (True, False):
        run(menagerie, 40, out=tmp_path / str(compiled), compiled=compiled, **given)
    assert tables(tmp_path / "True") == tables(tmp_path / "False")


def test_killed_it_goes_on(menagerie, mind, tmp_path):
    ticks = 300
    program = (
        "import sys; from socialmind.catalogue import load_model\n"
        "from socialmind.experiments import run\n"
        f"run(load_model({str(FOLDER)!r}), {ticks}, 3, out=sys.argv[1], every=1,\n"
        f"    hierarchy={{'collectors': {str(mind)!r}}}, checkpoint_every=0.0)\n"
    )
    folder = tmp_path / "killed"
    environment = {**os.environ, "PYTHONPATH": str(CHECKOUT)}
    process = subprocess.Popen([sys.executable, "-c", program, str(folder)], env=environment)
    deadline = time.monotonic() + 120
    while not (folder / "checkpoint.npz").is_file() and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.002)
    process.send_signal(signal.SIGKILL)
    process.wait()
    resume(folder, model_class=menagerie)
    whole = tmp_path / "whole"
    run(menagerie, ticks, 3, out=whole, every=1, hierarchy={"collectors": mind})
    assert tables(folder) == tables(whole)


def test_the_command_line_takes_an_engine_and_keeps_it(mind, tmp_path):
    def invoke(*words):
        return CliRunner().invoke(app, [str(word) for word in words])

    out = tmp_path / "out"
    words = ("--ticks", 20, "--mind", f"collectors={mind}", "--out", out, "--quiet")
    result = invoke("run", FOLDER, "--engine", "pymunk", *words)
    assert result.exit_code == 0, result.output
    assert Run(out).manifest.engine == "pymunk"
    assert invoke("run", "--resume", out, "--ticks", 30, "--quiet").exit_code == 0
    assert invoke("replay", out).stdout == "equal\n"
    refused = invoke("run", "--resume", out, "--engine", "compiled")
    assert refused.exit_code == 2 and "--resume with --engine" in refused.stderr
    wrong = invoke("run", FOLDER, "--engine", "box2d", *words[:-2], tmp_path / "b", "--quiet")
    assert wrong.exit_code == 2 and "found 'box2d'" in wrong.stderr
    assert not (tmp_path / "b").exists()
    flat = invoke("run", "farmer_artisan", "--engine", "pymunk", "--out", tmp_path / "c")
    assert flat.exit_code == 2 and "which has no plane" in flat.stderr


def test_a_model_is_checked():
    found = CliRunner().invoke(app, ["check", str(FOLDER.parent / "seekers")])
    assert found.exit_code == 0, found.output
    unset = CliRunner().invoke(app, ["check", "--trust", str(FOLDER)])
    assert unset.exit_code == 1 and "its 15 weights are not set" in unset.output


def test_the_tables_say_where_robots_were_and_what_ended_it(menagerie, mind, tmp_path):
    run(menagerie, 20, 5, hierarchy={"collectors": mind}, every=5, out=tmp_path / "out")
    result = Run(tmp_path / "out")
    columns = list(result.agents.columns)
    assert columns[:7] == ["tick", "agent", "population", "x", "y", "angle", "speed"]
    assert set(result.agents["population"]) == {"scouts", "collectors"}
    assert {"score", "over", "clock", "balls"} <= set(result.series.columns)


def test_an_engine_belongs_to_a_plane(tmp_path):
    with pytest.raises(SocialmindError, match="which has no plane"):
        run(load_model("farmer_artisan"), 5, engine="pymunk", out=tmp_path / "out")
