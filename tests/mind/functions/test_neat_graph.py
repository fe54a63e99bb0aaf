"""NEAT graphs: what neat-python computes, from genomes that it mutated."""

import random

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import Skill
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.neat.neuron import GraphNeuron
from socialmind.mind.functions.network import (
    NEAT_ACTIVATIONS,
    NEAT_AGGREGATIONS,
    Neurons,
)

CONFIG = """
[NEAT]
fitness_criterion = max
fitness_threshold = 1
no_fitness_termination = True
pop_size = 10
reset_on_extinction = False

[DefaultGenome]
num_inputs = 3
num_outputs = 2
num_hidden = 1
feed_forward = {feed_forward}
initial_connection = partial_direct 0.5
compatibility_disjoint_coefficient = 1.0
compatibility_weight_coefficient = 0.5
conn_add_prob = 0.7
conn_delete_prob = 0.4
node_add_prob = 0.6
node_delete_prob = 0.3
activation_default = random
activation_options = {activations}
activation_mutate_rate = 0.3
aggregation_default = random
aggregation_options = {aggregations}
aggregation_mutate_rate = 0.3
bias_init_mean = 0.0
bias_init_stdev = 0.5
bias_max_value = 2.0
bias_min_value = -2.0
bias_mutate_power = 0.5
bias_mutate_rate = 0.5
bias_replace_rate = 0.1
response_init_mean = 1.0
response_init_stdev = 0.3
response_max_value = 2.0
response_min_value = -2.0
response_mutate_power = 0.2
response_mutate_rate = 0.3
response_replace_rate = 0.1
weight_init_mean = 0.0
weight_init_stdev = 0.7
weight_max_value = 2.0
weight_min_value = -2.0
weight_mutate_power = 0.5
weight_mutate_rate = 0.6
weight_replace_rate = 0.1
enabled_default = True
enabled_mutate_rate = 0.2

[DefaultSpeciesSet]
compatibility_threshold = 3.0

[DefaultStagnation]
species_fitness_func = max
max_stagnation = 20
species_elitism = 2

[DefaultReproduction]
elitism = 2
survival_threshold = 0.2
min_species_size = 2
"""

# Repeated squares and cubes overflow in neat-python itself; every activation has a test of its own.
TAME = [name for name in NEAT_ACTIVATIONS if name not in ("square", "cube", "exp", "inv")]


@pytest.fixture(scope="module")
def configured(tmp_path_factory):
    """Make a configuration of neat-python."""
    neat = pytest.importorskip("neat")

    def make(feed_forward, activations=TAME):
        file = tmp_path_factory.mktemp("neat") / "config"
        text = CONFIG.format(
            feed_forward=feed_forward,
            activations=" ".join(activations),
            aggregations=" ".join(NEAT_AGGREGATIONS),
        )
        file.write_text(text, "utf-8")
        config = neat.Config(
            neat.DefaultGenome,
            neat.DefaultReproduction,
            neat.DefaultSpeciesSet,
            neat.DefaultStagnation,
            str(file),
        )
        config.genome_config.innovation_tracker = neat.innovation.InnovationTracker()
        return config

    return make


@pytest.fixture
def seeded():
    """Seed the random numbers of Python, which neat-python draws from, and put them back."""
    state = random.getstate()
    yield random.seed
    random.setstate(state)


def mutated(config, mutations):
    genome = config.genome_type(1)
    genome.configure_new(config.genome_config)
    for _ in range(mutations):
        genome.mutate(config.genome_config)
    return genome


def held(values):
    return [min(max(value, 0.0), 1.0) for value in values]


def theirs(config, genome, sequence):
    """What neat-python's own network gives."""
    import neat

    kind = neat.nn.FeedForwardNetwork if config.genome_config.feed_forward else None
    network = (kind or neat.nn.RecurrentNetwork).create(genome, config)
    return [held(network.activate(list(inputs))) for inputs in sequence]


@pytest.mark.parametrize("feed_forward", [True, False])
def test_it_computes_what_neat_python_does(feed_forward, configured, seeded, stepped):
    config = configured(feed_forward)
    sequence = np.random.default_rng(5).random((6, 3))
    seen = set()
    for seed in range(150):
        seeded(seed)
        genome = mutated(config, seed % 25)
        graph, weights = NeatGraph.from_genome(genome, config)
        assert graph.recurrent is not feed_forward
        assert len(weights) == graph.genome_size(3, 2)
        ours = stepped(graph.network(3, 2), weights, sequence)
        assert np.allclose(ours, theirs(config, genome, sequence), rtol=0, atol=1e-12)
        seen |= kinds_of_structure(genome, graph)
    assert seen >= {"dead end", "disabled", "output without connections", "hidden"}
    assert feed_forward or "loop" in seen


