"""Neurons of NEAT graphs, and the lines of text that write them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import ModelError
from socialmind.mind.functions.network import NEAT_ACTIVATIONS, NEAT_AGGREGATIONS
from socialmind.mind.functions.perceptron import check_whole


@dataclass(frozen=True)
class GraphNeuron:
    """A neuron of a graph: activation(bias + response · aggregation(weight · source …)).

    Args:
        key: its number in the graph: 0 … outputs − 1 for the outputs, further ones for hidden
            neurons.
        sources: what it reads, in order: −1, −2, … for the first, second, … input, else the keys of
            neurons.
        activation: one of neat-python's activations, with its formula of release 2.0.
        aggregation: one of neat-python's aggregations.
        response: the factor of the aggregated input.

    Raises:
        ModelError: another value of one of these, or a source twice.
    """

    key: int
    sources: tuple[int, ...] = ()
    activation: str = "sigmoid"
    aggregation: str = "sum"
    response: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "key", check_whole(self.key, "the key of a neuron", 0))
        what = f"neuron {self.key}"
        if not isinstance(self.sources, tuple | list):
            raise ModelError(f"{self.sources!r} as the sources of {what}", "a tuple of keys")
        object.__setattr__(self, "sources", tuple(self.sources))
        for place, source in enumerate(self.sources):
            if not is_whole(source):
                raise ModelError(f"{shown(source)} as a source of {what}", "a whole number")
            if source in self.sources[:place]:
                raise ModelError(f"{source} twice among the sources of {what}", "each source once")
        _check_known(self.activation, NEAT_ACTIVATIONS, f"the activation of {what}")
        _check_known(self.aggregation, NEAT_AGGREGATIONS, f"the aggregation of {what}")
        if not is_number(self.response):
            raise ModelError(f"{shown(self.response)} as the response of {what}", "a finite number")
        object.__setattr__(self, "response", float(self.response))
        object.__setattr__(self, "sources", tuple(int(one) for one in self.sources))

    def to_line(self) -> str:
        """Return it as a line of text.

        >>> GraphNeuron(0, (-1, -2), "tanh").to_line()
        'neuron 0 tanh sum 1.0 -1 -2'
        """
        described = (self.key, self.activation, self.aggregation, float(self.response))
        return " ".join(map(str, ("neuron", *described, *self.sources)))

    @classmethod
    def from_line(cls, line: str) -> GraphNeuron:
        """Return the neuron that a line of text writes, as `to_line` gives it.

        Raises:
            ModelError: the line writes none.
        """
        words = line.split()
        if len(words) < 5 or words[0] != "neuron":
            raise ModelError(
                f"{' '.join(words)!r} as a neuron of a NEAT graph",
                "neuron, its key, activation, aggregation, response and sources",
            )
        try:
            response = float(words[4])
        except ValueError:
            raise ModelError(f"{words[4]!r} as the response of a neuron", "a number") from None
        sources = tuple(whole(word) for word in words[5:])
        return cls(whole(words[1]), sources, words[2], words[3], response)


def _check_known(name: Any, known: Mapping[str, int], what: str) -> None:
    if not isinstance(name, str) or name not in known:
        raise ModelError(f"{name!r} as {what}", f"one of {', '.join(known)}")


def whole(word: str) -> int:
    """Return the whole number that a word of the text form writes.

    Raises:
        ModelError: it writes none.
    """
    try:
        return int(word)
    except ValueError:
        raise ModelError(f"{word!r} in a NEAT graph", "a whole number") from None
