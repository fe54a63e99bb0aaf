"""What the thesis reports of roles learned by reinforcement (8.2), beside ours."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from socialmind.experiments.judging import Finding
from socialmind.experiments.overview import Result, rows_of

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


def peaks(in_a: Sequence[int], robots: int) -> list[int]:
    """Return where most robots are in A, once for each time that these are more than half.

    A time ends when all but one, or all, are back in B.

    Args:
        in_a: robots in A, record by record.
        robots: all of them.

    >>> peaks([0, 2, 5, 8, 4, 5, 1, 3, 6, 0, 2], 9)
    [3, 8]
    """
    found: list[int] = []
    high = None
    for place, now in enumerate(in_a):
        if now <= 1 and high is not None:
            found.append(high)
            high = None
        elif 2 * now > robots and (high is None or now > in_a[high]):
            high = place
    return found if high is None else [*found, high]


def collapse() -> list[Finding]:
    first, in_a = rows()[0], [int(row["in_a"]) for row in rows()]
    robots = int(first["robots"])
    high = next(iter(peaks(in_a, robots)), 0)
    back = in_a[high]
    for now in in_a[high:]:
        if now > back:
            break
        back = now
    begun = int(first["changes"]) + int(first["delivered_a"]) + int(first["delivered_b"])
    return [
        Finding(
            "step 1, at first all robots take role B",
            "all of 9",
            f"{first['in_b']} of {robots} at tick {first['tick']}",
            int(first["in_b"]) == robots,
            apart=""
            if begun
            else "by construction: the variable ROLE begins undecided, at 0.5, which counts as B, "
            "and until then nothing is delivered and nobody has changed",
        ),
        Finding(
            f"step 2, the payoff sinks and almost all change to A ({ALMOST_ALL} or more)",
            "almost all",
            f"{in_a[high]} of {robots} the first time that most do, at tick "
            f"{int(rows()[high]['tick']):,}",
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
    in_a, robots = [int(row["in_a"]) for row in rows()], int(rows()[0]["robots"])
    several = peaks(in_a, robots)
    # The first rise is step 2, in figure 8.6.
    again = sum(in_a[place] >= ALMOST_ALL for place in several[1:])
    return [
        Finding(
            "steps 5 to 7, the minority goes back to B, and almost all change to A again "
            f"({ALMOST_ALL} or more)",
            "several cycles",
            f"after the first rise from one in A at most to {ALMOST_ALL} or more {again} "
            f"time{'s' * (again != 1)}, to more than half {len(several) - 1} times",
            again > 1,
            why="in most of its rises fewer than almost all of ours change",
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
    return (
        f"attempt 1 of {attempts()} at a lesson of ours in an economy without bodies, of which the "
        "weights are kept alone; how they were trained is not kept"
    )


def attempts() -> int:
    """Return how many attempts at the lesson of the figure are kept."""
    return sum(row["plan"] == "counts" for row in rows_of(KEPT / "genomes.csv"))


UNKEPT = "their training is not kept"
results = (
    Result("figure 8.6", "roles learned by reinforcement, steps 1 to 4", "figure-8.6", collapse,
           "not told", budget, unkept=UNKEPT),
    Result("figure 8.7", "steps 5 to 8", "figure-8.6", settling, "not told", budget,
           unkept=UNKEPT),
)  # fmt: skip
