"""Who is judged once more after the last generation."""

import numpy as np
import pytest

from socialmind.learning.training.finalists import Finalists, Individual, arrays_of, individual_of
from socialmind.mind.functions.neat.graph import NeatGraph


def test_finalists_are_distinct_and_half_of_them_the_last():
    finalists = Finalists(4)
    scores = [5.0, 9.0, 1.0, 2.0, 9.0, 0.0, 1.0]
    genomes = [1, 2, 3, 3, 2, 4, 5]
    for generation, (genome, score) in enumerate(zip(genomes, scores, strict=True), start=1):
        finalists.add(Individual(np.array([float(genome)]), None, score, generation))
    chosen = {(one.genome[0], one.generation) for one in finalists.chosen()}
    assert chosen == {(2.0, 2), (1.0, 1), (5.0, 7), (4.0, 6)}


def test_of_five_finalists_three_are_the_highest_and_two_the_last():
    finalists = Finalists(5)
    for generation, score in enumerate([9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0], start=1):
        finalists.add(Individual(np.array([score]), None, score, generation))
    assert [one.generation for one in finalists.chosen()] == [1, 2, 3, 6, 7]


def test_one_finalist_is_the_highest():
    finalists = Finalists(1)
    for generation, score in enumerate([1.0, 7.0, 3.0], start=1):
        finalists.add(Individual(np.array([score]), None, score, generation))
    assert [one.generation for one in finalists.chosen()] == [2]


@pytest.mark.parametrize("graph", [None, NeatGraph.minimal(2, 1)])
def test_they_go_through_arrays_bit_by_bit(graph, tmp_path):
    finalists = Finalists(3)
    for generation in range(1, 6):
        weights = np.random.default_rng(generation).normal(size=3)
        finalists.add(Individual(weights, graph, float(weights[0]), generation))
    np.savez(tmp_path / "state.npz", **finalists.state())
    restored = Finalists(3)
    with np.load(tmp_path / "state.npz") as arrays:
        restored.restore(arrays)
    for one, other in zip(finalists.chosen(), restored.chosen(), strict=True):
        assert one.same(other)
        assert (one.score, one.generation) == (other.score, other.generation)
    one = finalists.chosen()[0]
    assert individual_of(arrays_of(one)).same(one)
