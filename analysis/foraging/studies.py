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
    names = dict.fromkeys(one.training for one in CONDITIONS)
    trainings = {name: PLANS.training(name, way, out) for name in names}
    results = []
    for condition in CONDITIONS:
        training = trainings[condition.training][0]
        results.append((condition, result(condition, training, worlds)))
        print(f"{condition.name}: scored", file=sys.stderr, flush=True)
    lines = [
        f"{way.said('foraging-table', 'foraging')} Means over all attempts of a training and "
        f"{worlds} worlds that no training has seen (seed {SEED}), the same ones for all; in "
        "brackets intervals of 95 % over attempts and worlds, wide where attempts are few. "
        "*Learned without* and *learned with* have trainings of their own; the others are the "
        "attempts of `foraging`, from which something is taken.",
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
