"""What interpreted rules call of the neighbours that were found."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from socialmind.worlds.neighbours.asked import QUESTIONS


def still_living(found: list[Any]) -> Iterator[Any]:
    """Yield the agents that were found, but for those dead meanwhile."""
    for agent in found:
        if agent._table.alive[agent._slot]:
            yield agent


def one_found(found: list[Any], rng: Any) -> Any:
    """Return one of the agents that were found, drawn at random, or None."""
    return found[int(rng.integers(0, len(found)))] if found else None


def how_many(found: Iterable[Any]) -> int:
    """Return how many agents or patches were found."""
    return len(list(found))


def one_patch(found: Iterable[Any], rng: Any) -> Any:
    """Return one of the patches that were found, drawn at random."""
    found = list(found)
    if not found:
        raise ValueError(NO_PATCH)
    return found[int(rng.integers(0, len(found)))]


NO_PATCH = "one_of() where there is no patch"


FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{f"_agents_{name}": function for name, function in QUESTIONS.items()},
    "_still_living": still_living,
    "_how_many": how_many,
    "_one_found": one_found,
    "_one_patch": one_patch,
}
