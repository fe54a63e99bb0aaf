"""What actuators do, computed by hand, and in a world."""

import math

import numpy as np
import pytest

from socialmind import Model, Population, each
from socialmind.worlds.plane import BALL, Body, Disc, Plane, Robot, claw, emitter, in_claw, wheel


class TestWheel:
    @pytest.mark.parametrize(("command", "force"), [(1.0, 80.0), (0.5, 0.0), (0.0, -80.0)])
    def test_the_command_is_a_share_of_the_force(self, stand_in, command, force):
        robot = stand_in.body()
        stand_in.call(wheel(at=(0.0, 0.0)), robot=robot, command=command)
        assert (robot.push_x, robot.push_y, robot.torque) == (force, 0.0, 0.0)

    def test_it_pushes_along_the_robot_and_turns_it_away_from_its_side(self, stand_in):
        robot = stand_in.body(angle=math.pi / 2)
        stand_in.call(wheel(at=(0.0, 2.0), force=3.0), robot=robot, command=1.0)
        assert (robot.push_x, robot.push_y) == pytest.approx((0.0, 3.0))
        assert robot.torque == -6.0  # a left wheel turns it clockwise

    def test_two_wheels_add_up(self, stand_in):
        robot = stand_in.body()
        stand_in.call(wheel(at=(0.0, 1.0)), robot=robot, command=1.0)
        stand_in.call(wheel(at=(0.0, -1.0)), robot=robot, command=0.75)
        assert (robot.push_x, robot.torque) == (120.0, -40.0)


class TestClaw:
    def pair(self, stand_in, *objects):
        robot = stand_in.body(id=4)
        members = stand_in.members(*objects)

        def told(before, command):
            given = {"robot": robot, "members": members, "before": before, "command": command}
            stand_in.call(claw("objects"), **given, kind=1, slot=2)
            return robot.closed, robot.carrying

        return told

    def test_it_grips_when_the_command_rises_above_a_half(self, stand_in):
        ball = stand_in.body(3, 0, id=9)
        told = self.pair(stand_in, ball)
        assert told(0.5, 0.5) == (False, -1)
        assert told(0.5, 0.51) == (True, 9)
        assert (ball.carrier_kind, ball.carrier) == (1, 2)

    def test_it_holds_at_a_half_and_opens_below(self, stand_in):
        ball = stand_in.body(3, 0, id=9)
        told = self.pair(stand_in, ball)
        told(0.0, 1.0)
        assert told(1.0, 0.5) == (True, 9)
        assert told(0.5, 0.5) == (True, 9)
        assert told(0.5, 0.49) == (False, -1)
        assert (ball.carrier_kind, ball.carrier) == (-1, -1)

    def test_a_claw_that_closed_on_nothing_grips_when_the_command_rises_again(self, stand_in):
        ball = stand_in.body(30, 0, id=9)
        told = self.pair(stand_in, ball)
        assert told(0.5, 1.0) == (True, -1)
        ball.x = 3.0
        assert told(1.0, 1.0) == (True, -1)
        assert told(1.0, 0.5) == (True, -1)
        assert told(0.5, 1.0) == (True, 9)

    def test_it_takes_the_nearest_to_the_middle_of_the_box_that_nobody_carries(self, stand_in):
        held = stand_in.body(2.5, 0, id=1, carrier_kind=1, carrier=0)
        far, near = stand_in.body(4.4, 0, id=2), stand_in.body(2.5, 1.5, id=3)
        outside = stand_in.body(2.5, 2.1, id=5)
        assert self.pair(stand_in, held, far, outside, near)(0.5, 1.0) == (True, 3)
        assert (held.carrier_kind, held.carrier) == (1, 0)

    def test_a_full_claw_takes_nothing_more(self, stand_in):
        first, second = stand_in.body(3, 0, id=1), stand_in.body(2, 1, id=2)
        told = self.pair(stand_in, first, second)
        assert told(0.5, 1.0) == (True, 1)
        told(1.0, 0.5)
        assert told(0.5, 1.0) == (True, 1)
        assert second.carrier == -1

    def test_opening_leaves_alone_what_others_carry(self, stand_in):
        other = stand_in.body(3, 0, id=1, carrier_kind=1, carrier=3)
        self.pair(stand_in, other)(1.0, 0.0)
        assert other.carrier == 3


def test_an_emitter_writes_its_channel(stand_in):
    robot = stand_in.body()
    stand_in.call(emitter(1), robot=robot, command=0.7)
    assert robot.signal == [0.0, 0.7]


# In a world ------------------------------------------------------------------------------------


def ahead(ball):
    ball.x = 4


def steer(robot, model):
    """Stand and close the claw, back off with the object, open the claw."""
    robot.commands[0] = 0.5
    robot.commands[1] = 0.5
    robot.commands[2] = 0.5
    if model.tick == 1:
        robot.commands[2] = 1
    elif 10 <= model.tick < 60:
        robot.commands[0] = 0.25
        robot.commands[1] = 0.25
    elif model.tick == 80:
        robot.commands[2] = 0


class Carrying(Model):
    """A robot with two wheels and a claw, and an object in front of it."""

    ticks = 100
    world = Plane(0.0)
    objects = Population(Body, 1, body=BALL)
    robots = Population(
        Robot,
        1,
        body=Disc(meets=("objects",)),
        sensors={"SENSOBJ": in_claw("objects")},
        actuators={
            "MotL": wheel(at=(0.0, 1.0)),
            "MotR": wheel(at=(0.0, -1.0)),
            "EMAG": claw("objects"),
        },
    )
    setup = (each(objects, ahead),)
    schedule = (each(robots, steer),)


@pytest.mark.parametrize("compiled", [True, False])
def test_an_object_is_gripped_carried_and_let_go(compiled):
    model = Carrying(seed=1, compiled=compiled)
    robot, ball = model.tables["robots"], model.tables["objects"]
    model.advance(2)
    assert robot.rows["carrying"][0] == -1
    assert robot.rows["readings"][0, 0] == 1.0
    model.advance(58)
    assert robot.rows["carrying"][0] == ball.rows["_id"][0]
    assert robot.rows["x"][0] < -2.0
    assert ball.rows["x"][0] == pytest.approx(robot.rows["x"][0] + 2.0)
    assert robot.rows["readings"][0, 0] == 1.0
    model.advance(40)
    assert (robot.rows["closed"][0], ball.rows["carrier"][0]) == (False, -1)


def circle(robot):
    robot.commands[0] = 1
    robot.commands[1] = 0


class Turning(Carrying):
    """A robot whose wheels push against each other."""

    schedule = (each(Carrying.robots, circle),)


def test_the_left_wheel_ahead_turns_to_the_right_at_2_5_radians_a_second():
    model = Turning(seed=1)
    model.advance(100)
    spin = model.tables["robots"].rows["spin"][0]
    # Torque 160, moment π, 1/30 s a tick, damping 20: s = (s + 160 / (30 π)) / (1 + 20 / 30).
    assert spin == pytest.approx(-160 / 30 / math.pi / (20 / 30), abs=1e-9)
    assert np.hypot(*(model.tables["robots"].rows[one][0] for one in ("vx", "vy"))) < 1e-9
