"""Farmers and artisans: trade makes specialists out of equals (thesis, section 3.3).

Everybody can grow wheat and make tools. A tool makes wheat grow faster, and who sells or buys one
at the village is confirmed in the calling that the trade paid. From these feed-backs a society of
some twenty farmers and five artisans settles, without anybody being told what to be.
"""

import math

import numpy as np

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter
from socialmind.economy import (
    Market,
    buy_ware,
    demand_perception,
    fade_demand,
    proportional_decay,
    sell_ware,
    signal_demand,
    towards_neutral,
)
from socialmind.observation import mind_columns

COMFORT = 800.0  # wheat that leaves no need
PLENTY = 50.0  # tools of a village that count as plenty, and those it starts with
FIRST_TOOLS = 10.0  # tools of an agent at the start
FIRST_TOOLS_WORTH = 5.0  # its wheat at the start, as the price of so many tools
LAND_SPACING = 20.0  # patches to the next land, when the search begins
DEMAND_FADING = 0.01  # share of the demands that is forgotten in a tick
CALLING_FACTOR = 0.999999  # what a tick without trade leaves of a calling
CALLING_BOUND = 30.0
LARGEST_REWARD = 10.0  # feed-back of a trade: a number between 0 and this
LARGEST_ACTIVITY = 25_500


class Human(Agent):
    """A villager: its stocks, the tool in its hands, its trades, its land and its village."""

    wheat: float = 0.0
    tools: float = 0.0
    bought: int = 0
    sold: int = 0
    tool_state: float = 0.0
    timer: int = 0
    spacing: float = LAND_SPACING
    land_x: int | None = None
    land_y: int | None = None
    village: int = 0


class Land(Patch):
    """A patch: whether it belongs to somebody, and the work done on it."""

    taken: bool = False
    tool_activity: np.int16 = 12_700
    wheat_activity: np.int16 = 12_800


# Setup ------------------------------------------------------------------------------------------


def lay_out_villages(model):
    """Choose the lattice: the columns are the number's smallest divisor not below its root."""
    model.village_columns = math.ceil(math.sqrt(model.n_villages))
    while model.n_villages % model.village_columns != 0:
        model.village_columns += 1


def found_village(village, model):
    """Put a village on its place of the lattice, fill its stocks and take the patches round it."""
    world = model.world
    rows = model.n_villages // model.village_columns
    column = village.id % model.village_columns
    row = village.id // model.village_columns
    edge = world.low - 0.5
    village.x = math.floor(edge + (column + 0.5) * world.size / model.village_columns + 0.5)
    village.y = math.floor(edge + (row + 0.5) * world.size / rows + 0.5)
    village.ware = PLENTY
    village.staple = PLENTY * model.tool_price
    for dx in range(-1, 2):
        for dy in range(-1, 2):
            world.patch(village.x + dx, village.y + dy).taken = True


def arrive(human, model, rng):
    """Put an agent on a random place, with its first stocks."""
    world = model.world
    human.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    human.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    human.heading = rng.integers(360)
    human.tools = FIRST_TOOLS
    human.wheat = FIRST_TOOLS_WORTH * model.tool_price
    human.village = nearest_village(human, model)


def nearest_village(human, model):
    """Return the identity of the village nearest to where an agent stands."""
    world = model.world
    columns = model.village_columns
    rows = model.n_villages // columns
    column = math.floor((human.x - world.low + 0.5) * columns / world.size)
    row = math.floor((human.y - world.low + 0.5) * rows / world.size)
    nearest = 0
    least = math.inf
    # Villages stand on whole patches, so the nearest may be in a cell next door, or further where
    # cells are narrower than a patch.
    reach_x = 1 + columns // world.size
    reach_y = 1 + rows // world.size
    for i in range(column - reach_x, column + reach_x + 1):
        for j in range(row - reach_y, row + reach_y + 1):
            candidate = (j % rows) * columns + i % columns
            village = model.villages[candidate]
            away = world.distance(human, village.x, village.y)
            if away < least or (away == least and candidate < nearest):
                nearest = candidate
                least = away
    return nearest


