"""The two engines of a plane move alike: the compiled kernel and pymunk, from the same rows.

What is held here, in units and units a second:

- Free motion and carried bodies, single contacts (a wall, a side or corner of a square, a cylinder,
  another body) and the two borders of the arena's corner: `SAME`, which is rounding, for positions
  and velocities; who is in contact is equal.
- Runs in which a robot touches one thing at a time: `RUN`, as impacts at round things enlarge
  rounding.
- Several contacts at once are the one thing that each engine solves in its own way, pymunk all
  together and the kernel one after the other. From the same rows they still agree on who is in
  contact; a robot wedged between two obstacles stands within `WEDGED` of the other engine's.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from socialmind import Model, Population, each
from socialmind.errors import ModelError
from socialmind.worlds.plane import Plane
from socialmind.worlds.plane.bodies import BALL, Body, Disc, Obstacle, Robot
from socialmind.worlds.plane.kernel.arrays import Bodies, Obstacles, PlaneArrays
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.layout import BODY, OBSTACLE, SETTLING
from socialmind.worlds.plane.pymunk_motion import Kind, PymunkMotion

DT = 1 / 30
SAME = 1e-9
RUN = 1e-6
WEDGED = 0.1
ROBOT = Disc(meets=("objects",))
FIELDS = ("x", "y", "angle", "vx", "vy", "spin")


class Twins:
    """One world twice, moved by either engine.

    `pymunk` and `compiled` hold the rows of each population.
    """

    def __init__(self, *populations, half_width=0.0, obstacles=None):
        stones = np.zeros(0, OBSTACLE) if obstacles is None else obstacles
        standing = np.ones(len(stones), bool)
        self.pymunk = [rows.copy() for _, _, rows in populations]
        self.compiled = [rows.copy() for _, _, rows in populations]
        self.alive = [np.ones(len(rows), bool) for rows in self.pymunk]
        kinds, bodies = [], []
        for number, (name, disc, _) in enumerate(populations):
            alive = self.alive[number]
            table = SimpleNamespace(rows=self.pymunk[number], alive=alive)
            kinds.append(Kind(name, disc, table))
            bodies.append(Bodies(name, disc, self.compiled[number], alive, 0))
        fixed = SimpleNamespace(rows=stones, alive=standing)
        self.motion = PymunkMotion(half_width, DT, kinds, fixed)
        self.arrays = PlaneArrays(half_width, DT, 6.0, bodies, Obstacles(stones, standing, 0))
        self.motion.build()
        self.arrays.build()

    def move(self):
        self.motion.move()
        assert kernel().move.ctypes(self.arrays.address, 0, 0) == 0

    def drive(self, forward, torque):
        """Push the first population ahead; numbers, or an array of one for each."""
        for rows in (self.pymunk[0], self.compiled[0]):
            rows["push_x"] = forward * np.cos(rows["angle"])
            rows["push_y"] = forward * np.sin(rows["angle"])
            rows["torque"] = torque

    def agree(self):
        """Start the next tick from the same rows."""
        for ours, theirs in zip(self.pymunk, self.compiled, strict=True):
            theirs[:] = ours

    def apart(self, fields=FIELDS):
        """The largest difference."""
        return max(
            np.abs(ours[name] - theirs[name]).max()
            for ours, theirs in zip(self.pymunk, self.compiled, strict=True)
            for name in fields
        )

    def touching(self):
        """Who is in contact, on which the engines agree."""
        for ours, theirs in zip(self.pymunk, self.compiled, strict=True):
            assert ours["contact"].tolist() == theirs["contact"].tolist()
        return [rows["contact"].tolist() for rows in self.pymunk]


def bodies(*rows):
    table = np.zeros(len(rows), BODY)
    table["carrier_kind"] = table["carrier"] = -1
    for slot, row in enumerate(rows):
        for name, value in row.items():
            table[name][slot] = value
    return table


def stones(*rows):
    table = np.zeros(len(rows), OBSTACLE)
    for slot, row in enumerate(rows):
        for name, value in row.items():
            table[name][slot] = value
    return table


def on_neither_side_of_settling(approach):
    """Leave out impacts of which rounding decides whether they bounce."""
    assume(abs(approach - SETTLING) > SAME)


# Without contacts


@given(
    disc=st.builds(
        Disc,
        radius=st.floats(0.2, 3.0),
        density=st.floats(0.5, 4.0),
        linear_damping=st.floats(0.0, 10.0),
        angular_damping=st.floats(0.0, 30.0),
    ),
    state=st.tuples(*[st.floats(-90.0, 90.0)] * 5),
    push=st.tuples(*[st.floats(-300.0, 300.0)] * 3),
)
@settings(max_examples=50)
def test_free_motion(disc, state, push):
    row = dict(zip(("x", "y", "vx", "vy", "spin"), state, strict=True))
    row |= dict(zip(("push_x", "push_y", "torque"), push, strict=True))
    world = Twins(("robots", disc, bodies(row)))
    for _ in range(20):
        world.move()
        ours, theirs = world.pymunk[0], world.compiled[0]
        # An angle may be just below π here and -π there.
        turn = math.remainder(ours["angle"].item() - theirs["angle"].item(), 2 * math.pi)
        assert abs(turn) <= SAME
        aside = (ours["heading"] - theirs["heading"]).item()
        assert abs(math.remainder(aside, 360.0)) <= SAME
        assert world.apart(("x", "y", "vx", "vy", "spin")) <= SAME
        assert world.touching() == [[0]]


def test_carried_bodies_and_such_whose_carrier_died():
    held = {"carrier_kind": 0, "carrier": 1, "vx": 4.0, "spin": 1.0}
    world = Twins(
        ("robots", ROBOT, bodies({}, {"x": 6.0, "angle": 2.5}, {"x": -6.0})),
        ("objects", BALL, bodies(held, held | {"carrier": 2}, {"x": 0.0, "y": 2.0})),
        half_width=10.0,
    )
    for tick in range(40):
        if tick == 20:
            world.alive[0][2] = False
        world.drive(120.0, 30.0)
        world.move()
        assert world.apart((*FIELDS, "carrier", "carrier_kind")) <= SAME
        world.touching()
    assert world.pymunk[1]["carrier"].tolist() == [1, -1, -1]


# One contact


@given(
    side=st.integers(0, 3),
    speed=st.tuples(st.floats(0.0, 50.0), st.floats(-20.0, 20.0)),
    restitution=st.sampled_from([0.0, 0.5, 1.0, 1.8]),
    deep=st.floats(0.001, 1.5),
)
@settings(max_examples=50)
def test_a_wall(side, speed, restitution, deep):
    on_neither_side_of_settling(speed[0])
    c, s = math.cos(side * math.pi / 2), math.sin(side * math.pi / 2)
    out = 9.0 + deep - DT * speed[0]
    body = bodies(
        {"x": c * out, "y": s * out,
         "vx": c * speed[0] - s * speed[1], "vy": s * speed[0] + c * speed[1]}
    )  # fmt: skip
    disc = Disc(linear_damping=0.0, restitution=restitution)
    world = Twins(("robots", disc, body), half_width=10.0)
    world.move()
    assert world.touching() == [[1]]
    assert world.apart() <= SAME


@given(
    angle=st.floats(-3.0, 3.0),
    half_width=st.floats(0.5, 3.0),
    bearing=st.floats(-3.1, 3.1),
    deep=st.floats(0.01, 0.9),
    round_one=st.booleans(),
    speed=st.tuples(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0)),
    restitution=st.sampled_from([0.0, 0.5, 1.8]),
)
@settings(max_examples=200)
def test_a_square_from_any_side_or_corner_and_a_cylinder(
    angle, half_width, bearing, deep, round_one, speed, restitution
):
    c, s = math.cos(bearing), math.sin(bearing)
    rim = half_width if round_one else half_width / max(abs(c), abs(s))
    reach = rim + 1.0 - deep  # overlaps, the centre mostly outside
    ahead, left = math.cos(angle), math.sin(angle)
    x, y = 4.0 + reach * (c * ahead - s * left), -7.0 + reach * (c * left + s * ahead)
    body = bodies({"x": x - DT * speed[0], "y": y - DT * speed[1], "vx": speed[0], "vy": speed[1]})
    stone = stones(
        {"x": 4.0, "y": -7.0, "angle": angle, "half_width": half_width, "round": round_one}
    )
    disc = Disc(linear_damping=0.0, restitution=restitution)
    world = Twins(("robots", disc, body), obstacles=stone)
    world.move()
    if world.touching() == [[1]]:
        out = world.pymunk[0]["x"].item() - x, world.pymunk[0]["y"].item() - y
        on_neither_side_of_settling(-(speed[0] * out[0] + speed[1] * out[1]) / math.hypot(*out))
    assert world.apart() <= SAME


def test_a_square_around_a_bodys_centre():
    rng = np.random.default_rng(3)
    for _ in range(100):
        half, angle = rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)
        u, v = rng.uniform(-half, half, 2)
        c, s = math.cos(angle), math.sin(angle)
        world = Twins(
            ("robots", Disc(), bodies({"x": u * c - v * s, "y": u * s + v * c})),
            obstacles=stones({"angle": angle, "half_width": half}),
        )
        world.move()
        assert world.touching() == [[1]]
        assert world.apart() <= SAME


@given(
    bearing=st.floats(-3.1, 3.1),
    distance=st.floats(0.2, 2.0),
    velocities=st.tuples(*[st.floats(-20.0, 20.0)] * 4),
    sizes=st.tuples(*[st.floats(0.5, 2.0)] * 4),
    restitutions=st.tuples(*[st.sampled_from([0.0, 0.5, 1.8])] * 2),
)
@settings(max_examples=100)
def test_two_bodies(bearing, distance, velocities, sizes, restitutions):
    one = Disc(sizes[0], sizes[1], 0.0, restitution=restitutions[0], meets=("objects",))
    other = Disc(sizes[2], sizes[3], 0.0, restitution=restitutions[1])
    apart = distance * (sizes[0] + sizes[2]) / 2
    vx, vy = velocities[2] - velocities[0], velocities[3] - velocities[1]
    x, y = apart * math.cos(bearing) + DT * vx, apart * math.sin(bearing) + DT * vy
    on_neither_side_of_settling(-(vx * x + vy * y) / math.hypot(x, y))
    world = Twins(
        ("robots", one, bodies({"vx": velocities[0], "vy": velocities[1]})),
        ("objects", other, bodies({
            "x": apart * math.cos(bearing), "y": apart * math.sin(bearing),
            "vx": velocities[2], "vy": velocities[3],
        })),
    )  # fmt: skip
    for _ in range(3):
        world.move()
        world.touching()
        assert world.apart() <= SAME


@pytest.mark.parametrize("aside", [0.0, 0.2, 0.6])
def test_a_robot_plays_a_ball_against_a_wall(aside):
    world = Twins(
        ("robots", ROBOT, bodies({})),
        ("objects", BALL, bodies({"x": 6.0, "y": aside})),
        half_width=10.0,
    )
    hits = 0
    for _ in range(200):
        world.drive(160.0, 0.0)
        world.move()
        hits += sum(map(sum, world.touching()))
        assert world.apart() <= SAME
    assert hits > 5


@pytest.mark.parametrize("to", [(9.5, 9.5), (-9.2, 9.9), (10.0, -11.0)])
def test_the_corner_of_the_arena(to):
    body = {"x": to[0], "y": to[1], "vx": 10 * to[0] / abs(to[0]), "vy": 8 * to[1] / abs(to[1])}
    world = Twins(("robots", Disc(restitution=0.5), bodies(body)), half_width=10.0)
    for _ in range(10):
        world.move()
        world.touching()
        assert world.apart() <= SAME


# Runs


def field_of_stones(rng):
    """Obstacles so far from each other and from the borders that a robot meets one at a time."""
    grid = np.arange(36)
    table = np.zeros(36, OBSTACLE)
    table["x"] = -45 + 18 * (grid % 6) + rng.uniform(-1, 1, 36)
    table["y"] = -45 + 18 * (grid // 6) + rng.uniform(-1, 1, 36)
    table["half_width"] = rng.uniform(1, 3, 36)
    table["angle"] = rng.uniform(0, math.pi, 36)
    table["round"] = rng.random(36) < 0.3
    return table


def wander(world, seed, ticks):
    """Move by pushes that change every 40 ticks; yield after each tick."""
    number = len(world.pymunk[0])
    for tick in range(ticks):
        rng = np.random.default_rng([seed, tick // 40])
        world.drive(rng.uniform(20, 160, number), rng.uniform(-60, 60, number))
        world.move()
        yield tick


@given(seed=st.integers(0, 10_000))
@settings(max_examples=25)
def test_robots_among_obstacles_run_alike(seed):
    rng = np.random.default_rng(seed)
    robots = bodies(*[{}] * 4)
    for name, most in (("x", 50), ("y", 50), ("angle", 3)):
        robots[name] = rng.uniform(-most, most, 4)
    world = Twins(
        ("robots", Disc(), robots), half_width=54.0, obstacles=field_of_stones(rng)
    )  # fmt: skip
    for _ in wander(world, seed, 120):
        assert world.apart(("x", "y", "vx", "vy")) <= RUN
        world.touching()


def test_runs_among_obstacles_do_touch_them():
    rng = np.random.default_rng(0)
    robots = bodies(*[{}] * 20)
    for name, most in (("x", 50), ("y", 50), ("angle", 3)):
        robots[name] = rng.uniform(-most, most, 20)
    world = Twins(("robots", Disc(), robots), half_width=54.0, obstacles=field_of_stones(rng))
    assert sum(sum(world.touching()[0]) for _ in wander(world, 0, 200)) > 100


# Several contacts at once


@pytest.mark.parametrize("angle", [0.2, 0.6, 1.0, 1.4])
def test_a_robot_wedged_between_two_squares(angle):
    squares = stones(
        {"x": 8.0, "y": 6.0, "half_width": 5.0, "angle": angle},
        {"x": 8.0, "y": -6.0, "half_width": 5.0, "angle": -angle},
    )
    world = Twins(("robots", Disc(), bodies({})), obstacles=squares)
    touched = 0
    for _ in range(200):
        for rows in (world.pymunk[0], world.compiled[0]):
            rows["push_x"], rows["push_y"] = 160.0, 20.0
        world.move()
        touched += world.pymunk[0]["contact"].item()
        assert world.apart(("x", "y")) <= WEDGED
    assert touched > 50


def crowd(seed):
    """Robots and balls in a small arena with obstacles that may overlap each other."""
    rng = np.random.default_rng(seed)
    populations = []
    for _ in range(2):
        table = bodies(*[{}] * 6)
        for name, most in (("x", 14), ("y", 14), ("angle", 3)):
            table[name] = rng.uniform(-most, most, 6)
        populations.append(table)
    obstacles = np.zeros(10, OBSTACLE)
    for name, low, high in (("x", -15, 15), ("y", -15, 15), ("angle", 0, 3), ("half_width", 1, 3)):
        obstacles[name] = rng.uniform(low, high, 10)
    obstacles["round"] = rng.random(10) < 0.3
    return Twins(
        ("robots", ROBOT, populations[0]),
        ("objects", BALL, populations[1]),
        half_width=15.0,
        obstacles=obstacles,
    )


@pytest.mark.parametrize("seed", range(5))
def test_in_a_crowd_the_engines_agree_on_who_touches(seed):
    world = crowd(seed)
    same = []
    for tick in wander(world, seed, 200):
        world.touching()
        for rows in (*world.pymunk, *world.compiled):
            assert np.abs(rows["x"]).max() <= 14.0 + SAME
            assert np.abs(rows["y"]).max() <= 14.0 + SAME
        if tick >= 30:  # what started inside obstacles is out of them
            for ours, theirs in zip(world.pymunk, world.compiled, strict=True):
                gaps = [np.abs(ours[name] - theirs[name]) for name in ("x", "y", "vx", "vy")]
                same += (np.max(gaps, axis=0) <= SAME).tolist()
        world.agree()
    assert np.mean(same) > 0.8


# In a model


class Rover(Robot):
    touched: int = 0


class Ball(Body):
    pass


def lay(obstacle, rng):
    obstacle.x = rng.uniform(-30, 30)
    obstacle.y = rng.uniform(-30, 30)
    obstacle.angle = rng.uniform(0, 3)
    obstacle.half_width = rng.uniform(1, 3)


def place(body, rng):
    body.x = rng.uniform(-30, 30)
    body.y = rng.uniform(-30, 30)
    body.angle = rng.uniform(-3, 3)


def rove(rover, rng):
    rover.touched += rover.contact
    forward = rng.uniform(50, 160)
    rover.push_x = forward * math.cos(rover.angle)
    rover.push_y = forward * math.sin(rover.angle)
    rover.torque = rng.uniform(-60, 60)


class Field(Model):
    ticks = 1000
    world = Plane(35.0)
    obstacles = Population(Obstacle, 12)
    balls = Population(Ball, 2, body=BALL)
    rovers = Population(Rover, 3, body=Disc(meets=("balls",)))
    setup = (each(obstacles, lay), each(balls, place), each(rovers, place))
    schedule = (each(rovers, rove),)


def test_a_model_chooses_its_engine():
    one, other = (Field(seed=2, physics=name, compiled=False) for name in ("pymunk", "compiled"))
    for model in (one, other):
        model.advance(200)
    assert isinstance(one.ground.motion, PymunkMotion)
    assert one.rovers.touched.tolist() == other.rovers.touched.tolist()
    assert one.rovers.touched.sum() > 10
    for name in ("x", "y", "angle", "vx", "vy"):
        assert np.abs(getattr(one.rovers, name) - getattr(other.rovers, name)).max() <= RUN


# Degenerate shapes: who cannot be told apart, nothing, and next to nothing


SIZES = st.one_of(
    st.sampled_from([0.0, 1e-12, 1e-9, 1e-6, 0.3, 1.0, 2.0, 1e3, 1e6]), st.floats(0.0, 10.0)
)
PARTS = st.one_of(st.sampled_from([0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 1.5]), st.floats(-1.2, 1.2))


def finite(world):
    """No number is none."""
    for rows in (*world.pymunk, *world.compiled):
        assert all(np.isfinite(rows[name]).all() for name in (*FIELDS, "heading"))
    return True


@given(
    half=SIZES,
    place=st.tuples(PARTS, PARTS),
    angle=st.one_of(st.sampled_from([0.0, 0.5, math.pi / 4, -math.pi / 2]), st.floats(-3.0, 3.0)),
    round_one=st.booleans(),
    radius=st.sampled_from([1e-3, 0.5, 1.0]),
    speed=st.tuples(*[st.sampled_from([0.0, 3.0, -20.0])] * 2),
)
@example(  # on the line of a side, where pymunk alone takes another way out
    half=0.3, place=(-1.125, 1.0), angle=0.0, round_one=False, radius=0.5, speed=(0.0, 0.0)
)
@example(half=2.0, place=(1.0, 1.125), angle=0.5, round_one=False, radius=1.0, speed=(0.0, 0.0))
@settings(max_examples=300)
def test_anywhere_in_an_obstacle_of_any_size(half, place, angle, round_one, radius, speed):
    u, v = half * place[0], half * place[1]
    c, s = (1.0, 0.0) if angle == 0.0 else (math.cos(angle), math.sin(angle))
    x, y = u * c - v * s, u * s + v * c
    middle = u == v == 0.0
    # Where rounding alone tells the nearer of two sides, or any, either may be right; and pymunk
    # does not see the sides of what is much smaller than the body.
    still = speed == (0.0, 0.0)
    assume(middle or half >= 0.01)
    assume(still if middle else (still and angle == 0.0) or abs(abs(u) - abs(v)) > 1e-6 * half)
    body = bodies({"x": x - DT * speed[0], "y": y - DT * speed[1], "vx": speed[0], "vy": speed[1]})
    stone = stones({"angle": angle, "half_width": half, "round": round_one})
    world = Twins(("robots", Disc(radius, linear_damping=0.0), body), obstacles=stone)
    world.move()
    assert finite(world)
    world.touching()
    assert world.apart() <= SAME * max(1.0, half)


@pytest.mark.parametrize("angle", [0.0, 0.5, -2.0])
@pytest.mark.parametrize("half", [1e-12, 0.3, 2.0, 1e6])
def test_the_middle_of_a_square_is_left_ahead(angle, half):
    stone = stones({"angle": angle, "half_width": half})
    world = Twins(("robots", Disc(), bodies({})), obstacles=stone)
    world.move()
    assert world.touching() == [[1]]
    assert world.apart() <= SAME * max(1.0, half)
    # Ahead or back, as the sign of nothing has it.
    ahead = math.cos(angle) * world.pymunk[0]["x"] + math.sin(angle) * world.pymunk[0]["y"]
    assert abs(ahead.item()) == pytest.approx(half + 1.0)


@pytest.mark.parametrize("half", [0.0, -0.0])
@pytest.mark.parametrize("round_one", [0, 1])
def test_an_obstacle_of_half_width_0_is_nothing(half, round_one):
    stone = stones({"half_width": half, "round": round_one})
    world = Twins(("robots", Disc(), bodies({"x": 0.5})), obstacles=stone)
    world.move()
    assert world.touching() == [[0]] and world.apart() == 0.0


@pytest.mark.parametrize(
    "numbers",
    [{"half_width": -1.0}, {"half_width": math.nan}, {"half_width": math.inf}, {"x": math.nan},
     {"half_width": 1e12}, {"y": -1e200}, {"angle": math.inf}, {"half_width": -1e-300}],
)  # fmt: skip
@pytest.mark.parametrize("round_one", [0, 1])
def test_an_obstacle_that_is_none_is_refused_by_both(numbers, round_one):
    stone = stones({"half_width": 1.0}, {"half_width": 1.0, "round": round_one} | numbers)
    standing = np.ones(2, bool)
    expected = "found obstacle 1 at .*; expected numbers up to a thousand million, and a half-width"
    motion = PymunkMotion(0.0, DT, [], SimpleNamespace(rows=stone, alive=standing))
    with pytest.raises(ModelError, match=expected):
        motion.build()
    with pytest.raises(ModelError, match=expected):
        PlaneArrays(0.0, DT, 6.0, [], Obstacles(stone, standing, 0)).build()


@pytest.mark.parametrize("velocity", [0.0, 3.0, -3.0])
@pytest.mark.parametrize("masses", [(2.0, 2.0), (0.5, 4.0)])
def test_two_bodies_at_one_place_part_alike(velocity, masses):
    one, other = (Disc(density=density, linear_damping=0.0, meets=("robots", "objects"))
                  for density in masses)  # fmt: skip
    here = {"x": 3.0 - DT * velocity, "vx": velocity}
    for order in (1, -1):
        kinds = [("robots", one, bodies(here)), ("objects", other, bodies({"x": 3.0}))][::order]
        world = Twins(*kinds)
        world.move()
        assert finite(world) and world.touching() == [[2], [2]]
        assert world.apart() <= SAME
        # Who comes first goes to the left.
        assert world.pymunk[1]["x"] - world.pymunk[0]["x"] == pytest.approx(2.0)
    same = Twins(("robots", Disc(meets=("robots",)), bodies(here, {"x": 3.0})))
    same.move()
    assert same.touching() == [[2, 2]] and same.apart() <= SAME


@given(
    half_width=st.floats(1.5, 6.0),
    shapes=st.lists(
        st.tuples(SIZES, PARTS, PARTS, st.floats(-3.0, 3.0), st.integers(0, 1)), max_size=4
    ),
    places=st.lists(st.tuples(PARTS, PARTS), min_size=1, max_size=4),
)
@settings(max_examples=100)
def test_wherever_there_is_no_room_no_number_is_lost(half_width, shapes, places):
    stone = stones(*(
        {"half_width": half, "x": x * half_width, "y": y * half_width, "angle": angle, "round": one}
        for half, x, y, angle, one in shapes
    ))  # fmt: skip
    body = bodies(*({"x": x * half_width, "y": y * half_width, "vx": 9.0} for x, y in places))
    crowd = Disc(meets=("robots",), restitution=1.8)
    world = Twins(("robots", crowd, body), half_width=half_width, obstacles=stone)
    for _ in range(5):
        world.drive(100.0, 10.0)
        world.move()
        assert finite(world)
        for rows in (world.pymunk[0], world.compiled[0]):
            assert (np.abs(rows["x"]) <= half_width).all()
            assert (np.abs(rows["y"]) <= half_width).all()


@pytest.mark.parametrize("speed", [1e10, 1e160, 1e300])
def test_no_speed_is_too_large(speed):
    world = Twins(("robots", Disc(), bodies({"vx": speed, "vy": -speed})), half_width=10.0)
    world.move()
    assert finite(world) and world.apart() <= SAME
    assert math.hypot(world.pymunk[0]["vx"][0], world.pymunk[0]["vy"][0]) == pytest.approx(60.0)
