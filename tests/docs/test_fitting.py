"""The page about fits: its code runs, its commands are there, and what it says comes true."""

import re
import shlex
from pathlib import Path

import pytest

from socialmind.cli import app
from socialmind.experiments import Fit
from socialmind.experiments.calibration.methods.registry import METHODS
from socialmind.experiments.calibration.plan import Plan
from socialmind.experiments.calibration.reporting import pictures
from socialmind.experiments.calibration.space import Space
from socialmind.experiments.calibration.target import target_of

PAGE = (Path(__file__).parents[2] / "docs" / "fitting.md").read_text("utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
LINES = re.findall(r"^socialmind (fit .*)$", PAGE, re.MULTILINE)


def test_its_command_and_its_code_fit_alike_and_can_be_read(tmp_path, monkeypatch):
    from typer.testing import CliRunner

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pictures, "figures_of", lambda _: {})
    (line,) = LINES
    small = {"500": "8", "50000": "10"}
    words = [small.get(word, word) for word in shlex.split(line)]
    words[words.index("--every") + 1] = "2"
    words += ["--seeds", "1", "--recover", "1", "--workers", "1", "--interpreted"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    short = BLOCKS[0].replace("budget=500", "budget=8, seeds=1, recover=1, workers=1")
    short = short.replace("ticks=50_000", "ticks=10, compiled=False").replace(
        "every=500", "every=2"
    )
    names = {"__name__": "__main__"}
    exec(compile(short, "docs/fitting.md", "exec"), names)
    assert names["found"].values == Fit("price").values
    exec(BLOCKS[1], names)
    assert list(names["wide"].columns.names) == [None, "parameter"]
    assert len(names["trials"]) == 8
    table = PAGE.split("## The folder")[1]
    for path in Path("price").iterdir():
        if path.suffix != ".yaml" and path.name != ".lock":
            assert f"`{path.name}" in table, path.name


def test_it_says_what_is_said_before_the_first_run():
    plan = Plan(_two(), target_of(["settled=5±0.5", "wheat=16000±500"]), "cmaes", 500, 5, 10, 20)
    assert "```\n" + "\n".join(plan.said(50_000)) + "\n```" in PAGE


def test_it_tells_all_methods_and_options():
    import typer

    for name in METHODS:
        assert f"| `{name}` |" in PAGE
    known = {
        one
        for parameter in typer.main.get_command(app).commands["fit"].params
        for one in parameter.opts
    }
    named = set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", PAGE))
    assert named <= known
    assert "--resume" in named and "--cluster" in named


def test_its_distance_is_the_one_that_is_used():
    from socialmind.experiments.calibration import distance

    assert "√( 1/C · Σ_c  1/T_c · Σ_t ((x" in PAGE
    assert "√( 1/C · Σ_c  1/T_c · Σ_t ((x" in distance.__doc__
    target = target_of(["settled=5±0.5", "wheat=16000±500"])
    import numpy as np

    assert target.distance(np.array([[5.5, 16_500.0]])) == pytest.approx(1.0)


def _two():
    from socialmind.catalogue import load_model
    from socialmind.experiments.calibration.space import space_of
    from socialmind.experiments.sweeps.preparing import nameable

    there = nameable(load_model("farmer_artisan"))
    found = space_of({"tool_price": (100.0, 250.0), "demand_intensity": (0.2, 2.0)}, there)
    assert isinstance(found, Space)
    return found
