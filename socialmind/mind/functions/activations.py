"""Activations and aggregations: the formulas of neurons, in one place.

Plain functions of numbers: Python runs them as they stand, numba compiles them as they stand, so
the compiled evaluator, the interpreted one and the tests mean the same. The codes are those of
`network.py`.

The activations of neat-python are those of its release 2.0, constants included. Where neat-python
itself would end in an `OverflowError` (the cube of 1e200), its neurons are held to finite numbers
instead: their inputs and the inverse within ± `FINITE`, and an input that is not a number counts
as 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from socialmind.mind.functions.network import (
    CLAMP,
    GREATEST,
    GREATEST_ABSOLUTE,
    LEAST,
    LINEAR,
    MEAN,
    MEDIAN,
    NEAT_ACTIVATIONS,
    PRODUCT,
    RELU,
    SIGMOID,
    TANH,
)

FINITE = 1e100
"""What neurons of neat-python are held within; its cube is still a finite number."""
SELU_SCALE = 1.0507009873554804934193349852946
SELU_ALPHA = 1.6732632423543772848170429916717
LEAK = 0.005
"""The slope of `lelu` below 0."""

_NEAT_SIGMOID = NEAT_ACTIVATIONS["sigmoid"]
_NEAT_TANH = NEAT_ACTIVATIONS["tanh"]
_SIN = NEAT_ACTIVATIONS["sin"]
_GAUSS = NEAT_ACTIVATIONS["gauss"]
_NEAT_RELU = NEAT_ACTIVATIONS["relu"]
_ELU = NEAT_ACTIVATIONS["elu"]
_LELU = NEAT_ACTIVATIONS["lelu"]
_SELU = NEAT_ACTIVATIONS["selu"]
_SOFTPLUS = NEAT_ACTIVATIONS["softplus"]
_IDENTITY = NEAT_ACTIVATIONS["identity"]
_CLAMPED = NEAT_ACTIVATIONS["clamped"]
_INV = NEAT_ACTIVATIONS["inv"]
_LOG = NEAT_ACTIVATIONS["log"]
_EXP = NEAT_ACTIVATIONS["exp"]
_ABS = NEAT_ACTIVATIONS["abs"]
_HAT = NEAT_ACTIVATIONS["hat"]
_SQUARE = NEAT_ACTIVATIONS["square"]


def activate(code: int, x: float) -> float:
    """Return a neuron's value for its input.

    Args:
        code: one of the activations of `network.py`; not checked.
        x: the neuron's input.

    >>> activate(RELU, -2.0), activate(CLAMP, 1.5), activate(SIGMOID, -1000.0)
    (0.0, 1.0, 0.0)
    """
    # The order of comparisons gives 0 for what is not a number.
    if code == LINEAR:
        return x
    if code == RELU:
        return x if x > 0.0 else 0.0
    if code == CLAMP:
        return 1.0 if x >= 1.0 else (x if x > 0.0 else 0.0)
    if code == SIGMOID:
        # Each branch takes the exponential of what is not positive, so that none overflows.
        if x >= 0.0:
            return 1.0 / (1.0 + math.exp(-x))
        power = math.exp(x)
        return power / (1.0 + power)
    if code == TANH:
        return math.tanh(x)
    x = x if -FINITE < x < FINITE else (FINITE if x > 0.0 else (-FINITE if x < 0.0 else 0.0))
    if code == _NEAT_SIGMOID:
        return 1.0 / (1.0 + math.exp(-max(-60.0, min(60.0, 5.0 * x))))
    if code == _NEAT_TANH:
        return math.tanh(max(-60.0, min(60.0, 2.5 * x)))
    if code == _SIN:
        return math.sin(max(-60.0, min(60.0, 5.0 * x)))
    if code == _GAUSS:
        x = max(-3.4, min(3.4, x))
        return math.exp(-5.0 * x * x)
    if code == _NEAT_RELU:
        return x if x > 0.0 else 0.0
    if code == _ELU:
        return x if x > 0.0 else math.exp(x) - 1.0
    if code == _LELU:
        return x if x > 0.0 else LEAK * x
    if code == _SELU:
        return SELU_SCALE * x if x > 0.0 else SELU_SCALE * SELU_ALPHA * (math.exp(x) - 1.0)
    if code == _SOFTPLUS:
        return 0.2 * math.log(1.0 + math.exp(max(-60.0, min(60.0, 5.0 * x))))
    if code == _IDENTITY:
        return x
    if code == _CLAMPED:
        return max(-1.0, min(1.0, x))
    if code == _INV:
        return 0.0 if x == 0.0 else max(-FINITE, min(FINITE, 1.0 / x))
    if code == _LOG:
        return math.log(max(1e-7, x))
    if code == _EXP:
        return math.exp(max(-60.0, min(60.0, x)))
    if code == _ABS:
        return abs(x)
    if code == _HAT:
        return max(0.0, 1.0 - abs(x))
    if code == _SQUARE:
        return x * x
    return x * x * x


def aggregate(code: int, values: Sequence[float]) -> float:
    """Return a neuron's weighted inputs as one number.

    Args:
        code: one of the aggregations of `network.py`; not checked.
        values: the weighted inputs in order; of none, the product is 1 and all others are 0.

    >>> aggregate(GREATEST_ABSOLUTE, [1.0, -3.0, 2.0]), aggregate(MEDIAN, [1.0, 5.0, 2.0, 4.0])
    (-3.0, 3.0)
    """
    count = len(values)
    if code == PRODUCT:
        product = 1.0
        for value in values:
            product *= value
        return product
    if count == 0:
        return 0.0
    if code == GREATEST:
        found = values[0]
        for value in values:
            found = value if value > found else found
        return found
    if code == LEAST:
        found = values[0]
        for value in values:
            found = value if value < found else found
        return found
    if code == GREATEST_ABSOLUTE:
        found = values[0]
        for value in values:
            found = value if abs(value) > abs(found) else found
        return found
    if code == MEDIAN:
        # The two middle values by their ranks: nothing is sorted, so nothing is allocated.
        lower = upper = 0.0
        for value in values:
            less = equal = 0
            for other in values:
                if other < value:
                    less += 1
                elif other == value:
                    equal += 1
            if less <= (count - 1) // 2 < less + equal:
                lower = value
            if less <= count // 2 < less + equal:
                upper = value
        return lower if count % 2 == 1 else (lower + upper) / 2.0
    total = 0.0
    for value in values:
        total += value
    return total / count if code == MEAN else total
