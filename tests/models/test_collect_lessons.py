"""The lessons of the collecting robots: what is paid, what moves a target, what ends an episode."""

import math
import re

import numpy as np
import pytest

from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

LESSONS = load_file(model_folder("collect") / "lessons.py")
RETRAINED = load_file(model_folder("collect_retrained") / "lessons.py")
POWER = load_file(model_folder("collect_power") / "lessons.py")
AHEAD, BACK, STILL = (1.0, 1.0, 0.5), (0.0, 0.0, 0.5), (0.5, 0.5, 0.5)
EMPTY = [
    (LESSONS.GoToObject, "objects", 2.5),
    (LESSONS.GoToDropZone, "drop_zones", 0.0),
    (POWER.GoToPower, "supplies", 0.0),
]
CROWDED = [
    (LESSONS.GoToObjectAvoid, "objects", 2.5),
    (LESSONS.GoToDropZoneAvoid, "drop_zones", 0.0),
    (POWER.GoToPowerAvoid, "supplies", 0.0),
]
NAMES = [environment.__name__ for environment, *_ in EMPTY]


def world(environment, commands=STILL, seed=1):
    """Return a world whose robot is told the same thing all the time, and looks to the right."""
    model = environment(seed, compiled=False, hierarchy=False)
    model.robots[0].angle = 0.0
    model.steer("robots", commands)
    return model


def away(model, target):
    robot = model.robots[0]
    return math.hypot(target.x - robot.x, target.y - robot.y)


@pytest.mark.parametrize(("environment", "name", "ahead"), EMPTY, ids=NAMES)
def test_reaching_a_target_pays_once_and_moves_it(environment, name, ahead):
    model = world(environment)
    robot, target = model.robots[0], model.tables[name][0]
    model.advance(1)
    assert robot.score == 0.0
    target.x, target.y = robot.x + ahead, robot.y
    model.advance(1)  # sensed, and moved
    assert away(model, target) >= 8
    assert max(abs(target.x), abs(target.y)) <= 12
    model.advance(1)
    # The move itself is neither coming nearer nor going away.
    assert robot.score == pytest.approx(0.5, abs=0.02)
    paid = robot.score
    model.advance(10)
    assert robot.score == pytest.approx(paid)


@pytest.mark.parametrize(("environment", "name", "ahead"), EMPTY, ids=NAMES)
@pytest.mark.parametrize("sense", [1, -1], ids=["nearer", "away"])
def test_coming_nearer_pays_little_and_going_away_costs(environment, name, ahead, sense):
    model = world(environment, AHEAD)
    robot, target = model.robots[0], model.tables[name][0]
    robot.x = robot.y = 0.0
    target.x, target.y = 20.0 * sense, 0.0
    model.advance(3)
    before, score = away(model, target), robot.score
    model.advance(30)
    direction = 0.0 if name == "objects" else 30 * 0.0005
    assert sense * (before - away(model, target)) > 3
    gained = 0.001 * (before - away(model, target)) + direction
    assert robot.score - score == pytest.approx(gained, abs=1e-9)


@pytest.mark.parametrize(("environment", "name", "ahead"), EMPTY[1:], ids=NAMES[1:])
def test_backing_into_a_zone_costs_more_than_its_way_pays(environment, name, ahead):
    model = world(environment, BACK)
    robot, target = model.robots[0], model.tables[name][0]
    target.x, target.y = -12.0, 0.0
    model.advance(3)
    before, score = away(model, target), robot.score
    model.advance(20)
    closing = 0.001 * (before - away(model, target))
    assert robot.score - score == pytest.approx(closing - 20 * 0.005)
    assert robot.score < score


@pytest.mark.parametrize(("environment", "name", "ahead"), CROWDED, ids=NAMES)
def test_among_obstacles_reaching_pays_one_and_a_collision_ends_it(environment, name, ahead):
    model = world(environment)
    robot, target = model.robots[0], model.tables[name][0]
    for seed in range(10):
        fresh = world(environment, seed=seed)
        field, one = fresh.obstacles, fresh.tables[name][0]
        clear = np.hypot(field.x - one.x, field.y - one.y) - math.sqrt(2) * field.half_width
        assert clear.min() > (4.0 if name == "objects" else 5.0) - 0.001
        assert away(fresh, one) >= 8
        assert max(abs(one.x), abs(one.y)) <= 60
    target.x, target.y = robot.x + ahead, robot.y
    model.advance(3)
    assert robot.score == 1.0
    assert away(model, target) >= 8
    robot.x = 69.5
    robot.y = 64.0
    model.advance(2)
    assert model.over == "collision"
    assert robot.score == 1.0


