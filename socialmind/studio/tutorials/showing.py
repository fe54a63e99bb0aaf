"""What minds do in a model: the same world and the same luck for each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from socialmind.catalogue import load_model
from socialmind.model import Model
from socialmind.studio.schemes.checking import Bearers, runnable_of
from socialmind.studio.tutorials.step import Courses, Document

SHOWN = 100
"""Points of a curve."""
YOURS = "your mind"
SEED = 1


def courses(societies: Mapping[str, Model], measure: Callable[[Any], float], ticks: int) -> Courses:
    """Run societies, and return what came of them.

    Args:
        societies: by what they are called.
        measure: takes a number of a society.
        ticks: how long, 1 or more.

    Returns:
        `ticks`, `names`, and `courses`: for each name the numbers at these ticks.
    """
    shown = range(0, ticks + 1, max(ticks // SHOWN, 1))
    found = []
    for society in societies.values():
        values = []
        for tick in shown:
            society.advance(tick - society.tick)
            values.append(float(measure(society)))
        found.append(values)
    return {"ticks": list(shown), "names": list(societies), "courses": found}


def courses_of_scheme(
    model: str, population: str, measure: str, ticks: int, document: Document, beside: bool = False
) -> Courses:
    """Return what a model does with an edited scheme.

    Args:
        model: its name.
        population: whose minds it is.
        measure: a column of the series.
        ticks: how long.
        document: the scheme, as the editor has it.
        beside: whether the same is shown with the model's own scheme.

    Raises:
        SchemeError: the document is no scheme that the model can run with.
    """
    bearers = Bearers.of(load_model(model), population)
    edited = runnable_of(dict(document), bearers)
    societies = {YOURS: bearers.model(seed=SEED, scheme={population: edited})}
    if beside:
        societies["the model's own"] = bearers.model(seed=SEED)
    return courses(societies, lambda society: society.series()[measure], ticks)
