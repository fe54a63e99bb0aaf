"""The page about sweeps: its code runs, and its command is one that there is."""

import re
import shlex
from pathlib import Path

from coglogo_py.changing.words import words_of
from socialmind.catalogue import load_model
from socialmind.experiments import Sweep, designs
from socialmind.experiments.sweeps.measures.of_runs import measure_called
from socialmind.experiments.sweeps.preparing import nameable

PAGE = (Path(__file__).parents[2] / "docs" / "sweeps.md").read_text("utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


def test_its_first_sweep_ends_in_a_table_and_its_panels_in_a_figure(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    short = BLOCKS[0].replace("ticks=50_000", "ticks=20").replace("range(20)", "range(2)")
    short = short.replace("every=500", "every=5").replace('out="price-2"', 'out="price"')
    short = short.replace("measures=", "compiled=False, workers=1, measures=")
    assert short.count("compiled=False") == 1
    names = {"__name__": "__main__"}
    exec(compile(short, "docs/sweeps.md", "exec"), names)
    assert len(names["runs"]) == 18
    assert list(names["table"].columns) == [0.5, 1.0, 2.0]
    exec(compile(BLOCKS[-1], "docs/sweeps.md", "exec"), names)
    assert (tmp_path / "three.pdf").stat().st_size > 1000
    left, middle, right = names["figure"].axes[:3]
    assert left.get_xlabel().startswith("tool price") and len(middle.containers) == 3
    assert " ".join(right.get_xlabel().split()) == "difference of artisans (agents)"


def test_its_commands_are_there(tmp_path, monkeypatch):
    from typer.testing import CliRunner

    from socialmind.cli import app

    monkeypatch.chdir(tmp_path)
    lines = re.findall(r"^socialmind (.*)$", PAGE, re.MULTILINE)
    assert len(lines) == 9
    for line in lines:
        words = shlex.split(line)
        for old, new in {"50000": "4", "500": "2", "0:20": "0:2"}.items():
            words = [new if word == old else word for word in words]
        if words[0] == "sweep":
            words += ["--interpreted", "--workers", "1"] if "--grid" in words else ["--quiet"]
        result = CliRunner().invoke(app, words)
        assert result.exit_code == 0, (line, result.output)
    assert "`9 points (grid) × 20 seeds = 180 runs of 50,000 ticks`" in PAGE


def test_its_shock_strikes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plague.py").write_text("def hail(society):\n    society.humans.wheat = 0.0\n")
    short = BLOCKS[2].replace("10_000", "2, every=1, compiled=False, workers=1")
    short = short.replace("5000:", "1:").replace("range(20)", "range(1)")
    names = {"__name__": "__main__"}
    exec(compile(short, "docs/sweeps.md", "exec"), names)
    series = Sweep(names["folder"]).series
    assert (series.loc[series["tick"] == 1, "wheat"] > 0).all()
    assert (
        series.loc[series["tick"] == 2, "wheat"] < series.loc[series["tick"] == 1, "wheat"].min()
    ).all()


def test_what_it_names_is_there():
    names = {}
    exec(BLOCKS[1], names)
    assert measure_called("share", names["share_of_artisans"]).takes == ("series",)
    for name in designs.SAMPLERS:
        assert f"`{name}" in PAGE
    known = words_of(nameable(load_model("farmer_artisan")).schemes["humans"])
    kinds = "influence|reinforcement|start|at_birth|decision_maker"
    named = re.findall(rf"`((?:{kinds})\.\w[\w.]*)`", PAGE)
    assert len(named) >= 6
    assert [name for name in named if name not in known] == []
