"""Walkers with both kinds of mind and all that a hierarchy can have, among watchers without."""

import math

from coglogo_py import CognitiveScheme, Cogniton
from coglogo_py.decision import WeightedStochastic
from socialmind import Agent, Model, Population, each, parameter
from socialmind.mind import (
    CognitonScheme,
    Counter,
    Elman,
    MindDescription,
    Perceptron,
    Programmed,
    Regulated,
    Skill,
    Variable,
    Wave,
)


def leak(command, value, commanded, memory):
    """Follow the command slowly, and count how often there was one."""
    if commanded:
        memory += 1.0
    return value + 0.1 * (command - value), memory


def follow(inputs):
    """Cross the wires, and move the mood of the group towards the left eye."""
    return inputs[1], inputs[0], 0.5 * inputs[2] + 0.5 * inputs[0]


def rest(light):
    """Do little; fail where the light is exactly what a test asks for."""
    turn = 0.25 / (light - 0.125)
    return 0.1 + 0.1 * math.sin(turn), 1, light > 0.5


WISHES = CognitiveScheme(
    "wishes",
    (
        Cogniton(
            "L", start_value=0.0, influence={"Follow": 2.0, "Rest": 1.0},
            conditional=("Follow", "Rest"),
        ),
        Cogniton("Mood", start_value=0.3, influence={"Rest": 0.5}, conditional=("Rest",)),
    ),
    decision_maker=WeightedStochastic(),
)  # fmt: skip
WALKER = MindDescription(
    "walker",
    ["L", "R"],
    ["ML", "MR"],
    [
        Variable("Slow", Regulated(leak)),
        Variable("Herd", group="herd", default=0.5),
        Variable("Count", Counter(3)),
        Variable("Wave", Wave()),
    ],
    [
        Skill("Follow", ["SE:L", "SE:R", "VA:Herd"], ["MO:ML", "MO:MR", "VA:Herd"],
              Programmed(follow)),
        Skill("Rest", ["SE:R"], ["MO:ML", "VA:Slow", "VA:Count"], Programmed(rest)),
        Skill("Wish", ["SE:L"], ["SK:Follow", "SK:Rest"], CognitonScheme(WISHES)),
        Skill("Tune", ["VA:Slow", "VD:Herd", "SH:L:3", "VA:Count"],
              ["MO:MR", "VA:Count", "VA:Wave"], Elman(1),
              [0.3 * math.sin(weight) for weight in range(1, 88)]),
    ],
)  # fmt: skip


def push(mind):
    """Influence a skill outside the hierarchy, command, and set a variable; fail in the dark."""
    mind.add_influence("Tune", 0.5 * mind.sensor("R") - 0.05)
    mind.command("ML", 0.25, 0.1)
    mind.command_variable("Slow", 0.9, 0.2)
    if mind.sensor("L") > 0.9:
        mind.set_variable("Count", 1.0)


WATCHER = MindDescription(
    "watcher",
    ["Crowd"],
    ["Alarm"],
    ["Fear"],
    [
        Skill("Watch", ["SE:Crowd", "SD:Crowd", "SH:Crowd:2"], ["SK:Cry", "VA:Fear"], Elman(1),
              [0.4 * math.cos(weight) for weight in range(1, 58)]),
        Skill("Cry", ["VA:Fear"], ["MO:Alarm"], Perceptron(0), [0.9, 0.05]),
    ],
)  # fmt: skip

CULTURE = CognitiveScheme(
    "culture",
    (
        Cogniton("Restless", start_value=1.0, influence={"Roam": 2.0, "Stay": 1.0},
                 conditional=("Roam", "Stay")),
        Cogniton("Tired", start_value=0.0, influence={"Stay": 3.0}),
    ),
    decision_maker=WeightedStochastic(),
)  # fmt: skip


class Walker(Agent):
    """What a walker's mind commanded, and what it saw of itself."""

    ml: float = 0.0
    mr: float = 0.0
    herd: float = 0.0
    followed: float = 0.0
    mother: int = -1


class Watcher(Agent):
    """What a watcher's mind commanded."""

    alarm: float = 0.0


def join(walker):
    """Join one of three herds, and take part more or less."""
    walker.hierarchy.join_group("herd", walker.id % 3, 0.5 + 0.1 * (walker.id % 5))


def live(walker, model, rng):
    """Choose a plan, and now and then bear, die, or begin anew."""
    walker.plan = walker.mind.choose_next_plan()
    walker.run_plan(model, rng)
    chance = rng.random()
    if chance < model.births:
        child = walker.hatch()
        child.mother = walker.id
    elif chance < 2 * model.births:
        stranger = model.walkers.create()
        stranger.hierarchy.join_group("herd", 1, 2.0)
    elif chance < 2 * model.births + model.deaths:
        walker.die()
    elif chance > 0.98:
        walker.hierarchy.restart()
    elif chance > 0.96:
        walker.hierarchy.leave_group("herd")
    elif chance > 0.94:
        walker.hierarchy.set_variable("Herd", rng.random())


def roam(walker, model, rng):
    """See something else, and do what the hierarchy commands."""
    walker.hierarchy.set_sensor("L", rng.random())
    walker.hierarchy.set_sensor("R", rng.uniform(0.2, 1.0))
    if model.tick == model.failing and walker.id == 3:
        walker.hierarchy.set_sensor("R", 0.125)
    walker.hierarchy.evaluate()
    walker.ml = walker.hierarchy.actuator("ML")
    walker.mr = walker.hierarchy.actuator("MR")
    walker.herd = walker.hierarchy.variable("Herd")
    walker.followed = walker.hierarchy.influence("Follow")
    walker.x += walker.hierarchy.variable("Slow") + walker.hierarchy.variable("Wave")
    walker.y += walker.hierarchy.variable("Count") + walker.hierarchy.sensor("L")
    walker.mind.add_to_cogniton_value("Tired", walker.ml)


def stay(walker):
    """Become restless."""
    walker.mind.set_cogniton_value("Tired", 0.0)


def watch(watcher, model):
    """Cry when there are many."""
    watcher.hierarchy.set_sensor("Crowd", min(len(model.walkers) / 60, 1))
    watcher.hierarchy.evaluate()
    watcher.alarm = watcher.hierarchy.actuator("Alarm")


class Herd(Model):
    """Walkers that are born and die, with a genome each, and watchers that share one."""

    ticks = 100
    n_walkers: int = parameter(20, low=1)
    births: float = parameter(0.01, low=0.0, high=0.5)
    deaths: float = parameter(0.02, low=0.0, high=0.5)
    failing: int = parameter(-1)
    walkers = Population(
        Walker, "n_walkers", mind=CULTURE, plans={"Roam": roam, "Stay": stay},
        hierarchy=WALKER, master="Wish", drive=push, own_genomes=True, instances=3,
    )  # fmt: skip
    watchers = Population(Watcher, 3, hierarchy=WATCHER)
    setup = (each(walkers, join),)
    schedule = (each(walkers, live), each(watchers, watch))
