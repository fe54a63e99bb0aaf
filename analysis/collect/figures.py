"""Figures 6.2 to 6.5: what the best individual of each generation came to, a line an attempt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.drawing import style as paper

from .tables import write_rows

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from socialmind.learning import Training

NEAR = 0.05
"""Of its best, within which an attempt counts as having reached it."""
EARLY = 100
"""The generation by which the thesis finds most attempts of base skills at their maximum."""
FELL_SHORT = 0.75
"""Of the median attempt's best, below which an attempt counts as one that failed."""
WORTH = {"best": "best score", "mean": "mean score", "validated": "score on common worlds"}
PANEL = (90.0, 52.0)
"""Width and height of a panel, in mm."""


@dataclass(frozen=True)
class Curves:
    """A figure: lessons' curves.

    Attributes:
        name: of the study.
        plans: the trainings; of an attempt that several have made, the longest curve is shown.
        panels: for each, the lesson and the column of its curve.
        thesis: what the thesis says of its own.
    """

    name: str
    plans: tuple[str, ...]
    panels: tuple[tuple[str, str], ...]
    thesis: str

    @property
    def lessons(self) -> tuple[str, ...]:
        """The lessons, each once."""
        return tuple(dict.fromkeys(lesson for lesson, _ in self.panels))


FIGURES = (
    Curves(
        "figure-6.2",
        ("base_skills",),
        (
            ("GoToObject", "best"), ("GoToDropZone", "best"),
            ("GoToObject", "validated"), ("GoToDropZone", "validated"),
        ),
        "most of 10 attempts reach their maximum within 100 of 1,000 generations; of either skill "
        "1 attempt in 10 does not reach a satisfactory result",
    ),
    Curves(
        "figure-6.3",
        ("hierarchy", "longer_avoid"),
        (("Avoid", "best"),),
        "most of 10 attempts continue to evolve past generation 500 of 2,500; 2,500 generations "
        "reach 10 % more than 1,000",
    ),
    Curves(
        "figure-6.4",
        ("hierarchy",),
        (("GoToObject+Avoid", "best"), ("GoToDropZone+Avoid", "best")),
        "10 of 10 attempts succeed within 1,500 generations; GoToObject+Avoid is slightly more "
        "difficult",
    ),
    Curves(
        "figure-6.5",
        ("hierarchy",),
        (("Collect", "best"), ("Collect", "mean")),
        "10 of 10 attempts succeed in under 10 generations",
    ),
)  # fmt: skip


def curves_of(figure: Curves, trainings: Mapping[str, Training]) -> pd.DataFrame:
    """Return the curves of a figure's lessons, with the training that each is from.

    Attempts of one number are the same individuals in the same worlds wherever a lesson is the
    same but for its length, so of those the longest one stands for all.
    """
    import pandas as pd

    longest: dict[tuple[str, int], pd.DataFrame] = {}
    for plan, training in trainings.items():
        lessons = training.lessons
        done = (
            set() if lessons.empty else set(zip(lessons["attempt"], lessons["lesson"], strict=True))
        )
        curve = training.curve
        for attempt, lesson in dict.fromkeys(zip(curve["attempt"], curve["lesson"], strict=True)):
            own = curve[(curve["attempt"] == attempt) & (curve["lesson"] == lesson)]
            finished = lesson in figure.lessons and (attempt, lesson) in done
            if finished and len(own) > len(longest.get((lesson, attempt), ())):
                longest[lesson, attempt] = own.assign(training=plan)
    order = sorted(longest, key=lambda key: (figure.lessons.index(key[0]), key[1]))
    return pd.concat([longest[key] for key in order], ignore_index=True)


