"""The command line as a program: usage, imports, its end."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from socialmind.cli import app

CHECKOUT = Path(__file__).parents[1]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(CHECKOUT)}


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
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert message in result.stderr.splitlines()[-1]


def test_run_needs_no_mesa_pandas_or_matplotlib(tmp_path):
    script = """
import sys
from socialmind.cli import app
app(["run", "tutorial", "--ticks", "5", "--interpreted", "--quiet"], standalone_mode=False)
heavy = {"mesa", "pandas", "matplotlib", "rich", "solara"} & set(sys.modules)
assert not heavy, heavy
"""
    words = [sys.executable, "-c", script]
    ended = subprocess.run(words, env=ENVIRONMENT, cwd=tmp_path, capture_output=True)
    assert ended.returncode == 0, ended.stderr.decode()


def test_a_warning_names_the_line_of_the_model_that_it_is_about(tmp_path):
    (tmp_path / "model.py").write_text("""
import numpy as np
from socialmind import Agent, Model, Population

class Counting(Model):
    people = Population(Agent, 2)

    def series(self):
        return {"logarithm": float(np.log(np.array([-1.0]))[0])}
""")
    words = [sys.executable, "-m", "socialmind.cli", "run", "model.py", "--ticks", "1"]
    ended = subprocess.run(words, env=ENVIRONMENT, cwd=tmp_path, capture_output=True, text=True)
    assert f"socialmind: {tmp_path}/model.py:9: invalid value encountered in log" in ended.stderr


def test_a_reader_that_leaves_is_no_error():
    command = f"{sys.executable} -m socialmind.cli list | true"
    ended = subprocess.run(["bash", "-c", command], env=ENVIRONMENT, capture_output=True, text=True)
    assert ended.stderr == ""
