"""What is imported at the start: a command line that is only read waits for no library."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[1]
HEAVY = ("numpy", "numba", "scipy", "pandas", "pyarrow", "matplotlib", "mesa", "yaml", "rich")


def loaded(code):
    """Return which heavy modules a fresh Python has imported after some code."""
    said = f"import sys\n{code}\nprint(*sorted(set({HEAVY!r}) & set(sys.modules)), file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, check=True)
    return done.stderr.split()


@pytest.mark.parametrize(
    "code",
    [
        "import socialmind",
        "import coglogo_py",
        "import socialmind.cli",
        "from typer.testing import CliRunner; from socialmind.cli import app\n"
        "for options in ['--help'], ['--version'], ['run', '--help']:\n"
        "    assert CliRunner().invoke(app, options).exit_code == 0",
    ],
)
def test_nothing_heavy_is_imported(code):
    assert set(loaded(code)) <= {"rich"}  # a library for words on terminals, where there is one


def test_names_are_there_when_asked_for():
    done = subprocess.run(
        [sys.executable, "-c", "import socialmind.model, socialmind.society.parameter\n"
         "from socialmind import *; import socialmind, coglogo_py\n"
         "assert callable(socialmind.parameter) and callable(parameter)\n"
         "assert all(hasattr(one, name) for one in (socialmind, coglogo_py)"
         " for name in one.__all__)\n"
         "assert set(socialmind.__all__) <= set(dir(socialmind))\n"
         "assert not hasattr(socialmind, 'Modell')"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("module", ["socialmind", "socialmind.cli"])
def test_ctrl_c_at_the_very_start(tmp_path, module):
    (tmp_path / "typer.py").write_text("raise KeyboardInterrupt\n")
    path = os.pathsep.join([str(tmp_path), str(CHECKOUT)])
    done = subprocess.run(
        [sys.executable, "-m", module, "list"],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_ctrl_c_while_a_library_is_read_that_cannot_be_read_again(tmp_path):
    """As NumPy, which says so with an ImportError."""
    (tmp_path / "numpy.py").write_text(
        "import sys\n"
        "if hasattr(sys, 'begun'):\n"
        "    raise ImportError('cannot load module more than once per process')\n"
        "sys.begun = True\n"
        "raise KeyboardInterrupt\n"
    )
    path = os.pathsep.join([str(tmp_path), str(CHECKOUT)])
    done = subprocess.run(
        [sys.executable, "-m", "socialmind", "run", "boids"],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "socialmind: stopped\n")
