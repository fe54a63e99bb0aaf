"""The optimisers by keyword, as lessons name them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from socialmind.errors import ModelError
from socialmind.learning.optimisers.annealing import Annealing
from socialmind.learning.optimisers.cma import Cma
from socialmind.learning.optimisers.contract import Optimiser
from socialmind.learning.optimisers.genetic import Genetic

OPTIMISERS: Mapping[str, type[Optimiser]] = MappingProxyType(
    {one.keyword: one for one in (Genetic, Annealing, Cma)}
)
"""All that search genomes of a fixed length, by keyword."""


def optimiser_named(keyword: str) -> type[Optimiser]:
    """Return the optimiser of a keyword, in capitals or not.

    Args:
        keyword: `GENETIC`, `ANNEALING` or `CMAES`.

    Raises:
        ModelError: there is none of that name.

    >>> optimiser_named("genetic").keyword
    'GENETIC'
    """
    found = OPTIMISERS.get(keyword.upper())
    if found is None:
        raise ModelError(f"the optimiser {keyword!r}", f"one of {', '.join(OPTIMISERS)}")
    return found
