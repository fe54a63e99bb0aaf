"""How fast robots live on a plane: compiled episodes beside a plain Python loop over pymunk.

The world is the standard benchmark of models/collect, the controller its trained hierarchy: ten
range finders of three rays, 10,000 ticks at most, a collision ends an episode. `plane_in_pymunk.py`
is the same as a modeller would write it without socialmind; both are first checked to steer their
robots along the same path in the same worlds. All programs take turns in one run, so that a busy
machine slows all.

    python benchmarks/plane.py
    python benchmarks/plane.py --rounds 2 --worlds 8 --ticks 200    # whether it runs

The results go to benchmarks/plane.json and, as a table, to benchmarks/README.md.
"""

import argparse
import os
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import numpy as np
import plane_in_pymunk
from collect_hierarchy import LINKS, layers_of
from harness import HERE, describe_machine, spread, write
from numba import njit
from numpy.typing import NDArray

from socialmind.catalogue import load_model
from socialmind.compiling.memory import call_at
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.lessons.keys import seeds_for
from socialmind.mind import MindDescription, Minds
from socialmind.worlds.plane.kernel.code import kernel

COLLECT: Any = load_model("collect")
LANES = 64
THREADS = 2
MILLION = 1e6


def trained() -> MindDescription:
    """Return the mind of models/collect.

    Raises:
        SystemExit: its skills read or command other things than the program in plain Python.
    """
    mind: Any = COLLECT.steerings()["robots"].mind
    description = mind if isinstance(mind, MindDescription) else MindDescription.load(mind)
    for name, (inputs, outputs) in LINKS.items():
        skill = description.skills[name]
        expected = ["SK:ClawControl" if one == "MO:EMAG" else one for one in outputs]
        if [str(one) for one in skill.inputs] != inputs or [
            str(one) for one in skill.outputs
        ] != expected:
            raise SystemExit(f"the skill {name!r} of models/collect is wired in another way")
    return description


def plain_mind(description: MindDescription) -> plane_in_pymunk.Mind:
    """Return the mind as the program in plain Python has it."""
    layers: dict[str, plane_in_pymunk.Layers] = {}
    for name in LINKS:
        skill = description.skills[name]
        genome: Any = skill.genome
        rows = [
            genome[first : first + neurons * (sources + 1)].reshape(neurons, sources + 1)
            for first, neurons, sources in layers_of(skill)
        ]
        layers[name] = [(one[:, :-1].copy(), one[:, -1].copy()) for one in rows]
    return plane_in_pymunk.Mind(layers)


# Whether both do the same -------------------------------------------------------------------------


