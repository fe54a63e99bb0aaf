"""Figures 6.2 to 6.5 drawn, and written with what they say beside what the thesis says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from socialmind.drawing import style as paper

from .curricula import COMMON
from .figures import (
    EARLY,
    FELL_SHORT,
    NEAR,
    Curves,
    Judged,
    attempts_of,
    curves_of,
    length_of,
    short_of,
)
from .tables import write_rows

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from socialmind.learning import Training

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


def findings(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what can be said of each lesson's attempts, a line each."""
    lines = []
    for lesson in dict.fromkeys(row["lesson"] for row in rows):
        own = [row for row in rows if row["lesson"] == lesson]
        scores = [row["shared"] for row in own]
        short = [row for row, one in zip(own, short_of(scores), strict=True) if one]
        early = sum(row["near_end_from"] <= EARLY for row in own)
        gained = np.mean([row["end"] for row in own]) / np.mean([row["half"] for row in own]) - 1
        latest = max(row["near_end_from"] for row in own)
        longest = max(row["generations"] for row in own)
        reached = (
            f"{early} of {len(own)} are within {NEAR:.0%} of what they come to in the end by "
            f"generation {EARLY}, the last one at {latest}; "
        )
        share = ", ".join(f"attempt {row['attempt']}, {row['shared']:.2f}" for row in short)
        lines.append(
            f"{lesson}: {len(own)} attempts of {length_of(own)} generations{_from(own)}. Judged "
            f"{own[0]['judged']}, {reached if longest > EARLY else ''}from half-way to the end "
            f"{gained:+.1%}. Of the winners, in the worlds that all share, {len(short)} of "
            f"{len(own)} fell short (below {FELL_SHORT:.0%} of the median, "
            f"{np.median(scores):.2f}{f': {share}' if share else ''}); they come to "
            f"{min(scores):.2f} to {max(scores):.2f}."
        )
    return lines


def _from(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return which attempts are shown of which training, where they are of several."""
    by_plan: dict[str, list[str]] = {}
    for row in rows:
        by_plan.setdefault(row["training"], []).append(str(row["attempt"]))
    told = [f"{', '.join(numbers)} of `{plan}`" for plan, numbers in by_plan.items()]
    return f" ({', '.join(told)}, which is the longer one of each)" if told[1:] else ""


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
    """Draw a panel for each lesson and column, those beside each other with one scale.

    Args:
        figure: which.
        curves: as `curves_of` gives them.
        rows: of the attempts.
    """
    across = min(2, len(figure.panels))
    down = -(-len(figure.panels) // across)
    several = len(figure.lessons) > 1
    with paper.style():
        drawn = paper.figure(paper.COLUMN, PANEL * down + 8)
        panels = drawn.subplots(down, across, squeeze=False, sharey="row")
        for place, (axes, (lesson, column)) in enumerate(
            zip(panels.flat, figure.panels, strict=True)
        ):
            own = [row for row in rows if row["lesson"] == lesson]
            _draw(axes, curves[curves["lesson"] == lesson], column, own)
            if any(row["generations"] != figure.generations for row in own):
                axes.set_xlabel(f"generation (thesis: {figure.generations:,})")
            if across > 1:
                title = lesson if several else f"{lesson}, the {column}"
                paper.panel_title(axes, "abcd"[place], title)
            axes.set_ylabel(WORTH[column] if several or across == 1 else "score")
            if place % across:
                axes.set_ylabel("")  # the panel at its left says it
        limits = _limits([(one.dataLim.y0, one.dataLim.y1) for one in panels.flat])
        for row in panels:
            row[0].set_ylim(**limits)
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
    paper.attempts(axes, lines, short_of([row["shared"] for row in rows]))
    if longest > 2 * EARLY:
        axes.axvline(EARLY, color=paper.GREY, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_xlabel("generation")


def _limits(shown: Sequence[tuple[float, float]]) -> dict[str, float]:
    """Return where an axis of scores begins: at nought, or below it where a curve is.

    Where all curves lie in the upper two thirds, it begins where they do, so that they can be told
    apart.

    Args:
        shown: the least and the most that each panel shows.

    >>> _limits([(1.0, 5.0)]), _limits([(-1.0, 5.0), (2.0, 4.0)]), _limits([(4.0, 5.0)])
    ({'bottom': 0.0}, {'bottom': -1.0}, {})
    """
    least, most = min(low for low, _ in shown), max(high for _, high in shown)
    return {} if least > most / 3 else {"bottom": min(0.0, least)}


def _key(rows: Sequence[Mapping[str, Any]]) -> list[Line2D]:
    """Return the key of all panels."""
    failed = [one for own in _by_lesson(rows) for one in short_of([row["shared"] for row in own])]
    return [
        one
        for one in paper.attempts_key([range(row["generations"]) for row in rows], failed)
        if _uneven(rows) or one.get_marker() != "o"
    ]


def _by_lesson(rows: Sequence[Mapping[str, Any]]) -> list[list[Mapping[str, Any]]]:
    lessons = dict.fromkeys(row["lesson"] for row in rows)
    return [[row for row in rows if row["lesson"] == lesson] for lesson in lessons]


def _uneven(rows: Sequence[Mapping[str, Any]]) -> bool:
    """Whether some attempt at a lesson ends before others, which a dot says."""
    return any(len({row["generations"] for row in own}) > 1 for own in _by_lesson(rows))


def caption(figure: Curves, rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what a figure's marks mean, a sentence each."""
    smooth = max(row["generations"] for row in rows) > SMOOTHED
    columns = {column for _, column in figure.panels}
    uneven = _uneven(rows)
    short = any(one for own in _by_lesson(rows) for one in short_of([r["shared"] for r in own]))
    texts = [
        f"A grey line is an attempt{', red where its winner fell short' if short else ''}; blue is "
        "the median of the attempts"
        + (
            ", as far as all of them go, and a dot where an attempt's lesson ends."
            if uneven
            else "."
        )
    ]
    if uneven:
        texts.append("A dot is where an attempt's lesson ends before the longest.")
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
        texts.append(
            f"Common worlds are {COMMON} that no generation is trained in, the same for all "
            "generations of an attempt and others for each attempt, so that its own generations "
            "can be compared by them, and two attempts less well."
        )
    texts.append(
        "The worlds that all share, in which winners are judged once more, are used for nothing "
        "else: those of the finals chose the winner, so that its score there is a little too high, "
        "and each attempt has finals of its own."
    )
    if smooth:
        texts.append(f"The dashed line is generation {EARLY}.")
    return texts


def write_curves(
    figure: Curves,
    trainings: Mapping[str, Training],
    judged: Mapping[str, Judged],
    made: Sequence[str],
    out: Path,
) -> list[Path]:
    """Write a figure, what it says (Markdown), its curves and a row for each attempt (CSV).

    Only an attempt's own row says which training it is from, as curves are long.

    Args:
        figure: which.
        trainings: by plan.
        judged: what winners come to in the worlds that all share, by plan.
        made: how they came about, a line each.
        out: the folder, made where it is missing.

    Returns:
        The files written.
    """
    curves = curves_of(figure, trainings)
    rows = attempts_of(curves, trainings, judged)
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
    beside = [
        {"training": plan, "attempt": attempt, "lesson": lesson, "shared": round(score, 4)}
        for plan, own in judged.items()
        for (attempt, lesson), score in own.items()
    ]
    return [
        *written,
        page,
        write_rows(out / f"{figure.name}.csv", shown),
        write_rows(out / f"{figure.name}-attempts.csv", rows),
        *([write_rows(out / f"{figure.name}-lessons.csv", beside)] if figure.beside else []),
    ]
