"""Diversity of agents, against values worked out by hand."""

import math
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.diversity import (
    _groups,
    hierarchic_social_entropy,
    policy_distances,
    system_neural_diversity,
    work_distances,
)
from socialmind.experiments.measures.division import Division, division_of_labour


def test_one_index_of_the_whole_matrix_is_the_geometric_mean_of_both():
    found = division_of_labour([[3, 1], [1, 3], [2, 2]])
    assert found.both == pytest.approx(math.sqrt(found.agents_to_tasks * found.tasks_to_agents))
    assert Division(0.25, 1.0, 0.5).both == 0.5
    assert math.isnan(division_of_labour([[0, 0]]).both)


def test_agents_without_work_are_left_out():
    assert work_distances([[2, 0], [0, 0], [3, 1]]).tolist() == [[0.0, 0.25], [0.25, 0.0]]


def test_policies_are_apart_by_means_and_deviations():
    # At the first observation √(3² + 4²), at the second nothing.
    means = [[[3.0], [1.0]], [[0.0], [1.0]]]
    deviations = [[[4.0], [2.0]], [[0.0], [2.0]]]
    assert policy_distances(means, deviations)[0, 1] == pytest.approx(5 / 2)
    assert policy_distances(means)[0, 1] == pytest.approx(3 / 2)


def test_two_groups_of_minds_by_hand():
    # Three do 0 and three do 1: 9 of 15 pairs are 1 apart.
    apart = policy_distances([[[0.0]]] * 3 + [[[1.0]]] * 3)
    assert system_neural_diversity(apart) == pytest.approx(9 / 15)
    # Up to 1 two groups of three, 1 bit; from there on one.
    assert hierarchic_social_entropy(apart) == pytest.approx(1.0)


def test_many_small_groups_have_more_entropy_than_few_large_ones():
    four = policy_distances([[[float(place)]] for place in (0, 0, 1, 1)])
    apart = 1.0 - np.eye(4)
    assert hierarchic_social_entropy(four) == pytest.approx(1.0)
    assert hierarchic_social_entropy(apart) == pytest.approx(2.0)


def test_a_chain_falls_into_groups_that_overlap():
    # Places 0, 1, 2: below 1 three groups, log2 3 bits; below 2 {0, 1} and {1, 2}, 1 bit.
    chain = np.abs(np.subtract.outer([0.0, 1.0, 2.0], [0.0, 1.0, 2.0]))
    assert hierarchic_social_entropy(chain) == pytest.approx(math.log2(3) + 1)
    assert sorted(map(sorted, _groups(chain <= 1))) == [[0, 1], [1, 2]]


def test_one_agent_alone():
    assert math.isnan(system_neural_diversity([[0.0]]))
    assert hierarchic_social_entropy([[0.0]]) == 0.0


@settings(max_examples=60)
@given(st.integers(1, 7), st.integers(0, 2**20))
def test_groups_are_all_the_largest_ones(count, seed):
    alike = np.random.default_rng(seed).random((count, count)) < 0.5
    alike = alike | alike.T | np.eye(count, dtype=bool)
    cliques = [
        set(some)
        for size in range(1, count + 1)
        for some in combinations(range(count), size)
        if all(alike[a, b] for a, b in combinations(some, 2))
    ]
    largest = [one for one in cliques if not any(one < other for other in cliques)]
    assert sorted(map(sorted, _groups(alike))) == sorted(map(sorted, largest))


@pytest.mark.parametrize(
    "wrong", [[[0, 1], [2, 0]], [[1.0]], [[0, -1], [-1, 0]], [[0, 1]], [[0, math.nan]] * 2]
)
def test_distances_that_are_none_are_refused(wrong):
    for measure in (system_neural_diversity, hierarchic_social_entropy):
        with pytest.raises(SocialmindError, match="distances"):
            measure(wrong)


def test_other_shapes_are_refused():
    with pytest.raises(SocialmindError, match="agents by tasks"):
        work_distances([1, 2])
    with pytest.raises(SocialmindError, match="by observations"):
        policy_distances([[1.0, 2.0]])
    with pytest.raises(SocialmindError, match="deviations of 0 or more"):
        policy_distances([[[1.0]], [[2.0]]], [[[0.1]], [[-0.1]]])
