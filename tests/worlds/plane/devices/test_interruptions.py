"""When interruptions end an episode."""

from types import SimpleNamespace

import pytest

from socialmind import Model, Population, each
from socialmind.worlds.plane import (
    Disc,
    Plane,
    Robot,
    after,
    battery,
    collision,
    flat_battery,
    over_threshold,
    under_threshold,
)


def test_a_collision_is_a_contact(stand_in):
    assert stand_in.call(collision(), robot=stand_in.body(contact=1)) is True
    assert stand_in.call(collision(), robot=stand_in.body()) is False
    # 2 is a contact with another body.
    assert stand_in.call(collision(), robot=stand_in.body(contact=2)) is False


@pytest.mark.parametrize(("charge", "flat"), [(0.0, True), (-0.001, True), (1e-9, False)])
def test_a_battery_is_flat_at_nothing(stand_in, charge, flat):
    assert stand_in.call(flat_battery(), robot=stand_in.body(battery=charge)) is flat


@pytest.mark.parametrize(
    ("reading", "over", "under"), [(0.2, False, True), (0.3, False, False), (0.4, True, False)]
)
def test_thresholds_are_crossed_not_met(stand_in, reading, over, under):
    assert stand_in.call(over_threshold("S1", 0.3), reading=reading) is over
    assert stand_in.call(under_threshold("S1", 0.3), reading=reading) is under


def test_so_many_ticks_are_run_and_no_more(stand_in):
    ended = [stand_in.call(after(3), model=SimpleNamespace(tick=tick)) for tick in range(4)]
    assert ended == [False, False, True, True]


def drain(robot):
    robot.battery -= 0.25


class Ending(Model):
    """A robot whose battery is flat after four ticks."""

    ticks = 50
    world = Plane(10.0)
    robots = Population(Robot, 1, body=Disc(), sensors={"battery": battery()})
    interruptions = {"late": after(30), "flat": flat_battery()}  # noqa: RUF012
    schedule = (each(robots, drain),)


@pytest.mark.parametrize("compiled", [True, False])
def test_the_first_interruption_ends_the_episode_and_is_named(compiled):
    model = Ending(seed=1, compiled=compiled)
    model.advance(4)
    assert model.over is None
    model.advance(1)
    assert model.over == "flat"
    model.advance(10)
    assert model.tables["robots"].rows["battery"][0] == 0.0
