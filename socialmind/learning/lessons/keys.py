"""Seeds that hang on what they are for, and on nothing else: not on order, workers or platform."""

from __future__ import annotations

import hashlib

WORLD, OPTIMISER, FINAL, BEGINNING, VALIDATION, START, JUDGED = (
    "world",
    "optimiser",
    "final",
    "beginning",
    "validation",
    "start",
    "judged",
)
"""What learning draws seeds for; the last is for judging winners once more, when all is learned."""


def seed_for(*key: str | int) -> int:
    """Return the seed of a key, 0 … 2⁶³ − 1, the same on every machine and Python.

    Args:
        key: what it is for, in words and whole numbers.

    >>> seed_for("world", 1) == seed_for("world", 1), seed_for("world", 1) == seed_for("world", 2)
    (True, False)
    >>> seed_for("a", "b") == seed_for("ab")
    False
    """
    parts = [f"{type(part).__name__}:{len(str(part))}:{part}" for part in key]
    digest = hashlib.sha256("/".join(parts).encode()).digest()
    return int.from_bytes(digest[:8], "big") >> 1


def seeds_for(count: int, *key: str | int) -> list[int]:
    """Return seeds of a key, the first ones the same however many there are.

    >>> seeds_for(3, "world")[:2] == seeds_for(2, "world")
    True
    """
    return [seed_for(*key, number) for number in range(count)]
