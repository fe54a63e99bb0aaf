"""Conditions and chances where hierarchies weigh plans, on planes and in worlds side by side."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import Model, Population, each, parameter
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.sources.loading import load_file
from socialmind.worlds.plane import Disc, Plane, RangeFinder, Reward, Robot, wheel

GRAZING = load_file(Path(__file__).parents[2] / "learning" / "grazing.py")


def with_conditions(scheme):
    """Let the second cogniton come and go with the tick's grass, as its cows see it."""
    changed = {
        "Fatigue": {"active_while": "x > 0"},
        "Hunger": {"deactivated_when": "y > 9", "activated_when": "y < 9"},
    }
    cognitons = tuple(replace(one, **changed.get(one.name, {})) for one in scheme.cognitons)
    return replace(scheme, cognitons=cognitons)


def test_a_hierarchy_weighs_what_is_active_as_the_links_do():
    scheme = with_conditions(GRAZING.SCHEME)
    kinds = (GRAZING.Grazing, GRAZING.Weighed)
    societies = [kind(seed=3, compiled=c, scheme=scheme) for kind in kinds for c in (True, False)]
    known = []
    for society in societies:
        for _ in range(30):
            society.cows.x = np.sin(np.arange(len(society.cows)) + society.tick)
            society.cows.y = 10 * np.cos(np.arange(len(society.cows)) + society.tick)
            society.advance(1)
            known.append((society.plans(society.cows), society.cows.cogniton("Fatigue").tolist()))
    courses = [str(known[place : place + 30]) for place in range(0, 120, 30)]
    assert courses == [courses[0]] * 4
    assert "nan" in courses[0] and "rest" in courses[0]


MIND = MindDescription(
    "goer", ["S"], ["L", "R"],
    skills=[Skill("Go", ["SE:S"], ["MO:L", "MO:R"], Perceptron(layers=0), [0.3, 0.6, 0, 1.0])],
)  # fmt: skip
SCHEME = CognitiveScheme(
    "robots",
    (
        Cogniton("Tall", start_value=1, influence={"a": 1}, conditional=("a",), chance=0.5),
        Cogniton("Near", starting=False, start_value=2, influence={"b": 1}, conditional=("b",),
                 activated_when="clearance < near", deactivated_when="clearance > 6"),
    ),
)  # fmt: skip


class Walker(Robot):
    clearance: float = 9.0
    chosen: float = 0.0


def choose(walker):
    walker.clearance = 5.0 - walker.x
    walker.plan = walker.mind.choose_next_plan()
    if walker.plan == "a":
        walker.chosen += 1.0
    if walker.plan == "b":
        walker.chosen += 100.0


def chosen(robot):
    return robot.chosen


class Runway(Model):
    ticks = 40
    near: float = parameter(4.0)
    world = Plane(20.0)
    robots = Population(
        Walker, 6, body=Disc(), sensors={"S": RangeFinder()}, mind=SCHEME,
        actuators={"L": wheel((0.0, 1.0)), "R": wheel((0.0, -1.0))}, hierarchy=MIND,
    )  # fmt: skip
    schedule = (each(robots, choose),)
    rewards = {"chosen": Reward(chosen)}  # noqa: RUF012


def test_worlds_side_by_side_are_as_each_alone():
    seeds = (3, 0, 2**40 + 1)
    found = Episodes(Runway, lanes=2, record=("chosen",)).run(None, seeds)
    sums = []
    for number, seed in enumerate(seeds):
        for compiled in (True, False):
            alone = Runway(seed=seed, compiled=compiled)
            sums.append(np.isnan(alone.robots.cogniton("Tall")).sum())
            alone.advance(40)
            assert found.fields["chosen"][0, number].tolist() == alone.robots.chosen.tolist()
    assert len(set(sums)) > 1 and found.fields["chosen"].max() >= 100
