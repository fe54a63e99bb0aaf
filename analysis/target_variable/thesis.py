"""What the thesis reports of a skill that goes to a target variable (7.1), beside ours."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

from socialmind.experiments.judging import Finding, above, in_brackets, looked_through, not_so
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import interval_of
from socialmind.experiments.overview import Result, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
DIRECT = 1.3
"""Ways up to so many times as long as the plain hierarchy's have no loops."""
SELDOM = 0.1
"""Objects a run below which an attempt's ways are those of a few objects."""
LOOP = 2.0
"""A way so many times as long as the distance of its ends has a loop."""


def found_by(figure: str, number: int) -> str:
    """Return how the run of a figure was come by.

    Args:
        figure: which.
        number: of objects that the robot was to bring home.
    """
    from .trajectories import SEEDS

    run = looked_through(SEEDS, int(rows_of(KEPT / f"{figure}.csv")[0]["seed"]))
    return f"runs were searched for one in which it brings {number} home: {run}"


def ways(figure: str) -> dict[tuple[int, bool], float]:
    """Return how long each way of a figure is, over the distance of its ends.

    Args:
        figure: which.

    Returns:
        By the object's number, and whether it is carried.
    """
    legs: dict[tuple[int, bool], list[tuple[float, float]]] = {}
    for row in rows_of(KEPT / f"{figure}.csv"):
        place = float(row["x"]), float(row["y"])
        legs.setdefault((int(row["object"]), row["carrying"] == "1"), []).append(place)
    return {
        key: sum(math.dist(one, other) for one, other in pairwise(leg)) / math.dist(leg[0], leg[-1])
        for key, leg in legs.items()
    }


def brought(training: str) -> list[float]:
    """Return how many objects a run each attempt brings home."""
    rows = rows_of(KEPT / "target-functions.csv")
    return [float(row["objects"]) for row in rows if row["training"] == training]


def ratios(training: str) -> list[float]:
    """Return the attempts' ways over the plain hierarchy's, of those that are known."""
    return [
        float(row["path_ratio"])
        for row in rows_of(KEPT / "target-functions.csv")
        if row["training"] == training and float(row["objects"]) >= SELDOM
    ]


def seldom(training: str) -> str:
    """Return which attempts' ways are known from next to nothing, in words."""
    few = [
        f"; attempt {row['attempt']} brings {float(row['objects']) * int(row['worlds']):.0f} "
        f"objects in {row['worlds']} runs, so of its ways little is known, and they do not count"
        for row in rows_of(KEPT / "target-functions.csv")
        if row["training"] == training and 0 < float(row["objects"]) < SELDOM
    ]
    return "".join(few)


def told(training: str) -> str:
    """Return a training's ways in words."""
    found = ratios(training)
    near = sum(one <= DIRECT for one in found)
    return (
        f"ways {in_brackets(interval_of(found))} times the plain hierarchy's on the mean; {near} "
        f"of {len(found)} attempts within {DIRECT:g}{seldom(training)}"
    )


def one_object() -> list[Finding]:
    found, objects = ways("figure-7.2"), interval_of(brought("selecting"))
    return [
        Finding(
            "the robot brings objects home by a variable that holds its target (more than one a "
            "run)",
            "shown with one object",
            f"{in_brackets(objects, '.1f')} objects a run over {len(brought('selecting'))} "
            "attempts, three at a time in the arena, by the network of 9.2.4; the figure's robot "
            f"takes {found[1, False]:.2f} and {found[1, True]:.2f} times the distance to one and "
            f"home; {found_by('figure-7.2', 1)}",
            above(objects, 1.0),
        ),
        Finding(
            "as the original hierarchy does",
            "similar",
            told("selecting"),
            apart="ours is judged with several objects, and has another network (9.2.4)",
        ),
    ]


def three_objects() -> list[Finding]:
    longer = compared(ratios("perceptron"), ratios("selecting"), paired=False).difference
    fewer = compared(brought("selecting"), brought("perceptron"), paired=False).difference
    home = ways("figure-7.3")[2, True]
    return [
        Finding(
            "with three objects the thesis's perceptron goes unnecessary ways (longer ones than "
            "the network that the thesis proposes in its place, 9.2.4)",
            "a loop where it confuses object and drop zone; erratic for some inputs",
            f"{told('perceptron')}; {in_brackets(longer, '+.2f')} to the other network's; "
            f"{in_brackets(fewer, '+.1f')} objects a run",
            above(longer),
            why=not_so(longer),
        ),
        Finding(
            "the network that the thesis proposes instead does not (9.2.4)",
            "left to future work",
            told("selecting"),
            apart="the thesis reports no result of it",
        ),
        Finding(
            f"a loop on the way home with the second object (more than {LOOP:g} times the "
            "distance)",
            "shown",
            f"{home:.2f} times the distance; {found_by('figure-7.3', 3)}",
            home > LOOP,
            why="the robot of our figure has that influence network in place of the perceptron",
        ),
    ]


def budget() -> str:
    networks = {"influence": "selecting", "perceptron": "perceptron"}
    return "; ".join(
        f"{network}: {budget_of(KEPT / 'trainings' / name)}" for network, name in networks.items()
    )


results = (
    Result("figure 7.2", "one target variable, one object", "figure-7.2", one_object,
           "not told", budget, trainings=("selecting", "perceptron"), also=("target-functions",)),
    Result("figure 7.3", "one target variable, three objects", "figure-7.3", three_objects,
           "not told", budget, trainings=("selecting", "perceptron"), also=("target-functions",)),
)  # fmt: skip
