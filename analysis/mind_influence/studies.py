"""Figure 6.6 of the thesis: influence while a robot goes round an obstacle."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, write_figure


def five_steps(out: Path) -> list[Path]:
    """Draw five steps of the trained robot on constant base skills, in its world."""
    from .trained import write_steps

    return write_steps(out)


def in_numbers(out: Path) -> list[Path]:
    """Draw the thesis's five steps by programs that give the numbers of its text."""
    from .figures import draw_steps
    from .robot import STEPS, evaluated, row_of

    hierarchies = [evaluated(step) for step in STEPS]
    rows = [row_of(number, one) for number, one in enumerate(hierarchies, 1)]
    return write_figure("figure-6.6-numbers", draw_steps(hierarchies, STEPS), rows, out)


studies = (
    Study("figure-6.6", "a trained robot avoids an obstacle and reaches a goal", five_steps),
    Study("figure-6.6-numbers", "the same by programs, with the numbers of the text", in_numbers),
)
