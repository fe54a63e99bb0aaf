"""How fast hierarchies of skills are evaluated, beside torch in eager mode and plain Python.

The Collect hierarchy of thesis figure 6.1 (`collect_hierarchy.py` says how it is read) is evaluated
for many agents, on one core. All programs take turns in one run, so that a busy machine slows all;
they are first checked to give the same commands. One evaluation is one hierarchy of one agent, from
sensors that are in place to commands that are in place.

    python benchmarks/mind.py
    python benchmarks/mind.py --agents 20 --rounds 2 --seconds 0.05    # whether it runs

The results go to benchmarks/mind.json and, as a table, to benchmarks/README.md.
"""

import argparse
import os
import sys
import time
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import torch
from collect_hierarchy import (
    ACTUATORS,
    MASTER,
    SENSORS,
    collect_hierarchy,
    genomes,
    sensor_values,
    size,
)
from collect_in_python import Robot
from collect_in_torch import Collect, columns_of
from harness import HERE, describe_machine, spread, write

from socialmind.mind import Hierarchy, MindDescription, Minds

SHARED, OWN = "shared", "own"
SIZES = [(2, 2), (1, 2), (4, 2), (8, 2), (2, 16), (2, 48)]
"""Hidden layers and added neurons of the hierarchies over which weights are scaled."""
Step = Callable[[], object]


def minds(description: MindDescription, agents: int, own: bool, seed: int = 0) -> Minds:
    """Return agents with weights and with sensors in place."""
    made = Minds(description, MASTER, agents, own_genomes=own)
    for name, weights in genomes(description, agents if own else 1, seed).items():
        made.set_genome(name, weights if own else weights[0])
    for name, column in zip(SENSORS, sensor_values(agents, seed).T, strict=True):
        made.set_sensor(name, column)
    return made


def torch_step(
    description: MindDescription, agents: int, way: str, seed: int = 0
) -> Callable[[], torch.Tensor]:
    """Return what evaluates all agents once in torch."""
    count = 1 if way == SHARED else agents
    program = Collect(description, genomes(description, count, seed), way)
    columns = columns_of(sensor_values(agents, seed))
    return lambda: program.step(columns)


def python_step(
    description: MindDescription, agents: int, own: bool, seed: int = 0
) -> Callable[[], list[tuple[float, ...]]]:
    """Return what evaluates all agents once in plain Python."""
    drawn = genomes(description, agents if own else 1, seed)
    robots = [
        Robot(description, {name: one[number if own else 0] for name, one in drawn.items()})
        for number in range(agents)
    ]
    rows = sensor_values(agents, seed).tolist()
    return lambda: [robot.step(row) for robot, row in zip(robots, rows, strict=True)]


def check(description: MindDescription, agents: int = 50, ticks: int = 3) -> float:
    """Compare the commands of all programs; return the share of skills that received influence."""
    shares = []
    for own in (False, True):
        ours = minds(description, agents, own)
        plain = python_step(description, agents, own)
        ways = ["bmm", "vmap"] if own else [SHARED]
        in_torch = {way: torch_step(description, agents, way) for way in ways}
        for _ in range(ticks):
            ours.step()
            found = np.stack([ours.actuator(name) for name in ACTUATORS], axis=1)
            _same("plain Python", np.array(plain()), found, 1e-9)
            for way, step in in_torch.items():
                _same(f"torch, {way}", step().numpy(), found, 1e-3)
        influenced = [ours.influence(name) > 0.0 for name in description.skills]
        shares.append(float(np.mean(influenced)))
    return sum(shares) / len(shares)


def _same(name: str, theirs: np.ndarray, ours: np.ndarray, bound: float) -> None:
    apart = float(np.abs(theirs - ours).max())
    if not apart <= bound:
        raise SystemExit(f"{name} gives commands {apart:g} apart; they must be the same")


def rate(step: Step, agents: int, seconds: float) -> float:
    """Return evaluations a second, over a stretch of about so many seconds."""
    count, spent = 1, 0.0
    while True:
        start = time.perf_counter()
        for _ in range(count):
            step()
        spent = time.perf_counter() - start
        if spent >= seconds:
            return agents * count / spent
        count = max(2 * count, int(count * seconds / max(spent, 1e-9)) + 1)


