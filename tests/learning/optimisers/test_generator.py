"""A generator's state as an array."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.errors import ModelError
from socialmind.learning.optimisers.generator import generator_at, words_of


@given(st.integers(0, 2**64), st.integers(0, 9))
def test_it_goes_on_where_it_stood(seed, halves):
    generator = np.random.default_rng(seed)
    # Draws of 32 bits leave half a draw behind.
    generator.integers(0, 1000, halves, dtype=np.uint32)
    words = words_of(generator)
    again = generator_at(words)
    expected = generator.integers(0, 1000, 5, dtype=np.uint32).tolist()
    assert again.integers(0, 1000, 5, dtype=np.uint32).tolist() == expected
    assert again.normal() == generator.normal()


def test_words_that_were_rounded_are_refused():
    with pytest.raises(ModelError, match="uint64"):
        generator_at(np.zeros(6))
