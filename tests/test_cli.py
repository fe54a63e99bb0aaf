"""The commands, as a user types them."""

import json
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from socialmind.cli import app
from socialmind.experiments import Run

CHECKOUT = Path(__file__).parents[1]
PYTHON = [sys.executable, "-m", "socialmind.cli"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(CHECKOUT)}
SCHEME = """
name: odd
decision_maker: MaximumWeight
plans: [Sit, Fly]
cognitons:
  Tired: {at_birth: true, start: 1, influence: {Sit: 1, Fly: 1}, conditional: [Sit]}
"""


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def socialmind(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


def refused(*words):
    """The one line on stderr of a command that ends with exit code 2."""
    result = socialmind(*words)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    return line


def usage(*words):
    """The last line of a command that does not read its options."""
    result = socialmind(*words)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    return result.stderr.splitlines()[-1]


@pytest.fixture(scope="module")
def grazers(tmp_path_factory):
    folder = tmp_path_factory.mktemp("model") / "grazers"
    assert socialmind("new", folder).exit_code == 0
    return folder


@pytest.fixture(scope="module")
def done(grazers, tmp_path_factory):
    """A run of the small model, 40 ticks, interpreted."""
    out = tmp_path_factory.mktemp("done") / "run"
    words = ("--ticks", 40, "--seed", 4, "--set", "n_grazers=3", "--interpreted", "--out", out)
    result = socialmind("run", grazers, *words)
    assert result.exit_code == 0, result.output
    return out


# list, new, check


def test_list_shows_every_model_and_parameter():
    result = socialmind("list")
    assert result.exit_code == 0, result.output
    assert re.search(r"^farmer_artisan: Trade makes", result.stdout, re.MULTILINE)
    assert re.search(r"^  tool_price +167 +wheat a tool +1e-06 or more", result.stdout, re.M)
    assert re.search(r"^  starvation +false +true or false", result.stdout, re.M)
    assert re.search(r"^tutorial: ", result.stdout, re.MULTILINE)


def test_the_small_model_is_small_checks_and_runs(grazers, done):
    assert sorted(p.name for p in grazers.iterdir()) == ["README.md", "model.py", "scheme.yaml"]
    code = (grazers / "model.py").read_text().splitlines()
    assert len([line for line in code if line.strip()]) < 40
    result = socialmind("check", grazers)
    assert result.exit_code == 0
    assert result.stdout == f"{grazers}: nothing odd found\n"
    assert Run(done).manifest.parameters == {"n_grazers": 3, "regrowth": 0.01}
    assert set(Run(done).agents["plan"].dropna()) == {"Wander", "Graze"}


def test_new_leaves_a_folder_in_use_alone(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    assert refused("new", tmp_path).endswith("is not empty; give a fresh folder")
    assert refused("new", tmp_path / "mine.txt").endswith("is a file; give a folder")
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]


def test_check_of_a_scheme(tmp_path):
    path = tmp_path / "odd.yaml"
    path.write_text(SCHEME)
    result = socialmind("check", path)
    assert result.exit_code == 1
    assert "Fly" in result.stdout
    assert result.stdout.startswith(f"{path}: plan never available")
    clean = SCHEME.replace("[Sit]", "[Sit, Fly]").replace("MaximumWeight", "WeightedStochastic")
    path.write_text(clean)
    result = socialmind("check", path)
    assert (result.exit_code, result.stdout) == (0, f"{path}: nothing odd found\n")
    path.write_text("cognitons: [")
    assert refused("check", path).startswith(f"socialmind: {path}:")
    assert refused("check", tmp_path / "none.cogscheme").endswith("no such file")


def test_check_of_a_model_whose_rule_is_outside_the_language(grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "bad")
    model = tmp_path / "bad" / "model.py"
    text = model.read_text().replace("    grazer.energy -= 0.2\n", "    del grazer.energy\n")
    model.write_text(text)
    line = text.splitlines().index("    del grazer.energy") + 1
    assert f"{model}:{line}: del in the rule 'live'" in refused("check", tmp_path / "bad")


def test_check_of_a_model_knows_its_plans(grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "odd")
    scheme = tmp_path / "odd" / "scheme.yaml"
    scheme.write_text(scheme.read_text().replace("conditional: [Wander]", "conditional: [Graze]"))
    result = socialmind("check", tmp_path / "odd")
    assert result.exit_code == 1
    assert f"{scheme}: plan never available: plan 'Wander'" in result.stdout


# run


def test_run_ends_with_the_folder_and_the_manifest_says_all(grazers, tmp_path):
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


def test_run_options_reach_the_run(grazers, tmp_path):
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


def test_a_scheme_of_ones_own_is_kept_with_the_run(grazers, tmp_path):
    mine = tmp_path / "mine.yaml"
    mine.write_text((grazers / "scheme.yaml").read_text().replace("start: 2", "start: 5"))
    words = ("run", grazers, "--ticks", 40, "--seed", 4, "--interpreted", "--every", 1)
    for name, more in (("own", ()), ("mine", ("--scheme", mine))):
        assert socialmind(*words, *more, "--out", name).exit_code == 0
    mine.unlink()
    assert Run("mine").scheme.cognitons[1].start_value == 5
    assert not Run("mine").agents.equals(Run("own").agents)
    assert socialmind("replay", "mine").stdout == "equal\n"


def test_compiled_and_interpreted_runs_are_equal(grazers, done, tmp_path):
    out = tmp_path / "compiled"
    words = ("--ticks", 40, "--seed", 4, "--set", "n_grazers=3", "--out", out)
    assert socialmind("run", grazers, *words).exit_code == 0
    assert Run(out).manifest.tables == Run(done).manifest.tables


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["farmer_artizan"], "no model called farmer_artizan; did you mean farmer_artisan?"),
        (["./nowhere"], "nowhere: no such folder; a model is a folder with a model.py"),
        ([], "which model? give a name (`socialmind list` shows them) or a folder"),
        (["tutorial", "--set", "rewards=2"], "no parameter called rewards; did you mean reward?"),
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
def test_run_refuses_in_one_line(words, message):
    line = refused("run", *words)
    assert line.startswith("socialmind: ")
    assert message in line
    assert not Path("runs").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["run", "tutorial", "--tick", "5"], "No such option"),
        (["run", "tutorial", "--ticks", "many"], "Invalid value for '--ticks'"),
        (["run", "tutorial", "--ticks", "-1"], "Invalid value for '--ticks'"),
        (["run", "tutorial", "--every", "0"], "Invalid value for '--every'"),
        (["explain", "somewhere", "--agent", "1"], "Missing option '--tick'"),
        (["ran"], "No such command 'ran'"),
    ],
)
def test_wrong_usage_has_exit_code_2(words, message):
    assert message in usage(*words)


