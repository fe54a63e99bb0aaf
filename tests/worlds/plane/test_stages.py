"""The plan of a tick: what is looked up, with what numbers, and what the obstacles need."""

import re
from pathlib import Path

import pytest

from socialmind import Model, ModelError, Population, each, parameter
from socialmind.sources.loading import load_file
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Obstacle,
    Plane,
    RangeFinder,
    Robot,
    Sense,
    Zone,
    active,
    claw,
    distance_to,
    in_claw,
    orientation,
)
from socialmind.worlds.plane.scene import scene_of
from socialmind.worlds.plane.ticks.stages import PLACED, STAGES

MENAGERIE = load_file(Path(__file__).parent / "menagerie" / "model.py").Menagerie


def bright(distance, wide):
    return distance / wide


class Seeing(Model):
    world = Plane(20.0)
    zones = Population(Zone, 1)
    balls = Population(Body, 2, body=BALL)
    robots = Population(
        Robot,
        2,
        body=Disc(),
        sensors={
            "ray": RangeFinder(),
            "where": orientation("balls"),
            "there": orientation("balls"),
            "near": distance_to("balls", reach=5.0),
            "ahead": Sense(bright, of="balls", at=(1.0, 2.0), settings={"wide": 8.0}),
            "zone": orientation("zones"),
            "mate": orientation("robots"),
            "grip": in_claw("balls"),
        },
        actuators={"claw": claw("balls")},
    )


def planned(model):
    return model.typed().world


def test_devices_that_look_from_one_place_share_the_look():
    stage = planned(Seeing).stages["robots"]["sensors"]
    assert [(seek.of, seek.same, seek.carried) for seek in stage.seeks] == [
        ("balls", False, True),
        ("balls", False, True),
        ("balls", False, True),
        ("zones", False, False),
        ("robots", True, True),
    ]
    assert [call.seek for call in stage.calls] == [0, 0, 1, 2, 3, 4, None]


def test_a_range_finder_is_no_call_and_keeps_its_place():
    calls = planned(Seeing).stages["robots"]["sensors"].calls
    assert [call.number for call in calls] == [1, 2, 3, 4, 5, 6, 7]


def test_the_numbers_of_a_device_stand_behind_its_place():
    plan = planned(Seeing)
    (call,) = [c for c in plan.stages["robots"]["sensors"].calls if c.name == "ahead"]
    found = plan.settings[call.settings : call.settings + PLACED + 1].tolist()
    assert found == [1.0, 2.0, 0.0, float("inf"), 8.0]


def put(ball):
    ball.x = 4.0


class Sighted(Model):
    """A robot at 0 with a ball at 4; how far it sees is a parameter."""

    sight: float = parameter(5.0)
    largest: int = parameter(8)
    world = Plane(20.0)
    balls = Population(Body, 1, body=BALL)
    robots = Population(
        Robot,
        1,
        body=Disc(),
        sensors={
            "near": distance_to("balls", reach="sight"),
            "there": active("balls", reach="sight"),
            "far": active("balls", reach=5.0),
            "share": Sense(bright, of="balls", settings={"wide": "largest"}),
        },
    )
    setup = (each(balls, put),)


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(
    ("given", "readings"),
    [
        ({}, [0.8, 1.0, 1.0, 0.5]),
        ({"sight": 3.0}, [1.0, 0.0, 1.0, 0.5]),
        ({"sight": 0.0, "largest": 16}, [1.0, 0.0, 1.0, 0.25]),
    ],
)
def test_parameters_of_the_model_can_be_numbers_of_devices(compiled, given, readings):
    model = Sighted(compiled=compiled, **given)
    model.advance(1)
    assert model.tables["robots"].rows["readings"][0].tolist() == pytest.approx(readings)


def test_a_line_is_drawn_to_what_is_within_such_a_reach():
    class Aiming(Sighted):
        robots = Population(
            Robot, 1, body=Disc(), sensors={"where": orientation("balls", reach="sight")}
        )

    assert [len(scene_of(Aiming(sight=one)).robots[0].lines) for one in (3.0, 5.0)] == [0, 1]


def test_parameters_that_do_not_fit_are_refused():
    class Blind(Sighted):
        robots = Population(
            Robot, 1, body=Disc(), sensors={"near": distance_to("balls", reach="sigth")}
        )

    with pytest.raises(ModelError, match=r"reach='sigth' of the sensor 'near'.*mean 'sight'"):
        Blind()

    class Faint(Sighted):
        robots = Population(
            Robot,
            1,
            body=Disc(),
            sensors={"share": Sense(bright, of="balls", settings={"wide": "much"})},
        )

    with pytest.raises(ModelError, match=r"wide='much' of the sensor 'share'.*there is sight, la"):
        Faint()
    with pytest.raises(ModelError, match=r"sight=-1 as the reach of the sensor 'near' of 'robots'"):
        Sighted(sight=-1.0)


def test_every_device_draws_from_a_stream_of_its_own():
    plan = planned(MENAGERIE)
    tags = [
        call.tag for stages in plan.stages.values() for one in stages.values() for call in one.calls
    ]
    assert len(set(tags)) == len(tags) > 10
    assert all(list(stages) == list(STAGES) for stages in plan.stages.values())


def test_an_error_names_the_sensor_and_the_population():
    def wrong(robot):
        return robot.colour

    sensors = {"COLOUR": Sense(wrong)}
    attributes = {
        "world": Plane(20.0),
        "robots": Population(Robot, 1, body=Disc(), sensors=sensors),
    }
    with pytest.raises(ModelError, match=re.escape("in the sensor 'COLOUR' of 'robots'")) as caught:
        type("Wrong", (Model,), attributes)()
    assert caught.value.file == __file__
    assert caught.value.line == wrong.__code__.co_firstlineno + 1


def still(stone, model):
    model.seen += stone.x


def pushed(stone):
    shift(stone, 1.0)


def shift(stone, far):
    stone.x += far


def fall(stone):
    stone.die()


def sprout(stone):
    stone.hatch()


def watch(robot, model):
    for stone in model.stones:
        robot.x += stone.x


def heave(robot, model):
    for stone in model.stones:
        stone.angle += robot.x


@pytest.mark.parametrize(
    ("population", "rule", "shifting"),
    [
        ("stones", still, False),
        ("stones", pushed, True),
        ("stones", fall, True),
        ("stones", sprout, True),
        ("robots", watch, False),
        ("robots", heave, True),
    ],
)
def test_obstacles_are_looked_at_anew_where_something_changes_them(population, rule, shifting):
    stones = Population(Obstacle, 1)
    robots = Population(Robot, 1, body=Disc())
    given = {"stones": stones, "robots": robots}
    attributes = {
        "__annotations__": {"seen": float},
        "seen": 0.0,
        "world": Plane(20.0),
        **given,
        # What the setup does counts for nothing: the engines look after it anyway.
        "setup": (each(stones, pushed),),
        "schedule": (each(given[population], rule),),
    }
    model = type("Standing", (Model,), attributes)
    assert planned(model).shifting is shifting
    assert planned(MENAGERIE).shifting
