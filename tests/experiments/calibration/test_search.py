"""Searches: known answers by all methods, what recovery finds out, intervals, going on."""

import json
import math

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.finding import found_by, surface_of
from socialmind.experiments.calibration.methods.registry import METHODS
from socialmind.experiments.calibration.plan import DATA, FINAL, NEW, TRIAL
from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.calibration.reporting.tables import (
    recovery_table,
    seeds_in_use,
    trials_table,
)
from socialmind.experiments.calibration.search import Search


def bowl(a, b, rng):
    """Two statistics, one of them square in a parameter, with a little luck."""
    return [a**2 + rng.normal(0, 0.01), b + rng.normal(0, 0.01)]


def both(a, b, rng):
    """The sum alone."""
    return [a + b + rng.normal(0, 0.01)]


def recovered(searches):
    return recovery_table(searches[0].plan, [found_by(one) for one in searches])


@pytest.mark.parametrize("method", METHODS)
def test_each_method_finds_a_known_answer(searched, method):
    (search,) = searched(bowl, method, budget=400, x=(0.36, 0.01), y=(0.3, 0.01))
    found = found_by(search)
    near = 0.12 if method == "lhs" else 0.05
    assert found.values == pytest.approx((0.6, 0.3), abs=near)
    if method != "lhs":  # whose trials lie too far apart for data as sharp as these
        (low, high), _ = found.intervals
        assert low <= 0.6 <= high and high - low < 0.3
        assert found.plausible > 0
    assert len(search.trials) == 180 and len(search.finals) == 5
    again = searched(bowl, method, budget=400, x=(0.36, 0.01), y=(0.3, 0.01))
    assert again[0].trials == search.trials


@pytest.mark.parametrize("method", ["cmaes", "abc"])
def test_recovery_says_that_a_sum_does_not_tell_its_parts(searched, method):
    table = recovered(searched(both, method, budget=150, recover=8, x=(1.0, 0.02)))
    summary = identifying.summary(table).set_index("parameter")
    assert set(summary["verdict"]) == {"not apart"}
    ((one, other, together),) = identifying.combinations(table)
    assert {one, other} == {"a", "b"} and together < -0.9
    # Where nothing is told, the plausible values are nearly all that were looked for.
    assert summary["coverage"].min() >= 0.75


def test_recovery_says_what_data_tell(searched):
    table = recovered(searched(bowl, budget=150, recover=8, x=(0.36, 0.02), y=(0.3, 0.02)))
    summary = identifying.summary(table)
    assert set(summary["verdict"]) == {"told"}
    assert summary["coverage"].min() >= 0.75
    assert identifying.combinations(table) == []
    true = table.pivot_table("true", "recovery", "parameter")
    for name in ("a", "b"):  # all over the ranges: one in each eighth
        assert sorted((true[name] * 8).astype(int)) == list(range(8))


def test_one_parameter_alone_is_searched_too(searched):
    (search,) = searched(lambda a, b, rng: [a], budget=100, x=(0.7, 0.1))
    assert found_by(search).values[0] == pytest.approx(0.7, abs=0.05)
    for method in METHODS.values():
        alone = method(1, 24, 3)
        points = alone.ask()
        assert points.shape[1] == 1 and ((points >= 0) & (points <= 1)).all()
        alone.tell(points, np.abs(points[:, 0] - 0.5))
        assert alone.ask().shape[1] == 1


def test_trials_that_fail_are_the_worst_and_do_not_stop_a_search(searched):
    def broken(a, b, rng):
        return None if a > 0.6 else [a, b]

    for method in METHODS:
        (search,) = searched(broken, method, budget=150, x=(0.5, 0.1), y=(0.5, 0.1))
        distances = [one["distance"] for one in search.trials]
        assert 0 < distances.count(math.inf) < len(distances)
        assert search.trials[distances.index(math.inf)]["failed"] == 2
        assert found_by(search).values[0] <= 0.6
        frame = trials_table(search.plan, [search])
        assert (frame["failed"] > 0).sum() == distances.count(math.inf)


