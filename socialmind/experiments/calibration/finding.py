"""What a search found: the best trial, how good luck lets one be, and the plausible values.

**Luck.** At the best trial's values the model is run on new seeds. From these runs data are made as
those of a recovery are, and a trial of them; how far the two are apart is luck alone. The 95 %
quantile of that, over draws, is the distance beyond which values are not plausible.

**Intervals.** A parameter's interval holds the values at which the smooth surface through the
trials (`surface`) is no higher than luck, the other parameters being as good as they can be. Where
the method gives a posterior (`abc`), it is the middle 95 % of that. Whether intervals hold the
truth as often as they should is what recovery finds out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.calibration.search import Record, Search, runs_of
from socialmind.experiments.calibration.surface import Surface

LEVEL = 0.95
DRAWS = 400
"""Of data and a trial, from the runs on new seeds."""

Interval = tuple[float, float] | None
"""Ends, in the parameter's unit."""


@dataclass(frozen=True)
class Found:
    """What a search found.

    Attributes:
        search: its number.
        truth: the known values of a recovery.
        values: those of the best trial; None where there is no result.
        trial: its number.
        distance: its distance from the data.
        again: the mean distance of such a trial on new seeds.
        luck: beyond this distance values are not plausible.
        plausible: how many trials are.
        intervals: of each parameter.
        problem: why there is no result.
    """

    search: int
    truth: tuple[float, ...] | None = None
    values: tuple[float, ...] | None = None
    trial: int | None = None
    distance: float = math.nan
    again: float = math.nan
    luck: float = math.nan
    plausible: int = 0
    intervals: tuple[Interval, ...] = ()
    problem: str | None = None


def found_by(search: Search) -> Found:
    """Return what a search found, once it has come to its end."""
    plan = search.plan
    none = (None,) * len(plan.space.dimensions)
    truth = None if search.truth is None else plan.space.values(search.truth)
    best = search.best()
    if best is None or search.new is None:
        return Found(search.number, truth, intervals=none, problem=search.problem)
    again, luck = _luck(search, search.new)
    plausible = [one for one in search.trials if one["distance"] <= luck]
    sample = search.method.sample()
    ends: Sequence[tuple[float, float] | None] = none
    if sample is not None:
        ends = [_middle(column, sample[1]) for column in sample[0].T]
    else:
        surface = surface_of(search, luck)
        if surface is not None:
            ends = [surface.within(n, luck**2) for n in range(len(none))]
    return Found(
        search.number, truth, plan.space.values(best["place"]), best["number"], best["distance"],
        again, luck, len(plausible), _in_units(search, ends),
    )  # fmt: skip


def surface_of(search: Search, luck: float) -> Surface | None:
    """Return the smooth surface through a search's trials; None where nobody knows of luck."""
    if not math.isfinite(luck):
        return None
    places = np.array([one["place"] for one in search.trials])
    distances = np.array([one["distance"] for one in search.trials])
    return Surface.through(places, distances, luck)


def _luck(search: Search, new: Record) -> tuple[float, float]:
    """Return the mean distance of trials on new seeds from the data, and how far luck goes."""
    runs, plan = runs_of(new), search.plan
    if len(runs) < 2:
        return math.nan, math.nan
    rng = plan.draws_of(search.number, "luck")
    again, apart = [], []
    for _ in range(DRAWS):
        order = rng.permutation(len(runs))
        held = min(plan.data_runs, len(runs) // 2)
        if plan.data_runs >= len(runs):  # of so many runs the mean is nearly the same
            data, others = runs, order
        else:
            data, others = runs[order[:held]], order[held:]
        drawn = rng.choice(others, plan.seeds, replace=plan.seeds > len(others))
        mean = runs[drawn].mean(axis=0)
        apart.append(plan.target.of_data(data, rng).distance(mean))
        again.append(search.target.distance(mean))
    return float(np.mean(again)), float(np.quantile(apart, LEVEL))


def _middle(values: NDArray[np.float64], weights: NDArray[np.float64]) -> tuple[float, float]:
    """Return the ends of the middle 95 % of a weighted sample."""
    order = np.argsort(values)
    below = np.cumsum(weights[order]) - weights[order] / 2
    edge = (1 - LEVEL) / 2
    low, high = np.interp([edge, 1 - edge], below, values[order]).tolist()
    return low, high


def _in_units(search: Search, ends: Sequence[tuple[float, float] | None]) -> tuple[Interval, ...]:
    pairs = zip(search.plan.space.dimensions, ends, strict=True)
    return tuple(one and (d.value(one[0]), d.value(one[1])) for d, one in pairs)
