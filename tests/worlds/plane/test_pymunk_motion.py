"""Pymunk moves bodies as a plane wants it: hand-computed motion, impacts and contacts."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import BALL, Disc
from socialmind.worlds.plane.layout import BODY, FASTEST, OBSTACLE, SETTLING
from socialmind.worlds.plane.pymunk_motion import MOST_KINDS, Kind, PymunkMotion

DT = 1 / 30
ROBOT = Disc(meets=("objects",))
GLIDER = Disc(linear_damping=0.0, angular_damping=0.0)
BOUNCER = Disc(linear_damping=0.0, angular_damping=0.0, restitution=0.5)


def bodies(*rows, slots=None):
    """Records of bodies, of which those that are given live."""
    table = np.zeros(slots or len(rows), BODY)
    table["carrier_kind"] = table["carrier"] = -1
    for slot, row in enumerate(rows):
        for name, value in row.items():
            table[name][slot] = value
    return table, np.arange(len(table)) < len(rows)


def stones(*rows):
    table = np.zeros(len(rows), OBSTACLE)
    for slot, row in enumerate(rows):
        for name, value in row.items():
            table[name][slot] = value
    return table, np.ones(len(rows), bool)


def population(rows, alive):
    return SimpleNamespace(rows=rows, alive=alive)


def plane(*populations, half_width=0.0, obstacles=None):
    """A built world; populations as (name, disc, (rows, alive))."""
    kinds = [Kind(name, disc, population(*slots)) for name, disc, slots in populations]
    motion = PymunkMotion(half_width, DT, kinds, obstacles and population(*obstacles))
    motion.build()
    return motion


def drive(row, left, right):
    """The two wheels of EvoAgents' robot: what its commands do in a tick."""
    ahead, turn = 80.0 * ((2 * left - 1) + (2 * right - 1)), 80.0 * (2 * right - 2 * left)
    angle = row["angle"][0]
    row["push_x"], row["push_y"] = ahead * math.cos(angle), ahead * math.sin(angle)
    row["torque"] = turn


# Free motion


@given(
    disc=st.builds(
        Disc,
        radius=st.floats(0.2, 3.0),
        density=st.floats(0.5, 4.0),
        linear_damping=st.floats(0.0, 10.0),
        angular_damping=st.floats(0.0, 30.0),
    ),
    start=st.tuples(*[st.floats(-40.0, 40.0)] * 4),
    push=st.tuples(*[st.floats(-200.0, 200.0)] * 3),
)
@settings(max_examples=50)
def test_free_motion_follows_the_recursion(disc, start, push):
    x, y, vx, vy = start
    angle = spin = 0.0
    body = bodies({"x": x, "y": y, "vx": vx, "vy": vy})
    motion = plane(("robots", disc, body))
    row = body[0]
    row["push_x"], row["push_y"], row["torque"] = push
    for _ in range(20):
        vx = (vx + DT * push[0] / disc.mass) / (1 + DT * disc.linear_damping)
        vy = (vy + DT * push[1] / disc.mass) / (1 + DT * disc.linear_damping)
        speed = math.hypot(vx, vy)
        if speed > FASTEST:
            vx, vy = vx * FASTEST / speed, vy * FASTEST / speed
        spin = (spin + DT * push[2] / disc.moment) / (1 + DT * disc.angular_damping)
        x, y, angle = x + DT * vx, y + DT * vy, angle + DT * spin
        motion.move()
        got = [row[name].item() for name in ("x", "y", "vx", "vy", "spin")]
        assert got == pytest.approx([x, y, vx, vy, spin], rel=1e-12, abs=1e-12)
        assert -math.pi <= row["angle"].item() < math.pi
        assert math.remainder(row["angle"].item() - angle, 2 * math.pi) == pytest.approx(
            0.0, abs=1e-10
        )
        degrees = math.degrees(row["angle"].item())
        assert row["heading"].item() == pytest.approx((90 - degrees) % 360)
        assert row["contact"].item() == 0


