"""Skills learned again in the context of the whole task (thesis, 6.2.2).

The robot can collect already. Collect steers, and what it is paid for, objects brought home,
is all that the skills below it are judged by: Avoid alone, as in the thesis, then all of them
together.
"""

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson

LESSONS = load_file(model_folder("collect") / "lessons.py")
BELOW_COLLECT = ("GoToObject", "GoToDropZone", "Avoid", "GoToObject+Avoid", "GoToDropZone+Avoid")


def in_context(name, skill, budget, **settings):
    """Return a lesson of skills that go on from what they know while Collect steers."""
    return Lesson(
        name,
        LESSONS.CollectObjects,
        skill=skill,
        master="Collect",
        repetitions=8,
        generations=1000,
        budget=budget,
        settings={**LESSONS.FINE, **settings},
        start="known",
    )


curriculum = Curriculum(
    (
        in_context("Avoid in context", "Avoid", budget=150_000_000),
        in_context("All in context", BELOW_COLLECT, budget=300_000_000, step=0.5),
    ),
    mind=model_folder("collect") / "mind",
)
