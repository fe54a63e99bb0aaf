"""What the variable of each attempt holds, step by step, and how well it counts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from socialmind.catalogue import load_file, load_model, model_folder
from socialmind.drawing import style as paper
from socialmind.experiments import score
from socialmind.experiments.studies import Way, write_figure, write_page
from socialmind.experiments.trainings.plans import attempts_of
from socialmind.mind import MindDescription

from .trainings import PLANS, wanted_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.learning import Training

FIGURES = load_file(model_folder("counter") / "figures.py")
SEED = 75
"""Of the worlds that attempts are scored in."""
MEASURES = ("correct_sequences", "sequences", "objects", "survived")
STEPS = ("brings the first", "delivered it", "brings the second", "delivered it", "validated")
TITLES = {
    "counter": "no hidden layer",
    "counter_hidden": "two hidden layers",
    "simple": "holds what it is told",
    "wanted": "counts one to four",
}
"""Of the panels, by training."""
WATCHED = 10
"""Runs of an attempt in which a correct sequence is looked for."""
GOOD = 0.9
"""The share of correct sequences from which an attempt counts as one that learned to count."""

Row = dict[str, Any]
WELL: Row = {"color": paper.BLUE, "marker": "."}
OTHERS: Row = {"color": paper.GREY, "marker": "x", "markersize": 3, "linestyle": (0, (4, 1.2))}
"""Lines of attempts that learned to count, and of others."""


def row_of(name: str, attempt: int, mind: MindDescription, worlds: int) -> Row:
    """Return what an attempt comes to: its measures, and the variable's value in each step.

    Args:
        name: of the training.
        attempt: its number.
        mind: what it learned.
        worlds: how many it is scored in.
    """
    model = load_model("counter")
    parameters = {"wanted": wanted_of(name)}
    found = score(model, mind, episodes=worlds, seed=SEED, parameters=parameters)
    row: Row = {"training": name, "attempt": attempt, "worlds": worlds, "seed": SEED}
    row |= {key: round(found.intervals[key].mean, 4) for key in MEASURES}
    values: list[float] = []
    two = found.frame.sort_values("sequences", ascending=False, kind="stable")["world"]
    for world in two[:WATCHED].tolist():
        memory = FIGURES.watched(model(seed=world, hierarchy=mind, **parameters), model.ticks)
        shown = [one for one in FIGURES.sequences(memory) if len(one) == len(STEPS)]
        if shown:
            # The last one: a first sequence may begin from another value than all others.
            values = memory.value[shown[-1]].tolist()
            break
    for number in range(len(STEPS)):
        row[f"step {number + 1}"] = round(values[number], 4) if values else None
    return row


def write_representations(
    trainings: Mapping[str, tuple[Training | None, str]], way: Way, worlds: int, out: Path
) -> list[Path]:
    """Write a row for each attempt, a figure, and what they say.

    Args:
        trainings: by plan, each with a line on where it comes from.
        way: in which they are come by.
        worlds: how many each attempt is scored in.
        out: the folder.
    """
    attempts = attempts_of({name: training for name, (training, _) in trainings.items()})
    rows = [row_of(*attempt, worlds) for attempt in attempts]
    made = (
        f"{way.said('representations', 'counter')} Scored in {worlds} worlds that no training has "
        f"seen (seed {SEED}), the same ones for all."
    )
    told = [made, *(line for _, line in trainings.values())]
    page = write_page("representations", "Attempts at learning to count", told, lines_of(rows), out)
    return [*write_figure("representations", draw(rows), rows, out), page]


def lines_of(rows: list[Row]) -> list[str]:
    """Return what the attempts come to, in words and a table."""
    lines = []
    for name in dict.fromkeys(row["training"] for row in rows):
        own = [row for row in rows if row["training"] == name]
        shares = np.nan_to_num([row["correct_sequences"] for row in own])
        good = int((shares >= GOOD).sum())
        kinds = {tuple(row[f"step {n + 1}"] for n in range(len(STEPS))) for row in own
                 if row["correct_sequences"] >= GOOD and row["step 1"] is not None}  # fmt: skip
        lines.append(
            f"- `{name}`, {PLANS[name].about}: {good} of {len(own)} attempts with {GOOD:.0%} of "
            f"their sequences correct or more (best {shares.max():.2f}); {len(kinds)} different "
            "representations among them."
        )
    heads = ["training", "attempt", *MEASURES, *(f"{n}: {what}" for n, what in enumerate(STEPS, 1))]
    lines += ["", f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    for row in rows:
        cells = [row[key] for key in ("training", "attempt", *MEASURES)]
        cells += [row[f"step {number + 1}"] for number in range(len(STEPS))]
        lines.append(f"| {' | '.join('–' if one is None else str(one) for one in cells)} |")
    return lines


def draw(rows: list[Row]) -> Figure:
    """Draw the variable step by step, a panel for each training.

    A line is an attempt that has a correct sequence of two; the others are counted.

    Args:
        rows: of the attempts.
    """
    names = list(dict.fromkeys(row["training"] for row in rows))
    with paper.style():
        figure = paper.figure(paper.PAGE, 80)
        panels = figure.subplots(1, len(names), squeeze=False, sharey=True)[0]
        for place, (axes, name) in enumerate(zip(panels, names, strict=True)):
            every = [one for one in rows if one["training"] == name]
            own = [one for one in every if one["step 1"] is not None]
            alike = Counter(
                (row["correct_sequences"] >= GOOD,
                 tuple(row[f"step {number + 1}"] for number in range(len(STEPS))))
                for row in own
            )  # fmt: skip
            for (good, values), count in alike.items():
                look = WELL if good else OTHERS
                axes.plot(range(1, len(STEPS) + 1), values, linewidth=0.5 * count + 0.3,
                          clip_on=False, **look)  # fmt: skip
            axes.text(0.04, 0.97, f"{len(own)} of {len(every)} drawn", va="top", fontsize=7,
                      transform=axes.transAxes)  # fmt: skip
            axes.set_xlim(0.8, len(STEPS) + 0.2)
            axes.set_xticks(range(1, len(STEPS) + 1))
            axes.set_xlabel("step of a sequence of two")
            paper.panel_title(axes, "abcdef"[place], TITLES[name])
        panels[0].set_ylim(-0.02, 1.12)
        panels[0].set_yticks(np.linspace(0, 1, 6))
        panels[0].set_ylabel("variable Count (0 … 1)")
        marks = [
            Line2D([], [], label=what, **look)
            for look, what in (
                (WELL, f"{100 * GOOD:.0f} % or more of its sequences correct"),
                (OTHERS, "fewer"),
            )
        ]
        steps = ", ".join(f"{number} {what}" for number, what in enumerate(STEPS, 1))
        title = f"{steps}\na line: an attempt; the broader, the more come to the same"
        legend = figure.legend(handles=marks, loc="outside lower center", ncols=2, title=title)
        legend.get_title().set(fontsize=7, multialignment="center")
    return figure
