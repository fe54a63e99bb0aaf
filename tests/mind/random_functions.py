"""Internal functions, regulations and networks for random minds.

The functions are plain Python in the subset that is compiled (docs/rules.md). None compares for
equality or steps at round numbers, so that rounding in the last place never shows.
"""

import math
import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from socialmind.mind import Counter, Programmed, Regulated, Regulation, Simple, Wave
from socialmind.mind.functions import network as form
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution, Kernel
from socialmind.mind.functions.draft import NetworkDraft
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import GraphNeuron, NeatGraph
from socialmind.mind.functions.network import Network, Neuron
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent

# Programmed functions --------------------------------------------------------------------------


def steady():
    return 0.35


def forward():
    return 1.0, 1.0


def turn_left():
    return 0.0, 1.0


def three_shares():
    return 0.25, 0.0, 2.5


def copy(value):
    return value


def opposite(value):
    return 1.0 - value, value


def beyond(value):
    return 3.0 * value - 1.0, value - 0.7, 0.3 + value


def whole(value):
    if value > 0.4321:
        return 1
    return 0


def seek(left, right):
    return right, left


def greater(left, right):
    return max(left, right)


def bent(left, right, gain):
    turn = math.sin(3.0 * gain) * (left - right)
    return 0.5 + turn, 0.5 - turn, gain * gain


def mean(inputs):
    total = 0.0
    for value in inputs:
        total += value
    return total / (len(inputs) + 1)


def ends(inputs):
    return inputs[0], 1.0 - inputs[-1]


def ranked(inputs):
    low = 1.0
    high = 0.0
    for value in inputs:
        low = min(low, value)
        high = max(high, value)
    return low, high, high - low, 0.125


PROGRAMS: tuple[tuple[Callable[..., Any], int | None, int], ...] = (
    (steady, 0, 1),
    (forward, 0, 2),
    (turn_left, 0, 2),
    (three_shares, 0, 3),
    (copy, 1, 1),
    (opposite, 1, 2),
    (beyond, 1, 3),
    (whole, 1, 1),
    (seek, 2, 2),
    (greater, 2, 1),
    (bent, 3, 3),
    (mean, None, 1),
    (ends, None, 2),
    (ranked, None, 4),
)
"""The programs, with how many inputs (None: one or more, as an array) and outputs each has."""

# Regulations -----------------------------------------------------------------------------------


def leak(command, value):
    return value + 0.25 * (command - value)


def held(command, commanded):
    if commanded:
        return command
    return 0.3141


def accumulated(command, memory):
    total = 0.9 * memory + command
    return total / 10.0, total


def overshooting(command, value, memory, commanded):
    step = memory * 0.5 + (command - value)
    if not commanded:
        step = 0.01
    return value + 1.5 * step, step


def random_regulation(draw: random.Random, programs: bool = True) -> Regulation:
    """Return any regulation; with `programs`, those above as well."""
    low, high = sorted((draw.uniform(0.05, 0.95), draw.uniform(0.05, 0.95)))
    choices = [Simple(), Simple(), Wave(), Counter(), Counter(draw.randint(1, 4), high, low)]
    if programs:
        choices.append(Regulated(draw.choice([leak, held, accumulated, overshooting])))
    return draw.choice(choices)


# Networks --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Built(InternalFunction):
    """A network of random steps of every kind; equal seeds build equal networks."""

    seed: int
    remembers: bool = False
    keyword: ClassVar[str] = "BUILT"

    def network(self, inputs: int, outputs: int) -> Network:
        draw = random.Random(f"{self.seed} {inputs} {outputs}")
        draft = NetworkDraft(inputs)
        kept = draw.randint(1, 4) if self.remembers else 0
        if kept:
            draft.recall(draft.keep_memory(kept), kept)
        for _ in range(draw.randint(1, 3)):
            draw.choice([_layer, _neurons, _mixed])(draw, draft)
        last = draft.dense(0, draft.nodes, max(outputs, kept), draw.choice(PLAIN))
        if kept:
            draft.remember(last, 0, kept)
        return draft.finished(last, outputs)


PLAIN = (form.LINEAR, form.RELU, form.SIGMOID, form.CLAMP, form.TANH)
SMOOTH = tuple(
    form.NEAT_ACTIVATIONS[name]
    for name in (
        "sigmoid", "tanh", "sin", "gauss", "relu", "elu", "lelu", "selu", "softplus", "identity",
        "clamped", "abs", "hat", "square",
    )
)  # fmt: skip
"""The activations of neat-python that do not blow rounding up."""


def _nodes(draw: random.Random, draft: NetworkDraft, most: int) -> tuple[int, ...]:
    count = draw.randint(min(1, draft.nodes), min(most, draft.nodes))
    return tuple(draw.sample(range(draft.nodes), count))


