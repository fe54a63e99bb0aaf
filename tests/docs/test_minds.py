"""The page on minds of skills: its code runs, and gives what the page says."""

import re
from pathlib import Path

import pytest

from socialmind.catalogue import load_model

PAGE = (Path(__file__).parents[2] / "docs" / "minds.md").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The model of the page, loaded from a file that holds all its code."""
    folder = tmp_path_factory.mktemp("page")
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    (folder / "model.py").write_text(code, "utf-8")
    return load_model(str(folder))


def names_of(page):
    return __import__("sys").modules[page.__module__].__dict__


def test_equation_6_1(page):
    robot = names_of(page)["robot"]
    assert robot.evaluate({"DISTANCE": 0.0}) == {"MotL": 0.5, "MotR": 1.0}
    assert robot.influences() == {"Avoid": 1.0, "moveForward": 1.0, "turnLeft": 1.0}
    assert robot.evaluate({"DISTANCE": 1.0}) == {"MotL": 1.0, "MotR": 1.0}


def test_the_drive_reaches_its_skill(page):
    # moveForward 1.0 and, from the drive, turnLeft 0.5: the left wheel is told 1.0 / 1.5.
    driven = names_of(page)["driven"]
    assert driven.actuators()["MotL"] == pytest.approx(1.0 / 1.5)


def test_variants_leave_the_mind_as_it_was(page):
    names = names_of(page)
    robot, learned = names["robot"], names["learned"]
    assert robot.skills == ("Avoid", "moveForward", "turnLeft")
    assert (learned.skill("Avoid").genome == -names["weights"]).all()


def test_thousands_give_what_one_gives(page):
    names = names_of(page)
    alone = names["robot"].evaluate({"DISTANCE": 0.5})
    names["minds"].set_sensor("DISTANCE", 0.5)
    names["minds"].step()
    assert set(names["minds"].actuator("MotL").tolist()) == {alone["MotL"]}


def test_the_model_runs_alike_at_both_speeds(page):
    compiled, interpreted = page(seed=1), page(seed=1, compiled=False)
    for society in (compiled, interpreted):
        society.advance(30)
    assert compiled.robots.x.tolist() == interpreted.robots.x.tolist()
    assert len({*compiled.robots.x.tolist()}) > 1
