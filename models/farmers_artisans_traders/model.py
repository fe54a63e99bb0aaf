"""Farmers, artisans and villages with a culture: what a village lacks is known to its community.

Villagers grow wheat or make tools and trade at their village, as in `farmer_artisan`. Here there
are several villages, and each has a community, which the first to take land by it founds. What a
villager could not buy or sell becomes a demand of the community, a culturon, that moves all its
members and no one else. The model is one of those that came with CogLogo (Suro, 2020).
"""

import math

import numpy as np

from socialmind import Agent, Model, Patch, Population, Torus, each, parameter
from socialmind.economy import buy_ware, proportional_decay, sell_ware, towards_neutral
from socialmind.observation import mind_columns

COMFORT = 800.0  # wheat that leaves no need
VILLAGE_TOOLS = 80.0  # of a village at the start
VILLAGE_WHEAT = 800.0
FIRST_WHEAT = 800.0  # of an agent at the start
LAND_SPACING = 20.0  # patches to the next land, when the search begins
CALLING_FACTOR = 0.9999  # what a tick without trade leaves of a calling
CALLING_BOUND = 30.0
LARGEST_REWARD = 10.0  # feed-back of a trade: a number between 0 and this


class Village(Agent):
    """A village: its stocks and its community."""

    staple: float = VILLAGE_WHEAT
    ware: float = VILLAGE_TOOLS
    community: int | None = None


class Human(Agent):
    """A villager: its stocks, its tool in use, its trades and work so far, its land and village."""

    wheat: float = FIRST_WHEAT
    tools: float = 0.0
    bought: int = 0
    sold: int = 0
    grown: int = 0
    made: int = 0
    tool_state: float = 0.0
    timer: int = 0
    spacing: float = LAND_SPACING
    land_x: int | None = None
    land_y: int | None = None
    village: int = 0


class Land(Patch):
    """A patch: whether it belongs to somebody."""

    taken: bool = False


# Setup ------------------------------------------------------------------------------------------


def found_village(village, model, rng):
    """Put a village on a random patch that none has taken, and take the patches round it."""
    world = model.world
    found = False
    while not found:
        village.x = rng.integers(world.low, world.high + 1)
        village.y = rng.integers(world.low, world.high + 1)
        found = not world.patch(village.x, village.y).taken
    for dx in range(-1, 2):
        for dy in range(-1, 2):
            world.patch(village.x + dx, village.y + dy).taken = True


def arrive(human, model, rng):
    """Put an agent on a random place."""
    world = model.world
    human.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    human.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    human.heading = rng.integers(360)
    human.village = nearest_village(human, model)


def nearest_village(human, model):
    """Return the identity of the village nearest to where an agent stands."""
    nearest = 0
    least = math.inf
    for village in model.villages:
        away = model.world.distance(human, village.x, village.y)
        if away < least:
            nearest = village.id
            least = away
    return nearest


# A tick -----------------------------------------------------------------------------------------


def live(human, model, rng):
    """Perceive, let callings and demands fade, and go on with the plan or choose another."""
    perceive(human)
    fade_calling(human, "Farmer")
    fade_calling(human, "Artisan")
    if human.mind.get_group_role_id("community", "founder") >= 0:
        fade_demand(human, "ToolDemand", model)
        fade_demand(human, "WheatDemand", model)
    if human.wheat < 0 and model.starvation:
        human.die()
        return
    if human.timer <= 0:
        human.plan = human.mind.choose_next_plan()
        human.timer = model.plan_duration
        human.run_plan(model, rng)
        human.wheat = proportional_decay(human.wheat, model.food_decay)
    else:
        human.timer -= 1
        human.run_plan(model, rng)


def perceive(human):
    """Give the perceptive cognitons their values."""
    human.mind.set_cogniton_value("WheatStock", human.wheat)
    human.mind.set_cogniton_value("ToolStock", human.tools)
    human.mind.set_cogniton_value("WheatNeed", COMFORT - human.wheat)


def fade_calling(human, calling):
    """Let a calling come to rest when no trade confirms it."""
    value = human.mind.get_cogniton_value(calling)
    rested = towards_neutral(value, CALLING_FACTOR, 0.0, CALLING_BOUND)
    human.mind.set_cogniton_value(calling, rested)


