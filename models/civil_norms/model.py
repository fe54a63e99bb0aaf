"""Two civilisations gather in one region: one shares what is found, the other keeps it.

Their people have the same minds and bodies. A civilisation is a group, its norm a culturon that
pushes the plan it asks for, participation is how far the norm binds a member (thesis, sections 3.2
to 3.4). Members who see a breach may punish it, and whoever sees a stranger fare better may join
the stranger's civilisation.
"""

import numpy as np

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter
from socialmind.observation import mind_columns

SHARERS, KEEPERS = 0, 1  # the civilisations
FIRST_STORE = 10.0  # food of a gatherer at the start, in the mean
MEAL = 1.0  # food eaten in a tick
ENOUGH = 5.0  # food in store below which one is in need
BIRTH_STORE = 15.0  # food in store from which on there may be children
DOWRY = 5.0  # food that a child is given


class Gatherer(Agent):
    """A gatherer: its food in store, how it has fared, its civilisation and what it has done."""

    store: float = FIRST_STORE
    fare: float = FIRST_STORE  # the store, averaged over the past
    civilisation: int = SHARERS
    gifts: int = 0
    sanctioned: int = 0


class Land(Patch):
    """A patch: the food that lies there."""

    food: float = 0.0


# Setup ------------------------------------------------------------------------------------------


def settle(gatherer, model, rng):
    """Put a gatherer on a random place, into the civilisation that it was born in."""
    world = model.world
    gatherer.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    gatherer.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    gatherer.heading = rng.uniform(0, 360)
    gatherer.store = rng.uniform(ENOUGH, 2 * FIRST_STORE - ENOUGH)
    gatherer.fare = gatherer.store
    sharers = round(model.n_gatherers * model.share_of_sharers)
    if gatherer.id < sharers:
        gatherer.civilisation = SHARERS
        if gatherer.id == 0:
            model.group[SHARERS] = found(gatherer)
            gatherer.mind.set_culturon_value("Civilisation", "NormOfSharing", model.norm)
    else:
        gatherer.civilisation = KEEPERS
        if gatherer.id == sharers:
            model.group[KEEPERS] = found(gatherer)
            gatherer.mind.set_culturon_value("Civilisation", "NormOfKeeping", model.norm)
    join(gatherer, model.group[gatherer.civilisation], rng)


def found(gatherer):
    """Found a civilisation and return its identity."""
    gatherer.mind.create_and_join_group("Civilisation", "Member")
    return gatherer.mind.get_group_id("Civilisation")


def join(gatherer, group, rng):
    """Become a member; how far the norm binds somebody is a matter of luck."""
    gatherer.mind.join_group("Civilisation", "Member", group)
    gatherer.mind.set_participation("Civilisation", rng.random())


# A tick -----------------------------------------------------------------------------------------


def grow(model, rng):
    """Let finds come up on random patches; what has lain there rots."""
    for land in model.world.patches:
        land.food *= 1 - model.rot
    for _ in range(rng.poisson(model.food_supply / model.find_size)):
        x = rng.integers(model.world.low, model.world.high + 1)
        y = rng.integers(model.world.low, model.world.high + 1)
        model.world.patch(x, y).food += model.find_size


def live(gatherer, model, rng):
    """Walk, gather, do with the food what one wants and should, look at others, eat."""
    walk(gatherer, model, rng)
    gather(gatherer, model)
    if gatherer.store > ENOUGH and neediest(gatherer, model) is not None:
        model.occasions[gatherer.civilisation] += 1
        gatherer.plan = gatherer.mind.choose_next_plan()
        gatherer.run_plan(model, rng)
        if breaks_norm(gatherer):
            answer_to_witness(gatherer, model, rng)
    if rng.random() < model.curiosity:
        compare(gatherer, model, rng)
    eat(gatherer, model, rng)


def walk(gatherer, model, rng):
    """Go a patch further, roughly ahead."""
    model.world.right(gatherer, rng.uniform(-60, 60))
    model.world.forward(gatherer, 1)


def gather(gatherer, model):
    """Take all food from the patch."""
    land = model.world.patch(gatherer.x, gatherer.y)
    gatherer.store += land.food
    land.food = 0


def neediest(gatherer, model):
    """Return who has least in sight, if that is too little; a parochial eye sees its own people."""
    return min(
        (
            other
            for other in model.gatherers.near(gatherer, model.sight)
            if other.store < ENOUGH
            and (other.civilisation == gatherer.civilisation or not model.parochial)
        ),
        key=lambda other: other.store,
        default=None,
    )


