"""The contract that every network keeps."""

import pickle
from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import Hierarchy, MindDescription, Skill
from socialmind.mind.functions.network import Dense, Neurons
from socialmind.mind.functions.networks import NETWORKS


def skill(function, inputs, outputs, genome=None):
    return Skill(
        "Steer",
        [f"SE:S{place}" for place in range(inputs)],
        [f"MO:M{place}" for place in range(outputs)],
        function,
        genome,
    )


def test_every_kind_has_its_keyword_and_its_cases(cases):
    assert list(NETWORKS) == ["BASIC", "CNN", "ELMAN", "RNN", "NEAT", "INFLUENCE"]
    assert all(kind.keyword == keyword for keyword, kind in NETWORKS.items())
    assert {type(function) for function, _, _ in cases} == set(NETWORKS.values())


def test_it_computes_its_definition(case, drawn, defined, stepped):
    function, inputs, outputs = case
    network = function.network(inputs, outputs)
    for seed in range(10):
        genome, sequence = drawn(function, inputs, outputs, seed)
        expected = defined(function, genome, sequence, outputs)
        assert np.allclose(stepped(network, genome, sequence), expected, rtol=0, atol=1e-12)


def test_a_mind_evaluates_it_by_its_definition(case, drawn, defined):
    function, inputs, outputs = case
    genome, sequence = drawn(function, inputs, outputs, seed=21)
    steer = skill(function, inputs, outputs, genome)
    sensors = [f"S{place}" for place in range(inputs)]
    motors = [f"M{place}" for place in range(outputs)]
    mind = Hierarchy(MindDescription("agent", sensors, motors, skills=[steer]))
    expected = defined(function, genome, sequence, outputs)
    for read, wanted in zip(sequence, expected, strict=True):
        commands = mind.evaluate(dict(zip(sensors, read, strict=True)))
        assert np.allclose([commands[name] for name in motors], wanted, rtol=0, atol=1e-12)


def test_its_outputs_are_shares_even_for_wild_weights(case, drawn, stepped):
    function, inputs, outputs = case
    genome, sequence = drawn(function, inputs, outputs, times=30)
    given = np.array(stepped(function.network(inputs, outputs), 1e3 * genome, sequence))
    assert ((given >= 0) & (given <= 1)).all()


def test_its_size_is_that_of_its_network(case):
    function, inputs, outputs = case
    network = function.network(inputs, outputs)
    assert (network.inputs, network.outputs) == (inputs, outputs)
    assert function.genome_size(inputs, outputs) == network.genome_size
    assert network.output + outputs <= network.nodes


def test_each_of_its_weights_is_read(case):
    function, inputs, outputs = case
    network = function.network(inputs, outputs)
    read = []
    for step in network.steps:
        if isinstance(step, Dense):
            read += range(step.weights, step.weights + step.neurons * (step.sources + 1))
        elif isinstance(step, Neurons):
            for neuron in step.neurons:
                read += [*neuron.weights, *([neuron.bias] if neuron.bias >= 0 else [])]
    assert set(read) == set(range(network.genome_size))


def test_a_skill_takes_it_with_a_genome_of_its_size_only(case, drawn):
    function, inputs, outputs = case
    genome, _ = drawn(function, inputs, outputs)
    assert skill(function, inputs, outputs, genome).genome.tolist() == genome.tolist()
    with pytest.raises(ModelError) as caught:
        skill(function, inputs, outputs, [*genome, 0.5])
    message = str(caught.value)
    assert f"a genome of {len(genome) + 1} weights; expected {len(genome)}, for" in message
    assert message.endswith(f"{inputs} inputs, {outputs} outputs and {function}")


def test_it_is_a_value(case):
    function, _, _ = case
    same = pickle.loads(pickle.dumps(function))
    assert same == function
    assert hash(same) == hash(function)
    with pytest.raises(FrozenInstanceError):
        setattr(function, fields(function)[0].name, 1)


def test_its_name_in_messages_is_a_phrase(case):
    assert repr(case[0]).startswith(("a ", "an "))
