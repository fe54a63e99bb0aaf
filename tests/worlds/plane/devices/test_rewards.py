"""What rewards give, computed by hand."""

import math

import pytest

from socialmind.worlds.plane.devices.rewards import (
    clear,
    closing,
    collision_cost,
    exploring,
    forward,
    paid,
    reached,
    speed,
    straight,
)


class TestClosing:
    def run(self, stand_in, *steps, gain=0.001):
        """Rewards for steps of (distance, identity of the nearest or None for none)."""
        device = closing("objects", gain)
        memory = [0.0] * device.memory
        return [
            stand_in.call(
                device,
                memory=memory,
                target=stand_in.body(id=identity or 0),
                found=identity is not None,
                distance=distance,
            )
            for distance, identity in steps
        ]

    def test_it_is_the_distance_that_was_covered(self, stand_in):
        assert self.run(stand_in, (10, 0), (8, 0), (9, 0)) == pytest.approx([0, 0.002, -0.001])

    def test_each_unit_is_worth_the_gain(self, stand_in):
        assert self.run(stand_in, (10, 0), (7, 0), gain=0.5) == [0, 1.5]

    def test_coming_and_going_cancel_out(self, stand_in):
        there = [(distance, 3) for distance in (7, 5, 2, 4, 6.5, 7)]
        assert sum(self.run(stand_in, *there)) == pytest.approx(0.0)

    def test_another_nearest_begins_anew(self, stand_in):
        assert self.run(stand_in, (10, 1), (4, 2), (3, 2)) == pytest.approx([0, 0, 0.001])

    def test_nothing_there_is_forgotten(self, stand_in):
        assert self.run(stand_in, (10, 1), (0, None), (5, 1)) == [0, 0, 0]

    def test_an_empty_memory_begins_anew(self, stand_in):
        device = closing("objects")
        given = {"target": stand_in.body(id=0), "distance": 5.0}
        assert stand_in.call(device, memory=[0.0] * 3, **given) == 0.0


@pytest.mark.parametrize(("reading", "reward"), [(0.51, 0.5), (1, 0.5), (0.5, 0), (0, 0)])
def test_reaching_is_a_sensor_above_its_threshold(stand_in, reading, reward):
    device = reached("SENSOBJ", 0.5)
    assert device.sensor == "SENSOBJ"
    assert stand_in.call(device, reading=reading) == reward


@pytest.mark.parametrize(("reading", "reward"), [(0.21, 3.0), (0.2, 0), (0.1, 0)])
def test_the_amount_and_the_threshold_are_told_apart(stand_in, reading, reward):
    assert stand_in.call(reached("S1", 3.0, 0.2), reading=reading) == reward


class TestMotion:
    @pytest.mark.parametrize(
        ("vx", "vy", "angle", "way", "quick"),
        [
            (2, 0, 0, 0.1, 0.4),
            (-2, 0, 0, -1.0, 0),
            (0, 0, 0, 0, 0),
            (0, 3, math.pi / 2, 0.1, 0.9),
            (0, 3, -math.pi / 2, -1.0, 0),
            (3, 3, math.pi / 4, 0.1, 1.8),
        ],
    )
    def test_ways_ahead_and_back(self, stand_in, vx, vy, angle, way, quick):
        robot = stand_in.body(vx=vx, vy=vy, angle=angle)
        assert stand_in.call(forward(0.1), robot=robot) == pytest.approx(way)
        assert stand_in.call(speed(0.1), robot=robot) == pytest.approx(quick)

    def test_sliding_sideways_is_no_speed_ahead(self, stand_in):
        assert stand_in.call(speed(1.0), robot=stand_in.body(vy=3.0)) == 0.0

    def test_a_contact_costs(self, stand_in):
        assert stand_in.call(collision_cost(2.0), robot=stand_in.body(contact=1)) == -2.0
        assert stand_in.call(collision_cost(2.0), robot=stand_in.body()) == 0.0
        # 2 is a contact with another body.
        assert stand_in.call(collision_cost(2.0), robot=stand_in.body(contact=2)) == 0.0


class TestExploring:
    def walk(self, stand_in, *places, cells=4):
        """Rewards for squares of side 10 around (0, 0)."""
        device = exploring(1.0, side=10.0, cells=cells)
        memory = [0.0] * device.memory
        return [
            stand_in.call(device, robot=stand_in.body(*place), memory=memory, restarted=first)
            for first, place in zip([True] + [False] * len(places), places, strict=False)
        ]

    def test_each_square_counts_once_but_the_first(self, stand_in):
        places = [(1, 1), (9, 9), (11, 1), (9, 1), (11, 9), (11, -1), (-1, -1)]
        assert self.walk(stand_in, *places) == [0, 0, 1, 0, 0, 1, 1]

    def test_beyond_the_grid_lies_the_nearest_square(self, stand_in):
        places = [(15, 15), (100, 100), (-15, 15), (-1000, 12), (15, -25), (19, -19)]
        assert self.walk(stand_in, *places) == [0, 0, 1, 0, 1, 0]

    def test_of_an_odd_number_the_middle_one_lies_around_the_middle(self, stand_in):
        places = [(0, 0), (4, -4), (6, 0), (6, 6), (-6, 0)]
        assert self.walk(stand_in, *places, cells=3) == [0, 0, 1, 1, 1]

    def test_there_are_as_many_squares_as_the_memory_holds(self, stand_in):
        places = [(x, y) for x in (-15, -5, 5, 15) for y in (-15, -5, 5, 15)]
        assert sum(self.walk(stand_in, *places, *places)) == len(places) - 1


class TestStraight:
    def run(self, stand_in, *spins, window=4):
        device = straight(1.0, window, fastest=2.0)
        memory = [0.0] * device.memory
        return [
            stand_in.call(device, robot=stand_in.body(spin=spin), memory=memory) for spin in spins
        ]

    def test_turning_at_full_speed_costs_the_gain(self, stand_in):
        assert self.run(stand_in, *[2.0] * 6) == [-0.25, -0.5, -0.75, -1, -1, -1]

    def test_both_ways_cost_alike(self, stand_in):
        assert self.run(stand_in, -1.0, -1.0) == [-0.125, -0.25]

    def test_swinging_costs_nothing_on_the_whole(self, stand_in):
        assert self.run(stand_in, 1.0, -1.0, 1.0, -1.0)[1::2] == [0, 0]

    def test_what_lies_behind_the_window_is_forgotten(self, stand_in):
        assert self.run(stand_in, 2.0, 0, 0, 0, 0) == [-0.25, -0.25, -0.25, -0.25, 0]

    def test_it_never_costs_more_than_the_gain(self, stand_in):
        assert self.run(stand_in, *[9.0] * 4)[-1] == -1.0


def test_keeping_clear_is_the_mean_above_the_threshold(stand_in):
    device = clear(["S1", "S2"], 0.5, gain=2.0)
    assert device.sensors == ("S1", "S2")
    assert stand_in.call(device, readings=[1.0, 0.8]) == pytest.approx(2 * 0.4)
    assert stand_in.call(device, readings=[0.1, 0.3]) == pytest.approx(2 * -0.3)
    near = clear(["S1", "S2"], 0.8, gain=2.0)
    assert stand_in.call(near, readings=[0.9, 1.0]) == pytest.approx(2 * 0.15)


def test_what_was_earned_is_paid_once(stand_in):
    robot = stand_in.body(earned=2.0)
    assert stand_in.call(paid(3.0), robot=robot) == 6.0
    assert stand_in.call(paid(3.0), robot=robot) == 0.0
    assert paid().settles and not collision_cost(1.0).settles
