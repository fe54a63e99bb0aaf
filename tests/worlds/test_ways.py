"""Cheapest ways over patches: as short as all of them, at both speeds, whatever is in sight."""

import math

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind import Agent, Grid, Model, Patch, Population, each, parameter
from socialmind.worlds.grid.ways import STEPS, way

HEADINGS = {step: 45.0 * number for number, step in enumerate(STEPS)}


def first_step(costs, start, end, sight=0, beyond=1.0, wraps=True):
    """The heading of the first step over a field of costs, (width, height)."""
    width, height = costs.shape
    space = 0, 0, width, height, int(wraps), int(wraps)
    return way(costs.ravel(), *map(float, (*start, *end)), sight, beyond, *space)


def walked(costs, start, end, sight=0, beyond=1.0, wraps=True):
    """What the whole way costs, step by step; infinite where it leads nowhere."""
    place, spent = start, 0.0
    for _ in range(costs.size):
        if place == end:
            return spent
        heading = first_step(costs, place, end, sight, beyond, wraps)
        if heading < 0:
            return math.inf
        dx, dy = STEPS[int(heading // 45)]
        place = (place[0] + dx) % costs.shape[0], (place[1] + dy) % costs.shape[1]
        spent += costs[place]
    return math.inf


def shortest(costs, start, end, wraps):
    """The same by networkx."""
    width, height = costs.shape
    graph = nx.DiGraph()
    graph.add_nodes_from((x, y) for x in range(width) for y in range(height))
    for x in range(width):
        for y in range(height):
            for dx, dy in STEPS:
                to = x + dx, y + dy
                if wraps:
                    to = to[0] % width, to[1] % height
                if to in graph and math.isfinite(costs[to]):
                    graph.add_edge((x, y), to, weight=costs[to])
    try:
        return nx.shortest_path_length(graph, start, end, weight="weight")
    except nx.NetworkXNoPath:
        return math.inf


grounds = st.tuples(st.integers(1, 7), st.integers(1, 7)).flatmap(
    lambda size: st.tuples(
        st.just(size),
        st.lists(
            st.sampled_from([1.0, 2.0, 7.0, math.inf]),
            min_size=size[0] * size[1],
            max_size=size[0] * size[1],
        ),
    )
)


@given(grounds, st.data(), st.booleans())
def test_where_all_is_known_the_way_is_a_cheapest_one(ground, data, wraps):
    (width, height), values = ground
    costs = np.array(values).reshape(width, height)
    place = st.tuples(st.integers(0, width - 1), st.integers(0, height - 1))
    start, end = data.draw(place), data.draw(place)
    expected = shortest(costs, start, end, wraps)
    assert walked(costs, start, end, 0, 1.0, wraps) == expected
    if start == end or math.isinf(expected):
        assert first_step(costs, start, end, 0, 1.0, wraps) == -1.0


def test_a_wall_in_sight_is_gone_round_and_one_out_of_sight_is_met_later():
    costs = np.ones((20, 9))
    costs[8, :8] = math.inf  # open at the top
    assert first_step(costs, (7, 4), (12, 4), 5, 1.0, wraps=False) == 0.0
    assert first_step(costs, (1, 4), (12, 4), 3, 1.0, wraps=False) in (45.0, 90.0, 135.0)
    assert math.isfinite(walked(costs, (1, 4), (12, 4), 5, 1.0, wraps=False))


def test_ways_go_round_where_the_world_does():
    costs = np.ones((9, 9))
    assert first_step(costs, (0, 0), (7, 0)) == 270.0
    assert first_step(costs, (0, 0), (0, 8), 3) == 180.0


def test_costs_that_are_none_are_refused():
    with pytest.raises(ValueError, match="below 0"):
        first_step(np.full((3, 3), -1.0), (0, 0), (2, 2))
    with pytest.raises(ValueError, match="beyond sight"):
        first_step(np.ones((3, 3)), (0, 0), (2, 2), 1, 0.0)


class Walker(Agent):
    pass


class Hill(Patch):
    cost: float = 1.0


def walk(walker, model):
    heading = model.world.way("cost", walker.x, walker.y, 3, -2, model.sight, 1.0)
    if heading >= 0:
        walker.heading = heading
        model.world.forward(walker, 1)


class Hills(Model):
    """Walkers who go to one place."""

    sight: int = parameter(0)
    walkers = Population(Walker, 20)
    world = Grid(15, 11, patch=Hill)
    schedule = (each(walkers, walk),)


@pytest.mark.parametrize("sight", [0, 2])
def test_both_speeds_find_the_same_way(sight):
    found = []
    for compiled in (True, False):
        hills = Hills(seed=2, sight=sight, compiled=compiled)
        luck = np.random.default_rng(3)
        hills.world.load("cost", luck.choice([1.0, 3.0, 50.0], (15, 11), p=[0.6, 0.3, 0.1]))
        hills.walkers.x = np.arange(20) % 15 - 7
        hills.walkers.y = np.arange(20) % 11 - 5
        hills.advance(9)
        found.append((hills.walkers.x.tolist(), hills.walkers.y.tolist()))
    assert found[0] == found[1]
    assert any(abs(x - 3) + abs(y + 2) < 1 for x, y in zip(*found[0], strict=True))
