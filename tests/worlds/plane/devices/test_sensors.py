"""What sensors read, computed by hand."""

import math
import random

import pytest

from socialmind import ModelError
from socialmind.worlds.plane.devices.sensors import (
    RangeFinder,
    active,
    battery,
    carrying,
    constant,
    distance_to,
    identity,
    in_claw,
    inside,
    moved,
    noise,
    orientation,
    payoff,
    signal_active,
    signal_distance,
    signal_orientation,
)


class TestRangeFinder:
    def test_it_sits_on_the_rim_at_its_angle(self):
        lines = RangeFinder(math.pi / 2).lines(radius=2.0, sensor=4)
        assert lines["x"] == pytest.approx([0.0] * 3)
        assert lines["y"] == pytest.approx([2.0] * 3)
        assert lines["sensor"].tolist() == [4] * 3
        assert lines["reach"].tolist() == [12.0] * 3

    def test_it_sits_where_it_is_put(self):
        lines = RangeFinder(1.0, at=(0.5, -0.25)).lines(radius=2.0, sensor=0)
        assert lines["x"].tolist() == [0.5] * 3
        assert lines["y"].tolist() == [-0.25] * 3

    def test_its_rays_reach_as_far_as_it_does(self):
        assert RangeFinder(reach=7.5).lines(radius=1.0, sensor=0)["reach"].tolist() == [7.5] * 3

    def test_three_rays_look_ahead_and_to_the_edges_of_the_cone(self):
        lines = RangeFinder(math.radians(30)).lines(radius=1.0, sensor=0)
        degrees = [math.degrees(math.atan2(one["sin"], one["cos"])) for one in lines]
        assert degrees == pytest.approx([24.0, 30.0, 36.0])

    def test_other_numbers_of_rays_are_spread_alike(self):
        assert RangeFinder(0.5, rays=1).directions == (0.5,)
        assert RangeFinder(0.0, half_angle=0.2, rays=5).directions == pytest.approx(
            (-0.2, -0.1, 0.0, 0.1, 0.2)
        )

    @pytest.mark.parametrize(
        "wrong",
        [
            {"angle": math.inf},
            {"reach": 0},
            {"reach": math.inf},
            {"half_angle": -0.1},
            {"half_angle": 3.2},
            {"rays": 0},
            {"rays": 2.5},
            {"rays": True},
        ],
    )
    def test_numbers_out_of_range_are_refused(self, wrong):
        (name, value), *_ = wrong.items()
        with pytest.raises(ModelError, match=f"{name}={value}"):
            RangeFinder(**wrong)


class TestWhatIsSeen:
    @pytest.mark.parametrize(
        ("x", "y", "reading"),
        [
            (3, 0, 0.5),
            (0, 3, 0.25),  # to the left
            (0, -3, 0.75),
            (2, 2, 0.375),
            (-3, 1e-13, 0.0),
            (-3, -1e-13, 1.0),
        ],
    )
    def test_orientation(self, stand_in, x, y, reading):
        given = {"robot": stand_in.body(), "target": stand_in.body(x, y)}
        assert stand_in.call(orientation("objects"), **given) == pytest.approx(reading)

    def test_orientation_turns_with_the_robot(self, stand_in):
        given = {"robot": stand_in.body(1, 1, angle=math.pi / 2), "target": stand_in.body(1, 5)}
        assert stand_in.call(orientation("objects"), **given) == pytest.approx(0.5)

    def test_orientation_of_nothing_is_ahead(self, stand_in):
        assert stand_in.call(orientation("objects"), found=False, bearing=0.0) == 0.5

    @pytest.mark.parametrize(("distance", "reading"), [(0, 0), (25, 0.25), (100, 1), (150, 1)])
    def test_distance(self, stand_in, distance, reading):
        assert stand_in.call(distance_to("objects"), distance=distance) == reading

    def test_distance_of_nothing_is_the_largest(self, stand_in):
        assert stand_in.call(distance_to("objects", 20.0), found=False, distance=20.0) == 1.0
        assert stand_in.call(distance_to("objects", 20.0), found=False, distance=5.0) == 1.0

    def test_distances_are_shares_of_the_reach(self, stand_in):
        assert stand_in.call(distance_to("objects", 20.0), distance=5.0) == 0.25
        assert stand_in.call(distance_to("objects"), distance=0.0, largest=0.0) == 1.0

    def test_they_look_no_farther_than_their_reach(self):
        assert distance_to("objects", 20.0).reach == orientation("objects", 20.0).reach == 20.0

    @pytest.mark.parametrize(("found", "reading"), [(True, 0.8), (False, 0.2)])
    def test_active_reads_what_it_is_told_to(self, stand_in, found, reading):
        device = active("objects", 30.0, low=0.2, high=0.8)
        assert (device.reach, stand_in.call(device, found=found)) == (30.0, reading)


