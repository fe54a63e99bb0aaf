"""The farmer-artisan society as a plain Mesa program: the yardstick of the benchmarks.

The same rules as `models/farmer_artisan`, written as a competent Mesa user would write them: one
agent class, state in attributes, the scheme as lists of links, `random.Random` for the draws and
`agents.shuffle_do` for the order. It uses nothing of socialmind or coglogo_py, and nothing that
Mesa 4 removes.

    python benchmarks/mesa_farmer_artisan.py --ticks 20000 --seed 1
"""

import argparse
import math
import time

import mesa

SIZE = 33  # patches a side, a torus with coordinates -16 .. 16
HALF = SIZE / 2

TOOL_PRICE = 167.0  # wheat for one tool
FOOD_DECAY = 0.003312  # part of the wheat lost with each decision
TOOL_DURABILITY = 184  # harvests a tool lasts
MAX_TOOL_PRODUCTION = 0.076  # tools a tick
DEMAND_INTENSITY = 1.01
PLAN_DURATION = 40  # ticks
BIAS = 2.6  # of the biased weighted stochastic decision maker

COGNITONS = [
    "ToolStock", "WheatStock", "WheatNeed", "WheatDemand", "Farmer", "Artisan", "ToolDemand",
]  # fmt: skip
TOOL_STOCK, WHEAT_STOCK, WHEAT_NEED, WHEAT_DEMAND, FARMER, ARTISAN, TOOL_DEMAND = range(7)
TRADE_WHEAT_FOR_TOOLS, TRADE_TOOLS_FOR_WHEAT, GROW_WHEAT, PRODUCE_TOOLS = range(4)

# The cognitive scheme: for each cogniton its links as (plan, strength), and the plans it opens.
INFLUENCE: list[list[tuple[int, float]]] = [
    [(TRADE_WHEAT_FOR_TOOLS, -1.0), (TRADE_TOOLS_FOR_WHEAT, 5.0)],
    [(TRADE_WHEAT_FOR_TOOLS, 0.02), (TRADE_TOOLS_FOR_WHEAT, -0.1)],
    [(TRADE_WHEAT_FOR_TOOLS, -0.5), (TRADE_TOOLS_FOR_WHEAT, 0.5), (GROW_WHEAT, 1.0)],
    [(TRADE_TOOLS_FOR_WHEAT, -0.5), (GROW_WHEAT, 0.5)],
    [(GROW_WHEAT, 5.0)],
    [(PRODUCE_TOOLS, 5.0)],
    [(PRODUCE_TOOLS, 0.5), (TRADE_WHEAT_FOR_TOOLS, -0.5)],
]
CONDITIONAL: list[list[int]] = [
    [TRADE_TOOLS_FOR_WHEAT],
    [TRADE_WHEAT_FOR_TOOLS],
    [],
    [],
    [GROW_WHEAT],
    [PRODUCE_TOOLS],
    [PRODUCE_TOOLS],
]
REINFORCEMENT: list[list[tuple[int, float]]] = [
    [],
    [],
    [],
    [],
    [(TRADE_WHEAT_FOR_TOOLS, 0.05), (TRADE_TOOLS_FOR_WHEAT, -0.05)],
    [(TRADE_WHEAT_FOR_TOOLS, -0.05), (TRADE_TOOLS_FOR_WHEAT, 0.05)],
    [],
]


def wrap(position: float) -> float:
    """Bring a coordinate that left the torus back into -16.5 .. 16.5."""
    if position >= HALF:
        return position - SIZE
    if position < -HALF:
        return position + SIZE
    return position


def patch(position: float) -> int:
    """The patch that a coordinate falls on."""
    return math.floor(position + 0.5)


class Land:
    """A patch that somebody works, with its two activity counters."""

    def __init__(self, x: int, y: int) -> None:
        self.x = x
        self.y = y
        self.tools = 12_700
        self.wheat = 12_800

    def work(self, tools: int) -> None:
        """Count one working tick: `tools` is 1 for toolmaking and -1 for farming."""
        self.tools = min(25_500, max(0, self.tools + tools))
        self.wheat = min(25_500, max(0, self.wheat - tools))


