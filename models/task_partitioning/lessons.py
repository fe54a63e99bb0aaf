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


def lessons(gradient: float) -> Curriculum:
    """Return the lessons on a slope: a genetic algorithm finds a beginning, CMA-ES goes on with it.

    Most minds drawn at random bring nothing home, and where no mind of a generation does there is
    nothing to select. The first lesson therefore judges many, each once; the second takes its time
    for few.

    Args:
        gradient: of the slope, 0 … 1; 0 for flat ground.
    """
    place = {"gradient": gradient}
    return Curriculum(
        (
            Lesson(
                "Find", TaskPartitioning, skill=MASTER, parameters=place, generations=12,
                repetitions=1, finalists=4, finals=8,
                settings={
                    "population": 100, "selected": 0.2, "elite": 2, "mutation": 0.1, "step": 0.5,
                },
            ),
            Lesson(
                "Refine", TaskPartitioning, skill=MASTER, parameters=place, generations=100,
                repetitions=2, finalists=6, finals=16, optimiser="CMAES", start="known",
                spread=0.3, settings={"population": 16},
            ),
        ),
        mind=MIND,
    )  # fmt: skip


curriculum = lessons(1.0)