def test_the_robots_top_speed_and_turning_rate():
    body = bodies({})
    motion = plane(("robots", Disc(), body))
    for _ in range(600):
        drive(body[0], 1.0, 1.0)
        motion.move()
    # What a push of 160 keeps up against the damping: push / (mass · damping).
    assert body[0]["vx"].item() == pytest.approx(160 / (2 * math.pi * 5))
    assert body[0]["vx"].item() == pytest.approx(5.1, abs=0.01)
    for _ in range(600):
        drive(body[0], 0.0, 1.0)
        motion.move()
    assert body[0]["spin"].item() == pytest.approx(160 / (math.pi * 20))
    assert body[0]["spin"].item() == pytest.approx(2.5, abs=0.05)


# Impacts


@pytest.mark.parametrize("density", [2.0, 0.5])
def test_a_head_on_impact_keeps_momentum_and_bounces_by_the_larger_restitution(density):
    other = Disc(1.0, density, 0.0, 0.0, restitution=0.8, meets=("balls",))
    ball, target = bodies({"x": -1.2, "vx": 9.0}), bodies({"x": 1.0})
    motion = plane(("balls", BOUNCER, ball), ("targets", other, target))
    motion.move()
    momentum = BOUNCER.mass * ball[0]["vx"] + other.mass * target[0]["vx"]
    assert momentum.item() == pytest.approx(9.0 * BOUNCER.mass)
    assert (target[0]["vx"] - ball[0]["vx"]).item() == pytest.approx(0.8 * 9.0)
    assert ball[0]["contact"].item() == target[0]["contact"].item() == 2
    # The overlap of 0.1 is taken out at once, shared in inverse proportion to the masses.
    assert (target[0]["x"] - ball[0]["x"]).item() == pytest.approx(2.0, abs=1e-12)
    share = BOUNCER.mass / (BOUNCER.mass + other.mass)
    assert target[0]["x"].item() == pytest.approx(1.0 + 0.1 * share, abs=1e-12)
    motion.move()
    assert ball[0]["contact"].item() == target[0]["contact"].item() == 0


def test_a_bounce_of_two_balls_may_give_more_than_came():
    one, two = bodies({"x": -1.2, "vx": 9.0}), bodies({"x": 1.0})
    disc = Disc(linear_damping=0.0, restitution=1.8, meets=("two",))
    plane(("one", disc, one), ("two", GLIDER, two)).move()
    assert (two[0]["vx"] - one[0]["vx"]).item() == pytest.approx(1.8 * 9.0)


@pytest.mark.parametrize(("restitution", "share"), [(0.0, 0.0), (0.5, 0.5), (1.8, 1.0)])
def test_a_wall_gives_back_at_most_what_came(restitution, share):
    disc = Disc(linear_damping=0.0, restitution=restitution)
    body = bodies({"x": 8.9, "vx": 6.0, "vy": 3.0})
    plane(("balls", disc, body), half_width=10.0).move()
    assert body[0]["vx"].item() == pytest.approx(-6.0 * share, abs=1e-12)
    assert body[0]["vy"].item() == pytest.approx(3.0)
    assert body[0]["x"].item() == pytest.approx(9.0, abs=1e-12)


@pytest.mark.parametrize(("speed", "after"), [(0.99 * SETTLING, 0.0), (1.01 * SETTLING, -0.505)])
def test_slow_impacts_do_not_bounce(speed, after):
    body = bodies({"x": 8.99, "vx": speed})
    plane(("balls", BOUNCER, body), half_width=10.0).move()
    assert body[0]["vx"].item() == pytest.approx(after * SETTLING, abs=1e-12)


def test_a_robot_pushes_a_ball():
    robot, ball = bodies({"x": 0.0}), bodies({"x": 4.0, "y": 0.05})
    motion = plane(("robots", ROBOT, robot), ("objects", BALL, ball))
    touched = 0
    for _ in range(90):
        drive(robot[0], 1.0, 1.0)
        motion.move()
        touched += robot[0]["contact"].item()
        assert robot[0]["contact"].item() == ball[0]["contact"].item()
        apart = math.hypot(*(ball[0][name].item() - robot[0][name].item() for name in "xy"))
        assert apart >= 2.0 - 1e-9
    assert touched > 0
    assert ball[0]["x"].item() > 8.0
    assert ball[0]["spin"].item() == 0.0


