"""A plan of some lessons of `collect` that take no time."""

from dataclasses import replace
from pathlib import Path

from socialmind.experiments.trainings.plans import TrainingPlan
from socialmind.learning import Curriculum, Cycle
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

LESSONS = load_file(model_folder("collect") / "lessons.py")
CONTROLS = Path(__file__).parents[3] / "analysis" / "collect" / "controls.py"
SETTINGS = {"population": 6, "elite": 1}


def mind():
    """The mind that the plan begins from."""
    return load_file(CONTROLS).hierarchy()


def monolith():
    """Another mind than the plan's."""
    return load_file(CONTROLS).monolith()


def tiny(*names, generations=4):
    """Return a plan of two attempts at lessons of these names."""
    lessons = [
        replace(
            one, ticks=40, repetitions=1, generations=generations, finals=2, settings=SETTINGS,
            budget=None,
        )
        for one in LESSONS.curriculum.items
        if one.name in names
    ]  # fmt: skip
    return TrainingPlan("tiny", 2, mind, lambda: Curriculum(lessons), "collect", 6)


PLAN = tiny("GoToObject", "GoToDropZone")


def turned(cycles):
    """Return a plan of one attempt at its lessons in turn."""
    cycle = Cycle(PLAN.curriculum().lessons, cycles=cycles)
    return replace(PLAN, attempts=1, curriculum=lambda: Curriculum([cycle]))
