"""Foraging robots beside the same ones without signals, without sight of each other, at random.

All are scored in the same worlds, so differences are taken world by world.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_model
from socialmind.experiments.measures.intervals import Interval, interval_of
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
        training: the training that their mind is of; None for the mind of the model.
        parameters: of their worlds.
        change: what is done to the mind.
    """

    name: str
    training: str | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    change: Change | None = None


CONDITIONS = (
    Condition("foraging together"),
    Condition("no signals", None, DEAF),
    Condition("no signals, learned without", "deaf", DEAF),
    Condition("not seeing each other", None, BLIND),
    Condition("not seeing each other, learned without", "blind", BLIND),
    Condition("random walk", None, {}, MINDS.walking_at_random),
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
    Measured("area", f"area covered in {SEARCH_TICKS:,} ticks of search (%)", 1, 100.0, True),
    Measured("collisions", "collisions"),
)


@dataclass(frozen=True)
class Result:
    """What the robots of a condition came to.

    Attributes:
        condition: which.
        whole: a row for each world of the whole task.
        search: a row for each world without objects.
    """

    condition: Condition
    whole: pd.DataFrame
    search: pd.DataFrame

    def values(self, measured: Measured) -> Any:
        """Return a measure in each world, as the table has it."""
        frame = self.search if measured.searching else self.whole
        return frame[measured.name].to_numpy(float) * measured.scale

    def mean(self, measured: Measured) -> Interval:
        """Return the mean over worlds."""
        return interval_of(self.values(measured))

    def difference(self, measured: Measured, other: Result) -> Interval:
        """Return by how much it is more than another's, world by world."""
        return interval_of(self.values(measured) - other.values(measured))


def result(condition: Condition, training: Training | None, worlds: int = WORLDS) -> Result | None:
    """Score the robots of a condition.

    Args:
        condition: which.
        training: the one that it is of, if any.
        worlds: how many.

    Returns:
        None where the training is missing.
    """
    mind: Any = None
    if condition.training is not None:
        if training is None:
            return None
        mind = training.mind(best_of(training))
    if condition.change is not None:
        known = MindDescription.load(load_model("foraging").folder() / "mind")
        mind = condition.change(mind or known)
    model, parameters = load_model("foraging"), dict(condition.parameters)
    whole = score(model, mind, worlds, SEED, parameters=parameters)
    empty = score(model, mind, worlds, SEED, ticks=SEARCH_TICKS, parameters={**parameters, **EMPTY})
    return Result(condition, whole.frame, empty.frame)


# The table ----------------------------------------------------------------------------------------


def write_table(
    results: Sequence[tuple[Condition, Result | None]], lines: Sequence[str], out: Path
) -> list[Path]:
    """Write the table as Markdown and as CSV.

    Args:
        results: of all conditions; the first one is there.
        lines: what is said above the table.
        out: the folder.
    """
    out.mkdir(parents=True, exist_ok=True)
    text = ["# Four robots forage", "", *lines, ""]
    titles = [one.title for one in MEASURED]
    text += ["| robots | " + " | ".join(titles) + " |", "|---" * (1 + len(titles)) + "|"]
    text += [f"| {condition.name} | {_cells(found)} |" for condition, found in results]
    reference = results[0][1]
    text += ["", "By how much more than foraging together, world by world:", ""]
    text += ["| robots | " + " | ".join(titles) + " |", "|---" * (1 + len(titles)) + "|"]
    text += [
        f"| {condition.name} | {_cells(found, reference)} |" for condition, found in results[1:]
    ]
    page, numbers = out / "foraging.md", out / "foraging.csv"
    page.write_text("\n".join(text) + "\n", "utf-8")
    with numbers.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["robots", "training", "measure", "compared", "mean", "low", "high",
                         "worlds", "seed"])  # fmt: skip
        writer.writerows(_rows(results))
    return [page, numbers]


def _cells(found: Result | None, reference: Result | None = None) -> str:
    if found is None:
        return " | ".join("not trained" for _ in MEASURED)
    intervals = [
        found.mean(one) if reference is None else found.difference(one, reference)
        for one in MEASURED
    ]
    return " | ".join(
        f"{one.mean:.{m.digits}f} ({one.low:.{m.digits}f} … {one.high:.{m.digits}f})"
        for m, one in zip(MEASURED, intervals, strict=True)
    )


def _rows(results: Sequence[tuple[Condition, Result | None]]) -> list[list[Any]]:
    reference, rows = results[0][1], []
    for condition, found in results:
        if found is None or reference is None:
            continue
        worlds = len(found.whole)
        for measured in MEASURED:
            pairs = {"": found.mean(measured)}
            if found is not reference:
                pairs["foraging together"] = found.difference(measured, reference)
            for compared, one in pairs.items():
                numbers = [round(value, 4) for value in (one.mean, one.low, one.high)]
                training = condition.training or SHIPPED
                rows.append(
                    [condition.name, training, measured.name, compared, *numbers, worlds, SEED]
                )
    return rows


# The figure ---------------------------------------------------------------------------------------


def draw(results: Sequence[tuple[Condition, Result | None]]) -> Figure:
    """Draw the table: a panel for each measure, a row for each condition.

    Args:
        results: of all conditions.
    """
    from socialmind.drawing import style as paper

    found = [(condition.name, one) for condition, one in results if one is not None]
    with paper.style():
        figure = paper.figure(paper.PAGE, 22 + 7 * len(found))
        panels = figure.subplots(1, len(MEASURED), sharey=True)
        for axes, measured in zip(panels, MEASURED, strict=True):
            for place, (_, one) in enumerate(found):
                interval = one.mean(measured)
                colour = paper.BLUE if place == 0 else paper.INK
                axes.plot([interval.low, interval.high], [place, place], color=colour)
                axes.plot([interval.mean], [place], "o", color=colour, markersize=3.5)
            axes.set_xlim(left=0)
            axes.set_xlabel(_broken(measured.title))
        panels[0].set_yticks(range(len(found)), [_broken(name, 24) for name, _ in found])
        panels[0].set_ylim(len(found) - 0.5, -0.5)
    return figure


def _broken(text: str, width: int = 20) -> str:
    """Return a text in lines of at most so many letters, where words allow it."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) > width and lines[-1]:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return "\n".join(lines)


def write_figure(results: Sequence[tuple[Condition, Result | None]], out: Path) -> list[Path]:
    """Write the figure as PDF and PNG."""
    from socialmind.drawing import style as paper

    return paper.save({"foraging": draw(results)}, out)
