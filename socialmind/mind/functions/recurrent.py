"""Recurrent networks: hidden layers that read the whole network's last values (thesis, A.3.1)."""

from __future__ import annotations

from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.network import CLAMP, Network
from socialmind.mind.functions.perceptron import HIDDEN_ACTIVATIONS, Layered, hidden_size


class Recurrent(Layered):
    """A perceptron whose hidden layers also read all neurons' values of the last evaluation.

    Each hidden layer reads the layer below, then the neurons of all hidden layers from the first
    and of the output layer as they were at the last evaluation, 0 at the start; outputs as they
    were given, in [0, 1]. The genome goes layer by layer, neuron by neuron: the weights in this
    order, then the bias. The output layer reads the last hidden layer only.

    Args:
        layers: how many hidden layers, 1 or more.
        hidden: their activation, "relu" or "sigmoid".
        added: neurons a hidden layer has more than the larger of inputs and outputs.

    Raises:
        ModelError: another value of one of these.

    >>> Recurrent(layers=1, added=0).genome_size(1, 2)  # 2 · (1 + 2 + 2 + 1) + 2 · (2 + 1)
    18
    """

    keyword = "RNN"
    called = "a recurrent network"

    def network(self, inputs: int, outputs: int) -> Network:
        """Return what it computes as steps of arithmetic."""
        draft = NetworkDraft(inputs)
        size = hidden_size(inputs, outputs, self.added)
        activation = HIDDEN_ACTIVATIONS[self.hidden]
        remembered = self.layers * size + outputs
        memory = draft.keep_memory(remembered)
        below, count = 0, inputs
        kept = []
        for place in range(self.layers):
            # Recalled nodes follow the layer below, so that one range holds all the layer reads.
            draft.recall(memory, remembered)
            below, count = draft.dense(below, count + remembered, size, activation), size
            kept.append((below, memory + place * size, size))
        output = draft.dense(below, count, outputs, CLAMP)
        kept.append((output, memory + self.layers * size, outputs))
        for layer, place, neurons in kept:
            draft.remember(layer, place, neurons)
        return draft.finished(output, outputs)
