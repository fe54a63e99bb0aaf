"""What the thesis reports of robots that forage together (8.1), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.judging import MOST, NO_SAY, Finding, in_brackets, looked_through
from socialmind.experiments.measures.intervals import Interval
from socialmind.experiments.overview import Result, row_of, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
MOVING = ("Search+Avoid", "ReachSignal", "Collect", "Idle")


def sent(step: int, skill: str) -> float:
    """Return the influence of a skill in a step."""
    return float(row_of(KEPT / "figure-8.3.csv", step=str(step))[skill])


def part(step: int, skill: str) -> float:
    """Return a skill's part of the influence on those that move the robot in a step."""
    return sent(step, skill) / (sum(sent(step, one) for one in MOVING) or 1.0)


def found_by() -> str:
    """Return how the run of the steps was come by."""
    from .steps import SEEDS

    run = looked_through(SEEDS, int(row_of(KEPT / "figure-8.3.csv", step="1")["seed"]))
    return (
        "by their sensors alone runs were searched for a robot that sees objects, grips one, "
        f"leaves their sight, delivers it, hears a signal and sees objects again: {run}"
    )


def several(step: int, *skills: str) -> str:
    """Return the influence of skills in a step, in words, with their parts of it where they move.

    Args:
        step: which.
        skills: which.
    """
    return ", ".join(f"{one} {sent(step, one):.2f} ({part(step, one):.0%})" for one in skills)


def first_steps() -> list[Finding]:
    idle = max(part(step, "Idle") for step in range(1, 9))
    return [
        Finding(
            "step 1, before it sees objects: Search+Avoid at its maximum, no other has a say",
            "maximum intensity; that of ReachSignal, very low, has no impact",
            f"{several(1, 'Search+Avoid', 'ReachSignal', 'Collect')} of what those that move it "
            f"receive; {found_by()}",
            part(1, "Search+Avoid") >= 1 - NO_SAY,
            why="this robot, another training, gives Collect all as well before it sees an object; "
            "ReachSignal, the one that the thesis tells of, has no say",
        ),
        Finding(
            "step 2, it sees an object: Collect in majority",
            "Search+Avoid remains partially active",
            several(2, "Collect", "Search+Avoid"),
            part(2, "Collect") > MOST and part(2, "Search+Avoid") > NO_SAY,
            why="this robot, another training, stops searching when it sees an object",
        ),
        Finding(
            "step 3, it has gripped it: Collect completely, Search+Avoid not",
            "Search+Avoid disabled",
            several(3, "Collect", "Search+Avoid", "Idle"),
            part(3, "Collect") >= 1 - NO_SAY and part(3, "Search+Avoid") <= NO_SAY,
            why="Search+Avoid has no say here either, but Idle has: this robot waits while its "
            "signal can be heard",
        ),
        Finding(
            "step 4, out of sight of the objects, where its signal ends: Collect brings it home",
            "without disturbance",
            several(4, "Collect"),
            part(4, "Collect") >= 1 - NO_SAY,
        ),
        Finding(
            "Idle is not used",
            "not at all",
            f"up to {idle:.0%} of the influence in these steps",
            idle <= NO_SAY,
            why="waiting while it carries the object lets a robot emit its signal for longer "
            "before the cluster is out of its sight; how far robots see and hear in the thesis it "
            "does not say",
        ),
    ]


def brought(**values: str) -> Interval:
    """Return a row of objects of the kept table."""
    row = row_of(KEPT / "foraging.csv", measure="objects", **values)
    return Interval(*(float(row[name]) for name in ("mean", "low", "high")))


def last_steps() -> list[Finding]:
    ticks = [int(row["tick"]) for row in rows_of(KEPT / "figure-8.3.csv")]
    fewer = brought(robots="no signals", compared="foraging together")
    together, deaf = (
        brought(robots=one, compared="").mean for one in ("foraging together", "no signals")
    )
    return [
        Finding(
            "step 5, it has delivered: Collect ends, search and reaching the signal begin",
            "Search+Avoid and ReachSignal enabled",
            f"{several(5, 'Collect', 'Search+Avoid', 'ReachSignal')}; {found_by()}",
            part(5, "Collect") <= NO_SAY < min(part(5, "Search+Avoid"), part(5, "ReachSignal")),
            why="this robot, another training, follows the signal alone as long as it hears one",
        ),
        Finding(
            "steps 6 and 7, it turns to a signal and nears it: ReachSignal is used",
            "shown",
            f"{several(6, 'ReachSignal')} and {several(7, 'ReachSignal')}; influence was not "
            "searched for",
            min(part(6, "ReachSignal"), part(7, "ReachSignal")) > NO_SAY,
        ),
        Finding(
            "step 8, it sees objects again",
            "shown",
            f"{ticks[7] - ticks[4]:,} ticks after it has delivered",
            apart="the run was searched for one in which it does, as told in step 5",
        ),
        Finding(
            "what signals bring: objects home with them and without",
            "not told; other robots are attracted by the signal (step 3)",
            f"{together:.1f} objects, {deaf:.1f} without signals: {in_brackets(fewer, '+.1f')}",
            apart="the thesis counts no objects here, and compares with no robots without signals",
        ),
    ]


def budget() -> str:
    return budget_of(KEPT / "trainings" / "foraging")


results = (
    Result("figure 8.3", "a robot that forages with others, steps 1 to 4", "figure-8.3",
           first_steps, "not told", budget, trainings=("foraging",)),
    Result("figure 8.4", "steps 5 to 8", "figure-8.3", last_steps, "not told", budget,
           trainings=("foraging",), also=("foraging-table",)),
)  # fmt: skip
