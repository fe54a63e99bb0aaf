"""Motion of the compiled kernel: closed forms, impacts, contacts, carried bodies."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import BALL, Disc
from socialmind.worlds.plane.kernel.arrays import Bodies, Obstacles, PlaneArrays
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.layout import BODY, FASTEST, OBSTACLE, TOUCHING

DT = 1 / 30
ROW = np.dtype([("before", "i8"), *BODY.descr, ("after", "f8")])
ROBOT = Disc(meets=("balls",))
FREE = Disc(linear_damping=0.0, angular_damping=0.0)


def bodies(count):
    rows = np.zeros(count, ROW)
    rows["carrier"] = rows["carrier_kind"] = -1
    rows["before"], rows["after"] = 7, 0.25
    return rows


def plane(kinds, obstacles=(), half_width=0.0, cell=6.0):
    """Return a plane of {name: (disc, rows)} and (x, y, angle, half-width, round) of obstacles."""
    stones = np.zeros(len(obstacles), OBSTACLE)
    for row, one in zip(stones, obstacles, strict=True):
        row["x"], row["y"], row["angle"], row["half_width"], row["round"] = one
    every = [
        Bodies(name, disc, rows, np.ones(len(rows), np.bool_), 8)
        for name, (disc, rows) in kinds.items()
    ]
    standing = Obstacles(stones, np.ones(len(stones), np.bool_), 0)
    arrays = PlaneArrays(half_width, DT, cell, every, standing)
    arrays.build()
    return arrays


def move(arrays, ticks=1):
    for _ in range(ticks):
        assert kernel().move.ctypes(arrays.address, 0, 0) == 0


def depth_in(obstacle, x, y, radius):
    """How deep a circle is in an obstacle, by the distance of its centre from the outline."""
    ox, oy, angle, half_width, is_round = obstacle
    away = complex(x - ox, y - oy) * complex(math.cos(angle), -math.sin(angle))
    if is_round:
        return half_width + radius - abs(away)
    out_x, out_y = abs(away.real) - half_width, abs(away.imag) - half_width
    return radius - (math.hypot(max(out_x, 0), max(out_y, 0)) + min(max(out_x, out_y), 0.0))


def test_a_pushed_body_follows_the_damped_recursion():
    rows = bodies(1)
    rows["push_x"], rows["push_y"], rows["torque"] = 3.0, -4.0, 2.0
    arrays = plane({"robots": (Disc(), rows)})
    keep, ticks = 1 / (1 + DT * 5.0), 50
    per_tick = DT * 3.0 / ROBOT.mass * keep
    # v_n = a (1 - k^n) / (1 - k); x is the sum of dt * v.
    speeds = per_tick * (1 - keep ** np.arange(1, ticks + 1)) / (1 - keep)
    move(arrays, ticks)
    assert rows["vx"][0] == pytest.approx(speeds[-1], rel=1e-12)
    assert rows["x"][0] == pytest.approx(DT * speeds.sum(), rel=1e-12)
    assert rows["y"][0] == pytest.approx(-4 / 3 * rows["x"][0], rel=1e-12)
    slower = 1 / (1 + DT * 20.0)
    turning = DT * 2.0 / ROBOT.moment * slower * (1 - slower**ticks) / (1 - slower)
    assert rows["spin"][0] == pytest.approx(turning, rel=1e-12)
    assert rows["before"][0] == 7 and rows["after"][0] == 0.25


def test_the_standard_robots_top_speed_and_turning():
    ahead, turning = bodies(1), bodies(1)
    ahead["push_x"] = 2 * 80.0
    turning["torque"] = 2 * 80.0
    move(plane({"ahead": (Disc(), ahead), "turning": (Disc(), turning)}), 300)
    assert ahead["vx"][0] == pytest.approx(160 / (2 * math.pi * 5), rel=1e-6)  # 5.09 units/s
    assert turning["spin"][0] == pytest.approx(160 / (math.pi * 20), rel=1e-6)  # 2.55 rad/s


def test_angles_stay_within_a_turn_and_headings_go_with_them():
    rows = bodies(1)
    rows["spin"] = 7.0
    arrays = plane({"robots": (FREE, rows)})
    for tick in range(1, 200):
        move(arrays)
        assert -math.pi <= rows["angle"][0] < math.pi
        assert 0 <= rows["heading"][0] < 360
        assert math.cos(rows["angle"][0]) == pytest.approx(math.cos(7 * DT * tick), abs=1e-9)
        assert math.sin(math.radians(rows["heading"][0])) == pytest.approx(
            math.cos(rows["angle"][0]), abs=1e-9
        )


def test_nothing_is_faster_than_the_limit():
    rows = bodies(1)
    rows["push_x"], rows["push_y"] = 1e200, 1e200
    move(plane({"robots": (Disc(), rows)}))
    assert math.hypot(rows["vx"][0], rows["vy"][0]) == pytest.approx(FASTEST)


@pytest.mark.parametrize("push", [math.nan, math.inf])
def test_a_push_that_is_no_number_is_told_and_moves_nothing(push):
    rows = bodies(3)
    rows["x"] = 5.0, 6.0, 7.0
    rows["push_x"][1] = push
    arrays = plane({"robots": (Disc(), rows)})
    assert kernel().move.ctypes(arrays.address, 0, 0) == 2
    assert rows["x"].tolist() == [5.0, 6.0, 7.0] and rows["vx"].tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("name", "value"),
    [("push_y", math.nan), ("torque", math.nan), ("torque", -math.inf), ("x", -1.5e9)],
)
def test_who_moves_nowhere_stands_still_and_is_counted_over_all_kinds(name, value):
    robots, balls = bodies(2), bodies(3)
    balls["vx"], balls["vy"], balls["spin"] = 3.0, 2.0, 1.0
    balls[name][1:] = value
    arrays = plane({"robots": (ROBOT, robots), "balls": (BALL, balls)})
    balls["y"] = 50.0, 60.0, 70.0
    assert kernel().move.ctypes(arrays.address, 0, 0) == 1 + 2 + 1  # the first of both
    for slot in (1, 2):
        at_rest = [balls[one][slot] for one in ("vx", "vy", "spin", "angle")]
        assert at_rest == [0.0, 0.0, 0.0, 0.0]
        assert balls["y"][slot] == 50.0 + 10.0 * slot
    assert balls["y"][0] > 50.0


def test_half_a_turn_is_one_to_the_right():
    rows = bodies(2)
    rows["angle"] = math.pi, -math.pi
    move(plane({"robots": (FREE, rows)}))
    assert rows["angle"].tolist() == [-math.pi] * 2 and rows["heading"].tolist() == [270.0] * 2


def test_a_hair_is_no_contact():
    rows = bodies(2)
    rows["x"][1] = 2.0 - TOUCHING / 2
    move(plane({"robots": (Disc(meets=("robots",)), rows)}))
    assert rows["contact"].tolist() == [0, 0] and rows["x"].tolist() == [0.0, 2.0 - TOUCHING / 2]


ROUND_A_SQUARE = [
    # Where it is in the frame of a square of half-width 2, and where it is pushed to.
    ((2.5, 0.4), (3.0, 0.4)),
    ((-2.5, 0.4), (-3.0, 0.4)),
    ((0.4, 2.6), (0.4, 3.0)),
    ((0.4, -2.6), (0.4, -3.0)),
    ((2.3, 2.4), (2.6, 2.8)),  # 0.5 from the corner, by 3, 4 and 5
    ((-2.3, 2.4), (-2.6, 2.8)),
    ((-2.3, -2.4), (-2.6, -2.8)),
    ((2.3, -2.4), (2.6, -2.8)),
    ((1.5, 0.2), (3.0, 0.2)),  # the centre inside
    ((-1.5, 0.2), (-3.0, 0.2)),
    ((0.2, 1.5), (0.2, 3.0)),
    ((0.2, -1.5), (0.2, -3.0)),
    ((3.1, 0.0), (3.1, 0.0)),
    ((2.9, 2.9), (2.9, 2.9)),
]


@pytest.mark.parametrize("angle", [0.0, 0.3, -2.0])
def test_all_round_a_square_bodies_leave_by_the_shortest_way(angle):
    turn, centre = complex(math.cos(angle), math.sin(angle)), complex(1.0, -2.0)
    rows = bodies(len(ROUND_A_SQUARE))
    starts = [centre + turn * complex(*start) for start, _ in ROUND_A_SQUARE]
    rows["x"], rows["y"] = [one.real for one in starts], [one.imag for one in starts]
    move(plane({"robots": (Disc(), rows)}, [(centre.real, centre.imag, angle, 2.0, 0)]))
    for row, (start, end) in zip(rows, ROUND_A_SQUARE, strict=True):
        found = (complex(row["x"], row["y"]) - centre) / turn
        assert (found.real, found.imag) == pytest.approx(end, abs=1e-9)
        assert row["contact"] == (start != end)


def test_who_is_pushed_out_loses_the_speed_into_the_obstacle_alone():
    rows = bodies(4)
    rows["x"], rows["vy"] = 1.0 + 1.6, 4.0
    rows["vx"] = -3.0, 3.0, -0.5, -3.0
    rows["y"] = 0.0, 100.0, 200.0, 300.0
    obstacles = [(1.0, y, 0.0, 1.0, 0) for y in (0.0, 100.0, 200.0)]
    bouncing = Disc(linear_damping=0, restitution=0.5)
    move(plane({"balls": (bouncing, rows)}, obstacles))
    # The second leaves as fast as it was leaving; the third is too slow to bounce.
    assert rows["vx"].tolist() == pytest.approx([1.5, 3.0, 0.0, -3.0])
    assert rows["vy"].tolist() == [4.0] * 4
    assert rows["x"].tolist() == pytest.approx([3.0, 3.0, 3.0, 2.5])


def test_a_heavy_body_gives_way_less():
    small, large = bodies(1), bodies(1)
    large["x"], large["vx"], small["vx"] = 2.5, -2.0, 1.0
    light, heavy = Disc(linear_damping=0, meets=("large",)), Disc(radius=2.0, linear_damping=0)
    assert heavy.mass == pytest.approx(4 * light.mass)
    move(plane({"small": (light, small), "large": (heavy, large)}))
    # 0.6 deep after their way; four fifths of that are the light one's. They go on together.
    assert small["x"][0] == pytest.approx(DT - 0.8 * (0.5 + 3 * DT))
    assert large["x"][0] == pytest.approx(2.5 - 2 * DT + 0.2 * (0.5 + 3 * DT))
    assert small["vx"][0] == large["vx"][0] == pytest.approx((1.0 - 4 * 2.0) / 5)


def test_bodies_bounce_in_the_first_round_alone():
    rows = bodies(3)
    rows["x"], rows["vx"][2] = (0.0, 2.0, 4.0), -6.0
    move(plane({"balls": (Disc(linear_damping=0, meets=("balls",), restitution=1.0), rows)}))
    # The third gives its speed to the second, which shares it with the first in the second round.
    assert rows["vx"].tolist() == pytest.approx([-3.0, -3.0, 0.0])


def test_who_is_pressed_against_a_border_does_not_give_way():
    robots, balls = bodies(1), bodies(1)
    robots["x"], balls["x"] = 5.5, 9.0
    heavy = Disc(radius=3.0, meets=("balls",))
    move(plane({"robots": (heavy, robots), "balls": (BALL, balls)}, half_width=10.0))
    assert (robots["x"][0], balls["x"][0]) == pytest.approx((5.0, 9.0), abs=2 * TOUCHING)


@pytest.mark.parametrize("places", [(9.0, 7.0), (7.0, 9.0)])
@pytest.mark.parametrize("turned_round", [False, True])
def test_nor_does_who_is_pressed_against_that_one(places, turned_round):
    robots, balls = bodies(1), bodies(2)
    robots["x"], balls["x"] = 3.5, places
    heavy, ball = Disc(radius=3.0, meets=("balls",)), Disc(meets=("balls",))
    kinds = {"robots": (heavy, robots), "balls": (ball, balls)}
    kinds = dict(reversed(kinds.items())) if turned_round else kinds
    move(plane(kinds, half_width=10.0))
    assert balls["x"].tolist() == pytest.approx(places, abs=1e-6)
    assert robots["x"][0] == pytest.approx(3.0, abs=1e-6)


def test_two_that_cannot_give_way_share_the_way():
    # Between two walls 3 apart, where both are pressed against theirs: alike in turning it round.
    rows = bodies(2)
    rows["x"], rows["y"] = (-0.5, 0.5), (-0.1, 0.1)
    walls = [(-51.5, 0.0, 0.0, 50.0, 0), (51.5, 0.0, 0.0, 50.0, 0)]
    move(plane({"robots": (Disc(meets=("robots",)), rows)}, walls))
    assert rows["x"].tolist() == pytest.approx([-0.5, 0.5])
    assert rows["y"][1] == pytest.approx(-rows["y"][0]) and rows["y"][1] > 0.3


@pytest.mark.parametrize("turned_round", [False, True])
def test_what_is_carried_touches_no_body(turned_round):
    robots, balls = bodies(2), bodies(1)
    robots["x"][1], balls["carrier_kind"], balls["carrier"] = 2.5, int(turned_round), 0
    balls["x"] = 2.0
    kinds = {"robots": (ROBOT, robots), "balls": (BALL, balls)}
    move(plane(dict(reversed(kinds.items())) if turned_round else kinds))
    assert robots["contact"].tolist() == [0, 0] and balls["contact"].tolist() == [0]
    assert (robots["x"].tolist(), balls["x"].tolist()) == ([0.0, 2.5], [2.0])


def test_who_leaves_another_body_keeps_its_speed():
    one, two = bodies(1), bodies(1)
    two["x"], two["vx"], one["vy"] = 1.5, 2.0, 1.0
    meeting = Disc(linear_damping=0, meets=("two",))
    move(plane({"one": (meeting, one), "two": (Disc(linear_damping=0), two)}))
    assert (one["vx"][0], one["vy"][0], two["vx"][0]) == (0.0, 1.0, 2.0)
    assert (one["contact"][0], two["contact"][0]) == (2, 2)


def test_who_does_not_live_is_not_touched():
    rows = bodies(2)
    rows["vx"], rows["contact"] = 1.0, 5
    alive = np.array([False, True])
    arrays = PlaneArrays(10.0, DT, 5.0, [Bodies("robots", Disc(meets=("robots",)), rows, alive, 8)])
    before = rows[0].copy()
    move(arrays)
    assert rows[0] == before and rows["x"][1] > 0 and rows["contact"][1] == 0


def test_who_touches_a_body_and_a_border_has_run_into_the_border():
    crowd = bodies(3)
    crowd["x"] = [9.5, 8.0, 6.5]
    move(plane({"crowd": (Disc(meets=("crowd",)), crowd)}, half_width=10.0))
    assert crowd["contact"].tolist() == [1, 2, 2]


@pytest.mark.parametrize(("restitution", "leaving"), [(0.0, 5.0), (1.0, 10.0), (1.8, 14.0)])
def test_equal_balls_exchange_speed_by_the_larger_restitution(restitution, leaving):
    one, two = bodies(1), bodies(1)
    one["vx"], two["x"] = 10.0, 2.1
    hitting = Disc(linear_damping=0, meets=("two",))
    hit = Disc(linear_damping=0, restitution=restitution)
    move(plane({"one": (hitting, one), "two": (hit, two)}))
    assert two["vx"][0] == pytest.approx(leaving)
    assert one["vx"][0] == pytest.approx(10.0 - leaving)
    assert one["contact"][0] == two["contact"][0] == 2
    assert two["x"][0] - one["x"][0] == pytest.approx(2.0)
    # Of equal masses each gives way by half: 0.2333… units deep.
    assert two["x"][0] == pytest.approx(2.1 + (10 * DT - 0.1) / 2)


def test_slow_impacts_do_not_bounce():
    one, two = bodies(1), bodies(1)
    one["vx"], two["x"] = 0.9, 2.0
    ball = Disc(linear_damping=0, restitution=1.0)
    move(plane({"one": (Disc(linear_damping=0, meets=("two",)), one), "two": (ball, two)}))
    assert one["vx"][0] == pytest.approx(0.45) and two["vx"][0] == pytest.approx(0.45)


@given(
    place=st.floats(0, 2 * math.pi), speed=st.floats(0.1, 50), radius=st.floats(0.3, 3),
    density=st.floats(0.1, 10), restitution=st.floats(0, 1),
)  # fmt: skip
@settings(max_examples=60)
def test_impacts_keep_momentum_and_the_middle_of_mass(place, speed, radius, density, restitution):
    small = Disc(linear_damping=0, meets=("large",), restitution=restitution)
    large = Disc(radius=radius, density=density, linear_damping=0)
    one, two = bodies(1), bodies(1)
    two["x"], two["y"] = (1 + radius) * math.cos(place), (1 + radius) * math.sin(place)
    one["vx"], two["vy"] = speed, 0.5
    masses = np.array([small.mass, large.mass])
    before = masses @ np.array([one["x"][0] + DT * speed, two["x"][0]])
    energy = masses @ [speed**2, 0.25]
    move(plane({"small": (small, one), "large": (large, two)}))
    speeds_x, speeds_y = np.array([one["vx"][0], two["vx"][0]]), [one["vy"][0], two["vy"][0]]
    assert masses @ speeds_x == pytest.approx(small.mass * speed, rel=1e-9)
    assert masses @ np.array(speeds_y) == pytest.approx(large.mass * 0.5, rel=1e-9)
    assert masses @ np.array([one["x"][0], two["x"][0]]) == pytest.approx(before, abs=1e-9)
    assert masses @ (speeds_x**2 + np.square(speeds_y)) <= energy * (1 + 1e-9)


def test_robots_that_do_not_meet_pass_through_each_other():
    rows = bodies(2)
    rows["x"] = 0.0, 0.5
    move(plane({"robots": (ROBOT, rows), "balls": (BALL, bodies(0))}))
    assert rows["contact"].tolist() == [0, 0] and rows["x"].tolist() == [0.0, 0.5]


def test_bodies_in_one_place_are_parted():
    rows = bodies(2)
    move(plane({"robots": (Disc(meets=("robots",)), rows)}))
    assert abs(rows["x"][1] - rows["x"][0]) == pytest.approx(2.0)


def test_a_corner_stops_a_body_on_two_sides_at_once():
    rows = bodies(1)
    rows["x"], rows["y"], rows["vx"], rows["vy"] = 8.9, 8.95, 30.0, 30.0
    arrays = plane({"robots": (Disc(linear_damping=0), rows)}, half_width=10.0)
    move(arrays)
    row = rows[0]
    assert (row["x"], row["y"], row["vx"], row["vy"], row["contact"]) == (9.0, 9.0, 0.0, 0.0, 1)
    move(arrays)
    assert rows["contact"][0] == 0  # it rests against both, and overlaps neither


def test_balls_bounce_off_borders_and_squares_at_most_at_their_speed():
    rows = bodies(2)
    rows["x"], rows["y"], rows["vx"] = (8.9, -0.1), (8.0, 0.0), 6.0
    ball = Disc(linear_damping=0, restitution=1.8)
    obstacle = (2.0, 0.0, math.pi / 2, 1.0, 0)
    move(plane({"balls": (ball, rows)}, [obstacle], half_width=10.0))
    assert rows["vx"].tolist() == pytest.approx([-6.0, -6.0])
    assert rows["x"].tolist() == pytest.approx([9.0, 0.0])


def test_a_square_pushes_along_its_own_sides():
    rows = bodies(1)
    rows["x"], rows["y"], rows["vx"] = -1.45, 1.45, 4.0
    move(plane({"robots": (Disc(linear_damping=0), rows)}, [(0.0, 0.0, math.pi / 4, 1.2, 0)]))
    root = math.sqrt(0.5)
    assert rows["vx"][0] == pytest.approx(2.0) and rows["vy"][0] == pytest.approx(2.0)
    assert -rows["x"][0] * root + rows["y"][0] * root == pytest.approx(2.2)


def test_a_body_whose_centre_is_inside_leaves_by_the_nearest_side():
    rows = bodies(1)
    rows["x"], rows["y"] = 0.2, -1.5
    move(plane({"robots": (Disc(), rows)}, [(0.0, 0.0, 0.0, 2.0, 0)]))
    assert (rows["x"][0], rows["y"][0]) == pytest.approx((0.2, -3.0))


def test_a_body_is_freed_of_two_obstacles_at_once():
    rows = bodies(1)
    rows["x"], rows["y"], rows["vy"] = 0.0, 1.2, -2.0
    obstacles = [(-1.5, 0.0, 0.0, 1.0, 0), (1.5, 0.0, 0.3, 1.0, 0), (0.0, -1.0, 0.0, 1.0, 1)]
    move(plane({"robots": (Disc(), rows)}, obstacles))
    for one in obstacles:
        assert depth_in(one, rows["x"][0], rows["y"][0], 1.0) <= 2 * TOUCHING


def test_a_ball_between_robot_and_border_is_not_pressed_into_either():
    robots, balls = bodies(1), bodies(1)
    robots["x"], balls["x"], robots["push_x"] = 6.0, 9.0, 160.0
    arrays = plane({"robots": (ROBOT, robots), "balls": (BALL, balls)}, half_width=10.0)
    for _ in range(200):
        move(arrays)
        assert balls["x"][0] <= 9.0 + 2 * TOUCHING
        assert math.hypot(balls["x"][0] - robots["x"][0], balls["y"][0]) >= 2 - 2 * TOUCHING


floats = st.floats(-12, 12)
squares = st.tuples(floats, floats, st.floats(-4, 4), st.floats(0.3, 2.5), st.integers(0, 1))


@example(obstacles=[], places=[(8.0, 9.0, 1.0, 0.0), (9.0, 8.0, 0.0, 0.0)])
@given(
    obstacles=st.lists(squares, max_size=6),
    places=st.lists(st.tuples(floats, floats, st.floats(-60, 60), st.floats(-60, 60)), max_size=6),
)
@settings(max_examples=150)
def test_whatever_happens_there_are_numbers_inside_the_borders(obstacles, places):
    rows = bodies(len(places))
    for row, one in zip(rows, places, strict=True):
        row["x"], row["y"], row["vx"], row["vy"] = one
    disc = Disc(meets=("robots",), restitution=1.8)
    arrays = plane({"robots": (disc, rows)}, obstacles, half_width=10.0)
    for _ in range(5):
        move(arrays)
        for name in BODY.names:
            assert np.isfinite(rows[name]).all()
        most = 9 + 2 * TOUCHING
        assert (np.abs(rows["x"]) <= most).all() and (np.abs(rows["y"]) <= most).all()


@given(
    turns=st.lists(st.floats(-4, 4), min_size=9, max_size=9),
    widths=st.lists(st.floats(0.5, 2.5), min_size=9, max_size=9),
    kinds=st.lists(st.integers(0, 1), min_size=9, max_size=9),
    start=st.tuples(st.floats(-20, 20), st.floats(-20, 20)),
    push=st.tuples(st.floats(-500, 500), st.floats(-500, 500)),
)
@settings(max_examples=100)
def test_nothing_overlaps_after_a_move_where_there_is_room(turns, widths, kinds, start, push):
    places = [(x, y) for x in (-12.0, 0.0, 12.0) for y in (-12.0, 0.0, 12.0)]
    obstacles = [(*place, *rest) for place, *rest in zip(places, turns, widths, kinds, strict=True)]
    rows = bodies(1)
    rows["x"], rows["y"] = start
    rows["push_x"], rows["push_y"] = push
    arrays = plane({"robots": (Disc(), rows)}, obstacles, half_width=21.0, cell=4.0)
    for _ in range(20):
        x, y = rows["x"][0], rows["y"][0]
        move(arrays)
        deep = [depth_in(one, rows["x"][0], rows["y"][0], 1.0) for one in obstacles]
        assert max(deep) <= 2 * TOUCHING
        if not rows["contact"][0]:  # then it went where its speed took it
            moved = rows["x"][0] - x, rows["y"][0] - y
            assert moved == pytest.approx((DT * rows["vx"][0], DT * rows["vy"][0]), abs=1e-12)


def test_carried_bodies_are_just_ahead_and_touch_nothing():
    robots, balls = bodies(2), bodies(1)
    robots["angle"][1], robots["vx"][1], robots["vy"][1] = math.pi / 3, 3.0, 1.0
    balls["carrier_kind"], balls["carrier"], balls["contact"] = 1, 1, 1
    balls["spin"] = 4.0
    disc = Disc(linear_damping=0, meets=("balls",))
    arrays = plane({"balls": (BALL, balls), "robots": (disc, robots)}, [(1.0, 1.8, 0.0, 0.5, 0)])
    move(arrays)
    robot, ball = robots[1], balls[0]
    assert ball["x"] == pytest.approx(robot["x"] + 2 * math.cos(math.pi / 3), abs=1e-12)
    assert ball["y"] == pytest.approx(robot["y"] + 2 * math.sin(math.pi / 3), abs=1e-12)
    for name in ("angle", "heading", "vx", "vy"):
        assert ball[name] == robot[name]
    assert ball["contact"] == 0 and robots["contact"].tolist() == [0, 0] and ball["carrier"] == 1
    assert ball["spin"] == 0.0 and ball["carrier_kind"] == 1
    # Nor does it touch anything where it is carried through.
    robot["x"], robot["y"], robot["vx"], robot["vy"], robot["angle"] = -2.0, 1.8, 0.0, 0.0, 0.0
    balls["x"], balls["y"] = 1.0, 1.8
    move(arrays)
    assert balls["contact"].tolist() == [0] and balls["x"].tolist() == [0.0]
    assert (robot["x"], robot["contact"]) == (-2.0, 0)


@pytest.mark.parametrize(("kind", "carrier"), [(2, 0), (7, 0), (0, 1), (0, -1)])
def test_who_is_carried_by_nobody_that_there_is_moves_freely(kind, carrier):
    robots, balls = bodies(1), bodies(1)
    balls["carrier_kind"], balls["carrier"], balls["vx"] = kind, carrier, 3.0
    robots["y"] = 50.0
    move(plane({"robots": (ROBOT, robots), "balls": (BALL, balls)}))
    assert balls["carrier"][0] == balls["carrier_kind"][0] == -1 and balls["x"][0] > 0


def test_whose_carrier_is_gone_moves_freely():
    robots, balls = bodies(1), bodies(1)
    balls["carrier_kind"], balls["carrier"], balls["vx"] = 0, 0, 3.0
    kinds = [
        Bodies("robots", ROBOT, robots, np.array([False]), 8),
        Bodies("balls", BALL, balls, np.array([True]), 8),
    ]
    move(PlaneArrays(0.0, DT, 5.0, kinds))
    assert balls["carrier"][0] == balls["carrier_kind"][0] == -1 and balls["x"][0] > 0


def test_the_same_world_moves_the_same_way():
    def run():
        rng = np.random.default_rng(5)
        rows = bodies(20)
        for name in ("x", "y", "vx", "vy"):
            rows[name] = rng.uniform(-9, 9, 20)
        obstacles = [(*rng.uniform(-9, 9, 2), rng.uniform(0, 3), 1.0, n % 2) for n in range(5)]
        disc = Disc(meets=("robots",), restitution=0.5)
        move(plane({"robots": (disc, rows)}, obstacles, half_width=10.0), 100)
        return rows.tobytes()

    assert run() == run()


def test_arrays_that_have_moved_are_attached():
    rows = bodies(1)
    arrays = plane({"robots": (FREE, rows)})
    more = bodies(3)
    more["vx"] = 1.0
    arrays.attach(0, more, np.ones(3, np.bool_), 8)
    move(arrays)
    assert more["x"].tolist() == pytest.approx([DT] * 3) and rows["x"][0] == 0


def test_what_is_laid_out_otherwise_is_refused():
    rows, alive = bodies(1), np.ones(1, np.bool_)
    with pytest.raises(ModelError, match="column x 0 bytes"):
        PlaneArrays(0.0, DT, 5.0, [Bodies("robots", Disc(), rows, alive, 0)])
    with pytest.raises(ModelError, match="one truth value for each row"):
        PlaneArrays(0.0, DT, 5.0, [Bodies("robots", Disc(), rows, np.ones(2, np.bool_), 8)])
    with pytest.raises(ModelError, match="'robots' that meet 'balls'"):
        PlaneArrays(0.0, DT, 5.0, [Bodies("robots", ROBOT, rows, alive, 8)])
    with pytest.raises(ModelError, match="half_width=-1"):
        PlaneArrays(-1, DT, 5.0, [])