def paths(seed: int, ticks: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where the robot was in the same world: ours, and by plain Python; (ticks, 2) each."""
    model = COLLECT(seed=seed)
    obstacles, robot, ball = (
        model.tables[name].rows for name in ("obstacles", "robots", "objects")
    )
    living = obstacles[model.tables["obstacles"].alive]
    columns = [living[name].tolist() for name in ("x", "y", "angle", "half_width")]
    angle = robot["angle"][0].item()
    places = [(ball["x"][0].item(), ball["y"][0].item())]
    ours = []
    while model.over is None and model.tick < ticks:
        model.advance(1)
        ours.append((robot["x"][0].item(), robot["y"][0].item()))
        if robot["delivered"][0] == len(places):
            places.append((ball["x"][0].item(), ball["y"][0].item()))
    following = iter(places)
    world = plane_in_pymunk.World(
        list(zip(*columns, strict=True)), angle, lambda: next(following), plain_mind(trained())
    )
    theirs = []
    while not world.collided and world.tick < len(ours):
        world.step()
        theirs.append(tuple(world.robot.position))
    return np.array(ours), np.array(theirs)


def check(worlds: int, ticks: int = 600) -> float:
    """Compare paths; return how far apart they come at most, in units.

    Raises:
        SystemExit: farther than rounding explains, which grows as robots act on what they see.
    """
    farthest = 0.0
    for seed in range(worlds):
        ours, theirs = paths(seed, ticks)
        if ours.shape != theirs.shape:
            raise SystemExit(f"world {seed}: {len(ours)} ticks, by plain Python {len(theirs)}")
        farthest = max(farthest, float(np.abs(ours - theirs).max()))
    if farthest > 1e-3:
        raise SystemExit(f"the robots' paths are {farthest:g} apart; they must be the same")
    return farthest


# Rates --------------------------------------------------------------------------------------------

Ticks = Callable[[Sequence[int]], int]
"""Runs the episodes of some worlds; returns how many ticks they took."""


def python_ticks(description: MindDescription, limit: int) -> Ticks:
    """Return what runs episodes by plain Python over pymunk."""
    mind = plain_mind(description)
    return lambda seeds: sum(plane_in_pymunk.episode(seed, limit, mind).tick for seed in seeds)


def shared_ticks(limit: int, physics: str = "compiled") -> Ticks:
    """Return what runs episodes with one genome for all lanes."""
    episodes = Episodes(COLLECT, ticks=limit, lanes=LANES, physics=physics)
    return lambda seeds: int(episodes.run(None, seeds).ticks.sum())


def own_ticks(description: MindDescription, limit: int) -> Ticks:
    """Return what runs episodes with a genome for each lane, as in learning: the same ones here."""
    skills = [name for name, skill in description.skills.items() if skill.genome_size]
    episodes = Episodes(COLLECT, ticks=limit, lanes=LANES, skill=skills)
    known: list[Any] = [description.skills[name].genome for name in skills]
    genome = np.concatenate(known)[None]
    return lambda seeds: int(episodes.run(genome, seeds).ticks.sum())


def threaded_ticks(limit: int, threads: int) -> Ticks:
    """Return what runs episodes in several threads, an equal part of the worlds in each."""
    crew: SimpleQueue[Ticks] = SimpleQueue()
    for _ in range(threads):
        crew.put(shared_ticks(limit))

    def piece(seeds: Sequence[int]) -> int:
        one = crew.get()
        try:
            return one(seeds)
        finally:
            crew.put(one)

    def run(seeds: Sequence[int]) -> int:
        step = -(-len(seeds) // threads)
        with unpinned(), ThreadPoolExecutor(threads) as pool:
            cut = [seeds[first : first + step] for first in range(0, len(seeds), step)]
            return sum(pool.map(piece, cut))

    return run


def rate(run: Ticks, seeds: Sequence[int]) -> float:
    """Return ticks a second over whole episodes."""
    start = time.perf_counter()
    ticks = run(seeds)
    return ticks / (time.perf_counter() - start)


@contextmanager
def unpinned() -> Iterator[None]:
    """Let threads that are made meanwhile run on all cores, where the system can tell."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, CORES)
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


CORES = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set()


# Where the time goes ------------------------------------------------------------------------------


@njit
def _call_all(function: int, planes: NDArray[np.int64], second: NDArray[np.int64]) -> int:
    """Call a compiled function once for each world."""
    total = 0
    for number in range(len(planes)):
        total += call_at(function, planes[number], second[number], 0)
    return total


class Parts:
    """The parts of a tick, each by itself, for worlds that are under way.

    Args:
        description: the mind.
        ticks: how far the worlds are.
    """

    def __init__(self, description: MindDescription, ticks: int) -> None:
        models = []
        for seed in count():
            model = COLLECT(seed=seed)
            model.advance(ticks)
            if model.over is None:
                models.append(model)
            if len(models) == LANES:
                break
        self._models = models
        self._planes = np.array([one.ground.plane_arrays.address for one in models])
        self._eyes = np.array([one.ground.eyes_of("robots") for one in models])
        self._nothing = np.zeros(LANES, np.int64)
        self._minds = Minds(description, "Collect", LANES)
        readings = np.array([one.tables["robots"].rows["readings"][0] for one in models])
        for name, column in zip(description.sensors, readings.T, strict=False):
            self._minds.set_sensor(name, column)

    def motion(self, times: int) -> float:
        """Return microseconds a tick of a world that its bodies' motion takes."""
        tables = [table for one in self._models for table in one.tables.values()]
        kept = [table.rows.copy() for table in tables]
        taken = []
        for _ in range(times):
            taken.append(self._taken(kernel().move.address, self._nothing, 5))
            for table, rows in zip(tables, kept, strict=True):
                table.rows[:] = rows
        return sum(taken) / times

    def rays(self, times: int) -> float:
        """Return microseconds a tick of a world that its range finders take."""
        return self._taken(kernel().look.address, self._eyes, times)

    def mind(self, times: int) -> float:
        """Return microseconds that the evaluation of a mind takes."""
        self._minds.step()
        start = time.perf_counter()
        for _ in range(times):
            self._minds.step()
        return (time.perf_counter() - start) / (times * LANES) * MILLION

    def _taken(self, function: int, second: NDArray[np.int64], times: int) -> float:
        _call_all(function, self._planes, second)
        start = time.perf_counter()
        for _ in range(times):
            _call_all(function, self._planes, second)
        return (time.perf_counter() - start) / (times * LANES) * MILLION


def measure(arguments: argparse.Namespace) -> dict[str, object]:
    """Do all measurements."""
    if CORES:
        os.sched_setaffinity(0, {min(CORES)})
    description, limit = trained(), arguments.ticks
    print("whether both do the same …", flush=True)
    apart = check(arguments.compared)
    threads = min(THREADS, len(CORES) or THREADS)
    few = max(1, arguments.worlds // arguments.fewer)
    programs: dict[str, tuple[Ticks, int]] = {
        "compiled": (shared_ticks(limit), arguments.worlds),
        "compiled_own_genomes": (own_ticks(description, limit), arguments.worlds),
        "compiled_in_threads": (threaded_ticks(limit, threads), threads * arguments.worlds),
        "pymunk": (shared_ticks(limit, "pymunk"), few),
        "python": (python_ticks(description, limit), few),
    }
    print("loading the compiled code …", flush=True)
    for run, worlds in programs.values():
        run(range(min(worlds, threads * LANES)))  # makes the worlds of all lanes, too
    parts = Parts(description, min(1000, limit))
    rates: dict[str, list[float]] = {name: [] for name in programs}
    taken: dict[str, list[float]] = {"motion": [], "rays": [], "mind": []}
    for number in range(arguments.rounds):
        print(f"round {number + 1} of {arguments.rounds} …", flush=True)
        # By turns, and each round another one begins.
        names = list(programs)
        shift = number % len(names)
        for name in [*names[shift:], *names[:shift]]:
            run, worlds = programs[name]
            rates[name].append(rate(run, seeds_for(worlds, "benchmark", number)))
        taken["motion"].append(parts.motion(200))
        taken["rays"].append(parts.rays(2000))
        taken["mind"].append(parts.mind(2000))
    return {
        "machine": describe_machine("numba", "numpy", "pymunk"),
        "worlds": arguments.worlds,
        "worlds_in_python": few,
        "ticks": limit,
        "lanes": LANES,
        "threads": threads,
        "rounds": arguments.rounds,
        "paths_apart": apart,
        "ticks_per_second": rates,
        "microseconds_a_tick": taken,
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    rates, parts = results["ticks_per_second"], results["microseconds_a_tick"]
    ours = rates["compiled"]

    def times(one: list[float], other: list[float], form: str) -> str:
        return spread([a / b for a, b in zip(one, other, strict=True)], form)

    def millions(name: str, form: str) -> str:
        return spread([value / MILLION for value in rates[name]], form)

    shares = {
        name: [100 * part * one / MILLION for part, one in zip(values, ours, strict=True)]
        for name, values in parts.items()
    }
    rest = [100 - sum(values) for values in zip(*shares.values(), strict=True)]
    threads = results["threads"]
    rows = [
        ("compiled: times as fast as Python over pymunk", times(ours, rates["python"], ".0f")),
        (
            f"compiled: {threads} threads, times as fast as one",
            times(rates["compiled_in_threads"], ours, ".2f"),
        ),
        ("compiled (million ticks a second)", millions("compiled", ".3f")),
        (
            "compiled, a genome for each lane (million ticks a second)",
            millions("compiled_own_genomes", ".3f"),
        ),
        (
            f"compiled, {threads} threads (million ticks a second)",
            millions("compiled_in_threads", ".3f"),
        ),
        ('socialmind with `physics="pymunk"` (ticks a second)', spread(rates["pymunk"], ",.0f")),
        ("Python over pymunk (ticks a second)", spread(rates["python"], ",.0f")),
        ("compiled, of a tick: range finders", spread(shares["rays"], ".0f", " %")),
        ("compiled, of a tick: the mind", spread(shares["mind"], ".0f", " %")),
        ("compiled, of a tick: motion", spread(shares["motion"], ".0f", " %")),
        ("compiled, of a tick: other devices, rules, the rest", spread(rest, ".0f", " %")),
    ]
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}, pymunk {machine['pymunk']}; "
        f"{results['rounds']} rounds of {results['worlds']:,} episodes of at most "
        f"{results['ticks']:,} ticks, in each of the threads too, {results['worlds_in_python']:,} "
        "where pymunk moves; one core but for the threads. In the same worlds the robots' paths "
        f"were {results['paths_apart']:.0e} units apart at most.",
        "",
        "| | median | least – greatest |",
        "|---|---|---|",
        *(f"| {name} | {cells} |" for name, cells in rows),
    ]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7, help="how often each is measured")
    parser.add_argument("--worlds", type=int, default=512, help="episodes of a round")
    parser.add_argument(
        "--fewer", type=int, default=128, help="times fewer episodes where pymunk moves"
    )
    parser.add_argument("--ticks", type=int, default=COLLECT.ticks, help="length of an episode")
    parser.add_argument("--compared", type=int, default=10, help="worlds whose paths are compared")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments)
    write(results, table, "plane", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