def test_only_kinds_that_meet_collide_and_it_is_mutual():
    at = {"x": 0.5}
    robots, objects, ghosts = bodies({}, at), bodies(at), bodies({"x": 0.2})
    motion = plane(
        ("robots", ROBOT, robots), ("objects", BALL, objects), ("ghosts", Disc(), ghosts)
    )
    motion.move()
    assert robots[0]["contact"].tolist() == [2, 2]
    assert objects[0]["contact"].tolist() == [2]
    assert ghosts[0]["contact"].tolist() == [0]
    assert ghosts[0]["x"].item() == 0.2


def test_bodies_of_one_kind_may_meet_each_other():
    robots = bodies({}, {"x": 1.5})
    plane(("robots", Disc(meets=("robots",)), robots)).move()
    assert robots[0]["x"].tolist() == pytest.approx([-0.25, 1.75], abs=1e-12)


# What never moves


@pytest.mark.parametrize("side", range(4))
def test_a_body_slides_along_a_wall_without_losing_speed(side):
    turn = side * math.pi / 2
    c, s = math.cos(turn), math.sin(turn)
    body = bodies({"x": 9 * c, "y": 9 * s, "vx": 4 * c - 3 * s, "vy": 4 * s + 3 * c})
    motion = plane(("gliders", GLIDER, body), half_width=10.0)
    for tick in range(30):
        body[0]["push_x"], body[0]["push_y"] = 50 * c, 50 * s
        motion.move()
        ahead = -s * body[0]["x"].item() + c * body[0]["y"].item()
        assert ahead == pytest.approx(3.0 * DT * (tick + 1), abs=1e-9)
        assert c * body[0]["x"].item() + s * body[0]["y"].item() == pytest.approx(9.0, abs=1e-9)
        assert body[0]["contact"].item() == 1
    assert body[0]["spin"].item() == 0.0


def test_a_body_stops_in_a_corner():
    body = bodies({"x": 8.0, "y": 7.0, "vx": 20.0, "vy": 30.0})
    motion = plane(("robots", Disc(), body), half_width=10.0)
    for _ in range(20):
        body[0]["push_x"] = body[0]["push_y"] = 100.0
        motion.move()
    assert [body[0][name].item() for name in "xy"] == pytest.approx([9.0, 9.0], abs=1e-9)
    assert [body[0][name].item() for name in ("vx", "vy")] == pytest.approx([0.0, 0.0], abs=1e-9)


def test_the_fastest_body_does_not_leave_the_arena():
    body = bodies({"x": 8.99, "y": -8.99, "vx": FASTEST, "vy": -FASTEST})
    plane(("gliders", GLIDER, body), half_width=10.0).move()
    assert [body[0][name].item() for name in "xy"] == pytest.approx([9.0, -9.0], abs=1e-9)


def test_what_stands_outside_the_borders_is_put_back():
    body = bodies({"x": 37.0, "y": -3.0})
    plane(("gliders", GLIDER, body), half_width=10.0).move()
    assert [body[0][name].item() for name in "xy"] == pytest.approx([9.0, -3.0], abs=1e-9)


def test_without_borders_the_plane_goes_on():
    body = bodies({"x": 1e5, "vx": 30.0})
    plane(("gliders", GLIDER, body)).move()
    assert body[0]["x"].item() == pytest.approx(1e5 + 1.0)
    assert body[0]["contact"].item() == 0


@given(angle=st.floats(-3.0, 3.0), face=st.integers(0, 3), along=st.floats(-1.4, 1.4))
@settings(max_examples=50)
def test_a_square_pushes_out_along_its_face(angle, face, along):
    c, s = math.cos(angle + face * math.pi / 2), math.sin(angle + face * math.pi / 2)
    out, speed, deep = 2.5, 6.0, 0.15  # half-width 1.5 and radius 1
    gap = out + speed * DT - deep
    body = bodies(
        {"x": 5 + c * gap - s * along, "y": -4 + s * gap + c * along,
         "vx": -speed * c - 2 * s, "vy": -speed * s + 2 * c}
    )  # fmt: skip
    square = stones({"x": 5.0, "y": -4.0, "angle": angle, "half_width": 1.5})
    plane(("gliders", GLIDER, body), obstacles=square).move()
    row, now = body[0][0], along + 2 * DT
    assert row["contact"] == 1
    assert row["x"] == pytest.approx(5 + c * out - s * now, abs=1e-9)
    assert row["y"] == pytest.approx(-4 + s * out + c * now, abs=1e-9)
    assert row["vx"] == pytest.approx(-2 * s, abs=1e-9)
    assert row["vy"] == pytest.approx(2 * c, abs=1e-9)


