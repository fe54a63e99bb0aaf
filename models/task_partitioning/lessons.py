"""How the robots' mind evolves: by what the whole group brings home, and by nothing else.

All robots of a group have the same mind (thesis, 5.3). What they are told is where they are,
whether they have an item and what they are doing; what to make of it is left to them.
"""

from socialmind.learning import Curriculum, Lesson
from socialmind.mind import MindDescription, Perceptron, Skill

from .model import BEHAVIOURS, MASTER, PLACES, TaskPartitioning

SENSORS = (*PLACES, "LADEN", "PHOTOTAXIS", "ANTIPHOTOTAXIS", "RANDOM_WALK")
ACTUATORS = (*BEHAVIOURS, "PickUp", "Drop")
FUNCTION = Perceptron(layers=0)

MIND = MindDescription(
    "forager",
    sensors=list(SENSORS),
    actuators=list(ACTUATORS),
    skills=[
        Skill(
            MASTER, [f"SE:{one}" for one in SENSORS], [f"MO:{one}" for one in ACTUATORS], FUNCTION
        )
    ],
)


def lesson(gradient: float) -> Lesson:
    """Return the lesson on a slope.

    Args:
        gradient: of the slope, 0 … 1; 0 for flat ground.
    """
    return Lesson(
        MASTER,
        TaskPartitioning,
        parameters={"gradient": gradient},
        generations=60,
        repetitions=2,
        settings={
            "population": 100, "selected": 0.2, "elite": 2,
            "mutation": 0.1, "step": 0.5, "narrowing": 0.98,
        },
        finalists=6,
        finals=16,
    )  # fmt: skip


curriculum = Curriculum((lesson(1.0),), mind=MIND)
