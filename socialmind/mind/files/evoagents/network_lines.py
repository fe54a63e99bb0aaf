"""Networks as lines of `.ades` files, `TYPE:BASIC`, `LAYERS:2` … (thesis, A.3.1).

The YAML form and the files of weights describe networks by the same lines. TYPE:NEAT and
TYPE:INFLUENCE with BRANCHES, PASSES and GATES are ours.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from socialmind.errors import ModelError, nearest
from socialmind.mind.files.evoagents.text_file import Line, Lines
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution, Kernel
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import GATES, InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.networks import NETWORKS
from socialmind.mind.functions.perceptron import HIDDEN_ACTIVATIONS, Perceptron
from socialmind.mind.functions.recurrent import Recurrent

NEURAL = "neural"
"""The line of an `.ades` file that begins a network."""
TYPE = "TYPE"
SHORT_LAYERS = "layers"
"""The short form of LAYERS."""
HIDDEN = ("LAYERS", "HIDDEN_TRANSFER", "HIDDEN_NEURON_ADDED")
CONVOLUTIONS = ("CONVO_LAYER", "CONVO_LINK", "CONVO_BYPASS")
BRANCHES = ("BRANCHES", "PASSES", "GATES")
GRAPH = ("graph", "neuron")
"""How the lines of a NEAT graph's topology begin."""
KEYWORDS: Mapping[str, tuple[str, ...]] = {
    Perceptron.keyword: HIDDEN,
    Convolution.keyword: (*HIDDEN, *CONVOLUTIONS),
    Elman.keyword: HIDDEN,
    Recurrent.keyword: HIDDEN,
    # EvoAgents allows the layers of a network and ignores them for NEAT.
    NeatGraph.keyword: ("LAYERS",),
    InfluenceNetwork.keyword: (*HIDDEN, *BRANCHES),
}
"""What may be said of each type of network."""
MOST_LAYERS, MOST_NEURONS = 1000, 100_000
"""Beyond these a number is a slip of the pen."""


def network_of(
    lines: Lines, given: Sequence[Line], inputs: int, outputs: int, begun: int
) -> InternalFunction:
    r"""Return the network that lines describe.

    Args:
        lines: the file, for errors.
        given: the lines after `neural`.
        inputs: how many the skill has.
        outputs: how many the skill has.
        begun: the number of the line `neural`.

    Raises:
        ModelError: an unknown keyword, a wrong value …, with file and line.

    >>> lines = Lines("TYPE:ELMAN\nLAYERS:1", "Avoid.ades")
    >>> network_of(lines, lines.rest(), 3, 2, 1)
    an Elman network of 1 hidden layer
    """
    graph = [line for line in given if line.text.split()[0] in GRAPH]
    parameters = _Parameters(lines, [line for line in given if line not in graph])
    kind, place = parameters.kind(begun)
    parameters.check_known(kind)
    if graph and kind != NeatGraph.keyword:
        raise lines.error(
            f"a line of a NEAT graph in a network of {TYPE}:{kind}",
            f"{TYPE}:{NeatGraph.keyword} above it",
            "take the line out, or change the type",
            graph[0].number,
        )
    with lines.placing(place, f"correct what follows {TYPE}:{kind}"):
        if kind == NeatGraph.keyword:
            return _graph(lines, graph, inputs, outputs)
        fields = parameters.hidden()
        if kind == Convolution.keyword:
            fields |= _convolutions(parameters, inputs, place)
        if kind == InfluenceNetwork.keyword:
            fields |= _branches(parameters, inputs)
        return NETWORKS[kind](**fields)


