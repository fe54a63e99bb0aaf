"""Worlds of patches have NetLogo's geometry: the torus, and worlds with walls."""

import hashlib
import math
import struct
from types import SimpleNamespace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from socialmind.worlds.grid import geometry as torus
from socialmind.worlds.grid import patches_near
from socialmind.worlds.grid.extent import OF_TORUS, of_grid, values_of
from socialmind.worlds.grid.patches import PatchWorld

sizes = st.integers(1, 40)
inside = st.floats(0, 1, exclude_max=True)
anywhere = st.floats(-1e6, 1e6)


def world_of(size):
    return PatchWorld({}, values_of(OF_TORUS, size, size, None))


def space(low, size):
    return low, low, size, size, 1, 1


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
    found = [patches_near.patch_index(x, y, *space(-16, 33)) for x, y in places]
    assert found == [0, 1, 33, 33 * 33 - 1, 16, 17 * 33 + 16]


@given(inside, inside, st.floats(-60, 60), st.floats(-60, 60), sizes)
def test_is_on_the_patch_of_a_point(u, v, x, y, size):
    world = world_of(size)
    agent = placed(world, u, v)
    assume(agent.x < world.low - 0.5 + size and agent.y < world.low - 0.5 + size)
    place = patches_near.patch_index(agent.x, agent.y, *space(world.low, size))
    # Within a hair of a patch's edge the rounding of the way round the world decides.
    assume(all(abs((value + 0.5) % 1 - 0.5) < 0.5 - 1e-9 for value in (x, y)))
    there = patches_near.patch_index(x, y, *space(world.low, size))
    assert torus.is_on(world, agent, x, y) == (place == there)


@given(st.floats(-100, 100), st.floats(-100, 100), st.floats(0, 30), st.integers(1, 20))
def test_in_radius_is_the_patches_whose_centre_is_near(x, y, radius, size):
    world = world_of(size)
    x, y = torus.wrapped(x, world.low, size), torus.wrapped(y, world.low, size)
    found = list(patches_near.patches_in_radius(x, y, radius, *space(world.low, size)))
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
    assert list(patches_near.patches_in_radius(1.0, 1.0, 1.0, *space(-1, 3))) == [5, 7, 8, 6, 2]
    # Of 5 by 5, from a corner: more rows than there are, but not the four patches 2 · √2 away.
    for x, y in ((2.0, 2.0), (-2.0, 2.0), (2.0, -2.0), (-2.0, -2.0)):
        found = list(patches_near.patches_in_radius(x, y, 2.5, *space(-2, 5)))
        far = {
            ((round(x) + i + 2) % 5) * 5 + (round(y) + j + 2) % 5 for i in (-2, 2) for j in (-2, 2)
        }
        assert len(found) == 21 and set(found) == set(range(25)) - far


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
def test_points_that_are_nowhere(bad):
    with pytest.raises(ValueError, match="nowhere"):
        patches_near.patch_index(bad, 0.0, *space(-16, 33))
    with pytest.raises(ValueError, match="nowhere"):
        list(patches_near.patches_in_radius(0.0, bad, 1.0, *space(-16, 33)))
    with pytest.raises(ValueError, match="nowhere"):
        list(patches_near.patches_in_radius(0.0, 0.0, abs(bad), *space(-16, 33)))


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


# Walls ------------------------------------------------------------------------------------------


def walled(width, height, wraps=False, low=None):
    return PatchWorld({}, values_of(of_grid(wraps), width, height, low))


def test_a_walled_world_is_where_its_declaration_says():
    world = walled(5, 4, low=(0, -1))
    found = [getattr(world, name) for name in ("width", "height", "low_x", "low_y")]
    assert found == [5, 4, 0, -1]
    assert (world.high_x, world.high_y, world.wraps_x, world.wraps_y) == (4, 2, 0, 0)
    assert (walled(33, 33).low_x, walled(4, 4).low_y) == (-16, -2)


def test_forward_stops_before_a_wall_as_in_netlogo():
    # NetLogo, a box of 33 × 33, each from 0 0: fd goes in steps of one, and stops.
    world = walled(33, 33)
    for heading, length, expected in [
        (90, 16, (16, 0)), (90, 16.4, (16.4, 0)), (90, 16.5, (16, 0)), (90, 100, (16, 0)),
        (270, 16.5, (-16.5, 0)), (270, 16.6, (-16, 0)), (0, 40, (0, 16)), (180, 40, (0, -16)),
        (90, -20, (-16, 0)), (45, 100, (23 / math.sqrt(2), 23 / math.sqrt(2))),
    ]:  # fmt: skip
        agent = turtle(heading=heading)
        torus.forward(world, agent, length)
        assert (agent.x, agent.y) == pytest.approx(expected), (heading, length)
    agent = turtle(16.0, 0.0, 90)
    torus.forward(world, agent, 0.7)  # less than a step: as a whole, or not at all
    assert agent.x == 16.0
    torus.forward(world, agent, 0.4)
    assert agent.x == pytest.approx(16.4)


def test_who_goes_along_a_wall_does_not_run_into_it():
    # The cosine of 270° is -1.8e-16, which would lead below -0.5.
    world = walled(9, 9, low=(-4, 0))
    agent = turtle(4.0, -0.5, 270)
    torus.forward(world, agent, 8)
    assert (agent.x, agent.y) == (-4.0, -0.5)


