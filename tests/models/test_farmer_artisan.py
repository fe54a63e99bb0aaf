"""How farmers and artisans start, perceive, decide and trade: cases worked out by hand."""

import math

import numpy as np
import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model

PRICE = 167.0
Society = load_model("farmer_artisan")

# Scheme and setup --------------------------------------------------------------------------------


def test_the_scheme_is_that_of_the_thesis():
    scheme = CognitiveScheme.load(Society.folder() / "scheme.yaml")
    buy, sell, grow, make = (
        "TradeWheatForTools",
        "TradeToolsForWheat",
        "GrowWheat",
        "ProduceTools",
    )
    links = {
        one.name: (dict(one.influence), one.conditional, dict(one.reinforcement))
        for one in scheme.cognitons
    }
    assert links == {
        "ToolStock": ({buy: -1, sell: 5}, (sell,), {}),
        "WheatStock": ({buy: 0.02, sell: -0.1}, (buy,), {}),
        "WheatNeed": ({buy: -0.5, sell: 0.5, grow: 1}, (), {}),
        "WheatDemand": ({sell: -0.5, grow: 0.5}, (), {}),
        "ToolDemand": ({make: 0.5, buy: -0.5}, (make,), {}),
        "Farmer": ({grow: 5}, (grow,), {buy: 0.05, sell: -0.05}),
        "Artisan": ({make: 5}, (make,), {buy: -0.05, sell: 0.05}),
    }
    assert {one.name for one in scheme.cognitons if not one.starting} == {"ToolStock"}
    assert {one.start_value for one in scheme.cognitons} == {0}
    assert type(scheme.decision_maker).__name__ == "BiasedWeightedStochastic"
    assert scheme.decision_maker.bias == 2.6


def test_the_defaults_are_the_original_s():
    assert {name: one.default for name, one in Society.parameters.items()} == {
        "n_agents": 25,
        "tool_price": 167,
        "food_decay": 0.003312,
        "tool_durability": 184,
        "max_tool_production": 0.076,
        "demand_intensity": 1.01,
        "plan_duration": 40,
        "starvation": False,
        "world_size": 33,
        "n_villages": 1,
    }
    assert Society.ticks == 500_000


def test_agents_and_village_start_with_their_stocks(make, play):
    society = make(n_agents=200, tool_price=100.0)
    assert set(society.humans.tools) == {10.0}
    assert set(society.humans.wheat) == {500.0}
    assert set(society.humans.spacing) == {20.0}
    assert set(society.humans.land_x) == {None}
    assert society.plans(society.humans) == [None] * 200
    (village,) = society.villages
    assert (village.x, village.y) == (0, 0)
    assert (village.ware, village.staple) == (50, 5000)
    assert play.demands(village) == (0, 0)


def test_agents_start_anywhere_in_the_world(make):
    society = make(n_agents=2000)
    for axis in (society.humans.x, society.humans.y):
        assert axis.min() >= -16.5
        assert axis.max() < 16.5
        # A quarter of them in each quarter, within five standard errors.
        counts, _ = np.histogram(axis, 4, (-16.5, 16.5))
        assert np.abs(counts - 500).max() < 5 * math.sqrt(2000 * 0.25 * 0.75)
        assert len(set(axis)) == 2000
    assert set(society.humans.heading) <= set(range(360))


@pytest.mark.parametrize("n_villages", [1, 2, 6])
def test_the_patches_round_the_villages_are_taken(make, n_villages):
    society = make(n_villages=n_villages)
    taken = {tuple(place) for place in np.argwhere(society.world.taken) + society.world.low}
    assert taken == {
        (village.x + dx, village.y + dy)
        for village in society.villages
        for dx in (-1, 0, 1)
        for dy in (-1, 0, 1)
    }
    assert set(society.world.tool_activity.ravel()) == {12_700}
    assert set(society.world.wheat_activity.ravel()) == {12_800}


# Perception and decisions ------------------------------------------------------------------------


def test_perception(make, play):
    society = make()
    human, (village,) = society.humans[0], society.villages
    human.wheat, human.tools = 700.0, 3.5
    village.staple_demand, village.ware_demand = 4.0, -6.0
    play.follow(society, None)
    assert play.cogniton(human, "WheatNeed") == 100.0
    assert play.cogniton(human, "WheatStock") == 700.0
    assert play.cogniton(human, "WheatDemand") == 4.0
    assert play.cogniton(human, "ToolDemand") == -6.0
    values = society.humans.cogniton("ToolStock")
    assert np.isnan(values).all()  # inactive until the first tool is made or bought
    human.mind.activate_cogniton("ToolStock")
    play.follow(society, None)
    assert play.cogniton(human, "ToolStock") == 3.5


