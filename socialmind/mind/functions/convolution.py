"""Convolutional networks: small kernels swept over the inputs (thesis, 5.2.2 and A.3.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from socialmind.errors import ModelError
from socialmind.mind.functions import perceptron
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.network import Network, Neuron

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill


@dataclass(frozen=True)
class Kernel:
    """A convolution layer: neurons that share one set of weights.

    Args:
        size: how many places each of its neurons reads, 1 or more.
        links: for each neuron the places it reads, in order, counted from 0: inputs of the skill
            for the first kernel, neurons of the kernel before for the others.

    Raises:
        ModelError: a neuron reads another number of places, or a place is no whole number.

    >>> Kernel(2, ((0, 1), (1, 2))).neurons
    2
    """

    size: int
    links: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        object.__setattr__(
            self, "size", perceptron.check_whole(self.size, "the number of inputs of a kernel", 1)
        )
        if not isinstance(self.links, tuple | list) or not self.links:
            raise ModelError(f"{self.links!r} as the links of a kernel", "places for each neuron")
        links = tuple(
            perceptron.as_places(places, f"the places that neuron {neuron} of a kernel reads")
            for neuron, places in enumerate(self.links)
        )
        object.__setattr__(self, "links", links)
        for neuron, places in enumerate(links):
            if len(places) != self.size:
                raise ModelError(
                    f"{len(places)} places linked to neuron {neuron} of a kernel of size "
                    f"{self.size}",
                    f"{self.size}",
                )

    @property
    def neurons(self) -> int:
        """How many neurons it has."""
        return len(self.links)


@dataclass(frozen=True)
class Convolution(InternalFunction):
    """A convolutional network: kernels, then a perceptron (thesis, figures 5.6 and A.2).

    The neurons of kernels have the activation of the hidden layers. The perceptron reads the
    neurons of the last kernel in order, then the inputs that bypass the kernels in order; these are
    its inputs in equation 5.1. The genome goes kernel by kernel, `size` weights and a bias each,
    then through the perceptron layer by layer.

    Args:
        kernels: the kernels; each reads the neurons of the one before, the first the inputs.
        bypass: inputs that go to the perceptron directly, counted from 0.
        layers: how many hidden layers the perceptron has, 0 or more.
        hidden: the activation of kernels and hidden layers, "relu" or "sigmoid".
        added: neurons a hidden layer has more than the larger of its inputs and outputs.

    Raises:
        ModelError: no kernel, a link to a neuron that there is not, or another wrong value.

    >>> spatial = Kernel(2, ((0, 1), (1, 2)))
    >>> Convolution((spatial,), bypass=(3,), layers=0).genome_size(4, 1)  # (2 + 1) + (3 + 1)
    7
    """

    kernels: tuple[Kernel, ...]
    bypass: tuple[int, ...] = ()
    layers: int = 2
    hidden: str = "relu"
    added: int = perceptron.ADDED
    keyword: ClassVar[str] = "CNN"

    def __post_init__(self) -> None:
        bypass = perceptron.as_places(self.bypass, "the inputs that bypass the kernels")
        object.__setattr__(self, "bypass", bypass)
        perceptron.check_hidden_layers(self, "a convolutional network", 0)
        if not isinstance(self.kernels, tuple | list) or not self.kernels:
            raise ModelError(
                f"{self.kernels!r} as the kernels of a convolutional network", "one or more"
            )
        object.__setattr__(self, "kernels", tuple(self.kernels))
        for kernel in self.kernels:
            if not isinstance(kernel, Kernel):
                raise ModelError(f"{kernel!r} as a kernel of a convolutional network", "a Kernel")
        for number, (below, kernel) in enumerate(
            zip(self.kernels, self.kernels[1:], strict=False), 1
        ):
            found = _outside(kernel, number, below.neurons)
            if found is not None:
                raise ModelError(found, f"0 … {below.neurons - 1}, a neuron of the kernel before")

    def check(self, skill: Skill) -> None:
        """Refuse a skill with fewer inputs than its kernels and bypass read.

        Raises:
            ModelError: so it is.
        """
        found = self._missing(len(skill.inputs))
        if found is not None:
            raise skill.refused(f"with {found}", _inputs(len(skill.inputs)))

    def network(self, inputs: int, outputs: int) -> Network:
        """Return what it computes as steps of arithmetic.

        Raises:
            ModelError: it reads an input that there is not.
        """
        found = self._missing(inputs)
        if found is not None:
            raise ModelError(found, _inputs(inputs))
        draft = NetworkDraft(inputs)
        below = 0
        for kernel in self.kernels:
            first = draft.keep_weights(kernel.size + 1)
            weights = tuple(range(first, first + kernel.size))
            activation = perceptron.HIDDEN_ACTIVATIONS[self.hidden]
            below = draft.neurons(
                [
                    Neuron(tuple(below + place for place in places), weights, first + kernel.size,
                           activation)
                    for places in kernel.links
                ]
            )  # fmt: skip
        last = self.kernels[-1].neurons
        read = last + len(self.bypass)
        if self.bypass:
            below = draft.gather((*range(below, below + last), *self.bypass))
        return draft.finished(perceptron.add_perceptron(draft, below, read, outputs, self), outputs)

    def _missing(self, inputs: int) -> str | None:
        """Return which place it reads beyond the inputs, in words."""
        for place in self.bypass:
            if place >= inputs:
                return f"place {place} in the bypass"
        return _outside(self.kernels[0], 0, inputs)

    def __repr__(self) -> str:
        count = len(self.kernels)
        kernels = f"{count} kernel{'s' * (count != 1)}"
        return f"a convolutional network of {kernels} and {perceptron.hidden_layers(self)}"


def _outside(kernel: Kernel, number: int, count: int) -> str | None:
    """Return which place a kernel reads that is not among `count`, in words."""
    for neuron, places in enumerate(kernel.links):
        for place in places:
            if place >= count:
                return f"place {place} linked to neuron {neuron} of kernel {number}"
    return None


def _inputs(count: int) -> str:
    return f"0 … {count - 1}, one of its {count} inputs" if count else "an input; it has none"
