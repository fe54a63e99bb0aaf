"""Designs: how many points, where they lie, the same from the same seed."""

import random

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import designs

RANGES = {"price": (10.0, 20.0), "n": (3, 6), "share": (-1.0, 1.0)}
SIZES = {"sobol": 16, "saltelli": 8, "fast": 65, "morris": 6}


@pytest.mark.parametrize("name", designs.SAMPLERS)
def test_samples_lie_within_and_come_again(name):
    sampler, size = designs.SAMPLERS[name], SIZES.get(name, 11)
    state = random.getstate(), np.random.get_state()[1].copy()  # noqa: NPY002
    found = sampler.make(RANGES, size, 3, ["n"])
    assert random.getstate() == state[0]
    assert (np.random.get_state()[1] == state[1]).all()  # noqa: NPY002
    assert list(found) == list(RANGES)
    assert len(found) == sampler.points(size, 3)
    assert found["n"].dtype == np.int64
    for column, (low, high) in RANGES.items():
        assert found[column].min() >= low and found[column].max() <= high
    assert set(found["n"]) == {3, 4, 5, 6}
    assert found.equals(sampler.make(RANGES, size, 3, ["n"]))
    assert not found.equals(sampler.make(RANGES, size, 4, ["n"]))
    said = found.attrs["design"]
    assert (said["name"], said["size"], said["seed"]) == (name, size, 3)


def test_a_latin_hypercube_has_a_point_in_every_slice():
    found = designs.lhs({"a": (0.0, 10.0), "b": (0.0, 1.0)}, 10)
    assert sorted(found["a"].astype(int)) == list(range(10))
    assert sorted((found["b"] * 10).astype(int)) == list(range(10))


def test_a_grid_holds_every_combination_of_any_values():
    found = designs.grid({"scheme": ["a.yaml", "b.yaml"], "on": [True, False], "n": [1, 2, 3]})
    assert len(found) == len(found.drop_duplicates()) == 12
    assert found["n"].tolist()[:4] == [1, 2, 3, 1]


def test_what_cannot_be_is_refused():
    with pytest.raises(SocialmindError, match="expected a power of 2, as 64 or 128"):
        designs.sobol(RANGES, 100)
    with pytest.raises(SocialmindError, match="fast: found 20; expected"):
        designs.fast(RANGES, 20)
    with pytest.raises(SocialmindError, match=r"range of x: found \(2, 1\)"):
        designs.lhs({"x": (2, 1)}, 3)
    for name, sampler in designs.SAMPLERS.items():
        size = SIZES.get(name, 11)
        with pytest.raises(SocialmindError, match=f"{name}: nothing varies"):
            sampler.make({}, size, 0, ())
        with pytest.raises(SocialmindError, match=f"seed of {name}: found -1"):
            sampler.make(RANGES, size, -1, ())
        with pytest.raises(SocialmindError, match="expected whole numbers, as its values are"):
            sampler.make({"n": (0.5, 3.5)}, size, 0, ["n"])
        with pytest.raises(SocialmindError, match="range of x: found"):
            sampler.make({"x": (0.0, float("inf"))}, size, 0, ["x"])
    with pytest.raises(SocialmindError, match="did you mean 'sobol'"):
        designs.sampler_called("sobl")
