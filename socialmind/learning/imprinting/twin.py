"""The trainable twin of an internal function: the same genome gives the same outputs, in torch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.learning.imprinting.initial_genome import initial_genome
from socialmind.learning.imprinting.pytorch import torch
from socialmind.learning.imprinting.tensor_steps import Evaluation, runs_of, tensor_steps
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.network import MEMORY_BOUND, Remember

Tensor = torch.Tensor
Values = Tensor | NDArray[Any] | Sequence[Any]


class Twin(torch.nn.Module):
    """An internal function as a module of torch.

    Its one parameter is `genome`, in the order of the function's genome. It keeps no state of its
    own between calls: a network that remembers takes its memory and gives the next.

    Args:
        function: a network, such as `Perceptron()`.
        inputs: how many inputs its skill has.
        outputs: how many outputs.
        genome: the weights, shape (genome size,); None to draw them (`initial_genome`).
        seed: decides the draws.
        dtype: the type of its numbers; evaluations in float64 are those of the skill itself.

    Raises:
        ModelError: the function is no network, or the genome is not of its size.

    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> twin = Twin(Perceptron(layers=0), 2, 1, genome=[1.0, -1.0, 0.5])
    >>> twin([[0.3, 0.1], [0.9, 0.1]]).tolist()
    [[0.7], [1.0]]
    >>> twin([[0.9, 0.1]], clamp=False).tolist()
    [[1.3]]
    """

    def __init__(
        self,
        function: InternalFunction,
        inputs: int,
        outputs: int,
        genome: Values | None = None,
        seed: int = 0,
        dtype: torch.dtype = torch.float64,
    ) -> None:
        super().__init__()
        network = function.network(inputs, outputs)
        if network is None:
            raise ModelError(f"{function} to be trained", "a network, which has weights")
        self.function = function
        self.network = network
        steps, places = tensor_steps(network)
        self.steps = torch.nn.ModuleList(steps)
        output = range(network.output, network.output + outputs)
        self._output = runs_of(output, places)
        self._kept = [
            (step.memory, step.count, runs_of(range(step.source, step.source + step.count), places))
            for step in network.steps
            if isinstance(step, Remember)
        ]
        weights = initial_genome(network, seed) if genome is None else self._fitting(genome)
        self.genome = torch.nn.Parameter(weights.to(dtype))

    def _fitting(self, genome: Values) -> Tensor:
        """Return a genome as a tensor of its own, or refuse it."""
        if not isinstance(genome, Tensor):
            genome = torch.tensor(np.array(genome, dtype=np.float64))
        weights = genome.detach().clone().to(torch.float64).reshape(-1)
        if len(weights) != self.network.genome_size:
            raise ModelError(
                f"a genome of {len(weights)} weights for {self.function}",
                f"{self.network.genome_size}",
            )
        if not bool(torch.isfinite(weights).all()):
            raise ModelError("a genome with weights that are no finite numbers", "finite numbers")
        return weights

    @property
    def weights(self) -> NDArray[np.float64]:
        """A copy of the genome, as a skill takes it, shape (genome size,)."""
        return self.genome.detach().cpu().numpy().astype(np.float64)

    def start(self, batch: int) -> Tensor:
        """Return the memory before the first evaluation: zeros, shape (batch, memory)."""
        return self.genome.new_zeros(batch, self.network.memory)

    def forward(self, inputs: Values, memory: Tensor | None = None, clamp: bool = True) -> Tensor:
        """Return the outputs.

        Args:
            inputs: in [0, 1], shape (batch, inputs).
            memory: what was remembered, shape (batch, memory); None for the start. `step` also
                gives the next.
            clamp: False for training: outputs are given before they are held to [0, 1], and within
                the network the gradient passes through clamps, so that it does not vanish where a
                value lies outside. What the network remembers is the same.

        Returns:
            Shape (batch, outputs).

        Raises:
            ModelError: the inputs or the memory have another shape.
        """
        return self.step(inputs, memory, clamp)[0]

    def step(
        self, inputs: Values, memory: Tensor | None = None, clamp: bool = True
    ) -> tuple[Tensor, Tensor]:
        """Return the outputs and what is remembered for the next evaluation, as `forward`."""
        read = torch.as_tensor(inputs, dtype=self.genome.dtype, device=self.genome.device)
        if read.dim() != 2 or read.shape[1] != self.network.inputs:
            raise ModelError(
                f"inputs of shape {tuple(read.shape)}", f"(batch, {self.network.inputs})"
            )
        if memory is None:
            memory = self.start(len(read))
        if memory.shape != (len(read), self.network.memory):
            raise ModelError(
                f"a memory of shape {tuple(memory.shape)}", f"{(len(read), self.network.memory)}"
            )
        evaluation = Evaluation(read, self.genome, memory, clamp)
        for step in self.steps:
            step(evaluation)
        remembered = memory
        if self._kept:
            remembered = memory.clone()
            for first, count, runs in self._kept:
                held = evaluation.read(runs).clamp(-MEMORY_BOUND, MEMORY_BOUND)
                remembered[:, first : first + count] = held
        outputs = evaluation.read(self._output, linear=not clamp)
        return (outputs.clamp(0.0, 1.0) if clamp else outputs), remembered

    def run(self, sequence: Values, memory: Tensor | None = None, clamp: bool = True) -> Tensor:
        """Return the outputs at each evaluation of a sequence, each remembering the one before.

        Args:
            sequence: inputs in [0, 1], shape (time, batch, inputs).
            memory: what was remembered before, shape (batch, memory); None for the start.
            clamp: as in `forward`.

        Returns:
            Shape (time, batch, outputs).

        Raises:
            ModelError: the sequence has another shape.
        """
        read = torch.as_tensor(sequence, dtype=self.genome.dtype, device=self.genome.device)
        if read.dim() != 3 or read.shape[2] != self.network.inputs:
            raise ModelError(
                f"a sequence of shape {tuple(read.shape)}", f"(time, batch, {self.network.inputs})"
            )
        given = []
        for inputs in read:
            outputs, memory = self.step(inputs, memory, clamp)
            given.append(outputs)
        if not given:
            return read.new_zeros(0, read.shape[1], self.network.outputs)
        return torch.stack(given)

    def extra_repr(self) -> str:
        """Return what it is the twin of."""
        return f"{self.function}, {self.network.inputs} inputs, {self.network.outputs} outputs"