class _Parameters:
    """The lines KEYWORD:VALUE:… of a network."""

    def __init__(self, lines: Lines, given: Sequence[Line]) -> None:
        self.lines = lines
        self.found: dict[str, list[Line]] = {}
        known = [TYPE, *dict.fromkeys(word for words in KEYWORDS.values() for word in words)]
        for line in given:
            keyword = line.fields[0]
            keyword = "LAYERS" if keyword == SHORT_LAYERS else keyword
            if keyword not in known:
                raise lines.error(
                    f"the keyword {keyword!r} of a network",
                    f"one of {', '.join(known)}",
                    nearest(keyword, known),
                    line.number,
                )
            if keyword in self.found and keyword not in CONVOLUTIONS[:2]:
                raise lines.error(
                    f"a second {keyword}, first in line {self.found[keyword][0].number}",
                    "one",
                    "take one of them out",
                    line.number,
                )
            self.found.setdefault(keyword, []).append(line)

    def kind(self, begun: int) -> tuple[str, int]:
        """Return the type of network and its line; a perceptron where none is written."""
        if TYPE not in self.found:
            return Perceptron.keyword, begun
        line = self.found[TYPE][0]
        kind = ":".join(line.fields[1:])
        if kind not in KEYWORDS:
            raise self.lines.error(
                f"{kind!r} as {TYPE} of a network",
                f"one of {', '.join(KEYWORDS)}",
                nearest(kind, KEYWORDS),
                line.number,
            )
        return kind, line.number

    def check_known(self, kind: str) -> None:
        """Refuse what does not belong to a type of network."""
        for keyword, written in self.found.items():
            if keyword not in (TYPE, *KEYWORDS[kind]):
                raise self.lines.error(
                    f"{keyword} in a network of {TYPE}:{kind}",
                    f"one of {', '.join(KEYWORDS[kind])}",
                    "take the line out, or change the type",
                    written[0].number,
                )

    def numbers(self, line: Line, most: int = MOST_NEURONS) -> list[int]:
        """Return the whole numbers of a line."""
        keyword = line.fields[0]
        values = [
            self.lines.whole_number(text, f"a number of {keyword}", line.number)
            for text in line.fields[1:]
        ]
        for value in values:
            if value > most:
                raise self.lines.error(
                    f"{value} in {keyword}",
                    f"0 … {most}",
                    "write a smaller number",
                    line.number,
                )
        return values

    def one(self, keyword: str, most: int) -> int | None:
        """Return the whole number of a keyword; None where it is not written."""
        if keyword not in self.found:
            return None
        line = self.found[keyword][0]
        values = self.numbers(line, most)
        if len(values) != 1:
            raise self.lines.error(
                repr(line.text), "one whole number", f"write {keyword}:2", line.number
            )
        return values[0]

    def word(self, keyword: str, known: Mapping[str, Any]) -> str | None:
        """Return the word of a keyword in small letters; None where it is not written."""
        if keyword not in self.found:
            return None
        line = self.found[keyword][0]
        word = ":".join(line.fields[1:]).lower()
        if word not in known:
            upper = " or ".join(one.upper() for one in known)
            raise self.lines.error(
                f"{word.upper()!r} as {keyword}", upper, f"choose {upper}", line.number
            )
        return word

    def hidden(self) -> dict[str, Any]:
        """Return what is written about hidden layers, as the networks' fields call it."""
        fields = {
            "layers": self.one("LAYERS", MOST_LAYERS),
            "hidden": self.word("HIDDEN_TRANSFER", HIDDEN_ACTIVATIONS),
            "added": self.one("HIDDEN_NEURON_ADDED", MOST_NEURONS),
        }
        return {name: value for name, value in fields.items() if value is not None}

    def places(self, keyword: str, inputs: int) -> tuple[int, ...]:
        """Return the inputs that a keyword names."""
        if keyword not in self.found:
            return ()
        line = self.found[keyword][0]
        # A keyword without a number, `PASSES:`, names none.
        values = [] if line.fields[1:] == ("",) else self.numbers(line)
        for value in values:
            _check_place(self.lines, line, value, inputs, "input")
        return tuple(values)


def _check_place(lines: Lines, line: Line, place: int, count: int, what: str) -> None:
    if place >= count:
        raise lines.error(
            f"the {what} {place} in {line.fields[0]}",
            f"0 … {count - 1}, one of {count}" if count else f"no {what}, for there is none",
            "they are counted from 0, in the order in which they are declared",
            line.number,
        )


@dataclass(frozen=True)
class _Layer:
    """A convolution layer as its line declares it."""

    line: Line
    size: int
    neurons: int


def _convolutions(parameters: _Parameters, inputs: int, place: int) -> dict[str, Any]:
    """Return the kernels and the bypass of a convolutional network."""
    lines = parameters.lines
    remedy = "write CONVO_LAYER:inputs of the kernel:neurons of the layer"
    layers: list[_Layer] = []
    for line in parameters.found.get("CONVO_LAYER", []):
        numbers = parameters.numbers(line)
        if len(numbers) != 2 or 0 in numbers:
            raise lines.error(repr(line.text), "two whole numbers, 1 or more", remedy, line.number)
        layers.append(_Layer(line, *numbers))
    if not layers:
        raise lines.error("a convolutional network without CONVO_LAYER", "one", remedy, place)
    links = _links(parameters, layers, inputs)
    kernels = []
    for kernel, layer in enumerate(layers):
        for neuron in range(layer.neurons):
            if (kernel, neuron) not in links:
                raise lines.error(
                    f"neuron {neuron} of kernel {kernel} without a CONVO_LINK",
                    f"one for each of its {layer.neurons} neurons",
                    f"write CONVO_LINK:{kernel}:{neuron}:…",
                    layer.line.number,
                )
        read = tuple(links[kernel, neuron] for neuron in range(layer.neurons))
        kernels.append(Kernel(layer.size, read))
    return {"kernels": tuple(kernels), "bypass": parameters.places("CONVO_BYPASS", inputs)}


