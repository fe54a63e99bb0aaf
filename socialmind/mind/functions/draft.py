"""A network being drawn up: nodes, weights and memory are counted while steps are added."""

from __future__ import annotations

from collections.abc import Sequence

from socialmind.mind.functions import network


class NetworkDraft:
    """A network of which steps are added one after another.

    Args:
        inputs: how many inputs: nodes 0 … inputs − 1.

    >>> draft = NetworkDraft(2)
    >>> layer = draft.dense(0, 2, neurons=3, activation=0)
    >>> draft.finished(layer, 3).genome_size
    9
    """

    def __init__(self, inputs: int) -> None:
        self.inputs = inputs
        self.nodes = inputs
        self.weights = 0
        self.memory = 0
        self._steps: list[network.Step] = []

    def _taken(self, count: int) -> int:
        """Return the first of further nodes."""
        self.nodes += count
        return self.nodes - count

    def keep_weights(self, count: int) -> int:
        """Return the place in the genome of the first of further weights."""
        self.weights += count
        return self.weights - count

    def keep_memory(self, count: int) -> int:
        """Return the place in the memory of the first of further numbers."""
        self.memory += count
        return self.memory - count

    def dense(self, source: int, sources: int, neurons: int, activation: int) -> int:
        """Add a fully connected layer with weights of its own; return its first node."""
        weights = self.keep_weights(neurons * (sources + 1))
        target = self._taken(neurons)
        self._steps.append(network.Dense(source, sources, target, neurons, weights, activation))
        return target

    def neurons(self, neurons: Sequence[network.Neuron]) -> int:
        """Add neurons, of which none reads another; return the first one's node."""
        target = self._taken(len(neurons))
        self._steps.append(network.Neurons(target, tuple(neurons)))
        return target

    def gather(self, sources: Sequence[int]) -> int:
        """Add copies of nodes side by side; return the first."""
        target = self._taken(len(sources))
        self._steps.append(network.Gather(tuple(sources), target))
        return target

    def mix(self, pairs: Sequence[Sequence[tuple[int, int]]]) -> int:
        """Add nodes mixed by equation 4.3 from pairs (influence, value); return the first."""
        target = self._taken(len(pairs))
        self._steps.append(network.Mix(target, tuple(tuple(branches) for branches in pairs)))
        return target

    def recall(self, memory: int, count: int) -> int:
        """Add nodes with what was remembered at the last evaluation; return the first."""
        target = self._taken(count)
        self._steps.append(network.Recall(memory, target, count))
        return target

    def remember(self, source: int, memory: int, count: int) -> None:
        """Keep nodes for the next evaluation."""
        self._steps.append(network.Remember(source, memory, count))

    def finished(self, output: int, outputs: int) -> network.Network:
        """Return the network whose outputs are these nodes."""
        return network.Network(
            inputs=self.inputs,
            outputs=outputs,
            output=output,
            nodes=self.nodes,
            genome_size=self.weights,
            memory=self.memory,
            steps=tuple(self._steps),
        )
