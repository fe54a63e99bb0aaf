"""What the thesis reports of a skill that goes to a target variable (7.1), beside ours."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

from socialmind.experiments.overview import Finding, Result, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
DIRECT = 1.3
"""Ways up to so many times as long as the plain hierarchy's have no loops."""


def ways(figure: str) -> list[float]:
    """Return how long each way of a figure is, over the distance of its ends."""
    legs: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for row in rows_of(KEPT / f"{figure}.csv"):
        place = float(row["x"]), float(row["y"])
        legs.setdefault((row["object"], row["carrying"]), []).append(place)
    return [
        sum(math.dist(one, other) for one, other in pairwise(leg)) / math.dist(leg[0], leg[-1])
        for leg in legs.values()
    ]


def ratios(training: str) -> list[float]:
    """Return the attempts' ways over the plain hierarchy's, of those that deliver anything."""
    rows = rows_of(KEPT / "target-functions.csv")
    found = [float(row["path_ratio"] or "nan") for row in rows if row["training"] == training]
    return [one for one in found if math.isfinite(one)]


def told(training: str) -> str:
    """Return a training's ways in words."""
    found = ratios(training)
    near = sum(one <= DIRECT for one in found)
    return (
        f"ways {sum(found) / len(found):.2f} times the plain hierarchy's on the mean; {near} of "
        f"{len(found)} attempts within {DIRECT:g}"
    )


def one_object() -> list[Finding]:
    found = ways("figure-7.2")
    return [
        Finding(
            "the robot brings one object home by a variable that holds its target",
            "shown",
            f"to it and home, ways of {found[0]:.2f} and {found[1]:.2f} times the distance",
            len(found) == 2,
        ),
        Finding(
            "as the original hierarchy does",
            "similar",
            told("selecting"),
            apart="ours is judged with several objects, and has another network (9.2.4)",
        ),
    ]


def three_objects() -> list[Finding]:
    perceptron = ratios("perceptron")
    return [
        Finding(
            "with three objects the thesis's perceptron confuses object and drop zone",
            "an unnecessary loop; erratic for some inputs",
            told("perceptron"),
            sum(perceptron) / len(perceptron) > DIRECT,
        ),
        Finding(
            "the network that the thesis proposes instead does not (9.2.4)",
            "left to future work",
            told("selecting"),
            max(ratios("selecting")) <= DIRECT,
        ),
        Finding(
            "a loop on the way home with the second object",
            "shown",
            f"ways of {min(ways('figure-7.3')):.2f} to {max(ways('figure-7.3')):.2f} times the "
            "distance",
            max(ways("figure-7.3")) > 2.0,
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
           "not told", budget),
    Result("figure 7.3", "one target variable, three objects", "figure-7.3", three_objects,
           "not told", budget, trainings=("selecting", "perceptron")),
)  # fmt: skip
