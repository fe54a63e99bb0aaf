"""The smallest change of one cogniton's value that would change the most probable plan.

A plan's weight is a straight line in the value of one cogniton, and its availability does not
depend on values. `smallest_change` finds where along those lines another plan first takes over:

- MaximumWeight, WeightedStochastic, and BiasedWeightedStochastic with a bias of 1 or more: the most
  probable plan is the one of the largest weight, so where two lines cross;
- BiasedWeightedStochastic with a bias below 1: a weaker plan can be the most probable. Between the
  crossings the cumulative shares C are straight lines in 1 / (sum of the shifted weights), and
  the search walks along them by steps too short to pass over a change;
- a modeller's own decision maker: a search over growing steps, which can miss a brief change.

Whatever the way, the value found is the nearest one, to the last bit, for which the weights and
the maker, computed anew, give another plan.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, pairwise

import numpy as np

from coglogo_py.arrays import Floats
from coglogo_py.decision import (
    DecisionMaker,
    weight_shares,
)

LARGEST_SEARCHED = 1e12
"""How far from the value, in units of it or of 1, the search for a modeller's own maker goes."""

ROUNDING = 2.0 ** np.arange(-54, 0, 3)
"""How far beyond a computed crossing, relative to what rounds, the change is looked for."""

SHORTEST_STEP = 1e-8
WALK_STEPS = 20_000
"""Shortest step, and most steps, of the walk from one crossing (0) to the next (1)."""


@dataclass(frozen=True)
class Line:
    """How the weights of the available plans depend on the value of one active cogniton.

    Args:
        cogniton: its name.
        value: its present value.
        slopes: (n,) weights of its influence links to the available plans.
        weights_at: the available plans' weights at another value of it, as the mind sums them.
        low: the smallest value that it takes.
        high: the largest.
    """

    cogniton: str
    value: float
    slopes: Floats
    weights_at: Callable[[float], Floats]
    low: float = -math.inf
    high: float = math.inf


@dataclass(frozen=True)
class Change:
    """A change of one cogniton's value, and the plan that is then the most probable."""

    cogniton: str
    value: float
    new_value: float
    plan: str
    exact: bool
    """False where the decision maker is a modeller's own: a smaller change may have been missed."""

    @property
    def change(self) -> float:
        """The change, new value less present value."""
        return self.new_value - self.value


def most_probable(maker: DecisionMaker, weights: Floats) -> int:
    """Return the position of the most probable plan, the first of several by the maker's ranks.

    Args:
        maker: the decision maker.
        weights: (n,) weights of the available plans in the scheme's order, n ≥ 1.

    >>> from coglogo_py import BiasedWeightedStochastic
    >>> most_probable(BiasedWeightedStochastic(2.6), np.array([9.0, 12.0, 12.0]))
    1
    """
    if maker.ranking == "weights":
        return int(np.argmax(weights))
    if _is_largest_weight(maker):
        return int(np.argmax(weight_shares(weights)))
    return int(np.argmax(maker.probabilities(weights, maker.bias)))


def _is_largest_weight(maker: DecisionMaker) -> bool:
    """Whether the most probable plan is always the one of the largest weight."""
    return maker.ranking in ("weights", "shares") or (maker.ranking == "ranks" and maker.bias >= 1)


def _has_crossings(maker: DecisionMaker) -> bool:
    """Whether the places of change can be computed: not for a modeller's own maker."""
    return maker.ranking != "unknown"


def smallest_change(
    maker: DecisionMaker, plans: tuple[str, ...], lines: list[Line]
) -> Change | None:
    """Return the smallest change of one cogniton's value that changes the most probable plan.

    Args:
        maker: the scheme's decision maker.
        plans: the available plans, in the scheme's order.
        lines: one for each active cogniton, in the scheme's order.

    Returns:
        The change, of equal ones that of the first cogniton, upwards; None when no value of any
        one cogniton, within its bounds, makes a difference.
    """
    best: Change | None = None
    for line in lines:
        if len(plans) < 2 or not line.slopes.any():
            continue
        present = most_probable(maker, line.weights_at(line.value))
        for direction in (1.0, -1.0):
            new_value = _first_other(maker, line, present, direction)
            if new_value is None or not line.low <= new_value <= line.high:
                continue
            if best is None or abs(new_value - line.value) < abs(best.change):
                plan = plans[most_probable(maker, line.weights_at(new_value))]
                best = Change(line.cogniton, line.value, new_value, plan, _has_crossings(maker))
    return best


def _first_other(maker: DecisionMaker, line: Line, present: int, direction: float) -> float | None:
    """Return the nearest value in one direction at which another plan is the most probable."""
    if _is_largest_weight(maker):
        distances = _crossing_of(line, present, direction)
    elif _has_crossings(maker):
        distances = _changes_of_rank(maker, line, direction)
    else:
        distances = _growing_steps(line)
    reached = 0.0
    for distance, following in pairwise(chain(distances, [math.inf])):
        found = _located(maker, line, present, direction, reached, distance, following)
        if found is not None:
            return found
        reached = distance
    return None


