"""NEAT: networks whose topology evolves (Stanley and Miikkulainen 2002), by neat-python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.learning.optimisers.contract import Optimiser, State, check_shape, whole
from socialmind.learning.optimisers.settings import Setting
from socialmind.mind.functions.neat.graph import NeatGraph

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill


@dataclass(frozen=True, eq=False)
class NeatGenome:
    """An individual of NEAT: a skill's internal function, and the weights that it has there.

    Args:
        graph: the topology.
        weights: its genome, shape (genome size,).

    >>> from socialmind.mind.functions.neat.graph import NeatGraph
    >>> NeatGenome(NeatGraph.minimal(1, 1), [2.0, 0.5])
    a NEAT graph of 1 neuron and 1 connection, weights [2.0, 0.5]
    """

    graph: NeatGraph
    weights: NDArray[np.float64]

    def __post_init__(self) -> None:
        weights = np.array(self.weights, dtype=np.float64)
        weights.setflags(write=False)
        object.__setattr__(self, "weights", weights)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, NeatGenome):
            return NotImplemented
        return self.graph == other.graph and np.array_equal(self.weights, other.weights)

    def __hash__(self) -> int:
        return hash((self.graph, self.weights.shape))

    def __repr__(self) -> str:
        return f"{self.graph}, weights {self.weights.tolist()}"


class Neat(Optimiser):
    """Graphs that grow: species of graphs, each with its share of the offspring.

    The first generation connects all inputs to all outputs; mutations add and delete neurons and
    connections. Hidden neurons are ReLUs, outputs are linear and held to [0, 1]. Where all species
    die out, a generation is drawn anew; the best individual of all generations is kept.

    Runs repeat with the same releases of Python and neat-python.

    Args:
        size: the numbers of inputs and outputs, 1 or more each.
        first: a sequence of `NeatGenome` with as many, feed-forward or recurrent as set.

    >>> search = Neat((2, 1), seed=1, settings={"population": 20})
    >>> search.ask()[0].graph
    a NEAT graph of 1 neuron and 2 connections
    """

    keyword: ClassVar[str] = "NEAT"
    graphs: ClassVar[bool] = True
    known_settings: ClassVar[Mapping[str, Setting]] = MappingProxyType(
        {
            "population": Setting("graphs in a generation", 150, low=2, whole=True),
            "threshold": Setting("the distance at which graphs are of two species", 3.0),
            "disjoint": Setting("the distance that a gene without a counterpart makes", 1.0),
            "difference": Setting("the factor of differences of weights in the distance", 0.5),
            "add_neuron": Setting("the probability that a child gets a neuron", 0.2, high=1.0),
            "delete_neuron": Setting("the probability that a child loses a neuron", 0.2, high=1.0),
            "add_connection": Setting(
                "the probability that a child gets a connection", 0.5, high=1.0
            ),
            "delete_connection": Setting(
                "the probability that a child loses a connection", 0.5, high=1.0
            ),
            "enabling": Setting(
                "the probability that a connection is enabled or disabled by chance", 0.01, high=1.0
            ),
            "mutation": Setting("the probability that a weight mutates", 0.8, high=1.0),
            "step": Setting("the standard deviation of a weight's mutation", 0.5),
            "replacement": Setting(
                "the probability that a weight is drawn anew instead", 0.1, high=1.0
            ),
            "bias_mutation": Setting("the probability that a bias mutates", 0.7, high=1.0),
            "bias_step": Setting("the standard deviation of a bias's mutation", 0.5),
            "bias_replacement": Setting(
                "the probability that a bias is drawn anew instead", 0.1, high=1.0
            ),
            "spread": Setting("the standard deviation of weights and biases when drawn", 1.0),
            "bound": Setting("the greatest weight or bias, of either sign", 30.0),
            "survival": Setting("the best share of a species, which breeds", 0.2, high=1.0),
            "elite": Setting("how many of each species live on unchanged", 2, whole=True),
            "species_least": Setting("the fewest members of a species", 2, low=1, whole=True),
            "stagnation": Setting(
                "generations without gain after which a species dies out", 20, low=1, whole=True
            ),
            "species_elite": Setting(
                "how many species are spared from that; 0 lets all die out", 2, whole=True
            ),
            "recurrent": Setting(
                "1 for neurons that read values of the last evaluation, 0 for none",
                0,
                high=1,
                whole=True,
            ),
        }
    )

    @classmethod
    def of_skill(
        cls,
        skill: Skill,
        seed: int,
        settings: Mapping[str, Any] | None = None,
        first: Sequence[NeatGenome] | None = None,
    ) -> Neat:
        """Return an optimiser of graphs for a skill.

        Args:
            skill: gives the numbers of inputs and outputs; what function it has does not matter.
            seed: as of the class; so are the others.
            settings: values by name.
            first: individuals to begin from.
        """
        return cls((len(skill.inputs), len(skill.outputs)), seed, settings, first)

    def _checked_size(self, size: Any) -> tuple[int, int]:
        if not isinstance(size, Sequence) or len(size) != 2:
            raise ModelError(
                f"genome size={size!r} of NEAT", "the numbers of inputs and outputs, such as (3, 2)"
            )
        return whole("inputs", size[0], 1), whole("outputs", size[1], 1)

    def _checked_first(self, first: Any) -> list[NeatGenome]:
        if first is None:
            return []
        if not isinstance(first, Sequence):
            raise ModelError(f"first individuals of NEAT as {type(first).__name__}", "a list")
        for one in first:
            if not isinstance(one, NeatGenome):
                raise ModelError(f"{type(one).__name__} as a first individual", "a NeatGenome")
            if not np.isfinite(one.weights).all():
                raise ModelError("first individuals that are not finite", "finite weights")
        return list(first)

    def _begin(self, first: list[NeatGenome]) -> list[NeatGenome]:
        for name in ("elite", "species_least"):
            if self.settings[name] > self.population:
                raise ModelError(
                    f"{name}={self.settings[name]} of {self.population} graphs", "no more of them"
                )
        library = import_module("socialmind.learning.optimisers.neat_library")
        self._evolution = library.Evolution(*self.size, self.settings)
        self._evolution.begin(first[: self.population], self._seed())
        return self._grown()

    def _advance(self, genomes: list[NeatGenome], scores: NDArray[np.float64]) -> list[NeatGenome]:
        self._evolution.advance(scores.tolist(), self._seed())
        return self._grown()

    def _seed(self) -> int:
        """Return the seed of a generation's draws."""
        return int(self._generator.integers(1 << 63))

    def _grown(self) -> list[NeatGenome]:
        """Return the population as it stands in the library."""
        config = self._evolution.config
        return [
            NeatGenome(*NeatGraph.from_genome(genome, config))
            for genome in self._evolution.population.values()
        ]

    def _genomes_state(self) -> State:
        lines = "\n".join(self._best.graph.to_lines())
        return {
            "best_graph": np.frombuffer(lines.encode(), dtype=np.uint8).copy(),
            "best_weights": self._best.weights.copy(),
        }

    def _restore_genomes(self, state: Mapping[str, Any]) -> None:
        lines = np.asarray(state["best_graph"], dtype=np.uint8).tobytes().decode()
        self._best = NeatGenome(NeatGraph.from_lines(lines.split("\n")), state["best_weights"])
        self._genomes = self._grown()

    def _own_state(self) -> State:
        kind = np.array([*self.size, self.settings["recurrent"]], dtype=np.int64)
        return {"kind": kind, **_states().evolution_state(self._evolution)}

    def _restore_own(self, state: Mapping[str, Any]) -> None:
        _states().restore_evolution(self._evolution, state)

    def _check_fits(self, state: Mapping[str, Any], own: State) -> None:
        varying = (*_states().VARYING, "best_graph", "best_weights")
        for name in own:
            found, expected = np.shape(state[name]), np.shape(own[name])
            if name in varying:
                found, expected = found[1:], expected[1:]
            check_shape(self.keyword, name, found, expected)
        if not np.array_equal(state["kind"], own["kind"]):
            raise ModelError(
                f"a state of inputs, outputs and recurrence {np.array(state['kind']).tolist()}",
                str(own["kind"].tolist()),
                "restore with the same genome size and settings",
            )


def _states() -> Any:
    """Return the module that needs the library."""
    return import_module("socialmind.learning.optimisers.neat_state")
