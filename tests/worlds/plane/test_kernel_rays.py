"""Range finders of the compiled kernel against an evaluator in plain Python."""

import math

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import BALL, Disc
from socialmind.worlds.plane.kernel.arrays import Bodies, Eyes, Obstacles, PlaneArrays
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.layout import BODY, OBSTACLE, RAY

SENSORS = 12
ROW = np.dtype([("before", "i8"), *BODY.descr, ("readings", "f8", (SENSORS,))])


def bodies(count):
    rows = np.zeros(count, ROW)
    rows["carrier"] = rows["carrier_kind"] = -1
    rows["readings"] = -1.0
    return rows


def standard_rays():
    turns = [0, 0.5, *range(1, 8), 7.5]
    return np.array(
        [
            (math.cos(a), math.sin(a), math.cos(a + d), math.sin(a + d), 12.0, number)
            for number, a in enumerate(turn * math.pi / 4 for turn in turns)
            for d in (-math.radians(6), 0.0, math.radians(6))
        ],
        RAY,
    )


def along_outline(origin, direction, centre, arm):
    """Distance along a ray to a square, by its centre and half a side; 0 inside it."""
    inside = (origin - centre) / arm
    if max(abs(inside.real), abs(inside.imag)) < 1:
        return 0.0
    return along_sides(origin, direction, centre, arm)