class Human(mesa.Agent):
    """Somebody who farms, makes tools and trades in the village."""

    def __init__(self, model: "Society") -> None:
        super().__init__(model)
        self.x = model.random.uniform(-HALF, HALF)
        self.y = model.random.uniform(-HALF, HALF)
        self.heading = model.random.random() * 360.0  # degrees, 0 is north, clockwise
        self.wheat = 5 * TOOL_PRICE
        self.tools = 10.0
        self.tool_state = 0  # harvests left in the tool at hand
        self.land: Land | None = None
        self.spacing = 20.0
        self.plan: int | None = None
        self.plan_timer = 0
        self.colour = "white"
        self.cognitons = [0.0] * len(COGNITONS)
        self.active = [True] * len(COGNITONS)
        self.active[TOOL_STOCK] = False
        self.carry_out = [
            self.trade_wheat_for_tools,
            self.trade_tools_for_wheat,
            self.grow_wheat,
            self.produce_tools,
        ]

    def step(self) -> None:
        """Perceive, forget a little, decide when the plan has run out, act."""
        self.perceive()
        if self.wheat < 0:
            self.colour = "grey"
            if self.model.starvation:
                self.remove()
                return
        if self.plan_timer <= 0:
            self.plan = self.choose_plan()
            self.plan_timer = PLAN_DURATION
            self.carry_out[self.plan]()
            self.wheat *= 1.0 - FOOD_DECAY
        else:
            self.plan_timer -= 1
            self.carry_out[self.plan]()

    def perceive(self) -> None:
        """Set the perceptive cognitons; let the two specialisations fade, within -30 .. 30."""
        cognitons = self.cognitons
        cognitons[WHEAT_DEMAND] = self.model.wheat_demand
        cognitons[TOOL_DEMAND] = self.model.tool_demand
        cognitons[WHEAT_STOCK] = self.wheat
        if self.active[TOOL_STOCK]:
            cognitons[TOOL_STOCK] = self.tools
        cognitons[WHEAT_NEED] = 800.0 - self.wheat
        for index in (FARMER, ARTISAN):
            value = cognitons[index]
            if value > 30.0:
                cognitons[index] = 30.0
            elif value < -30.0:
                cognitons[index] = -30.0
            else:
                cognitons[index] = value * 0.999999

    def choose_plan(self) -> int:
        """Draw one of the open plans: better ones more often, all the more as BIAS exceeds 1."""
        weights = [0.0] * 4
        open_ = [False] * 4
        for cogniton, value in enumerate(self.cognitons):
            if self.active[cogniton]:
                for plan, influence in INFLUENCE[cogniton]:
                    weights[plan] += influence * value
                for plan in CONDITIONAL[cogniton]:
                    open_[plan] = True
        plans = [plan for plan in range(4) if open_[plan]]
        plans.sort(key=weights.__getitem__, reverse=True)
        offset = max(0.0, 1.0 - weights[plans[-1]])
        shares = [weights[plan] + offset for plan in plans]
        drawn = self.model.random.random() ** BIAS * sum(shares)
        for plan, share in zip(plans, shares, strict=True):
            drawn -= share
            if drawn <= 0.0:
                return plan
        return plans[-1]

    def feed_back(self, plan: int, value: float) -> None:
        """Add to every active cogniton what the plan's success is worth to it."""
        for cogniton, links in enumerate(REINFORCEMENT):
            if self.active[cogniton]:
                for linked, reinforcement in links:
                    if linked == plan:
                        self.cognitons[cogniton] += reinforcement * value

    # Plans

    def trade_wheat_for_tools(self) -> None:
        village = self.model
        self.colour = "yellow"
        if village.tools <= 1:
            village.signal_demand()
            self.plan_timer = 0
        elif self.is_at(0, 0):
            village.tools -= 1
            village.wheat += TOOL_PRICE
            self.tools += 1
            self.wheat -= TOOL_PRICE
            self.feed_back(TRADE_WHEAT_FOR_TOOLS, village.random.random() * 10)
            self.active[TOOL_STOCK] = True
            village.signal_demand()
            self.plan_timer = 0
        else:
            self.walk_to(0, 0)

    def trade_tools_for_wheat(self) -> None:
        village = self.model
        self.colour = "yellow"
        if self.tools < 1:
            self.active[TOOL_STOCK] = False
            self.plan_timer = 0
        elif village.wheat <= TOOL_PRICE:
            village.signal_demand()
            self.plan_timer = 0
        elif self.is_at(0, 0):
            village.tools += 1
            village.wheat -= TOOL_PRICE
            self.tools -= 1
            self.wheat += TOOL_PRICE
            self.feed_back(TRADE_TOOLS_FOR_WHEAT, village.random.random() * 10)
            village.signal_demand()
            self.plan_timer = 0
        else:
            self.walk_to(0, 0)

    def grow_wheat(self) -> None:
        self.colour = "blue"
        land = self.land
        if land is None:
            self.claim_land()
        elif self.is_at(land.x, land.y):
            if self.tool_state > 0:
                self.wheat += int(self.model.random.random() * 8)
                self.tool_state -= 1
            else:
                self.wheat += int(self.model.random.random() * 3)
            if self.tool_state <= 0 and self.tools > 0.999:
                self.tool_state = TOOL_DURABILITY
                self.tools -= 1
            land.work(-1)
            self.plan_timer = 0
        else:
            self.walk_to(land.x, land.y)

    def produce_tools(self) -> None:
        self.colour = "red"
        land = self.land
        if land is None:
            self.claim_land()
        elif self.is_at(land.x, land.y):
            self.tools += self.model.random.random() * MAX_TOOL_PRODUCTION
            if self.tools >= 1:
                self.active[TOOL_STOCK] = True
            land.work(1)
            self.plan_timer = 0
        else:
            self.walk_to(land.x, land.y)

    # Getting about

    def is_at(self, x: int, y: int) -> bool:
        return patch(self.x) == x and patch(self.y) == y

    def distance_to(self, x: int, y: int) -> float:
        return math.hypot(wrap(x - self.x), wrap(y - self.y))

    def face(self, x: int, y: int) -> None:
        """Turn towards a patch by the shorter way round."""
        self.heading = math.degrees(math.atan2(wrap(x - self.x), wrap(y - self.y)))

    def forward(self, distance: float) -> None:
        heading = math.radians(self.heading)
        self.x = wrap(self.x + distance * math.sin(heading))
        self.y = wrap(self.y + distance * math.cos(heading))

    def walk_to(self, x: int, y: int) -> None:
        """One patch towards the goal, or exactly onto it when it is nearer than that."""
        if self.distance_to(x, y) < 1.0:
            self.x, self.y = x, y
        else:
            self.face(x, y)
            self.forward(1.0)

    def claim_land(self) -> None:
        """Take the patch underfoot if nothing near is taken, else wander, asking for less room."""
        if any(self.distance_to(x, y) <= self.spacing for x, y in self.model.taken):
            random = self.model.random
            self.heading += random.randrange(70) - random.randrange(70)
            self.forward(0.5)
            self.spacing -= 0.5
            if self.spacing <= 1.0:
                self.spacing = 5.0
        else:
            self.land = Land(patch(self.x), patch(self.y))
            self.model.taken.append((self.land.x, self.land.y))
            self.plan_timer = 0