def test_a_folder_in_use_is_refused(done, tmp_path):
    assert "holds a run; go on with it by --resume" in refused("run", "tutorial", "--out", done)
    (tmp_path / "notes.txt").write_text("mine")
    assert "is not empty" in refused("run", "tutorial", "--out", tmp_path)
    assert "is a file" in refused("run", "tutorial", "--out", tmp_path / "notes.txt")
    line = refused("run", "tutorial", "--interpreted", "--out", tmp_path / "notes.txt" / "run")
    assert "notes.txt" in line


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is unwritable for root")
def test_an_unwritable_folder_is_named(tmp_path):
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
def test_a_model_that_cannot_be_loaded_is_named_by_line(grazers, tmp_path, old, new, message):
    model, line = broken(grazers, tmp_path, old, new)
    found = refused("run", tmp_path / "broken")
    assert found.startswith(f"socialmind: {model}:{line}: ")
    assert message in found


def test_a_rule_that_fails_is_named_by_line(grazers, tmp_path):
    model, line = broken(
        grazers, tmp_path, "    grazer.energy -= 0.2\n", "    grazer.energy /= 0\n"
    )
    found = refused("run", tmp_path / "broken", "--interpreted", "--out", "out")
    assert f"{model}:{line}" in found
    assert Run("out").manifest.status == "failed"


def test_idle_agents_are_warned_of(grazers, tmp_path):
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


# resume


