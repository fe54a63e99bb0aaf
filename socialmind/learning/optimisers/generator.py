"""The state of a random number generator as an array."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError

WORD = 1 << 64
"""The generator's two numbers have 128 bits each: two words."""


def words_of(generator: np.random.Generator) -> NDArray[np.uint64]:
    """Return the state of a PCG64 generator.

    Args:
        generator: one that `numpy.random.default_rng` made.

    Returns:
        Shape (6,): high and low word of the state and of the increment, whether half a draw is
        kept, and that half.

    >>> generator = np.random.default_rng(5)
    >>> words = words_of(generator)
    >>> generator.random() == generator_at(words).random()
    True
    """
    state: Any = generator.bit_generator.state
    inner = state["state"]
    words = [*divmod(inner["state"], WORD), *divmod(inner["inc"], WORD)]
    return np.array([*words, state["has_uint32"], state["uinteger"]], dtype=np.uint64)


def generator_at(words: NDArray[np.uint64]) -> np.random.Generator:
    """Return a generator in the state that `words_of` gave.

    Args:
        words: shape (6,), uint64.

    Raises:
        ModelError: they are no unsigned 64-bit numbers, which hold a state exactly.
    """
    if np.asarray(words).dtype != np.uint64:
        raise ModelError(
            f"a generator's state as {np.asarray(words).dtype}", "uint64", "save it as it is"
        )
    high, low, inc_high, inc_low, kept, half = (int(word) for word in words)
    bits = np.random.PCG64()
    bits.state = {
        "bit_generator": "PCG64",
        "state": {"state": high * WORD + low, "inc": inc_high * WORD + inc_low},
        "has_uint32": kept,
        "uinteger": half,
    }
    return np.random.Generator(bits)