def eat(gatherer, model, rng):
    """Eat, lose what spoils, starve or grow old, or have a child."""
    gatherer.store = gatherer.store * (1 - model.spoilage) - MEAL
    gatherer.fare += model.forgetting * (gatherer.store - gatherer.fare)
    if gatherer.store < 0:
        model.starved[gatherer.civilisation] += 1
        gatherer.die()
    elif rng.random() < model.mortality:
        gatherer.die()
    elif gatherer.store > BIRTH_STORE and rng.random() < model.fertility:
        bear(gatherer, model, rng)


def bear(gatherer, model, rng):
    """Have a child: a member of the same civilisation, of an obedience of its own."""
    gatherer.store -= DOWRY
    child = gatherer.hatch(keep_groups=True)
    child.store = DOWRY
    child.fare = gatherer.fare
    child.gifts = 0
    child.sanctioned = 0
    child.heading = rng.uniform(0, 360)
    child.plan = None
    child.mind.set_participation("Civilisation", rng.random())
    model.born[gatherer.civilisation] += 1


# Plans ------------------------------------------------------------------------------------------


def share(gatherer, model):
    """Give the neediest so much that both have the same."""
    needy = neediest(gatherer, model)
    if needy is not None:
        gift = (gatherer.store - needy.store) / 2
        gatherer.store -= gift
        needy.store += gift
        gatherer.gifts += 1
        model.shared[gatherer.civilisation] += 1


def keep(gatherer):
    """Give nothing."""


# Norms and sanctions ----------------------------------------------------------------------------


def breaks_norm(gatherer):
    """Say whether a gatherer did what the norm of its civilisation asks not to do."""
    kept, shared = gatherer.plan == "Keep", gatherer.plan == "Share"
    to_share = gatherer.mind.get_culturon_value("Civilisation", "NormOfSharing") > 0
    to_keep = gatherer.mind.get_culturon_value("Civilisation", "NormOfKeeping") > 0
    return (to_share and kept) or (to_keep and shared)


def answer_to_witness(gatherer, model, rng):
    """Be punished by a member in sight and mend one's ways, or get away with it and be bolder."""
    model.breaches[gatherer.civilisation] += 1
    witness = rng.choice(
        other
        for other in model.gatherers.near(gatherer, model.sight)
        if other.civilisation == gatherer.civilisation
    )
    if witness is not None and punishes(witness, model, rng):
        witness.store -= model.sanction_cost
        gatherer.store -= min(model.fine, gatherer.store)
        gatherer.sanctioned += 1
        model.sanctions[gatherer.civilisation] += 1
        change_obedience(gatherer, model.lesson)
    else:
        change_obedience(gatherer, -model.slackening)


def punishes(witness, model, rng):
    """Say whether a witness punishes: the more the norm binds it, if it can pay what that costs."""
    able = witness.store >= model.sanction_cost
    willing = rng.random() < witness.mind.get_participation("Civilisation")
    return model.sanctions_on and able and willing


def change_obedience(gatherer, change):
    """Bind a member more or less to the norm, between 0 and 1."""
    bound = gatherer.mind.get_participation("Civilisation") + change
    gatherer.mind.set_participation("Civilisation", min(max(bound, 0.0), 1.0))


# Meeting ----------------------------------------------------------------------------------------


def compare(gatherer, model, rng):
    """Look at a stranger in sight, and go over to its civilisation if it fares better."""
    stranger = rng.choice(
        other
        for other in model.gatherers.near(gatherer, model.sight)
        if other.civilisation != gatherer.civilisation
    )
    if stranger is not None and stranger.fare > gatherer.fare:
        gatherer.mind.leave_group("Civilisation")
        gatherer.civilisation = stranger.civilisation
        join(gatherer, stranger.mind.get_group_id("Civilisation"), rng)
        model.joined[gatherer.civilisation] += 1


