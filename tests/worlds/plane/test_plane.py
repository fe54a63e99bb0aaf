"""Declarations of planes: what is refused, with file, line and what to do."""

import re
from dataclasses import replace

import pytest

from socialmind import Agent, Model, ModelError, Population
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Interruption,
    Obstacle,
    Plane,
    RangeFinder,
    Reward,
    Robot,
    Sense,
    Zone,
    clear,
    collision,
    orientation,
    paid,
    reached,
    wheel,
)
from socialmind.worlds.plane.shape import memory_field


class Chosen(Robot):
    readings: int = 0


def robots(**changes):
    given = {"agent": Robot, "size": 1, "body": Disc(), "sensors": {"S1": RangeFinder()}}
    return Population(**{**given, **changes})


WRONG = {
    "a body without a disc": (
        {"balls": Population(Body, 1)},
        "the population 'balls' of Body without a body; write Population(…, body=Disc())",
    ),
    "a disc without a body": (
        {"zones": Population(Zone, 1, body=BALL)},
        "the population 'zones' of Zone, which does not move, with a body",
    ),
    "a meeting with nobody": (
        {"robots": robots(body=Disc(meets=("bals",))), "balls": Population(Body, 1, body=BALL)},
        "found 'bals' among what 'robots' collides with; expected the name of a population of "
        "bodies; did you mean 'balls'?",
    ),
    "two populations of obstacles": (
        {"stones": Population(Obstacle, 1), "trees": Population(Obstacle, 1)},
        "found 2 populations of obstacles: stones, trees; expected one at most",
    ),
    "sensors of what is no robot": (
        {"balls": Population(Body, 1, body=BALL, sensors={"S1": RangeFinder()})},
        "found sensors or actuators of 'balls', whose class is Body; expected a class that "
        "inherits from Robot",
    ),
    "a search for nobody": (
        {"robots": robots(sensors={"RAD": orientation("robotts")})},
        "found 'RAD', which looks for 'robotts'; expected the name of a population; "
        "did you mean 'robots'?",
    ),
    "a reading of no sensor": (
        {"robots": robots(), "rewards": {"near": reached("S2", 1.0)}},
        "found 'near', which reads the sensor 'S2'; expected a sensor of 'robots'",
    ),
    "readings that are apart": (
        {
            "robots": robots(sensors={"A": RangeFinder(), "B": RangeFinder(), "C": RangeFinder()}),
            "rewards": {"clear": clear(("A", "C"))},
        },
        "found 'clear', which reads A, C; expected sensors that stand next to each other",
    ),
    "rewards without robots": (
        {"rewards": {"paid": paid()}},
        "found 'paid' in a model without robots; expected a population of robots",
    ),
    "an interruption of no robots": (
        {"robots": robots(), "interruptions": {"hit": replace(collision(), robots="robot")}},
        "found 'hit', which is for 'robot'; expected a population of robots",
    ),
    "a reward that is none": (
        {"robots": robots(), "rewards": {"hit": collision()}},
        "as 'hit'; expected one of the rewards of socialmind",
    ),
    "a field that robots have": (
        {"robots": robots(agent=Chosen)},
        "found a field called 'readings' of Chosen; expected a name that robots do not use",
    ),
    "a half-width that is no parameter": (
        {"world": Plane("size")},
        "found the half-width 'size'; expected a number or the name of a parameter of numbers",
    ),
    "a half-width below 0": (
        {"world": Plane(-1.0)},
        "found half_width=-1.0 of a plane; expected a number, 0 or more",
    ),
    "a half-width that is no number": (
        {"world": Plane(None)},
        "found half_width=None of a plane; expected a number, 0 or more",
    ),
    "ticks of no time": (
        {"world": Plane(10.0, dt=0)},
        "found dt=0 of a plane; expected seconds, above 0 and below 1",
    ),
    "bodies without a plane": (
        {"world": None, "balls": Population(Body, 1, body=BALL)},
        "found bodies of 'balls' without a plane; expected world = Plane(…)",
    ),
    "rewards without a plane": (
        {"world": None, "rewards": {"paid": paid()}},
        "rewards without a plane; write world = Plane(…)",
    ),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_refused(what):
    attributes, message = WRONG[what]
    declared = {"world": Plane(20.0), **attributes}
    if declared["world"] is None:
        del declared["world"]
    with pytest.raises(ModelError, match=re.escape(message)):
        type("Wrong", (Model,), declared)


FILE = """
from socialmind import Model, Population
from socialmind.worlds.plane import Disc, Plane, Robot, orientation, paid


class Wrong(Model):
    world = Plane(20.0)
    robots = Population(Robot, 1, body=Disc(), sensors={SENSORS})
    rewards = {"paid": paid(), REWARDS}
"""


@pytest.mark.parametrize(
    ("sensors", "rewards", "line"),
    [
        ("'RAD': orientation('balls')", "", 8),
        ("", "'near': __import__('socialmind.worlds.plane').worlds.plane.closing('balls')", 9),
    ],
)
def test_it_is_said_where(sensors, rewards, line, tmp_path):
    from socialmind.catalogue import load_model

    text = FILE.replace("SENSORS", sensors).replace("REWARDS", rewards)
    (tmp_path / "model.py").write_text(text)
    with pytest.raises(ModelError) as caught:
        load_model(str(tmp_path))
    assert (caught.value.file, caught.value.line) == (str(tmp_path / "model.py"), line)


def test_a_mind_needs_the_sensors_that_its_skills_read():
    from socialmind.mind import MindDescription, Perceptron, Skill

    blind = Skill("Go", ["SE:S2"], ["MO:MotL"], Perceptron(layers=0), [0.0, 0.5])
    mind = MindDescription("walker", ["S2", "S9"], ["MotL"], skills=[blind])
    wheels = {"MotL": wheel((0.0, 1.0))}

    class Walk(Model):
        world = Plane(20.0)
        robots = Population(
            Robot, 1, body=Disc(), sensors={"S1": RangeFinder()}, actuators=wheels, hierarchy=mind
        )

    message = "the sensor 'S2' of the mind 'walker', which the bodies of 'robots' do not have"
    with pytest.raises(ModelError, match=message):
        Walk()


def test_rewards_are_for_the_first_robots_that_sense_unless_they_say_otherwise():
    def always(robot):
        return True

    class Teams(Model):
        world = Plane(20.0)
        drones = Population(Robot, 1, body=Disc())
        seers = Population(Robot, 1, body=Disc(), sensors={"S1": RangeFinder()})
        rewards = {"paid": paid(), "other": replace(paid(), robots="drones")}  # noqa: RUF012
        interruptions = {"always": Interruption(always)}  # noqa: RUF012

    teams = Teams.shape.world.robots
    assert list(teams["seers"].rewards) == ["paid"]
    assert list(teams["drones"].rewards) == ["other"]
    assert list(teams["seers"].interruptions) == ["always"]


def test_no_two_devices_remember_in_one_field():
    names = ("a b", "a_b", "a-b", "a__b", "a_20_b", "é", "e", "A B")
    fields = {memory_field("rewards", name) for name in names}
    assert len(fields) == len(names)
    assert all(field.isidentifier() and field.isascii() for field in fields)


def first(memory):
    memory[0] += 1.0
    return memory[0]


def second(memory):
    memory[1] += 10.0
    return memory[1]


def test_devices_of_like_names_remember_apart():
    class Counting(Model):
        world = Plane(20.0)
        robots = Population(
            Robot, 1, body=Disc(), sensors={"a b": Sense(first, memory=1), "S": RangeFinder()}
        )
        rewards = {"r 1": Reward(first, memory=1), "r_1": Reward(second, memory=2)}  # noqa: RUF012

    for compiled in (True, False):
        model = Counting(compiled=compiled)
        model.advance(3)
        assert model.robots.score.tolist() == [6.0 + 60.0]


def test_an_agent_without_a_body_may_live_on_a_plane():
    class Judge(Agent):
        seen: int = 0

    class Watched(Model):
        world = Plane(20.0)
        judges = Population(Judge, 2)

    model = Watched()
    model.advance(2)
    assert model.tick == 2 and len(model.judges) == 2 and model.over is None
