"""Influence neural networks: influence as an operation within a network (thesis, 9.2.4)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from socialmind.errors import ModelError
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.network import Network
from socialmind.mind.functions.perceptron import (
    ADDED,
    add_perceptron,
    as_places,
    check_hidden_layers,
    check_whole,
    hidden_layers,
)

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill

GATES = ("output", "branch")


@dataclass(frozen=True)
class InfluenceNetwork(InternalFunction):
    """Perceptrons side by side, mixed by the influence that one above them gives.

    A high-level perceptron reads the inputs and gives influences in [0, 1]. Each branch reads the
    inputs too and gives a value in [0, 1] for each output. An output is what equation 4.3 makes of
    its branches, Σ influence · value / Σ influence, and 0.5 without influence. An input in `passes`
    is a branch of its own: it stands as it is for every output, so that one decision lets one of
    several signals through undistorted, as the Collect of section 7.1.3 needs it.

    The genome holds the high-level perceptron, then the branches' perceptrons in order, each layer
    by layer, neuron by neuron: the incoming weights, then the bias. The high-level perceptron's
    outputs are the influences: for gates "output", those of the first output's branches, then the
    second's, …; for gates "branch", one for each branch. Branches with perceptrons come first, then
    the inputs in `passes`.

    Args:
        branches: how many perceptrons are mixed, 0 or more.
        passes: inputs that are branches themselves, counted from 0.
        layers: how many hidden layers each perceptron has, 0 or more.
        hidden: their activation, "relu" or "sigmoid".
        added: neurons a hidden layer has more than the larger of its perceptron's inputs and
            outputs (equation 5.1 for each perceptron).
        gates: "output" for an influence on each output of each branch, "branch" for one influence
            on all outputs of a branch.

    Raises:
        ModelError: another value of one of these, or no branch at all.

    >>> selector = InfluenceNetwork(branches=0, passes=(0, 1), layers=0)
    >>> selector.genome_size(3, 1)  # two influences of 3 weights and a bias
    8
    """

    branches: int = 2
    passes: tuple[int, ...] = ()
    layers: int = 1
    hidden: str = "relu"
    added: int = ADDED
    gates: str = "output"
    keyword: ClassVar[str] = "INFLUENCE"

    def __post_init__(self) -> None:
        passes = as_places(self.passes, "the inputs that an influence network lets through")
        object.__setattr__(self, "passes", passes)
        check_hidden_layers(self, "an influence network", 0)
        object.__setattr__(
            self,
            "branches",
            check_whole(self.branches, "the number of branches of an influence network", 0),
        )
        if len(set(self.passes)) < len(self.passes):
            raise ModelError(f"the inputs {self.passes} let through", "each input once")
        if self.branches + len(self.passes) == 0:
            raise ModelError("an influence network without branches", "one branch or pass, or more")
        if not any(self.gates == gates for gates in GATES):
            raise ModelError(
                f"{self.gates!r} as the gates of an influence network",
                " or ".join(repr(gates) for gates in GATES),
            )

    def check(self, skill: Skill) -> None:
        """Refuse a skill without one of the inputs that are let through.

        Raises:
            ModelError: so it is.
        """
        found = self._missing(len(skill.inputs))
        if found is not None:
            raise skill.refused(f"with {found}", f"one of its {len(skill.inputs)} inputs")

    def network(self, inputs: int, outputs: int) -> Network:
        """Return what it computes as steps of arithmetic.

        Raises:
            ModelError: it lets through an input that there is not.
        """
        found = self._missing(inputs)
        if found is not None:
            raise ModelError(found, f"one of {inputs} inputs")
        draft = NetworkDraft(inputs)
        branches = self.branches + len(self.passes)
        of_each_output = self.gates == "output"
        gates = branches * outputs if of_each_output else branches
        influence = add_perceptron(draft, 0, inputs, gates, self)
        firsts = [add_perceptron(draft, 0, inputs, outputs, self) for _ in range(self.branches)]
        pairs = []
        for output in range(outputs):
            first = influence + output * branches if of_each_output else influence
            values = [*(value + output for value in firsts), *self.passes]
            pairs.append([(first + place, value) for place, value in enumerate(values)])
        return draft.finished(draft.mix(pairs), outputs)

    def _missing(self, inputs: int) -> str | None:
        """Return which input it lets through that there is not, in words."""
        for place in self.passes:
            if place >= inputs:
                return f"input {place} let through"
        return None

    def __repr__(self) -> str:
        parts = [f"{self.branches} branch{'es' * (self.branches != 1)} of {hidden_layers(self)}"]
        if self.passes:
            count = len(self.passes)
            parts.append(f"{count} input{'s' * (count != 1)} let through")
        if self.gates == "branch":
            parts.append("one gate a branch")
        return f"an influence network of {', '.join(parts)}"