def test_wheat_need_falls_under_zero_with_plenty(make, play):
    society = make()
    society.humans[0].wheat = 1000.0
    assert play.cogniton(play.follow(society, None), "WheatNeed") == -200.0


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (10.0, 10.0 * 0.999999),
        (-10.0, -10.0 * 0.999999),
        (0.0, 0.0),
        # What is at the bound fades; the clip looks at the value before, and beyond it the bound
        # itself is what is written, although the faded value would be less.
        (30.0, 30.0 * 0.999999),
        (-30.0, -30.0 * 0.999999),
        (30.00001, 30.0),
        (-30.00001, -30.0),
        (31.0, 30.0),
        (-45.0, -30.0),
    ],
)
def test_callings_fade_within_their_bound(make, before, after, play):
    society = make()
    human = society.humans[0]
    human.mind.set_cogniton_value("Farmer", before)
    human.mind.set_cogniton_value("Artisan", -before)
    play.follow(society, None)
    assert play.cogniton(human, "Farmer") == after
    assert play.cogniton(human, "Artisan") == -after


def test_wheat_spoils_at_decisions_only(make, play):
    society = make(food_decay=0.25, plan_duration=2)
    human = play.settle(society, 10, 0)
    play.place(human, 4.0, 0.0)
    human.wheat, human.tools = 800.0, 0.0  # wheat grows or tools are made: on the land, 6 away
    wheat, timers, decisions = [], [], []
    for _ in range(4):
        human.mind.set_cogniton_value("Farmer", 30.0)
        society.villages[0].ware = 0.0
        society.advance(1)
        if human.plan == "TradeWheatForTools":
            pytest.fail("Farmer at 30 outweighs trade by far")
        wheat.append(human.wheat)
        timers.append(human.timer)
        decisions.append(int(society.humans.society.minds.draws[0]))
    # A decision at timer 0; then two ticks on the way; then the next decision.
    assert wheat == [600.0, 600.0, 600.0, 450.0]
    assert timers == [2, 1, 0, 2]
    assert decisions == [1, 1, 1, 2]


def test_a_timer_that_counts_down_carries_the_plan_out(make, play):
    society = make()
    play.settle(society, 10, 0)
    human = society.humans[0]
    play.place(human, 4.0, 0.0)
    play.follow(society, "GrowWheat", timer=1)
    assert (human.x, human.timer, human.plan) == (5.0, 0, "GrowWheat")


def test_a_plan_that_ends_is_followed_by_a_decision(make, play):
    society = make(food_decay=0.5)
    human = play.settle(society, 10, 0)
    human.tool_state, human.wheat = 0.0, 100.0
    gain = play.draws(society).integers(3)
    play.follow(society, "GrowWheat", timer=30)
    assert (human.timer, human.wheat) == (0, 100.0 + gain)
    society.advance(1)
    assert int(society.humans.society.minds.draws[0]) == 1


# Trade -------------------------------------------------------------------------------------------


def test_buying_a_tool(make, play):
    society = make()
    human, village = play.trader(society)
    reward = play.draws(society).uniform(0, 10)
    play.follow(society, "TradeWheatForTools")
    assert (human.tools, human.wheat) == (11.0, 1000.0 - PRICE)
    assert (village.ware, village.staple) == (39.0, 8350.0 + PRICE)
    assert 0 <= reward < 10
    assert play.cogniton(human, "Farmer") == 1.0 * 0.999999 + reward * 0.05
    assert play.cogniton(human, "Artisan") == 2.0 * 0.999999 + reward * -0.05
    assert not np.isnan(society.humans.cogniton("ToolStock")[0])
    assert human.timer == 0
    # The perception is that of the tick's begin: (8350 - 40 * 167) / (50 * 167) = 0.2.
    signal = 1.01 * 0.2
    assert play.demands(village) == pytest.approx(((0.5 - signal) * 0.99, (0.25 + signal) * 0.99))


def test_selling_a_tool(make, play):
    society = make(demand_intensity=2.0)
    human, village = play.trader(society, tools=1.0, ware=60.0)
    human.mind.activate_cogniton("ToolStock")
    reward = play.draws(society).uniform(0, 10)
    play.follow(society, "TradeToolsForWheat")
    assert (human.tools, human.wheat) == (0.0, 1000.0 + PRICE)
    assert (village.ware, village.staple) == (61.0, 8350.0 - PRICE)
    assert play.cogniton(human, "Farmer") == 1.0 * 0.999999 + reward * -0.05
    assert play.cogniton(human, "Artisan") == 2.0 * 0.999999 + reward * 0.05
    assert human.timer == 0
    # (8350 - 60 * 167) / 8350 = -0.2, twice.
    assert play.demands(village) == pytest.approx(((0.5 + 0.4) * 0.99, (0.25 - 0.4) * 0.99))
    # The tool is gone, but ToolStock stays active until a sale is tried without one.
    assert not np.isnan(society.humans.cogniton("ToolStock")[0])


