"""Villages with a culture: communities are founded and joined, demands are shared and fade."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder

NAME = "farmers_artisans_traders"


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make villages with few people, at either speed."""

    def made(n_agents=2, **parameters):
        return load_model(NAME)(5, compiled=request.param, n_agents=n_agents, **parameters)

    return made


def settle(society, agent, village=0):
    """Let an agent claim the land under it, beside a village; it joins the community there."""
    human, home = society.humans[agent], society.villages[village]
    human.x, human.y = home.x + 2.0 + agent, home.y
    human.spacing = 0.1
    human.plan, human.timer = "GrowWheat", 9
    return human


def go_on(human, plan):
    human.plan, human.timer = plan, 9


def test_the_scheme_is_that_of_coglogo():
    scheme = CognitiveScheme.load(model_folder(NAME) / "scheme.yaml")
    assert (scheme.decision_maker.name, scheme.decision_maker.bias) == (
        "BiasedWeightedStochastic",
        3,
    )
    found = {one.name: (dict(one.influence), dict(one.reinforcement)) for one in scheme.cognitons}
    buys, sells = "TradeWheatForTools", "TradeToolsForWheat"
    assert found == {
        "ToolStock": ({buys: -1, sells: 10}, {}),
        "WheatStock": ({buys: 0.02, sells: -0.1}, {}),
        "WheatNeed": ({sells: 1, "GrowWheat": 1}, {}),
        "Farmer": ({"GrowWheat": 10}, {buys: 0.1, sells: -0.1}),
        "Artisan": ({"ProduceTools": 10}, {buys: -0.1, sells: 0.1}),
    }
    community = scheme.groups[0]
    assert [role.name for role in community.roles] == ["founder", "member"]
    for role in community.roles:
        wants = {one.name: one for one in role.culturons}
        assert dict(wants["ToolDemand"].influence) == {"ProduceTools": 1}
        assert tuple(wants["ToolDemand"].conditional) == ("ProduceTools",)
        assert dict(wants["WheatDemand"].influence) == {"GrowWheat": 1}
        assert tuple(wants["WheatDemand"].conditional) == ()


def test_villages_lie_apart_and_take_the_patches_round_them():
    for seed in range(20):
        society = load_model(NAME)(seed, compiled=False, n_villages=9, n_agents=1)
        places = {(village.x, village.y) for village in society.villages}
        assert len(places) == 9
        assert 9 < society.world.taken.sum() <= 81


def test_the_first_on_land_founds_the_community_and_later_ones_join(make):
    society = make(n_agents=3)
    for agent, village in ((0, 1), (1, 1), (2, 2)):
        settle(society, agent, village)
    society.advance(1)
    minds = [human.mind for human in society.humans]
    homes = [human.village for human in society.humans]
    assert homes == [1, 1, 2]
    assert minds[0].get_group_id("community") == minds[1].get_group_id("community")
    assert minds[2].get_group_id("community") != minds[0].get_group_id("community")
    founders = [mind.get_group_role_id("community", "founder") >= 0 for mind in minds]
    assert sorted(founders[:2]) == [False, True]
    assert founders[2]
    assert [mind.get_participation("community") for mind in minds] == [1.0, 1.0, 1.0]
    assert society.series()["people_of_1"] == 2
    assert society.villages[0].community is None


def test_one_community_for_all_villages(make):
    society = make(one_community=True)
    settle(society, 0, 1)
    settle(society, 1, 2)
    society.advance(1)
    ids = [human.mind.get_group_id("community") for human in society.humans]
    assert ids[0] == ids[1] >= 0


def test_what_cannot_be_bought_or_sold_becomes_a_demand_of_ones_own_community(make):
    society = make(n_agents=3, demand_fading=0.0)
    for agent, village in ((0, 0), (1, 0), (2, 1)):
        settle(society, agent, village)
    society.advance(1)
    home = society.villages[0]
    home.ware, home.staple = 1.0, 120.0
    society.humans[0].tools = 3.0
    go_on(society.humans[0], "TradeToolsForWheat")
    go_on(society.humans[1], "TradeWheatForTools")
    go_on(society.humans[2], "GrowWheat")
    society.advance(1)
    for human in list(society.humans)[:2]:
        assert human.timer == 0
        assert human.mind.get_culturon_value("community", "ToolDemand") == pytest.approx(0.1)
        assert human.mind.get_culturon_value("community", "WheatDemand") == pytest.approx(0.1)
    other = society.humans[2].mind
    assert other.get_culturon_value("community", "ToolDemand") == 0.0
    series = society.series()
    assert series["ToolDemand_of_0"] == pytest.approx(0.1)
    assert series["ToolDemand_of_1"] == series["ToolDemand_of_2"] == 0.0
    assert series["balance_of_0"] == 120.0 - 1.0


def test_the_demand_moves_every_member_as_much_as_it_is(make):
    society = make(demand_fading=0.0)
    settle(society, 0)
    settle(society, 1)
    society.advance(1)
    minds = [human.mind for human in society.humans]
    before = [mind.plan_weights()["ProduceTools"] for mind in minds]
    minds[0].set_culturon_value("community", "ToolDemand", 7.0)
    after = [mind.plan_weights()["ProduceTools"] for mind in minds]
    assert np.subtract(after, before).tolist() == pytest.approx([7.0, 7.0])


def test_the_founder_alone_lowers_demands_and_not_under_nothing(make):
    society = make()
    settle(society, 0)
    settle(society, 1)
    society.advance(1)
    mind = society.humans[0].mind
    mind.set_culturon_value("community", "ToolDemand", 1.0)
    mind.set_culturon_value("community", "WheatDemand", 0.005)
    for human in society.humans:
        go_on(human, "GrowWheat")
    society.advance(1)  # two members, lowered once
    assert mind.get_culturon_value("community", "ToolDemand") == pytest.approx(0.99)
    assert mind.get_culturon_value("community", "WheatDemand") == 0.0


def test_a_purchase_and_a_sale(make):
    society = make()
    buyer, seller = settle(society, 0), settle(society, 1)
    society.advance(1)
    home = society.villages[0]
    wheat, ware, staple = buyer.wheat, home.ware, home.staple
    for human, plan in ((buyer, "TradeWheatForTools"), (seller, "TradeToolsForWheat")):
        human.x, human.y = home.x, home.y
        human.tools = 2.0
        go_on(human, plan)
    for calling in ("Farmer", "Artisan"):
        buyer.mind.set_cogniton_value(calling, 1.0)
    society.advance(1)
    assert (buyer.tools, seller.tools, buyer.bought, seller.sold) == (3.0, 1.0, 1, 1)
    assert buyer.wheat == wheat - 120.0
    assert (home.ware, home.staple) == (ware, staple)
    farmer, artisan = (buyer.mind.get_cogniton_value(name) for name in ("Farmer", "Artisan"))
    assert 0.9999 < farmer <= 1.9999
    assert farmer + artisan == pytest.approx(2 * 0.9999)


def test_callings_fade(make):
    society = make()
    human = settle(society, 0)
    human.mind.set_cogniton_value("Farmer", 10.0)
    human.mind.set_cogniton_value("Artisan", -40.0)
    society.advance(1)
    assert human.mind.get_cogniton_value("Farmer") == pytest.approx(9.999)
    assert human.mind.get_cogniton_value("Artisan") == -30.0