@given(angle=st.floats(-3.0, 3.0), toward=st.floats(0.1, 1.4))
@settings(max_examples=50)
def test_a_squares_corner_pushes_away_from_the_corner(angle, toward):
    corner = (2 * math.cos(angle) - 2 * math.sin(angle), 2 * math.sin(angle) + 2 * math.cos(angle))
    c, s = math.cos(angle + toward), math.sin(angle + toward)
    body = bodies({"x": corner[0] + 0.9 * c, "y": corner[1] + 0.9 * s})
    square = stones({"angle": angle, "half_width": 2.0})
    plane(("gliders", GLIDER, body), obstacles=square).move()
    assert body[0]["x"].item() == pytest.approx(corner[0] + c, abs=1e-9)
    assert body[0]["y"].item() == pytest.approx(corner[1] + s, abs=1e-9)


def test_a_cylinder_pushes_out_along_the_line_of_centres():
    body = bodies({"x": 2.0, "y": 1.4, "vx": -3.0})
    cylinder = stones({"half_width": 1.5, "round": 1, "angle": 0.3})
    plane(("gliders", GLIDER, body), obstacles=cylinder).move()
    x, y = 2.0 - 3.0 * DT, 1.4
    c, s = x / math.hypot(x, y), y / math.hypot(x, y)
    assert body[0]["x"].item() == pytest.approx(2.5 * c)
    assert body[0]["y"].item() == pytest.approx(2.5 * s)
    assert body[0]["vx"].item() == pytest.approx(-3.0 + 3.0 * c * c)
    assert body[0]["vy"].item() == pytest.approx(3.0 * c * s)


@pytest.mark.parametrize(("half_width", "away"), [(0.0, 0.6 * math.sqrt(2)), (1e-9, 1.0)])
def test_an_obstacle_may_be_tiny_or_nothing(half_width, away):
    body = bodies({"x": 0.6, "y": -0.6})
    point = stones({"half_width": half_width, "angle": 1.0})
    plane(("gliders", GLIDER, body), obstacles=point).move()
    assert math.hypot(body[0]["x"].item(), body[0]["y"].item()) == pytest.approx(away)


def test_dead_obstacles_stop_nobody_and_build_reads_them_again():
    body = bodies({"x": 2.0, "vx": -3.0})
    cylinder = stones({"half_width": 1.5, "round": 1})
    cylinder[1][0] = False
    motion = plane(("gliders", GLIDER, body), obstacles=cylinder)
    motion.move()
    assert body[0]["contact"].item() == 0
    cylinder[1][0] = True
    motion.build()
    motion.move()
    assert body[0]["contact"].item() == 1
    assert body[0]["x"].item() == pytest.approx(2.5)


def test_what_rests_against_a_wall_touches_nothing():
    body = bodies({"x": 8.95, "y": 1 / 3, "vx": 6.0})
    square = stones({"x": 9.0, "y": 3.3, "half_width": 2.0, "angle": 0.4})
    motion = plane(("robots", Disc(), body), half_width=10.0, obstacles=square)
    motion.move()
    assert body[0]["contact"].item() == 1
    for _ in range(100):
        motion.move()
    before = body[0].copy()
    motion.move()
    assert body[0]["contact"].item() == 0
    assert body[0]["x"].item() == pytest.approx(before["x"].item(), abs=1e-12)


# Rows are the truth


