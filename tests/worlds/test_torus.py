"""The torus has NetLogo's geometry."""

import hashlib
import math
import struct
from types import SimpleNamespace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from socialmind.worlds.torus import geometry as torus
from socialmind.worlds.torus.patches import Grid

sizes = st.integers(1, 40)
inside = st.floats(0, 1, exclude_max=True)
anywhere = st.floats(-1e6, 1e6)


def world_of(size):
    return Grid({}, size)


def turtle(x=0.0, y=0.0, heading=0.0):
    return SimpleNamespace(x=x, y=y, heading=heading)


def placed(world, u, v, heading=0.0):
    """An agent at shares u and v of the world's sides."""
    edge = world.low - 0.5
    return turtle(edge + u * world.size, edge + v * world.size, heading)


def far(world, agent, x, y):
    """The distance by brute force, over all copies of the world."""
    s = world.size
    return min(
        math.hypot(x + i * s - agent.x, y + j * s - agent.y) for i in (-1, 0, 1) for j in (-1, 0, 1)
    )


def test_the_default_world_is_netlogos():
    world = world_of(33)
    assert (world.low, world.high) == (-16, 16)
    assert world_of(4).low == -2
    assert world_of(4).high == 1


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0, 0), (16.4, 16.4), (16.5, -16.5), (17, -16), (-16.5, -16.5), (-16.6, 16.4), (83, -16)],
)
def test_what_leaves_on_one_side_comes_back_on_the_other(value, expected):
    assert torus.wrapped(value, -16, 33) == pytest.approx(expected)


