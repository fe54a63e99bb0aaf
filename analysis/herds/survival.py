"""How long herds live, by age: the estimate of Kaplan and Meier, and how sure it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

DRAWS = 1_000
"""Of seeds, with replacement, for a band."""


@dataclass(frozen=True)
class Curve:
    """The share of herds that outlive each age.

    Attributes:
        ages: at which a herd ended or was seen last, from 0 on.
        shares: that outlive them.
        low, high: the band of 95 % over seeds.
        seen_last: ages of herds that still lived when their run ended.
    """

    ages: NDArray[np.float64]
    shares: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    seen_last: NDArray[np.float64]

    def share(self, ages: ArrayLike) -> NDArray[np.float64]:
        """Return the shares that outlive some ages."""
        return self.shares[np.searchsorted(self.ages, ages, side="right") - 1]


def surviving(lives: ArrayLike, ended: ArrayLike) -> tuple[list[float], list[float]]:
    """Return the share of herds that live longer, by age (Kaplan and Meier, 1958).

    Args:
        lives: ticks of each herd.
        ended: whether it ended then, or was still there when the run ended.

    Returns:
        Ages at which herds ended, from 0 on, and the shares that outlive them.
    """
    lives, ended = np.asarray(lives), np.asarray(ended, bool)
    ages, shares = [0.0], [1.0]
    for age in np.unique(lives[ended]):
        share = 1 - (lives[ended] == age).sum() / (lives >= age).sum()
        ages.append(float(age))
        shares.append(shares[-1] * float(share))
    return ages, shares


def curve_of(herds: pd.DataFrame) -> Curve:
    """Return how long herds live, with a band: whole seeds are drawn anew, as herds of one meet.

    Args:
        herds: a row for each, of one setting.
    """
    ended = herds["ended"].to_numpy(bool)
    lives = herds["life"].to_numpy(float)
    ages = np.unique([0.0, *lives])
    seeds = [
        (own["life"].to_numpy(float), own["ended"].to_numpy(bool))
        for _, own in herds.groupby("seed")
    ]
    rng = np.random.default_rng(0)
    drawn = np.empty((DRAWS, len(ages)))
    for row in drawn:
        chosen = [seeds[one] for one in rng.integers(len(seeds), size=len(seeds))]
        row[:] = _shares(*map(np.concatenate, zip(*chosen, strict=True)), ages)
    low, high = np.quantile(drawn, (0.025, 0.975), axis=0)
    return Curve(ages, _shares(lives, ended, ages), low, high, np.sort(lives[~ended]))


def _shares(
    lives: NDArray[np.float64], ended: NDArray[np.bool_], ages: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the shares that outlive ages, which hold all lives."""
    known, shares = surviving(lives, ended)
    return np.asarray(shares)[np.searchsorted(known, ages, side="right") - 1]
