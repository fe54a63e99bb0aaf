"""Designs of experiments: tables whose rows are the points at which a model is run.

A design is a data frame with a column for each thing that varies; any table will do for a sweep.
Those made here say in `frame.attrs["design"]` how they were made, and a sweep's manifest keeps it.

| design | what it is for | points for size n and k columns |
|---|---|---|
| `grid` | every combination | product of the values |
| `lhs`, `sobol`, `halton` | to fill a space evenly | n |
| `saltelli` | Sobol indices of sensitivity | n (2 k + 2) |
| `morris` | elementary effects | n (k + 1) |
| `fast` | Fourier amplitudes | n k |
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, whole_number
from socialmind.errors import SocialmindError, nearest

if TYPE_CHECKING:
    import pandas as pd

Ranges = Mapping[str, tuple[float, float]]

LEVELS = 4
"""Levels of each column in a design of Morris."""
HARMONICS = 4
"""The interference factor M of FAST: a column needs more than 4 M² points."""


class MissingLibraryError(SocialmindError, ImportError):
    """A library that a design needs is not installed."""


def grid(values: Mapping[str, Sequence[Any]]) -> pd.DataFrame:
    """Return every combination of some values; the last column changes fastest.

    Args:
        values: of each column, each once.

    >>> grid({"price": [1.0, 2.0], "n": [5, 6]}).values.tolist()
    [[1.0, 5.0], [1.0, 6.0], [2.0, 5.0], [2.0, 6.0]]
    """
    import pandas as pd

    columns = {name: list(several) for name, several in values.items()}
    for name, several in columns.items():
        if not several:
            raise SocialmindError(f"no values of {name}; give one at least")
    counts = [len(several) for several in columns.values()]
    places = np.indices(counts).reshape(len(counts), -1)
    frame = pd.DataFrame(
        {
            name: pd.Series([several[place] for place in where])
            for (name, several), where in zip(columns.items(), places.tolist(), strict=True)
        }
    )
    frame.attrs["design"] = {"name": "grid"}
    return frame


def lhs(ranges: Ranges, points: int, seed: int = 0, whole: Collection[str] = ()) -> pd.DataFrame:
    """Return a Latin hypercube: of each column, one point in each of n equal slices.

    Args:
        ranges: lowest and highest value of each column.
        points: how many, 1 or more.
        seed: of the design, 0 or more.
        whole: columns of whole numbers.

    >>> sorted(lhs({"x": (0.0, 4.0)}, 4)["x"].astype(int))
    [0, 1, 2, 3]
    """
    _check("lhs", ranges, points, seed, whole)
    unit = _qmc("LatinHypercube", len(ranges), seed).random(points)
    return _made("lhs", unit, ranges, points, seed, whole)


def sobol(ranges: Ranges, points: int, seed: int = 0, whole: Collection[str] = ()) -> pd.DataFrame:
    """Return a scrambled Sobol sequence, which fills a space evenly; arguments as of `lhs`.

    Args:
        ranges: lowest and highest value of each column.
        points: a power of 2.
        seed: of the scrambling.
        whole: columns of whole numbers.
    """
    _check("sobol", ranges, points, seed, whole, even=True)
    unit = _qmc("Sobol", len(ranges), seed).random(points)
    return _made("sobol", unit, ranges, points, seed, whole)


def halton(ranges: Ranges, points: int, seed: int = 0, whole: Collection[str] = ()) -> pd.DataFrame:
    """Return a scrambled Halton sequence, of any length; arguments as of `lhs`."""
    _check("halton", ranges, points, seed, whole)
    unit = _qmc("Halton", len(ranges), seed).random(points)
    return _made("halton", unit, ranges, points, seed, whole)


def saltelli(ranges: Ranges, base: int, seed: int = 0, whole: Collection[str] = ()) -> pd.DataFrame:
    """Return Saltelli's design for Sobol indices: first, total and second order.

    Args:
        ranges: lowest and highest value of each column.
        base: size of the two base samples, a power of 2; n (2 k + 2) points come of it.
        seed: of the scrambling.
        whole: columns of whole numbers.
    """
    _check("saltelli", ranges, base, seed, whole, even=True)
    unit = _salib("sobol").sample(_problem(ranges), base, calc_second_order=True, seed=seed)
    return _made("saltelli", unit, ranges, base, seed, whole, second_order=True)


def morris(
    ranges: Ranges, trajectories: int, seed: int = 0, whole: Collection[str] = ()
) -> pd.DataFrame:
    """Return a design of elementary effects (Morris, 1991), of four levels.

    Args:
        ranges: lowest and highest value of each column.
        trajectories: how many; n (k + 1) points come of it.
        seed: of the design.
        whole: columns of whole numbers.
    """
    _check("morris", ranges, trajectories, seed, whole)
    sample = _salib("morris").sample
    unit = reseeding(sample, _problem(ranges), trajectories, num_levels=LEVELS, seed=seed)
    return _made("morris", unit, ranges, trajectories, seed, whole, levels=LEVELS)


def fast(ranges: Ranges, points: int, seed: int = 0, whole: Collection[str] = ()) -> pd.DataFrame:
    """Return a design of the extended Fourier amplitude test (Saltelli et al., 1999).

    Args:
        ranges: lowest and highest value of each column.
        points: of each column, more than 64; n k come of it.
        seed: of the design.
        whole: columns of whole numbers.
    """
    _check("fast", ranges, points, seed, whole, least=4 * HARMONICS**2 + 1)
    sample = _salib("fast_sampler").sample
    unit = reseeding(sample, _problem(ranges), points, M=HARMONICS, seed=seed)
    return _made("fast", unit, ranges, points, seed, whole, harmonics=HARMONICS)


@dataclass(frozen=True)
class Sampler:
    """A design by name.

    Attributes:
        make: makes it, of ranges, a size, a seed and the columns of whole numbers.
        points: how many points it has, of a size and a number of columns.
    """

    make: Callable[..., Any]
    points: Callable[[int, int], int]


SAMPLERS = {
    "lhs": Sampler(lhs, lambda n, k: n),
    "sobol": Sampler(sobol, lambda n, k: n),
    "halton": Sampler(halton, lambda n, k: n),
    "saltelli": Sampler(saltelli, lambda n, k: n * (2 * k + 2)),
    "morris": Sampler(morris, lambda n, k: n * (k + 1)),
    "fast": Sampler(fast, lambda n, k: n * k),
}
"""What `--sample NAME:SIZE` can name."""


def sampler_called(name: str) -> Sampler:
    """Return a sampler by its name.

    Raises:
        SocialmindError: there is none of that name.
    """
    if name not in SAMPLERS:
        raise SocialmindError(f"no design called {name!r}; {nearest(name, SAMPLERS)}")
    return SAMPLERS[name]


def _check(
    name: str,
    ranges: Ranges,
    size: Any,
    seed: Any,
    whole: Collection[str],
    least: int = 1,
    even: bool = False,
) -> None:
    """Refuse what no design is made of: sizes below `least`, or no power of 2 where it is even."""
    if not ranges:
        raise SocialmindError(f"{name}: nothing varies; give the ranges of something")
    count = whole_number(size, name, least, None, SocialmindError)
    if even and count & (count - 1):
        near = 1 << (count.bit_length() - 1)
        raise SocialmindError(
            f"{name}: found {count}; expected a power of 2, as {near} or {2 * near}, else the "
            "sequence is not even"
        )
    whole_number(seed, f"seed of {name}", 0, None, SocialmindError)
    for column, bounds in ranges.items():
        _check_bounds(column, bounds, column in whole)


def _check_bounds(column: str, bounds: Any, whole: bool) -> None:
    try:
        low, high = bounds
    except (TypeError, ValueError):
        low = high = None
    if not is_number(low) or not is_number(high) or not low < high:
        raise SocialmindError(
            f"range of {column}: found {shown(bounds)}; expected two numbers, the lower first"
        )
    if whole and (int(low) != low or int(high) != high):
        raise SocialmindError(
            f"range of {column}: found {shown(bounds)}; expected whole numbers, as its values are"
        )


def _qmc(kind: str, columns: int, seed: int) -> Any:
    try:
        from scipy.stats import qmc
    except ImportError:
        raise MissingLibraryError(
            "a design that samples needs scipy: pip install 'socialmind[analysis]'"
        ) from None
    return getattr(qmc, kind)(columns, seed=np.random.default_rng(seed))


def _salib(module: str) -> Any:
    try:
        return import_module(f"SALib.sample.{module}")
    except ImportError:
        raise MissingLibraryError(
            "a design for sensitivity needs SALib: pip install 'socialmind[sensitivity]'"
        ) from None


def _problem(ranges: Ranges) -> dict[str, Any]:
    names = list(ranges)
    return {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}


def reseeding(sample: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """Call a sampler that may seed NumPy's or Python's own generator, which others use."""
    import random

    before, others = random.getstate(), np.random.get_state()  # noqa: NPY002
    try:
        return sample(*arguments, **named)
    finally:
        random.setstate(before)
        np.random.set_state(others)  # noqa: NPY002


def _made(
    name: str,
    unit: NDArray[np.float64],
    ranges: Ranges,
    size: int,
    seed: int,
    whole: Collection[str],
    **further: Any,
) -> pd.DataFrame:
    """Return points of the unit cube as a design."""
    import pandas as pd

    columns: dict[str, NDArray[Any]] = {}
    for number, (column, (low, high)) in enumerate(ranges.items()):
        u = unit[:, number]
        if column in whole:
            found = np.floor(low + u * (high - low + 1)).astype(np.int64)
            columns[column] = np.clip(found, int(low), int(high))
        else:
            columns[column] = np.clip(low + u * (high - low), low, high)
    frame = pd.DataFrame(columns)
    bounded = {column: list(map(float, one)) for column, one in ranges.items()}
    said = {"name": name, "size": size, "seed": seed, "ranges": bounded, "whole": list(whole)}
    frame.attrs["design"] = said | further
    return frame