def test_another_price_counts_in_all_that_trade_does(make, play):
    society = make(tool_price=100.0)
    human, village = play.trader(society, staple=6000.0)
    play.follow(society, "TradeWheatForTools")
    assert (human.tools, human.wheat, village.ware, village.staple) == (11.0, 900.0, 39.0, 6100.0)
    # (6000 - 40 * 100) / (50 * 100) = 0.4.
    signal = 1.01 * 0.4
    assert play.demands(village) == pytest.approx(((0.5 - signal) * 0.99, (0.25 + signal) * 0.99))
    play.trader(society, staple=150.0)  # poor, but not too poor for this price
    play.follow(society, "TradeToolsForWheat")
    assert (human.tools, human.wheat, village.ware, village.staple) == (9.0, 1100.0, 41.0, 50.0)
    assert (human.bought, human.sold) == (1, 1)


@pytest.mark.parametrize("x", [0.0, 9.0])
def test_no_tool_to_buy(make, x, play):
    society = make()
    human, village = play.trader(society, ware=1.0)
    play.place(human, x, 0.0)
    play.follow(society, "TradeWheatForTools")
    assert (human.x, human.tools, human.wheat, human.timer) == (x, 10.0, 1000.0, 0)
    assert (village.ware, village.staple) == (1.0, 8350.0)
    signal = 1.01 * (8350 - PRICE) / (50 * PRICE)
    assert play.demands(village) == pytest.approx(((0.5 - signal) * 0.99, (0.25 + signal) * 0.99))
    assert play.cogniton(human, "Farmer") == 0.999999


@pytest.mark.parametrize("x", [0.0, 9.0])
def test_a_village_too_poor_to_buy(make, x, play):
    society = make()
    human, village = play.trader(society, staple=PRICE)
    play.place(human, x, 0.0)
    play.follow(society, "TradeToolsForWheat")
    assert (human.x, human.tools, human.wheat, human.timer) == (x, 10.0, 1000.0, 0)
    assert (village.ware, village.staple) == (40.0, PRICE)
    signal = 1.01 * (PRICE - 40 * PRICE) / (50 * PRICE)
    assert play.demands(village) == pytest.approx(((0.5 - signal) * 0.99, (0.25 + signal) * 0.99))


def test_nothing_to_sell(make, play):
    society = make()
    human, village = play.trader(society, tools=0.999)
    human.mind.activate_cogniton("ToolStock")
    play.follow(society, "TradeToolsForWheat")
    assert np.isnan(society.humans.cogniton("ToolStock")[0])
    assert (human.tools, human.wheat, human.timer) == (0.999, 1000.0, 0)
    assert play.demands(village) == pytest.approx((0.5 * 0.99, 0.25 * 0.99))  # no signal


@pytest.mark.parametrize("plan", ["TradeWheatForTools", "TradeToolsForWheat"])
def test_a_trader_walks_to_the_village(make, plan, play):
    society = make()
    human, village = play.trader(society)
    play.place(human, 3.0, 4.0)
    play.follow(society, plan)
    assert (human.x, human.y) == pytest.approx((2.4, 3.2))
    assert human.heading == pytest.approx(180 + math.degrees(math.atan2(3, 4)))
    assert human.timer == 8
    assert play.demands(village) == pytest.approx((0.5 * 0.99, 0.25 * 0.99))
    assert human.wheat == 1000.0


@pytest.mark.parametrize("plan", ["TradeWheatForTools", "TradeToolsForWheat"])
def test_trade_keeps_wheat_and_tools(make, plan, play):
    society = make()
    human, village = play.trader(society)
    play.follow(society, plan)
    assert human.tools != 10.0
    assert human.tools + village.ware == 50.0
    assert human.wheat + village.staple == 9350.0


def test_the_village_s_stocks_and_the_agents_add_up_over_a_run(make):
    # Without decay, harvests and products, no wheat and no tools come or go.
    society = make(n_agents=25, food_decay=0.0, max_tool_production=0.0)
    for human in society.humans:
        human.mind.set_cogniton_value("Farmer", -30.0)
    humans, villages = society.humans, society.villages
    tools = humans.tools.sum() + villages.ware.sum()
    trades = 0
    for _ in range(60):
        before = villages.ware[0], int(society.world.wheat_activity.sum())
        wheat = humans.wheat.sum() + villages.staple.sum()
        worn = humans.tool_state.copy()
        society.advance(1)
        trades += villages.ware[0] != before[0]
        grown = int(society.world.wheat_activity.sum()) - before[1]
        if grown == 0:
            assert humans.wheat.sum() + villages.staple.sum() == pytest.approx(wheat)
        taken = int(((humans.tool_state > worn) & (worn <= 1)).sum())
        tools -= taken  # a tool in hand is no longer in the stock
        assert humans.tools.sum() + villages.ware.sum() == pytest.approx(tools)
    assert trades > 0
