"""The optimisers by keyword, as lessons name them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from socialmind.errors import ModelError
from socialmind.learning.optimisers.annealing import Annealing
from socialmind.learning.optimisers.cma import Cma
from socialmind.learning.optimisers.contract import Optimiser
from socialmind.learning.optimisers.genetic import Genetic
from socialmind.learning.optimisers.neat import Neat

OPTIMISERS: Mapping[str, type[Optimiser]] = MappingProxyType(
    {one.keyword: one for one in (Genetic, Neat, Annealing, Cma)}
)
"""All optimisers by keyword; `graphs` says whether their individuals are graphs."""


def optimiser_named(keyword: str) -> type[Optimiser]:
    """Return the optimiser of a keyword, in capitals or not.

    Args:
        keyword: `GENETIC`, `NEAT`, `ANNEALING` or `CMAES`.

    Raises:
        ModelError: there is none of that name.

    >>> optimiser_named("genetic").keyword
    'GENETIC'
    """
    found = OPTIMISERS.get(keyword.upper())
    if found is None:
        raise ModelError(f"the optimiser {keyword!r}", f"one of {', '.join(OPTIMISERS)}")
    return found
