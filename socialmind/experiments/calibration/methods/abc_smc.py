"""Approximate Bayesian computation by adaptive population Monte Carlo (Lenormand et al., 2013).

The prior is even over the ranges. Of all trials so far the nearest half is kept; each generation
draws among them by weight, moves what it drew a little, and weighs it by prior over how likely it
was to be drawn. The tolerance is the distance of the farthest that is kept, so no trial is wasted.

Lenormand, Jabot and Deffuant (2013), Computational Statistics 28: 2777–2796. Moves are normal ones
with twice the weighted variance in each dimension (Beaumont et al., 2009), cut at the ranges.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.calibration.methods.contract import (
    Distances,
    Method,
    MissingMethodError,
    Points,
)

GENERATIONS = 4
"""After the first, which is twice as large as each of these."""
NARROWEST = 1e-6
"""Smallest standard deviation of a move."""


class Abc(Method):
    """Gives a sample of a posterior, with weights."""

    def __init__(self, size: int, trials: int, seed: int) -> None:
        super().__init__(size, trials, seed)
        try:
            from scipy.special import ndtr, ndtri
        except ImportError:
            raise MissingMethodError("scipy") from None
        self._ndtr, self._ndtri = ndtr, ndtri
        self._rng = np.random.default_rng(seed)
        self._kept_count = max(2, trials // (GENERATIONS + 2))
        self._points = np.zeros((0, size))
        self._weights = np.zeros(0)
        self._distances = np.zeros(0)
        self._asked_weights = np.zeros(0)

    def ask(self) -> Points:
        """Return the trials of the next generation."""
        if not len(self._points):
            self._asked_weights = np.ones(2 * self._kept_count)
            return self._rng.uniform(size=(2 * self._kept_count, self.size))
        shares = self._weights / self._weights.sum()
        mean = shares @ self._points
        width = np.maximum(np.sqrt(2 * shares @ (self._points - mean) ** 2), NARROWEST)
        centres = self._points[self._rng.choice(len(shares), self._kept_count, p=shares)]
        low, high = self._ndtr((0 - centres) / width), self._ndtr((1 - centres) / width)
        drawn = self._ndtri(low + self._rng.uniform(size=centres.shape) * (high - low))
        found = np.clip(centres + drawn * width, 0.0, 1.0)
        self._asked_weights = 1 / self._likely(found, shares, width)
        return found

    def tell(self, points: Points, distances: Distances) -> None:
        """Keep the nearest."""
        distances = np.concatenate([self._distances, distances])
        order = np.argsort(distances, kind="stable")[: self._kept_count]
        self._distances = distances[order]
        self._points = np.concatenate([self._points, points])[order]
        self._weights = np.concatenate([self._weights, self._asked_weights])[order]

    def sample(self) -> tuple[Points, NDArray[np.float64]] | None:
        """Return what is kept; failed trials are not."""
        near = np.isfinite(self._distances)
        if not near.any():
            return None
        return self._points[near], self._weights[near] / self._weights[near].sum()

    def _likely(
        self, found: Points, shares: NDArray[np.float64], width: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return how densely a generation draws at some places."""
        inside = self._ndtr((1 - self._points) / width) - self._ndtr((0 - self._points) / width)
        away = (found[:, None, :] - self._points[None]) / width
        density = np.exp(-0.5 * away**2) / (math.sqrt(2 * math.pi) * width * inside)
        return np.asarray(density.prod(axis=2) @ shares)