def fade_demand(founder, demand, model):
    """Let a demand of the founder's community fade, not under 0."""
    value = founder.mind.get_culturon_value("community", demand)
    founder.mind.set_culturon_value("community", demand, max(0.0, value - model.demand_fading))


# Plans ------------------------------------------------------------------------------------------


def trade_wheat_for_tools(human, model, rng):
    """Walk to the village and buy a tool; where there is none, let the community know."""
    village = model.villages[human.village]
    if village.ware <= 1:
        human.mind.add_to_culturon_value("community", "ToolDemand", model.demand_step)
        human.timer = 0
    elif model.world.is_on(human, village.x, village.y):
        buy_ware(village, model.tool_price)
        human.tools += 1
        human.bought += 1
        human.wheat -= model.tool_price
        human.mind.feed_back_from_plan("TradeWheatForTools", rng.uniform(0, LARGEST_REWARD))
        human.mind.activate_cogniton("ToolStock")
        human.timer = 0
    else:
        model.world.walk_to(human, village.x, village.y, 1)


def trade_tools_for_wheat(human, model, rng):
    """Walk to the village and sell a tool; where it cannot pay, let the community know."""
    village = model.villages[human.village]
    if human.tools < 1:
        human.mind.deactivate_cogniton("ToolStock")
        human.timer = 0
    elif village.staple <= model.tool_price:
        human.mind.add_to_culturon_value("community", "WheatDemand", model.demand_step)
        human.timer = 0
    elif model.world.is_on(human, village.x, village.y):
        sell_ware(village, model.tool_price)
        human.tools -= 1
        human.sold += 1
        human.wheat += model.tool_price
        human.mind.feed_back_from_plan("TradeToolsForWheat", rng.uniform(0, LARGEST_REWARD))
        human.timer = 0
    else:
        model.world.walk_to(human, village.x, village.y, 1)


def grow_wheat(human, model, rng):
    """Work on one's own land, with a tool if there is one."""
    if on_own_land(human, model, rng):
        if human.tool_state > 0:
            human.wheat += rng.integers(8)
            human.tool_state -= 1
        else:
            human.wheat += rng.integers(3)
        if human.tool_state <= 0 and human.tools > 0.999:
            human.tool_state = model.tool_durability
            human.tools -= 1
        human.grown += 1
        human.timer = 0


def produce_tools(human, model, rng):
    """Make a piece of a tool on one's own land."""
    if on_own_land(human, model, rng):
        human.tools += rng.uniform(0, model.max_tool_production)
        if human.tools >= 1:
            human.mind.activate_cogniton("ToolStock")
        human.made += 1
        human.timer = 0


# Land and community -----------------------------------------------------------------------------


def on_own_land(human, model, rng):
    """Say whether an agent stands on its land; if not, let it claim one or walk there."""
    if human.land_x is None or human.land_y is None:
        claim_land(human, model, rng)
        return False
    if model.world.is_on(human, human.land_x, human.land_y):
        return True
    model.world.walk_to(human, human.land_x, human.land_y, 1)
    return False


def claim_land(human, model, rng):
    """Take the patch under an agent if none is taken near it; else move on and ask for less."""
    world = model.world
    if any(patch.taken for patch in world.in_radius(human, human.spacing)):
        world.right(human, rng.integers(70))
        world.left(human, rng.integers(70))
        world.forward(human, 0.5)
        human.spacing -= 0.5
        if human.spacing <= 1:
            human.spacing = 5
        human.village = nearest_village(human, model)
        return
    land = world.patch(human.x, human.y)
    land.taken = True
    human.land_x = land.x
    human.land_y = land.y
    join_community(human, model)
    human.timer = 0


def join_community(human, model):
    """Join the community of the nearest village, or found it as the first."""
    human.village = nearest_village(human, model)
    village = model.villages[0 if model.one_community else human.village]
    if village.community is None:
        human.mind.create_and_join_group("community", "founder")
        village.community = human.mind.get_group_id("community")
    else:
        human.mind.join_group("community", "member", village.community)