def test_can_move_by_hand():
    world = walled(33, 33)
    for agent, length, may in [
        (turtle(heading=90), 16.4, True), (turtle(heading=90), 16.5, False),
        (turtle(heading=270), 16.5, True), (turtle(heading=270), 16.6, False),
        (turtle(heading=90), -16.5, True), (turtle(0, -16.5, 90), 1, True),
    ]:  # fmt: skip
        assert torus.can_move(world, agent, length) is may
    assert torus.can_move(world_of(5), turtle(), 1e6)
    tube = walled(5, 5, wraps="x")
    assert torus.can_move(tube, turtle(heading=90), 1e6)
    assert not torus.can_move(tube, turtle(heading=0), 3)


@given(
    st.integers(1, 12), st.integers(1, 12), st.sampled_from([False, "x", "y"]),
    inside, inside, st.floats(0, 360, exclude_max=True) | st.sampled_from([0.0, 90, 180, 270]),
    st.floats(-30, 30) | st.integers(-20, 20),
)  # fmt: skip
def test_forward_is_netlogos_loop_of_steps(width, height, wraps, u, v, heading, length):
    world = walled(width, height, wraps)
    x = world.low_x - 0.5 + u * width
    y = world.low_y - 0.5 + v * height
    assume(world.is_inside(x, y))
    agent = turtle(x, y, heading)
    angle = math.radians(heading)
    dx, dy = (0.0 if abs(one) < 3.2e-15 else one for one in (math.sin(angle), math.cos(angle)))
    left = abs(length)
    way = 0.0
    while left > 0:  # what NetLogo does, one `jump` after another
        step = min(1.0, left)
        new = way + math.copysign(step, length)
        if not world.is_inside(x + new * dx, y + new * dy):
            break
        way, left = new, left - step
    torus.forward(world, agent, length)
    expected = turtle(
        torus.kept(x + way * dx, world.low_x, width, world.wraps_x),
        torus.kept(y + way * dy, world.low_y, height, world.wraps_y),
    )
    assert torus.distance(world, agent, expected.x, expected.y) < 1e-9
    assert torus.is_inside(world, agent.x, agent.y)


def test_distances_and_headings_do_not_go_through_walls():
    agent = turtle(15.0, 0.0)
    for wraps, away, heading in [(False, 30, 270), ("y", 30, 270), ("x", 3, 90), (True, 3, 90)]:
        world = walled(33, 33, wraps)
        assert torus.distance(world, agent, -15.0, 0.0) == away
        assert torus.towards(world, agent, -15.0, 0.0) == heading
    assert torus.distance(walled(33, 33, "x"), turtle(0, 15), 0.0, -15.0) == 30
    assert torus.is_on(walled(3, 3), turtle(1.4, 0), 1.0, 0.0)
    assert not torus.is_on(walled(3, 3), turtle(1.4, 0), -1.7, 0.0)
    assert torus.is_on(walled(3, 3, "x"), turtle(1.4, 0), -1.7, 0.0)


def test_walking_between_walls():
    agent = turtle(4.0, 0.0)
    torus.walk_to(walled(9, 9), agent, -4.0, 0.0, 1.5)
    assert (agent.x, agent.y, agent.heading) == (2.5, 0.0, 270.0)
    torus.walk_to(walled(9, 9, "x"), agent, -4.0, 0.0, 9)
    assert (agent.x, agent.heading) == (-4.0, 90.0)


def test_a_patch_outside_is_an_error():
    world = walled(5, 4)
    for x, y in [(2.5, 0), (-2.6, 0), (0, 1.5), (0, -2.6), (9, 9)]:
        assert not world.is_inside(x, y)
        with pytest.raises(ValueError, match="outside the world"):
            world.patch(x, y)
    for x, y, expected in [(2.4, 1.4, (2, 1)), (-2.5, -2.5, (-2, -2))]:
        assert world.is_inside(x, y)
        patch = world.patch(x, y)
        assert (patch.x, patch.y) == expected
    # 0.49999999999999994 + 0.5 is 1.0: the last coordinate of a world that ends there.
    assert walled(1, 1).patch(math.nextafter(0.5, 0), 0).x == 0


@given(
    st.integers(1, 9), st.integers(1, 9), st.sampled_from([False, True, "x", "y"]),
    inside, inside, st.floats(0, 12),
)  # fmt: skip
def test_in_radius_between_walls_is_the_patches_whose_centre_is_near(
    width, height, wraps, u, v, radius
):
    world = walled(width, height, wraps, low=(-(width // 3), 1 - height))
    agent = turtle(world.low_x - 0.5 + u * width, world.low_y - 0.5 + v * height)
    found = [(patch.x, patch.y) for patch in world.around(agent.x, agent.y, radius)]
    assert len(found) == len(set(found))
    for x in range(world.low_x, world.high_x + 1):
        for y in range(world.low_y, world.high_y + 1):
            copies = [
                math.hypot(x + i * width - agent.x, y + j * height - agent.y)
                for i in ((-1, 0, 1) if world.wraps_x else (0,))
                for j in ((-1, 0, 1) if world.wraps_y else (0,))
            ]
            if abs(min(copies) - radius) > 1e-9:
                assert ((x, y) in found) == (min(copies) < radius)


def test_lattices_of_a_world_that_is_no_square():
    assert torus.lattice((9, 3), 3) == [(-3, 0), (0, 0), (3, 0)]
    assert torus.lattice((33, 33), 6) == torus.lattice(33, 6)
