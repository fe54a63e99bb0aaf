"""The world of the collecting robots, against the standard benchmark worked out by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file
from socialmind.worlds.plane import in_zone

WORLD = load_file(model_folder("collect") / "model.py")
POWER = load_file(model_folder("collect_power") / "model.py")
SEEDS = range(25)
ZONE, SUPPLY = (-40.0, -40.0), (40.0, 40.0)
STILL = (0.5, 0.5)


def empty(name="collect", seed=1, **parameters):
    """Return a world whose robot does nothing by itself."""
    return load_model(name)(seed, compiled=False, hierarchy=False, **parameters)


@pytest.fixture(scope="module", params=["collect", "collect_retrained", "collect_power"])
def worlds(request):
    """Worlds of a model, just set up; and the middles and half-widths of its zones."""
    zones = [ZONE, SUPPLY] if request.param == "collect_power" else [ZONE]
    return [empty(request.param, seed) for seed in SEEDS], zones


class Draws:
    """A stream whose numbers are given as shares of the interval."""

    def __init__(self, *shares):
        self.shares = list(shares)

    def uniform(self, low, high):
        return low + self.shares.pop(0) * (high - low)


def laid(rules, number, *shares):
    """Return an obstacle as a rule lays it, and whether it lives."""
    gone = []
    obstacle = SimpleNamespace(id=number, die=lambda: gone.append(number))
    rules.lay(obstacle, SimpleNamespace(half_width=70.0), Draws(*shares))
    return obstacle, not gone


# Obstacles ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("rules", [WORLD, POWER], ids=["collect", "collect_power"])
def test_an_obstacle_is_laid_as_worked_out_by_hand(rules):
    obstacle, lives = laid(rules, 19, 0.0, 0.75, 0.5, 0.5)  # column 2, row 3
    assert lives
    assert (obstacle.x, obstacle.y) == (-35.0, -15.5)
    assert (obstacle.angle, obstacle.half_width) == (math.pi / 2, 2.0)


@pytest.mark.parametrize(
    ("number", "shares", "lives"),
    [
        # The middle of cell 36 is (2, 2), 2.83 from the start.
        (36, (0.5, 0.5, 0.0, 0.0), False),  # half-width 1, from 3 on
        (36, (1.0, 1.0, 0.0, 0.0), True),  # at (3, 3), 4.24 away
        (36, (1.0, 1.0, 0.0, 1.0), False),  # half-width 3, from 5 on
        # That of cell 18 is (−34, −34), 8.49 from the middle of the drop zone.
        (18, (0.5, 0.5, 0.0, 1.0), True),  # half-width 3, from 8 on
        (18, (0.0, 0.0, 0.0, 1.0), False),  # at (−35, −35), 7.07 away
        (18, (0.0, 0.0, 0.0, 0.5), True),  # half-width 2, from 7 on
    ],
)
@pytest.mark.parametrize("rules", [WORLD, POWER], ids=["collect", "collect_power"])
def test_none_is_near_the_start_or_the_drop_zone(rules, number, shares, lives):
    assert laid(rules, number, *shares)[1] == lives


@pytest.mark.parametrize(
    ("shares", "near"), [((0.5, 0.5, 0.0, 1.0), True), ((0.0, 0.5, 0.0, 0.0), False)]
)
def test_none_is_near_the_power_supply(shares, near):
    # The middle of cell 54 is (38, 38), 2.8 away; that of cell 53 is (38, 20), far enough.
    assert laid(WORLD, 54, *shares)[1]
    assert not laid(POWER, 54, *shares)[1]
    assert laid(POWER, 53, *shares)[1]


def test_the_field_is_as_the_benchmark_has_it(worlds):
    models, zones = worlds
    offsets, sizes, angles = [], [], []
    for model in models:
        assert model.half_width == 70
        field = model.obstacles
        assert 60 <= len(field) <= 64
        columns, rows = field.id // 8, field.id % 8
        offsets += [*(field.x + 70 - 18 * columns), *(field.y + 70 - 18 * rows)]
        sizes += [*field.half_width]
        angles += [*field.angle]
        assert not field.round.any()
        assert (np.hypot(field.x, field.y) >= field.half_width + 2).all()
        for x, y in zones:
            assert (np.hypot(field.x - x, field.y - y) >= field.half_width + 5).all()
        left_out = {*range(64)} - {*field.id.tolist()}
        assert left_out <= {36, 18, 54}  # the cells next to the start and to zones
    for found, low, high in ((offsets, -1, 1), (sizes, 1, 3), (angles, 0, math.pi)):
        width = high - low
        assert low <= min(found) < low + 0.02 * width
        assert high - 0.02 * width < max(found) <= high
        assert np.mean(found) == pytest.approx((low + high) / 2, abs=0.03 * width)


# Zones, the robot and the object -----------------------------------------------------------------


def test_zones_and_robot_are_in_their_places(worlds):
    models, zones = worlds
    for model in models:
        found = [
            (zone.x, zone.y, zone.half_width, zone.angle)
            for name in ("drop_zones", "supplies")
            if name in model.tables
            for zone in model.tables[name]
        ]
        assert found == [(x, y, 5.0, 0.0) for x, y in zones]
        (robot,) = model.robots
        assert (robot.x, robot.y, robot.delivered) == (0.0, 0.0, 0)
    headings = [model.robots[0].angle for model in models]
    assert -math.pi <= min(headings) < -2 < 2 < max(headings) < math.pi


def test_objects_keep_their_distances(worlds):
    models, _ = worlds
    for model in models:
        (ball,) = model.objects
        assert max(abs(ball.x), abs(ball.y)) <= 60
        assert math.dist((ball.x, ball.y), ZONE) > 50
        field = model.obstacles
        # The circle around a square goes through its corners.
        away = np.hypot(field.x - ball.x, field.y - ball.y) - math.sqrt(2) * field.half_width
        assert away.min() > 3.999
    places = np.array([(model.objects[0].x, model.objects[0].y) for model in models])
    assert places.max() > 50
    assert places.min() < -20


@pytest.mark.parametrize(
    ("ahead", "aside", "gripped"),
    [
        (4.4, 0.0, True),
        (4.6, 0.0, False),
        (2.5, 1.9, True),
        (2.5, -1.9, True),
        (2.5, 2.1, False),
        (4.4, -1.9, True),
        (0.6, 1.95, True),
        (0.4, 1.98, False),
        (-2.5, 0.0, False),
    ],
)
def test_the_claw_grips_in_its_box(ahead, aside, gripped):
    model = empty()
    robot, ball = model.robots[0], model.objects[0]
    angle = robot.angle = 0.7
    ball.x = ahead * math.cos(angle) - aside * math.sin(angle)
    ball.y = ahead * math.sin(angle) + aside * math.cos(angle)
    model.steer("robots", [*STILL, 1.0])
    model.advance(2)
    assert robot.readings[list(WORLD.SENSORS).index("SENSOBJ")] == float(gripped)
    assert robot.carrying == (ball.id if gripped else -1)
    model.advance(1)
    if gripped:
        # Carried, its centre is as far ahead as both radii are long.
        assert ball.x == pytest.approx(robot.x + 2 * math.cos(robot.angle))
        assert ball.y == pytest.approx(robot.y + 2 * math.sin(robot.angle))


def carrying(x, y, angle, **arguments):
    """Return a world whose robot stands somewhere with the object in its claw."""
    model = empty(**arguments)
    robot, ball = model.robots[0], model.objects[0]
    robot.x, robot.y, robot.angle = x, y, angle
    ball.x, ball.y = x + 2.5 * math.cos(angle), y + 2.5 * math.sin(angle)
    model.steer("robots", [*STILL, 1.0])
    model.advance(3)
    assert robot.carrying == ball.id
    return model, robot, ball


@pytest.mark.parametrize("name", ["collect", "collect_retrained", "collect_power"])
def test_letting_go_in_the_drop_zone_delivers(name):
    model, robot, ball = carrying(-41.0, -40.0, 0.0, name=name)
    assert (robot.delivered, robot.score) == (0, 0.0)
    model.steer("robots", [*STILL, 0.0])
    model.advance(1)
    assert (robot.delivered, robot.carrying) == (1, -1)
    assert math.dist((ball.x, ball.y), ZONE) > 50
    assert (ball.vx, ball.vy, ball.lifted) == (0.0, 0.0, False)
    model.advance(5)
    assert (robot.delivered, robot.score) == (1, 1.0)  # once


def test_letting_go_outside_delivers_nothing():
    # The robot is in the zone, the object ahead of it is not: 4 + 2 from the middle.
    model, robot, ball = carrying(-36.0, -40.0, 0.0)
    model.steer("robots", [*STILL, 0.0])
    model.advance(5)
    assert (robot.delivered, robot.score, robot.carrying) == (0, 0.0, -1)
    assert (ball.x, ball.y) == pytest.approx((-34.0, -40.0))


def test_an_object_pushed_into_the_drop_zone_is_not_delivered():
    model = empty()
    ball = model.objects[0]
    ball.x, ball.y = ZONE
    model.steer("robots", [*STILL, 0.5])
    model.advance(3)
    assert in_zone(model.drop_zones[0], ball.x, ball.y)
    assert model.robots[0].delivered == 0


def test_a_collision_ends_the_run_and_touching_the_object_does_not():
    model = empty()
    robot, ball = model.robots[0], model.objects[0]
    robot.angle = 0.0
    ball.x, ball.y = 1.5, 0.0  # overlapping
    model.steer("robots", [*STILL, 0.5])
    model.advance(1)
    assert (robot.contact, robot.collisions, model.over) == (2, 0, None)
    robot.x, robot.y = 69.5, 65.0
    model.advance(1)
    assert (model.over, robot.collisions) == ("collision", 1)
    tick = model.tick
    before = (robot.x, robot.y)
    model.advance(20)
    assert (robot.x, robot.y) == before
    assert model.tick == tick + 20


# Power -------------------------------------------------------------------------------------------


def test_doing_nothing_the_battery_lasts_2000_ticks():
    model = empty("collect_power")
    robot = model.robots[0]
    assert robot.battery == 0.4
    model.advance(1)
    assert robot.battery == pytest.approx(0.3998)
    still = load_model("collect_power")(1, hierarchy=False)
    still.steer("robots", [*STILL, 0.5])
    still.advance(1995)
    assert still.over is None
    still.advance(10)
    assert still.over == "battery"


def test_the_battery_charges_in_the_power_supply_alone():
    model = empty("collect_power", consumption=0.01)
    robot = model.robots[0]
    robot.x, robot.y = SUPPLY
    model.steer("robots", [*STILL, 0.5])
    model.advance(10)
    assert robot.battery == pytest.approx(0.45)
    model.advance(200)
    assert robot.battery == 1.0
    names = list(POWER.SENSORS)
    assert robot.readings[names.index("SENSPW")] == robot.readings[names.index("BATTERY")] == 1.0
    robot.x = SUPPLY[0] + 5.5
    model.advance(10)
    assert robot.battery == pytest.approx(0.9)
    assert robot.readings[names.index("SENSPW")] == 0.0
    assert robot.readings[names.index("RADPW")] != 0.5


# Both speeds -------------------------------------------------------------------------------------


def test_both_speeds_agree_on_a_delivery(differences):
    fast, slow = load_model("collect")(1), load_model("collect")(1, compiled=False)
    while fast.robots[0].delivered == 0 and fast.tick < 4000:
        before = fast.state()
        fast.advance(40)
    assert fast.robots[0].delivered == 1
    slow.restore(before)
    slow.advance(40)
    assert differences(fast, slow) == []
