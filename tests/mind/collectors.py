"""A small mind that collects, and what shows of its runs."""

import numpy as np
import pytest
from random_minds import bits

from socialmind.errors import ModelError
from socialmind.mind import Elman, Hierarchy, MindDescription, Perceptron, Skill

SENSORS = ["SeesObject", "SeesBase", "Wall", "Holds", "Enemy"]


def collector():
    """The mind of figure 6.1, in small: Collect over GoToObject, GoToBase and Avoid."""
    motors = ["MO:MotL", "MO:MotR"]
    skills = [
        Skill("Collect", ["SE:SeesObject", "SE:Holds", "VA:Phase", "SD:Wall"],
              ["SK:GoToObject", "SK:GoToBase", "SK:Avoid", "VA:Phase"], Perceptron(1)),
        Skill("GoToObject", ["SE:SeesObject", "SH:SeesObject:2"], motors, Perceptron(1)),
        Skill("GoToBase", ["SE:SeesBase"], motors, Elman(1)),
        Skill("Avoid", ["SE:Wall"], motors, Perceptron(1, "sigmoid")),
    ]  # fmt: skip
    description = MindDescription(
        "collector", SENSORS, ["MotL", "MotR", "Claw"], ["Phase", "Alert"], skills
    )
    made = Hierarchy(description)
    made.randomise(6)
    return made


def values(ticks=12, seed=0, names=SENSORS):
    rng = np.random.default_rng(seed)
    for _ in range(ticks):
        yield {
            name: float(value) for name, value in zip(names, rng.random(len(names)), strict=True)
        }


def run(hierarchy, ticks=12, seed=0):
    """Everything that shows of a run, to the last bit."""
    seen = []
    for sensed in values(ticks, seed, list(hierarchy.description.sensors)):
        motors = hierarchy.evaluate(sensed)
        tables = (motors, hierarchy.variables(), hierarchy.influences(), hierarchy.outputs())
        seen.append([bits(table) for table in tables])
    return seen


def weights_of(hierarchy):
    return {
        name: hierarchy.skill(name).genome.tobytes()
        for name in hierarchy.skills
        if hierarchy.skill(name).genome is not None
    }


def refused(call, *words, kind=ModelError):
    with pytest.raises(kind) as raised:
        call()
    message = str(raised.value)
    assert "\n" not in message
    for word in words:
        assert word in message
    return message
