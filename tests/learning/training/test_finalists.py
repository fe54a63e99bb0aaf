"""Who is judged once more after the last generation."""

import numpy as np
import pytest

from socialmind.learning.training.finalists import Finalists, Individual, arrays_of, individual_of
from socialmind.mind import Perceptron, Skill
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


def test_who_does_better_later_is_known_by_its_higher_score():
    finalists = Finalists(3)
    for generation, (genome, score) in enumerate([(1, 5.0), (2, 6.0), (1, 9.0), (3, 7.0)], start=1):
        finalists.add(Individual(np.array([float(genome)]), None, score, generation))
    assert [(one.score, one.generation) for one in finalists.highest] == [(9.0, 3), (7.0, 4)]
    finalists.add(Individual(np.array([1.0]), None, 8.0, 5))
    finalists.add(Individual(np.array([1.0]), None, 9.0, 6))  # no better than before
    assert [(one.score, one.generation) for one in finalists.highest] == [(9.0, 3), (7.0, 4)]


def test_of_equal_scores_the_earlier_one_is_higher():
    finalists = Finalists(2)
    for generation in (1, 2):
        finalists.add(Individual(np.array([float(generation)]), None, 4.0, generation))
    assert [one.generation for one in finalists.highest] == [1]


def test_they_differ_in_graph_or_in_weights():
    weights, graph = np.array([1.0, 2.0, 3.0]), NeatGraph.minimal(2, 1)
    one = Individual(weights, graph, 1.0, 1)
    assert one.same(Individual(weights.copy(), NeatGraph.minimal(2, 1), 5.0, 9))
    assert not one.same(Individual(weights, None, 1.0, 1))
    assert not one.same(Individual(weights + 1.0, graph, 1.0, 1))


def test_there_are_as_many_as_were_asked_for_where_the_highest_are_the_last():
    finalists = Finalists(5)
    for generation in range(1, 8):
        finalists.add(Individual(np.array([float(generation)]), None, generation, generation))
    assert [one.generation for one in finalists.chosen()] == [3, 4, 5, 6, 7]


def test_one_that_is_the_best_again_and_again_is_one_of_the_last_once():
    finalists = Finalists(4)
    for generation, (genome, score) in enumerate(
        [(1, 9.0), (2, 8.0), (3, 1.0), (4, 0.5), (4, 0.5), (4, 0.5), (4, 0.5)], start=1
    ):
        finalists.add(Individual(np.array([float(genome)]), None, score, generation))
    assert [one.generation for one in finalists.chosen()] == [1, 2, 3, 7]


def test_each_skill_gets_its_part_of_the_genome():
    skills = [
        Skill(name, inputs, ["MO:L"], Perceptron(layers=0))
        for name, inputs in (("A", ["SE:S"]), ("B", ["SE:S", "SE:T"]), ("C", ["SE:S"]))
    ]
    sizes = [one.genome_size for one in skills]
    assert sizes == [2, 3, 2]
    found = Individual(np.arange(7.0), None, 0.0, 1).given_to(skills)
    assert [one.name for one in found] == ["A", "B", "C"]
    assert [one.genome.tolist() for one in found] == [[0, 1], [2, 3, 4], [5, 6]]
    graph = NeatGraph.minimal(2, 1)
    weights = np.arange(float(skills[1].changed(function=graph).genome_size))
    (grown,) = Individual(weights, graph, 0.0, 1).given_to(skills[1:2])
    assert (grown.function, grown.genome.tolist()) == (graph, weights.tolist())


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
    restored.add(Individual(np.zeros(3), graph, 99.0, 99))  # which is forgotten
    with np.load(tmp_path / "state.npz") as arrays:
        restored.restore(arrays)
    for one, other in zip(finalists.chosen(), restored.chosen(), strict=True):
        assert one.same(other)
        assert (one.score, one.generation) == (other.score, other.generation)
    one = finalists.chosen()[0]
    assert individual_of(arrays_of(one)).same(one)