class TestInClaw:
    @pytest.mark.parametrize(
        ("x", "y", "reading"),
        [(2.5, 0, 1), (4.5, 2, 1), (0.5, -2, 1), (4.6, 0, 0), (0.4, 0, 0), (2.5, 2.1, 0)],
    )
    def test_the_box_is_4_by_4_around_2_5_ahead(self, stand_in, x, y, reading):
        given = {"robot": stand_in.body(), "members": stand_in.members(stand_in.body(x, y))}
        assert stand_in.call(in_claw("objects"), **given) == reading

    def test_the_box_turns_with_the_robot(self, stand_in):
        robot = stand_in.body(10, 10, angle=math.pi / 2)
        for x, y, reading in ((10, 12.5, 1), (12.5, 10, 0), (8.1, 14.4, 1)):
            members = stand_in.members(stand_in.body(x, y))
            assert stand_in.call(in_claw("objects"), robot=robot, members=members) == reading

    def test_one_of_several_suffices(self, stand_in):
        # The one outside, 2.1 aside, is nearer to the middle than the one in the corner.
        members = stand_in.members(stand_in.body(2.5, 2.1), stand_in.body(4.5, 2.0))
        assert stand_in.call(in_claw("objects"), robot=stand_in.body(), members=members) == 1.0

    @pytest.mark.parametrize(
        ("along", "aside", "reading"),
        [(4.49, 1.99, 1), (4.49, -1.99, 1), (0.51, -1.99, 1), (2.5, 2.01, 0), (4.51, -1.0, 0)],
    )
    def test_its_corners_count_however_it_is_turned(self, stand_in, along, aside, reading):
        robot, half = stand_in.body(-3, 8, angle=math.pi / 4), math.sqrt(0.5)
        held = stand_in.body(-3 + half * (along - aside), 8 + half * (along + aside))
        given = {"robot": robot, "members": stand_in.members(held)}
        assert stand_in.call(in_claw("objects"), **given) == reading

    def test_the_box_may_be_smaller_elsewhere_and_read_otherwise(self, stand_in):
        device = in_claw("objects", half=1.0, ahead=-4.0, low=0.2, high=0.7)
        for x, reading in ((-4.9, 0.7), (-3.1, 0.7), (-5.1, 0.2), (-2.9, 0.2), (2.5, 0.2)):
            given = {"robot": stand_in.body(), "members": stand_in.members(stand_in.body(x, 0))}
            assert stand_in.call(device, **given) == reading

    @pytest.mark.parametrize(("carrier", "reading"), [((0, 3), 1), ((0, 2), 0), ((1, 3), 0)])
    def test_what_is_carried_counts_for_its_carrier_alone(self, stand_in, carrier, reading):
        kind, slot = carrier
        members = stand_in.members(stand_in.body(2, 0, carrier_kind=kind, carrier=slot))
        given = {"robot": stand_in.body(), "members": members, "kind": 0, "slot": 3}
        assert stand_in.call(in_claw("objects"), **given) == reading


class TestInside:
    @pytest.mark.parametrize(
        ("x", "y", "angle", "reading"),
        [
            (5, 5, 0, 1),
            (5.1, 0, 0, 0),
            (7, 0, math.pi / 4, 1),  # the corners of a turned square lie 7.07 away
            (7.1, 0, math.pi / 4, 0),
            (5, 5, math.pi / 4, 0),
            (-5, 5, math.pi / 4, 0),
            (6.9, 0.1, math.pi / 4, 1),
        ],
    )
    def test_a_zone_is_a_turned_square(self, stand_in, x, y, angle, reading):
        zone = stand_in.body(-40, -40, angle=angle, half_width=5.0)
        given = {"robot": stand_in.body(x - 40, y - 40), "members": stand_in.members(zone)}
        assert stand_in.call(inside("zones"), **given) == reading

    def test_any_zone_counts(self, stand_in):
        # The robot is nearer to the centre of the small one, and in the large one.
        small, large = stand_in.body(0, 0, half_width=1.0), stand_in.body(10, 0, half_width=9.0)
        given = {"robot": stand_in.body(2, 0), "members": stand_in.members(small, large)}
        assert stand_in.call(inside("zones"), **given) == 1.0

    def test_it_reads_what_it_is_told_to(self, stand_in):
        zone, device = stand_in.body(0, 0, half_width=1.0), inside("zones", low=0.2, high=0.7)
        for x, reading in ((0.5, 0.7), (1.5, 0.2)):
            given = {"robot": stand_in.body(x, 0), "members": stand_in.members(zone)}
            assert stand_in.call(device, **given) == reading


