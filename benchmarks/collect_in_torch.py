"""The Collect hierarchy written for torch in eager mode, batched over agents.

In 32 bits, as torch has it unless told otherwise, and which is the faster. Agents with a genome
each come in the two ways that torch has for it: batched products of matrices, and `vmap`.
"""

from collections.abc import Callable

import numpy as np
import torch
from collect_hierarchy import LINKS, SENSORS, layers_of
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from socialmind.mind import MindDescription

Layers = dict[str, list[tuple[Tensor, Tensor]]]
Linear = Callable[[Tensor, Tensor, Tensor], Tensor]

# Columns are laid out so that what a skill reads lies side by side and slices are views.
COLUMNS = ["RADDZ", *SENSORS[:11], "VAR_SIN", "RADOBJ", "SENSOBJ", "SENSDZ"]
WAVE = COLUMNS.index("VAR_SIN")


def _slices() -> dict[str, slice]:
    """Return which columns each skill reads."""
    found = {}
    for name, (inputs, _) in LINKS.items():
        first = COLUMNS.index(inputs[0].partition(":")[2])
        read = slice(first, first + len(inputs))
        if COLUMNS[read] != [one.partition(":")[2] for one in inputs]:
            raise ValueError(f"what {name} reads does not lie side by side")
        found[name] = read
    return found


READ = _slices()


class Collect:
    """The hierarchy of many agents.

    Args:
        description: the hierarchy.
        genomes: for each skill the weights, (1, genome size), or (agents, genome size).
        way: "shared" for one genome; "bmm" or "vmap" for one each.
    """

    def __init__(
        self, description: MindDescription, genomes: dict[str, NDArray[np.float64]], way: str
    ) -> None:
        self.way = way
        self.layers: Layers = {
            name: _layers(description, name, one, way) for name, one in genomes.items()
        }
        self.tick = 0

    @torch.inference_mode()
    def step(self, columns: Tensor) -> Tensor:
        """Return the commands of MotL, MotR and EMAG, (agents, 3).

        Args:
            columns: (agents, columns); that of the wave is filled in.
        """
        self.tick += 1
        columns[:, WAVE] = 0.5 + 0.5 * float(np.sin(self.tick))
        if self.way == "shared":
            return _commands(functional.linear, self.layers, columns)
        if self.way == "bmm":
            return _commands(_product, self.layers, columns.unsqueeze(1)).squeeze(1)
        mapped: Tensor = torch.func.vmap(_one_agent)(self.layers, columns)
        return mapped


def _one_agent(layers: Layers, columns: Tensor) -> Tensor:
    return _commands(functional.linear, layers, columns)


def _product(values: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
    return torch.baddbmm(bias, values, weight)


def _perceptron(linear: Linear, layers: list[tuple[Tensor, Tensor]], values: Tensor) -> Tensor:
    for weight, bias in layers[:-1]:
        values = torch.relu(linear(values, weight, bias))
    return linear(values, *layers[-1]).clamp(0.0, 1.0)


def _commands(linear: Linear, layers: Layers, columns: Tensor) -> Tensor:
    """Return the motor commands (thesis, equations 4.2 and 4.3)."""

    def skill(name: str) -> Tensor:
        return _perceptron(linear, layers[name], columns[..., READ[name]])

    collect = skill("Collect")
    to_object = skill("GoToObject+Avoid") * collect[..., 0:1]
    to_zone = skill("GoToDropZone+Avoid") * collect[..., 1:2]
    with_object, with_zone = to_object[..., 0:1], to_zone[..., 0:1]
    avoiding = to_object[..., 1:2] + to_zone[..., 1:2]
    total = with_object + with_zone + avoiding
    weighted = (
        skill("GoToObject") * with_object
        + skill("GoToDropZone") * with_zone
        + skill("Avoid") * avoiding
    )
    wheels = torch.where(total > 0.0, weighted / total, 0.5)
    return torch.cat([wheels, collect[..., 2:3]], dim=-1)


def _layers(
    description: MindDescription, name: str, weights: NDArray[np.float64], way: str
) -> list[tuple[Tensor, Tensor]]:
    """Return the weights and biases of a skill's layers as tensors."""
    found = []
    for first, neurons, sources in layers_of(description.skills[name]):
        rows = weights[:, first : first + neurons * (sources + 1)]
        rows = torch.tensor(rows, dtype=torch.float32).reshape(-1, neurons, sources + 1)
        weight, bias = rows[..., :-1], rows[..., -1]
        if way == "shared":
            weight, bias = weight[0], bias[0]
        elif way == "bmm":
            weight, bias = weight.transpose(1, 2), bias.unsqueeze(1)
        found.append((weight.contiguous(), bias.contiguous()))
    return found


def columns_of(values: NDArray[np.float64]) -> Tensor:
    """Return sensor values, in the order of `SENSORS`, as the columns of `step`."""
    columns = torch.zeros((len(values), len(COLUMNS)))
    for place, name in enumerate(SENSORS):
        columns[:, COLUMNS.index(name)] = torch.tensor(values[:, place], dtype=torch.float32)
    return columns
