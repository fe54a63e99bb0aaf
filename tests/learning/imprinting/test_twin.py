"""The trainable twin: the same outputs as the definition, and true gradients."""

import copy
import importlib.util
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.mind import Programmed
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.neat.neuron import GraphNeuron
from socialmind.mind.functions.network import LINEAR, SIGMOID, Network, Neuron, Neurons
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent

torch = pytest.importorskip("torch")

from socialmind.learning.imprinting.initial_genome import initial_genome  # noqa: E402
from socialmind.learning.imprinting.twin import Twin  # noqa: E402


def drawn(twin, seed, scale=1.0):
    rng = np.random.default_rng(seed)
    genome = rng.uniform(-scale, scale, twin.network.genome_size)
    return genome, rng.random((4, 3, twin.network.inputs))  # time, batch, inputs


def set_weights(twin, genome):
    with torch.no_grad():
        twin.genome.copy_(torch.tensor(genome))


def test_it_computes_the_definition(case, defined):
    function, inputs, outputs = case
    twin = Twin(function, inputs, outputs)
    for seed in range(10):
        genome, sequence = drawn(twin, seed)
        set_weights(twin, genome)
        given = twin.run(sequence).detach().numpy()
        assert given.shape == (4, 3, outputs)
        for agent in range(3):
            expected = defined(function, genome, sequence[:, agent], outputs)
            assert np.allclose(given[:, agent], expected, rtol=0, atol=1e-12)


def test_its_gradients_are_those_of_finite_differences(case):
    function, inputs, outputs = case
    twin = Twin(function, inputs, outputs)
    genome, sequence = drawn(twin, 11, scale=0.7)

    def outputs_of(genome, clamp=True):
        given, memory = [], None
        for values in torch.as_tensor(sequence):
            step, memory = torch.func.functional_call(
                Stepping(twin), {"twin.genome": genome}, (values, memory, clamp)
            )
            given.append(step)
        return torch.stack(given)

    weights = torch.tensor(genome, requires_grad=True)
    assert torch.autograd.gradcheck(outputs_of, [weights], fast_mode=len(genome) > 100)


class Stepping(torch.nn.Module):
    """A twin of which a call is a step."""

    def __init__(self, twin):
        super().__init__()
        self.twin = twin

    def forward(self, *given):
        return self.twin.step(*given)


