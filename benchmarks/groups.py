"""Speed of decisions of a million agents in a hundred thousand groups, beside the same in none.

    python benchmarks/groups.py [--agents 1000000] [--groups 100000] [--ticks 5]

Both societies take one decision an agent and tick; their schemes are equal but for the group, whose
culturon acts on one of the two plans. Numbers are agent-steps a second, the best of some stretches.
"""

from __future__ import annotations

import argparse
import time

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind import Agent, Model, Population, each, parameter

HUNGER = Cogniton("Hunger", start_value=1, influence={"eat": 2}, conditional=("eat",))
TIRED = Cogniton("Tired", start_value=3, influence={"rest": 1}, conditional=("rest",))
LAW = Culturon("Law", 2, influence={"rest": 1}, conditional=("rest",))
PLAIN = CognitiveScheme("plain", (HUNGER, TIRED))
GROUPED = CognitiveScheme(
    "grouped", (HUNGER, TIRED), (Group("village", (Role("member", (LAW,)),)),)
)


class Human(Agent):
    pass


def settle(human, model):
    if human.id < model.groups:
        human.mind.create_and_join_group("village", "member")
    else:
        human.mind.join_group("village", "member", human.id % model.groups)


def decide(human):
    human.plan = human.mind.choose_next_plan()


class Without(Model):
    agents_at_start: int = parameter(1000, low=0)
    humans = Population(Human, "agents_at_start", mind=PLAIN)
    schedule = (each(humans, decide),)


class Within(Model):
    agents_at_start: int = parameter(1000, low=0)
    groups: int = parameter(100, low=1)
    humans = Population(Human, "agents_at_start", mind=GROUPED)
    setup = (each(humans, settle, shuffled=False),)
    schedule = (each(humans, decide),)


def rate(society: Model, agents: int, ticks: int) -> float:
    """Return the agent-steps a second of the best of a few stretches."""
    society.advance(1)
    best = 0.0
    for _ in range(3):
        begin = time.perf_counter()
        society.advance(ticks)
        best = max(best, agents * ticks / (time.perf_counter() - begin))
    return best


def main() -> None:
    """Measure, and print a table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--agents", type=int, default=1_000_000)
    options.add_argument("--groups", type=int, default=100_000)
    options.add_argument("--ticks", type=int, default=5)
    given = options.parse_args()
    without = rate(Without(seed=1, agents_at_start=given.agents), given.agents, given.ticks)
    print(f"without groups: {without / 1e6:6.2f} million agent-steps a second")
    for groups in sorted({min(10, given.groups), given.groups}):
        society = Within(seed=1, agents_at_start=given.agents, groups=groups)
        found = rate(society, given.agents, given.ticks)
        print(f"{groups:7,} groups: {found / 1e6:6.2f} ({found / without:.2f} of that)")


if __name__ == "__main__":
    main()
