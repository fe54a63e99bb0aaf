"""Uncounted arrays are the same arrays."""

import numpy as np
from numba import njit

from coglogo_py.compiled.borrow import borrowed


@njit
def write_through(array, pair):
    lent = borrowed(array)
    first, second = borrowed(pair)
    # A comprehension makes numba look for useless writes: it must not take these for such.
    doubled = [2.0 * position for position in range(3)]
    lent[0] = doubled[1]
    first[1] = doubled[2]
    second[0] += 7
    return lent[0] + first.shape[0]


def test_compiled_code_writes_to_the_arrays_it_was_lent():
    array, floats, whole = np.zeros(2), np.zeros(3), np.array([5])
    assert write_through(array, (floats, whole)) == 5.0
    assert array.tolist() == [2.0, 0.0]
    assert floats.tolist() == [0.0, 4.0, 0.0]
    assert whole.tolist() == [12]


def test_interpreted_code_gets_the_very_arrays():
    pair = (np.zeros(2), np.ones(1))
    assert borrowed(pair) is pair
