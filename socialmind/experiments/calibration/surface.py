"""A smooth surface through the distances of trials: luck averaged out, gaps between trials closed.

Near the best place squared distances are a quadratic form, the sum of squares of what differs
(Box and Wilson's response surface). It is fitted by least squares to all trials, a trial of squared
distance D² with the weight 1 / (D² + L²)², L being how far luck goes: what is far counts little.
Where trials are few, it is without products of two parameters. Curvature below 0, which luck
feigns, counts as none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEWEST = 1.5
"""Trials for each coefficient, at least."""
TINY = 1e-3
"""What counts for luck where there is none, as in a model without draws."""
GRID = 101
"""Values of a parameter at which its profile is looked at."""


@dataclass(frozen=True)
class Surface:
    """Squared distances over the unit cube, c + b · x + x · A x.

    Attributes:
        constant: c.
        slope: b, (dimensions,).
        curvature: A, (dimensions, dimensions), symmetric, no eigenvalue below 0.
    """

    constant: float
    slope: Array
    curvature: Array

    @classmethod
    def through(cls, places: Array, distances: Array, luck: float) -> Surface | None:
        """Return the surface through some trials; None where they are too few.

        Args:
            places: (trials, dimensions).
            distances: (trials,); infinite ones are left out.
            luck: how far from the data luck lets a trial be.

        >>> x = np.linspace(0, 1, 12)[:, None]
        >>> Surface.through(x, np.abs(x[:, 0] - 0.25), 0.1).curvature.round(6).tolist()
        [[1.0]]
        """
        near = np.isfinite(distances)
        places, squares = places[near], distances[near] ** 2
        size = places.shape[1]
        pairs = [(i, j) for i in range(size) for j in range(i, size)]
        if len(places) < FEWEST * (1 + size + len(pairs)):
            pairs = [(i, i) for i in range(size)]
        if len(places) < FEWEST * (1 + size + len(pairs)):
            return None
        middle = places[squares.argmin()]
        width = np.maximum(places.std(axis=0), 1e-9)
        x = (places - middle) / width
        columns = [np.ones(len(x)), *x.T, *(x[:, i] * x[:, j] for i, j in pairs)]
        weight = 1 / (squares + max(luck, TINY) ** 2)
        rows = np.column_stack(columns) * weight[:, None]
        found = np.linalg.lstsq(rows, squares * weight, rcond=1e-10)[0]
        form = np.zeros((size, size))
        for (i, j), value in zip(pairs, found[1 + size :].tolist(), strict=True):
            form[i, j] += value / 2
            form[j, i] += value / 2
        values, vectors = np.linalg.eigh(form)
        form = (vectors * np.maximum(values, 0.0)) @ vectors.T / np.outer(width, width)
        slope = found[1 : 1 + size] / width
        # From around the best trial to around 0.
        constant = float(found[0] - slope @ middle + middle @ form @ middle)
        return cls(constant, slope - 2 * form @ middle, form)

    def at(self, places: Array) -> Array:
        """Return squared distances at places, (…, dimensions)."""
        forms = np.einsum("...i,ij,...j->...", places, self.curvature, places)
        return np.asarray(self.constant + places @ self.slope + forms)

    def profile(self, dimension: int) -> tuple[Array, Array]:
        """Return values of a dimension, and the least squared distance at each of them.

        The others take the values, within the cube, at which it is least.
        """
        # A valley between parameters that make up for one another is long: only a step along it,
        # which knows the curvature, reaches its floor.
        from scipy.optimize import minimize

        grid = np.linspace(0.0, 1.0, GRID)
        x = np.full((GRID, len(self.slope)), 0.5)
        x[:, dimension] = grid
        others = [one for one in range(len(self.slope)) if one != dimension]
        if not others:
            return grid, self.at(x)
        form, across = self.curvature[np.ix_(others, others)], self.curvature[others, dimension]
        start = x[0, others]
        for row in x:
            slope = self.slope[others] + 2 * across * row[dimension]
            row[others] = start = minimize(
                lambda y, slope=slope: (y @ form @ y + slope @ y, 2 * form @ y + slope),
                start,
                jac=True,
                method="L-BFGS-B",
                bounds=[(0.0, 1.0)] * len(others),
                options={"ftol": 1e-15, "gtol": 1e-9},
            ).x
        return grid, self.at(x)

    def within(self, dimension: int, limit: float) -> tuple[float, float] | None:
        """Return the ends of the values at which the surface is no higher than a limit.

        Args:
            dimension: which.
            limit: a squared distance.
        """
        grid, squares = self.profile(dimension)
        below = np.flatnonzero(squares <= limit)
        if not len(below):
            return None
        ends = []
        for inside, outside in ((below[0], below[0] - 1), (below[-1], below[-1] + 1)):
            end = float(grid[inside])
            if 0 <= outside < GRID:
                part = (limit - squares[inside]) / (squares[outside] - squares[inside])
                end += float(part * (grid[outside] - grid[inside]))
            ends.append(end)
        return ends[0], ends[1]
