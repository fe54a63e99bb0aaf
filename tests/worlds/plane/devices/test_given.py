"""What devices, bodies and measures are made with is refused with the line that made them."""

from pathlib import Path

import pytest

from socialmind import Model, ModelError, Population
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import (
    Disc,
    Measure,
    Plane,
    RangeFinder,
    Robot,
    after,
    clear,
    constant,
    emitter,
    exploring,
    orientation,
    straight,
    wheel,
)
from socialmind.worlds.plane.devices.sensors import identity, moved, noise, payoff, signal_distance


class Lamp(Robot):
    """A robot that emits signals on one channel."""

    signal: list[float] = [0.0]  # noqa: RUF012


def emitting(robot, channel, **sensors):
    """Run a model whose robots emit signals."""
    parts = {"sensors": {"S": constant(0.5), **sensors}, "actuators": {"E": emitter(channel)}}
    robots = Population(robot, 1, body=Disc(), **parts)
    made = type("Emitting", (Model,), {"world": Plane(20.0), "robots": robots})
    made(compiled=False).advance(2)


WRONG = [
    (lambda: noise(0), "every=0 of noise"),
    (lambda: noise(1.5), "every=1.5 of noise"),
    (lambda: straight(0.1, window=0), "window=0 of straight"),
    (lambda: straight(0.1, fastest=0.0), "fastest=0.0 of straight"),
    (lambda: exploring(1.0, cells=0), "cells=0 of exploring"),
    (lambda: moved(1), "positions=1 of moved"),
    (lambda: moved(every=0), "every=0 of moved"),
    (lambda: payoff(0.0), "scale=0.0 of payoff"),
    (lambda: identity(0), "robots=0 of identity"),
    (lambda: after(0), "ticks=0 of after"),
    (lambda: clear(sensors="S1"), "the text 'S1' as sensors|sensors='S1'"),
    (lambda: Disc(meets="balls"), "meets"),
    (lambda: Disc(radius=0.0), "radius=0.0"),
    (lambda: Disc(density=1e300), "density=1e.300"),
    (lambda: Disc(restitution=float("nan")), "restitution=nan"),
    (lambda: RangeFinder(reach=None), "reach=None"),
    (lambda: RangeFinder(at=3), "at=3"),
    (lambda: wheel(3), "at=3"),
    (lambda: orientation("balls", reach=None), "reach=None"),
    (lambda: Measure(len, "ticks"), "takes"),
    (lambda: MindDescription("m", "S1", ["W"]), "sensors"),
    (lambda: Skill("Go", "SE:S", ["MO:W"], Perceptron(layers=0)), "inputs"),
    (lambda: emitting(Robot, 0), "without a field for signals in the class of 'robots'"),
    (lambda: emitting(Lamp, 3), "channel 3 of the actuator 'E'"),
    (lambda: emitting(Lamp, 0, H=signal_distance("robots", channel=1)), "channel 1 of the sensor"),
]


@pytest.mark.parametrize(("make", "message"), WRONG)
def test_the_line_of_the_modeller_is_named(make, message):
    with pytest.raises(ModelError, match=message) as caught:
        make()
    assert caught.value.file is not None
    assert Path(caught.value.file).name == Path(__file__).name
    assert caught.value.line > 0


def test_what_fits_is_taken():
    assert noise("period").settings["every"] == "period"
    assert clear(sensors=["S1"]).sensors == ("S1",)
    emitting(Lamp, 0, H=signal_distance("robots"))


def test_one_name_is_no_sequence_of_letters():
    world = type("Empty", (Model,), {"world": Plane(20.0)})
    with pytest.raises(ModelError, match="record"):
        Episodes(world, record="caught")