def kinds_of_structure(genome, graph):
    """What the mutations brought about, so that the test is known to meet it."""
    enabled = [gene.key for gene in genome.connections.values() if gene.enabled]
    kept = {neuron.key for neuron in graph.neurons}
    found = set()
    if len(enabled) < len(genome.connections):
        found.add("disabled")
    if {key for _, key in enabled} - kept:
        found.add("dead end")
    if {0, 1} - {key for _, key in enabled}:
        found.add("output without connections")
    if kept - {0, 1}:
        found.add("hidden")
    if any(key == source for source, key in enabled):
        found.add("loop")
    return found


@pytest.mark.parametrize("feed_forward", [True, False])
def test_a_genome_written_back_computes_the_same(feed_forward, configured, seeded):
    config = configured(feed_forward)
    sequence = np.random.default_rng(6).random((6, 3))
    for seed in range(40):
        seeded(seed)
        original = mutated(config, seed)
        graph, weights = NeatGraph.from_genome(original, config)
        before = random.getstate()
        genome = graph.to_genome(config, weights, key=7)
        assert random.getstate() == before
        assert genome.key == 7
        again, same = NeatGraph.from_genome(genome, config)
        assert again == graph
        assert same.tolist() == weights.tolist()
        expected = theirs(config, original, sequence)
        assert np.allclose(theirs(config, genome, sequence), expected, rtol=0, atol=1e-12)
        genome.mutate(config.genome_config)  # it can evolve further


def test_a_cycle_in_a_feed_forward_genome_is_not_evaluated(configured, seeded, stepped):
    seeded(1)
    config = configured(True)
    settings = config.genome_config
    genome = config.genome_type(1)
    for key in (0, 1, 5, 6):
        genome.nodes[key] = genome.create_node(settings, key)
        genome.nodes[key].aggregation = "sum"
    for ends in ((-1, 0), (5, 6), (6, 5), (6, 1), (-2, 5)):
        genome.connections[ends] = genome.create_connection(settings, *ends, abs(sum(ends)) + 1)
    graph, weights = NeatGraph.from_genome(genome, config)
    assert [neuron.key for neuron in graph.neurons] == [0]
    inputs = [[0.3, 0.6, 0.9]]
    assert stepped(graph.network(3, 2), weights, inputs) == theirs(config, genome, inputs)
    assert theirs(config, graph.to_genome(config, weights), inputs)[0][1] == 0.0


def test_the_genome_goes_neuron_by_neuron(stepped):
    graph = NeatGraph(
        2, 1, (GraphNeuron(3, (-2, -1), "identity"), GraphNeuron(0, (3, -1), "identity"))
    )
    # Neuron 3: second input, first input, bias; the output: neuron 3, first input, bias.
    genome = [1.0, -1.0, 0.1, 0.5, 0.25, 0.05]
    # 0.8 - 0.4 + 0.1 = 0.5; 0.25 + 0.1 + 0.05
    assert stepped(graph.network(2, 1), genome, [[0.4, 0.8]])[0] == pytest.approx([0.4], abs=1e-15)


def test_a_recurrent_neuron_reads_the_last_evaluation(stepped):
    graph = NeatGraph(1, 1, (GraphNeuron(0, (-1, 0), "identity"),), recurrent=True)
    given = stepped(graph.network(1, 1), [1.0, 0.5, 0.0], [[0.4], [0.0], [0.0]])
    assert [row[0] for row in given] == pytest.approx([0.4, 0.2, 0.1], abs=1e-15)


def test_the_recurrent_output_that_is_remembered_is_not_held(stepped):
    # As in neat-python: only what the skill gives is held to [0, 1].
    graph = NeatGraph(1, 1, (GraphNeuron(0, (-1, 0), "identity"),), recurrent=True)
    given = stepped(graph.network(1, 1), [3.0, 0.25, 0.0], [[1.0], [0.0], [0.0]])
    assert [row[0] for row in given] == pytest.approx([1.0, 0.75, 0.1875], abs=1e-15)


def test_layers_hold_neurons_that_do_not_read_each_other():
    chain = NeatGraph(
        1, 1, (GraphNeuron(1, (-1,)), GraphNeuron(2, (-1,)), GraphNeuron(0, (1, 2)))
    ).network(1, 1)
    assert [len(step.neurons) for step in chain.steps if isinstance(step, Neurons)] == [2, 1]


def test_a_graph_that_is_not_drawn_yet_is_the_minimal_one():
    assert NeatGraph().network(3, 2) == NeatGraph.minimal(3, 2).network(3, 2)
    assert NeatGraph().genome_size(3, 2) == 8
    assert repr(NeatGraph()) == "a NEAT graph that is not drawn yet"


@pytest.mark.parametrize("feed_forward", [True, False])
def test_its_text_reads_back(feed_forward, configured, seeded):
    config = configured(feed_forward)
    for seed in range(40):
        seeded(seed)
        graph, _ = NeatGraph.from_genome(mutated(config, seed), config)
        assert NeatGraph.from_lines(graph.to_lines()) == graph
    assert NeatGraph.from_lines(NeatGraph().to_lines()) == NeatGraph()