class TestSignals:
    def heard(self, stand_in, device, *others, own=True):
        robot = stand_in.body(0, 0, id=7, signal=[1.0, 1.0])
        members = stand_in.members(robot, *others) if own else stand_in.members(*others)
        return stand_in.call(device, robot=robot, members=members, own=own)

    def test_the_nearest_that_emits_is_heard(self, stand_in):
        silent = stand_in.body(0, 1, id=1, signal=[0.5, 1.0])
        near = stand_in.body(0, 10, id=2, signal=[0.6, 0.0])
        far = stand_in.body(-30, 0, id=3, signal=[1.0, 0.0])
        others = (far, silent, near)
        assert self.heard(stand_in, signal_orientation("robots"), *others) == pytest.approx(0.25)
        assert self.heard(stand_in, signal_distance("robots"), *others) == pytest.approx(0.1)

    def test_other_channels_are_other_signals(self, stand_in):
        other = stand_in.body(20, 0, id=1, signal=[0.0, 1.0])
        assert self.heard(stand_in, signal_distance("robots", 0), other) == 1.0
        assert self.heard(stand_in, signal_distance("robots", 1), other) == pytest.approx(0.2)

    def test_nothing_is_heard_from_beyond_the_reach(self, stand_in):
        other = stand_in.body(0, 20, id=1, signal=[1.0, 0.0])
        assert self.heard(stand_in, signal_orientation("robots", reach=19.0), other) == 0.5
        assert self.heard(stand_in, signal_orientation("robots", reach=21.0), other) == 0.25
        # The reach itself is within it.
        assert self.heard(stand_in, signal_orientation("robots", reach=20.0), other) == 0.25
        assert self.heard(stand_in, signal_active("robots", reach=20.0), other) == 1.0

    def test_directions_turn_with_the_robot_and_are_those_of_their_channel(self, stand_in):
        robot = stand_in.body(2, 1, id=7, angle=math.pi / 4, signal=[0.0, 0.0])
        other = stand_in.body(2, 9, id=1, signal=[0.0, 1.0])
        given = {"robot": robot, "members": stand_in.members(robot, other), "own": True}
        # North of a robot that looks to the north-east is 45 degrees to its left.
        assert stand_in.call(signal_orientation("robots", 1), **given) == pytest.approx(0.375)
        assert stand_in.call(signal_orientation("robots", 0), **given) == 0.5

    def test_a_half_is_no_signal(self, stand_in):
        other = stand_in.body(0, 20, id=1, signal=[0.5, 0.0])
        for device, reading in (
            (signal_active("robots"), 0.0),
            (signal_orientation("robots"), 0.5),
            (signal_distance("robots"), 1.0),
        ):
            assert self.heard(stand_in, device, other) == reading

    def test_whether_one_is_heard(self, stand_in):
        other = stand_in.body(0, 20, id=1, signal=[1.0, 0.0])
        assert self.heard(stand_in, signal_active("robots", reach=19.0), other) == 0.0
        assert self.heard(stand_in, signal_active("robots", reach=21.0), other) == 1.0
        assert self.heard(stand_in, signal_active("robots", 1, low=0.2), other) == 0.2
        assert self.heard(stand_in, signal_active("robots", high=0.7), other) == 0.7
        assert self.heard(stand_in, signal_active("robots")) == 0.0

    def test_a_reach_of_0_hears_nothing(self, stand_in):
        other = stand_in.body(0, 20, id=1, signal=[1.0, 0.0])
        assert self.heard(stand_in, signal_orientation("robots", reach=0.0), other) == 0.5
        assert self.heard(stand_in, signal_distance("robots", reach=0.0), other) == 1.0

    def test_another_team_with_the_same_identity_is_heard(self, stand_in):
        other = stand_in.body(50, 0, id=7, signal=[1.0, 0.0])
        assert self.heard(stand_in, signal_distance("others"), other, own=False) == 0.5
        assert self.heard(stand_in, signal_orientation("others"), other, own=False) == 0.5
        assert self.heard(stand_in, signal_active("others"), other, own=False) == 1.0


