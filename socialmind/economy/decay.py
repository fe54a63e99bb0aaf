"""Decay models: how a quantity falls, follows or comes to rest when nothing acts on it."""

from __future__ import annotations


def proportional_decay(value: float, rate: float) -> float:
    """Return what is left of a value that loses a share of itself: v′ = v · (1 − r).

    Food that spoils, a pheromone that evaporates, a demand that is forgotten.

    Args:
        value: v, any number.
        rate: r, the share lost at a step, 0 … 1.

    Source: foodDecay in listing 3.1 of the thesis.

    >>> proportional_decay(1000.0, 0.25)
    750.0
    """
    return value * (1.0 - rate)


def exponential_smoothing(value: float, observed: float, weight: float) -> float:
    """Return a running estimate after an observation: v′ = v + w · (o − v).

    Args:
        value: v, the estimate so far.
        observed: o, what was observed.
        weight: w, the weight of the observation, 0 … 1.

    >>> exponential_smoothing(10.0, 20.0, 0.1)
    11.0
    """
    return value + weight * (observed - value)


def towards_neutral(value: float, factor: float, neutral: float, bound: float) -> float:
    """Return a value that comes to rest: v′ = n + (v − n) · f, held within n ± b.

    The thesis's specialisation: without reinforcement a role slowly returns to its neutral value
    (section 3.3.3). As in the original model, a value found beyond the bound is set to the bound
    and does not come to rest in that step.

    Args:
        value: v, any number.
        factor: f, what is left of the distance after a step, 0 … 1.
        neutral: n, where it comes to rest.
        bound: b, the largest distance from n, 0 or more.

    >>> towards_neutral(20.0, 0.5, 0.0, 30.0), towards_neutral(31.0, 0.5, 0.0, 30.0)
    (10.0, 30.0)
    """
    distance = value - neutral
    if distance > bound:
        return neutral + bound
    if distance < -bound:
        return neutral - bound
    return neutral + distance * factor
