"""A first lesson that is soon over, and a second one that is long."""

from socialmind.learning import Curriculum, Lesson

from .model import Rover

SMALL = {"repetitions": 2, "settings": {"population": 10}, "finalists": 2, "finals": 2}

curriculum = Curriculum(
    (
        Lesson("Short", Rover, skill="Drive", generations=8, **SMALL),
        Lesson("Long", Rover, skill="Drive", generations=200_000, start="known", **SMALL),
    )
)
