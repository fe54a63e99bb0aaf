"""Minds that begin with building blocks: the strategies are there, which one counts when evolves.

Ferrante et al. (2015) find that an optimal mix of specialists comes about most readily where the
behaviours for the parts of a task are there beforehand. Here they are skills below Forage, which
gives each its influence by place, load and behaviour; what their commands come to is weighted by
it (thesis, equation 4.3).
"""

import numpy as np
from numpy.typing import NDArray

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum
from socialmind.mind import MindDescription, Perceptron, Skill

LESSONS = load_file(model_folder("task_partitioning") / "lessons.py")
FUNCTION = Perceptron(layers=0)

Rules = dict[str, dict[str, float]]
SEARCH_SOURCE: Rules = {
    "Phototaxis": {"": 1.0, "LADEN": -2.0, "SOURCE": -2.0},
    "Antiphototaxis": {"LADEN": 1.0},
    "RandomWalk": {"SOURCE": 1.0, "LADEN": -2.0},
    "PickUp": {"SOURCE": 1.0},
}
"""Commands as sums of sensors, "" being 1 always; what is below 0 or above 1 is held to that."""
SEARCH_CACHE: Rules = {
    "Phototaxis": {"NEST": 1.0, "LADEN": -2.0},
    "Antiphototaxis": {"SLOPE": 1.0, "SOURCE": 1.0, "LADEN": 1.0},
    "RandomWalk": {"CACHE": 1.0, "LADEN": -2.0},
    "PickUp": {"CACHE": 1.0},
}


def blocks(gradient: float) -> dict[str, Rules]:
    """Return what each strategy of the model's `programmed.py` does, by its name.

    Args:
        gradient: of the slope; on flat ground droppers go on to the cache.
    """
    let_go = "SLOPE" if gradient > 0 else "CACHE"
    return {
        "Generalist": SEARCH_SOURCE | {"Drop": {"NEST": 1.0}},
        "Dropper": SEARCH_SOURCE | {"Drop": {let_go: 1.0}},
        "Collector": SEARCH_CACHE | {"Drop": {"NEST": 1.0}},
    }


def genome_of(rules: Rules) -> NDArray[np.float64]:
    """Return the weights of a perceptron without hidden layers that does as rules say."""
    sources = (*LESSONS.SENSORS, "")  # the bias stands last
    return np.array(
        [rules[one].get(source, 0.0) for one in LESSONS.ACTUATORS for source in sources]
    )


def mind_of_blocks(gradient: float) -> MindDescription:
    """Return a mind whose strategies are known and whose Forage is not learned yet.

    Args:
        gradient: of the slope, 0 … 1; 0 for flat ground.
    """
    reads = [f"SE:{one}" for one in LESSONS.SENSORS]
    commands = [f"MO:{one}" for one in LESSONS.ACTUATORS]
    known = [
        Skill(name, reads, commands, FUNCTION, genome=genome_of(rules))
        for name, rules in blocks(gradient).items()
    ]
    forage = Skill(LESSONS.MASTER, reads, [f"SK:{one.name}" for one in known], FUNCTION)
    return MindDescription("forager", LESSONS.SENSORS, LESSONS.ACTUATORS, skills=[forage, *known])


def lessons_of_blocks(gradient: float) -> Curriculum:
    """Return the lessons from primitives for a mind with building blocks, of fewer generations.

    Args:
        gradient: of the slope, 0 … 1; 0 for flat ground.
    """
    find, refine = LESSONS.lessons(gradient).lessons
    return Curriculum(
        (find.changed(generations=3), refine.changed(generations=40)),
        mind=mind_of_blocks(gradient),
    )
