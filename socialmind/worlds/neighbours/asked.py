"""What a population is asked of its neighbours, by interpreted rules and by users between ticks.

Each takes the population's table first. What is found comes in order of birth; the agent that is
asked about is not among it. Distances are compared as squares, dx² + dy² ≤ radius², each rounded as
64-bit numbers are.
"""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_truth
from socialmind.errors import SocialmindError, ValueRefusedError
from socialmind.worlds.contract import Extent
from socialmind.worlds.neighbours import search


def near(table: Any, who: Any, radius: float) -> list[Any]:
    """Return the agents at most a radius away, the short way round where the world wraps.

    Args:
        table: the population.
        who: an agent of any population, or a patch.
        radius: 0 or more, in units of the world.

    Raises:
        ValueRefusedError: a radius below 0, or `who` stands nowhere.
    """
    extent, slots, x, y = _asked(table, who)
    return _rows(table, search.near(extent, slots, table.columns, x, y, _checked(radius)))


def on(table: Any, who: Any) -> list[Any]:
    """Return the agents on the patch of an agent, or on a patch.

    Args:
        table: the population.
        who: an agent of any population, or a patch.
    """
    return _on_patches(table, who, 0, 0)


def neighbours(table: Any, who: Any, steps: int = 1) -> list[Any]:
    """Return the agents on the patches around that of an agent, or around a patch.

    Args:
        table: the population.
        who: an agent of any population, or a patch.
        steps: at most so many king's moves away, 0 or more; its own patch is not among them.
    """
    return _on_patches(table, who, _checked(steps), 8)


def neighbours4(table: Any, who: Any) -> list[Any]:
    """Return the agents on the 4 patches that share a side with that of an agent, or with a patch.

    Args:
        table: the population.
        who: an agent of any population, or a patch.
    """
    return _on_patches(table, who, 1, 4)


def nearest(table: Any, who: Any, radius: float = math.inf) -> Any:
    """Return the nearest agent, of several the first born; None where there is none.

    Args:
        table: the population.
        who: an agent of any population, or a patch.
        radius: at most so far, 0 or more.
    """
    extent, slots, x, y = _asked(table, who)
    found = search.nearest(extent, slots, table.columns, x, y, _checked(radius))
    return None if found is None else table.row_class(table, found)


QUESTIONS = {
    function.__name__: function for function in (near, on, neighbours, neighbours4, nearest)
}


def _on_patches(table: Any, who: Any, steps: int, kind: int) -> list[Any]:
    extent, slots, x, y = _asked(table, who)
    if not extent.whole:
        raise SocialmindError(f"the world of {table.model.name} has no patches; ask near(…)")
    return _rows(table, search.on_patches(extent, slots, table.columns, x, y, steps, kind))


def _asked(table: Any, who: Any) -> tuple[Extent, NDArray[np.int64], float, float]:
    """Return the world, the slots of all that may be found, and where who asks stands."""
    extent = table.model.ground.extent
    if extent is None:
        raise SocialmindError(
            f"the world of {table.model.name} has no places; declare one: world = Torus(33)"
        )
    if not (hasattr(who, "x") and hasattr(who, "y")):
        raise ValueRefusedError(
            f"neighbours in {table.shape.name!r}: found {shown(who)}; expected an agent or a patch"
        )
    slots = table.slots
    if getattr(who, "_table", None) is table:
        slots = slots[slots != who._slot]
    return extent, slots, who.x, who.y


def _checked(radius: Any) -> Any:
    """Return a radius, or a number of steps, or refuse it."""
    real = isinstance(radius, Real) and not is_truth(radius)
    if not real or not float(radius) >= 0:
        raise ValueRefusedError(
            f"a radius, or a number of steps, below 0: found {shown(radius)}; expected 0 or more"
        )
    return radius


def _rows(table: Any, slots: NDArray[np.int64]) -> list[Any]:
    return [table.row_class(table, slot) for slot in slots.tolist()]
