"""Elman networks: hidden layers that read what they gave last time (thesis, A.3.1)."""

from __future__ import annotations

from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.network import CLAMP, Network
from socialmind.mind.functions.perceptron import HIDDEN_ACTIVATIONS, Layered, hidden_size


class Elman(Layered):
    """A perceptron whose hidden layers also read their own values of the last evaluation.

    Each hidden layer reads the layer below, then its context: its own neurons as they were at the
    last evaluation, 0 at the start. The genome goes layer by layer, neuron by neuron: the weights
    of the layer below, the weights of the context, the bias. The output layer has no context.

    Args:
        layers: how many hidden layers, 1 or more.
        hidden: their activation, "relu" or "sigmoid".
        added: neurons a hidden layer has more than the larger of inputs and outputs.

    Raises:
        ModelError: another value of one of these.

    >>> Elman(layers=1, added=0).genome_size(1, 2)  # 2 · (1 + 2 + 1) + 2 · (2 + 1)
    14
    """

    keyword = "ELMAN"
    called = "an Elman network"

    def network(self, inputs: int, outputs: int) -> Network:
        """Return what it computes as steps of arithmetic."""
        draft = NetworkDraft(inputs)
        size = hidden_size(inputs, outputs, self.added)
        activation = HIDDEN_ACTIVATIONS[self.hidden]
        below, count = 0, inputs
        kept = []
        for _ in range(self.layers):
            # Recalled nodes follow the layer below, so that one range holds all the layer reads.
            context = draft.keep_memory(size)
            draft.recall(context, size)
            below, count = draft.dense(below, count + size, size, activation), size
            kept.append((below, context))
        output = draft.dense(below, count, outputs, CLAMP)
        for layer, context in kept:
            draft.remember(layer, context, size)
        return draft.finished(output, outputs)