def lookup_rate(description: MindDescription, seconds: float) -> float:
    """Return evaluations a second of one agent by `Hierarchy.evaluate`, tables included."""
    hierarchy = Hierarchy(description, MASTER)
    for name, weights in genomes(description, 1, 0).items():
        hierarchy.skill(name).genome = weights[0]
    values = dict(zip(SENSORS, sensor_values(1, 0)[0].tolist(), strict=True))
    hierarchy.evaluate(values)
    return rate(lambda: hierarchy.evaluate(values), 1, seconds)


def memory(description: MindDescription, agents: int, ticks: int = 1000) -> dict[str, int]:
    """Return what evaluating takes of memory: in so many ticks, and in ten times as many.

    Returns:
        The peak of bytes traced (Python and numpy), and blocks that Python kept.
    """
    made = minds(description, agents, own=True)
    made.step()
    found = {}
    for times in (ticks, 10 * ticks):
        tracemalloc.start()
        blocks = sys.getallocatedblocks()
        for _ in range(times):
            made.step()
        found[f"blocks_after_{times}"] = sys.getallocatedblocks() - blocks
        found[f"peak_bytes_in_{times}"] = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return found


def scaling(arguments: argparse.Namespace) -> dict[str, list[dict[str, float]]]:
    """Measure over agents and over weights, each by its best of the rounds."""
    over: dict[str, list[dict[str, float]]] = {"agents": [], "weights": []}
    description = collect_hierarchy()

    def best(description: MindDescription, agents: int, own: bool) -> float:
        made = minds(description, agents, own)
        made.step()
        return max(rate(made.step, agents, arguments.seconds) for _ in range(arguments.rounds))

    for agents in arguments.crowds:
        print(f"{agents} agents …", flush=True)
        rates = {SHARED: best(description, agents, False)}
        if agents <= arguments.most_genomes:
            rates[OWN] = best(description, agents, True)
        over["agents"].append({"agents": agents, **rates})
    for layers, added in SIZES:
        larger = collect_hierarchy(layers, added)
        print(f"{size(larger)} weights …", flush=True)
        rates = {
            SHARED: best(larger, arguments.agents, False),
            OWN: best(larger, arguments.agents, True),
        }
        over["weights"].append({"layers": layers, "added": added, "weights": size(larger), **rates})
    over["weights"].sort(key=lambda one: one["weights"])
    return over


def measure(arguments: argparse.Namespace) -> dict[str, object]:
    """Do all measurements."""
    torch.set_num_threads(1)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    description = collect_hierarchy()
    print("whether all give the same commands …", flush=True)
    influenced = check(description)
    agents = arguments.agents
    steps: dict[str, Step] = {
        "ours_shared": minds(description, agents, False).step,
        "ours_own": minds(description, agents, True).step,
        "torch_shared": torch_step(description, agents, SHARED),
        "torch_bmm_own": torch_step(description, agents, "bmm"),
        "torch_vmap_own": torch_step(description, agents, "vmap"),
        "python_shared": python_step(description, agents, False),
        "python_own": python_step(description, agents, True),
    }
    rates: dict[str, list[float]] = {name: [] for name in steps}
    one_by_one = []
    for number in range(arguments.rounds):
        print(f"round {number + 1} of {arguments.rounds} …", flush=True)
        # By turns, and each round another one begins.
        names = list(steps)
        for name in [*names[number % len(names) :], *names[: number % len(names)]]:
            rates[name].append(rate(steps[name], agents, arguments.seconds))
        one_by_one.append(lookup_rate(description, arguments.seconds))
    return {
        "machine": describe_machine("numba", "numpy", "torch"),
        "agents": agents,
        "weights": size(description),
        "rounds": arguments.rounds,
        "seconds": arguments.seconds,
        "share_of_skills_influenced": influenced,
        "evaluations_per_second": rates,
        "one_agent_evaluations_per_second": one_by_one,
        "memory": memory(description, agents),
        "scaling": scaling(arguments),
    }