class CivilNorms(Model):
    """Two civilisations of the same people in one region, and two norms: to share, and to keep."""

    ticks = 2_000

    n_gatherers: int = parameter(
        120, unit="gatherers", low=2, high=100_000, doc="gatherers at the start"
    )
    share_of_sharers: float = parameter(
        0.5, unit="share of gatherers", low=0.0, high=1.0, doc="how many begin as sharers"
    )
    norm: float = parameter(
        10.0, unit="weight", low=0.0, doc="value of a civilisation's norm; 0: no culturons"
    )
    sanctions_on: bool = parameter(True, doc="whether breaches are punished")
    sanction_cost: float = parameter(
        0.2, unit="food", low=0.0, doc="what punishing costs the witness"
    )
    fine: float = parameter(1.0, unit="food", low=0.0, doc="what the punished lose")
    lesson: float = parameter(
        0.2, unit="participation", low=0.0, high=1.0, doc="obedience gained by a punishment"
    )
    slackening: float = parameter(
        0.05, unit="participation", low=0.0, high=1.0, doc="obedience lost by a breach unpunished"
    )
    parochial: bool = parameter(True, doc="whether gifts stop at one's own civilisation")
    curiosity: float = parameter(
        0.0, unit="chance a tick", low=0.0, high=1.0, doc="looking at a stranger, to join"
    )
    forgetting: float = parameter(
        0.02, unit="share a tick", low=0.0, high=1.0, doc="how fast one's fare follows the store"
    )
    food_supply: float = parameter(
        250.0, unit="food a tick", low=0.0, high=1e6, doc="food that comes up in the region"
    )
    find_size: float = parameter(20.0, unit="food", low=0.1, doc="food of one find")
    rot: float = parameter(
        0.1, unit="share a tick", low=0.0, high=1.0, doc="food on the ground that rots"
    )
    spoilage: float = parameter(
        0.03, unit="share a tick", low=0.0, high=1.0, doc="food in store that spoils"
    )
    fertility: float = parameter(
        0.02, unit="chance a tick", low=0.0, high=1.0, doc="a child, with food in plenty"
    )
    mortality: float = parameter(
        0.002, unit="chance a tick", low=0.0, high=1.0, doc="death, whatever there is to eat"
    )
    sight: float = parameter(2.0, unit="patches", low=0.0, high=10.0, doc="how far one sees others")
    world_size: int = parameter(25, unit="patches", low=3, high=1_000, doc="side of the region")

    # Of each civilisation, and so far: its group; decisions and gifts; breaches and punishments;
    # the starved and the born; those who came over to it.
    group: list[int] = [-1, -1]
    occasions: list[int] = [0, 0]
    shared: list[int] = [0, 0]
    breaches: list[int] = [0, 0]
    sanctions: list[int] = [0, 0]
    starved: list[int] = [0, 0]
    born: list[int] = [0, 0]
    joined: list[int] = [0, 0]

    world = Torus("world_size", Land)
    gatherers = Population(
        Gatherer, "n_gatherers", mind="scheme.yaml", plans={"Share": share, "Keep": keep}
    )

    setup = (each(gatherers, settle, shuffled=False),)
    schedule = (once(grow), each(gatherers, live))

    def series(self):
        """Return the numbers of both civilisations: the living, their stores, what was done."""
        found = {}
        belong = self.gatherers.civilisation
        obedience = self.obedience()
        for one, name in ((SHARERS, "sharers"), (KEEPERS, "keepers")):
            members = belong == one
            store = self.gatherers.store[members]
            found |= {
                name: int(members.sum()),
                f"{name}_store": float(store.mean()) if len(store) else 0.0,
                f"{name}_inequality": gini(store),
                f"{name}_obedience": float(obedience[members].mean()) if len(store) else 0.0,
                f"{name}_occasions": int(self.occasions[one]),
                f"{name}_gifts": int(self.shared[one]),
                f"{name}_breaches": int(self.breaches[one]),
                f"{name}_sanctions": int(self.sanctions[one]),
                f"{name}_starved": int(self.starved[one]),
                f"{name}_born": int(self.born[one]),
                f"{name}_joined": int(self.joined[one]),
            }
        return found

    def agents(self):
        """Return each gatherer's body, culture and mind."""
        gatherers = self.gatherers
        return {
            "agent": gatherers.id,
            "x": gatherers.x,
            "y": gatherers.y,
            "plan": self.plans(gatherers),
            "civilisation": gatherers.civilisation,
            "obedience": self.obedience(),
            "store": gatherers.store,
            "fare": gatherers.fare,
            "gifts": gatherers.gifts,
            "sanctioned": gatherers.sanctioned,
            **mind_columns(gatherers),
        }

    def obedience(self):
        """Return how far the norm of its civilisation binds each gatherer."""
        return np.array([one.mind.get_participation("Civilisation") for one in self.gatherers])


def gini(values):
    """Return Gini's coefficient of numbers, 0 for equals and for none.

    >>> gini(np.array([2.0, 2.0])), gini(np.array([0.0, 1.0]))
    (0.0, 0.5)
    """
    total = values.sum()
    if total <= 0:
        return 0.0
    ranks = np.arange(1, len(values) + 1)
    return float(((2 * ranks - len(values) - 1) * np.sort(values)).sum() / (len(values) * total))
