"""Lessons of robots in groups: weights that are not learned are shared, beside a copy for each.

    python benchmarks/lessons.py
    python benchmarks/lessons.py --rounds 2 --individuals 4 --ticks 50    # whether it runs

The lessons are those of `models/foraging`: four robots in a world, a hierarchy of skills of which
one lesson teaches one or a few. *Shared* is `Episodes` as a training runs it: each individual has
weights of its own for the lesson's skills alone. *A copy for each* gives every individual its own
weights for all skills that have some, the same numbers; so trainings held them before. Both are
checked to give the same scores, then take turns in one run, on one core.

The results go to benchmarks/lessons.json and, as a table, to benchmarks/README.md.
"""

import argparse
import os
import statistics
import time
from pathlib import Path
from typing import Any

import numpy as np
from harness import HERE, describe_machine, spread, write

from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.lessons.keys import seeds_for
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.course import curriculum_of
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder

MODEL = "foraging"
MILLION = 1e6
CORES = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []


def programs(lesson: Lesson, mind: MindDescription, ticks: int, individuals: int) -> dict[str, Any]:
    """Return both programs by name: a function of seeds that gives scores and ticks."""
    top = lesson.master or lesson.skills[0]
    weights = {
        name: mind.skill(name).genome
        for name in mind.skills
        if name in mind.below(top) and mind.skill(name).genome is not None
    }
    found = {}
    for name, skills in (("shared", list(lesson.skills)), ("copied", list(weights))):
        episodes = Episodes(
            lesson.environment, lesson.parameters, hierarchy=mind, master=lesson.master,
            skill=skills, ticks=ticks,
        )  # fmt: skip
        rows = np.tile(np.concatenate([weights[one] for one in skills]), (individuals, 1))

        def run(seeds: range, episodes: Episodes = episodes, rows: np.ndarray = rows) -> Any:
            outcome = episodes.run(rows, seeds)
            return np.asarray(outcome.score), int(np.asarray(outcome.ticks).sum())

        found[name] = run
    return found


def measure(arguments: argparse.Namespace) -> dict[str, object]:
    """Do all measurements."""
    if CORES:
        os.sched_setaffinity(0, {min(CORES)})
    curriculum, _ = curriculum_of(MODEL)
    mind = MindDescription.load(model_folder(MODEL) / "mind")
    rates: dict[str, dict[str, list[float]]] = {}
    for lesson in curriculum.lessons:
        print(f"{lesson.name} …", flush=True)
        both = programs(lesson, mind, arguments.ticks, arguments.individuals)
        first = {name: run(seeds_for(lesson.repetitions, "check")) for name, run in both.items()}
        if not np.array_equal(first["shared"][0], first["copied"][0]):
            raise SystemExit(f"{lesson.name}: the scores differ")
        rates[lesson.name] = {name: [] for name in both}
        for number in range(arguments.rounds):
            names = list(both) if number % 2 else list(both)[::-1]
            for name in names:
                begin = time.perf_counter()
                _, ticks = both[name](seeds_for(lesson.repetitions, "benchmark", number))
                rates[lesson.name][name].append(ticks / (time.perf_counter() - begin) / MILLION)
    return {
        "machine": describe_machine("numba", "numpy"),
        "individuals": arguments.individuals,
        "ticks": arguments.ticks,
        "rounds": arguments.rounds,
        "million_ticks_per_second": rates,
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}; {results['rounds']} rounds of "
        f"{results['individuals']} individuals, episodes of at most {results['ticks']:,} ticks, on "
        "one core.",
        "",
        "| lesson | shared, times as fast | least – greatest | shared (million ticks a second) |",
        "|---|---|---|---|",
    ]
    for name, rates in results["million_ticks_per_second"].items():
        ratios = [one / other for one, other in zip(rates["shared"], rates["copied"], strict=True)]
        lines.append(
            f"| {name} | {spread(ratios, '.2f')} | {statistics.median(rates['shared']):.3f} |"
        )
    return "\n".join(lines)


def main() -> None:
    """Measure, print and keep."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--rounds", type=int, default=7)
    options.add_argument("--individuals", type=int, default=64)
    options.add_argument("--ticks", type=int, default=1000)
    options.add_argument("--out", type=Path, default=HERE)
    arguments = options.parse_args()
    results = measure(arguments)
    print(table(results))
    write(results, table, "lessons", arguments.out)


if __name__ == "__main__":
    main()
