"""Decision makers: how a mind picks one plan out of the weights of the available ones.

A maker is a name, a bias and two plain functions. Both take the weights of the available plans, in
the scheme's order, and the bias:

- `choose(weights, bias, u)`: the position of the plan that the uniform number `u` falls on;
- `probabilities(weights, bias)`: the exact probability of each plan.

They are ordinary Python in the subset that numba compiles, so that a decision is the same in both.
Formulas: thesis, section 3.2, and CogLogo 1.18.1, with ties broken by the scheme's order.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from coglogo_py.border.errors import SchemeError, nearest, shown
from coglogo_py.border.numbers import is_number

Weights = NDArray[np.float64]


@register_jitable
def weight_shares(weights: Weights) -> Weights:
    """Return each plan's share of the weights, after moving them all up so that the least is 1.

    The offset is 1 − min where the least weight is under 1, else 0; share = (w + offset) / Σ.

    Args:
        weights: (n,) finite weights, n ≥ 1.

    Returns:
        (n,) shares, none negative, with sum 1 up to rounding.

    >>> weight_shares(np.array([-1.0, 0.0, 1.0])).round(3).tolist()
    [0.167, 0.333, 0.5]
    """
    # Sums run one by one, in order: NumPy's own would differ from numba's in the last bit.
    count = len(weights)
    least = float(weights[0])
    greatest = least
    for position in range(1, count):
        least = min(least, float(weights[position]))
        greatest = max(greatest, float(weights[position]))
    scale = 1.0
    if greatest > 1e300 / count or least < -1e300 / count:
        # Near the end of the number range: the same shares, of weights scaled down.
        scale = 1e-10 / count
    moved = np.empty(count)
    total = 0.0
    for position in range(count):
        weight = float(weights[position]) * scale
        if least < 1.0:
            # (w − min) + 1 rather than w + (1 − min): the 1 survives beside large weights.
            weight = (weight - least * scale) + scale
        moved[position] = weight
        total += weight
    for position in range(count):
        moved[position] /= total
    return moved


@register_jitable
def heaviest(weights: Weights) -> int:
    """Return the position of the largest weight, the first of equals."""
    best = 0
    for position in range(1, len(weights)):
        if weights[position] > weights[best]:
            best = position
    return best


@register_jitable
def positive_shares(weights: Weights) -> Weights:
    """Return each plan's share of the weights above 0; all is the largest one's if none is.

    >>> positive_shares(np.array([1.0, -2.0, 3.0])).tolist(), positive_shares(-np.ones(2)).tolist()
    ([0.25, 0.0, 0.75], [1.0, 0.0])
    """
    count = len(weights)
    best = heaviest(weights)
    scale = 1e-10 / count if weights[best] > 1e300 / count else 1.0
    shares = np.zeros(count)
    total = 0.0
    for position in range(count):
        if weights[position] > 0.0:
            shares[position] = float(weights[position]) * scale
            total += shares[position]
    if total <= 0.0:
        shares[best] = 1.0
        return shares
    for position in range(count):
        shares[position] /= total
    return shares


@dataclass(frozen=True)
class DecisionMaker:
    """Base of the decision makers: subclass it to let minds decide in a way of your own.

    A maker of your own sets `name`, one word, and the two static functions. They must stay within
    what numba compiles, call no random numbers (`u` is the draw), give a plan's probability exactly
    and choose so that over all `u` each plan comes as often as its probability says. Hand the
    class to `CognitiveScheme.load(path, decision_makers=[...])` if a file names it.

    Args:
        bias: a number above 0 that the maker may use; 1 by default.

    Raises:
        SchemeError: the bias is not a finite number above 0, or the subclass is incomplete.

    >>> class FirstAvailable(DecisionMaker):
    ...     '''Takes the available plan that the scheme names first.'''
    ...
    ...     name = "FirstAvailable"
    ...
    ...     @staticmethod
    ...     def choose(weights, bias, u):
    ...         return 0
    ...
    ...     @staticmethod
    ...     def probabilities(weights, bias):
    ...         shares = np.zeros(len(weights))
    ...         shares[0] = 1.0
    ...         return shares
    >>> FirstAvailable().choose(np.array([2.0, 5.0]), 1.0, 0.5)
    0
    """

    bias: float = 1.0

    name: ClassVar[str] = ""
    biased: ClassVar[bool] = True
    """Whether its bias plays a part."""
    ranking: ClassVar[str] = "unknown"
    """By what its most probable plan is found: `weights`, `shares`, `ranks` (shares and the bias),
    or `unknown`, by its probabilities alone."""

    @staticmethod
    def choose(weights: Weights, bias: float, u: float) -> int:
        """Return the position of the plan that `u` falls on; each maker has its own.

        Args:
            weights: (n,) finite weights of the available plans, in the scheme's order, n ≥ 1.
            bias: the maker's bias.
            u: the draw, in [0, 1).

        Returns:
            A position in 0 … n − 1.
        """
        raise _undecided()

    @staticmethod
    def probabilities(weights: Weights, bias: float) -> Weights:
        """Return the exact probability of each plan; each maker has its own.

        Args:
            weights: (n,) finite weights of the available plans, in the scheme's order, n ≥ 1.
            bias: the maker's bias.

        Returns:
            (n,) probabilities with sum 1.
        """
        raise _undecided()

    def __init_subclass__(cls) -> None:
        """Refuse a maker that lacks its name or one of its functions."""
        super().__init_subclass__()
        for known in ("biased", "ranking"):  # of a maker itself, not of one that it is made from
            if known not in vars(cls):
                setattr(cls, known, getattr(DecisionMaker, known))
        name = cls.name
        if not isinstance(name, str) or not name or name.split() != [name]:
            raise SchemeError(
                f"decision maker {cls.__name__} with the name {name!r}",
                "one word, which a scheme file can hold",
                f'write name = "{cls.__name__}" in the class',
            )
        for function in ("choose", "probabilities"):
            own = inspect.getattr_static(cls, function)
            if own is vars(DecisionMaker)[function] or not isinstance(own, staticmethod):
                raise SchemeError(
                    f"decision maker {cls.__name__} without a static function {function!r}",
                    "choose(weights, bias, u) and probabilities(weights, bias)",
                    "write @staticmethod above each of the two",
                )

    def __post_init__(self) -> None:
        if type(self) is DecisionMaker:
            raise _undecided()
        bias = self.bias
        if not is_number(bias) or not bias > 0:
            raise SchemeError(
                f"bias {shown(bias)} of the decision maker {self.name}",
                "a finite number above 0",
                "write 1 for no bias; above 1 favours strong plans, below 1 weak ones",
            )
        object.__setattr__(self, "bias", float(bias))


def _undecided() -> SchemeError:
    return SchemeError(
        "DecisionMaker is the base of the decision makers and decides nothing",
        remedy="use MaximumWeight() or another of them, or write a subclass",
    )


class MaximumWeight(DecisionMaker):
    """The plan of the greatest weight; among equals, the one that the scheme names first.

    >>> MaximumWeight.choose(np.array([9.0, 12.0, 12.0]), 1.0, 0.7)
    1
    """

    name = "MaximumWeight"
    biased = False
    ranking = "weights"

    @staticmethod
    def choose(weights: Weights, bias: float, u: float) -> int:
        """Return the position of the greatest weight; `bias` and `u` play no part."""
        return heaviest(weights)

    @staticmethod
    def probabilities(weights: Weights, bias: float) -> Weights:
        """Return 1 for the first plan of the greatest weight and 0 for the others."""
        certain = np.zeros(len(weights))
        certain[heaviest(weights)] = 1.0
        return certain


class WeightedStochastic(DecisionMaker):
    """A plan drawn with the probability of its share of the weights, moved up to 1 at least.

    >>> WeightedStochastic.probabilities(np.array([1.0, 3.0]), 1.0).tolist()
    [0.25, 0.75]
    """

    name = "WeightedStochastic"
    biased = False
    ranking = "shares"

    @staticmethod
    def choose(weights: Weights, bias: float, u: float) -> int:
        """Return the first position whose cumulative share reaches `u`; `bias` plays no part."""
        shares = weight_shares(weights)
        last = len(weights) - 1
        cumulative = 0.0
        for position in range(last):
            cumulative += shares[position]
            if u <= cumulative:
                return position
        return last

    @staticmethod
    def probabilities(weights: Weights, bias: float) -> Weights:
        """Return the shares."""
        return weight_shares(weights)


class PositiveStochastic(DecisionMaker):
    """A plan drawn in proportion to its weight, those of weight 0 or less never.

    MetaCiv's WeightedStochasticDecisionMaker. Where no weight is above 0, the largest one wins.

    >>> PositiveStochastic.probabilities(np.array([1.0, -2.0, 3.0]), 1.0).tolist()
    [0.25, 0.0, 0.75]
    """

    name = "PositiveStochastic"
    biased = False

    @staticmethod
    def choose(weights: Weights, bias: float, u: float) -> int:
        """Return the first position whose cumulative share is above `u`; no bias plays a part."""
        shares = positive_shares(weights)
        cumulative = 0.0
        for position in range(len(weights)):
            cumulative += shares[position]
            if u < cumulative:
                return position
        return heaviest(weights)

    @staticmethod
    def probabilities(weights: Weights, bias: float) -> Weights:
        """Return the shares of the weights that are above 0."""
        return positive_shares(weights)


class BiasedWeightedStochastic(DecisionMaker):
    """A plan drawn by share, the draw raised to the power of a bias; strong plans come first.

    With the shares sorted from the greatest down (equals in the scheme's order) and their
    cumulative sums C, the plan at rank i has the probability C_i^(1/bias) − C_(i−1)^(1/bias). A
    bias above 1 favours strong plans and, among equals, the earlier; below 1, weak ones.

    >>> BiasedWeightedStochastic(2).probabilities(np.array([1.0, 3.0]), 2.0).round(4).tolist()
    [0.134, 0.866]
    """

    name = "BiasedWeightedStochastic"
    ranking = "ranks"

    @staticmethod
    def choose(weights: Weights, bias: float, u: float) -> int:
        """Return the first position, by rank, whose cumulative share reaches `u ** bias`."""
        shares = weight_shares(weights)
        ranks = np.argsort(-shares, kind="mergesort")
        draw = math.pow(u, bias)
        last = len(weights) - 1
        cumulative = 0.0
        for rank in range(last):
            cumulative += shares[ranks[rank]]
            if draw <= cumulative:
                return int(ranks[rank])
        return int(ranks[last])

    @staticmethod
    def probabilities(weights: Weights, bias: float) -> Weights:
        """Return C_i^(1/bias) − C_(i−1)^(1/bias) for the plan at rank i."""
        shares = weight_shares(weights)
        ranks = np.argsort(-shares, kind="mergesort")
        chances = np.zeros(len(weights))
        last = len(weights) - 1
        cumulative = 0.0
        below = 0.0
        for rank in range(last):
            cumulative += shares[ranks[rank]]
            reached = math.pow(min(cumulative, 1.0), 1.0 / bias)
            chances[ranks[rank]] = reached - below
            below = reached
        chances[ranks[last]] = 1.0 - below
        return chances


BUILT_IN: tuple[type[DecisionMaker], ...] = (
    MaximumWeight,
    WeightedStochastic,
    BiasedWeightedStochastic,
    PositiveStochastic,
)
"""The decision makers of CogLogo, and MetaCiv's that draws."""


def decision_maker_called(
    name: str, bias: float = 1.0, makers: Iterable[type[DecisionMaker]] = ()
) -> DecisionMaker:
    """Return the decision maker that a file names.

    Args:
        name: its name, capitals included.
        bias: a finite number above 0.
        makers: classes that a modeller made, besides the built-in ones; of one name, theirs wins.

    Raises:
        SchemeError: no maker has that name, or the bias is no finite number above 0.

    >>> decision_maker_called("BiasedWeightedStochastic", 2.6)
    BiasedWeightedStochastic(bias=2.6)
    """
    known = {maker.name: maker for maker in (*BUILT_IN, *makers)}
    if name not in known:
        advice = nearest(name, known)
        raise SchemeError(
            f"decision maker {name!r}",
            f"one of {', '.join(known)}",
            (f"{advice} " if advice else "")
            + "A maker of your own is handed over as decision_makers=[...]",
        )
    return known[name](bias)
