"""What the study writes: a row for each group and world, a figure, and a page with the findings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file, model_folder
from socialmind.drawing import style as paper
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.studies import Way, write_page
from socialmind.mind import Hierarchy, MindDescription

from .groups import (
    BLOCKS,
    GENERALISTS,
    GROUNDS,
    HALVES,
    JUDGED,
    NAMES,
    PRIMITIVES,
    evolved_there,
    judge_all,
    mix,
    mixes,
)
from .plots import draw, over_attempts

if TYPE_CHECKING:
    from socialmind.learning import Training

MODEL = load_file(model_folder("task_partitioning") / "model.py")
NAME = "task-partitioning"
PARTITIONED = 0.5
"""The share of items that two robots or more had, from which an attempt counts as one that divides
the way."""


def write_partitioning(
    trainings: Mapping[str, tuple[Training | None, str]], way: Way, worlds: Sequence[int], out: Path
) -> list[Path]:
    """Judge all groups; write the tables, the figure and the page.

    Args:
        trainings: by name, each with a line on where it comes from.
        way: in which they are come by.
        worlds: the seeds of those in which groups are judged.
        out: the folder, made where it is missing.
    """
    known = {name: training for name, (training, _) in trainings.items() if training is not None}
    table = judge_all(known, worlds)
    figure = draw(table, {name: curve_of(training) for name, training in known.items()})
    written = paper.save({NAME: figure}, out)
    table.to_csv(out / f"{NAME}.csv", index=False, float_format="%.4g", lineterminator="\n")
    rules = pd.concat(
        rules_of(training.mind(attempt)).assign(training=name, attempt=attempt)
        for name, training in known.items()
        for attempt in training.finished
    )
    rules.to_csv(out / f"{NAME}-rules.csv", index=False, float_format="%.3g", lineterminator="\n")
    made = (
        f"{way.said(NAME, 'task_partitioning')} All groups are judged in the same {len(worlds)} "
        "worlds, which no training has seen. Brackets: intervals of 95 %, of evolved groups over "
        "attempts and worlds, of programmed ones over worlds."
    )
    told = [made, *(line for _, line in trainings.values())]
    lines = [] if way is Way.QUICK else [*findings(table), ""]
    page = write_page(NAME, "Task partitioning", told, [*lines, *tables(table)], out)
    return [*written, out / f"{NAME}.csv", out / f"{NAME}-rules.csv", page]


def curve_of(training: Training) -> pd.DataFrame:
    """Return a training's curve, with the episodes of an attempt so far, over all its lessons."""
    curve = training.curve
    own = curve.groupby(["attempt", "lesson"], sort=False)["ticks"].diff().fillna(curve["ticks"])
    so_far = own.groupby(curve["attempt"]).cumsum()
    return curve.assign(episodes=so_far / MODEL.TaskPartitioning.ticks)


# Findings -----------------------------------------------------------------------------------------


def findings(table: pd.DataFrame) -> Iterator[str]:
    """Yield what was found, a line each; of a claim whether the table bears it.

    Args:
        table: of `judge_all`.
    """
    for ground in GROUNDS:
        yield (
            f"- On {NAMES[ground]} programmed generalists bring "
            f"{_of(table, GENERALISTS.name, ground)} items home, half droppers and half collectors "
            f"{_of(table, HALVES.name, ground)}. The best of all {len(list(mixes()))} programmed "
            f"groups: {_best_mix(table, ground)}, {_of(table, _best_mix(table, ground), ground)}."
        )
    one_dropper, one_collector, both = (
        _of(table, mix(*numbers).name, "slope") for numbers in ((3, 1, 0), (3, 0, 1), (2, 1, 1))
    )
    yield (
        f"- On the slope, a dropper in place of one of four generalists makes it {one_dropper} "
        f"items, a collector {one_collector}, both at once {both}."
    )
    for start in (BLOCKS, PRIMITIVES):
        for ground in GROUNDS:
            yield from _what_evolved(evolved_there(table, start, ground), start, ground)
    for start in (BLOCKS, PRIMITIVES):
        yield _more(
            f"Evolved from {start}, groups on the slope divide the way more than on flat ground",
            *(_by_attempt(table, start, ground, "shared") for ground in GROUNDS),
        )
    yield _more(
        "On the slope, groups that begin with building blocks divide the way more than those that "
        "begin with primitives",
        *(_by_attempt(table, start, "slope", "shared") for start in (BLOCKS, PRIMITIVES)),
    )
    yield _more(
        "On the slope, groups that begin with building blocks bring more home than those that "
        "begin with primitives",
        *(_by_attempt(table, start, "slope", "delivered") for start in (BLOCKS, PRIMITIVES)),
    )
    for start in (BLOCKS, PRIMITIVES):
        yield _more_than_generalists(table, start)


