"""The market: perception, signals, fading and trade, alike at both speeds."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind import Agent, Model, Population, each, parameter
from socialmind.economy import (
    Market,
    buy_ware,
    demand_perception,
    fade_demand,
    sell_ware,
    signal_demand,
)

stocks = st.floats(0.0, 1e6, allow_subnormal=False)
prices = st.floats(0.01, 1e4)


def market(**values):
    fields = dict.fromkeys(("staple", "ware", "staple_demand", "ware_demand", "perception"), 0.0)
    return SimpleNamespace(**(fields | values))


@pytest.mark.parametrize(
    ("staple", "ware", "perceived"),
    [
        (8350.0, 50.0, 0.0),  # as the price says
        (8350.0, 40.0, 0.2),  # tools are scarce
        (0.0, 50.0, -1.0),  # wheat is
        (8350.0, 60.0, -0.2),
        (16_700.0, 0.0, 2.0),
    ],
)
def test_perception_by_hand(staple, ware, perceived):
    assert demand_perception(staple, ware, 167.0, 50.0) == pytest.approx(perceived)


@given(stocks, stocks, prices, st.floats(0.1, 1e3))
def test_perception_is_above_zero_when_the_ware_is_scarcer(staple, ware, price, plenty):
    perceived = demand_perception(staple, ware, price, plenty)
    balance = staple - ware * price
    assert (perceived > 0) == (balance > 0)
    assert (perceived < 0) == (balance < 0)
    assert perceived * plenty * price == pytest.approx(balance, rel=1e-9, abs=1e-6)


@given(st.floats(-1e3, 1e3), st.floats(0.0, 10.0), st.integers(1, 20))
def test_signals_move_both_demands_by_as_much_and_apart(perception, intensity, times):
    place = market(perception=perception)
    for _ in range(times):
        signal_demand(place, intensity)
    assert place.ware_demand == -place.staple_demand
    assert place.ware_demand == pytest.approx(times * intensity * perception, abs=1e-6)
    assert (place.perception, place.staple, place.ware) == (perception, 0.0, 0.0)


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(0.0, 1.0))
def test_fading_takes_the_same_share_of_both(staple_demand, ware_demand, rate):
    place = market(staple_demand=staple_demand, ware_demand=ware_demand)
    fade_demand(place, rate)
    assert place.staple_demand == pytest.approx(staple_demand * (1 - rate), abs=1e-9)
    assert place.ware_demand == pytest.approx(ware_demand * (1 - rate), abs=1e-9)


@given(st.integers(0, 10**6), st.integers(0, 10**6), st.integers(1, 10**4))
def test_buying_and_selling_are_each_other_s_reverse(staple, ware, price):
    place = market(staple=float(staple), ware=float(ware))
    buy_ware(place, float(price))
    assert (place.ware, place.staple) == (ware - 1, staple + price)
    sell_ware(place, float(price))
    assert (place.ware, place.staple) == (ware, staple)


@given(st.integers(0, 10**5), st.integers(0, 10**4), st.integers(1, 10**3), st.booleans())
def test_a_trade_keeps_the_worth_at_the_price(staple, ware, price, buys):
    place = market(staple=float(staple), ware=float(ware))
    (buy_ware if buys else sell_ware)(place, float(price))
    assert place.staple + place.ware * price == staple + ware * price


class Trader(Agent):
    bought: int = 0


def look(stall, model):
    stall.perception = demand_perception(stall.staple, stall.ware, model.price, 50.0)


def trade(trader, model, rng):
    stall = model.stalls[0]
    if rng.random() < 0.6 and stall.ware > 1:
        buy_ware(stall, model.price)
        trader.bought += 1
    elif stall.staple > model.price:
        sell_ware(stall, model.price)
        trader.bought -= 1
    signal_demand(stall, 1.01)


def fade(stall):
    fade_demand(stall, 0.01)


class Fair(Model):
    price: float = parameter(3.7, unit="grain a pot", low=0.0)
    stalls = Population(Market, 1)
    traders = Population(Trader, 20)
    schedule = (each(stalls, look), each(traders, trade), each(stalls, fade))


def test_a_market_begins_empty_and_neutral():
    (stall,) = Fair(1, compiled=False).stalls
    assert (stall.staple, stall.ware) == (0.0, 0.0)
    assert (stall.staple_demand, stall.ware_demand, stall.perception) == (0.0, 0.0, 0.0)


def test_in_rules_it_is_the_same_at_both_speeds():
    compiled, interpreted = Fair(1), Fair(1, compiled=False)
    for society in (compiled, interpreted):
        society.stalls[0].ware, society.stalls[0].staple = 30.0, 200.0
        society.advance(200)
    for name in ("staple", "ware", "staple_demand", "ware_demand", "perception"):
        assert list(getattr(compiled.stalls, name)) == list(getattr(interpreted.stalls, name))
    stall = compiled.stalls[0]
    assert stall.ware + compiled.traders.bought.sum() == 30
    assert stall.staple + stall.ware * 3.7 == pytest.approx(200 + 30 * 3.7)
    assert stall.ware_demand != 0
