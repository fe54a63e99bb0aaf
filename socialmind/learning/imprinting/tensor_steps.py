"""The steps of a network over tensors: each fills one block of nodes for a whole batch.

A block is a tensor of shape (batch, nodes of the block); block 0 holds the inputs. Where each node
lies is known when the twin is built, so that evaluating it is a row of tensor operations.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from socialmind.learning.imprinting.pytorch import torch
from socialmind.learning.imprinting.tensor_activations import activate, aggregate
from socialmind.mind.functions import network as forms

Tensor = torch.Tensor
Places = Mapping[int, tuple[int, int]]
"""The (block, column) of each node."""
Runs = tuple[tuple[int, int, int], ...]
"""Columns as runs (block, first, last + 1)."""


class Evaluation:
    """One evaluation of a batch, while it goes on.

    Attributes:
        blocks: the blocks filled so far.
        linear: the blocks of clamped neurons before clamping, by their number.
        genome: the weights, shape (genome size,).
        memory: what was remembered, shape (batch, memory).
        clamp: whether gradients are those of the clamped values; if not, clamps within the network
            let them through.
    """

    def __init__(self, inputs: Tensor, genome: Tensor, memory: Tensor, clamp: bool) -> None:
        self.blocks = [inputs]
        self.linear: dict[int, Tensor] = {}
        self.genome = genome
        self.memory = memory
        self.clamp = clamp

    def read(self, runs: Runs, linear: bool = False) -> Tensor:
        """Return nodes side by side, shape (batch, nodes); before clamping if `linear`."""
        parts = []
        for number, first, end in runs:
            block = self.linear.get(number) if linear else None
            parts.append((self.blocks[number] if block is None else block)[:, first:end])
        if not parts:
            return self.blocks[0][:, :0]
        return parts[0] if len(parts) == 1 else torch.cat(parts, dim=1)

    def add(self, code: int, values: Tensor) -> None:
        """Add a block of neurons with these inputs."""
        given = activate(code, values)
        if code == forms.CLAMP:
            self.linear[len(self.blocks)] = values
            if not self.clamp:
                # The value is the clamped one, the gradient that of the linear one.
                given = given.detach() + (values - values.detach())
        self.blocks.append(given)


class DenseStep(torch.nn.Module):
    """A fully connected layer: one linear operation on a view of the genome."""

    def __init__(self, step: forms.Dense, places: Places) -> None:
        super().__init__()
        self.step = step
        self.runs = runs_of(range(step.source, step.source + step.sources), places)

    def forward(self, evaluation: Evaluation) -> None:
        """Add the layer's neurons."""
        step = self.step
        width = step.sources + 1
        own = evaluation.genome[step.weights : step.weights + step.neurons * width]
        weights = own.view(step.neurons, width)
        read = evaluation.read(self.runs)
        values = torch.nn.functional.linear(read, weights[:, :-1], weights[:, -1])
        evaluation.add(step.activation, values)


class NeuronsStep(torch.nn.Module):
    """Neurons alike in activation, aggregation and number of inputs, each with inputs of its own.

    Args:
        neurons: the neurons.
        places: where their sources lie.
    """

    def __init__(self, neurons: Sequence[forms.Neuron], places: Places) -> None:
        super().__init__()
        first = neurons[0]
        self.activation, self.aggregation = first.activation, first.aggregation
        self.runs, columns = columns_of([one.sources for one in neurons], places)
        self.columns: Tensor
        self.weights: Tensor
        self.biases: Tensor
        self.biased: Tensor
        self.has_biases = any(one.bias >= 0 for one in neurons)
        self.responses: Tensor
        biases = [one.bias for one in neurons]
        shape = len(neurons), len(first.sources)
        weights = torch.tensor([one.weights for one in neurons], dtype=torch.long).reshape(shape)
        responses = torch.tensor([one.response for one in neurons], dtype=torch.float64)
        for name, buffer in {
            "columns": columns.reshape(shape),
            "weights": weights,
            "biases": torch.tensor([max(bias, 0) for bias in biases], dtype=torch.long),
            "biased": torch.tensor([bias >= 0 for bias in biases], dtype=torch.bool),
            "responses": responses,
        }.items():
            self.register_buffer(name, buffer, persistent=False)

    def forward(self, evaluation: Evaluation) -> None:
        """Add the neurons."""
        genome = evaluation.genome
        weighted = evaluation.read(self.runs)[:, self.columns] * genome[self.weights]
        values = self.responses.to(genome.dtype) * aggregate(self.aggregation, weighted)
        if self.has_biases:
            values = values + torch.where(self.biased, genome[self.biases], 0.0)
        evaluation.add(self.activation, values)