def along_sides(origin, direction, centre, arm):
    corners = [centre + arm * complex(x, y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    sides = zip(corners, [*corners[1:], corners[0]], strict=True)
    return min(along_segment(origin, direction, one, two) for one, two in sides)


def along_segment(origin, direction, one, two):
    """Distance along a ray to a segment, by solving for where the lines cross; inf without."""
    side = two - one
    cross = direction.real * side.imag - direction.imag * side.real
    if cross == 0:
        return math.inf
    way = one - origin
    t = (way.real * side.imag - way.imag * side.real) / cross
    s = (way.real * direction.imag - way.imag * direction.real) / cross
    return t if t >= 0 and 0 <= s <= 1 else math.inf


def along_circle(origin, direction, centre, radius):
    way = origin - centre
    if abs(way) <= radius:
        return 0.0
    b = (way * direction.conjugate()).real
    c = abs(way) ** 2 - radius**2
    if b * b < c or b > 0:
        return math.inf
    return -b - math.sqrt(b * b - c)


def expected(rays, half_width, obstacles, circles, body):
    """The readings of a body, one ray after the other; circles are the seen bodies but itself."""
    turn = complex(math.cos(body["angle"]), math.sin(body["angle"]))
    place = complex(body["x"], body["y"])
    nearest = {}
    for ray in rays:
        origin = place + turn * complex(ray["x"], ray["y"])
        direction = turn * complex(ray["cos"], ray["sin"])
        found = [float(ray["reach"])]
        if half_width:
            if max(abs(origin.real), abs(origin.imag)) > half_width:
                found.append(0.0)
            found.append(along_sides(origin, direction, 0j, half_width))
        for stone in obstacles:
            centre, width = complex(stone["x"], stone["y"]), stone["half_width"]
            if stone["round"]:
                found.append(along_circle(origin, direction, centre, width))
                continue
            own = complex(math.cos(stone["angle"]), math.sin(stone["angle"]))
            found.append(along_outline(origin, direction, centre, own * width))
        found += [along_circle(origin, direction, *circle) for circle in circles]
        sensor = int(ray["sensor"])
        nearest[sensor] = min(nearest.get(sensor, 1.0), min(found) / ray["reach"])
    return nearest


def random_rays(rng):
    """Sensors of one to four rays, of different reaches, not all of the body's sensors."""
    rays = []
    for sensor in rng.permutation(SENSORS)[:7]:
        place, reach = rng.uniform(-1.5, 1.5, 2), rng.uniform(1, 20)
        angles = rng.uniform(-math.pi, math.pi, rng.integers(1, 5))
        rays += [(*place, math.cos(one), math.sin(one), reach, sensor) for one in angles]
    return np.array(rays, RAY)


@pytest.mark.parametrize("seed", range(60))
def test_readings_are_those_of_plain_python(seed):
    rng = np.random.default_rng(seed)
    half_width = (0.0, 25.0, 40.0)[seed % 3]
    obstacles = np.zeros(30, OBSTACLE)
    for name in ("x", "y"):
        obstacles[name] = rng.uniform(-30, 30, 30)
    obstacles["angle"], obstacles["round"] = rng.uniform(-4, 4, 30), rng.integers(0, 2, 30)
    obstacles["angle"][:5] = np.arange(5) * math.pi / 2  # rays along sides, too
    obstacles["half_width"] = rng.uniform(0.2, 3, 30)
    standing = rng.random(30) < 0.8
    robots, balls = bodies(12), bodies(6)
    for rows in (robots, balls):
        for name in ("x", "y"):
            rows[name] = rng.uniform(-25, 25, len(rows))
        rows["angle"] = rng.uniform(-math.pi, math.pi, len(rows))
    robots["angle"][:3] = 0.0, math.pi / 2, -math.pi
    balls["carrier_kind"][:2], balls["carrier"][:2] = 0, 1
    alive = rng.random(12) < 0.8
    seen = Disc(radius=0.7, seen=bool(seed % 2))
    rays = standard_rays() if seed % 4 == 0 else random_rays(rng)
    eyes = Eyes(0, rays, ROW.fields["readings"][1] - 8)
    kinds = [
        Bodies("robots", Disc(), robots, alive, 8),
        Bodies("balls", seen, balls, np.ones(6, np.bool_), 8),
    ]
    cell = (3.0, 10.0, 200.0)[seed // 3 % 3]
    arrays = PlaneArrays(half_width, 1 / 30, cell, kinds, Obstacles(obstacles, standing, 0), [eyes])
    arrays.build()
    untouched = robots.copy()
    assert kernel().look.ctypes(arrays.address, eyes.address, 0) == 0
    for slot, robot in enumerate(robots):
        if not alive[slot]:
            assert robot == untouched[slot]
            continue
        circles = [
            (complex(one["x"], one["y"]), 1.0)
            for other, one in enumerate(robots)
            if alive[other] and other != slot
        ]
        if seen.seen:
            circles += [(complex(one["x"], one["y"]), 0.7) for one in balls[2:]]
        wanted = expected(rays, half_width, obstacles[standing], circles, robot)
        for sensor in range(SENSORS):
            reading = wanted.get(sensor, -1.0)  # others are left alone
            assert robot["readings"][sensor] == pytest.approx(reading, abs=1e-9)


def test_nothing_in_reach_reads_one_and_a_square_ahead_its_distance():
    robots = bodies(2)
    robots["y"] = 0.0, 50.0
    obstacles = np.zeros(1, OBSTACLE)
    obstacles["x"], obstacles["half_width"] = 9.0, 2.0
    eyes = Eyes(0, standard_rays(), ROW.fields["readings"][1] - 8)
    kinds = [Bodies("robots", Disc(), robots, np.ones(2, np.bool_), 8)]
    arrays = PlaneArrays(
        0.0, 1 / 30, 5.0, kinds, Obstacles(obstacles, np.ones(1, np.bool_), 0), [eyes]
    )
    arrays.build()
    kernel().look.ctypes(arrays.address, eyes.address, 0)
    assert robots["readings"][1, :10].tolist() == [1.0] * 10
    assert robots["readings"][0, 0] == pytest.approx(0.5)  # 7 from the centre, 6 from the rim
    assert robots["readings"][0, 2:9].tolist() == [1.0] * 7


def read_alone(body, ray, obstacles=(), half_width=0.0, circle=None):
    """What one ray (x, y, cos, sin) of reach 12 of a body (x, y, angle) reads."""
    robots, balls = bodies(1), bodies(1)
    robots["x"], robots["y"], robots["angle"] = body
    balls["x"], balls["y"] = circle or (0.0, 0.0)
    stones = np.zeros(len(obstacles), OBSTACLE)
    for row, one in zip(stones, obstacles, strict=True):
        row["x"], row["y"], row["angle"], row["half_width"] = one
    eyes = Eyes(0, np.array([(*ray, 12.0, 0)], RAY), ROW.fields["readings"][1] - 8)
    kinds = [
        Bodies("robots", Disc(), robots, np.ones(1, np.bool_), 8),
        Bodies("balls", Disc(), balls, np.array([circle is not None]), 8),
    ]
    standing = Obstacles(stones, np.ones(len(stones), np.bool_), 0)
    arrays = PlaneArrays(half_width, 1 / 30, 5.0, kinds, standing, [eyes])
    arrays.build()
    kernel().look.ctypes(arrays.address, eyes.address, 0)
    return robots["readings"][0, 0]


@pytest.mark.parametrize(("cos", "sin"), [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])
def test_rays_along_the_sides_of_a_square(cos, sin):
    ray = (0.0, 0.0, cos, sin)
    ahead = (8 * cos, 8 * sin, 0.0, 2.0)
    beside = (8 * cos - 3 * sin, 8 * sin + 3 * cos, 0.0, 2.0)
    behind = (-8 * cos, -8 * sin, 0.0, 2.0)
    assert read_alone((0, 0, 0), ray, [ahead]) == pytest.approx(6 / 12)
    assert read_alone((0, 0, 0), ray, [beside, behind]) == 1.0
    assert read_alone((0, 0, 0), ray, [(0.5, 0.5, 0.0, 2.0)]) == 0.0


def test_what_a_ray_just_touches_is_seen():
    assert read_alone((0, 0, 0), (0, 0, 1.0, 0.0), circle=(6.0, 1.0)) == 6 / 12
    assert read_alone((0, 0, 0), (0, 0, 1.0, 0.0), circle=(6.0, 1.001)) == 1.0
    slope = math.sqrt(0.5)
    corner = [(6.0, 4.0, 0.0, 1.0)]
    assert read_alone((0, 0, 0), (0, 0, slope, slope), corner) == pytest.approx(5 / slope / 12)
    assert read_alone((0, 0, 0), (0, 0, slope, slope), [(6.0, 3.999, 0.0, 1.0)]) == 1.0


def test_on_the_border_itself_all_rays_read_nothing_left():
    for cos, sin in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)):
        assert read_alone((9, 0, 0), (1.0, 0.0, cos, sin), half_width=10.0) == 0.0
    assert read_alone((8, 0, 0), (1.0, 0.0, 0.0, 1.0), half_width=10.0) == pytest.approx(10 / 12)


def test_balls_that_are_not_made_to_be_seen_are_not():
    robots, balls = bodies(1), bodies(1)
    balls["x"] = 4.0
    eyes = Eyes(0, standard_rays(), ROW.fields["readings"][1] - 8)
    for disc, reading in ((BALL, 1.0), (Disc(), 2 / 12)):
        kinds = [
            Bodies("robots", Disc(), robots, np.ones(1, np.bool_), 8),
            Bodies("balls", disc, balls, np.ones(1, np.bool_), 8),
        ]
        arrays = PlaneArrays(0.0, 1 / 30, 5.0, kinds, None, [eyes])
        kernel().look.ctypes(arrays.address, eyes.address, 0)
        assert robots["readings"][0, 0] == pytest.approx(reading)


def test_eyes_are_checked():
    apart = standard_rays()
    apart["sensor"] = np.arange(30) % 10
    with pytest.raises(ModelError, match="apart"):
        Eyes(0, apart, 0)
    uneven = standard_rays()
    uneven["reach"][1] = 5.0
    with pytest.raises(ModelError, match="reaches"):
        Eyes(0, uneven, 0)
    with pytest.raises(ModelError, match="without a ray"):
        Eyes(0, standard_rays()[:0], 0)
