"""What the tests of models share: the states of societies, side by side."""

import numpy as np
import pytest


def parts(state):
    """Yield the arrays of a state with their names, of records each field apart.

    Padding between the fields of a record, and columns of addresses, are nobody's.
    """
    kept = ("_tick", "_idle", "_idle_agent", "_idle_tick")
    for name, array in state.items():
        if array.dtype.names is None:
            yield name, array
            continue
        for field in array.dtype.names:
            ours = name != "context" or not field.startswith("_") or field.startswith("_has_")
            if ours or field in kept:
                yield f"{name}.{field}", array[field]


def different(one, other):
    """Return the names of what differs between the states of two models, to the last bit."""
    mine, theirs = dict(parts(one.state())), dict(parts(other.state()))
    assert mine.keys() == theirs.keys()
    return [
        name
        for name in mine
        if not np.array_equal(mine[name], theirs[name], equal_nan=mine[name].dtype.kind == "f")
    ]


@pytest.fixture(scope="session")
def differences():
    """What compares the states of two models."""
    return different
