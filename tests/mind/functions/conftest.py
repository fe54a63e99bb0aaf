import importlib.util
from pathlib import Path

import numpy as np
import pytest

from socialmind.mind.functions.convolution import Convolution, Kernel
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.neat.neuron import GraphNeuron
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent


def avoid():
    """The network of figure A.2: ten sensors over three moments, then each with its neighbours."""
    temporal = Kernel(3, tuple((3 * k, 3 * k + 1, 3 * k + 2) for k in range(10)))
    spatial = Kernel(3, tuple((k, (k + 1) % 10, (k + 2) % 10) for k in range(10)))
    return Convolution((temporal, spatial), bypass=(30, 31, 32, 33, 34, 35), layers=2)


CASES = [
    (Perceptron(), 3, 2),
    (Perceptron(layers=0), 2, 3),
    (Perceptron(layers=1, hidden="sigmoid", added=0), 0, 2),
    (Perceptron(layers=3, hidden="sigmoid", added=5), 15, 4),
    (avoid(), 36, 4),
    (Convolution((Kernel(2, ((0, 1), (2, 1))),), layers=1, hidden="sigmoid"), 4, 2),
    (Elman(layers=1), 2, 1),
    (Elman(layers=3, hidden="sigmoid", added=0), 3, 2),
    (Elman(), 0, 1),
    (Recurrent(layers=1), 2, 1),
    (Recurrent(layers=2, hidden="sigmoid", added=1), 3, 4),
    (NeatGraph(), 3, 2),
    (
        NeatGraph(
            2,
            3,
            (
                GraphNeuron(5, (-2, -1), "gauss", "product", 1.5),
                GraphNeuron(3, (5,), "elu", "mean"),
                GraphNeuron(2, (3, -1, 5), "abs", "maxabs"),
                GraphNeuron(0, (), "tanh"),
            ),
        ),
        2,
        3,
    ),
    (
        NeatGraph(
            1,
            2,
            (
                GraphNeuron(0, (-1, 0, 4), "sigmoid"),
                GraphNeuron(4, (1, 4, 9), "tanh", "median", 0.5),
                GraphNeuron(1, (4, 0), "sin", "max"),
            ),
            recurrent=True,
        ),
        1,
        2,
    ),
    (InfluenceNetwork(), 3, 2),
    (InfluenceNetwork(branches=3, passes=(0, 2), layers=0, gates="branch"), 3, 2),
    (InfluenceNetwork(branches=0, passes=(1, 0), layers=2, hidden="sigmoid"), 2, 2),
]


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0]}, {case[1]} to {case[2]}")
def case(request):
    """An internal function, the number of inputs and the number of outputs."""
    if isinstance(request.param[0], NeatGraph):
        pytest.importorskip("neat")  # its formulas are the definition of a graph's
    return request.param


def loaded(name):
    path = Path(__file__).parent / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def cases():
    return CASES


@pytest.fixture(scope="session")
def figure_a2():
    return avoid()


@pytest.fixture(scope="session")
def defined():
    """What a function computes by its definition."""
    return loaded("definitions").defined


@pytest.fixture(scope="session")
def stepped():
    """What a network's steps compute."""
    return loaded("stepping").stepped


@pytest.fixture
def drawn():
    """Draw a genome and a sequence of inputs for a function."""

    def draw(function, inputs, outputs, seed=1, times=5):
        rng = np.random.default_rng(seed)
        genome = rng.uniform(-1.0, 1.0, function.genome_size(inputs, outputs))
        return genome, rng.random((times, inputs))

    return draw
