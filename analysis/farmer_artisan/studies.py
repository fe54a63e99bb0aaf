"""Figures 3.1 and 3.8 to 3.14 of the thesis: influence on plans, and the society of section 3.3."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, write_figure


def influence(out: Path) -> list[Path]:
    """Figure 3.1: cognitons A and B and what they make of two plans."""
    from .example import draw, weights

    return write_figure("figure-3.1", draw(), weights(), out)


def society(out: Path) -> list[Path]:
    """Figures 3.8 to 3.13: one run of 500,000 ticks."""
    from .society import write_society

    return write_society(out)


def other_run(out: Path) -> list[Path]:
    """Figure 3.14: a run that has four artisans at tick 300,000."""
    from .society import write_other_run

    return write_other_run(out)


studies = (
    Study("figure-3.1", "an example of the influence mechanism", influence),
    Study("figure-3.8", "farmers and artisans over 500,000 ticks (3.8 to 3.13)", society),
    Study("figure-3.14", "another run, with four artisans at tick 300,000", other_run),
)