def test_its_text():
    graph = NeatGraph(2, 1, (GraphNeuron(4, (4, -2), "relu", "max", 0.25),), recurrent=True)
    assert graph.to_lines() == ["graph recurrent 2 1", "neuron 4 relu max 0.25 4 -2"]


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ([], "steer.genome:3: found a NEAT graph without lines; expected one or more"),
        (
            ["graph round 1 1"],
            "steer.genome:3: found 'graph round 1 1' as the first line of a NEAT graph; expected "
            "graph feed-forward or recurrent, the numbers of inputs and outputs, or graph minimal",
        ),
        (
            ["graph feed-forward 1 one"],
            "steer.genome:3: found 'one' in a NEAT graph; expected a whole number",
        ),
        (
            ["graph feed-forward 1 1", "", "neuron 0 tanh"],
            "steer.genome:5: found 'neuron 0 tanh' as a neuron of a NEAT graph; expected neuron, "
            "its key, activation, aggregation, response and sources",
        ),
        (
            ["graph feed-forward 1 1", "neuron 0 tanh sum much -1"],
            "steer.genome:4: found 'much' as the response of a neuron; expected a number",
        ),
        (
            ["graph feed-forward 1 1", "neuron 0 tanh total 1.0 -1"],
            "steer.genome:4: found 'total' as the aggregation of neuron 0; expected one of sum, "
            "product, max, min, maxabs, median, mean",
        ),
        (
            ["graph feed-forward 1 1", "neuron 0 tanh sum 1.0 -2"],
            "steer.genome:3: found the source -2 of neuron 0; expected one of 1 inputs, from -1 on",
        ),
    ],
)
def test_broken_text_names_its_line(lines, expected):
    with pytest.raises(ModelError) as caught:
        NeatGraph.from_lines(lines, "steer.genome", 3)
    assert str(caught.value) == expected


ONE = GraphNeuron(0, (-1,))


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: GraphNeuron(0, (-1, -1)),
            "found -1 twice among the sources of neuron 0; expected each source once",
        ),
        (
            lambda: GraphNeuron(0, (-1,), "step"),
            "found 'step' as the activation of neuron 0; expected one of "
            + ", ".join(NEAT_ACTIVATIONS),
        ),
        (
            lambda: GraphNeuron(0, (-1,), response=float("nan")),
            "found nan as the response of neuron 0; expected a finite number",
        ),
        (
            lambda: GraphNeuron(-1),
            "found -1 as the key of a neuron; expected a whole number, 0 or more",
        ),
        (
            lambda: NeatGraph(2, None),
            "found a NEAT graph that is drawn in part; expected inputs, outputs and neurons, or "
            "none of them",
        ),
        (
            lambda: NeatGraph(1, 1, (ONE, ONE)),
            "found neuron 0 twice in a NEAT graph; expected each key once",
        ),
        (
            lambda: NeatGraph(1, 1, (GraphNeuron(0, (3,)), GraphNeuron(3, (-1,)))),
            "found the source 3 of neuron 0; expected the key of a neuron before it, or a "
            "recurrent graph",
        ),
        (
            lambda: NeatGraph(1, 1, (GraphNeuron(0),), recurrent=True),
            "found neuron 0 of a recurrent NEAT graph without sources; expected one or more; "
            "neat-python does not evaluate it, so leave it out: it counts as 0",
        ),
        (
            lambda: NeatGraph(1, 1, ("neuron",)),
            "found 'neuron' as a neuron of a NEAT graph; expected a GraphNeuron",
        ),
        (
            lambda: NeatGraph(1, 1, (ONE,)).network(2, 1),
            "found a NEAT graph of 1 neuron and 1 connection that has 1 inputs and 1 outputs; "
            "expected 2 inputs and 1 outputs",
        ),
        (
            lambda: Skill("Go", ["SE:S"], ["MO:L", "MO:R"], NeatGraph(1, 1, (ONE,))),
            "found the skill 'Go' with a NEAT graph of 1 neuron and 1 connection that has 1 inputs "
            "and 1 outputs; expected 1 inputs and 2 outputs, as it has",
        ),
    ],
)
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected


def test_refusals_with_neat_python(configured, seeded):
    seeded(3)
    config = configured(True)
    graph, weights = NeatGraph.from_genome(mutated(config, 5), config)
    with pytest.raises(ModelError, match="weights for a NEAT graph of"):
        graph.to_genome(config, weights[:-1])
    with pytest.raises(ModelError, match="feed_forward = False; expected 3, 2 and True"):
        graph.to_genome(configured(False), weights)
    with pytest.raises(ModelError, match="that is not drawn yet; take"):
        NeatGraph().to_genome(config, [])
    own = config.genome_config
    own.add_activation("mine", lambda x: 2 * x)
    genome = mutated(config, 0)
    genome.nodes[0].activation = "mine"
    with pytest.raises(ModelError, match="found 'mine' as the activation of neuron 0"):
        NeatGraph.from_genome(genome, config)
