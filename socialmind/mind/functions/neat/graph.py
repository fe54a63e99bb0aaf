"""NEAT graphs: networks whose topology evolves, as neat-python has them (thesis, A.3.1)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError, of_model_file
from socialmind.mind.functions import network
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.neat.genome import read_genome, written_genome
from socialmind.mind.functions.neat.neuron import GraphNeuron, whole
from socialmind.mind.functions.perceptron import check_whole

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill

Weights = Sequence[float] | NDArray[np.float64]

FORWARD, RECURRENT, MINIMAL = "feed-forward", "recurrent", "minimal"
"""The kinds of graph in the text form."""


@dataclass(frozen=True)
class NeatGraph(InternalFunction):
    """The topology of a neat-python genome (`TYPE:NEAT`).

    Its weights and biases are the skill's genome; activations, aggregations and responses belong to
    the topology, connections that are not enabled do not. A feed-forward graph computes what
    `neat.nn.FeedForwardNetwork` does, a recurrent one what `neat.nn.RecurrentNetwork` does: each
    neuron reads the inputs of now and the neurons of the last evaluation, 0 at the start. Outputs
    are held to [0, 1]. An output or a source without a neuron is 0.

    The genome goes neuron by neuron in the order of `neurons`: the weights in the order of the
    sources, then the bias.

    Args:
        inputs: how many inputs; None for a graph that is not drawn yet: it connects all inputs of
            its skill to all outputs, which have neat-python's `sigmoid`.
        outputs: how many outputs, None likewise.
        neurons: the neurons; those of a feed-forward graph come after their sources.
        recurrent: whether neurons read each other's values of the last evaluation.

    Raises:
        ModelError: a key twice, a source that there is not or that comes later, a neuron of a
            recurrent graph without sources (neat-python does not evaluate it), …

    >>> graph = NeatGraph(2, 1, (GraphNeuron(1, (-1, -2), "tanh"), GraphNeuron(0, (1,))))
    >>> graph
    a NEAT graph of 2 neurons and 3 connections
    >>> graph.genome_size(2, 1)
    5
    """

    inputs: int | None = None
    outputs: int | None = None
    neurons: tuple[GraphNeuron, ...] = ()
    recurrent: bool = False
    keyword: ClassVar[str] = "NEAT"

    def __post_init__(self) -> None:
        if not isinstance(self.neurons, tuple | list):
            raise ModelError(f"{self.neurons!r} as the neurons of a NEAT graph", "GraphNeurons")
        object.__setattr__(self, "neurons", tuple(self.neurons))
        for neuron in self.neurons:
            if not isinstance(neuron, GraphNeuron):
                raise ModelError(f"{neuron!r} as a neuron of a NEAT graph", "a GraphNeuron")
        if self.inputs is None or self.outputs is None:
            given = (self.inputs, self.outputs, self.neurons, self.recurrent)
            if given != (None, None, (), False):
                raise ModelError(
                    "a NEAT graph that is drawn in part",
                    "inputs, outputs and neurons, or none of them",
                )
            return
        object.__setattr__(
            self, "inputs", check_whole(self.inputs, "the number of inputs of a NEAT graph", 0)
        )
        object.__setattr__(
            self, "outputs", check_whole(self.outputs, "the number of outputs of a NEAT graph", 1)
        )
        keys = [neuron.key for neuron in self.neurons]
        known = {-place for place in range(1, self.inputs + 1)}
        if self.recurrent:
            known.update(keys)
        for place, neuron in enumerate(self.neurons):
            if neuron.key in keys[:place]:
                raise ModelError(f"neuron {neuron.key} twice in a NEAT graph", "each key once")
            if self.recurrent and not neuron.sources:
                raise ModelError(
                    f"neuron {neuron.key} of a recurrent NEAT graph without sources",
                    "one or more",
                    "neat-python does not evaluate it, so leave it out: it counts as 0",
                )
            for source in neuron.sources:
                if source in known or (self.recurrent and source >= 0):
                    continue
                if source < 0:
                    expected = f"one of {self.inputs} inputs, from -1 on"
                else:
                    expected = "the key of a neuron before it, or a recurrent graph"
                raise ModelError(f"the source {source} of neuron {neuron.key}", expected)
            known.add(neuron.key)

    @classmethod
    def minimal(cls, inputs: int, outputs: int) -> NeatGraph:
        """Return the graph that connects all inputs to all outputs.

        >>> NeatGraph.minimal(3, 2)
        a NEAT graph of 2 neurons and 6 connections
        """
        sources = tuple(range(-1, -inputs - 1, -1))
        return cls(inputs, outputs, tuple(GraphNeuron(key, sources) for key in range(outputs)))

    @classmethod
    def from_genome(cls, genome: Any, config: Any) -> tuple[NeatGraph, NDArray[np.float64]]:
        """Return the topology and the weights of a genome of neat-python.

        Neurons that no output depends on are left out.

        Args:
            genome: a `neat.DefaultGenome`.
            config: the `neat.Config` that it belongs to; its `feed_forward` says which kind of
                network it is.

        Returns:
            The graph and its genome, shape (genome size,).

        Raises:
            ModelError: an activation or an aggregation of the modeller's own.
        """
        settings = config.genome_config
        neurons, weights = read_genome(genome, config)
        graph = cls(
            len(settings.input_keys),
            len(settings.output_keys),
            tuple(neurons),
            not settings.feed_forward,
        )
        return graph, np.array(weights, dtype=np.float64)

    def to_genome(self, config: Any, weights: Weights, key: int = 0) -> Any:
        """Return a genome of neat-python that computes the same, to evolve it further.

        Args:
            config: the `neat.Config` that it is to belong to.
            weights: the graph's genome, shape (genome size,).
            key: the key of the neat-python genome.

        Returns:
            A genome of the configuration's type. Connections get the innovation numbers of the
            configuration's tracker, or 1, 2, … where it has none yet.

        Raises:
            ModelError: the graph is not drawn yet, or the configuration or the number of weights
                does not fit it.
        """
        settings = config.genome_config
        if self.inputs is None or self.outputs is None:
            raise ModelError("a NEAT graph that is not drawn yet", remedy="take NeatGraph.minimal")
        theirs = (len(settings.input_keys), len(settings.output_keys), settings.feed_forward)
        if theirs != (self.inputs, self.outputs, not self.recurrent):
            raise ModelError(
                f"a configuration of {theirs[0]} inputs, {theirs[1]} outputs and feed_forward = "
                f"{theirs[2]}",
                f"{self.inputs}, {self.outputs} and {not self.recurrent}, as in the graph",
            )
        if len(weights) != self.genome_size(self.inputs, self.outputs):
            size = self.genome_size(self.inputs, self.outputs)
            raise ModelError(f"{len(weights)} weights for {self}", f"{size}")
        return written_genome(config, self.neurons, self._without_neuron(), weights, key)

    def _without_neuron(self) -> list[int]:
        """Return the outputs and sources that have no neuron, in order."""
        keys = {neuron.key for neuron in self.neurons}
        named = [*range(self.outputs or 0)]
        named += [source for neuron in self.neurons for source in neuron.sources if source >= 0]
        return sorted(set(named) - keys)

    def check(self, skill: Skill) -> None:
        """Refuse a skill with other numbers of inputs and outputs than the graph has.

        Raises:
            ModelError: so it is.
        """
        found = self._mismatch(len(skill.inputs), len(skill.outputs))
        if found is not None:
            numbers = f"{len(skill.inputs)} inputs and {len(skill.outputs)} outputs, as it has"
            raise skill.refused(f"with {found}", numbers)

    def _mismatch(self, inputs: int, outputs: int) -> str | None:
        if self.inputs is None or (inputs, outputs) == (self.inputs, self.outputs):
            return None
        return f"{self} that has {self.inputs} inputs and {self.outputs} outputs"

    def network(self, inputs: int, outputs: int) -> network.Network:
        """Return what it computes as steps of arithmetic.

        Raises:
            ModelError: the graph has other numbers of inputs and outputs.
        """
        found = self._mismatch(inputs, outputs)
        if found is not None:
            raise ModelError(found, f"{inputs} inputs and {outputs} outputs")
        if self.inputs is None:
            return NeatGraph.minimal(inputs, outputs).network(inputs, outputs)
        draft = NetworkDraft(inputs)
        nodes = {-place - 1: place for place in range(inputs)}
        silent = self._without_neuron()
        if silent:
            nothing = draft.neurons([network.Neuron((), (), -1, network.LINEAR)])
            nodes.update(dict.fromkeys(silent, nothing))
        if self.recurrent and self.neurons:
            count = len(self.neurons)
            memory = draft.keep_memory(count)
            last = draft.recall(memory, count)
            read = nodes | {one.key: last + place for place, one in enumerate(self.neurons)}
            first = draft.neurons([_neuron(draft, one, read) for one in self.neurons])
            draft.remember(first, memory, count)
            nodes.update({one.key: first + place for place, one in enumerate(self.neurons)})
        else:
            for layer in _layers(self.neurons):
                first = draft.neurons([_neuron(draft, one, nodes) for one in layer])
                nodes.update({one.key: first + place for place, one in enumerate(layer)})
        output = draft.gather([nodes[key] for key in range(outputs)])
        return draft.finished(output, outputs)

    def to_lines(self) -> list[str]:
        """Return the topology as lines of text: the kind, then a line for each neuron.

        >>> for line in NeatGraph(2, 1, (GraphNeuron(0, (-1, -2), "tanh"),)).to_lines():
        ...     print(line)
        graph feed-forward 2 1
        neuron 0 tanh sum 1.0 -1 -2
        """
        if self.inputs is None:
            return [f"graph {MINIMAL}"]
        kind = RECURRENT if self.recurrent else FORWARD
        header = f"graph {kind} {self.inputs} {self.outputs}"
        return [header, *(neuron.to_line() for neuron in self.neurons)]

    @classmethod
    def from_lines(cls, lines: Iterable[str], file: str | None = None, first: int = 1) -> NeatGraph:
        """Return the topology that lines of text write, as `to_lines` gives them.

        Args:
            lines: the lines; blank ones count for nothing.
            file: the file that they stand in, for errors.
            first: the number of the first line in it.

        Raises:
            ModelError: a line writes none, with file and line.

        >>> NeatGraph.from_lines(["graph recurrent 1 1", "neuron 0 tanh sum 1.0 -1 0"])
        a recurrent NEAT graph of 1 neuron and 2 connections
        """
        written = [(line, text) for line, text in enumerate(lines, first) if text.strip()]
        if not written:
            raise ModelError("a NEAT graph without lines", "one or more", file=file, line=first)
        (start, header), *rest = written
        with of_model_file(file, start):
            fields = _header(header)
        neurons = []
        for line, text in rest:
            with of_model_file(file, line):
                neurons.append(GraphNeuron.from_line(text))
        with of_model_file(file, start):
            return cls(**fields, neurons=tuple(neurons))

    def __repr__(self) -> str:
        if self.inputs is None:
            return "a NEAT graph that is not drawn yet"
        neurons = len(self.neurons)
        connections = sum(len(neuron.sources) for neuron in self.neurons)
        return (
            f"a {'recurrent ' * self.recurrent}NEAT graph of {neurons} neuron{'s' * (neurons != 1)}"
            f" and {connections} connection{'s' * (connections != 1)}"
        )


def _layers(neurons: Iterable[GraphNeuron]) -> list[list[GraphNeuron]]:
    """Return neurons in their order, cut where one reads another of its layer."""
    layers: list[list[GraphNeuron]] = []
    for neuron in neurons:
        if not layers or any(one.key in neuron.sources for one in layers[-1]):
            layers.append([])
        layers[-1].append(neuron)
    return layers


def _neuron(draft: NetworkDraft, neuron: GraphNeuron, nodes: Mapping[int, int]) -> network.Neuron:
    """Return a neuron as a step's, with weights and a bias of its own."""
    count = len(neuron.sources)
    first = draft.keep_weights(count + 1)
    return network.Neuron(
        sources=tuple(nodes[source] for source in neuron.sources),
        weights=tuple(range(first, first + count)),
        bias=first + count,
        activation=network.NEAT_ACTIVATIONS[neuron.activation],
        aggregation=network.NEAT_AGGREGATIONS[neuron.aggregation],
        response=float(neuron.response),
    )


def _header(line: str) -> dict[str, Any]:
    """Return what the first line of the text form says."""
    words = line.split()
    if words == ["graph", MINIMAL]:
        return {}
    if len(words) == 4 and words[0] == "graph" and words[1] in (FORWARD, RECURRENT):
        inputs, outputs = (whole(word) for word in words[2:])
        return {"inputs": inputs, "outputs": outputs, "recurrent": words[1] == RECURRENT}
    raise ModelError(
        f"{' '.join(words)!r} as the first line of a NEAT graph",
        f"graph {FORWARD} or {RECURRENT}, the numbers of inputs and outputs, or graph {MINIMAL}",
    )
