"""The measures of the farmer-artisan study, against values worked out by hand."""

from __future__ import annotations

import doctest
import importlib.util
import math
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

PATH = Path(__file__).parents[2] / "analysis" / "farmer_artisan" / "measures.py"


def _load() -> ModuleType:
    spec = importlib.util.spec_from_file_location("farmer_artisan_measures", PATH)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


measures = _load()


def test_examples() -> None:
    found = doctest.testmod(measures)
    assert found.attempted > 0
    assert found.failed == 0


def test_distance_goes_the_short_way_round() -> None:
    # From (-16, -16) to (16, 16) it is one patch across each edge of a world of 33.
    distance = measures.nearest_distance([-16.0], [-16.0], [(16, 16)], 33)
    assert distance.tolist() == [pytest.approx(math.sqrt(2))]


def test_without_land_there_is_no_distance() -> None:
    assert np.isnan(measures.nearest_distance([np.nan], [np.nan], [(0, 0)], 33)).all()


def test_correlation_agrees_with_scipy_and_ranks_the_late_last() -> None:
    distance = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0]
    tick = [30.0, 20.0, 10.0, 20.0, math.inf, math.inf]
    expected = stats.spearmanr(distance, [30, 20, 10, 20, 99, 99]).statistic
    assert measures.rank_correlation(distance, tick) == pytest.approx(expected)


def test_correlation_of_equals_is_unknown() -> None:
    assert math.isnan(measures.rank_correlation([1.0, 2.0], [math.inf, math.inf]))


@given(st.lists(st.integers(-1000, 1000), min_size=2, max_size=30, unique=True))
def test_any_rising_relation_correlates_fully(distance: list[int]) -> None:
    tick = [math.exp(d / 500) for d in distance]
    assert measures.rank_correlation(distance, tick) == pytest.approx(1.0)
    assert measures.rank_correlation(distance, [-t for t in tick]) == pytest.approx(-1.0)


def test_a_band_has_the_interval_of_each_tick() -> None:
    samples = np.array([[1.0, 5.0], [2.0, 5.0], [4.0, 5.0]])
    mean, low, high = measures.band(samples)
    expected = stats.t.interval(0.95, 2, samples[:, 0].mean(), stats.sem(samples[:, 0]))
    assert mean.tolist() == pytest.approx([7 / 3, 5.0])
    assert (low[0], high[0]) == pytest.approx(expected)
    assert (low[1], high[1]) == (5.0, 5.0)
