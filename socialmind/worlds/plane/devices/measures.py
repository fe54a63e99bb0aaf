"""What is measured of an episode on a plane: how much was collected, how long it lasted.

A model declares its measures by name, and `socialmind score` gives their means over many worlds:

    measures = {"objects": total("delivered"), "survived": survived()}

A measure may be made of several numbers an episode, whose means over all episodes are combined at
the end, such as a ratio of totals; and it may be set against another mind in the same worlds.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from socialmind.errors import ModelError
from socialmind.names import several

EPISODE: Mapping[str, str] = {
    "ticks": "how many ticks the episode lasted",
    "limit": "how many it could have lasted",
    "over": "the name of the interruption that ended it, or None",
}
"""What a measure may take of an episode itself."""
RESERVED = ("episodes", "ticks")
"""Names that no measure has: a score tells these numbers anyway."""


Combine = Callable[..., float]
"""Makes one number of several; NaN or ZeroDivisionError where there is none."""


def quotient(one: float, other: float) -> float:
    """Return a number over another.

    >>> quotient(3.0, 4.0)
    0.75
    """
    return one / other


@dataclass(frozen=True)
class Measure:
    """A number that episodes come to.

    Attributes:
        function: a function that returns what one episode comes to: a number, or several where
            `combine` makes the measure of them.
        takes: what the function takes, in order: names of `EPISODE`; fields of the robots, as
            arrays with a number for each robot, `"population.field"` for robots other than the
            first with minds; and variables of the model. By default the names of its parameters.
        combine: a function that makes the measure of the means, over the episodes, of the numbers
            that the function returns; None for a function that returns one.
        mind: the mind that it is set against, as `socialmind.experiments.score` takes minds, but
            for a path, which is relative to the model's folder; None for none.
        compare: a function that makes the measure of what the mind comes to and of what that other
            one comes to in the same worlds.

    Raises:
        ModelError: no function.

    >>> def share(ticks, limit):
    ...     return ticks / limit
    >>> Measure(share).takes
    ('ticks', 'limit')
    """

    function: Callable[..., Any]
    takes: tuple[str, ...] = ()
    combine: Combine | None = None
    mind: Any = None
    compare: Combine = quotient

    def __post_init__(self) -> None:
        given = {"function": self.function, "compare": self.compare}
        if self.combine is not None:
            given["combine"] = self.combine
        for what, one in given.items():
            if not callable(one):
                raise ModelError(f"{one!r} as the {what} of a measure", "a function")
        if self.takes:
            object.__setattr__(self, "takes", several(self.takes, "takes"))
        else:
            object.__setattr__(self, "takes", tuple(inspect.signature(self.function).parameters))

    @property
    def records(self) -> tuple[str, ...]:
        """The fields and variables among what it takes."""
        return tuple(name for name in self.takes if name not in EPISODE)

    def parts(self, values: Mapping[str, Any]) -> tuple[float, ...]:
        """Return the numbers that an episode comes to.

        Args:
            values: by name, all that it takes.

        >>> ratio("correct", "ended").parts({"correct": np.array([2]), "ended": np.array([5])})
        (2.0, 5.0)
        """
        found = self.function(*(values[name] for name in self.takes))
        if self.combine is None:
            return (float(found),)
        return tuple(float(one) for one in found)

    def combined(self, means: tuple[float, ...], others: tuple[float, ...] = ()) -> float:
        """Return the measure of the means of its parts.

        Args:
            means: of the parts.
            others: of the parts of the mind that it is set against, where there is one.

        Returns:
            The measure; NaN where there is none, such as a ratio to nothing.

        >>> ratio("correct", "ended").combined((2.0, 5.0)), total("delivered").combined((7.5,))
        (0.4, 7.5)
        """
        try:
            found = self._whole(means)
            return found if self.mind is None else float(self.compare(found, self._whole(others)))
        except ZeroDivisionError:
            return math.nan

    def _whole(self, means: tuple[float, ...]) -> float:
        return means[0] if self.combine is None else float(self.combine(*means))

    def of(self, values: Mapping[str, Any]) -> float:
        """Return the measure of one episode, for one that is not set against another mind.

        Args:
            values: by name, all that it takes.

        >>> total("delivered").of({"delivered": np.array([2, 3])})
        5.0
        """
        return self.combined(self.parts(values))


def total(field: str) -> Measure:
    """A field of the robots at the end, added up over them.

    Args:
        field: its name, or `"population.field"`.
    """
    return Measure(np.sum, (field,))


def survived() -> Measure:
    """How long the episode lasted, as a share of how long it could have."""
    return Measure(_share, ("ticks", "limit"))


def _share(ticks: int, limit: int) -> float:
    return ticks / limit


def ratio(part: str, whole: str) -> Measure:
    """A field of the robots over another, both added up over robots and episodes.

    Episodes count by their whole, so one in which that is 0 does not count at all.

    Args:
        part: the name of a field at the end, or `"population.field"`.
        whole: another one.
    """
    return Measure(_totals, (part, whole), combine=quotient)


def _totals(part: Any, whole: Any) -> tuple[float, float]:
    return np.sum(part), np.sum(whole)


def against(measure: Measure, mind: Any, compare: Combine = quotient) -> Measure:
    """A measure set against that of another mind in the same worlds: its quotient by default.

    Args:
        measure: of episodes alone.
        mind: the other mind: its folder or YAML file, where these are relative to the model's
            folder, or a `MindDescription`; for several populations a mapping.
        compare: a function of both measures, the own one first.

    Raises:
        ModelError: a measure that is set against a mind already, or no mind.

    >>> against(total("delivered"), mind="plain").combined((6.0,), (8.0,))
    0.75
    """
    if measure.mind is not None:
        raise ModelError("a measure against a mind, set against another", "one of episodes alone")
    if mind is None:
        raise ModelError("a measure against no mind", "a mind's folder, or a MindDescription")
    return replace(measure, mind=mind, compare=compare)