def test_resume_makes_a_finished_run_longer(grazers, done, tmp_path):
    shutil.copytree(done, tmp_path / "longer")
    result = socialmind("run", "--resume", "longer", "--ticks", 60, "--quiet")
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/longer\n"
    words = ("--ticks", 60, "--seed", 4, "--set", "n_grazers=3", "--interpreted")
    assert socialmind("run", grazers, *words, "--out", "at_once", "--every", 1).exit_code == 0
    assert Run("longer").manifest.tables == Run("at_once").manifest.tables
    assert "60 ticks are done, 50 asked for" in refused("run", "--resume", "longer", "--ticks", 50)


def test_resume_sees_a_changed_model_and_a_changed_scheme(grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "mine")
    words = ("--ticks", 5, "--interpreted", "--out", "out")
    assert socialmind("run", "./mine", *words).exit_code == 0
    model = tmp_path / "mine" / "model.py"
    model.write_text(model.read_text().replace("0.2", "0.3"))
    line = refused("run", "--resume", "out", "--ticks", 9)
    assert "source is not the one the run was made with; put the old file back" in line
    model.write_text(model.read_text().replace("0.3", "0.2"))
    with Path("out/scheme.yaml").open("a") as file:
        file.write("# a word\n")
    assert "copy of its scheme was changed" in refused("run", "--resume", "out", "--ticks", 9)


def slow(grazers, tmp_path):
    """The small model, made to take its time in Python."""
    shutil.copytree(grazers, tmp_path / "slow")
    model = tmp_path / "slow" / "model.py"
    model.write_text(
        model.read_text().replace('"""Grazers wander', 'import time\n\n"""Grazers wander')
        + "\n    def series(self):\n        time.sleep(0.005)\n"
        + "        return {'n': len(self.grazers)}\n"
    )
    return tmp_path / "slow"


def started(words, until, **options):
    """A command in a process of its own, once a file is there."""
    process = subprocess.Popen([*PYTHON, *map(str, words)], env=ENVIRONMENT, **options)
    limit = time.monotonic() + 30
    while not until.exists():
        assert process.poll() is None
        assert time.monotonic() < limit
        time.sleep(0.01)
    return process


def test_ctrl_c_says_how_to_go_on(grazers, tmp_path):
    out = tmp_path / "out"
    words = ("run", slow(grazers, tmp_path), "--ticks", 300, "--interpreted", "--out", out)
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    process = started(words, out, **pipes)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    stdout, stderr = process.communicate(timeout=30)
    assert process.returncode == 130
    assert stdout == ""
    assert re.fullmatch(
        rf"socialmind: stopped at tick \d+; go on with `socialmind run --resume {out}`\n", stderr
    )
    assert 0 < Run(out).ticks < 300
    assert socialmind("run", "--resume", out).exit_code == 0
    assert socialmind("replay", out).exit_code == 0


def test_sigkill_before_the_first_checkpoint(grazers, tmp_path):
    out = tmp_path / "out"
    words = ("run", slow(grazers, tmp_path), "--ticks", 200, "--interpreted", "--out", out)
    process = started(words, out / ".lock")
    time.sleep(0.1)
    process.kill()
    process.wait()
    assert not (out / "checkpoint.npz").exists()
    assert "finish it with --resume" in refused("replay", out)
    assert socialmind("run", "--resume", out).exit_code == 0
    assert socialmind("replay", out).exit_code == 0


def test_a_bar_is_drawn_on_a_terminal_and_only_there(grazers, tmp_path):
    words = ["run", grazers, "--ticks", 30, "--interpreted"]
    shown = {}
    for option in ("--quiet", "--interpreted"):
        ours, theirs = pty.openpty()
        command = [*PYTHON, *map(str, words), option]
        ended = subprocess.run(command, stderr=theirs, stdout=subprocess.PIPE, env=ENVIRONMENT)
        os.close(theirs)
        assert ended.returncode == 0
        try:
            shown[option] = os.read(ours, 100_000).decode()
        except OSError:  # nothing was written
            shown[option] = ""
        os.close(ours)
    assert shown["--quiet"] == ""
    assert "of 30 ticks" in shown["--interpreted"]


# plot, replay, explain


def test_plot_draws_every_series_when_the_model_has_no_figures(done):
    result = socialmind("plot", done)
    assert result.exit_code == 0, result.output
    assert result.stdout.split() == [str(done / f"figures/series.{s}") for s in ("pdf", "png")]
    assert (done / "figures/series.pdf").read_bytes().startswith(b"%PDF")
    assert (done / "figures/series.png").read_bytes().startswith(b"\x89PNG")