class GatherStep(torch.nn.Module):
    """Nodes copied side by side."""

    def __init__(self, step: forms.Gather, places: Places) -> None:
        super().__init__()
        self.runs = runs_of(step.sources, places)

    def forward(self, evaluation: Evaluation) -> None:
        """Add the copies."""
        evaluation.blocks.append(evaluation.read(self.runs))


class MixStep(torch.nn.Module):
    """Nodes mixed by equation 4.3, each from as many branches.

    Args:
        pairs: for each node its pairs (influence, value).
        places: where these lie.
    """

    def __init__(self, pairs: Sequence[Sequence[tuple[int, int]]], places: Places) -> None:
        super().__init__()
        self.influence_runs, influences = columns_of([[i for i, _ in one] for one in pairs], places)
        self.value_runs, values = columns_of([[v for _, v in one] for one in pairs], places)
        self.influences: Tensor
        self.values: Tensor
        shape = len(pairs), len(pairs[0])
        self.register_buffer("influences", influences.reshape(shape), persistent=False)
        self.register_buffer("values", values.reshape(shape), persistent=False)

    def forward(self, evaluation: Evaluation) -> None:
        """Add the mixed nodes."""
        influences = evaluation.read(self.influence_runs)[:, self.influences]
        values = evaluation.read(self.value_runs, linear=not evaluation.clamp)[:, self.values]
        total = influences.sum(-1)
        some = total > 0.0
        mixed = (influences * values).sum(-1) / torch.where(some, total, 1.0)
        evaluation.blocks.append(torch.where(some, mixed, 0.5))


class RecallStep(torch.nn.Module):
    """What was remembered at the last evaluation."""

    def __init__(self, step: forms.Recall) -> None:
        super().__init__()
        self.step = step

    def forward(self, evaluation: Evaluation) -> None:
        """Add it."""
        first = self.step.memory
        evaluation.blocks.append(evaluation.memory[:, first : first + self.step.count])


def tensor_steps(
    network: forms.Network,
) -> tuple[list[torch.nn.Module], dict[int, tuple[int, int]]]:
    """Return the steps that fill blocks, and where each node lies."""
    places = {node: (0, node) for node in range(network.inputs)}
    steps: list[torch.nn.Module] = []

    def add(step: torch.nn.Module, nodes: Iterable[int]) -> None:
        steps.append(step)
        places.update({node: (len(steps), place) for place, node in enumerate(nodes)})

    for step in network.steps:
        match step:
            case forms.Dense():
                add(DenseStep(step, places), range(step.target, step.target + step.neurons))
            case forms.Neurons():
                for chosen in _alike(step):
                    neurons = [step.neurons[place] for place in chosen]
                    add(NeuronsStep(neurons, places), [step.target + place for place in chosen])
            case forms.Gather():
                nodes = range(step.target, step.target + len(step.sources))
                add(GatherStep(step, places), nodes)
            case forms.Mix():
                counts = sorted({len(pairs) for pairs in step.pairs})
                for count in counts:
                    chosen = [k for k, pairs in enumerate(step.pairs) if len(pairs) == count]
                    pairs = [step.pairs[place] for place in chosen]
                    add(MixStep(pairs, places), [step.target + place for place in chosen])
            case forms.Recall():
                add(RecallStep(step), range(step.target, step.target + step.count))
            case forms.Remember():
                continue
    return steps, places


def _alike(step: forms.Neurons) -> Iterator[list[int]]:
    """Yield the places of neurons that can be evaluated together, sources before readers."""
    levels: dict[int, int] = {}
    groups: dict[tuple[int, int, int, int], list[int]] = {}
    for place, one in enumerate(step.neurons):
        level = 1 + max((levels.get(source, -1) for source in one.sources), default=-1)
        levels[step.target + place] = level
        kind = level, one.activation, one.aggregation, len(one.sources)
        groups.setdefault(kind, []).append(place)
    for kind in sorted(groups):
        yield groups[kind]


def runs_of(nodes: Iterable[int], places: Places) -> Runs:
    """Return the columns of nodes as few runs."""
    runs: list[tuple[int, int, int]] = []
    for node in nodes:
        block, column = places[node]
        if runs and runs[-1][0] == block and runs[-1][2] == column:
            runs[-1] = (block, runs[-1][1], column + 1)
        else:
            runs.append((block, column, column + 1))
    return tuple(runs)


def columns_of(rows: Iterable[Iterable[int]], places: Places) -> tuple[Runs, Tensor]:
    """Return what to read for rows of nodes, and the column in it of each node, row by row."""
    wanted = [node for row in rows for node in row]
    read = sorted(set(wanted), key=lambda node: places[node])
    column = {node: place for place, node in enumerate(read)}
    return runs_of(read, places), torch.tensor([column[node] for node in wanted], dtype=torch.long)