class Society(mesa.Model):
    """A village with its two stocks and demands, and the people round it."""

    def __init__(
        self, n_agents: int = 25, starvation: bool = False, rng: int | None = None
    ) -> None:
        super().__init__(rng=rng)
        self.starvation = starvation
        self.tools = 50.0
        self.wheat = 50 * TOOL_PRICE
        self.tool_demand = 0.0
        self.wheat_demand = 0.0
        self.perception = 0.0
        self.taken = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]  # the village and its rim
        for _ in range(n_agents):
            Human(self)

    def step(self) -> None:
        """One tick: everybody acts in a fresh random order, then the demands fade."""
        self.perception = (self.wheat - self.tools * TOOL_PRICE) / (50 * TOOL_PRICE)
        self.agents.shuffle_do("step")
        self.tool_demand *= 0.99
        self.wheat_demand *= 0.99

    def signal_demand(self) -> None:
        """Let the stocks of the village speak for what is wanted."""
        self.wheat_demand -= DEMAND_INTENSITY * self.perception
        self.tool_demand += DEMAND_INTENSITY * self.perception


def main() -> None:
    parser = argparse.ArgumentParser(description="Run the farmer-artisan society in plain Mesa.")
    parser.add_argument("--ticks", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--agents", type=int, default=25)
    arguments = parser.parse_args()

    society = Society(n_agents=arguments.agents, rng=arguments.seed)
    start = time.perf_counter()
    for _ in range(arguments.ticks):
        society.step()
    seconds = time.perf_counter() - start

    farmers = sum(human.cognitons[FARMER] > human.cognitons[ARTISAN] for human in society.agents)
    artisans = sum(human.cognitons[ARTISAN] > human.cognitons[FARMER] for human in society.agents)
    steps = arguments.ticks * arguments.agents
    print(f"farmers {farmers}")
    print(f"artisans {artisans}")
    print(f"undecided {len(society.agents) - farmers - artisans}")
    print(f"village tools {society.tools:.0f}")
    print(f"village wheat {society.wheat:.0f}")
    print(f"loop seconds {seconds:.3f}")
    print(f"agent-steps per second {steps / seconds:.0f}")


if __name__ == "__main__":
    main()
