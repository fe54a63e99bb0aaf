"""Calibration that proves itself: six link weights fitted, and four methods at equal budget."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study


def weights(out: Path, quick: bool = False) -> list[Path]:
    """Fit six weights, with recovery, and write what comes of it.

    Args:
        out: the folder; the fit's own is `calibration-fits/weights` in it, and is gone on with.
        quick: a small one, which shows that all works.
    """
    from .page import write_weights
    from .weights import six_weights

    return write_weights(six_weights(out / "calibration-fits", quick), out)


def methods(out: Path, quick: bool = False) -> list[Path]:
    """Fit two weights by four methods at equal budget; arguments as above."""
    from .page import write_methods
    from .weights import METHODS, two_weights

    fits = {name: two_weights(name, out / "calibration-fits", quick) for name in METHODS}
    return write_methods(fits, out)


studies = (
    Study(
        "calibration-weights", "six link weights fitted to a run with known ones, and recovery",
        weights, partial(weights, quick=True),
    ),
    Study(
        "calibration-methods", "two link weights by four methods at equal budget",
        methods, partial(methods, quick=True),
    ),
)  # fmt: skip
