"""Robots that forage together, with and without signals and sight of each other (thesis, 8.1)."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.studies import Study

if TYPE_CHECKING:
    from socialmind.learning import Training

QUICK_WORLDS = 8

Source = Callable[[str, Path], "tuple[Training | None, str]"]
"""Gives the training of a plan, if there is one, and a line on where it comes from."""


def _from_nothing(name: str, out: Path) -> tuple[Training | None, str]:
    """The whole training, made below a folder, or gone on with."""
    return _made(name, out / "trainings", quick=False)


def _small(name: str, out: Path) -> tuple[Training | None, str]:
    """A small training."""
    return _made(name, out / "small_trainings", quick=True)


def _made(name: str, home: Path, quick: bool) -> tuple[Training, str]:
    from .trainings import PLANS, SEED, make

    plan = PLANS[name]
    print(f"{name}: {plan.about}, in {home / name}", file=sys.stderr, flush=True)
    training = make(name, home / name, quick)
    size = "trained small" if quick else "trained from nothing"
    count = len(training.attempts)
    attempts = f"{count} attempt{'s' if count > 1 else ''}"
    return training, f"`{name}`: {plan.about}. {attempts}, {size}, seed {SEED}."


def _kept(name: str, out: Path) -> tuple[Training | None, str]:
    """The training as `results/` has it; nothing is made below the folder."""
    from socialmind.learning import Training

    from .trainings import KEPT, PLANS, SEED

    plan, command = PLANS[name], f"python -m analysis.foraging.trainings {name}"
    if not (KEPT / name).is_dir():
        return None, f"`{name}`: {plan.about}. Not kept; `{command}` makes it."
    training = Training(KEPT / name)
    done = training.manifest.finished
    return training, (
        f"`{name}`: {plan.about}. {done} of {plan.attempts} attempts, seed {SEED}; `{command}`."
    )


WAYS: dict[str, tuple[Source, str]] = {
    "": (_from_nothing, "From training to result"),
    " --quick": (
        _small,
        "A small version, which shows that all works and says nothing about how well",
    ),
    " --kept": (_kept, "From the trainings kept in `analysis/foraging/results`, scored anew"),
}


def make_comparison(way: str, out: Path) -> list[Path]:
    from .comparison import CONDITIONS, SEED, WORLDS, result, write_figure, write_table

    source, made = WAYS[way]
    worlds = QUICK_WORLDS if way == " --quick" else WORLDS
    trainings = {
        one.training: source(one.training, out) for one in CONDITIONS if one.training is not None
    }
    results = []
    for condition in CONDITIONS:
        training = trainings[condition.training][0] if condition.training is not None else None
        results.append((condition, result(condition, training, worlds)))
        print(f"{condition.name}: scored", file=sys.stderr, flush=True)
    lines = [
        f"{made}, by `socialmind reproduce foraging-table{way}`. Means over {worlds} worlds that "
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
    Study(
        "foraging-table",
        "foraging robots beside those without signals, without sight of each other, at random",
        partial(make_comparison, ""),
        quick=partial(make_comparison, " --quick"),
        kept=partial(make_comparison, " --kept"),
    ),
    Study("figure-8.3", "steps of a robot that forages with others (8.3 and 8.4)", make_steps),
)
