"""What the thesis reports of a robot that counts (7.2), beside ours."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from socialmind.experiments.judging import Finding, looked_through
from socialmind.experiments.overview import Result, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
THESIS = (0.0, 0.1, 0.1, 0.2, 0.0)
"""What VAR_COUNT holds in the five steps."""
WELL = 0.9
"""Share of sequences correct from which on an attempt has learned to count."""
AS_GOOD = 0.9
"""Of the sequences a run of the best attempt, from which on an attempt is as good as that one."""


def sequence() -> list[dict[str, str]]:
    """Return the five steps of our robot, and what its variable holds in them."""
    return rows_of(KEPT / "figure-7.5-memory.csv")


def found_by() -> str:
    """Return how the run of the steps was come by."""
    from .steps import SEEDS

    run = looked_through(SEEDS, int(sequence()[0]["seed"]))
    return f", in a run that was searched for a correct sequence, whatever Count holds: {run}"


def step(number: int, what: str, found: str = "") -> Finding:
    """Return the finding about one step.

    Args:
        number: of the step.
        what: the robot does.
        found: how the run was come by, told once a figure.
    """
    ours = float(sequence()[number - 1]["variable"])
    return Finding(
        f"step {number}, {what}: the variable Count",
        f"{THESIS[number - 1]:g}",
        f"{ours:g}{found}",
        abs(ours - THESIS[number - 1]) < 1e-6,
        why="this robot counts the object when it grips it, not when it delivers it: which "
        "representation comes about is up to the draws, in the thesis as here",
    )


def first_steps() -> list[Finding]:
    return [
        step(1, "it brings the first object", found_by()),
        step(2, "it has dropped it"),
        step(3, "it brings the second object"),
        several(),
    ]


def last_steps() -> list[Finding]:
    return [step(4, "it has dropped it", found_by()), step(5, "it has validated")]


def several() -> Finding:
    """Return the finding about other attempts."""
    rows = [row for row in rows_of(KEPT / "representations.csv") if row["training"] == "counter"]
    best = max(float(row["sequences"]) for row in rows)
    good = [row for row in rows if is_good(row, best)]
    kinds = Counter(
        tuple(value for name, value in row.items() if name.startswith("step")) for row in good
    )
    each = " and ".join(str(count) for count in sorted(kinds.values(), reverse=True))
    return Finding(
        "attempts settle on different representations, equally good",
        "0 → 0.2 → 0 and 0.1 → 0.3 → 0.1",
        f"{len(good)} of {len(rows)} attempts come within {1 - AS_GOOD:.0%} of the best one's "
        f"{best:.2f} correct sequences a run, and have {WELL:.0%} of their sequences correct or "
        f"more; among these are {len(kinds)} representations, in {each} attempts "
        "(`representations`)",
        len(kinds) > 1,
    )


def is_good(row: dict[str, str], best: float) -> bool:
    """Return whether an attempt counts, and does so about as often as the best one.

    Args:
        row: of the attempt.
        best: correct sequences a run of the best attempt.
    """
    share = float(row["correct_sequences"] or "nan")
    return share >= WELL and float(row["sequences"]) >= AS_GOOD * best


def budget() -> str:
    return budget_of(KEPT / "trainings" / "counter")


results = (
    Result(
        "figure 7.5",
        "a robot that counts, steps 1 to 3",
        "figure-7.5",
        first_steps,
        "not told",
        budget,
        trainings=("counter",),
        also=("representations",),
    ),
    Result(
        "figure 7.6",
        "steps 4 and 5",
        "figure-7.5",
        last_steps,
        "not told",
        budget,
        trainings=("counter",),
    ),
)
