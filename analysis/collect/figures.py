"""Figures 6.2 to 6.5: what the best individual of each generation came to, a line an attempt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from socialmind.drawing import style as paper

from .tables import write_rows

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from socialmind.learning import Training

NEAR = 0.05
"""Of what it comes to in the end, within which an attempt counts as having reached it."""
END = 10
"""The part of a curve, one in so many generations, whose mean is what it comes to in the end."""
EARLY = 100
"""The generation by which the thesis finds most attempts of base skills at their maximum."""
FELL_SHORT = 0.75
"""Of the median attempt's finals, below which an attempt counts as one that failed."""
WORTH = {
    "best": "score of the best",
    "mean": "mean score",
    "validated": "score, common worlds",
}
PANEL = 46.0
"""Height of a row of panels, in mm."""
SMOOTHED = 200
"""Generations from which on a curve of training is drawn as running medians."""
WINDOW = 15
"""Generations of a running median."""
COMMON = 64
"""Worlds on which curves of base skills are judged too."""


@dataclass(frozen=True)
class Curves:
    """A figure: lessons' curves.

    Attributes:
        name: of the study.
        plans: the trainings; of an attempt that several have made, the longest curve is shown.
        panels: for each, the lesson and the column of its curve.
        thesis: what the thesis says of its own.
        generations: that each attempt has in the thesis.
    """

    name: str
    plans: tuple[str, ...]
    panels: tuple[tuple[str, str], ...]
    thesis: str
    generations: int

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
        1000,
    ),
    Curves(
        "figure-6.3",
        ("hierarchy", "longer_avoid"),
        (("Avoid", "best"),),
        "most of 10 attempts continue to evolve past generation 500 of 2,500; 2,500 generations "
        "reach 10 % more than 1,000",
        2500,
    ),
    Curves(
        "figure-6.4",
        ("hierarchy",),
        (("GoToObject+Avoid", "best"), ("GoToDropZone+Avoid", "best")),
        "10 of 10 attempts succeed within 1,500 generations; GoToObject+Avoid is slightly more "
        "difficult",
        1500,
    ),
    Curves(
        "figure-6.5",
        ("hierarchy",),
        (("Collect", "best"), ("Collect", "mean")),
        "10 of 10 attempts succeed in under 10 generations",
        1500,
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
                "end": round(float(at_the_end(values)), 4),
                "near_end_from": first_near(values),
                "half": round(float(at_the_end(values[: max(1, len(values) // 2)])), 4),
                "finals": round(float(finals["score"]), 4),
                "finals_deviation": round(float(finals["deviation"]), 4),
                "seconds": round(float(own["seconds"].sum()), 1),
            }
        )
    return rows


def at_the_end(values: np.ndarray) -> float:
    """Return the mean of a curve's last tenth: no single lucky generation decides.

    >>> at_the_end(np.array([9.0] + [1.0] * 18 + [3.0]))
    2.0
    """
    return float(values[-max(1, len(values) // END) :].mean())


def first_near(values: np.ndarray, near: float = NEAR) -> int:
    """Return the first generation within a share of what a curve comes to in the end.

    >>> first_near(np.array([1.0, 94.0, 96.0, 90.0, 100.0]))
    3
    """
    end = at_the_end(values)
    return int(np.argmax(values >= end - near * abs(end))) + 1


def short_of(finals: Sequence[float], usual: float | None = None) -> list[bool]:
    """Return which attempts failed, by their final individuals in worlds of their own.

    Args:
        finals: of the attempts.
        usual: what is to be come near to; the attempts' own median by default.

    >>> short_of([4.0, 4.0, 2.9]), short_of([4.0, 4.0, 2.9], usual=6.0)
    ([False, False, True], [True, True, True])
    """
    least = FELL_SHORT * float(np.median(finals) if usual is None else usual)
    return [one < least for one in finals]


def findings(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what can be said of each lesson's attempts, a line each."""
    lines = []
    for lesson in dict.fromkeys(row["lesson"] for row in rows):
        own = [row for row in rows if row["lesson"] == lesson]
        finals = [row["finals"] for row in own]
        short = [row for row, one in zip(own, short_of(finals), strict=True) if one]
        early = sum(row["near_end_from"] <= EARLY for row in own)
        gained = np.mean([row["end"] for row in own]) / np.mean([row["half"] for row in own]) - 1
        latest = max(row["near_end_from"] for row in own)
        longest = max(row["generations"] for row in own)
        reached = (
            f"{early} of {len(own)} are within {NEAR:.0%} of what they come to in the end by "
            f"generation {EARLY}, the last one at {latest}; "
        )
        share = ", ".join(f"attempt {row['attempt']}, {row['finals']:.2f}" for row in short)
        lines.append(
            f"{lesson}: {len(own)} attempts of {length_of(own)} generations. Judged "
            f"{own[0]['judged']}, {reached if longest > EARLY else ''}from half-way to the end "
            f"{gained:+.1%}. By their finals, the individuals that came of them in worlds of their "
            f"own, {len(short)} of {len(own)} fell short (below {FELL_SHORT:.0%} of the median, "
            f"{np.median(finals):.2f}{f': {share}' if share else ''}); they come to "
            f"{min(finals):.2f} to {max(finals):.2f}."
        )
    return lines


def length_of(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return how many generations attempts have, the fewest to the most.

    >>> length_of([{"generations": 60}, {"generations": 1200}])
    '60 to 1,200'
    """
    each = sorted({row["generations"] for row in rows})
    return f"{each[0]:,}" + (f" to {each[-1]:,}" if each[1:] else "")


def budget(figure: Curves, rows: Sequence[Mapping[str, Any]]) -> str:
    """Return our generations and ticks beside the thesis's generations."""
    parts = []
    for lesson in figure.lessons:
        own = [row for row in rows if row["lesson"] == lesson]
        ticks = max(row["ticks"] for row in own) / 1e6
        parts.append(f"{lesson} {length_of(own)} generations, up to {ticks:,.0f} million ticks")
    same = all(row["generations"] == figure.generations for row in rows)
    return (
        f"Budget of an attempt: {'; '.join(parts)}. Thesis: {figure.generations:,} generations; "
        "its individuals and the worlds of each it does not tell, so ticks cannot be compared"
        f"{'' if same else ', and **the budgets are not equal**'}."
    )


def draw_curves(figure: Curves, curves: pd.DataFrame, rows: Sequence[Mapping[str, Any]]) -> Figure:
    """Draw a panel for each lesson and column.

    Args:
        figure: which.
        curves: as `curves_of` gives them.
        rows: of the attempts.
    """
    across = min(2, len(figure.panels))
    down = -(-len(figure.panels) // across)
    with paper.style():
        drawn = paper.figure(paper.COLUMN, PANEL * down + 8)
        panels = drawn.subplots(down, across, squeeze=False)
        for place, (axes, (lesson, column)) in enumerate(
            zip(panels.flat, figure.panels, strict=True)
        ):
            own = [row for row in rows if row["lesson"] == lesson]
            _draw(axes, curves[curves["lesson"] == lesson], column, own)
            if any(row["generations"] != figure.generations for row in own):
                axes.set_xlabel(f"generation (thesis: {figure.generations:,})")
            paper.panel_title(axes, "abcd"[place], lesson)
            if place % across and figure.panels[place - 1][1] == column:
                axes.set_ylabel("")  # the panel at its left says it
        drawn.legend(handles=_key(rows), loc="outside lower center", ncols=3, columnspacing=1.2,
                     handlelength=1.6)  # fmt: skip
    return drawn


def _draw(axes: Axes, own: pd.DataFrame, column: str, rows: Sequence[Mapping[str, Any]]) -> None:
    longest = int(own["generation"].max())
    lines = []
    for row in rows:
        line = own.loc[own["attempt"] == row["attempt"], column]
        if column != "validated" and longest > SMOOTHED:
            line = line.rolling(WINDOW, center=True, min_periods=1).median()
        lines.append(line.to_numpy())
    paper.attempts(axes, lines, short_of([row["finals"] for row in rows]))
    if longest > 2 * EARLY:
        axes.axvline(EARLY, color=paper.GREY, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_ylim(bottom=min(0.0, *(float(one.min()) for one in lines)))
    axes.set_xlabel("generation")
    axes.set_ylabel(WORTH[column])


def _key(rows: Sequence[Mapping[str, Any]]) -> list[Line2D]:
    """Return the key of all panels."""
    by_lesson = [[row for row in rows if row["lesson"] == one["lesson"]] for one in rows]
    failed = [one for own in by_lesson for one in short_of([row["finals"] for row in own])]
    return paper.attempts_key([range(row["generations"]) for row in rows], failed)


def caption(figure: Curves, rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what a figure's marks mean, a sentence each."""
    smooth = max(row["generations"] for row in rows) > SMOOTHED
    columns = {column for _, column in figure.panels}
    texts = [
        "A grey line is an attempt, red where its final individual fell short; blue is the median "
        "of the attempts, as far as all of them go, and a dot where an attempt's lesson ends."
    ]
    if columns & {"best", "mean"}:
        texts.append(
            "Scores of training are of other worlds in each generation, the same for all its "
            "individuals: a dip is a generation whose worlds are hard, for the mean as for the "
            "best, and the best of many is luck in part, the more the less alike they are, so "
            "scores fall as a population comes to be alike."
        )
    if smooth and "best" in columns:
        texts.append(f"They are drawn as running medians over {WINDOW} generations.")
    if "validated" in columns:
        texts.append(f"Common worlds are {COMMON} that no generation is trained in.")
    if smooth:
        texts.append(f"The dashed line is generation {EARLY}.")
    return texts


def write_curves(
    figure: Curves, trainings: Mapping[str, Training], made: Sequence[str], out: Path
) -> list[Path]:
    """Write a figure, what it says (Markdown), its curves and a row for each attempt (CSV).

    Only an attempt's own row says which training it is from, as curves are long.

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
    written = paper.save({figure.name: draw_curves(figure, curves, rows)}, out)
    page = out / f"{figure.name}.md"
    lines = [
        f"# Figure {figure.name.removeprefix('figure-')}: {' and '.join(figure.lessons)}",
        "",
        *made,
        "",
        f"- Thesis: {figure.thesis}.",
        *(f"- Ours: {line}" for line in findings(rows)),
        f"- {budget(figure, rows)}",
        "",
        " ".join(caption(figure, rows)),
        "",
    ]
    page.write_text("\n".join(lines), encoding="utf-8")
    columns = ["lesson", "attempt", "generation", "ticks", "best", "mean"]
    columns += [one for one in ("validated",) if one in curves]
    shown: list[dict[str, Any]] = [
        dict(zip(columns, row, strict=True)) for row in curves[columns].itertuples(index=False)
    ]
    for row in shown:
        row |= {name: f"{row[name]:.5g}" for name in columns[4:]}
    return [
        *written,
        page,
        write_rows(out / f"{figure.name}.csv", shown),
        write_rows(out / f"{figure.name}-attempts.csv", rows),
    ]
