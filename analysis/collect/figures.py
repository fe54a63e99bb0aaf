"""Figures 6.2 to 6.5: what the best individual of each generation came to, a line an attempt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.learning import Training

NEAR = 0.05
"""Of what it comes to in the end, within which an attempt counts as having reached it."""
END = 10
"""The part of a curve, one in so many generations, whose mean is what it comes to in the end."""
EARLY = 100
"""The generation by which the thesis finds most attempts of base skills at their maximum."""
FELL_SHORT = 0.75
"""Of the median attempt's score, below which an attempt counts as one that failed."""
WORLDS = 128
"""In which winners are judged once more: the same for all attempts, and used for nothing else.
Those of the finals chose the winner, and are others for each attempt."""

Judged = Mapping[tuple[int, str], float]
"""What winners come to in those worlds, by attempt and lesson."""


@dataclass(frozen=True)
class Curves:
    """A figure: lessons' curves.

    Attributes:
        name: of the study.
        plans: the trainings; of an attempt that several have made, the longest curve is shown.
        panels: for each, the lesson and the column of its curve.
        thesis: what the thesis says of its own.
        generations: that each attempt has in the thesis.
        beside: lessons that have no panel, and whose winners are told of all the same.
    """

    name: str
    plans: tuple[str, ...]
    panels: tuple[tuple[str, str], ...]
    thesis: str
    generations: int
    beside: tuple[str, ...] = ()

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
        ("GoToObject", "GoToDropZone", "Avoid", "Collect"),
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


def attempts_of(
    curves: pd.DataFrame, trainings: Mapping[str, Training], judged: Mapping[str, Judged]
) -> list[dict[str, Any]]:
    """Return a row for each attempt at a lesson: how far it came, and when it was near its best.

    Where a curve was validated, that says so on common worlds; otherwise the scores of training,
    which are from other worlds in each generation.

    Args:
        curves: as `curves_of` gives them.
        trainings: by plan.
        judged: what winners come to in the worlds that all share, by plan.
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
                "shared": round(judged[plan][attempt, lesson], 4),
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


def short_of(scores: Sequence[float], usual: float | None = None) -> list[bool]:
    """Return which attempts failed, by what their winners come to.

    Args:
        scores: of the attempts.
        usual: what is to be come near to; the attempts' own median by default.

    >>> short_of([4.0, 4.0, 2.9]), short_of([4.0, 4.0, 2.9], usual=6.0)
    ([False, False, True], [True, True, True])
    """
    least = FELL_SHORT * float(np.median(scores) if usual is None else usual)
    return [one < least for one in scores]


def length_of(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return how many generations attempts have, the fewest to the most.

    >>> length_of([{"generations": 60}, {"generations": 1200}])
    '60 to 1,200'
    """
    each = sorted({row["generations"] for row in rows})
    return f"{each[0]:,}" + (f" to {each[-1]:,}" if each[1:] else "")