def _located(
    maker: DecisionMaker,
    line: Line,
    present: int,
    direction: float,
    reached: float,
    distance: float,
    following: float,
) -> float | None:
    """Return the nearest value at which the plan changes, to the last bit, or None.

    Args:
        maker: the decision maker.
        line: the weights as the value of a cogniton goes.
        present: position of the plan that is most probable now.
        direction: 1 for larger values, -1 for smaller ones.
        reached: a distance up to which nothing changes.
        distance: where a change is expected, perhaps a little short by rounding.
        following: where the next one is expected.
    """

    def changed(value: float) -> bool:
        weights = line.weights_at(value)
        return bool(np.all(np.isfinite(weights))) and most_probable(maker, weights) != present

    weights = line.weights_at(line.value)
    # What rounds are the value and the weights, these seen along the steepest line.
    visible = (1.0 + float(np.max(np.abs(weights)))) / float(np.max(np.abs(line.slopes)))
    scale = max(abs(line.value), distance, visible)
    margins = (scale * ROUNDING).tolist() if _has_crossings(maker) else []
    for margin in (0.0, *margins):
        after = line.value + direction * (distance + margin)
        beyond = margin > 0 and distance + margin >= following
        if not beyond and math.isfinite(after) and changed(after):
            break
    else:
        return None
    before = line.value + direction * reached
    while True:
        middle = before + (after - before) / 2
        if middle in (before, after):
            return after
        if changed(middle):
            after = middle
        else:
            before = middle


def _crossing_of(line: Line, top: int, direction: float) -> Iterator[float]:
    """Give the distance at which the first other weight reaches that of the top plan, if any."""
    weights = line.weights_at(line.value)
    closing = (line.slopes - line.slopes[top]) * direction
    overtaking = closing > 0
    if overtaking.any():
        yield float(np.min((weights[top] - weights[overtaking]) / closing[overtaking]))


def _growing_steps(line: Line) -> Iterator[float]:
    """Give distances from a billionth of the value up, each a tenth longer than the last."""
    scale = max(1.0, abs(line.value))
    distance = scale * 1e-9
    while distance < scale * LARGEST_SEARCHED:
        yield distance
        distance *= 1.1


def _changes_of_rank(maker: DecisionMaker, line: Line, direction: float) -> Iterator[float]:
    """Give the distances at which the most probable plan may change, for a bias below 1.

    These are the crossings of weights with each other and with 1 (where the shift begins), and
    between them the places where the most probable rank changes.
    """
    weights = line.weights_at(line.value)
    slopes = line.slopes * direction
    crossings = {0.0}
    for i in range(len(weights)):
        if slopes[i] != 0:
            crossings.add(float((1.0 - weights[i]) / slopes[i]))
        for j in range(i):
            if slopes[i] != slopes[j]:
                crossings.add(float((weights[i] - weights[j]) / (slopes[j] - slopes[i])))
    ends = sorted(distance for distance in crossings if distance >= 0)
    for start, end in zip(ends, [*ends[1:], math.inf], strict=True):
        yield start
        yield from _within_ranks(maker.bias, weights, slopes, start, end)


def _within_ranks(
    bias: float, weights: Floats, slopes: Floats, start: float, end: float
) -> Iterator[float]:
    """Give where the most probable rank changes between two crossings, where ranks are fixed."""
    inside = start + 1.0 + abs(start) if math.isinf(end) else (start + end) / 2
    at_inside = weights + slopes * inside
    lowest = int(np.argmin(at_inside))
    constant, slope = weights, slopes
    if at_inside[lowest] < 1.0:
        constant = weights - weights[lowest] + 1.0
        slope = slopes - slopes[lowest]
    ranks = np.argsort(-(constant + slope * inside), kind="stable")
    # Between two crossings every cumulative share is a straight line in 1 / total; `part` goes
    # along it from 0 at the first to 1 at the second.
    at_start = (constant + slope * start)[ranks]
    endless = math.isinf(end)
    at_end = slope[ranks] if endless else (constant + slope * end)[ranks]
    start_total, end_total = float(at_start.sum()), float(at_end.sum())
    if end_total <= 0:
        return
    begin = np.clip(np.cumsum(at_start) / start_total, 0, 1)
    finish = np.clip(np.cumsum(at_end) / end_total, 0, 1)

    def distance_at(part: float) -> float:
        if endless:
            return start + part / (1 - part) * start_total / end_total
        return start + (end - start) * part * start_total / (
            (1 - part) * end_total + part * start_total
        )

    power = 1.0 / bias
    # A rank's probability is f(C_i) − f(C_(i−1)) with f(C) = C^power, whose slope is at most power:
    # no two of them can approach each other faster than this.
    fastest = 4.0 * power * float(np.max(np.abs(finish - begin)))
    if fastest == 0:
        return

    def chances_at(part: float) -> Floats:
        return np.diff((begin + part * (finish - begin)) ** power, prepend=0.0)

    part = 0.0
    leader = int(np.argmax(chances_at(0.0)))
    for _ in range(WALK_STEPS):
        chances = chances_at(part)
        lead = float(chances[leader] - np.delete(chances, leader).max())
        if lead < 0:
            yield distance_at(part)
            leader = int(np.argmax(chances))
        part += max(abs(lead) / fastest, SHORTEST_STEP)
        if part >= 1.0:
            return
