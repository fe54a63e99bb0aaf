"""CMA-ES: beginnings, restarts, and the library itself."""

import sys

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.learning.optimisers.cma import Cma, MissingCmaesError


@pytest.fixture
def library():
    return pytest.importorskip("cmaes")


def test_the_population_is_hansens_unless_it_is_set(library):
    # 4 + 3 ln 10 = 10.9
    assert Cma(10, 1).population == 10
    assert Cma(10, 1, {"population": 40}).ask().shape == (40, 10)
    with pytest.raises(ModelError, match="4 or more, or 0"):
        Cma(10, 1, {"population": 3})


def test_first_individuals_give_mean_and_size_of_the_distribution(library):
    first = 5.0 + np.random.default_rng(1).normal(0.0, 0.01, (50, 4))
    search = Cma(4, 1, {"population": 50}, first)
    search.ask()
    search.tell(np.random.default_rng(2).normal(size=50))
    second = search.ask()
    assert second.mean() == pytest.approx(5.0, abs=0.02)
    assert second.std() == pytest.approx(0.01, rel=0.5)


def test_it_goes_the_way_of_the_library(library):
    """Ten generations beside the library's own loop, given the same mean and seeds."""
    search = Cma(6, 3)
    draws = np.random.default_rng(3)
    plain = library.CMA(mean=draws.uniform(-1.0, 1.0, (1, 6))[0], sigma=0.5)
    for _ in range(10):
        plain.reseed_rng(int(draws.integers(1 << 32)))
        expected = np.array([plain.ask() for _ in range(plain.population_size)])
        genomes = search.ask()
        assert genomes == pytest.approx(expected, abs=1e-9)
        scores = -(genomes**2).sum(axis=1)
        search.tell(scores)
        plain.tell(list(zip(expected, -scores, strict=True)))


def test_it_starts_again_once_converged_restored_or_not(library):
    search, restored = Cma(3, 1), Cma(3, 1)
    spreads = []
    for _ in range(400):
        state = restored.state()
        restored = Cma(3, 2)
        restored.restore(state)
        genomes = search.ask()
        assert np.array_equal(restored.ask(), genomes)
        spreads.append(genomes.std(axis=0).max())
        for one in (search, restored):
            one.tell(-(genomes**2).sum(axis=1))
    converged = int(np.flatnonzero(np.array(spreads) < 1e-8)[0])
    assert max(spreads[converged:]) > 0.1
    assert search.best == pytest.approx(np.zeros(3), abs=1e-6)


def test_equal_first_individuals_leave_the_size_as_set(library):
    search = Cma(40, 1, {"population": 100, "step": 0.2}, np.full((3, 40), 0.1))
    assert search.ask()[3:].std() == pytest.approx(0.2, rel=0.1)


def test_without_the_library_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "cmaes", None)
    with pytest.raises(MissingCmaesError, match=r"pip install 'socialmind\[learning\]'"):
        Cma(3, 1)
