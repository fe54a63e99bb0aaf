"""What the thesis reports of roles learned by reinforcement (8.2), beside ours."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from socialmind.experiments.overview import Finding, Result, rows_of

KEPT = Path(__file__).parent / "results"
ALMOST_ALL = 8
"""Of nine robots."""
LESSON = (
    "our lesson judges the counts of objects alone, in an economy without bodies: robots that "
    "fetch B, B and A in turn keep the ratio without dividing the work, so nothing makes a split "
    "last. What the thesis rewarded it does not tell"
)


def rows() -> list[dict[str, str]]:
    """Return the run of the figure, a row each fifty ticks."""
    return rows_of(KEPT / "figure-8.6.csv")


def collapse() -> list[Finding]:
    in_a = [int(row["in_a"]) for row in rows()]
    in_b = [int(row["in_b"]) for row in rows()]
    robots = int(rows()[0]["robots"])
    high = max(range(len(in_a)), key=lambda place: (in_a[place], -place))
    back = in_a[high]
    for now in in_a[high:]:
        if now > back:
            break
        back = now
    return [
        Finding(
            "step 1, at first all robots take role B",
            "all of 9",
            f"{in_b[0]} of {robots}",
            in_b[0] == robots,
        ),
        Finding(
            "step 2, the payoff sinks and almost all change to A",
            "almost all",
            f"{in_a[high]} of {robots}, at tick {int(rows()[high]['tick']):,}",
            in_a[high] >= ALMOST_ALL,
        ),
        Finding(
            "steps 3 and 4, the payoff of A drops, and a minority remains in it",
            "2 of 9",
            f"down to {back} of {robots} in A before it rises again",
            0 < back < robots / 2,
            why="all of them change in this run; the lesson is ours, in an economy without bodies",
        ),
    ]


def settling() -> list[Finding]:
    off = [float(row["off"]) for row in rows()]
    late = off[3 * len(off) // 4 :]
    changes = [int(row["changes"]) for row in rows()]
    done = changes[-1] - changes[3 * len(changes) // 4]
    robots = int(rows()[0]["robots"])
    again = sum(one < 1 <= other for one, other in pairwise(off))
    return [
        Finding(
            "steps 5 to 7, minority and majority change again, and it collapses again",
            "several cycles",
            f"the wanted split is met and left {again} times",
            again > 1,
        ),
        Finding(
            "step 8, by accident the wanted split is met, and it stays",
            "3 in A, 6 in B, for good",
            f"in the last quarter {sum(one < 1 for one in late) / len(late):.0%} of the records "
            f"have it; {done / robots:.0f} changes of each robot then",
            all(one < 1 for one in late),
            why=LESSON,
        ),
    ]


def budget() -> str:
    from .trainings import ATTEMPTS, LESSONS

    lesson = LESSONS.lesson
    return (
        f"{ATTEMPTS} attempts of {lesson.generations} generations, "
        f"{lesson.settings['population']} individuals in {lesson.repetitions} worlds each, at a "
        "lesson of ours in an economy without bodies"
    )


results = (
    Result("figure 8.6", "roles learned by reinforcement, steps 1 to 4", "figure-8.6", collapse,
           "not told", budget),
    Result("figure 8.7", "steps 5 to 8", "figure-8.6", settling, "not told", budget),
)  # fmt: skip
