"""The figures of a counting robot: where it went, and what its variable held meanwhile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from socialmind.catalogue import load_file, model_folder
from socialmind.drawing import style as paper
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import model_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from socialmind import Model
    from socialmind.experiments import Run

COLLECT = load_file(model_folder("collect") / "figures.py")
VARIABLE = "Count"
TASKS = {"Collect": paper.BLUE, "GoToValid+Avoid": paper.RED}
BEFORE = 60
"""Ticks before an object is delivered, in which it is shown on its way."""
AFTER = 3
"""Ticks after something was done, by which the mind has answered."""


@dataclass(frozen=True)
class Memory:
    """What the robot's mind did in each tick.

    Attributes:
        tick: ascending.
        value: of the variable.
        influence: of each task, by the name of its skill.
        carrying: whether the robot held an object.
        delivered: objects brought home so far.
        correct, ended: sequences so far.
    """

    tick: NDArray[np.int64]
    value: NDArray[np.float64]
    influence: dict[str, NDArray[np.float64]]
    carrying: NDArray[np.bool_]
    delivered: NDArray[np.int64]
    correct: NDArray[np.int64]
    ended: NDArray[np.int64]


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `path`, `deliveries` and `memory` by name.
    """
    found: dict[str, Figure] = COLLECT.draw(run)
    memory = memory_of(run)
    with paper.style():
        return {**found, "memory": over_time(memory)}


def memory_of(run: Run) -> Memory:
    """Repeat a run, and note what its robot's mind does in each tick.

    Args:
        run: a recorded run.
    """
    return watched(model_of(Capsule(run.folder)), run.ticks)


def watched(model: Model, ticks: int) -> Memory:
    """Run a model, and note what its robot's mind does in each tick.

    Args:
        model: before its first tick.
        ticks: how many at most.
    """
    robot = model.tables["robots"][0]
    fields = ("carrying", "delivered", "correct", "ended")
    rows = []
    while model.tick < ticks and model.over is None:
        model.advance(1)
        mind = robot.hierarchy
        told = [mind.variable(VARIABLE), *(mind.influence(name) for name in TASKS)]
        rows.append([model.tick, *told, *(getattr(robot, name) for name in fields)])
    columns = np.array(rows, float).reshape(-1, 2 + len(TASKS) + len(fields)).T
    tick, value, *rest = columns
    carrying, *counts = rest[len(TASKS) :]
    delivered, correct, ended = (one.astype(int) for one in counts)
    influence = dict(zip(TASKS, rest, strict=False))
    return Memory(tick.astype(int), value, influence, carrying >= 0, delivered, correct, ended)


def sequences(memory: Memory) -> list[list[int]]:
    """Return the correct sequences, each as places in the memory, step by step.

    For each of its objects: on the way home with it, and just after it was delivered; at last just
    after validating. Of a sequence of two objects these are the steps of figures 7.5 and 7.6.

    Args:
        memory: what the mind did.
    """
    ended, correct, home = (
        np.flatnonzero(np.diff(counts, prepend=0) > 0)
        for counts in (memory.ended, memory.correct, memory.delivered)
    )
    found = []
    for end in correct.tolist():
        begin = max([0, *ended[ended < end].tolist()])
        steps = []
        for delivered in home[(home > begin) & (home < end)].tolist():
            empty = np.flatnonzero(~memory.carrying[: delivered - AFTER])
            gripped = int(empty[-1]) + 1 if len(empty) else 0
            steps += [max(gripped, delivered - BEFORE), delivered + AFTER]
        found.append([*steps, min(end + AFTER, len(memory.tick) - 1)])
    return found


def over_time(memory: Memory) -> Figure:
    """Draw the variable, and which task has how much influence, over time.

    The steps of the first correct sequence, as `sequences` gives them, are numbered.

    Args:
        memory: what the mind did.
    """
    figure = paper.figure(paper.PAGE, 90)
    upper, lower = figure.subplots(2, 1, sharex=True)
    scale = 1.0
    for axes in (upper, lower):
        scale = paper.time_axis(axes, list(memory.tick))
        axes.set_xlim(left=0)
        axes.xaxis.set_major_formatter("{x:,.0f}")
    upper.set_xlabel("")
    time = memory.tick / scale
    upper.step(time, memory.value, where="post", color=paper.INK)
    for what, mark, colour in (
        (memory.delivered, "o", paper.GOLD),
        (memory.correct, "^", paper.PURPLE),
    ):
        at = np.flatnonzero(np.diff(what, prepend=0) > 0)
        name = "object delivered" if mark == "o" else "correct sequence"
        upper.plot(time[at], memory.value[at], mark, color=colour, markersize=3.5, label=name)
    # Room for the legend above what the variable comes to.
    top = min(1.4, 1.6 * max(0.2, float(memory.value.max(initial=0.0))))
    upper.set_ylim(-0.04, top)
    upper.set_ylabel(f"variable {VARIABLE} (0 … 1)")
    upper.legend(loc="upper right", ncols=2)
    for number, place in enumerate(next(iter(sequences(memory)), []), 1):
        for axes in (upper, lower):
            axes.axvline(time[place], color=paper.PALE, linewidth=0.5, zorder=0)
        upper.annotate(
            str(number), (time[place], top), ha="left" if number % 2 == 0 else "right", va="top",
            xytext=(1 if number % 2 == 0 else -1, 0), textcoords="offset points", fontsize=7,
        )  # fmt: skip
    for name, colour in TASKS.items():
        lower.step(
            time,
            memory.influence[name],
            where="post",
            color=colour,
            linestyle=paper.DASHES.get(colour, "-"),
            label=name,
        )
    lower.set_ylim(-0.04, 1.4)
    lower.set_yticks([0.0, 0.5, 1.0])
    lower.set_ylabel("influence (0 … 1)")
    lower.legend(loc="upper right", ncols=2)
    paper.panel_title(upper, "a", "What the variable holds; numbers: steps of a sequence")
    paper.panel_title(lower, "b", "Which task has how much influence")
    return figure
