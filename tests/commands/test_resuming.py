"""`socialmind run --resume`, and stopping a run."""

import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from socialmind.experiments import Run

CHECKOUT = Path(__file__).parents[2]
PYTHON = [sys.executable, "-m", "socialmind.cli"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(CHECKOUT)}


def test_resume_makes_a_finished_run_longer(socialmind, refused, grazers, done, tmp_path):
    shutil.copytree(done, tmp_path / "longer")
    result = socialmind("run", "--resume", "longer", "--ticks", 60, "--quiet")
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/longer\n"
    words = ("--ticks", 60, "--seed", 4, "--set", "n_grazers=3", "--interpreted")
    assert socialmind("run", grazers, *words, "--out", "at_once", "--every", 1).exit_code == 0
    assert Run("longer").manifest.tables == Run("at_once").manifest.tables
    assert "60 ticks are done, 50 asked for" in refused("run", "--resume", "longer", "--ticks", 50)


def test_resume_sees_a_changed_model_and_a_changed_scheme(socialmind, refused, grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "mine")
    words = ("--ticks", 5, "--interpreted", "--out", "out")
    assert socialmind("run", "./mine", *words).exit_code == 0
    model = tmp_path / "mine" / "model.py"
    model.write_text(model.read_text().replace("0.2", "0.3"))
    line = refused("run", "--resume", "out", "--ticks", 9)
    assert "is not the file that the run was made with; put the old file back" in line
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


def test_ctrl_c_says_how_to_go_on(socialmind, grazers, tmp_path):
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


def test_sigkill_before_the_first_checkpoint(socialmind, refused, grazers, tmp_path):
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
    words = ["run", grazers, "--ticks", 3000, "--interpreted"]
    shown = {}
    for option in ("--quiet", "--interpreted"):
        ours, theirs = pty.openpty()
        command = [*PYTHON, *map(str, words), option]
        ended = subprocess.run(command, stderr=theirs, stdout=subprocess.PIPE, env=ENVIRONMENT)
        os.close(theirs)
        assert ended.returncode == 0
        try:
            shown[option] = os.read(ours, 100_000).decode(errors="replace")
        except OSError:  # nothing was written
            shown[option] = ""
        os.close(ours)
    assert shown["--quiet"] == ""
    assert "of 3000 ticks" in shown["--interpreted"]
