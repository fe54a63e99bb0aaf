"""Networks: how long walking, counting, rewiring and making the lists of links anew take.

    python benchmarks/networks.py

Processor time, the least of some rounds, as other programs on the machine leave it alone.
"""

import time

import numpy as np
from harness import HERE, describe_machine, write

from socialmind import Agent, Model, Network, Population, each, parameter

SIZES = ((1_000, 10_000), (100_000, 1_000_000))
"""Agents and links."""
ROUNDS = 5


class Person(Agent):
    mood: float = 1.0
    around: float = 0.0


def walk(person, model):
    found = 0.0
    for friend in model.friends.neighbours(person):
        found += friend.mood
    person.around = found


def count(person, model):
    person.around = len(model.friends.neighbours(person))


def rewire(person, model, rng):
    friend = model.friends.neighbours(person).one_of(rng)
    if friend is not None:
        model.friends.unlink(person, friend)
    other = model.people.one_of(rng)
    if other != person:
        model.friends.link(person, other)


class Walking(Model):
    n: int = parameter(1_000, low=1)
    people = Population(Person, "n")
    friends = Network(people)
    schedule = (each(people, walk),)


class Counting(Walking):
    schedule = (each(Walking.people, count),)


class Rewiring(Walking):
    schedule = (each(Walking.people, rewire),)


def pairs(agents: int, links: int) -> dict[str, np.ndarray]:
    """Return so many links between agents drawn at random, in a random order."""
    rng = np.random.default_rng(0)
    one, other = rng.integers(0, agents, (2, 2 * links))
    keys = np.unique((np.minimum(one, other) * agents + np.maximum(one, other))[one != other])
    rng.shuffle(keys)
    return {"source": keys[:links] // agents, "target": keys[:links] % agents}


def least(run, times: int = 1) -> float:
    """Return the least processor time of some rounds, in seconds, each of a number of calls."""
    found = []
    for _ in range(ROUNDS):
        begin = time.process_time()
        run()
        found.append((time.process_time() - begin) / times)
    return min(found)


def measured(agents: int, links: int) -> dict[str, float]:
    """Return nanoseconds an agent, and a neighbour; seconds of making all lists anew."""
    edges = pairs(agents, links)
    found: dict[str, float] = {}
    ticks = max(1, 2_000_000 // (agents + links))
    for kind in (Walking, Counting, Rewiring):
        society = kind(n=agents)
        society.friends.set_from(edges)
        society.advance(2)
        took = least(lambda society=society: society.advance(ticks), ticks)
        found[kind.__name__.lower()] = took / agents * 1e9
        if kind is Walking:
            found["neighbour"] = took / (2 * links) * 1e9
            found["lists"] = least(society.friends.build_index)
    return found


def table(results: dict) -> str:
    """Return the results as the README's table."""
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; "
        f"Python {machine['python']}, numba {machine['numba']}.",
        "",
        "| agents | links | walk, ns a neighbour | count, ns an agent | rewire, ns an agent "
        "| lists anew, ms |",
        "|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {one['agents']:,} | {one['links']:,} | {one['neighbour']:.1f} "
        f"| {one['counting']:.0f} | {one['rewiring']:,.0f} | {1e3 * one['lists']:.1f} |"
        for one in results["sizes"]
    ]
    return "\n".join(lines)


def main() -> None:
    """Measure, and write `networks.json` and the README's table."""
    sizes = [{"agents": n, "links": m, **measured(n, m)} for n, m in SIZES]
    write({"machine": describe_machine("numba"), "sizes": sizes}, table, "networks", HERE)


if __name__ == "__main__":
    main()
