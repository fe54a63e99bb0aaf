"""The Collect hierarchy of thesis figure 6.1, as a mind to measure.

The thesis's text gives the six skills, two hidden layers by equation 5.1 and 1,510 weights in all;
the sensors of the figure are read from sections 5.3.1, 6.1 and 7.1.2:

| skill | reads | commands or influences |
|---|---|---|
| GoToObject | the object's orientation | MotL, MotR |
| GoToDropZone | the drop zone's orientation | MotL, MotR |
| Avoid | 10 range finders, movement, a wave generator | MotL, MotR |
| GoToObject+Avoid | what Avoid reads, the object's orientation | GoToObject, Avoid |
| GoToDropZone+Avoid | what Avoid reads, the drop zone's orientation | GoToDropZone, Avoid |
| Collect | is an object in the claw's reach, is the robot in the zone | both of these, the claw |

That makes 1,525 weights and biases.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from socialmind.mind import MindDescription, Skill, Variable, Wave
from socialmind.mind.functions.perceptron import Perceptron

MASTER = "Collect"
WAVE = "VAR_SIN"
AROUND = [*(f"S{number}" for number in range(1, 11)), "DOF"]
SENSORS = [*AROUND, "RADOBJ", "RADDZ", "SENSOBJ", "SENSDZ"]
ACTUATORS = ["MotL", "MotR", "EMAG"]

_WHEELS = ["MO:MotL", "MO:MotR"]
_NEAR = [*(f"SE:{name}" for name in AROUND), f"VA:{WAVE}"]
LINKS: dict[str, tuple[list[str], list[str]]] = {
    "GoToObject": (["SE:RADOBJ"], _WHEELS),
    "GoToDropZone": (["SE:RADDZ"], _WHEELS),
    "Avoid": (_NEAR, _WHEELS),
    "GoToObject+Avoid": ([*_NEAR, "SE:RADOBJ"], ["SK:GoToObject", "SK:Avoid"]),
    "GoToDropZone+Avoid": (["SE:RADDZ", *_NEAR], ["SK:GoToDropZone", "SK:Avoid"]),
    "Collect": (
        ["SE:SENSOBJ", "SE:SENSDZ"],
        ["SK:GoToObject+Avoid", "SK:GoToDropZone+Avoid", "MO:EMAG"],
    ),
}
"""The inputs and outputs of each skill."""


def collect_hierarchy(layers: int = 2, added: int = 2) -> MindDescription:
    """Return the hierarchy, without weights.

    Args:
        layers: hidden layers of each skill.
        added: neurons that each has more than equation 5.1's max(inputs, outputs).
    """
    function = Perceptron(layers, added=added)
    skills = [Skill(name, *links, function) for name, links in LINKS.items()]
    variables = [Variable(WAVE, Wave())]
    return MindDescription("Collect", SENSORS, ACTUATORS, variables, skills)


def size(description: MindDescription) -> int:
    """Return how many weights all skills have."""
    return sum(skill.genome_size for skill in description.skills.values())


def genomes(description: MindDescription, count: int, seed: int) -> dict[str, NDArray[np.float64]]:
    """Return weights for some agents, (count, genome size) for each skill.

    Hidden weights are drawn from [-1, 1] over the root of a neuron's inputs. The output neurons are
    biased to 0.5, so that nearly all skills receive influence and none can be left out.
    """
    generator = np.random.default_rng(seed)
    drawn = {}
    for name, skill in description.skills.items():
        weights = generator.uniform(-1.0, 1.0, (count, skill.genome_size))
        for first, neurons, sources in layers_of(skill):
            one = weights[:, first : first + neurons * (sources + 1)]
            one /= np.sqrt(sources + 1)
            last = one.reshape(count, neurons, sources + 1)
        last[:, :, -1] = 0.5
        drawn[name] = weights
    return drawn


def layers_of(skill: Skill) -> list[tuple[int, int, int]]:
    """Return each layer's first place in the genome, its neurons and what each of them reads."""
    function = skill.function
    if not isinstance(function, Perceptron):
        raise TypeError(f"the skill {skill.name!r} is no perceptron")
    size = max(len(skill.inputs), len(skill.outputs)) + function.added
    counts = [len(skill.inputs), *[size] * function.layers, len(skill.outputs)]
    found, place = [], 0
    for sources, neurons in pairwise(counts):
        found.append((place, neurons, sources))
        place += neurons * (sources + 1)
    return found


def sensor_values(agents: int, seed: int) -> NDArray[np.float64]:
    """Return values for the sensors in the order of `SENSORS`, (agents, sensors)."""
    return np.random.default_rng(seed).random((agents, len(SENSORS)))
