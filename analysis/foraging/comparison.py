"""Foraging robots beside the same ones without signals, without sight of each other, at random.

All are scored in the same worlds, and all attempts of a training count: an interval over worlds
alone would be about the minds at hand, not about what the next training comes to.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.catalogue import load_model
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import Interval
from socialmind.experiments.scoring import score
from socialmind.mind import MindDescription

from .trainings import BLIND, DEAF, MINDS, SHIPPED, best_of

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from socialmind.learning import Training

WORLDS = 100
SEED = 81
"""Of the worlds, in which nothing was learned."""
SEARCH_TICKS = 2000
"""How long robots search where there is nothing to find, for the area that they cover."""
EMPTY = {"cluster_size": 0}

Change = Callable[[MindDescription], MindDescription]


@dataclass(frozen=True)
class Condition:
    """Robots that are compared.

    Attributes:
        name: what the table calls them.
        training: the training that their minds are of.
        parameters: of their worlds.
        change: what is done to the minds.
    """

    name: str
    training: str = SHIPPED
    parameters: Mapping[str, float] = field(default_factory=dict)
    change: Change | None = None


CONDITIONS = (
    Condition("foraging together"),
    Condition("no signals", parameters=DEAF),
    Condition("no signals, learned without", "deaf", DEAF),
    Condition("not seeing each other", parameters=BLIND),
    Condition("not seeing each other, learned without", "blind", BLIND),
    Condition("random walk", change=MINDS.walking_at_random),
    Condition("random walk, the rest learned with it", "random"),
)
"""The first one is what the others are compared with."""


@dataclass(frozen=True)
class Measured:
    """A column of the table.

    Attributes:
        name: of the measure.
        title: what the table calls it.
        digits: behind the point.
        scale: what its numbers are multiplied by.
        searching: whether it is taken where there are no objects.
    """

    name: str
    title: str
    digits: int = 1
    scale: float = 1.0
    searching: bool = False


MEASURED = (
    Measured("objects", "objects delivered"),
    Measured("first_find", "ticks to the first find", 0),
    Measured("nothing", "worlds where nothing is found (%)", 0, 100.0),
    Measured("area", f"area covered in {SEARCH_TICKS:,} ticks of search (%)", 1, 100.0, True),
    Measured("collisions", "collisions"),
)


@dataclass(frozen=True)
class Result:
    """What the robots of a condition came to.

    Attributes:
        condition: which.
        worlds: for each attempt a row for each world: its seed, and the measures.
        best: the attempt that did best in the finals of its own last lesson.
    """

    condition: Condition
    worlds: Mapping[int, pd.DataFrame]
    best: int

    def values(self, measured: Measured) -> Any:
        """Return a measure as the table has it, (attempts, worlds)."""
        frames = self.worlds.values()
        return np.array([one[measured.name].to_numpy(float) for one in frames]) * measured.scale

    def mean(self, measured: Measured) -> Interval:
        """Return the mean over attempts and worlds."""
        return crossed_interval(self.values(measured))

    def difference(self, measured: Measured, other: Result) -> Interval:
        """Return by how much it is more than another's, attempt by attempt and world by world.

        All trainings have one seed, so attempts of one number share draws also where they are of
        two trainings, and what both learn under the same conditions is the same to the last bit.
        """
        both = [one for one in self.worlds if one in other.worlds]
        own, others = (
            Result(one.condition, {each: one.worlds[each] for each in both}, one.best)
            for one in (self, other)
        )
        return crossed_interval(own.values(measured) - others.values(measured))


def result(condition: Condition, training: Training | None, worlds: int = WORLDS) -> Result | None:
    """Score the robots of a condition, those of each attempt.

    Args:
        condition: which.
        training: the one that it is of.
        worlds: how many.

    Returns:
        None where the training is missing.
    """
    if training is None:
        return None
    found = {}
    for attempt in training.finished:
        mind = training.mind(attempt)
        found[attempt] = measured_in(
            mind if condition.change is None else condition.change(mind),
            dict(condition.parameters),
            worlds,
        )
    return Result(condition, found, best_of(training))


def measured_in(mind: Any, parameters: Mapping[str, float], worlds: int) -> pd.DataFrame:
    """Return what robots of a mind come to in each world, with and without objects."""
    model, names = load_model("foraging"), {True: ["world"], False: []}
    for one in MEASURED:
        names[not one.searching].append(one.name)
    whole = score(model, mind, worlds, SEED, parameters=parameters).frame
    whole["nothing"] = (whole["first_find"] == whole["ticks"]).astype(float)  # as the model has it
    empty = score(model, mind, worlds, SEED, ticks=SEARCH_TICKS, parameters={**parameters, **EMPTY})
    return whole[names[True]].join(empty.frame[names[False]])


# The table ----------------------------------------------------------------------------------------

Results = Sequence[tuple[Condition, Result | None]]
EACH = (
    "Each attempt, the mean over worlds; in bold the one that did best in the finals of its own "
    "last lesson:"
)


def write_table(results: Results, lines: Sequence[str], out: Path) -> list[Path]:
    """Write the table as Markdown and as CSV, and what each attempt came to in each world.

    Args:
        results: of all conditions; the first one is there.
        lines: what is said above the table.
        out: the folder.
    """
    out.mkdir(parents=True, exist_ok=True)
    titles = " | ".join(one.title for one in MEASURED)
    rule = "|---" * (1 + len(MEASURED)) + "|"
    reference = results[0][1]
    text = ["# Four robots forage", "", *lines, "", f"| robots | {titles} |", rule]
    text += [f"| {condition.name} | {_cells(found)} |" for condition, found in results]
    text += [
        "",
        "By how much more than foraging together, attempt by attempt:",
        "",
        f"| robots | {titles} |",
        rule,
    ]
    text += [
        f"| {condition.name} | {_cells(found, reference)} |" for condition, found in results[1:]
    ]
    text += ["", EACH, "", f"| robots, attempt | {titles} |", rule]
    text += [line for _, found in results if found is not None for line in _attempts(found)]
    page, numbers, worlds = (out / f"foraging{end}" for end in (".md", ".csv", "-worlds.csv"))
    page.write_text("\n".join(text) + "\n", "utf-8")
    heads = ["robots", "training", "measure", "compared", "mean", "low", "high", "attempts",
             "worlds", "seed"]  # fmt: skip
    _write(numbers, heads, _rows(results))
    names = [one.name for one in MEASURED]
    _write(worlds, ["robots", "training", "attempt", "world", *names], _world_rows(results))
    return [page, numbers, worlds]


def _write(file: Path, heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    with file.open("w", newline="", encoding="utf-8") as opened:
        writer = csv.writer(opened)
        writer.writerow(heads)
        writer.writerows(rows)


def _cells(found: Result | None, reference: Result | None = None) -> str:
    if found is None:
        return " | ".join("not trained" for _ in MEASURED)
    intervals = [
        found.mean(one) if reference is None else found.difference(one, reference)
        for one in MEASURED
    ]
    return " | ".join(
        _shown(one, measured.digits) for measured, one in zip(MEASURED, intervals, strict=True)
    )


def _shown(one: Interval, digits: int) -> str:
    """Return a mean and its interval, if there is one."""
    if math.isnan(one.low):
        return f"{one.mean:.{digits}f} (one attempt)"
    return f"{one.mean:.{digits}f} ({one.low:.{digits}f} … {one.high:.{digits}f})"


def _attempts(found: Result) -> list[str]:
    """Return a line for each attempt."""
    means = [found.values(one).mean(axis=1) for one in MEASURED]
    lines = []
    for place, attempt in enumerate(found.worlds):
        mark = "**" if attempt == found.best else ""
        numbers = [
            f"{mark}{mean[place]:.{m.digits}f}{mark}"
            for m, mean in zip(MEASURED, means, strict=True)
        ]
        lines.append(f"| {found.condition.name}, {attempt} | {' | '.join(numbers)} |")
    return lines


def _rows(results: Results) -> list[list[Any]]:
    reference, rows = results[0][1], []
    for condition, found in results:
        if found is None or reference is None:
            continue
        attempts, worlds = found.values(MEASURED[0]).shape
        for measured in MEASURED:
            pairs = {"": found.mean(measured)}
            if found is not reference:
                pairs["foraging together"] = found.difference(measured, reference)
            for compared, one in pairs.items():
                numbers = [round(value, 4) for value in (one.mean, one.low, one.high)]
                rows.append(
                    [condition.name, condition.training, measured.name, compared, *numbers,
                     attempts, worlds, SEED]
                )  # fmt: skip
    return rows


def _world_rows(results: Results) -> list[list[Any]]:
    names = ["world", *(one.name for one in MEASURED)]
    return [
        [condition.name, condition.training, attempt, *row]
        for condition, found in results
        if found is not None
        for attempt, frame in found.worlds.items()
        for row in frame[names].itertuples(index=False, name=None)
    ]


# The figure ---------------------------------------------------------------------------------------


def draw(results: Results) -> Figure:
    """Draw the table: a panel for each measure, a row for each condition, a dot for each attempt.

    Args:
        results: of all conditions.
    """
    from matplotlib.lines import Line2D

    from socialmind.drawing import style as paper

    found = [(condition.name, one) for condition, one in results if one is not None]
    with paper.style():
        figure = paper.figure(paper.PAGE, 30 + 7 * len(found))
        panels = figure.subplots(1, len(MEASURED), sharey=True)
        for letter, axes, measured in zip("abcdefg", panels, MEASURED, strict=False):
            paper.panel_title(axes, letter, "")
            for place, (_, one) in enumerate(found):
                interval = one.mean(measured)
                colour = paper.BLUE if place == 0 else paper.INK
                axes.plot([interval.low, interval.high], [place, place], color=colour)
                axes.plot([interval.mean], [place], "|", color=colour, markersize=7)
                for attempt, mean in zip(
                    one.worlds, one.values(measured).mean(axis=1), strict=True
                ):
                    filled = colour if attempt == one.best else "white"
                    axes.plot([mean], [place - 0.3], "o", color=colour, markersize=3,
                              markerfacecolor=filled, markeredgewidth=0.7,
                              clip_on=False)  # fmt: skip
            axes.set_xlim(left=0)
            axes.set_xlabel(_broken(measured.title))
        panels[0].set_yticks(range(len(found)), [_broken(name, 24) for name, _ in found])
        panels[0].set_ylim(len(found) - 0.5, -0.6)
        dot: dict[str, Any] = {
            "color": paper.INK, "marker": "o", "markersize": 3, "markeredgewidth": 0.7,
            "linestyle": "",
        }  # fmt: skip
        marks = [
            Line2D([], [], **dot, markerfacecolor="white", label="an attempt"),
            Line2D([], [], **dot, label="the best by its own finals"),
            Line2D([], [], color=paper.INK, marker="|", markersize=7,
                   label="mean with its interval of 95 %"),
        ]  # fmt: skip
        figure.legend(handles=marks, loc="outside lower center", ncols=len(marks))
    return figure


def _broken(text: str, width: int = 20) -> str:
    """Return a text in lines of at most so many letters, where words allow it."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) > width and lines[-1]:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return "\n".join(lines)


def write_figure(results: Results, out: Path) -> list[Path]:
    """Write the figure as PDF and PNG."""
    from socialmind.drawing import style as paper

    return paper.save({"foraging": draw(results)}, out)