def attempts_of(curves: pd.DataFrame, trainings: Mapping[str, Training]) -> list[dict[str, Any]]:
    """Return a row for each attempt at a lesson: how far it came, and when it was near its best.

    Where a curve was validated, that says so on common worlds; otherwise the scores of training,
    which are from other worlds in each generation.
    """
    rows = []
    for (lesson, attempt), own in curves.groupby(["lesson", "attempt"], sort=False):
        measured = "validated" if own.get("validated") is not None else "best"
        values = own[measured].to_numpy()
        plan = own["training"].iloc[0]
        told = trainings[plan].lessons
        finals = told[(told["attempt"] == attempt) & (told["lesson"] == lesson)].iloc[0]
        rows.append(
            {
                "lesson": lesson,
                "attempt": attempt,
                "training": plan,
                "generations": len(own),
                "ticks": int(own["ticks"].iloc[-1]),
                "judged": "on common worlds" if measured == "validated" else "in training",
                "best": round(float(values.max()), 4),
                "near_best_from": first_near(values),
                "best_by_half": round(float(values[: max(1, len(values) // 2)].max()), 4),
                "finals": round(float(finals["score"]), 4),
                "finals_deviation": round(float(finals["deviation"]), 4),
                "seconds": round(float(own["seconds"].sum()), 1),
            }
        )
    return rows


def first_near(values: np.ndarray, near: float = NEAR) -> int:
    """Return the first generation within a share of the best of all.

    >>> first_near(np.array([1.0, 94.0, 96.0, 90.0, 100.0]))
    3
    """
    best = values.max()
    return int(np.argmax(values >= best - near * abs(best))) + 1


def findings(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what can be said of each lesson's attempts, a line each."""
    lines = []
    for lesson in dict.fromkeys(row["lesson"] for row in rows):
        own = [row for row in rows if row["lesson"] == lesson]
        best = np.array([row["best"] for row in own])
        early = sum(row["near_best_from"] <= EARLY for row in own)
        short = int((best < FELL_SHORT * np.median(best)).sum())
        gained = best.mean() / np.mean([row["best_by_half"] for row in own]) - 1
        generations = sorted({row["generations"] for row in own})
        length = f"{generations[0]:,}" + (f" to {generations[-1]:,}" if generations[1:] else "")
        latest = max(row["near_best_from"] for row in own)
        near = f"within {NEAR:.0%} of their best by generation {EARLY}"
        reached = f"{early} of {len(own)} are {near}, the last one at {latest}; "
        lines.append(
            f"{lesson}: {len(own)} attempts of {length} generations. Judged {own[0]['judged']}, "
            f"{reached if generations[-1] > EARLY else ''}the second half of the generations adds "
            f"{gained:.1%} to the best so far; {short} of {len(own)} fell short (their best below "
            f"{FELL_SHORT:.0%} of the median). In the finals, on other worlds again: "
            f"{min(row['finals'] for row in own):.2f} to {max(row['finals'] for row in own):.2f}."
        )
    return lines


def draw_curves(figure: Curves, curves: pd.DataFrame) -> Figure:
    """Draw a panel for each lesson and column."""
    across = min(2, len(figure.panels))
    down = -(-len(figure.panels) // across)
    with paper.style():
        drawn = paper.figure(PANEL[0] * across, PANEL[1] * down)
        panels = drawn.subplots(down, across, squeeze=False)
        for place, (axes, (lesson, column)) in enumerate(
            zip(panels.flat, figure.panels, strict=True)
        ):
            _draw(axes, curves[curves["lesson"] == lesson], column)
            paper.panel_title(axes, "abcd"[place], lesson)
    return drawn


def _draw(axes: Axes, own: pd.DataFrame, column: str) -> None:
    attempts = sorted(set(own["attempt"]))
    colours = paper.BLUE_TO_RED
    for place, attempt in enumerate(attempts):
        line = own[own["attempt"] == attempt]
        shade = round((len(colours) - 1) * place / max(1, len(attempts) - 1))
        axes.plot(line["generation"], line[column], color=colours[shade], linewidth=0.6)
    longest = int(own["generation"].max())
    if longest > 2 * EARLY:
        axes.axvline(EARLY, color=paper.GREY, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_xlim(1, max(2, longest))
    axes.set_xlabel("generation")
    axes.set_ylabel(WORTH[column])


def write_curves(
    figure: Curves, trainings: Mapping[str, Training], made: Sequence[str], out: Path
) -> list[Path]:
    """Write a figure, what it says (Markdown), its curves and a row for each attempt (CSV).

    Args:
        figure: which.
        trainings: by plan.
        made: how they came about, a line each.
        out: the folder, made where it is missing.

    Returns:
        The files written.
    """
    curves = curves_of(figure, trainings)
    rows = attempts_of(curves, trainings)
    written = paper.save({figure.name: draw_curves(figure, curves)}, out)
    caption = out / f"{figure.name}.md"
    lines = [
        f"# Figure {figure.name.removeprefix('figure-')}: {' and '.join(figure.lessons)}",
        "",
        *made,
        "",
        f"- Thesis: {figure.thesis}.",
        *(f"- Ours: {line}" for line in findings(rows)),
        "",
    ]
    caption.write_text("\n".join(lines), encoding="utf-8")
    columns = ["lesson", "attempt", "training", "generation", "ticks", "best", "mean"]
    columns += [one for one in ("validated",) if one in curves]
    shown: list[dict[str, Any]] = [
        dict(zip(columns, row, strict=True)) for row in curves[columns].itertuples(index=False)
    ]
    for row in shown:
        row |= {name: f"{row[name]:.5g}" for name in columns[5:]}
    return [
        *written,
        caption,
        write_rows(out / f"{figure.name}.csv", shown),
        write_rows(out / f"{figure.name}-attempts.csv", rows),
    ]
