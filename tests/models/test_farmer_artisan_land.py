"""How farmers and artisans work, claim land and walk: cases worked out by hand."""

import math

import numpy as np
import pytest

# Work --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("state", "tools", "most", "state_after", "tools_after"),
    [
        (3.0, 2.0, 8, 2.0, 2.0),  # a working tool
        (1.0, 2.0, 8, 184.0, 1.0),  # its last work: the next one is taken at once
        (1.0, 0.999, 8, 0.0, 0.999),  # none to take
        (1.0, 0.9995, 8, 184.0, -0.0005),  # nearly a whole one is enough
        (0.0, 5.0, 3, 184.0, 4.0),  # none in hand: bare hands, then the next one
        (0.0, 0.5, 3, 0.0, 0.5),
    ],
)
def test_growing_wheat(make, state, tools, most, state_after, tools_after, play):
    society = make()
    human = play.settle(society, 5, -7)
    human.wheat, human.tools, human.tool_state = 100.0, tools, state
    gain = play.draws(society).integers(most)
    play.follow(society, "GrowWheat")
    assert human.wheat == 100.0 + gain
    assert (human.tool_state, human.tools) == (state_after, pytest.approx(tools_after))
    assert human.timer == 0
    patch = society.world.patch(5, -7)
    assert (patch.tool_activity, patch.wheat_activity) == (12_699, 12_801)


@pytest.mark.parametrize(("state", "harvest"), [(1e9, range(8)), (0.0, range(3))])
def test_a_harvest_is_any_whole_number_below_its_bound(make, state, harvest, play):
    society = make()
    human = play.settle(society, 5, -7)
    gains = set()
    for _ in range(120):
        human.wheat, human.tools, human.tool_state = 0.0, 0.0, state
        play.follow(society, "GrowWheat")
        gains.add(human.wheat)
    assert gains == set(harvest)


def test_making_tools(make, play):
    society = make()
    human = play.settle(society, 5, -7)
    human.tools = 0.5
    part = play.draws(society).uniform(0, 0.076)
    play.follow(society, "ProduceTools")
    assert human.tools == 0.5 + part
    assert 0 <= part < 0.076
    assert human.timer == 0
    assert np.isnan(society.humans.cogniton("ToolStock")[0])
    patch = society.world.patch(5, -7)
    assert (patch.tool_activity, patch.wheat_activity) == (12_701, 12_799)


@pytest.mark.parametrize(("lacking", "active"), [(-1e-9, True), (1e-9, False)])
def test_the_first_whole_tool_activates_the_tool_stock(make, lacking, active, play):
    society = make()
    human = play.settle(society, 5, -7)
    human.tools = 1.0 - play.draws(society).uniform(0, 0.076) - lacking
    play.follow(society, "ProduceTools")
    assert bool(np.isnan(society.humans.cogniton("ToolStock")[0])) != active


@pytest.mark.parametrize("plan", ["GrowWheat", "ProduceTools"])
def test_nobody_works_off_their_land(make, plan, play):
    society = make()
    human = play.settle(society, 5, 0)
    play.place(human, 8.0, 0.0)
    human.wheat = human.tools = 3.0
    play.follow(society, plan)
    assert (human.x, human.y, human.heading, human.timer) == (7.0, 0.0, 270.0, 8)
    assert (human.wheat, human.tools) == (3.0, 3.0)


def test_the_activity_of_land_stays_in_its_range(make, play):
    society = make()
    play.settle(society, 5, -7)
    patch = society.world.patch(5, -7)
    patch.tool_activity, patch.wheat_activity = 25_500, 0
    play.follow(society, "ProduceTools")
    assert (patch.tool_activity, patch.wheat_activity) == (25_500, 0)
    patch.tool_activity, patch.wheat_activity = 0, 25_500
    play.follow(society, "GrowWheat")
    assert (patch.tool_activity, patch.wheat_activity) == (0, 25_500)


# Land and walking --------------------------------------------------------------------------------


@pytest.mark.parametrize("plan", ["GrowWheat", "ProduceTools"])
def test_land_is_claimed_where_none_is_taken_near(make, plan, play):
    society = make()
    human = society.humans[0]
    play.place(human, 10.4, -11.6)
    human.spacing = 5.0
    human.wheat = human.tools = 3.0
    play.follow(society, plan)
    assert (human.land_x, human.land_y) == (10, -12)
    assert society.world.patch(10, -12).taken
    assert (human.x, human.y, human.spacing, human.timer) == (10.4, -11.6, 5.0, 0)
    assert (human.wheat, human.tools) == (3.0, 3.0)  # the work begins with the next decision


@pytest.mark.parametrize(
    ("x", "spacing", "claims"),
    [
        (6.0, 5.0, False),  # the patch (1, 0) of the village is exactly 5 away
        (6.001, 5.0, True),
        (-15.5, 13.0, True),
        (-15.5, 14.5, False),
    ],
)
def test_taken_land_counts_from_where_the_agent_stands(make, x, spacing, claims, play):
    society = make()
    human = society.humans[0]
    play.place(human, x, 0.0)
    human.spacing = spacing
    play.follow(society, "GrowWheat")
    assert (human.land_x is not None) == claims


def test_taken_land_counts_across_the_edge_of_the_world(make, play):
    society = make()
    human = society.humans[0]
    society.world.patch(-15, 16).taken = True
    play.place(human, 16.0, 16.0)
    human.spacing = 2.0
    play.follow(society, "GrowWheat")
    assert human.land_x is None


@pytest.mark.parametrize(
    ("spacing", "after"), [(20.0, 19.5), (2.0, 1.5), (1.5, 5.0), (1.0, 5.0), (5.0, 4.5)]
)
def test_a_search_moves_on_and_asks_for_less(make, spacing, after, play):
    society = make()
    human = society.humans[0]
    play.place(human, 1.0, 1.0)
    human.spacing, human.heading = spacing, 10.0
    stream = play.draws(society)
    heading = (10 + stream.integers(70) - stream.integers(70)) % 360
    play.follow(society, "GrowWheat")
    assert human.land_x is None
    assert human.spacing == after
    assert human.heading == heading
    angle = math.radians(heading)
    assert (human.x, human.y) == pytest.approx(
        (1 + 0.5 * math.sin(angle), 1 + 0.5 * math.cos(angle))
    )
    assert human.timer == 8


def test_everybody_has_land_of_their_own_in_the_end(make):
    society = make(n_agents=25)
    society.advance(1500)
    x, y = society.humans.filled("land_x", 99), society.humans.filled("land_y", 99)
    assert len(set(zip(x, y, strict=True))) == 25
    assert society.humans.holds("land_x").all()
    assert int(society.world.taken.sum()) == 9 + 25


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ((0.0, 2.6), (0.0, 1.6)),
        ((0.0, 0.9), (0.0, 0.0)),  # nearer than 1: exactly onto it
        ((0.6, -0.6), (0.0, 0.0)),
        ((1.0, 0.0), (0.0, 0.0)),
        ((0.0, -16.0), (0.0, -15.0)),
    ],
)
def test_walking(make, start, end, play):
    society = make()
    human = society.humans[0]
    play.place(human, *start)
    play.follow(society, "TradeWheatForTools")
    assert (human.x, human.y) == pytest.approx(end)
    if end == (0.0, 0.0):
        assert (human.x, human.y) == end


def test_walking_takes_the_short_way_round(make, play):
    society = make()
    human = play.settle(society, -15, 3)
    play.place(human, 16.0, 3.0)
    play.follow(society, "GrowWheat")
    assert (human.x, human.y, human.heading) == (-16.0, 3.0, 90.0)
