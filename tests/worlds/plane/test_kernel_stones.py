"""The table of obstacles against looking at all of them."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import Disc
from socialmind.worlds.plane.kernel.arrays import Bodies, Obstacles, PlaneArrays
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.layout import (
    BODY,
    OBSTACLE,
    STONE_RADIUS,
    STONE_X,
    STONE_Y,
)


def world(seed, cell, half_width=50.0, count=40):
    rng = np.random.default_rng(seed)
    obstacles = np.zeros(count, OBSTACLE)
    for name in ("x", "y"):
        obstacles[name] = rng.uniform(-45, 45, count)
    obstacles["half_width"] = rng.uniform(0.0, 4, count)
    obstacles["round"] = rng.integers(0, 2, count)
    obstacles["angle"] = rng.uniform(0, 3, count)
    obstacles["half_width"][0] = 0.0  # no obstacle at all
    alive = rng.random(count) < 0.7
    rows = np.zeros(1, BODY)
    robots = Bodies("robots", Disc(radius=3.0), rows, np.ones(1, np.bool_), 0)
    arrays = PlaneArrays(half_width, 1 / 30, cell, [robots], Obstacles(obstacles, alive, 0))
    return arrays, obstacles, alive


@pytest.mark.parametrize("cell", [1.0, 7.0, 300.0])
@pytest.mark.parametrize("half_width", [0.0, 50.0])
def test_a_cell_lists_every_stone_within_reach(cell, half_width):
    arrays, obstacles, alive = world(3, cell, half_width)
    arrays.build()
    stones, reach = arrays.stones, 3.0  # the body's own radius, as there are no eyes
    living = obstacles[alive & (obstacles["half_width"] > 0)]
    assert stones[:, STONE_X].tolist() == living["x"].tolist()
    rng = np.random.default_rng(1)
    listed = 0
    for x, y in rng.uniform(-70, 70, (4000, 2)):
        held = arrays.stones_near(x, y)
        away = np.hypot(stones[:, STONE_X] - x, stones[:, STONE_Y] - y)
        met = np.flatnonzero(away <= stones[:, STONE_RADIUS] + reach)
        assert held == sorted(held) and set(met.tolist()) <= set(held)
        listed += len(held) - len(met)
    if cell == 1.0:
        assert listed < 4000  # and hardly any more


def test_a_table_without_room_is_done_without_until_there_is():
    arrays, *_ = world(4, 2.0)
    arrays.make_room(3)
    needed = kernel().build.ctypes(arrays.address, 0, 0)
    assert needed > 3
    assert arrays.stones_near(0.0, 0.0) == list(range(len(arrays.stones)))
    arrays.make_room(needed)
    assert kernel().build.ctypes(arrays.address, 0, 0) == 0
    assert len(arrays.stones_near(0.0, 0.0)) < len(arrays.stones)


def test_results_do_not_depend_on_the_table():
    ends = set()
    for cell in (1.0, 7.0, 300.0, None):
        arrays, *_ = world(5, cell or 5.0)
        if cell is None:
            arrays.make_room(0)
            kernel().build.ctypes(arrays.address, 0, 0)
        else:
            arrays.build()
        rows = arrays._attached[0][0]
        rows["carrier_kind"] = rows["carrier"] = -1
        rows["push_x"], rows["push_y"] = 900.0, 400.0
        for _ in range(300):
            kernel().move.ctypes(arrays.address, 0, 0)
        ends.add(rows.tobytes())
    assert len(ends) == 1


@pytest.mark.parametrize(
    ("name", "value"),
    [("angle", np.nan), ("x", 2e9), ("y", -np.inf), ("half_width", np.inf), ("half_width", -0.5)],
)
def test_an_obstacle_that_stands_nowhere_is_refused(name, value):
    arrays, obstacles, alive = world(6, 5.0)
    arrays.build()
    assert len(arrays.stones)
    slot = int(np.flatnonzero(alive)[3])
    obstacles[name][slot] = value
    with pytest.raises(ModelError, match=f"obstacle {slot} "):
        arrays.build()
    assert not len(arrays.stones)