# A tick -----------------------------------------------------------------------------------------


def look_at_stocks(village, model):
    """Let a village see what is scarce."""
    village.perception = demand_perception(village.staple, village.ware, model.tool_price, PLENTY)


def live(human, model, rng):
    """Perceive, let the callings fade, and go on with the plan or choose another (listing 3.1)."""
    perceive(human, model)
    fade_calling(human, "Farmer")
    fade_calling(human, "Artisan")
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


def perceive(human, model):
    """Give the perceptive cognitons their values (listing 3.2)."""
    village = model.villages[human.village]
    human.mind.set_cogniton_value("WheatDemand", village.staple_demand)
    human.mind.set_cogniton_value("ToolDemand", village.ware_demand)
    human.mind.set_cogniton_value("WheatStock", human.wheat)
    human.mind.set_cogniton_value("ToolStock", human.tools)
    human.mind.set_cogniton_value("WheatNeed", COMFORT - human.wheat)


def fade_calling(human, calling):
    """Let a calling come to rest when no trade confirms it."""
    value = human.mind.get_cogniton_value(calling)
    rested = towards_neutral(value, CALLING_FACTOR, 0.0, CALLING_BOUND)
    human.mind.set_cogniton_value(calling, rested)


def forget_demand(village):
    """Let the demands of a village fade."""
    fade_demand(village, DEMAND_FADING)


# Plans ------------------------------------------------------------------------------------------


def trade_wheat_for_tools(human, model, rng):
    """Walk to the village and buy a tool (listing 3.3)."""
    village = model.villages[human.village]
    if village.ware > 1:
        if model.world.is_on(human, village.x, village.y):
            buy_ware(village, model.tool_price)
            human.tools += 1
            human.bought += 1
            human.wheat -= model.tool_price
            human.mind.feed_back_from_plan("TradeWheatForTools", rng.uniform(0, LARGEST_REWARD))
            human.mind.activate_cogniton("ToolStock")
            signal_demand(village, model.demand_intensity)
            human.timer = 0
        else:
            model.world.walk_to(human, village.x, village.y, 1)
    else:
        signal_demand(village, model.demand_intensity)
        human.timer = 0


def trade_tools_for_wheat(human, model, rng):
    """Walk to the village and sell a tool."""
    village = model.villages[human.village]
    if human.tools < 1:
        human.mind.deactivate_cogniton("ToolStock")
        human.timer = 0
    elif village.staple > model.tool_price:
        if model.world.is_on(human, village.x, village.y):
            sell_ware(village, model.tool_price)
            human.tools -= 1
            human.sold += 1
            human.wheat += model.tool_price
            human.mind.feed_back_from_plan("TradeToolsForWheat", rng.uniform(0, LARGEST_REWARD))
            signal_demand(village, model.demand_intensity)
            human.timer = 0
        else:
            model.world.walk_to(human, village.x, village.y, 1)
    else:
        signal_demand(village, model.demand_intensity)
        human.timer = 0


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
        land = model.world.patch(human.x, human.y)
        land.wheat_activity = min(land.wheat_activity + 1, LARGEST_ACTIVITY)
        land.tool_activity = max(land.tool_activity - 1, 0)
        human.timer = 0


def produce_tools(human, model, rng):
    """Make a piece of a tool on one's own land."""
    if on_own_land(human, model, rng):
        human.tools += rng.uniform(0, model.max_tool_production)
        if human.tools >= 1:
            human.mind.activate_cogniton("ToolStock")
        land = model.world.patch(human.x, human.y)
        land.tool_activity = min(land.tool_activity + 1, LARGEST_ACTIVITY)
        land.wheat_activity = max(land.wheat_activity - 1, 0)
        human.timer = 0


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
    for patch in world.in_radius(human, human.spacing):
        if patch.taken:
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
    human.timer = 0