def test_its_gradients_reach_the_inputs():
    twin = Twin(Perceptron(hidden="sigmoid"), 3, 2, seed=4)
    inputs = torch.rand(5, 3, dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(lambda x: twin(x, clamp=False), [inputs])


def test_without_clamping_gradients_do_not_vanish():
    twin = Twin(Perceptron(layers=0), 1, 1, genome=[1.0, 2.0])
    twin([[0.5]]).sum().backward()
    assert twin.genome.grad.tolist() == [0.0, 0.0]
    given = twin([[0.5]], clamp=False)
    assert given.tolist() == [[2.5]]
    given.sum().backward()
    assert twin.genome.grad.tolist() == [0.5, 1.0]


def test_gradients_pass_through_the_gates_of_an_influence_network():
    # Influences 1.5, held to 1, and 0.5; branches 0.2 and 0.8.
    twin = Twin(InfluenceNetwork(layers=0), 0, 1, genome=[1.5, 0.5, 0.2, 0.8])
    given = twin(torch.zeros(1, 0), clamp=False)
    assert given.item() == pytest.approx(0.4)
    given.sum().backward()
    # d(i·v + j·w) / (i + j) / di = (v - mix) / (i + j) at i = 1
    assert twin.genome.grad.tolist() == pytest.approx([-0.2 / 1.5, 0.4 / 1.5, 1 / 1.5, 0.5 / 1.5])


@pytest.mark.parametrize("kind", [Elman, Recurrent])
def test_what_is_remembered_does_not_depend_on_clamping(kind):
    twin = Twin(kind(layers=1), 2, 1, genome=np.full(kind(layers=1).genome_size(2, 1), 0.9))
    inputs = [[0.9, 0.8]]
    clamped, first = twin.step(inputs)
    linear, second = twin.step(inputs, clamp=False)
    assert linear.item() > 1.0 == clamped.item()
    assert first.tolist() == second.tolist()


def test_it_carries_its_memory_when_asked():
    twin = Twin(Elman(layers=1, added=0), 1, 1, genome=[0.5, 0.5, 0.1, 1.0, 0.0])
    outputs, memory = twin.step([[0.2]])
    assert (outputs.item(), memory.item()) == pytest.approx((0.2, 0.2))
    assert twin([[0.4]], memory).item() == pytest.approx(0.4)
    assert twin([[0.4]]).item() == pytest.approx(0.3)  # from the start again
    assert twin.run([[[0.2]], [[0.4]]]).flatten().tolist() == pytest.approx([0.2, 0.4])
    assert twin.run(np.zeros((0, 3, 1))).shape == (0, 3, 1)


def test_neurons_of_one_step_may_read_each_other():
    class Chain(Perceptron):
        def network(self, inputs, outputs):
            neurons = (
                Neuron((0,), (0,), -1, LINEAR),
                Neuron((1,), (1,), 2, SIGMOID),
                Neuron((2, 0), (3, 4), -1, LINEAR),
            )
            return Network(1, 1, 3, 4, 5, 0, (Neurons(1, neurons),))

    twin = Twin(Chain(), 1, 1, genome=[2.0, 1.0, -1.0, 0.5, 0.25])
    # 1.0; sigmoid(1 - 1) = 0.5; 0.25 + 0.125
    assert twin([[0.5]]).item() == pytest.approx(0.375)


def test_drawn_weights_keep_to_the_size_of_their_layer():
    network = Perceptron(layers=2, added=28).network(2, 2)
    genome = initial_genome(network, seed=3).numpy()
    first, second, last = genome[:90].reshape(30, 3), genome[90:1020].reshape(30, 31), genome[1020:]
    for weights, limit in (
        (first[:, :-1], np.sqrt(6 / 2)),
        (second[:, :-1], np.sqrt(6 / 30)),
        (last.reshape(2, 31)[:, :-1], np.sqrt(6 / 32)),
    ):
        assert 0.9 * limit < np.abs(weights).max() <= limit
    assert last.reshape(2, 31)[:, -1].tolist() == [0.5, 0.5]
    # Each first neuron's kink passes through the unit square: it is silent on one side only.
    corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
    there = first[:, :-1] @ corners.T + first[:, -1:]
    assert ((there.min(1) < 0) & (there.max(1) > 0)).all()


def test_neurons_of_neat_are_drawn_as_their_like():
    count = 200
    hidden = (GraphNeuron(one, (-1, -2), "relu") for one in range(1, count + 1))
    output = GraphNeuron(0, tuple(range(1, count + 1)), "identity")
    graph = NeatGraph(2, 1, (*hidden, output))
    genome = initial_genome(graph.network(2, 1), seed=3).numpy()
    first = genome[: 3 * count].reshape(count, 3)
    assert np.sqrt(6 / 3) < np.abs(first[:, :-1]).max() <= np.sqrt(6 / 2)
    corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
    there = first[:, :-1] @ corners.T + first[:, -1:]
    assert ((there.min(1) < 0) & (there.max(1) > 0)).all()
    assert genome[-1] == 0.5  # the output's bias


def test_drawn_weights_are_the_seed_s():
    torch.manual_seed(1)
    before = torch.get_rng_state()
    first, again, other = (Twin(Elman(), 3, 2, seed=seed).weights for seed in (5, 5, 6))
    assert first.tolist() == again.tolist() != other.tolist()
    assert torch.equal(torch.get_rng_state(), before)


def test_each_weight_is_drawn(case):
    function, inputs, outputs = case
    genome = initial_genome(function.network(inputs, outputs), seed=1)
    assert torch.isfinite(genome).all()
    assert (genome != 0.0).all()


def test_it_is_an_ordinary_module():
    twin = Twin(NeatGraph.minimal(2, 1), 2, 1, seed=1)
    assert [name for name, _ in twin.named_parameters()] == ["genome"]
    assert list(twin.state_dict()) == ["genome"]
    inputs = [[0.1, 0.9]]
    for other in (copy.deepcopy(twin), pickle.loads(pickle.dumps(twin))):
        assert other(inputs).tolist() == twin(inputs).tolist()
    assert "NEAT graph" in repr(twin)
    single = Twin(NeatGraph.minimal(2, 1), 2, 1, genome=twin.weights, dtype=torch.float32)
    assert single(inputs).dtype == torch.float32
    assert single(inputs).item() == pytest.approx(twin(inputs).item(), abs=1e-6)


def test_its_genome_is_its_own():
    genome = np.array([1.0, 0.0])
    twin = Twin(Perceptron(layers=0), 1, 1, genome=genome)
    torch.optim.SGD(twin.parameters(), 1.0).zero_grad()
    set_weights(twin, [0.5, 0.5])
    assert genome.tolist() == [1.0, 0.0]
    weights = twin.weights
    weights[0] = 9.0
    assert twin.weights.tolist() == [0.5, 0.5]


def test_a_wild_graph_stays_finite():
    graph = NeatGraph(
        1,
        1,
        (
            GraphNeuron(1, (-1,), "cube"),
            GraphNeuron(2, (1,), "cube"),
            GraphNeuron(3, (2, 1), "cube", "product"),
            GraphNeuron(0, (3, 2), "identity"),
        ),
    )
    twin = Twin(graph, 1, 1, genome=np.full(graph.genome_size(1, 1), 1e30))
    twin([[1.0]], clamp=False).sum().backward()
    assert twin([[1.0]]).item() == 1.0


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: Twin(Programmed(len), 1, 1),
            "found the function len to be trained; expected a network, which has weights",
        ),
        (
            lambda: Twin(Perceptron(layers=0), 1, 1, genome=[1.0]),
            "found a genome of 1 weights for a perceptron of no hidden layer; expected 2",
        ),
        (
            lambda: Twin(Perceptron(layers=0), 1, 1, genome=[1.0, float("inf")]),
            "found a genome with weights that are no finite numbers; expected finite numbers",
        ),
        (
            lambda: Twin(Perceptron(), 2, 1)([0.1, 0.2]),
            "found inputs of shape (2,); expected (batch, 2)",
        ),
        (
            lambda: Twin(Perceptron(), 2, 1).run([[0.1, 0.2]]),
            "found a sequence of shape (1, 2); expected (time, batch, 2)",
        ),
        (
            lambda: Twin(Elman(), 2, 1)([[0.1, 0.2]], torch.zeros(1, 3)),
            "found a memory of shape (1, 3); expected (1, 8)",
        ),
    ],
)
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected


def test_without_torch_it_says_how_to_get_it(monkeypatch):
    import socialmind.learning.imprinting.pytorch as found

    monkeypatch.setitem(sys.modules, "torch", None)
    spec = importlib.util.spec_from_file_location("missing", Path(found.__file__))
    with pytest.raises(SocialmindError) as caught:
        spec.loader.exec_module(importlib.util.module_from_spec(spec))
    assert isinstance(caught.value, ImportError)
    assert str(caught.value) == (
        "supervised learning needs PyTorch, which is not installed; "
        "pip install 'socialmind[learning]'"
    )
