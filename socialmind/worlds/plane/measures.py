"""What is measured of an episode on a plane: how much was collected, how long it lasted.

A model declares its measures by name, and `socialmind score` gives their means over many worlds:

    measures = {"objects": total("delivered"), "survived": survived()}
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from socialmind.errors import ModelError

EPISODE: Mapping[str, str] = {
    "ticks": "how many ticks the episode lasted",
    "limit": "how many it could have lasted",
    "over": "the name of the interruption that ended it, or None",
}
"""What a measure may take of an episode itself."""
RESERVED = ("episodes", "ticks")
"""Names that no measure has: a score tells these numbers anyway."""


@dataclass(frozen=True)
class Measure:
    """A number that an episode comes to.

    Attributes:
        function: a function that returns it.
        takes: what the function takes, in order: names of `EPISODE`; fields of the robots, as
            arrays with a number for each robot, `"population.field"` for robots other than the
            first with minds; and variables of the model. By default the names of its parameters.

    Raises:
        ModelError: no function.

    >>> def share(ticks, limit):
    ...     return ticks / limit
    >>> Measure(share).takes
    ('ticks', 'limit')
    """

    function: Callable[..., Any]
    takes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not callable(self.function):
            raise ModelError(f"{self.function!r} as the function of a measure", "a function")
        if not self.takes:
            object.__setattr__(self, "takes", tuple(inspect.signature(self.function).parameters))

    @property
    def records(self) -> tuple[str, ...]:
        """The fields and variables among what it takes."""
        return tuple(name for name in self.takes if name not in EPISODE)

    def of(self, values: Mapping[str, Any]) -> float:
        """Return the measure of an episode.

        Args:
            values: by name, all that it takes.

        >>> total("delivered").of({"delivered": np.array([2, 3])})
        5.0
        """
        return float(self.function(*(values[name] for name in self.takes)))


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
