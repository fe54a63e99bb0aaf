"""Ways to teach roles: with a look into the mind, by what is brought home, as in the thesis.

`supervised_role` is the lesson of `lessons.py`, by which the model's own mind was learned: its loss
counts the variable ROLE, and what ROLE means is a program's. `delivered_role` judges by what robots
bring home alone, and CollectSelect is learned before; `at_once` both together. `thesis_role` is the
lesson of section 8.2: in bodies, with one society that begins undecided. `curricula.py` has their
names.
"""

from socialmind import each, once
from socialmind.catalogue import model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill
from socialmind.mind.functions.contract import InternalFunction
from socialmind.worlds.plane import paid

from .by_deliveries import ForagingByDeliveries, shock, watch
from .by_deliveries import work as bring
from .deliveries import CHOICE, DeliveryEconomy, Errands
from .lessons import MASTER, ROLE, SETTLING, foraging, lesson
from .payoff import forget
from .places import tidy_a, tidy_b
from .roles import UNDECIDED

CHOOSING = ["VA:ROLE", "SE:DISTOBJA", "SE:DISTOBJB"]
STATUS = ["SE:SENSOBJA", "SE:SENSOBJB", "SE:SENSDZ"]
"""What says how far the collect task has come."""
CHOOSER = Perceptron(layers=0)
"""Of CollectSelect: one layer. With a hidden one robots stay torn between both ways, and slow."""


# Minds ------------------------------------------------------------------------------------------


def known() -> MindDescription:
    """Return the mind that can collect."""
    return MindDescription.load(model_folder("collect_retrained") / "mind")


def choosing(
    settling: InternalFunction = SETTLING, choice: InternalFunction = CHOOSER
) -> MindDescription:
    """Return the mind of figure 8.5 with a CollectSelect that is to be learned as well.

    Args:
        settling: the internal function of ForageRole.
        choice: that of CollectSelect.
    """
    select = Skill(CHOICE, CHOOSING, ["SK:CollectA", "SK:CollectB"], choice)
    return foraging(known(), settling).with_modules(skills=[select])


def always():
    """Collect, and think about the role, all the time."""
    return 1.0, 1.0


def as_in_thesis() -> MindDescription:
    """Return the mind of section 8.2.2: perceptrons, and ForageRole thinks in every tick."""
    mind = choosing(choice=Perceptron(layers=2))
    role = ["SE:PAYOFF", *STATUS, "VA:ROLE"]
    return mind.with_modules(
        skills=[
            Skill(MASTER, [], [f"SK:{CHOICE}", f"SK:{ROLE}"], Programmed(always)),
            Skill(ROLE, role, ["VA:ROLE"], Perceptron(layers=2)),
        ]
    )


# The lesson in bodies ---------------------------------------------------------------------------


def work(robot, model, rng):
    """Work, and be rewarded for each object, the more the nearer the counts are to the ratio."""
    bring(robot, model, rng)
    if robot.paid:
        for market in model.markets:
            share = market.staple / (market.staple + market.ware)
            farthest = max(model.wanted, 1.0 - model.wanted)
            robot.earned += -1.0 + (1.0 - abs(share - model.wanted) / farthest)


class ForageInBodies(ForagingByDeliveries):
    """Robots in the arena that are rewarded for what they bring, near the wanted ratio."""

    ticks = 15_000

    rewards = {"near the ratio": paid()}
    schedule = (
        each(ForagingByDeliveries.robots, work),
        each(ForagingByDeliveries.objects_a, tidy_a),
        each(ForagingByDeliveries.objects_b, tidy_b),
        each(ForagingByDeliveries.markets, forget),
        each(ForagingByDeliveries.markets, shock),
        once(watch),
    )


# Lessons ----------------------------------------------------------------------------------------

supervised_role = lesson
"""Its name in trainings is that of the skill, on which its worlds hang."""

choose = Lesson(
    CHOICE,
    Errands,
    optimiser="CMAES",
    settings={"population": 20, "step": 1.0},
    repetitions=8,
    generations=150,
    finalists=20,
    finals=128,
)
"""CollectSelect finds two meanings for ROLE; which one is high and which low is nobody's matter."""
delivered_role = Lesson(
    "delivered_role",
    DeliveryEconomy,
    skill=ROLE,
    master=MASTER,
    optimiser="CMAES",
    settings={"population": 120, "step": 1.0},
    repetitions=8,
    generations=120,
    finalists=20,
    finals=256,
)
"""ForageRole, with what ROLE means to CollectSelect: many individuals in few worlds."""
delivered_finely = delivered_role.changed(
    name="delivered_role, finely",
    settings={"population": 40},
    repetitions=16,
    generations=200,
    start="known",
)
"""Then fewer from there on, in more worlds."""
delivered_narrow = delivered_role.changed(
    settings={"population": 40, "step": 0.5}, repetitions=16, generations=400
)
"""All with as few individuals as `supervised_role`. Many attempts never come to divide their
work."""

delivered_anew = delivered_narrow.changed(
    generations=220, starts=8, enough=-0.17, name="delivered_role, begun anew"
)
"""So it is begun anew until it has succeeded, eight times at most."""
delivered_closely = delivered_narrow.changed(
    name="delivered_role, closely",
    settings={"population": 40, "step": 0.1},
    repetitions=32,
    generations=60,
    start="known",
    spread=0.05,
)
"""Then in twice as many worlds, near what was found."""

BOTH = (ROLE, CHOICE)
at_once = Lesson(
    "delivered_role",
    DeliveryEconomy,
    skill=BOTH,
    master=MASTER,
    optimiser="CMAES",
    settings={"population": 40, "step": 0.5},
    repetitions=16,
    generations=200,
    finalists=20,
    finals=128,
)
"""Both skills at once. Robots may come to be torn between both ways: slow, which helps settling."""
at_once_briskly = Lesson(
    "delivered_role, briskly",
    DeliveryEconomy,
    skill=BOTH,
    master=MASTER,
    optimiser="CMAES",
    settings={"population": 40},
    repetitions=16,
    generations=100,
    finalists=20,
    finals=128,
    start="known",
    parameters={"missing": 3.0},
)
"""Then what is not brought home counts for more; those who are torn stay so."""

thesis_role = Lesson(
    "thesis_role",
    ForageInBodies,
    skill=BOTH,
    master=MASTER,
    repetitions=6,
    generations=60,
    settings={"population": 60, "selected": 0.2, "elite": 3, "mutation": 0.1, "step": 1.0},
    parameters={"start": UNDECIDED},
    finals=32,
)

delivered = Curriculum((choose, delivered_role, delivered_finely), mind=choosing())
narrow = Curriculum((choose, delivered_narrow), mind=choosing())
anew = Curriculum((choose, delivered_anew, delivered_closely), mind=choosing())
together = Curriculum((at_once, at_once_briskly), mind=choosing())
thesis = Curriculum((thesis_role,), mind=as_in_thesis())