def _links(
    parameters: _Parameters, layers: Sequence[_Layer], inputs: int
) -> dict[tuple[int, int], tuple[int, ...]]:
    """Return what each neuron of each kernel reads."""
    lines = parameters.lines
    links: dict[tuple[int, int], tuple[int, ...]] = {}
    for line in parameters.found.get("CONVO_LINK", []):
        numbers = parameters.numbers(line)
        if len(numbers) < 2:
            raise lines.error(
                repr(line.text),
                "a kernel, a neuron and what it reads",
                "write CONVO_LINK:kernel:neuron:input:input:…",
                line.number,
            )
        kernel, neuron, *read = numbers
        _check_place(lines, line, kernel, len(layers), "kernel")
        layer = layers[kernel]
        _check_place(lines, line, neuron, layer.neurons, "neuron")
        if len(read) != layer.size:
            raise lines.error(
                f"{len(read)} inputs for neuron {neuron} of kernel {kernel}",
                str(layer.size),
                f"name as many as line {layer.line.number} says",
                line.number,
            )
        for one in read:
            if kernel:
                _check_place(lines, line, one, layers[kernel - 1].neurons, "neuron below")
            else:
                _check_place(lines, line, one, inputs, "input")
        if (kernel, neuron) in links:
            raise lines.error(
                f"neuron {neuron} of kernel {kernel} linked a second time",
                "each neuron once",
                "take one of the lines out, or correct its number",
                line.number,
            )
        links[kernel, neuron] = tuple(read)
    return links


def _branches(parameters: _Parameters, inputs: int) -> dict[str, Any]:
    """Return what an influence network mixes."""
    fields = {
        "branches": parameters.one("BRANCHES", MOST_LAYERS),
        "gates": parameters.word("GATES", dict.fromkeys(GATES)),
        "passes": parameters.places("PASSES", inputs),
    }
    return {name: value for name, value in fields.items() if value is not None}


def _graph(lines: Lines, given: Sequence[Line], inputs: int, outputs: int) -> NeatGraph:
    """Return a NEAT graph, which is not drawn yet where no line tells its topology."""
    if not given:
        return NeatGraph()
    words = given[0].text.split()
    # Before the graph is built: its numbers may be any.
    if len(words) == 4 and words[2:] != [str(inputs), str(outputs)]:
        raise lines.error(
            f"a NEAT graph of {words[2]} inputs and {words[3]} outputs",
            f"{inputs} and {outputs}, as the skill has",
            "correct the line, or take the graph of this skill",
            given[0].number,
        )
    try:
        return NeatGraph.from_lines([line.text for line in given], lines.file, 0)
    except ModelError as error:
        # Blank lines and comments between them do not count as lines of the graph.
        place = given[error.line or 0].number
        remedy = error.remedy or "correct the line of the graph"
        raise lines.error(error.found, error.expected, remedy, place) from None


def network_lines(function: InternalFunction) -> list[str]:
    """Return the lines of a network after `neural`, every value written out.

    >>> network_lines(Perceptron(layers=1))
    ['TYPE:BASIC', 'LAYERS:1', 'HIDDEN_TRANSFER:RELU', 'HIDDEN_NEURON_ADDED:2']
    """
    lines = [f"{TYPE}:{function.keyword}"]
    if isinstance(function, NeatGraph):
        return lines if function.inputs is None else [*lines, *function.to_lines()]
    if not isinstance(function, Perceptron | Convolution | Elman | Recurrent | InfluenceNetwork):
        raise ModelError(
            f"{function!r} as a function to be saved",
            f"one of {', '.join(kind.__name__ for kind in NETWORKS.values())}",
            "a function of your own is saved as the program that makes it",
        )
    lines += [
        f"LAYERS:{function.layers}",
        f"HIDDEN_TRANSFER:{function.hidden.upper()}",
        f"HIDDEN_NEURON_ADDED:{function.added}",
    ]
    if isinstance(function, InfluenceNetwork):
        lines += [f"BRANCHES:{function.branches}", f"GATES:{function.gates.upper()}"]
        lines += [_joined("PASSES", function.passes)] if function.passes else []
    if isinstance(function, Convolution):
        lines += [f"CONVO_LAYER:{kernel.size}:{kernel.neurons}" for kernel in function.kernels]
        lines += [_joined("CONVO_BYPASS", function.bypass)] if function.bypass else []
        for place, kernel in enumerate(function.kernels):
            for neuron, read in enumerate(kernel.links):
                lines.append(_joined("CONVO_LINK", (place, neuron, *read)))
    return lines


def _joined(keyword: str, numbers: Sequence[int]) -> str:
    return ":".join([keyword, *map(str, numbers)])