class TestWhatIsFelt:
    def test_what_the_claw_holds_is_felt(self, stand_in):
        held = [stand_in.call(carrying(), robot=stand_in.body(carrying=one)) for one in (-1, 0, 3)]
        assert held == [0.0, 1.0, 1.0]
        told = carrying(low=0.2, high=0.7)
        held = [stand_in.call(told, robot=stand_in.body(carrying=one)) for one in (-1, 0)]
        assert held == [0.2, 0.7]

    def test_noise_is_drawn_every_so_many_ticks(self, stand_in):
        rng, memory = random.Random(3), [0.0, 0.0]
        read = [stand_in.call(noise(3), rng=rng, memory=memory) for _ in range(300)]
        assert read[::3] == read[1::3] == read[2::3]
        assert len(set(read)) == 100
        assert 0.4 < sum(read) / 300 < 0.6 and min(read) < 0.1 and max(read) > 0.9

    @pytest.mark.parametrize(
        ("charge", "reading"),
        [(1.0, 1.0), (0.391, 0.4), (0.4, 0.4), (0.07, 0.07), (0.00001, 0.01), (0, 0), (1.3, 1.0)],
    )
    def test_the_battery_is_rounded_up_to_hundredths(self, stand_in, charge, reading):
        assert stand_in.call(battery(), robot=stand_in.body(battery=charge)) == reading

    def test_movement_is_the_mean_distance_of_remembered_positions(self, stand_in):
        device = moved(positions=3, every=2, largest=10.0)
        memory = [0.0] * device.memory
        readings = []
        for tick in range(9):
            robot = stand_in.body(x=float(tick))
            readings.append(stand_in.call(device, robot=robot, memory=memory))
        # Remembered at ticks 0, 2, 4, 6, 8: 2 apart; of three the distances are 2, 2 and 4.
        mean = (2 + 2 + 4) / 3 / 10
        assert readings == pytest.approx([0, 0, 0.2, 0.2, mean, mean, mean, mean, mean])

    def test_movement_is_a_distance_in_the_plane(self, stand_in):
        device = moved(positions=2, every=1, largest=10.0)
        memory = [0.0] * device.memory
        places = [(0, 0), (3, 4), (3, 4), (3, -2)]
        found = [
            stand_in.call(device, robot=stand_in.body(*place), memory=memory) for place in places
        ]
        assert found == pytest.approx([0.0, 0.5, 0.0, 0.6])

    def test_the_standard_movement_fills_in_400_ticks_and_fades(self, stand_in):
        device = moved()
        memory = [0.0] * device.memory

        def reading(x):
            return stand_in.call(device, robot=stand_in.body(x=x), memory=memory)

        driving = [reading(0.1 * tick) for tick in range(400)]
        # 20 positions 2 apart: the mean of 2·|i − j| is 14, over 3, capped.
        assert driving[:20] == [0.0] * 20
        assert driving[20] == pytest.approx(2 / 3)
        assert driving[-1] == 1.0
        assert [reading(39.9) for _ in range(401)][-1] == 0.0

    def test_a_constant(self, stand_in):
        assert stand_in.call(constant(0.3)) == 0.3

    def test_identities_are_spread_over_the_range(self, stand_in):
        assert [stand_in.call(identity(5), slot=slot) for slot in range(6)] == [
            0,
            0.25,
            0.5,
            0.75,
            1,
            1,
        ]
        assert [stand_in.call(identity(2), slot=slot) for slot in (0, 1)] == [0, 1]
        assert stand_in.call(identity(1), slot=0) == 0

    @pytest.mark.parametrize(
        ("reward", "reading"), [(0, 0.5), (1, 0.75), (-1, 0.25), (2, 1), (5, 1), (-9, 0)]
    )
    def test_the_payoff_is_the_reward_around_a_half(self, stand_in, reward, reading):
        assert stand_in.call(payoff(2.0), robot=stand_in.body(reward=reward)) == reading