def test_a_carried_body_stays_ahead_of_its_carrier_and_touches_nothing():
    robots = bodies({}, {"x": -5.0, "angle": 2.0, "vx": 1.0})
    ball = bodies({"x": 30.0, "carrier_kind": 0, "carrier": 1, "contact": 1, "vx": 50.0})
    other = bodies({"x": -5.0 + 2.0 * math.cos(2.0), "y": 2.0 * math.sin(2.0)})
    motion = plane(
        ("robots", ROBOT, robots), ("objects", Disc(radius=0.5), ball), ("bystanders", BALL, other)
    )
    for _ in range(3):
        drive(robots[0][1:], 0.2, 0.9)
        motion.move()
    carrier, held = robots[0][1], ball[0][0]
    assert held["x"] == pytest.approx(carrier["x"] + 1.5 * math.cos(carrier["angle"]))
    assert held["y"] == pytest.approx(carrier["y"] + 1.5 * math.sin(carrier["angle"]))
    for name in ("vx", "vy", "angle", "heading"):
        assert held[name] == carrier[name]
    assert held["spin"] == 0
    assert held["contact"] == 0
    assert other[0]["contact"].item() == 0


def test_a_dropped_body_goes_on_by_itself():
    robot = bodies({"vx": 4.0})
    ball = bodies({"carrier_kind": 0, "carrier": 0})
    motion = plane(("robots", GLIDER, robot), ("objects", GLIDER, ball))
    motion.move()
    ball[0]["carrier_kind"] = ball[0]["carrier"] = -1
    robot[0]["vx"] = 0.0
    motion.move()
    assert robot[0]["x"].item() == pytest.approx(4 * DT)
    assert ball[0]["x"].item() == pytest.approx(2.0 + 8 * DT)


@pytest.mark.parametrize("carrier", [(0, 1), (0, 7), (0, -1), (5, 0)])
def test_what_nobody_living_carries_is_put_down(carrier):
    robots = bodies({}, slots=2)
    ball = bodies({"x": 9.0, "vx": 3.0, "carrier_kind": carrier[0], "carrier": carrier[1]})
    plane(("robots", ROBOT, robots), ("objects", GLIDER, ball)).move()
    assert ball[0]["carrier_kind"].item() == ball[0]["carrier"].item() == -1
    assert ball[0]["x"].item() == pytest.approx(9.0 + 3.0 * DT)


def test_who_touches_a_body_and_a_border_has_run_into_the_border():
    crowd = bodies({"x": 9.5}, {"x": 8.0}, {"x": 6.5})
    plane(("crowd", Disc(meets=("crowd",)), crowd), half_width=10.0).move()
    assert crowd[0]["contact"].tolist() == [1, 2, 2]


def test_rows_may_be_written_between_ticks():
    robot, ball = bodies({"x": 0.0}), bodies({"x": 1.9})
    motion = plane(("robots", ROBOT, robot), ("objects", BALL, ball), half_width=20.0)
    motion.move()
    assert ball[0]["contact"].item() == 2
    ball[0]["x"], ball[0]["y"], ball[0]["vx"], ball[0]["vy"] = -7.0, 5.0, 0.0, 3.0
    robot[0]["angle"] = 1.0
    motion.move()
    speed = 3.0 / (1 + DT * BALL.linear_damping)
    assert [ball[0][name].item() for name in ("x", "y", "vx", "vy")] == pytest.approx(
        [-7.0, 5.0 + DT * speed, 0.0, speed], abs=1e-12
    )
    assert ball[0]["contact"].item() == robot[0]["contact"].item() == 0
    assert robot[0]["heading"].item() == pytest.approx(90 - math.degrees(1.0))


def test_the_dead_are_left_out_and_the_born_appear():
    robots = bodies({"x": 0.0}, slots=3)
    robots[0]["x"][1] = 1.5
    motion = plane(("robots", Disc(meets=("robots",)), robots))
    motion.move()
    assert robots[0]["contact"].tolist() == [0, 0, 0]
    robots[1][1] = True
    motion.move()
    assert robots[0]["contact"].tolist() == [2, 2, 0]
    robots[1][0] = False
    robots[0]["vx"][0] = 5.0
    before = robots[0][0].copy()
    robots[0]["x"][1] = robots[0]["x"][0]
    motion.move()
    assert robots[0][0] == before
    assert robots[0]["contact"][1] == 0


