"""The genetic algorithm, beside Algorithms 1 and 2 worked by hand."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.learning.optimisers.genetic import Genetic, crossed

STILL = {"mutation": 0.0, "elite": 0}


def marked(population, size, **settings):
    """Genomes whose genes are all the number of the individual, counted from 0."""
    first = np.repeat(np.arange(float(population))[:, None], size, axis=1)
    return Genetic(size, 1, {"population": population, **settings}, first)


def test_a_child_has_the_genes_of_one_parent_up_to_the_pivot_and_then_of_the_other():
    first = np.array([[1.0, 2.0, 3.0, 4.0]] * 4)
    assert crossed(first, -first, np.array([1, 2, 3, 4])).tolist() == [
        [1.0, -2.0, -3.0, -4.0],
        [1.0, 2.0, -3.0, -4.0],
        [1.0, 2.0, 3.0, -4.0],
        [1.0, 2.0, 3.0, 4.0],
    ]


def test_only_the_best_thirty_per_cent_breed():
    search = marked(400, 6, **STILL)
    search.ask()
    search.tell(np.arange(400.0))
    children = search.ask()
    # The 120 best of 400 are those marked 280 to 399.
    assert children.min() >= 280.0
    assert set(np.unique(children)) > set(np.arange(281.0, 399.0, 7.0))


def test_children_change_parents_once_and_pivots_lie_anywhere():
    search = marked(2000, 5, selected=1.0, **STILL)
    search.ask()
    search.tell(np.zeros(2000))
    changes = np.diff(search.ask(), axis=1) != 0.0
    assert changes.sum(axis=1).max() == 1
    # Pivots 1 … 4 of 5 show as a change behind that gene, a fifth of the children each.
    assert changes.mean(axis=0) == pytest.approx(np.full(4, 0.2), abs=0.04)


def test_each_gene_mutates_with_its_probability_by_small_steps():
    first = np.zeros((1000, 20))
    search = Genetic(20, 1, {"population": 1000, "mutation": 0.1, "step": 0.3, "elite": 0}, first)
    search.ask()
    search.tell(np.zeros(1000))
    genes = search.ask()
    mutated = genes[genes != 0.0]
    assert mutated.size / genes.size == pytest.approx(0.1, abs=0.01)
    assert mutated.std() == pytest.approx(0.3, abs=0.02)
    assert mutated.mean() == pytest.approx(0.0, abs=0.03)


def test_the_elite_lives_on_unchanged_and_in_order():
    search = marked(50, 4, elite=3, mutation=1.0)
    search.ask()
    scores = np.zeros(50)
    scores[[17, 40, 8]] = 3.0, 2.0, 1.0
    search.tell(scores)
    assert search.ask()[:3, 0].tolist() == [17.0, 40.0, 8.0]


def test_of_equal_scores_the_first_are_the_best():
    search = marked(200, 4, elite=3)
    search.ask()
    search.tell(np.arange(200) % 3)
    assert search.ask()[:3, 0].tolist() == [2.0, 5.0, 8.0]


def test_of_equal_scores_the_first_generation_stays_the_best():
    search = marked(3, 1, elite=0, mutation=1.0)
    for scores in ([0.0, 5.0, 5.0], [1.0, 5.0, 1.0]):
        search.ask()
        search.tell(scores)
        assert (search.best.tolist(), search.best_score) == ([1.0], 5.0)


def test_one_selected_breeds_alone_and_shares_are_rounded():
    for selected, parents in ((0.01, {9.0}), (0.28, {7.0, 8.0, 9.0}), (0.25, {8.0, 9.0})):
        search = marked(10, 40, selected=selected, **STILL)
        search.ask()
        search.tell(np.arange(10.0))
        assert set(np.unique(search.ask())) == parents


def test_the_foremost_of_those_given_stand_at_the_head():
    first = np.arange(5.0)[:, None]
    assert Genetic(1, 1, {"population": 3}, first).ask()[:, 0].tolist() == [0.0, 1.0, 2.0]
    assert Genetic(1, 1, {"population": 8}, first).ask()[:5, 0].tolist() == [
        0.0,
        1.0,
        2.0,
        3.0,
        4.0,
    ]


def test_mutations_are_added_to_what_was_bred():
    settings = {"population": 200, "mutation": 0.5, "step": 0.1, "elite": 0}
    search = Genetic(8, 1, settings, np.full((200, 8), 7.0))
    search.ask()
    search.tell(np.zeros(200))
    children = search.ask()
    assert 6.0 < children.min() < 6.9 and 7.1 < children.max() < 8.0
    # Each gene by its own luck: few children have none or all of the eight changed.
    changed = (children != 7.0).sum(axis=1)
    assert changed.mean() == pytest.approx(4.0, abs=0.5)
    assert ((changed == 0) | (changed == 8)).mean() < 0.1


def test_winners_of_tournaments_have_the_distribution_of_the_best_of_several():
    search = marked(3000, 1, tournament=3, **STILL)
    search.ask()
    search.tell(np.arange(3000.0))
    ranks = search.ask()[:, 0] / 3000.0
    # The greatest of three uniform numbers has mean 3/4 and exceeds 1/2 in 7 of 8 cases.
    assert ranks.mean() == pytest.approx(0.75, abs=0.02)
    assert (ranks > 0.5).mean() == pytest.approx(0.875, abs=0.02)
    assert ranks.max() == 2999 / 3000  # the best of all competes as well


def test_the_worst_may_win_a_tournament_as_well():
    children = []
    for seed in range(200):
        search = Genetic(1, seed, {"population": 2, "tournament": 2, **STILL}, [[0.0], [1.0]])
        search.ask()
        search.tell([0.0, 1.0])
        children += search.ask()[:, 0].tolist()
    # Both draws are the worse one of two in a quarter of all cases.
    assert np.mean(children) == pytest.approx(0.75, abs=0.1)


@pytest.mark.parametrize(
    "settings",
    [
        {"population": 1},
        {"population": 2.5},
        {"elite": 200},
        {"elite": 1.5},
        {"mutation": 1.1},
        {"tournament": 1},
    ],
)
def test_settings_outside_their_range_are_refused(settings):
    with pytest.raises(ModelError, match=next(iter(settings))):
        Genetic(3, 1, settings)


@pytest.mark.parametrize("generation", [0, 3])
def test_steps_narrow_with_the_generations(generation):
    settings = {"population": 400, "mutation": 1.0, "step": 2.0, "narrowing": 0.5, "elite": 0}
    search = Genetic(6, seed=2, settings=settings, first=np.zeros((400, 6)))
    search.restore({**search.state(), "generation": generation})
    search.ask()
    search.tell(np.zeros(400))
    assert search.ask().std() == pytest.approx(2.0 * 0.5**generation, rel=0.05)
