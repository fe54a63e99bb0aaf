"""Where bodies may be put: inside the arena, whoever puts them there, by either engine."""

import math
from pathlib import Path

import numpy as np
import pytest

from socialmind import Model, ModelError, Population, RuleError, SocialmindError, each, parameter
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import Disc, Obstacle, Plane, Robot, Sense, constant, wheel
from socialmind.worlds.plane.devices.relative import bearing_of

MIND = MindDescription(
    "goer",
    ["S"],
    ["W"],
    skills=[Skill("Go", ["SE:S"], ["MO:W"], Perceptron(layers=0), [0.0, 1.0])],
)


def lay(robot, model):
    """Begin somewhere."""
    robot.x = model.begin


def fence(stone):
    """Stand on the border; what never moves may reach over it."""
    stone.x = 1000.0


def leap(robot, model):
    """Put the second robot somewhere in the fourth tick, by two steps, the first of them inside."""
    if model.tick == 3 and robot.id == 1:
        robot.y = 0.0
        robot.y += model.to


class Yard(Model):
    """Three robots in an arena from -20 to 20."""

    ticks = 6
    begin: float = parameter(0.0)
    to: float = parameter(0.0)
    half_width: float = parameter(20.0, low=0.0)
    world = Plane("half_width")
    stones = Population(Obstacle, 1)
    robots = Population(
        Robot,
        3,
        body=Disc(),
        sensors={"S": constant(0.5)},
        actuators={"W": wheel((0.0, 0.0))},
        hierarchy=MIND,
    )
    setup = (each(stones, fence), each(robots, lay))
    schedule = (each(robots, leap),)


WAYS = [(True, "compiled"), (True, "pymunk"), (False, "compiled"), (False, "pymunk")]


@pytest.mark.parametrize(("compiled", "physics"), WAYS)
@pytest.mark.parametrize("to", [1000.0, -20.001, 1e300])
def test_a_rule_that_puts_a_robot_outside_is_refused_with_its_line(compiled, physics, to):
    yard = Yard(compiled=compiled, physics=physics, to=to)
    with pytest.raises(RuleError, match=r"y = .* of agent 1, which is outside the arena") as caught:
        yard.advance(6)
    assert caught.value.tick == 3
    file, _, line = caught.value.place.rpartition(":")
    assert "robot.y += model.to" in Path(file).read_text().splitlines()[int(line) - 1]


@pytest.mark.parametrize(("compiled", "physics"), WAYS)
def test_the_border_itself_is_inside_and_without_borders_all_is(compiled, physics):
    for arguments in ({"to": 20.0, "begin": -20.0}, {"to": 1000.0, "half_width": 0.0}):
        yard = Yard(compiled=compiled, physics=physics, **arguments)
        yard.advance(6)
        y = yard.robots.y.tolist()[1]
        # At the border there is a wall: it is pushed back by its radius.
        assert y == pytest.approx(19.0 if "begin" in arguments else 1000.0)


def test_in_lockstep_and_in_the_setup():
    with pytest.raises(RuleError, match="y = 1000 of agent 1"):
        Episodes(Yard, parameters={"to": 1000.0}).run(None, [1, 2])
    with pytest.raises(RuleError, match=r"x = -30 of agent \d, .*; in tick 0"):
        Episodes(Yard, parameters={"begin": -30.0}).run(None, [1, 2])
    with pytest.raises(RuleError, match=r"x = 30 of agent \d, .*; in tick 0"):
        Yard(begin=30.0)


def test_from_outside_and_from_tables():
    yard = Yard(compiled=False)
    with pytest.raises(SocialmindError, match=r"x = 1000 of agent 1.*; expected -20 … 20"):
        yard.robots[1].x = 1000
    with pytest.raises(SocialmindError, match="outside the arena"):
        yard.robots.y = -21.0
    with pytest.raises(SocialmindError, match=r"x = 33 of 'robots' \(row 2\)"):
        yard.robots.x = [1.0, 2.0, 33.0]
    assert yard.robots.x.tolist() == [0.0, 0.0, 0.0] and yard.robots.y.tolist() == [0.0, 0.0, 0.0]
    yard.robots[1].x = -20
    assert yard.robots.x.tolist() == [0.0, -20.0, 0.0]
    yard.stones.x = -500.0  # stands where it likes


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_what_is_far_outside_is_brought_back_by_either_engine(physics):
    """No rule can put it there, but a row that somebody wrote."""
    yard = Yard(compiled=False, physics=physics)
    for x, y in ((1000.0, 3.0), (-70.0, 50.0), (5e5, -5e5)):
        rows = yard.tables["robots"].rows
        rows["x"], rows["y"], rows["contact"] = x, y, 0
        yard.advance(1)
        within = [min(max(one, -19.0), 19.0) for one in (x, y)]
        assert [yard.robots.x.tolist()[0], yard.robots.y.tolist()[0]] == pytest.approx(within)
        assert yard.robots.contact.tolist() == [1, 1, 1]


def test_an_arena_has_room_for_its_bodies():
    with pytest.raises(ModelError, match=r"test_edges.py:\d+: found a half-width of 1, in"):
        Yard(half_width=1.0)
    Yard(half_width=1.001, compiled=False).advance(2)


@pytest.mark.parametrize("angle", [0.0, 1.0, -4.0, 7.0, 100.0, -100.0, 3 * math.pi])
def test_bearings_are_angles_whatever_the_angle_of_the_device(angle):
    for way in np.linspace(-math.pi, math.pi, 25).tolist():
        found = bearing_of(math.cos(way), math.sin(way), 1.0, 0.0, angle)
        assert -math.pi <= found <= math.pi
        assert math.cos(found) == pytest.approx(math.cos(way - angle))
        assert math.sin(found) == pytest.approx(math.sin(way - angle), abs=1e-9)


def turn(robot):
    """Tell the angle, from which the heading follows."""
    return robot.heading / 400.0


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
@pytest.mark.parametrize("angle", [math.pi / 2, math.nextafter(math.pi / 2, 4), 90.0, -1e6, 1e-17])
def test_headings_are_below_360(physics, angle):
    sensors = {"H": Sense(turn)}
    robots = Population(Robot, 1, body=Disc(), sensors=sensors)
    parts = {"robots": robots, "setup": (), "schedule": ()}
    yard = type("Turning", (Yard,), parts)(compiled=False, physics=physics)
    yard.robots.angle = angle
    yard.advance(1)
    assert 0.0 <= yard.robots.heading[0] < 360.0
    apart = yard.robots.heading[0] - (90.0 - math.degrees(angle))
    assert math.remainder(apart, 360.0) == pytest.approx(0.0, abs=1e-4)
    yard.robots.heading = -90.0
    assert yard.robots.heading.tolist() == [270.0]