def test_avoid_pays_for_each_square_once():
    model = world(LESSONS.Avoid)
    robot = model.robots[0]
    robot.x, robot.y = 65.0, 65.0  # clear of all obstacles
    model.advance(2)
    start = robot.score
    robot.x = 59.9  # the next square
    model.advance(1)
    assert robot.score - start == pytest.approx(1, abs=0.02)
    robot.x = 65.0
    model.advance(1)
    robot.x = 59.9
    model.advance(1)
    assert robot.score - start == pytest.approx(1, abs=0.02)


def test_avoid_costs_twenty_for_a_collision_which_ends_it():
    model = world(LESSONS.Avoid)
    robot = model.robots[0]
    model.advance(2)
    before = robot.score
    robot.x, robot.y = 69.5, 5.0
    model.advance(1)
    assert model.over == "collision"
    assert robot.score - before == pytest.approx(-20 + 1, abs=0.02)  # in another square


@pytest.mark.parametrize(
    ("commands", "lowest", "highest"),
    [(AHEAD, 0.001, 0.003), (BACK, -0.01, -0.008), ((0.0, 1.0, 0.5), -0.002, 0.001)],
    ids=["ahead", "back", "turning"],
)
def test_avoid_pays_for_going_ahead_straight_and_clear(commands, lowest, highest):
    model = world(LESSONS.Avoid, commands)
    robot = model.robots[0]
    rewards = []
    robot.x, robot.y, robot.angle = 62.5, 0.0, math.pi / 2
    for _ in range(90):
        model.advance(1)
        assert model.over is None
        if robot.reward < 0.5:  # no other square
            rewards.append(robot.reward)
    later = rewards[40:]
    assert lowest <= min(later)
    assert max(later) <= highest


@pytest.mark.parametrize(
    ("environment", "contact"),
    [(LESSONS.GoToObject, 0), (LESSONS.GoToObjectAvoid, 0), (LESSONS.CollectObjects, 2)],
)
def test_only_where_it_collects_the_robot_pushes_the_object(environment, contact):
    model = world(environment)
    robot, ball = model.robots[0], model.objects[0]
    ball.x, ball.y = robot.x, robot.y - 1.5  # overlapping, out of the claw's reach
    model.advance(1)
    assert robot.contact == contact
    assert (ball.y == -1.5) == (contact == 0)
    assert model.over is None


def test_the_battery_ends_the_lesson_with_power():
    model = world(POWER.CollectWithPower)
    robot = model.robots[0]
    robot.battery = 0.0005
    model.advance(5)
    assert model.over == "battery"
    assert robot.score == 0.0


# What the ODD documents say ---------------------------------------------------------------------


def rows_of(name):
    """Return the table of lessons in a model's ODD document, a row each."""
    text = (model_folder(name) / "ODD.md").read_text("utf-8").split("### Lessons\n", 1)[1]
    lines = [line for line in text.split("\n#", 1)[0].splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


@pytest.mark.parametrize(
    ("name", "lessons"),
    [
        ("collect", LESSONS.curriculum.items),
        ("collect_retrained", RETRAINED.curriculum.items),
        ("collect_power", POWER.lessons),
    ],
)
def test_the_odd_document_tells_the_lessons(name, lessons):
    rows = rows_of(name)
    assert [row[0] for row in rows] == [lesson.name for lesson in lessons]
    for row, lesson in zip(rows, lessons, strict=True):
        ticks, worlds, generations, individuals = (cell.replace(",", "") for cell in row[-4:])
        environment = lesson.environment
        assert int(ticks) == (lesson.ticks or environment.ticks)
        assert int(worlds) == lesson.repetitions
        assert re.match(r"\d+", generations)[0] == str(lesson.generations)
        if lesson.budget:
            assert f"{lesson.budget // 10**6} million ticks" in generations
        assert int(individuals) == lesson.settings["population"]
        ends = [one.strip() for one in row[3].split(",") if one.strip()]
        assert len(ends) == len(environment.interruptions)
