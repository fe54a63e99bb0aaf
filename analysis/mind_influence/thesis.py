"""What the thesis reports of influence while going round an obstacle (6.1.3), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.judging import NO_SAY, Finding, looked_through
from socialmind.experiments.overview import Result, row_of
from socialmind.learning.training.course import curriculum_of
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder

KEPT = Path(__file__).parent / "results"


def sent(step: int, skill: str) -> float:
    """Return the influence of a skill in a step."""
    return float(row_of(KEPT / "figure-6.6.csv", step=str(step))[skill])


def avoiding(step: int) -> float:
    """Return Avoid's part of what GoToObject and Avoid receive in a step."""
    total = sent(step, "GoToObject") + sent(step, "Avoid")
    return sent(step, "Avoid") / total if total else 0.0


def found_by() -> str:
    """Return how the run of the figure was come by."""
    from .trained import ALONE, LASTS, SEEDS, SHARED

    run = looked_through(SEEDS, int(row_of(KEPT / "figure-6.6.csv", step="1")["seed"]))
    return (
        f"runs were searched for one in which, on the way to an object, Avoid's part is {SHARED:g} "
        f"or less, then {ALONE:g} or more for {LASTS} ticks at least, then {SHARED:g} or less "
        f"again: {run}"
    )


def steps() -> list[Finding]:
    parts = [avoiding(step) for step in range(1, 5)]
    zone, goal = sent(5, "GoToDropZone+Avoid"), sent(5, "GoToObject+Avoid")
    return [
        Finding(
            "step 1, approaching: the influence goes to GoToObject",
            "exclusively",
            f"Avoid's part is {parts[0]:.2f}; {found_by()}",
            parts[0] <= NO_SAY,
            why="this robot keeps Avoid beside GoToObject, where it adds to moveForward "
            f"({sent(1, 'moveForward'):.2f}) and hardly turns ({sent(1, 'turnLeft'):.2f}): its "
            "training asked for no more",
        ),
        Finding(
            "step 2, too close to the obstacle: it goes to Avoid",
            "exclusively",
            f"Avoid's part is {parts[1]:.2f}",
            apart="the run was searched for one in which it does, as told in step 1",
        ),
        Finding(
            "steps 3 and 4, distance recovered, front clear: it goes back to GoToObject",
            "Avoid less and less, GoToObject 0.16 at first",
            f"Avoid's part is {parts[2]:.2f}, then {parts[3]:.2f}",
            parts[1] > parts[2] > parts[3],
            why="beside GoToObject this robot gives Avoid at once as much as in step 1, and "
            "afterwards no less",
        ),
        Finding(
            "step 5, object picked up: Collect sends all to GoToDropZone+Avoid",
            "exclusively",
            f"GoToDropZone+Avoid {zone:.2f}, GoToObject+Avoid {goal:.2f}",
            zone >= 1 - NO_SAY and goal <= NO_SAY,
            why="another training: as influence counts relative to what else there is, most is as "
            "good as all",
        ),
        Finding(
            "and it keeps Avoid active where GoToObject+Avoid would not",
            "shown",
            f"Avoid {sent(5, 'Avoid'):.2f}, {sent(1, 'Avoid'):.2f} in step 1",
            sent(5, "Avoid") > max(sent(1, "Avoid"), NO_SAY),
            why="another training: what this robot's GoToDropZone+Avoid does beside obstacles is "
            "its own",
        ),
    ]


def budget() -> str:
    lessons = curriculum_of("collect")[0].lessons
    known = MindDescription.load(model_folder("collect") / "mind_constant")
    taught = [one for one in lessons if known.skill(one.name).genome is not None]
    generations = sum(one.generations for one in taught)
    return (
        f"one training, not compared with others: {len(taught)} lessons of `collect`, "
        f"{generations:,} generations"
    )


results = (
    Result("figure 6.6", "a robot on constant base skills goes round an obstacle", "figure-6.6",
           steps, "not told", budget),
)  # fmt: skip