FIGURES = """
from matplotlib import pyplot

def draw(run):
    pyplot.rcParams["lines.linewidth"] = 9
    figure, axes = pyplot.subplots()
    axes.plot(run.series["tick"], run.series["grazers"])
    return {"herd": figure}
"""


def with_figures(grazers, tmp_path, text):
    shutil.copytree(grazers, tmp_path / "drawn")
    (tmp_path / "drawn/figures.py").write_text(text)
    words = ("--ticks", 20, "--interpreted", "--figures", "--out", "out")
    return "run", "./drawn", *words


def test_a_models_own_figures_leave_no_trace_in_matplotlib(grazers, tmp_path):
    import matplotlib as mpl
    from matplotlib import pyplot

    before = mpl.rcParams["lines.linewidth"]
    result = socialmind(*with_figures(grazers, tmp_path, FIGURES))
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/out\n"
    assert {p.name for p in Path("out/figures").iterdir()} == {"herd.pdf", "herd.png"}
    assert mpl.rcParams["lines.linewidth"] == before
    assert pyplot.get_fignums() == []
    (tmp_path / "drawn/figures.py").write_text(FIGURES.replace("herd", "flock"))
    assert "flock.pdf" in socialmind("plot", "out").stdout  # figures may change after the run
    assert socialmind("run", "--resume", "out", "--ticks", 25).exit_code == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (FIGURES.replace("grazers", "cows"), "drawn/figures.py:7: draw(run) stopped with KeyError"),
        (FIGURES.replace('{"herd": figure}', "figure"), "draw(run) giving Figure; expected a dict"),
        (FIGURES.replace('"herd"', '"../herd"'), "draw(run) giving '../herd'"),
        ("x = 1", "no function draw(run)"),
        ("x = ", "figures.py:1: not valid Python"),
    ],
)
def test_figures_that_fail_are_named(grazers, tmp_path, text, message):
    assert message in socialmind(*with_figures(grazers, tmp_path, text)).stderr
    assert Run("out").manifest.status == "finished"


def test_replay_says_equal_or_what_differs(done, tmp_path):
    result = socialmind("replay", done)
    assert (result.exit_code, result.stdout) == (0, "equal\n")
    import pandas as pd

    shutil.copytree(done, tmp_path / "altered")
    table = pd.read_parquet("altered/agents.parquet")
    table.loc[(table["tick"] == 20) & (table["agent"] == 1), "energy"] = 99.0
    table.to_parquet("altered/agents.parquet")
    result = socialmind("replay", "altered")
    assert result.exit_code == 1
    first, second = result.stdout.splitlines()
    assert first == "different: agents: agents.parquet is not the table that the run wrote"
    assert "column energy first differs at tick 20, agent 1: 99.0 in the run" in second


def test_explain_prints_the_receipt(done):
    result = socialmind("explain", done, "--agent", 1, "--tick", 20)
    assert result.exit_code == 0, result.output
    assert "Hunger" in result.stdout
    assert "probability" in result.stdout


@pytest.mark.parametrize(
    ("agent", "tick", "message"),
    [
        (99, 20, "no agent 99 lives at tick 20"),
        (1, 41, "tick 41: expected 1 … 40"),
        (1, 0, "tick 0: expected 1 … 40"),
    ],
)
def test_explain_of_nothing(done, agent, tick, message):
    assert message in refused("explain", done, "--agent", agent, "--tick", tick)


# the process


def test_run_needs_no_mesa_pandas_or_matplotlib(tmp_path):
    script = """
import sys
from socialmind.cli import app
app(["run", "tutorial", "--ticks", "5", "--interpreted", "--quiet"], standalone_mode=False)
heavy = {"mesa", "pandas", "matplotlib", "rich", "solara"} & set(sys.modules)
assert not heavy, heavy
"""
    ended = subprocess.run([sys.executable, "-c", script], env=ENVIRONMENT, capture_output=True)
    assert ended.returncode == 0, ended.stderr.decode()


def test_a_reader_that_leaves_is_no_error(tmp_path):
    command = f"{sys.executable} -m socialmind.cli list | true"
    ended = subprocess.run(["bash", "-c", command], env=ENVIRONMENT, capture_output=True, text=True)
    assert ended.stderr == ""
