"""`socialmind learn`: what it says, what it refuses, and how it is stopped."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from socialmind.commands.learning import read_settings
from socialmind.errors import SocialmindError
from socialmind.learning import Training
from socialmind.learning.training.telling import clock, line_of

CHECKOUT = Path(__file__).parents[2]
MODEL = """
from socialmind import Agent, Model, Population


class Walker(Agent):
    pass


class Empty(Model):
    walkers = Population(Walker, 1)
"""
LESSONS = """
from socialmind.learning import Curriculum, Cycle, Lesson
from socialmind.mind import MindDescription, Perceptron, Skill
from .slopes import Slope

mind = MindDescription("robot", ["S1"], ["MotL"], skills=[
    Skill("Top", ["SE:S1"], ["SK:Go"], Perceptron(layers=0)),
    Skill("Go", ["SE:S1"], ["MO:MotL"], Perceptron(layers=0)),
])
COMMON = dict(generations=3, repetitions=2, finals=5, parameters={"seconds": SECONDS},
              settings={"population": 12})
curriculum = Curriculum([Lesson("Go", Slope, **COMMON), Lesson("Top", Slope, **COMMON)], mind=mind)
"""


@pytest.fixture
def walk(tmp_path):
    """A model's folder with a curriculum of two lessons."""

    def made(seconds=0.0):
        folder = tmp_path / "walk"
        folder.mkdir()
        (folder / "model.py").write_text(MODEL)
        (folder / "lessons.py").write_text(LESSONS.replace("SECONDS", str(seconds)))
        shutil.copy(Path(__file__).parents[1] / "learning" / "slopes.py", folder)
        return folder

    return made


def test_it_says_what_was_learned_and_where_it_is(socialmind, walk, tmp_path):
    result = socialmind("learn", walk(), "--attempts", 2, "--seed", 3)
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/trainings/walk-001\n"
    lines = result.stderr.splitlines()
    pattern = r"attempt 1, Go: -?[\d.]+ ± [\d.]+ on 5 worlds, from generation [123] of 3, [\d,]+ t"
    assert re.match(pattern, lines[0])
    assert [line.split(":")[0] for line in lines[1:4]] == [
        "attempt 1, Top", "attempt 2, Go", "attempt 2, Top",
    ]  # fmt: skip
    assert re.fullmatch(r"Go: \S+ in 2 attempts, the best \S+ \(attempt [12]\)", lines[4])
    assert re.fullmatch(rf"[\d,]+ ticks in \S+; minds in {tmp_path}/trainings/walk-001", lines[6])
    training = Training("trainings/walk-001")
    assert training.manifest.seed == 3
    assert training.manifest.model["name"] == "walk"
    again = socialmind("learn", "--resume", "trainings/walk-001", "--attempts", 3, "--quiet")
    assert (again.exit_code, again.stderr) == (0, "")
    assert Training("trainings/walk-001").attempts == [1, 2, 3]


def test_options_go_to_the_lessons(socialmind, walk):
    words = (
        "--optimiser",
        "annealing",
        "--set",
        "neighbours=2",
        "--generations",
        2,
        "--workers",
        1,
    )
    result = socialmind("learn", walk(), "--lesson", "Go", *words, "--out", "out", "--quiet")
    assert result.exit_code == 0, result.output
    (record,) = Training("out").manifest.lessons
    assert (record["name"], record["optimiser"], record["generations"]) == ("Go", "ANNEALING", 2)
    assert record["settings"]["neighbours"] == 2
    result = socialmind("learn", "./walk", "--ticks-budget", 1,
                        "--out", "short", "--quiet")  # fmt: skip
    assert Training("short").curve["generation"].tolist() == [1, 1]


def test_what_is_wrong_is_one_line(refused, walk, tmp_path):
    folder = walk()
    assert "which model? give a name" in refused("learn")
    assert "did you mean 'Go'?" in refused("learn", folder, "--lesson", "Goo")
    assert "LUCK" in refused("learn", folder, "--optimiser", "LUCK")
    assert "--set elite: expected NAME=NUMBER" in refused("learn", folder, "--set", "elite")
    assert "the setting 'elit'" in refused("learn", folder, "--set", "elit=3")
    assert "engine 'jet'" in refused("learn", folder, "--engine", "jet")
    line = refused("learn", "--resume", "x", "--seed", 1, "--lesson", "Go")
    assert "--resume with --lesson, --seed: a training keeps what it was started with" in line
    assert "no such folder" in refused("learn", "--resume", "x")
    assert not (tmp_path / "trainings").exists()


def test_ctrl_c_says_how_to_go_on(socialmind, walk, tmp_path):
    words = ["learn", str(walk(0.2)), "--out", "out", "--workers", "1"]
    process = subprocess.Popen(
        [sys.executable, "-m", "socialmind.cli", *words],
        env={**os.environ, "PYTHONPATH": str(CHECKOUT)}, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    while not Path("out/attempts/1/checkpoint.npz").exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    assert re.fullmatch(
        r"socialmind: stopped in attempt 1, Go, after generation [12]; go on with "
        rf"`socialmind learn --resume {tmp_path}/out`",
        stderr.splitlines()[-1],
    )
    assert socialmind("learn", "--resume", "out").exit_code == 0
    assert Training("out").manifest.status == "finished"


def test_a_line_of_progress(walk):
    from socialmind.learning.lessons.curriculum import Position
    from socialmind.learning.lessons.lesson import Lesson
    from socialmind.learning.training.attempt import News

    news = News(1, Lesson("Go", Path, generations=1500), Position(), 20, 1.23456, -0.5, 900, 0.5, 9)
    assert line_of(news, 61.0) == (
        "attempt 1, Go  generation 20 of 1,500  best 1.235  mean -0.5  1,800 ticks/s  0:01:01 left"
    )
    assert line_of(news, None).endswith("1,800 ticks/s")
    assert clock(36_000) == "10:00:00"


def test_settings_are_numbers_by_name():
    assert read_settings(["elite=2", "add-neuron=0.5", "elite=3"]) == {
        "elite": 3,
        "add_neuron": 0.5,
    }
    for wrong in ("elite", "elite=many", "=3x"):
        with pytest.raises(SocialmindError, match="expected NAME=NUMBER"):
            read_settings([wrong])