def table(results: dict) -> str:
    """The results as tables in Markdown."""
    rates = results["evaluations_per_second"]
    torch_own = [
        max(both) for both in zip(rates["torch_bmm_own"], rates["torch_vmap_own"], strict=True)
    ]

    def times(ours: str, theirs: list[float], form: str) -> str:
        return spread([a / b for a, b in zip(rates[ours], theirs, strict=True)], form)

    def millions(values: list[float], form: str) -> str:
        return spread([value / 1e6 for value in values], form)

    one, each = "one genome for all", "a genome each"
    rates_of = "million evaluations a second"
    one_by_one = [rate / 1e3 for rate in results["one_agent_evaluations_per_second"]]
    rows = [
        (f"{one}: times as fast as torch", times("ours_shared", rates["torch_shared"], ".1f")),
        (f"{each}: times as fast as torch", times("ours_own", torch_own, ".1f")),
        (f"{one}: times as fast as Python", times("ours_shared", rates["python_shared"], ".0f")),
        (f"{each}: times as fast as Python", times("ours_own", rates["python_own"], ".0f")),
        (f"{one} ({rates_of})", millions(rates["ours_shared"], ".2f")),
        (f"{one}, torch", millions(rates["torch_shared"], ".2f")),
        (f"{one}, plain Python", millions(rates["python_shared"], ".4f")),
        (f"{each} ({rates_of})", millions(rates["ours_own"], ".2f")),
        (f"{each}, torch by `baddbmm`", millions(rates["torch_bmm_own"], ".3f")),
        (f"{each}, torch by `vmap`", millions(rates["torch_vmap_own"], ".3f")),
        (f"{each}, plain Python", millions(rates["python_own"], ".4f")),
        (
            "one agent by `Hierarchy.evaluate` (thousand evaluations a second)",
            spread(one_by_one, ".1f"),
        ),
    ]
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}, torch {machine['torch']}; "
        f"{results['agents']:,} agents, {results['weights']:,} weights, {results['rounds']} "
        f"rounds on one core. {100 * results['share_of_skills_influenced']:.0f} % of the skills "
        "received influence.",
        "",
        "| | median | least – greatest |",
        "|---|---|---|",
        *(f"| {name} | {cells} |" for name, cells in rows),
        "",
        f"By agents, in {rates_of}, the best of the rounds:",
        "",
        f"| agents | {one} | {each} |",
        "|---|---|---|",
        *(_scaling_row(f"{row['agents']:,}", row) for row in results["scaling"]["agents"]),
        "",
        f"By weights, in thousand million weights a second, with {results['agents']:,} agents:",
        "",
        f"| weights (hidden layers, neurons added) | {one} | {each} |",
        "|---|---|---|",
        *(
            _scaling_row(
                f"{row['weights']:,} ({row['layers']}, {row['added']})", row, row["weights"] / 1e3
            )
            for row in results["scaling"]["weights"]
        ),
        "",
        _memory_line(results["memory"]),
    ]
    return "\n".join(lines)


def _scaling_row(name: str, rates: dict[str, float], factor: float = 1.0) -> str:
    cells = [
        f"{rates[kind] * factor / 1e6:.2f}" if kind in rates else "–" for kind in (SHARED, OWN)
    ]
    return f"| {name} | {cells[0]} | {cells[1]} |"


def _memory_line(memory: dict[str, int]) -> str:
    ticks = sorted(int(name.rpartition("_")[2]) for name in memory if name.startswith("peak"))
    peaks = " and ".join(f"{memory[f'peak_bytes_in_{one}']:,} bytes" for one in ticks)
    counts = " and ".join(f"{one:,}" for one in ticks)
    blocks = " and ".join(f"{memory[f'blocks_after_{one}']}" for one in ticks)
    return (
        f"Memory in {counts} ticks, with a genome each: at most {peaks} at once, by Python and "
        f"numpy together; {blocks} blocks were left."
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--agents", type=int, default=1000, help="how many are evaluated")
    parser.add_argument("--rounds", type=int, default=7, help="how often each is measured")
    parser.add_argument("--seconds", type=float, default=0.5, help="length of a measurement")
    parser.add_argument(
        "--crowds", type=int, nargs="*", default=[10, 100, 1000, 10_000, 100_000],
        help="numbers of agents over which is scaled",
    )  # fmt: skip
    parser.add_argument(
        "--most-genomes", type=int, default=100_000,
        help="most agents with a genome each; 100,000 take 1.2 GB, and as much for a moment",
    )  # fmt: skip
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments)
    write(results, table, "mind", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
