"""What the thesis reports of a robot that counts (7.2), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.overview import Finding, Result, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
THESIS = (0.0, 0.1, 0.1, 0.2, 0.0)
"""What VAR_COUNT holds in the five steps."""
WELL = 0.9
"""Share of sequences correct from which on an attempt has learned to count."""


def held() -> list[float]:
    """Return what our robot's variable holds in the five steps."""
    return [float(row["variable"]) for row in rows_of(KEPT / "figure-7.5-memory.csv")]


def step(number: int, what: str) -> Finding:
    """Return the finding about one step."""
    ours = held()[number - 1]
    return Finding(
        f"step {number}, {what}: the variable Count",
        f"{THESIS[number - 1]:g}",
        f"{ours:g}",
        abs(ours - THESIS[number - 1]) < 1e-6,
        why="this robot counts the object when it grips it, not when it delivers it: which "
        "representation comes about is up to the draws, in the thesis as here",
    )


def first_steps() -> list[Finding]:
    return [
        step(1, "it brings the first object"),
        step(2, "it has dropped it"),
        step(3, "it brings the second object"),
        several(),
    ]


def last_steps() -> list[Finding]:
    return [step(4, "it has dropped it"), step(5, "it has validated")]


def several() -> Finding:
    """Return the finding about other attempts."""
    rows = [row for row in rows_of(KEPT / "representations.csv") if row["training"] == "counter"]
    well = [
        row for row in rows if row["correct_sequences"] and float(row["correct_sequences"]) >= WELL
    ]
    kinds = {tuple(value for name, value in row.items() if name.startswith("step")) for row in well}
    return Finding(
        "attempts settle on different representations, equally good",
        "0 → 0.2 → 0 and 0.1 → 0.3 → 0.1",
        f"{len(kinds)} representations among the {len(well)} of {len(rows)} attempts that have "
        f"{WELL:.0%} of their sequences correct or more (`representations`)",
        len(kinds) > 1,
    )


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
    ),
    Result("figure 7.6", "steps 4 and 5", "figure-7.5", last_steps, "not told", budget),
)
