"""Cows that eat, rest or wander: a society whose plans a scheme or a hierarchy weighs."""

from coglogo_py import BiasedWeightedStochastic, CognitiveScheme, Cogniton
from socialmind import Agent, Model, Population, each
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.mind.weighing import Weighing

SCHEME = CognitiveScheme(
    "cows",
    (
        Cogniton("Hunger", influence={"eat": 2.0, "rest": -0.5}, conditional=("eat", "wander")),
        Cogniton("Fatigue", influence={"rest": 1.5, "wander": -0.25}, conditional=("rest",)),
        Cogniton("Fear", False, influence={"wander": 4.0}, conditional=("wander",)),
    ),
    decision_maker=BiasedWeightedStochastic(2.0),
    plan_order=("eat", "rest", "wander"),
)
WEIGHING = Weighing({"Hunger": 50.0, "Fatigue": 40.0, "Fear": 10.0}, reach=200.0)


def linear(scheme, weighing):
    """The weights of a perceptron without hidden layers that are a scheme's influence links."""
    genome = []
    for plan in scheme.plans:
        parts = [
            weighing.cognitons[one.name] * one.influence.get(plan, 0.0) / weighing.reach
            for one in scheme.cognitons
        ]
        genome += [*parts, 0.5 - sum(parts) / 2]
    return genome


MIND = MindDescription(
    "cow",
    [one.name for one in SCHEME.cognitons],
    SCHEME.plans,
    skills=[
        Skill(
            "Weigh",
            [f"SE:{one.name}" for one in SCHEME.cognitons],
            [f"MO:{plan}" for plan in SCHEME.plans],
            Perceptron(layers=0),
            linear(SCHEME, WEIGHING),
        )
    ],
)


class Cow(Agent):
    """A cow: what it has eaten, and how often it chose each plan."""

    eaten: float = 0.0
    meals: int = 0
    naps: int = 0


def live(cow, model, rng):
    """Grow hungry or tired, be frightened now and then, decide and act."""
    cow.mind.add_to_cogniton_value("Hunger", rng.uniform(-1, 2))
    cow.mind.add_to_cogniton_value("Fatigue", rng.uniform(-1, 1))
    if rng.random() < 0.1:
        cow.mind.activate_cogniton("Fear")
        cow.mind.set_cogniton_value("Fear", rng.uniform(0, 10))
    elif rng.random() < 0.2:
        cow.mind.deactivate_cogniton("Fear")
    cow.plan = cow.mind.choose_next_plan()
    cow.run_plan(model, rng)


def eat(cow):
    """Eat away the hunger."""
    cow.eaten += 1
    cow.meals += 1
    cow.mind.add_to_cogniton_value("Hunger", -3)


def rest(cow):
    """Rest."""
    cow.naps += 1
    cow.mind.add_to_cogniton_value("Fatigue", -2)


def wander(cow):
    """Go on."""
    cow.mind.add_to_cogniton_value("Fatigue", 0.5)


class Grazing(Model):
    """Cows with a scheme."""

    ticks = 200

    cows = Population(Cow, 12, mind=SCHEME, plans={"eat": eat, "rest": rest, "wander": wander})
    schedule = (each(cows, live),)

    def series(self):
        """What all cows have done."""
        return {"meals": int(self.cows.meals.sum()), "naps": int(self.cows.naps.sum())}


class Weighed(Grazing):
    """The same cows, whose plans a hierarchy weighs; they are to eat as often as they rest."""

    cows = Population(
        Cow, 12, mind=SCHEME, plans=Grazing.cows.plans, hierarchy=MIND, weighing=WEIGHING
    )

    def score(self):
        """How equal meals and naps are, −1 … 0."""
        meals, naps = self.cows.meals.sum(), self.cows.naps.sum()
        return -abs(float(meals - naps)) / (12 * self.tick)