class FarmerArtisan(Model):
    """Trade makes farmers and artisans out of equals (thesis, section 3.3)."""

    ticks = 500_000

    n_agents: int = parameter(25, unit="agents", low=1, doc="agents at the start")
    tool_price: float = parameter(167.0, unit="wheat a tool", low=1e-6, doc="price of a tool")
    food_decay: float = parameter(
        0.003312, unit="share a decision", low=0.0, high=1.0, doc="wheat that spoils"
    )
    tool_durability: float = parameter(
        184.0, unit="working ticks", low=0.0, doc="work that a tool lasts"
    )
    max_tool_production: float = parameter(
        0.076, unit="tools a working tick", low=0.0, doc="largest part of a tool made in a tick"
    )
    demand_intensity: float = parameter(
        1.01, unit="demand a signal", low=0.0, doc="weight of one signal of demand"
    )
    plan_duration: int = parameter(
        40, unit="ticks", low=0, doc="ticks until a plan that goes on is weighed again"
    )
    starvation: bool = parameter(False, doc="whether agents under zero wheat die")
    world_size: int = parameter(33, unit="patches", low=3, high=20_000, doc="side of the world")
    n_villages: int = parameter(1, unit="villages", low=1, doc="villages on a regular lattice")

    village_columns: int = 1

    world = Torus("world_size", Land)
    villages = Population(Market, "n_villages")
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

    setup = (
        once(lay_out_villages),
        each(villages, found_village, shuffled=False),
        each(humans, arrive),
    )
    schedule = (
        each(villages, look_at_stocks, shuffled=False),
        each(humans, live),
        each(villages, forget_demand, shuffled=False),
    )

    def series(self):
        """Return the society's numbers: stocks, demands, callings and specialisation."""
        farmer, artisan = self.callings()
        villages = self.villages
        return {
            "population": len(self.humans),
            "farmers": int((farmer > artisan).sum()),
            "artisans": int((artisan > farmer).sum()),
            "undecided": int((farmer == artisan).sum()),
            "wheat": float(self.humans.wheat.sum()),
            "tools": float(self.humans.tools.sum()),
            "village_wheat": float(villages.staple.sum()),
            "village_tools": float(villages.ware.sum()),
            "wheat_demand": float(villages.staple_demand.mean()),
            "tool_demand": float(villages.ware_demand.mean()),
            "specialisation": self.specialisation(),
            "idle": self.idle.count,
        }

    def agents(self):
        """Return each agent's body, land and mind."""
        farmer, artisan = self.callings()
        humans = self.humans
        has_land, made, grown = self.land_activity()
        land_tools = np.full(len(humans), None, object)
        land_wheat = land_tools.copy()
        land_tools[has_land], land_wheat[has_land] = made.tolist(), grown.tolist()
        return {
            "agent": humans.id,
            "x": humans.x,
            "y": humans.y,
            "plan": self.plans(humans),
            "farmer": farmer,
            "artisan": artisan,
            "wheat": humans.wheat,
            "tools": humans.tools,
            "land_x": humans.land_x,
            "land_y": humans.land_y,
            "land_tools": land_tools,
            "land_wheat": land_wheat,
            "village": humans.village,
            **mind_columns(humans),
        }

    def callings(self):
        """Return the values of Farmer and Artisan, an array each; 0 where one is inactive."""
        return tuple(np.nan_to_num(self.humans.cogniton(name)) for name in ("Farmer", "Artisan"))

    def land_activity(self):
        """Return who has land, and the work done on the land of those: tools, wheat."""
        humans = self.humans
        has_land = humans.holds("land_x")
        x = humans.filled("land_x")[has_land] - self.world.low
        y = humans.filled("land_y")[has_land] - self.world.low
        return has_land, self.world.tool_activity[x, y], self.world.wheat_activity[x, y]

    def specialisation(self):
        """Return the mean over agents with land of |t − w| / (t + w); NaN when none has land."""
        has_land, made, grown = self.land_activity()
        if not has_land.any():
            return math.nan
        made, grown = made.astype(float), grown.astype(float)
        return float(np.mean(np.abs(made - grown) / (made + grown)))
