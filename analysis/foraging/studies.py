"""Robots that forage together, with and without signals and sight of each other (thesis, 8.1)."""

from __future__ import annotations

import sys
from pathlib import Path

from socialmind.experiments.studies import Study, Way

QUICK_WORLDS = 8


def make_comparison(way: Way, out: Path) -> list[Path]:
    from .comparison import CONDITIONS, SEED, WORLDS, result, write_figure, write_table
    from .trainings import PLANS

    worlds = QUICK_WORLDS if way is Way.QUICK else WORLDS
    trainings = {
        one.training: PLANS.training(one.training, way, out)
        for one in CONDITIONS
        if one.training is not None
    }
    results = []
    for condition in CONDITIONS:
        training = trainings[condition.training][0] if condition.training is not None else None
        results.append((condition, result(condition, training, worlds)))
        print(f"{condition.name}: scored", file=sys.stderr, flush=True)
    lines = [
        f"{way.said('foraging-table', 'foraging')} Means over {worlds} worlds that "
        f"no training has seen (seed {SEED}), the same ones for all; in brackets intervals of 95 "
        "%. Robots without further note have the mind of the model; the others learned under the "
        "same conditions, and their best attempt, by the finals of its own last lesson, is shown.",
        "",
        *(f"- {line}" for _, line in trainings.values()),
    ]
    return [*write_table(results, lines, out), *write_figure(results, out)]


def make_steps(out: Path) -> list[Path]:
    from .steps import draw, found

    return draw(out, found())


studies = (
    Study.of_trainings(
        "foraging-table",
        "foraging robots beside those without signals, without sight of each other, at random",
        make_comparison,
    ),
    Study("figure-8.3", "steps of a robot that forages with others (8.3 and 8.4)", make_steps),
)