def _layer(draw: random.Random, draft: NetworkDraft) -> None:
    """A dense layer, over neighbouring nodes or over any that are gathered."""
    if draft.nodes and draw.random() < 0.5:
        read = _nodes(draw, draft, 6)
        draft.dense(draft.gather(read), len(read), draw.randint(1, 5), draw.choice(PLAIN))
    else:
        first = draw.randint(0, draft.nodes)
        draft.dense(first, draft.nodes - first, draw.randint(1, 5), draw.choice(PLAIN))


def _neurons(draw: random.Random, draft: NetworkDraft) -> None:
    """Neurons of their own, some of which share weights or have no bias."""
    shared = draft.keep_weights(6)
    neurons = []
    for _ in range(draw.randint(1, 4)):
        read = _nodes(draw, draft, 5)
        first = shared if draw.random() < 0.5 else draft.keep_weights(6)
        neurons.append(
            Neuron(
                read,
                tuple(first + place for place in range(len(read))),
                draw.choice([first + 5, -1]),
                draw.choice(SMOOTH),
                draw.choice(list(form.NEAT_AGGREGATIONS.values())),
                draw.choice([1.0, 1.0, draw.uniform(-1.5, 1.5)]),
            )
        )
    draft.neurons(neurons)


def _mixed(draw: random.Random, draft: NetworkDraft) -> None:
    """Nodes mixed by equation 4.3; influences may all be 0."""
    if draft.nodes == 0:
        return
    values = _nodes(draw, draft, 4)
    gates = draft.dense(0, draft.nodes, len(values), form.CLAMP)
    pairs = [(gates + place, value) for place, value in enumerate(values)]
    draft.mix([pairs, pairs[:1]])


def _convolution(draw: random.Random, inputs: int) -> Convolution:
    size = draw.randint(1, inputs)
    first = [tuple((k + j) % inputs for j in range(size)) for k in range(draw.randint(1, inputs))]
    kernels = [Kernel(size, tuple(first))]
    if draw.random() < 0.5:
        pairs = [(k, draw.randrange(len(first))) for k in range(len(first))]
        kernels.append(Kernel(2, tuple(pairs)))
    bypass = tuple(sorted(draw.sample(range(inputs), draw.randint(0, inputs))))
    hidden = draw.choice(["relu", "sigmoid"])
    return Convolution(tuple(kernels), bypass, draw.randint(0, 2), hidden)


def _graph(draw: random.Random, inputs: int, outputs: int) -> NeatGraph:
    """A feed-forward graph with hidden neurons; some outputs may have no neuron."""
    placed = [-1 - place for place in range(inputs)]
    neurons = []
    hidden = [outputs + place for place in range(draw.randint(0, 4))]
    written = [key for key in range(outputs) if draw.random() < 0.9]
    draw.shuffle(written)
    for key in [*hidden, *written]:
        read = draw.sample(placed, draw.randint(0, min(5, len(placed))))
        activation = draw.choice(["sigmoid", "tanh", "gauss", "relu", "clamped", "abs", "hat"])
        aggregation = draw.choice(["sum", "sum", "product", "max", "min", "median", "mean"])
        neurons.append(GraphNeuron(key, tuple(read), activation, aggregation))
        placed.append(key)
    return NeatGraph(inputs, outputs, tuple(neurons))


def random_function(
    draw: random.Random,
    inputs: int,
    outputs: int,
    memory: bool = True,
    programs: bool = True,
) -> InternalFunction:
    """Return any internal function for so many inputs and outputs.

    Args:
        draw: what to draw from.
        inputs, outputs: the skill's.
        memory: whether networks that remember may be among them.
        programs: whether programmed functions may.
    """
    fitting = [
        function
        for function, takes, gives in PROGRAMS
        if gives == outputs and (takes == inputs or (takes is None and inputs > 0))
    ]
    if programs and fitting and draw.random() < 0.35:
        return Programmed(draw.choice(fitting))
    hidden = draw.choice(["relu", "sigmoid"])
    added = draw.randint(0, 3)
    choices: list[Callable[[], InternalFunction]] = [
        lambda: Perceptron(),
        lambda: Perceptron(draw.randint(0, 3), hidden, added),
        lambda: Built(draw.randrange(10**6)),
        lambda: _graph(draw, inputs, outputs),
        lambda: InfluenceNetwork(
            draw.randint(1, 3),
            tuple(draw.sample(range(inputs), draw.randint(0, min(2, inputs)))),
            draw.randint(0, 2),
            hidden,
            added,
            draw.choice(["output", "branch"]),
        ),
    ]
    if inputs:
        choices.append(lambda: _convolution(draw, inputs))
    if memory:
        choices += [
            lambda: Elman(draw.randint(1, 2), hidden, added),
            lambda: Recurrent(draw.randint(1, 2), hidden, added),
            lambda: Built(draw.randrange(10**6), remembers=True),
        ]
    return draw.choice(choices)()
