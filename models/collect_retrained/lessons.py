"""Skills learned again in the context of the whole task (thesis, 6.2.2).

The robot can collect already. Collect steers, and what it is paid for, objects brought home,
is all that the skills below it are judged by: Avoid alone, as in the thesis; then Avoid and the two
skills together that choose between it and going somewhere; then all skills below Collect.
"""

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson

LESSONS = load_file(model_folder("collect") / "lessons.py")
CHOICES = ("Avoid", "GoToObject+Avoid", "GoToDropZone+Avoid")
BELOW_COLLECT = ("GoToObject", "GoToDropZone", *CHOICES)
GENTLE = {"step": 0.2, "mutation": 0.1, "narrowing": 0.97}
"""For all skills together: small steps, as little must change in base skills to lose the way."""


def in_context(name, skill, budget, finals=32, **settings):
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
        finals=finals,
    )


curriculum = Curriculum(
    (
        in_context("Avoid in context", "Avoid", budget=150_000_000),
        in_context("Choices in context", CHOICES, budget=300_000_000, finals=96, step=0.5),
        in_context("All in context", BELOW_COLLECT, budget=250_000_000, finals=96, **GENTLE),
    ),
    mind=model_folder("collect") / "mind",
)