def test_a_search_of_which_all_fails_says_so(searched):
    searches = searched(lambda *_: None, budget=40, recover=1, x=(1, 1))
    fit, recovery = map(found_by, searches)
    assert fit.values is None and "no trial came to its end" in fit.problem
    assert "no data could be made" in recovery.problem
    table = recovered(searches)
    assert not table["covers"].any() and table["problem"].notna().all()


def test_what_no_values_give_is_not_plausible(searched):
    (search,) = searched(bowl, budget=200, x=(7.0, 0.01), y=(0.3, 0.01))
    found = found_by(search)
    assert found.plausible == 0 and found.intervals == (None, None)
    assert found.distance > found.luck


def test_where_runs_on_new_seeds_fail_nothing_is_known_of_luck_nor_of_a_surface(searched):
    calls = iter(range(10_000))

    def fails_at_last(a, b, rng):
        return [a, b] if next(calls) < 300 else None

    (search,) = searched(fails_at_last, budget=300, x=(0.5, 0.1), y=(0.5, 0.1))
    found = found_by(search)
    assert math.isnan(found.luck) and found.plausible == 0
    assert found.intervals == (None, None) and found.distance < 0.5
    assert surface_of(search, found.luck) is None


def test_a_model_without_luck_has_an_interval_as_well(searched):
    (search,) = searched(lambda a, b, rng: [a, b], budget=200, x=(0.5, 0.1), y=(0.5, 0.1))
    (low, high), _ = found_by(search).intervals
    assert low < 0.5 < high


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kept", [0, 1, 7, 30, 10_000])
def test_a_search_goes_on_from_its_log_as_if_never_stopped(searched, method, kept):
    searches = searched(bowl, method, budget=120, recover=1, x=(0.36, 0.01), y=(0.3, 0.01))
    whole = searches[1]
    log = [json.loads(json.dumps(one)) for one in _lines(whole)]
    known = {(one["search"], one["kind"], one["number"]): one for one in log[:kept]}
    again = Search(whole.plan, 1, whole.truth)
    groups = again.begin(known)
    left = {(one["search"], one["kind"], one["number"]): one for one in log[kept:]}
    while groups:
        groups += again.take(left.pop(groups.pop(0).key))
    assert left == {}
    assert again.trials == whole.trials and again.finals == whole.finals
    assert found_by(again) == found_by(whole)


def test_a_log_of_another_fit_is_refused(searched):
    (search,) = searched(bowl, budget=40, x=(0.36, 0.01), y=(0.3, 0.01))
    record = dict(search.trials[0], place=[0.0, 0.0])
    with pytest.raises(SocialmindError, match="it is of another fit"):
        Search(search.plan, 0).begin({(0, TRIAL, 0): record})


def test_no_seed_serves_two_purposes(searched):
    (search,) = searched(bowl, budget=40, x=(0.36, 0.01), y=(0.3, 0.01))
    plan = search.plan.__class__(**{**vars(search.plan), "recover": 3, "budget": 150})
    used = seeds_in_use(plan)
    counts = [len(one) for one in used.values()]
    assert sum(counts) == len(set().union(*used.values()))
    assert used["reported"] == set(plan.seeds_of(0, NEW))
    assert set(plan.seeds_of(2, DATA)) | set(plan.seeds_of(1, FINAL, 3)) <= used["recovery"]


def _lines(search):
    """Return the lines of a search's log, in order."""
    data = {"search": 1, "kind": DATA, "number": 0, "place": search.truth.tolist(), "failed": 0}
    rng = [np.random.default_rng(seed) for seed in search.plan.seeds_of(1, DATA)]
    values = search.plan.space.values(search.truth)
    data |= {"error": None, "runs": [[bowl(*values, one)] for one in rng]}
    return [data, *search.trials, *search.finals, search.new]
