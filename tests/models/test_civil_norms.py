"""Norms, gifts, sanctions and changing sides: cases worked out by hand, and what no norm does."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import load_figures, load_model

Society = load_model("civil_norms")
STILL = {"food_supply": 0.0, "spoilage": 0.0, "fertility": 0.0, "mortality": 0.0, "sight": 10.0}
SURE = 1e12  # a norm that nobody of obedience 1 breaks


def pair(seed=1, stores=(20.0, 3.0), obedience=(1.0, 1.0), compiled=False, **parameters):
    """Two gatherers beside each other in a land where nothing grows."""
    society = Society(seed, compiled, n_gatherers=2, **{**STILL, **parameters})
    for gatherer, store, bound in zip(society.gatherers, stores, obedience, strict=True):
        gatherer.x = gatherer.y = 0.0
        gatherer.store = gatherer.fare = store
        gatherer.mind.set_participation("Civilisation", bound)
    return society


def norms(gatherer):
    mind = gatherer.mind
    return tuple(
        mind.get_culturon_value("Civilisation", name) for name in ("NormOfSharing", "NormOfKeeping")
    )


def obedience(gatherer):
    return gatherer.mind.get_participation("Civilisation")


# Culture ------------------------------------------------------------------------------------------


def test_only_the_values_of_culturons_tell_civilisations_apart():
    society = Society(3, compiled=False, n_gatherers=10, share_of_sharers=0.3, norm=7.0)
    assert list(society.gatherers.civilisation) == [0] * 3 + [1] * 7
    groups = [one.mind.get_group_id("Civilisation") for one in society.gatherers]
    assert groups == [society.group[0]] * 3 + [society.group[1]] * 7
    assert [norms(one) for one in society.gatherers] == [(7.0, 0.0)] * 3 + [(0.0, 7.0)] * 7
    assert len({str(one.mind.cognitons()) for one in society.gatherers}) == 1


@pytest.mark.parametrize("bound", [0.0, 0.25, 1.0])
def test_obedience_says_how_far_the_norm_counts(bound):
    society = Society(3, compiled=False, n_gatherers=2, norm=8.0)
    sharer, keeper = society.gatherers
    for one in (sharer, keeper):
        one.mind.set_participation("Civilisation", bound)
    expected = (1 + 8 * bound) / (2 + 8 * bound)
    assert sharer.mind.plan_probabilities()["Share"] == pytest.approx(expected)
    assert keeper.mind.plan_probabilities()["Keep"] == pytest.approx(expected)


# Gifts --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_who_shares_gives_half_of_the_difference(seed):
    society = pair(seed, share_of_sharers=1.0, norm=SURE)
    society.advance(1)
    # Both eat 1. If the needy one ate before, it had 2 and was given 9, otherwise 8.5.
    assert tuple(society.gatherers.store) in {(10.0, 11.0), (10.5, 10.5)}
    assert society.plans(society.gatherers)[0] == "Share"
    assert list(society.gatherers.gifts) == [1, 0]
    assert list(society.occasions) == list(society.shared) == [1, 0]


@pytest.mark.parametrize("seed", range(4))
def test_who_keeps_gives_nothing(seed):
    society = pair(seed, share_of_sharers=0.0, norm=SURE)
    society.advance(1)
    assert list(society.gatherers.store) == [19.0, 2.0]
    assert society.plans(society.gatherers)[0] == "Keep"
    assert list(society.occasions) == [0, 1]
    assert list(society.shared) == list(society.breaches) == [0, 0]


def test_a_parochial_eye_sees_only_its_own_people():
    society = pair(norm=SURE)
    society.advance(1)
    assert list(society.plans(society.gatherers)) == [None, None]
    society = pair(norm=SURE, parochial=False)
    society.advance(1)
    assert list(society.plans(society.gatherers)) == ["Share", None]


def test_nobody_decides_where_nobody_is_in_need():
    society = pair(stores=(20.0, 9.0), share_of_sharers=1.0)
    society.advance(1)
    assert list(society.plans(society.gatherers)) == [None, None]


# Sanctions ----------------------------------------------------------------------------------------


def after_a_breach(**parameters):
    """Return a pair of sharers one tick after the first kept what the second needed.

    The norm is so weak that they toss a coin.
    """
    for seed in range(20):
        society = pair(seed, share_of_sharers=1.0, norm=1e-12, **parameters)
        society.advance(1)
        if society.plans(society.gatherers)[0] == "Keep":
            return society
    raise AssertionError("nobody kept")


def test_a_breach_that_a_member_punishes_costs_both_and_binds_the_culprit():
    society = after_a_breach(obedience=(0.5, 1.0))
    culprit, witness = society.gatherers
    assert (culprit.store, witness.store) == pytest.approx((20 - 1 - 1, 3 - 0.2 - 1))
    assert obedience(culprit) == pytest.approx(0.7)
    assert obedience(witness) == 1.0
    assert (list(society.breaches), list(society.sanctions)) == ([1, 0], [1, 0])
    assert culprit.sanctioned == 1


@pytest.mark.parametrize(
    "case",
    [
        {"obedience": (0.5, 0.0)},
        {"obedience": (0.5, 1.0), "sanctions_on": False},
        {"obedience": (0.5, 1.0), "sanction_cost": 4.0},
    ],
    ids=["a witness without obedience", "no sanctions", "too dear"],
)
def test_a_breach_that_nobody_punishes_costs_nothing_and_loosens(case):
    society = after_a_breach(**case)
    culprit, witness = society.gatherers
    assert (culprit.store, witness.store) == (19.0, 2.0)
    assert obedience(culprit) == pytest.approx(0.45)
    assert (list(society.breaches), list(society.sanctions)) == ([1, 0], [0, 0])


# Changing sides, births and deaths ----------------------------------------------------------------


def test_who_fares_worse_joins_the_others():
    society = pair(stores=(20.0, 9.0), curiosity=1.0, norm=4.0)
    society.advance(1)
    assert list(society.gatherers.civilisation) == [0, 0]
    assert [norms(one) for one in society.gatherers] == [(4.0, 0.0)] * 2
    assert len({one.mind.get_group_id("Civilisation") for one in society.gatherers}) == 1
    assert list(society.joined) == [1, 0]


def test_what_counts_is_the_fare_of_the_past():
    society = pair(stores=(20.0, 9.0), curiosity=1.0, forgetting=0.0)
    society.gatherers[0].fare = 1.0
    society.advance(1)
    assert list(society.gatherers.civilisation) == [1, 1]


def test_a_child_belongs_to_the_civilisation_of_its_parent():
    society = pair(stores=(20.0, 9.0), fertility=1.0, norm=4.0)
    society.advance(1)
    assert list(society.gatherers.civilisation) == [0, 1, 0]
    assert list(society.gatherers.store) == [14.0, 8.0, 5.0]
    assert norms(society.gatherers[2]) == (4.0, 0.0)
    assert list(society.born) == [1, 0]


def test_who_has_nothing_to_eat_starves():
    society = pair(stores=(20.0, 0.5))
    society.advance(1)
    assert list(society.gatherers.id) == [0]
    assert list(society.starved) == [0, 1]


# Other norms, other outcome; no norms, none -------------------------------------------------------


def test_alone_and_without_culturons_both_civilisations_are_the_same_to_the_last_bit():
    sharers, keepers = (Society(5, norm=0.0, share_of_sharers=share) for share in (1.0, 0.0))
    for society in (sharers, keepers):
        society.advance(500)
    for name in ("id", "x", "y", "store", "fare", "gifts"):
        found, expected = (list(getattr(one.gatherers, name)) for one in (sharers, keepers))
        assert found == expected, name
    assert list(sharers.starved) == list(keepers.starved)[::-1]


def wins_of_sharers(seeds, **parameters):
    """In how many runs more sharers than keepers are left."""
    wins = 0
    for seed in range(seeds):
        society = Society(seed, **parameters)
        society.advance(600)
        now = society.series()
        wins += now["sharers"] > now["keepers"]
    return wins


@pytest.mark.parametrize("parochial", [True, False])
def test_together_and_without_culturons_neither_is_the_likelier_to_win(parochial):
    # Of 40 tosses of a coin, 12 … 28 heads: all but 1 % of what comes.
    assert 12 <= wins_of_sharers(40, norm=0.0, parochial=parochial) <= 28


def test_with_norms_sharers_win_among_themselves_and_lose_to_those_they_feed():
    assert wins_of_sharers(10) >= 9
    assert wins_of_sharers(10, parochial=False) <= 1


def test_inequality_is_that_of_gini():
    gini = Society.series.__globals__["gini"]
    assert gini(np.array([])) == gini(np.array([0.0])) == 0.0
    # Differences of all pairs, 1 2 3: 2·(1 + 2 + 1) = 8; over 2 · 3² · mean 2 = 36.
    assert gini(np.array([3.0, 1.0, 2.0])) == pytest.approx(8 / 36)


@pytest.mark.parametrize("share", [0.5, 1.0])
def test_its_figures_are_drawn(share):
    society = Society(1, compiled=False, n_gatherers=12, share_of_sharers=share)
    series, agents = [], []
    for tick in (0, 20, 40):
        society.advance(tick - society.tick)
        series.append({"tick": tick, **society.series()})
        agents.append(pd.DataFrame({"tick": tick, **society.agents()}))
    run = SimpleNamespace(
        series=pd.DataFrame(series),
        agents=pd.concat(agents, ignore_index=True),
        parameters=society.parameter_values(),
    )
    figures = load_figures(Society.folder()).draw(run)
    assert list(figures) == ["outcome", "region"]
    lines = figures["outcome"].axes[0].lines
    assert [list(line.get_ydata()) for line in lines] == [
        [row[name] for row in series] for name in ("sharers", "keepers")
    ]
