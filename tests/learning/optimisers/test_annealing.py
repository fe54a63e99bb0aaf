"""Simulated annealing: when a neighbour is taken."""

import numpy as np
import pytest

from socialmind.learning.optimisers.annealing import Annealing


def stands_after(scores, seed=1, **settings):
    """Return which genome of a generation the next one stands on."""
    search = Annealing(3, seed, {"neighbours": len(scores) - 1, **settings})
    genomes = search.ask()
    search.tell(scores)
    return int(np.flatnonzero((genomes == search.ask()[0]).all(axis=1))[0])


@pytest.mark.parametrize("seed", range(5))
def test_the_best_neighbour_is_taken_where_it_is_no_worse(seed):
    assert stands_after([1.0, 0.0, 3.0, 2.0], seed, temperature=1e-6) == 2
    assert stands_after([1.0, 0.0, 1.0, 0.5], seed, temperature=1e-6) == 2


@pytest.mark.parametrize("seed", range(5))
def test_the_smallest_advantage_and_even_a_tie_are_enough(seed):
    assert stands_after([1.0, 1.0 + 1e-12], seed, temperature=1e-15) == 1
    assert stands_after([1.0, 1.0], seed, temperature=1e-15) == 1


def test_a_worse_one_is_taken_by_the_law_of_metropolis():
    taken = [stands_after([1.0, -9.0, 0.5], seed, temperature=0.5) for seed in range(2000)]
    assert set(taken) == {0, 2}
    assert np.mean(np.array(taken) == 2) == pytest.approx(np.exp(-1.0), abs=0.03)


def test_no_worse_one_is_taken_in_the_cold():
    assert {stands_after([1.0, 0.5], seed, temperature=1e-9) for seed in range(50)} == {0}


def test_temperature_and_steps_fall_by_their_factors():
    search = Annealing(400, 1, {"temperature": 8.0, "cooling": 0.5, "step": 2.0, "narrowing": 0.5})
    for generation in range(4):
        genomes = search.ask()
        moved = (genomes[1:] - genomes[0])[genomes[1:] != genomes[0]]
        assert len(genomes) == 5
        assert moved.mean() == pytest.approx(0.0, abs=0.3 * 0.5**generation)
        assert moved.std() == pytest.approx(2.0 * 0.5**generation, rel=0.15)
        search.tell(np.zeros(5))
    assert search.temperature == 0.5


def test_the_temperature_comes_from_the_first_scores_that_differ():
    search = Annealing(3, 1, {"neighbours": 1, "cooling": 0.5})
    for scores in ([2.0, 2.0], [5.0, 1.0], [0.0, 100.0]):
        search.ask()
        search.tell(scores)
    # The standard deviation of 5 and 1 is 2; it cooled twice.
    assert search.temperature == 0.5


def test_the_coldest_temperature_is_above_nought():
    search = Annealing(3, 1, {"neighbours": 1, "temperature": 1.0, "cooling": 1e-200})
    for _ in range(5):
        search.ask()
        search.tell([0.0, 1.0])
    assert 0.0 < search.temperature < 1e-300


def test_every_neighbour_differs_from_the_genome():
    search = Annealing(3, 1, {"neighbours": 200, "mutation": 0.0})
    genomes = search.ask()
    assert ((genomes[1:] != genomes[0]).sum(axis=1) == 1).all()