class FarmersArtisansTraders(Model):
    """Villages whose communities share what they lack, as culturons (after CogLogo's model)."""

    ticks = 200_000

    n_agents: int = parameter(17, unit="agents", low=1, high=150, doc="agents at the start")
    n_villages: int = parameter(3, unit="villages", low=1, high=9, doc="villages at random places")
    tool_price: float = parameter(120.0, unit="wheat a tool", low=1e-6, doc="price of a tool")
    food_decay: float = parameter(
        0.00125, unit="share a decision", low=0.0, high=1.0, doc="wheat that spoils"
    )
    tool_durability: float = parameter(
        83.0, unit="working ticks", low=0.0, doc="work that a tool lasts"
    )
    max_tool_production: float = parameter(
        0.0336, unit="tools a working tick", low=0.0, doc="largest part of a tool made in a tick"
    )
    plan_duration: int = parameter(
        30, unit="ticks", low=0, doc="ticks until a plan that goes on is weighed again"
    )
    demand_step: float = parameter(
        0.1, unit="demand a trade", low=0.0, doc="what a trade that fails adds to a demand"
    )
    demand_fading: float = parameter(
        0.01, unit="demand a tick", low=0.0, doc="by which the founder lowers each demand"
    )
    one_community: bool = parameter(False, doc="whether all villages share one community")
    starvation: bool = parameter(False, doc="whether agents under zero wheat die")

    world = Torus(33, Land)
    humans = Population(
        Human,
        "n_agents",
        mind="scheme.yaml",
        plans={
            "TradeWheatForTools": trade_wheat_for_tools,
            "TradeToolsForWheat": trade_tools_for_wheat,
            "GrowWheat": grow_wheat,
            "ProduceTools": produce_tools,
        },
    )
    villages = Population(Village, "n_villages")

    setup = (each(villages, found_village, shuffled=False), each(humans, arrive))
    schedule = (each(humans, live),)

    def series(self):
        """Return the society's numbers, and those of each village."""
        farmer, artisan = self.callings()
        humans, villages = self.humans, self.villages
        numbers = {
            "population": len(humans),
            "farmers": int((farmer > artisan).sum()),
            "artisans": int((artisan > farmer).sum()),
            "wheat": float(humans.wheat.sum()),
            "tools": float(humans.tools.sum()),
            "idle": self.idle.count,
        }
        for village in villages:
            own = self.members() == village.id
            numbers[f"people_of_{village.id}"] = int(own.sum())
            numbers[f"farmers_of_{village.id}"] = int((own & (farmer > artisan)).sum())
            numbers[f"artisans_of_{village.id}"] = int((own & (artisan > farmer)).sum())
            numbers[f"balance_of_{village.id}"] = village.staple - village.ware
            for demand in ("ToolDemand", "WheatDemand"):
                numbers[f"{demand}_of_{village.id}"] = self.demand(village, demand)
        return numbers

    def agents(self):
        """Return each agent's body, land, village and mind."""
        farmer, artisan = self.callings()
        humans = self.humans
        return {
            "agent": humans.id,
            "x": humans.x,
            "y": humans.y,
            "plan": self.plans(humans),
            "farmer": farmer,
            "artisan": artisan,
            "wheat": humans.wheat,
            "tools": humans.tools,
            "grown": humans.grown,
            "made": humans.made,
            "bought": humans.bought,
            "sold": humans.sold,
            "land_x": humans.land_x,
            "land_y": humans.land_y,
            "village": humans.village,
            "member": self.members() >= 0,
            **mind_columns(humans),
        }

    def callings(self):
        """Return the values of Farmer and Artisan, an array each; 0 where one is inactive."""
        return tuple(np.nan_to_num(self.humans.cogniton(name)) for name in ("Farmer", "Artisan"))

    def members(self):
        """Return the village whose community each agent is in, an array; -1 for none."""
        return np.where(self.humans.holds("land_x"), self.humans.village, -1)

    def demand(self, village, culturon):
        """Return a culturon of a village's community; 0 where nobody is left to hold it."""
        own = np.flatnonzero(self.members() == village.id)
        if not len(own):
            return 0.0
        member = self.humans[int(self.humans.id[own[0]])]
        return member.mind.get_culturon_value("community", culturon)