@pytest.mark.parametrize(("edge", "size"), [(-1.5, 3), (-3.5, 7), (-5.5, 11), (-19.5, 39)])
def test_a_hair_below_the_far_edge_of_a_copy_is_in_the_world(edge, size):
    for copy in range(1, 60):
        value = math.nextafter(edge + size * copy, -math.inf)
        found = torus.wrapped(value, -(size // 2), size)
        assert edge <= found < edge + size


@given(st.floats(-1e15, 1e15), sizes)
def test_every_coordinate_is_brought_back_into_the_world(value, size):
    low = -(size // 2)
    found = torus.wrapped(value, low, size)
    assert low - 0.5 <= found < low - 0.5 + size
    rounds = (value - found) / size
    assert abs(rounds - round(rounds)) * size <= 1e-9 * max(1.0, abs(value))


@given(inside, sizes)
def test_a_coordinate_in_the_world_stays_as_it_is(u, size):
    low = -(size // 2)
    value = low - 0.5 + u * size
    assume(value < low - 0.5 + size)
    assert torus.wrapped(value, low, size) == value


@given(st.floats(-1e6, 1e6), sizes)
def test_the_short_way_is_at_most_half_the_world(difference, size):
    short = torus.short_way(difference, size)
    assert abs(short) <= size / 2 + 1e-9
    rounds = (difference - short) / size
    assert abs(rounds - round(rounds)) < 1e-6


def test_the_short_way_by_hand():
    # Half the world away both ways are as long: it keeps the sign.
    found = [torus.short_way(one, 33) for one in (16.5, -16.5, 16.6, -16.6, 33.0, -33.0, 70.0)]
    assert found == pytest.approx([16.5, -16.5, -16.4, 16.4, 0.0, 0.0, 4.0])


def test_the_arc_tangent_is_right_to_the_last_bits():
    # In the first eighth nothing is added that could hide an error.
    for step in range(1, 1001):
        share = step / 1000
        right = math.degrees(math.atan2(share, 1.0))
        assert torus.compass(share, 1.0) == pytest.approx(right, rel=6e-16, abs=0)
        assert torus.compass(1.0, share) == pytest.approx(90.0 - right, rel=6e-16, abs=0)
    assert torus.compass(1.0, 1.0) == 45.0
    # And they are the same bits for ever, or recorded runs would not repeat.
    bits = b"".join(struct.pack("<d", torus.compass(step / 1000, 1.0)) for step in range(1001))
    assert hashlib.sha256(bits).hexdigest()[:16] == "b91a7073259d0d28"


def test_a_hair_west_of_north_is_north():
    assert torus.compass(-1e-20, 1.0) == 0.0
    assert torus.compass(-1e-13, 1.0) == pytest.approx(360.0) and torus.compass(-1e-13, 1.0) < 360.0


def test_faces_the_short_way_round():
    world = world_of(33)
    agent = turtle(15, 0)
    torus.face(world, agent, -15, 0)
    assert agent.heading == 90  # east, over the edge
    assert torus.distance(world, agent, -15, 0) == 3
    torus.face(world, agent, 15, -16)
    assert agent.heading == 180
    torus.face(world, agent, 12, 3)
    assert agent.heading == pytest.approx(315)
    torus.face(world, agent, 15, 0)
    assert agent.heading == pytest.approx(315)  # where it is: it does not turn


@pytest.mark.parametrize(
    ("dx", "dy", "heading"),
    [(0, 1, 0), (1, 1, 45), (1, 0, 90), (1, -1, 135), (0, -1, 180), (-1, -1, 225), (-1, 0, 270)],
)
def test_headings_grow_clockwise_from_north(dx, dy, heading):
    agent = turtle()
    assert torus.towards(world_of(33), agent, dx, dy) == pytest.approx(heading)
    torus.right(world_of(33), agent, heading)
    torus.forward(world_of(33), agent, math.hypot(dx, dy))
    assert (agent.x, agent.y) == (pytest.approx(dx, abs=1e-12), pytest.approx(dy, abs=1e-12))


@given(inside, inside, anywhere, anywhere, sizes)
def test_distances_are_those_to_the_nearest_copy(u, v, x, y, size):
    world = world_of(size)
    agent = placed(world, u, v)
    x, y = torus.wrapped(x, world.low, size), torus.wrapped(y, world.low, size)
    assert torus.distance(world, agent, x, y) == pytest.approx(far(world, agent, x, y), abs=1e-9)


@given(inside, inside, st.floats(-300, 300), st.floats(-300, 300), sizes)
def test_points_outside_the_world_are_brought_into_it(u, v, x, y, size):
    world = world_of(size)
    agent = placed(world, u, v)
    wrapped = torus.wrapped(x, world.low, size), torus.wrapped(y, world.low, size)
    there = torus.distance(world, agent, *wrapped)
    assert torus.distance(world, agent, x, y) == pytest.approx(there, abs=1e-9)


@given(inside, inside, st.floats(0, 360), st.floats(-50, 50), st.integers(2, 40))
def test_there_and_back(u, v, heading, length, size):
    world = world_of(size)
    agent = placed(world, u, v, heading)
    start = (agent.x, agent.y)
    torus.forward(world, agent, length)
    torus.right(world, agent, 180)
    torus.forward(world, agent, length)
    assert torus.distance(world, agent, *start) < 1e-9


@given(st.floats(0, 360, exclude_max=True), st.floats(-1000, 1000))
def test_right_and_left_undo_each_other(heading, angle):
    agent = turtle(heading=heading)
    torus.right(None, agent, angle)
    assert 0 <= agent.heading <= 360
    torus.left(None, agent, angle)
    assert 0 <= agent.heading <= 360
    turned = (agent.heading - heading) % 360
    assert min(turned, 360 - turned) < 1e-9


def test_turning_by_hand():
    agent = turtle(heading=350.0)
    torus.right(None, agent, 20.0)
    assert agent.heading == 10.0
    torus.left(None, agent, 30.0)
    assert agent.heading == 340.0


def test_who_is_put_somewhere_is_brought_back_into_the_world():
    agent = turtle()
    torus.move_to(world_of(33), agent, 17.0, -20.0)
    assert (agent.x, agent.y) == (-16.0, 13.0)


def test_walking_by_hand():
    world, agent = world_of(33), turtle(15.0, 1.0)
    torus.walk_to(world, agent, -14.0, -2.0, 2.5)  # 4 east over the edge and 3 south
    assert (agent.x, agent.y) == pytest.approx((-16.0, -0.5))
    assert agent.heading == pytest.approx(90.0 + math.degrees(math.atan2(3, 4)))
    torus.walk_to(world, agent, -16.0, 1.0, 20.0)  # nearer than the step
    assert (agent.x, agent.y, agent.heading) == (-16.0, 1.0, 0.0)
    torus.walk_to(world, agent, -26.0, 1.0, 1.0)
    assert agent.x == pytest.approx(16.0) and agent.heading == 270.0


@given(inside, inside, inside, inside, st.floats(0.01, 3), st.integers(1, 40))
def test_walking_comes_nearer_by_the_length_or_arrives(u, v, p, q, length, size):
    world = world_of(size)
    agent, goal = placed(world, u, v), placed(world, p, q)
    before = torus.distance(world, agent, goal.x, goal.y)
    torus.walk_to(world, agent, goal.x, goal.y, length)
    after = torus.distance(world, agent, goal.x, goal.y)
    assert after == pytest.approx(max(0.0, before - length), abs=1e-9)
    assert world.low - 0.5 <= agent.x < world.low - 0.5 + size
    assert 0 <= agent.heading < 360


def test_walking_on_the_spot():
    agent = turtle(2.0, 3.0, 77.0)
    torus.walk_to(world_of(9), agent, 2.0, 3.0, 0)
    assert (agent.x, agent.y, agent.heading) == (2.0, 3.0, 77.0)


def test_is_on_a_patch_by_hand():
    world = world_of(33)
    for x, y, there in [
        (0.0, 0.0, True), (0.5, 0.0, False), (0.49, -0.5, True), (0.0, -0.51, False),
        (33.0, 0.0, True), (0.0, -33.4, True), (-0.5, 33.4, True), (33.4, 1.0, False),
    ]:  # fmt: skip
        assert torus.is_on(world, turtle(), x, y) is there
    assert torus.is_on(world, turtle(-0.49, -0.49), 0.46, 0.46)
    # 32.2 away the other way round, and on its patch.
    assert torus.is_on(world, turtle(0.0, -15.6), 0.0, 16.6)
    assert torus.is_on(world, turtle(-15.6, 0.0), 16.6, 0.0)


def test_patches_stand_column_by_column():
    places = [(-16, -16), (-16, -15), (-15, -16), (16, 16), (17, 0), (0.5, -0.5)]
    found = [torus.patch_index(x, y, -16, 33) for x, y in places]
    assert found == [0, 1, 33, 33 * 33 - 1, 16, 17 * 33 + 16]


@given(inside, inside, st.floats(-60, 60), st.floats(-60, 60), sizes)
def test_is_on_the_patch_of_a_point(u, v, x, y, size):
    world = world_of(size)
    agent = placed(world, u, v)
    assume(agent.x < world.low - 0.5 + size and agent.y < world.low - 0.5 + size)
    place = torus.patch_index(agent.x, agent.y, world.low, size)
    # Within a hair of a patch's edge the rounding of the way round the world decides.
    assume(all(abs((value + 0.5) % 1 - 0.5) < 0.5 - 1e-9 for value in (x, y)))
    assert torus.is_on(world, agent, x, y) == (place == torus.patch_index(x, y, world.low, size))


@given(st.floats(-100, 100), st.floats(-100, 100), st.floats(0, 30), st.integers(1, 20))
def test_in_radius_is_the_patches_whose_centre_is_near(x, y, radius, size):
    world = world_of(size)
    x, y = torus.wrapped(x, world.low, size), torus.wrapped(y, world.low, size)
    found = list(torus.patches_in_radius(x, y, radius, world.low, size))
    assert len(found) == len(set(found))
    for place in range(size * size):
        patch = world.row_class(world, place)
        away = far(world, turtle(x, y), patch.x, patch.y)
        if abs(away - radius) > 1e-9:
            assert (place in found) == (away < radius)


def test_in_radius_by_hand():
    world = world_of(33)
    near = {(patch.x, patch.y) for patch in world.in_radius(turtle(16, 0), 1)}
    assert near == {(16, 0), (15, 0), (-16, 0), (16, 1), (16, -1)}
    assert [(p.x, p.y) for p in world.in_radius(turtle(0.4, 0), 0.4)] == [(0, 0)]
    assert len(list(world.in_radius(turtle(), 100))) == 33 * 33
    assert list(world.in_radius(turtle(0.5, 0.5), 0.1)) == []


def test_in_radius_over_the_edge_of_a_small_world():
    # Patches of a world of 3, whose places are 0 … 8: from x − 1 on, then from y − 1.
    assert list(torus.patches_in_radius(1.0, 1.0, 1.0, -1, 3)) == [5, 7, 8, 6, 2]
    # Of 5 by 5, from a corner: more rows than there are, but not the four patches 2 · √2 away.
    for x, y in ((2.0, 2.0), (-2.0, 2.0), (2.0, -2.0), (-2.0, -2.0)):
        found = list(torus.patches_in_radius(x, y, 2.5, -2, 5))
        far = {
            ((round(x) + i + 2) % 5) * 5 + (round(y) + j + 2) % 5 for i in (-2, 2) for j in (-2, 2)
        }
        assert len(found) == 21 and set(found) == set(range(25)) - far


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
def test_points_that_are_nowhere(bad):
    with pytest.raises(ValueError, match="nowhere"):
        torus.patch_index(bad, 0.0, -16, 33)
    with pytest.raises(ValueError, match="nowhere"):
        list(torus.patches_in_radius(0.0, bad, 1.0, -16, 33))
    with pytest.raises(ValueError, match="nowhere"):
        list(torus.patches_in_radius(0.0, 0.0, abs(bad), -16, 33))


def test_lattices_by_hand():
    assert torus.lattice(33, 2) == [(-8, 0), (8, 0)]
    # Three columns and two rows: the first row first.
    rows = [(-11, -8), (0, -8), (11, -8), (-11, 8), (0, 8), (11, 8)]
    assert torus.lattice(33, 6) == rows
    assert [torus.lattice_columns(n) for n in (1, 2, 3, 4, 5, 6, 12)] == [1, 2, 3, 2, 5, 3, 4]


@given(st.integers(1, 60), st.integers(1, 60))
def test_a_lattice_has_its_places_evenly_apart(size, n):
    places = torus.lattice(size, n)
    columns = torus.lattice_columns(n)
    assert len(places) == n
    assert n % columns == 0
    low = -(size // 2)
    assert all(low <= x < low + size and low <= y < low + size for x, y in places)
    xs = sorted({x for x, _ in places})
    gaps = [b - a for a, b in zip(xs, [*xs[1:], xs[0] + size], strict=True)]
    assert max(gaps) - min(gaps) <= 1
