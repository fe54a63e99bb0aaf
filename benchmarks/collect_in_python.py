"""The Collect hierarchy written by hand in plain Python: one object an agent, lists of weights."""

import math
from operator import mul

from collect_hierarchy import layers_of
from numpy.typing import NDArray

from socialmind.mind import MindDescription

Layer = list[tuple[list[float], float]]


class Robot:
    """One agent.

    Args:
        description: the hierarchy.
        genomes: for each skill its weights.
    """

    def __init__(self, description: MindDescription, genomes: dict[str, NDArray]) -> None:
        self.tick = 0
        layers = {name: _layers(description, name, one) for name, one in genomes.items()}
        self.go_to_object = layers["GoToObject"]
        self.go_to_zone = layers["GoToDropZone"]
        self.avoid = layers["Avoid"]
        self.object_or_avoid = layers["GoToObject+Avoid"]
        self.zone_or_avoid = layers["GoToDropZone+Avoid"]
        self.collect = layers["Collect"]

    def step(self, sensors: list[float]) -> tuple[float, float, float]:
        """Return the commands of MotL, MotR and EMAG for sensors in the order of `SENSORS`."""
        self.tick += 1
        near = [*sensors[:11], 0.5 + math.sin(self.tick) / 2.0]
        to_object, to_zone, in_reach, in_zone = sensors[11:]
        first, second, claw = perceptron(self.collect, [in_reach, in_zone])
        left = right = total = avoiding = 0.0
        if first > 0.0:
            going, avoided = perceptron(self.object_or_avoid, [*near, to_object])
            avoiding += first * avoided
            if going > 0.0:
                influence = first * going
                one, other = perceptron(self.go_to_object, [to_object])
                left += one * influence
                right += other * influence
                total += influence
        if second > 0.0:
            going, avoided = perceptron(self.zone_or_avoid, [to_zone, *near])
            avoiding += second * avoided
            if going > 0.0:
                influence = second * going
                one, other = perceptron(self.go_to_zone, [to_zone])
                left += one * influence
                right += other * influence
                total += influence
        if avoiding > 0.0:
            one, other = perceptron(self.avoid, near)
            left += one * avoiding
            right += other * avoiding
            total += avoiding
        if total > 0.0:
            return left / total, right / total, claw
        return 0.5, 0.5, claw


def perceptron(layers: list[Layer], values: list[float]) -> list[float]:
    """Return the outputs of a perceptron; `sum(map(mul))` is the quickest way without numpy."""
    for layer in layers[:-1]:
        values = [max(0.0, sum(map(mul, weights, values), bias)) for weights, bias in layer]
    return [
        min(1.0, max(0.0, sum(map(mul, weights, values), bias))) for weights, bias in layers[-1]
    ]


def _layers(description: MindDescription, name: str, genome: NDArray) -> list[Layer]:
    made = []
    for first, neurons, sources in layers_of(description.skills[name]):
        rows = genome[first : first + neurons * (sources + 1)].reshape(neurons, sources + 1)
        made.append([(row[:-1].tolist(), float(row[-1])) for row in rows])
    return made
