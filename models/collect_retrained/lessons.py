"""Avoid learned anew in the context of the whole task (thesis, 6.2.2).

The robot can collect already. Collect steers, and what it is paid for, objects brought home,
is all that the new Avoid is judged by.
"""

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson

LESSONS = load_file(model_folder("collect") / "lessons.py")

curriculum = Curriculum(
    (
        Lesson(
            "Avoid in context",
            LESSONS.CollectObjects,
            skill="Avoid",
            master="Collect",
            repetitions=8,
            generations=1000,
            budget=200_000_000,
            settings=LESSONS.FINE,
        ),
    ),
    mind=model_folder("collect") / "mind",
)
