"""Elman and recurrent networks: what they remember, on paper."""

import pytest

from socialmind.errors import ModelError
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.network import MEMORY_BOUND
from socialmind.mind.functions.recurrent import Recurrent


def test_an_elman_layer_reads_its_own_last_values(stepped):
    network = Elman(layers=1, added=0).network(1, 1)
    # The hidden neuron: input, context, bias; the output: the hidden neuron, bias.
    genome = [0.5, 0.5, 0.1, 1.0, 0.0]
    given = stepped(network, genome, [[0.2], [0.4], [0.0]])
    # 0.1 + 0 + 0.1; 0.2 + 0.1 + 0.1; 0 + 0.2 + 0.1
    assert [row[0] for row in given] == pytest.approx([0.2, 0.4, 0.3], abs=1e-15)


def test_each_elman_layer_has_a_context_of_its_own(stepped):
    network = Elman(layers=2, added=0).network(1, 1)
    genome = [1.0, 0.0, 0.0, 1.0, 0.5, 0.0, 1.0, 0.0]
    given = stepped(network, genome, [[0.4], [0.0], [0.0]])
    # Only the second layer remembers: 0.4, half of it, a quarter.
    assert [row[0] for row in given] == pytest.approx([0.4, 0.2, 0.1], abs=1e-15)


def test_a_recurrent_layer_reads_hidden_and_output_neurons(stepped):
    network = Recurrent(layers=1, added=0).network(1, 1)
    # The hidden neuron: input, hidden, output, bias; the output: the hidden neuron, bias.
    genome = [1.0, 0.1, 0.25, 0.0, 2.0, 0.0]
    given = stepped(network, genome, [[0.1], [0.2], [0.8], [0.0]])
    # Hidden: 0.1; 0.2 + 0.01 + 0.05 = 0.26; 0.8 + 0.026 + 0.13 = 0.956; 0.0956 + 0.25 · 1.
    assert [row[0] for row in given] == pytest.approx([0.2, 0.52, 1.0, 0.6912], abs=1e-15)


def test_all_recurrent_layers_read_all_layers(stepped):
    network = Recurrent(layers=2, added=0).network(1, 1)
    # First layer: input, first, second, output, bias; the second likewise above the first.
    genome = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.1, 1.0, 0.0]
    given = stepped(network, genome, [[0.4], [0.8], [0.0]])
    # The second layer reads what the first was at the last evaluation.
    assert [row[0] for row in given] == pytest.approx([0.1, 0.3, 0.5], abs=1e-15)


@pytest.mark.parametrize(
    ("function", "expected"),
    [
        # 4 neurons: 4 · (2 + 4 + 1); 4 · (4 + 4 + 1); 1 · (4 + 1).
        (Elman(), 28 + 36 + 5),
        # 4 neurons: 4 · (2 + 8 + 1 + 1); 4 · (4 + 8 + 1 + 1); 1 · (4 + 1).
        (Recurrent(), 48 + 56 + 5),
    ],
)
def test_sizes_on_paper(function, expected):
    assert function.genome_size(2, 1) == expected


@pytest.mark.parametrize("function", [Elman(layers=1, added=0), Recurrent(layers=1, added=0)])
def test_what_it_remembers_stays_finite(function, stepped):
    genome = [1e3] * function.genome_size(1, 1)
    genome[-2:] = [0.1 / (1e3 * MEMORY_BOUND), 0.0]
    given = stepped(function.network(1, 1), genome, [[1.0]] * 300)
    # The hidden neuron is a thousand times what is remembered of it at most, and a little more.
    assert given[-1] == pytest.approx([0.1], rel=1e-5)


@pytest.mark.parametrize(
    ("kind", "what"), [(Elman, "an Elman network"), (Recurrent, "a recurrent network")]
)
def test_they_need_a_hidden_layer(kind, what):
    assert repr(kind()) == f"{what} of 2 hidden layers"
    with pytest.raises(ModelError) as caught:
        kind(layers=0)
    assert str(caught.value) == (
        f"found 0 as the number of hidden layers of {what}; expected a whole number, 1 or more"
    )
