"""What minds do in a model: the same world and the same luck for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from coglogo_py import CognitiveScheme
from socialmind.model import Model

SHOWN = 100
"""Points of a curve."""


def courses(
    model: type[Model],
    population: str,
    schemes: Sequence[CognitiveScheme | None],
    measure: str,
    ticks: int,
    seed: int = 1,
) -> dict[str, Any]:
    """Run a model once with each of some schemes, and return what came of it.

    Args:
        model: the model's class.
        population: whose minds they are.
        schemes: one a run; None for the model's own.
        measure: a column of the series.
        ticks: how long, 1 or more.
        seed: of all runs alike.

    Returns:
        `ticks`, and `courses`: for each scheme the measure at these ticks.
    """
    step = max(ticks // SHOWN, 1)
    shown = range(0, ticks + 1, step)
    found = []
    for scheme in schemes:
        society = model(seed=seed, scheme=None if scheme is None else {population: scheme})
        values = []
        for tick in shown:
            society.advance(tick - society.tick)
            values.append(float(society.series()[measure]))
        found.append(values)
    return {"ticks": list(shown), "courses": found}