def _what_evolved(rows: pd.DataFrame, start: str, ground: str) -> Iterator[str]:
    if rows.empty:
        return
    shares = rows.groupby("attempt")["shared"].mean()
    beyond = rows.assign(beyond=rows["division"] - rows["by_chance"])
    yield (
        f"- Evolved from {start} on {NAMES[ground]}: {int((shares > PARTITIONED).sum())} of "
        f"{len(shares)} attempts divide the way for more than {PARTITIONED:.0%} of their items; of "
        f"all items more than one robot had {_said(rows, 'shared')}. Brought home: "
        f"{_said(rows, 'delivered', 1)}. Division of labour, I / H(tasks): "
        f"{_said(rows, 'division')}, {_said(beyond, 'beyond')} more than luck gives."
    )


def _by_attempt(table: pd.DataFrame, start: str, ground: str, measure: str) -> pd.Series:
    rows = evolved_there(table, start, ground)
    return rows.groupby("attempt")[measure].mean().dropna()


def _more(claim: str, first: pd.Series, second: pd.Series) -> str:
    """Say whether one sample is larger than another, by the interval of the difference."""
    if min(len(first), len(second)) < 2:
        return f"- {claim}: too few attempts to tell."
    found = compared(first, second, paired=False)
    away = found.difference
    return (
        f"- {claim}: {_verdict(away)} (difference {away.mean:.2f}, {away.low:.2f} to "
        f"{away.high:.2f}; Cliff's δ {found.delta:+.2f})."
    )


def _more_than_generalists(table: pd.DataFrame, start: str) -> str:
    """Say whether evolved groups bring more home than generalists do, world by world."""
    claim = f"Evolved from {start}, groups on the slope bring more home than generalists do"
    rows = evolved_there(table, start, "slope")
    if rows["attempt"].nunique() < 2:
        return f"- {claim}: too few attempts to tell."
    alone = table[(table["group"] == GENERALISTS.name) & (table["ground"] == "slope")]
    brought = alone.set_index("world")["delivered"]
    more = rows.assign(more=rows["delivered"] - rows["world"].map(brought))
    away = over_attempts(more, "more")
    return (
        f"- {claim}: {_verdict(away)} (difference {away.mean:.2f}, {away.low:.2f} to "
        f"{away.high:.2f}, in the same worlds)."
    )


def _verdict(away: Interval) -> str:
    if away.low > 0:
        return "holds"
    return "**the reverse holds**" if away.high < 0 else "cannot be told"


def _best_mix(table: pd.DataFrame, ground: str) -> str:
    own = table[(table["attempt"] == 0) & (table["ground"] == ground)]
    return str(own.groupby("group")["delivered"].mean().idxmax())


def _said(rows: pd.DataFrame, measure: str, digits: int = 2) -> str:
    return _interval(over_attempts(rows, measure), digits)


def _of(table: pd.DataFrame, name: str, ground: str) -> str:
    rows = table[(table["group"] == name) & (table["ground"] == ground)]
    return _interval(interval_of(rows["delivered"]), 1)


def _interval(found: Interval, digits: int) -> str:
    mean = f"{found.mean:.{digits}f}"
    return (
        mean
        if np.isnan(found.low)
        else f"{mean} ({found.low:.{digits}f} to {found.high:.{digits}f})"
    )


# Tables -------------------------------------------------------------------------------------------


def tables(table: pd.DataFrame) -> Iterator[str]:
    """Yield the lines of a table: means over worlds of each attempt and programmed group.

    Args:
        table: of `judge_all`.
    """
    heads = ["group", "attempt", "judged on", *JUDGED]
    yield f"| {' | '.join(heads)} |"
    yield "|" + "---|" * len(heads)
    for (name, attempt, ground), rows in table.groupby(["group", "attempt", "ground"], sort=False):
        means = [rows[measure].mean() for measure in JUDGED]
        digits = [1, *[2] * (len(JUDGED) - 1)]
        cells = [
            f"{one:.{n}f}" if np.isfinite(one) else "–"
            for one, n in zip(means, digits, strict=True)
        ]
        yield f"| {name} | {attempt or '–'} | {NAMES[str(ground)]} | {' | '.join(cells)} |"


def rules_of(mind: MindDescription) -> pd.DataFrame:
    """Return a mind as a table of rules: the chances of each primitive in each situation.

    Args:
        mind: of a robot.

    Returns:
        A row for each place, with an item or without, and behaviour so far. The chances of the
        three behaviours add up to 1, or are all 0 where the robot goes on with what it does.
    """
    robot, rows = Hierarchy(mind, master=MODEL.MASTER), []
    senses = ("PHOTOTAXIS", "ANTIPHOTOTAXIS", "RANDOM_WALK")
    for place, laden, doing in product(MODEL.PLACES, (0, 1), range(len(senses))):
        told = dict.fromkeys((*MODEL.PLACES, *senses), 0.0)
        told |= {place: 1.0, senses[doing]: 1.0, "LADEN": float(laden)}
        commands = robot.evaluate(told)
        total = sum(commands[one] for one in MODEL.BEHAVIOURS)
        chances = {one: commands[one] / total if total else 0.0 for one in MODEL.BEHAVIOURS}
        rows.append(
            {"place": place.lower(), "laden": laden, "behaviour": MODEL.BEHAVIOURS[doing]}
            | {f"to_{name}": chance for name, chance in chances.items()}
            | {name: commands[name] for name in ("PickUp", "Drop")}
        )
    return pd.DataFrame(rows)
