"""One society of the study: run, and its piles measured."""

from __future__ import annotations

from typing import Any

import numpy as np

from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

SETTINGS: dict[str, dict[str, Any]] = {
    "one kind": {},
    "two kinds": {"n_kinds": 2},
    "four kinds": {"n_kinds": 4},
    "nobody goes away": {"away": 0},
    "10 termites": {"n_termites": 10},
    "200 termites": {"n_termites": 200},
}
"""50 termites and one kind of chips where nothing else is said."""
MOMENTS = (0, 500, 1_000, 2_000, 5_000, 10_000, 20_000)


def gathered(setting: str, seed: int) -> list[dict[str, Any]]:
    """Let termites work, and measure the piles at each of `MOMENTS`.

    Args:
        setting: one of `SETTINGS`.
        seed: of every draw.

    Returns:
        A row for each moment: the columns of the model's series; as `heaps` and `largest_heap`
        the piles there are when all kinds count as one; and as `scattered_…` the piles of the chips
        that lie on the ground when they are scattered anew.
    """
    society = load_model("termites")(seed, **SETTINGS[setting])
    rows = []
    for tick in MOMENTS:
        society.advance(tick - society.tick)
        chips = society.world.chip
        row = {"setting": setting, "seed": seed, "tick": tick, **society.series()}
        heaps = sizes_of((chips > 0).astype(int))
        row |= {"heaps": len(heaps), "largest_heap": int(heaps.max(initial=0))}
        rows.append(row | scattered(chips, seed))
    return rows


def sizes_of(chips: Any) -> Any:
    """Return the sizes of piles as the model counts them."""
    return load_file(model_folder("termites") / "model.py").pile_sizes(chips)


def scattered(chips: Any, seed: int) -> dict[str, float]:
    """Return how many piles there are, and the largest, when the same chips are scattered anew.

    Args:
        chips: the kind on each patch, (width, height), 0 for none.
        seed: of the scattering.
    """
    rng = np.random.default_rng(seed)
    anew = rng.permutation(chips.ravel()).reshape(chips.shape)
    sizes = sizes_of(anew)
    return {"scattered_piles": len(sizes), "scattered_largest": int(sizes.max(initial=0))}
