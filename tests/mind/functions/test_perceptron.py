"""Perceptrons: sizes and values on paper."""

import pytest

from socialmind.errors import ModelError
from socialmind.mind.functions.perceptron import Perceptron, hidden_size


@pytest.mark.parametrize(
    ("inputs", "outputs", "added", "expected"),
    [(15, 4, 2, 17), (2, 3, 2, 5), (0, 2, 0, 2), (3, 3, 1, 4)],
)
def test_hidden_layers_have_the_size_of_equation_5_1(inputs, outputs, added, expected):
    assert hidden_size(inputs, outputs, added) == expected


@pytest.mark.parametrize(
    ("function", "inputs", "outputs", "expected"),
    [
        # Avoid of figure A.1: 17 neurons a layer: 17 · 16 + 17 · 18 + 4 · 18.
        (Perceptron(), 15, 4, 650),
        # Collect: 5 neurons a layer: 5 · 3 + 5 · 6 + 3 · 6.
        (Perceptron(), 2, 3, 63),
        (Perceptron(layers=3), 2, 3, 93),
        (Perceptron(layers=0), 2, 3, 9),
        # Without inputs only the biases of the first layer: 4 + 4 · 5 + 2 · 5.
        (Perceptron(), 0, 2, 34),
        (Perceptron(layers=1, added=1), 1, 2, 14),
    ],
)
def test_sizes_on_paper(function, inputs, outputs, expected):
    assert function.genome_size(inputs, outputs) == expected


def test_one_three_two_on_paper(stepped):
    # Three hidden neurons, each a weight and a bias; two outputs, each three weights and a bias.
    genome = [0.5, 0.1, -1.0, 0.2, 2.0, -0.5, 1.0, 10.0, 0.25, 0.0, -1.0, 7.0, 2.0, 0.4]
    network = Perceptron(layers=1, added=1).network(1, 2)
    # At 0.4 the hidden neurons are 0.3, max(-0.2, 0) = 0 and 0.3.
    # Outputs: 0.3 + 0.075 + 0 = 0.375; -0.3 + 0.6 + 0.4 = 0.7.
    assert stepped(network, genome, [[0.4]])[0] == pytest.approx([0.375, 0.7], abs=1e-15)
    # At 1 they are 0.6, 0 and 1.5: 0.6 + 0.375 = 0.975; -0.6 + 3.0 + 0.4 = 2.8, held to 1.
    assert stepped(network, genome, [[1.0]])[0] == pytest.approx([0.975, 1.0], abs=1e-15)


def test_sigmoid_hidden_layers(stepped):
    network = Perceptron(layers=1, hidden="sigmoid", added=0).network(1, 1)
    assert stepped(network, [0.0, 0.0, 1.0, -0.25], [[0.7]])[0] == pytest.approx([0.25])


def test_without_hidden_layers_inputs_go_to_outputs(stepped):
    network = Perceptron(layers=0).network(2, 1)
    assert stepped(network, [0.5, -0.25, 0.1], [[0.6, 0.4]])[0] == pytest.approx([0.3])


def test_without_inputs_it_gives_what_its_biases_say(stepped):
    network = Perceptron(layers=1, added=0).network(0, 1)
    assert stepped(network, [0.5, 1.5, -0.5], [[]])[0] == pytest.approx([0.25])


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({}, "a perceptron of 2 hidden layers"),
        ({"layers": 1, "hidden": "sigmoid"}, "a perceptron of 1 hidden layer (sigmoid)"),
        ({"layers": 0}, "a perceptron of no hidden layer"),
        ({"added": 1}, "a perceptron of 2 hidden layers (1 neuron added)"),
    ],
)
def test_its_name(fields, expected):
    assert repr(Perceptron(**fields)) == expected


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        (
            {"layers": -1},
            "found -1 as the number of hidden layers of a perceptron; expected a whole number, "
            "0 or more",
        ),
        (
            {"layers": True},
            "found True as the number of hidden layers of a perceptron; expected a whole number, "
            "0 or more",
        ),
        (
            {"added": 1.5},
            "found 1.5 as the number of neurons added to a hidden layer of a perceptron; expected "
            "a whole number, 0 or more",
        ),
        (
            {"hidden": "ReLu"},
            "found 'ReLu' as the activation of the hidden layers of a perceptron; expected 'relu' "
            "or 'sigmoid'",
        ),
        (
            {"hidden": ["relu"]},
            "found ['relu'] as the activation of the hidden layers of a perceptron; expected "
            "'relu' or 'sigmoid'",
        ),
    ],
)
def test_refusals(fields, expected):
    with pytest.raises(ModelError) as caught:
        Perceptron(**fields)
    assert str(caught.value) == expected