def test_a_population_may_move_to_larger_arrays():
    robots = population(*bodies({"vx": 3.0}))
    motion = PymunkMotion(0.0, DT, [Kind("robots", GLIDER, robots)])
    motion.build()
    motion.move()
    rows, robots.rows = robots.rows, bodies({}, {"x": 5.0, "vx": -3.0}, slots=8)[0]
    robots.rows[:1], robots.alive = rows, np.arange(8) < 2
    motion.move()
    assert robots.rows["x"][:2].tolist() == pytest.approx([6.0 * DT, 5.0 - 3.0 * DT])


def crowd(seed):
    """Twelve robots and eight balls that meet each other among ten obstacles."""
    rng = np.random.default_rng(seed)
    tables = []
    for number in (12, 8):
        table, alive = bodies(*[{}] * number)
        for name, most in (("x", 14.0), ("y", 14.0), ("angle", 3.0), ("vx", 9.0), ("vy", 9.0)):
            table[name] = rng.uniform(-most, most, number)
        tables.append((table, alive))
    obstacles = np.zeros(10, OBSTACLE)
    for name, low, high in (("x", -15, 15), ("y", -15, 15), ("angle", 0, 3), ("half_width", 1, 3)):
        obstacles[name] = rng.uniform(low, high, 10)
    obstacles["round"] = rng.integers(0, 2, 10)
    motion = plane(
        ("robots", Disc(meets=("robots", "objects")), tables[0]),
        ("objects", Disc(restitution=1.8, linear_damping=0.15, meets=("objects",)), tables[1]),
        half_width=15.0,
        obstacles=(obstacles, np.ones(10, bool)),
    )
    return motion, tables[0][0], tables[1][0]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("every", [1, 7])
def test_a_world_that_is_built_anew_goes_on_exactly_as_the_other(seed, every):
    """Nothing but the rows is remembered: not a contact, not the order of pymunk's shapes."""
    going, stopping = crowd(seed), crowd(seed)
    touched = 0
    for tick in range(150):
        force = np.random.default_rng([seed, tick // 30]).uniform(-150, 150, (3, 12))
        for motion, robots, _ in (going, stopping):
            robots["push_x"], robots["push_y"], robots["torque"] = force
            if motion is stopping[0] and tick % every == 0:
                motion.build()
            motion.move()
        touched += going[1]["contact"].sum()
        assert going[1].tobytes() == stopping[1].tobytes()
        assert going[2].tobytes() == stopping[2].tobytes()
    assert touched > 300


@pytest.mark.parametrize("seed", range(3))
def test_a_crowd_stays_in_the_arena(seed):
    motion, robots, objects = crowd(seed)
    for tick in range(200):
        force = np.random.default_rng([seed, tick // 30]).uniform(-150, 150, (3, 12))
        robots["push_x"], robots["push_y"], robots["torque"] = force
        motion.move()
        for table in (robots, objects):
            assert np.abs(table["x"]).max() <= 14.0
            assert np.abs(table["y"]).max() <= 14.0


# Refusals


def test_meeting_what_is_not_there_is_refused():
    with pytest.raises(ModelError, match="bodies 'robots' that meet 'objects'"):
        plane(("robots", ROBOT, bodies({})))


def test_more_kinds_than_pymunk_tells_apart_are_refused():
    many = [(f"kind{number}", Disc(), bodies({})) for number in range(MOST_KINDS + 1)]
    plane(*many[:-1])
    with pytest.raises(ModelError, match="32 populations of bodies"):
        plane(*many)


@pytest.mark.parametrize("name", ["x", "angle", "half_width"])
def test_an_obstacle_without_a_place_is_refused(name):
    with pytest.raises(ModelError, match="obstacle 1 at"):
        plane(obstacles=stones({}, {name: math.nan}))


@pytest.mark.parametrize("name", ["x", "vy", "push_x", "angle", "torque"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_numbers_that_are_none_are_refused_before_pymunk_sees_them(name, value):
    body = bodies({})
    motion = plane(("robots", Disc(), body))
    body[0][name] = value
    with pytest.raises(ModelError, match="agent 0 of 'robots', whose motion is not finite"):
        motion.move()
