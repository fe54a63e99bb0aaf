"""Scenes: what stands where, and what robots see, by hand-computed places."""

import math
from pathlib import Path

import numpy as np
import pytest

from socialmind import Agent, Model, Population
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.worlds.plane import Disc, Plane, Robot, emitter
from socialmind.worlds.plane.scene import RobotSeen, Scene, scene_of

SEEKERS = Path(__file__).parent / "seekers"


class Wanderers(Model):
    wanderers = Population(Agent, 2)


@pytest.fixture
def seekers():
    return load_model(SEEKERS)(compiled=False)


def segments(*wanted):
    return pytest.approx(np.array(wanted, float), abs=1e-9)


def test_bodies_zones_and_obstacles_stand_where_the_rules_put_them(seekers):
    scene = scene_of(seekers)
    assert (scene.tick, scene.half_width, scene.over) == (0, 30.0, None)
    assert [(one.team, one.identity, one.x, one.y) for one in scene.robots] == [
        ("robots", 0, -8.0, 0.0),
        ("robots", 1, -2.0, 3.0),
    ]
    assert [(one.angle, one.radius) for one in scene.robots] == [(0.0, 1.0)] * 2
    assert scene.objects["balls"].tolist() == [[15.0, -5.0, 1.0]]
    assert scene.zones["zones"].tolist() == [[-20.0, -20.0, 0.3, 5.0]]
    assert scene.obstacles.tolist() == [[-2.0, 12.0, 0.0, 1.0, 0.0], [8.0, 12.0, 0.0, 1.0, 1.0]]


def test_rays_end_at_what_they_detect_and_start_with_the_first_tick(seekers):
    assert [len(one.rays) for one in scene_of(seekers).robots] == [0, 0]
    # In the first tick commands are 0.5, which is to stand still.
    seekers.advance()
    first, second = scene_of(seekers).robots
    # Nobody sees the ball, and nothing else is within 12 ahead.
    assert first.rays == segments([[-7, 0], [5, 0]], [[-8, 1], [-8, 13]])
    # Straight to the left of the second stands the square, from y = 11 on.
    assert second.rays == segments([[-1, 3], [11, 3]], [[-2, 4], [-2, 11]])


def test_rays_turn_with_the_robot(seekers):
    seekers.tables["robots"].columns["angle"][1] = math.pi / 2
    seekers.advance()
    second = scene_of(seekers).robots[1]
    assert second.rays == segments([[-2, 4], [-2, 11]], [[-3, 3], [-15, 3]])


def test_lines_lead_to_the_targets_within_reach(seekers):
    # The zone is 23.3 from the first robot, 29.2 from the second, whose sensor reaches 25.
    first, second = scene_of(seekers).robots
    assert first.lines == segments([[-8, 0], [15, -5]], [[-8, 0], [-20, -20]])
    assert second.lines == segments([[-2, 3], [15, -5]])


def test_no_line_leads_to_what_is_carried(seekers):
    balls = seekers.tables["balls"].columns
    balls["carrier_kind"][:], balls["carrier"][:] = 1, 0
    first, second = scene_of(seekers).robots
    assert first.lines == segments([[-8, 0], [-20, -20]])
    assert len(second.lines) == 0


def test_the_dead_are_not_shown(seekers):
    robots, stones = seekers.tables["robots"], seekers.tables["stones"]
    robots.die(robots[0])
    stones.die(stones[1])
    scene = scene_of(seekers)
    assert [one.identity for one in scene.robots] == [1]
    assert len(scene.obstacles) == 1


class Beacon(Robot):
    signal: list[float] = [0.0, 0.0]  # noqa: RUF012


class Beacons(Model):
    """Three robots that can emit on the second channel alone."""

    world = Plane(20.0)
    beacons = Population(Beacon, 3, body=Disc(), actuators={"Signal": emitter(1)})


def test_who_emits_a_signal_is_known():
    model = Beacons(compiled=False)
    for robot, signal in zip(model.beacons, ([1.0, 0.5], [0.0, 0.6], [0.0, 0.0]), strict=True):
        for channel in (0, 1):
            robot.signal[channel] = signal[channel]
    assert [one.emits for one in scene_of(model).robots] == [False, True, False]


def test_an_interruption_has_its_name(seekers):
    seekers.tables["robots"].columns["x"][0] = 29.5
    seekers.advance(2)
    assert scene_of(seekers).over == "collision"


def test_robots_are_found_by_population_and_identity():
    places = [("foxes", 0), ("foxes", 1), ("geese", 1)]
    scene = Scene(0, 10.0, [RobotSeen(team, one, 0.0, 0.0, 0.0, 1.0) for team, one in places])

    def found(*wanted):
        one = scene.robot(*wanted)
        return one and (one.team, one.identity)

    assert found() == ("foxes", 0)
    assert found(1) == ("foxes", 1)
    assert found(1, "geese") == ("geese", 1)
    assert found(None, "geese") == ("geese", 1)
    assert found(2) is None


def test_a_world_that_is_no_plane_has_no_scene():
    with pytest.raises(SocialmindError, match=r"wanderers has no plane.*world = Plane"):
        scene_of(Wanderers())
