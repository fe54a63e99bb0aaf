"""What it costs to begin a society, beside its own setup and ticks.

A society is made, set up and advanced from Python; the same setup and the same ticks are timed
alone, in the compiled loops that run them. What is left is what beginning costs, whatever the model
does; likewise what a call of `advance(1)` costs beside the same ticks in one call. All are measured
in turns, each seed as the least of five rounds, once others of the class have run in the process.

- `walkers`: a hundred agents without minds walk on 25 × 25 patches (the model is below);
- `farmer_artisan`: a hundred farmers with minds of a scheme in a file, 101 × 101 patches;
- `collect`: a robot on a plane, with a mind of seven skills in a folder.

    python benchmarks/start.py

The results go to benchmarks/start.json and, as a table, to benchmarks/README.md.
"""

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from harness import HERE, describe_machine, spread, write

from socialmind import Agent, Model, Patch, Population, Torus, each, parameter
from socialmind.catalogue import load_model

MILLI = 1000.0
TICKS = 100
TIMES = 5
"""How often a seed is measured; the least counts, for others use the machine too."""


class Land(Patch):
    """A patch, and how often somebody stood there."""

    trodden: int = 0


class Walker(Agent):
    """An agent that wanders about."""

    walked: float = 0.0


def arrive(walker, model, rng):
    """Stand somewhere, turned anywhere."""
    walker.x = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    walker.y = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    walker.heading = rng.uniform(0.0, 360.0)


def wander(walker, model, rng):
    """Turn a little, and go a step."""
    model.world.right(walker, rng.uniform(-20.0, 20.0))
    model.world.forward(walker, model.stride)
    walker.walked += model.stride
    model.world.patch(walker.x, walker.y).trodden += 1


class Walkers(Model):
    """A hundred agents on 25 × 25 patches."""

    n_walkers: int = parameter(100, unit="agents", low=0)
    stride: float = parameter(1.0, unit="patches", low=0.0)
    walkers = Population(Walker, "n_walkers")
    world = Torus(25, Land)
    setup = (each(walkers, arrive),)
    schedule = (each(walkers, wander),)


def models() -> dict[str, Callable[..., Any]]:
    """The models by name, each made with a seed."""
    farmers, collect = load_model("farmer_artisan"), load_model("collect")
    return {
        "walkers": lambda seed: Walkers(seed=seed),
        "farmer_artisan": lambda seed: farmers(seed=seed, n_agents=100),
        "collect": lambda seed: collect(seed=seed),
    }


def seconds(work: Callable[[], Any]) -> float:
    """Seconds that some work takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def setup_seconds(society: Any) -> float:
    """Seconds that the compiled setup of a society takes alone; it runs once more, on its state."""
    module, state = society.engine.module, society.state()
    record = society.contexts.view(module.MODEL)
    society.engine.connect()
    took = seconds(lambda: module.prepare(record))
    society.restore(state)
    return took


def measured(make: Callable[..., Any]) -> dict[str, Callable[[int], float]]:
    """What is measured of a model: seconds, for a seed."""

    def calls(seed: int, ticks: int) -> float:
        """Seconds of a hundred ticks, after as many, in calls of so many."""
        society = make(seed)
        society.advance(TICKS)

        def step() -> None:
            for _ in range(TICKS // ticks):
                society.advance(ticks)

        return seconds(step)

    def loop(seed: int, ticks: int) -> float:
        society = make(seed)
        module = society.engine.module
        record = society.contexts.view(module.MODEL)
        society.engine.connect()
        return seconds(lambda: module.advance(record, ticks))

    return {
        "begin": lambda seed: seconds(lambda: make(seed).advance(1)),
        "whole": lambda seed: seconds(lambda: make(seed).advance(TICKS)),
        "setup": lambda seed: setup_seconds(make(seed)),
        "first": lambda seed: loop(seed, 1),
        "ticks": lambda seed: loop(seed, TICKS),
        "one by one": lambda seed: calls(seed, 1),
        "at once": lambda seed: calls(seed, TICKS),
    }


def measure(seeds: int) -> dict:
    """Measure all models: milliseconds, of each seed the least of all rounds."""
    programs = {name: measured(make) for name, make in models().items()}
    found = {name: {what: [float("inf")] * seeds for what in one} for name, one in programs.items()}
    for number in range(TIMES + 1):
        for name, one in programs.items():
            for what, work in one.items():
                values = [MILLI * work(seed) for seed in range(seeds)]
                if number:  # the first round compiles, or loads, what all societies share
                    found[name][what] = list(map(min, found[name][what], values))
    return {
        "machine": describe_machine("numba", "numpy"),
        "seeds": seeds,
        "ticks": TICKS,
        "milliseconds": found,
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    rows = []
    for name, found in results["milliseconds"].items():
        own = [sum(pair) for pair in zip(found["setup"], found["first"], strict=True)]
        all_own = [sum(pair) for pair in zip(found["setup"], found["ticks"], strict=True)]
        beyond = [a - b for a, b in zip(found["begin"], own, strict=True)]
        times = [a / b for a, b in zip(found["whole"], all_own, strict=True)]
        pairs = zip(found["one by one"], found["at once"], strict=True)
        a_call = [(a - b) / results["ticks"] for a, b in pairs]
        rows += [
            (f"{name}: begun and one tick, beyond its own setup and tick", beyond, ".3f", " ms"),
            (f"{name}: its own setup and first tick", own, ".3f", " ms"),
            (
                f"{name}: begun and {results['ticks']} ticks, times its own setup and ticks",
                times,
                ".2f",
                "",
            ),
            (f"{name}: begun and {results['ticks']} ticks", found["whole"], ".3f", " ms"),
            (f"{name}: a call of `advance(1)`, beyond its tick", a_call, ".4f", " ms"),
        ]
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}; {results['seeds']} seeds, one core.",
        "",
        "| | median | least – greatest |",
        "|---|---|---|",
        *(f"| {what} | {spread(values, form, unit)} |" for what, values, form, unit in rows),
    ]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100, help="societies of each model")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments.seeds)
    write(results, table, "start", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
