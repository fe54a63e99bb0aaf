"""Figure 6.6 of the thesis: influence while an agent goes round an obstacle."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, write_figure


def five_steps(out: Path) -> list[Path]:
    from .figures import draw_steps
    from .robot import STEPS, evaluated, row_of

    hierarchies = [evaluated(step) for step in STEPS]
    rows = [row_of(number, one) for number, one in enumerate(hierarchies, 1)]
    return write_figure("figure-6.6", draw_steps(hierarchies, STEPS), rows, out)


studies = (
    Study("figure-6.6", "five steps of avoiding an obstacle and reaching a goal", five_steps),
)
