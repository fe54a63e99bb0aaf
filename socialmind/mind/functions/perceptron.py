"""Perceptrons: layers of neurons, each fully connected to the one below (thesis, 5.2.1).

Also what all networks with hidden layers share: their size (equation 5.1), their activations, and
how they are checked and named.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.network import CLAMP, RELU, SIGMOID, Network

ADDED = 2
"""How many neurons a hidden layer has more than the larger of inputs and outputs."""
HIDDEN_ACTIVATIONS = {"relu": RELU, "sigmoid": SIGMOID}
"""The activations of hidden layers by name (thesis, A.3.1: HIDDEN_TRANSFER)."""


def hidden_size(inputs: int, outputs: int, added: int = ADDED) -> int:
    """Return how many neurons a hidden layer has (thesis, equation 5.1).

    >>> hidden_size(15, 4)
    17
    """
    return max(inputs, outputs) + added


@dataclass(frozen=True, repr=False)
class Layered(InternalFunction):
    """What perceptrons and the networks that remember have in common: hidden layers."""

    layers: int = 2
    hidden: str = "relu"
    added: int = ADDED
    called: ClassVar[str]
    least: ClassVar[int] = 1

    def __post_init__(self) -> None:
        check_hidden_layers(self, self.called, self.least)

    def __repr__(self) -> str:
        return f"{self.called} of {hidden_layers(self)}"


class Perceptron(Layered):
    """A multi-layered perceptron (thesis, 5.2.1; `TYPE:BASIC`).

    Each hidden layer has max(inputs, outputs) + added neurons; the last layer is linear and held to
    [0, 1]. The genome goes layer by layer, neuron by neuron: the incoming weights in the order of
    the layer's inputs, then the bias.

    Args:
        layers: how many hidden layers, 0 or more.
        hidden: their activation, "relu" or "sigmoid".
        added: neurons a hidden layer has more than the larger of inputs and outputs, 0 or more.

    Raises:
        ModelError: another value of one of these.

    >>> Perceptron(layers=1).genome_size(3, 2)  # 5 · (3 + 1) + 2 · (5 + 1)
    32
    >>> Perceptron()
    a perceptron of 2 hidden layers
    """

    keyword = "BASIC"
    called = "a perceptron"
    least = 0

    def network(self, inputs: int, outputs: int) -> Network:
        """Return what it computes as steps of arithmetic."""
        draft = NetworkDraft(inputs)
        return draft.finished(add_perceptron(draft, 0, inputs, outputs, self), outputs)


class HasHiddenLayers(Protocol):
    """What all networks with hidden layers have."""

    @property
    def layers(self) -> int:
        """How many hidden layers."""

    @property
    def hidden(self) -> str:
        """The name of their activation."""

    @property
    def added(self) -> int:
        """How many neurons each has more than the larger of inputs and outputs."""


def add_perceptron(
    draft: NetworkDraft, source: int, sources: int, outputs: int, function: HasHiddenLayers
) -> int:
    """Add the layers of a perceptron over a range of nodes; return its first output node."""
    size = hidden_size(sources, outputs, function.added)
    for _ in range(function.layers):
        source = draft.dense(source, sources, size, HIDDEN_ACTIVATIONS[function.hidden])
        sources = size
    return draft.dense(source, sources, outputs, CLAMP)


def check_hidden_layers(function: HasHiddenLayers, what: str, least: int) -> None:
    """Refuse hidden layers that there cannot be.

    Args:
        function: the network.
        what: what it is, in words.
        least: how many hidden layers it must have.

    Raises:
        ModelError: a number or an activation is not one.
    """
    layers = check_whole(function.layers, f"the number of hidden layers of {what}", least)
    more = f"the number of neurons added to a hidden layer of {what}"
    object.__setattr__(function, "layers", layers)
    object.__setattr__(function, "added", check_whole(function.added, more, 0))
    # A value that cannot be hashed is no key either, so the names are compared one by one.
    if not any(function.hidden == name for name in HIDDEN_ACTIVATIONS):
        raise ModelError(
            f"{function.hidden!r} as the activation of the hidden layers of {what}",
            " or ".join(repr(name) for name in HIDDEN_ACTIVATIONS),
        )


def check_whole(value: Any, what: str, least: int) -> int:
    """Return a whole number from `least` up as Python's, or refuse what is none.

    Raises:
        ModelError: so it is.
    """
    if not is_whole(value) or value < least:
        raise ModelError(f"{shown(value)} as {what}", f"a whole number, {least} or more")
    return int(value)


def as_places(values: Any, what: str) -> tuple[int, ...]:
    """Return places counted from 0 as a tuple, or refuse what is none.

    Raises:
        ModelError: it is no tuple or list of whole numbers from 0 up.
    """
    if not isinstance(values, tuple | list):
        raise ModelError(f"{values!r} as {what}", "a tuple of whole numbers")
    for place in values:
        check_whole(place, f"one of {what}", 0)
    return tuple(values)


def hidden_layers(function: HasHiddenLayers) -> str:
    """Return in words which hidden layers a network has, as far as they are not the usual ones.

    >>> hidden_layers(Perceptron(layers=1, hidden="sigmoid", added=4))
    '1 hidden layer (sigmoid, 4 neurons added)'
    """
    if function.layers == 0:
        return "no hidden layer"
    unusual = [function.hidden] if function.hidden != "relu" else []
    if function.added != ADDED:
        unusual.append(f"{function.added} neuron{'s' * (function.added != 1)} added")
    words = f"{function.layers} hidden layer{'s' * (function.layers != 1)}"
    return f"{words} ({', '.join(unusual)})" if unusual else words
