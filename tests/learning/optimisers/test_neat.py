"""NEAT: what it learns, beside neat-python's own loop, extinction and crowding."""

import random
import sys
import threading

import numpy as np
import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning.optimisers.neat import Neat, NeatGenome
from socialmind.mind import Skill
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.neat.neuron import GraphNeuron

neat = pytest.importorskip("neat")

XOR = [((0.0, 0.0), 0.0), ((0.0, 1.0), 1.0), ((1.0, 0.0), 1.0), ((1.0, 1.0), 0.0)]


def learned(search, judge, enough, generations):
    """Let an optimiser learn until a score is reached, and return its best individual."""
    for _ in range(generations):
        search.tell([judge(one) for one in search.ask()])
        if search.best_score >= enough:
            break
    assert search.best_score >= enough
    return search.best


STRUCTURAL = ("add_neuron", "add_connection", "delete_connection", "delete_neuron", "enabling")
UNCHANGED = (*STRUCTURAL, "mutation", "replacement", "bias_mutation", "bias_replacement")


def weights_of(genomes):
    return {weight for one in genomes for weight in one.weights.tolist()}


def hidden(graph):
    return [neuron for neuron in graph.neurons if neuron.key >= graph.outputs]


@pytest.mark.parametrize("seed", range(3))
def test_it_learns_exclusive_or_which_takes_a_hidden_neuron(seed, stepped):
    def judge(one):
        network = one.graph.network(2, 1)
        given = [stepped(network, one.weights, [inputs])[0][0] for inputs, _ in XOR]
        return -sum((have - want) ** 2 for have, (_, want) in zip(given, XOR, strict=True))

    best = learned(Neat((2, 1), seed), judge, -0.05, 200)
    assert hidden(best.graph)
    assert {neuron.activation for neuron in hidden(best.graph)} == {"relu"}
    assert [one.activation for one in best.graph.neurons if one.key == 0] == ["identity"]
    skill = Skill("Xor", ["SE:A", "SE:B"], ["MO:C"], best.graph, genome=best.weights)
    assert skill.genome.tolist() == best.weights.tolist()


@pytest.mark.parametrize("seed", range(3))
def test_it_learns_to_bring_a_cart_to_a_place_and_hold_it_there(seed, stepped):
    """Place and speed suffice to know the push, so no memory is needed."""

    def judge(one):
        network = one.graph.network(2, 1)
        error = 0.0
        for start in (-1.0, 1.0):
            place, speed = start, 0.0
            for tick in range(40):
                inputs = [min(max(0.5 + value / 4.0, 0.0), 1.0) for value in (place, speed)]
                push = 2.0 * stepped(network, one.weights, [inputs])[0][0] - 1.0
                speed += 0.2 * push
                place += 0.2 * speed
                error += abs(place) / 40 if tick >= 20 else 0.0
        return -error

    still = -2 * 20 / 40  # where nothing is pushed
    best = learned(Neat((2, 1), seed, {"population": 40}), judge, 0.05 * still, 60)
    assert judge(best) >= 0.05 * still


CONFIG = """
[NEAT]
fitness_criterion = max
fitness_threshold = 1
no_fitness_termination = True
pop_size = 60
reset_on_extinction = True

[Genome]
num_inputs = 2
num_outputs = 2
num_hidden = 0
feed_forward = {feed_forward}
initial_connection = full_direct
compatibility_disjoint_coefficient = 1.0
compatibility_weight_coefficient = 0.5
conn_add_prob = 0.5
conn_delete_prob = 0.5
node_add_prob = 0.2
node_delete_prob = 0.2
activation_default = relu
activation_options = relu
activation_mutate_rate = 0.0
aggregation_default = sum
aggregation_options = sum
aggregation_mutate_rate = 0.0
bias_init_mean = 0.0
bias_init_stdev = 1.0
bias_max_value = 30.0
bias_min_value = -30.0
bias_mutate_power = 0.5
bias_mutate_rate = 0.7
bias_replace_rate = 0.1
response_init_mean = 1.0
response_init_stdev = 0.0
response_max_value = 1.0
response_min_value = 1.0
response_mutate_power = 0.0
response_mutate_rate = 0.0
response_replace_rate = 0.0
weight_init_mean = 0.0
weight_init_stdev = 1.0
weight_max_value = 30
weight_min_value = -30
weight_mutate_power = 0.5
weight_mutate_rate = 0.8
weight_replace_rate = 0.1
enabled_default = True
enabled_mutate_rate = 0.01

[DefaultSpeciesSet]
compatibility_threshold = 3.0

[DefaultStagnation]
species_fitness_func = max
max_stagnation = 5
species_elitism = 2

[DefaultReproduction]
elitism = 2
survival_threshold = 0.2
min_species_size = 2
"""
SETTINGS = {"population": 60, "stagnation": 5}
SEQUENCE = np.random.default_rng(4).random((4, 2)).tolist()


def held(values):
    return [min(max(value, 0.0), 1.0) for value in values]


@pytest.mark.parametrize("feed_forward", [True, False])
def test_it_goes_the_way_of_the_library_and_computes_what_its_networks_do(
    feed_forward, tmp_path, stepped
):
    """Thirty generations beside the library's own loop, given the seed of each."""
    from socialmind.learning.optimisers.neat_library import Genome

    file = tmp_path / "config"
    file.write_text(CONFIG.format(feed_forward=feed_forward), "utf-8")
    theirs = neat.DefaultReproduction, neat.DefaultSpeciesSet, neat.DefaultStagnation
    config = neat.Config(Genome, *theirs, str(file))
    search = Neat((2, 2), 3, SETTINGS | {"recurrent": int(not feed_forward)})
    draws = np.random.default_rng(3)
    network_of = neat.nn.FeedForwardNetwork if feed_forward else neat.nn.RecurrentNetwork
    grown = set()

    def judged(genomes, config):
        mine = search.ask()
        scores = []
        for (_, genome), one in zip(genomes, mine, strict=True):
            assert one == NeatGenome(*NeatGraph.from_genome(genome, config))
            network = network_of.create(genome, config)
            expected = [held(network.activate(inputs)) for inputs in SEQUENCE]
            given = stepped(one.graph.network(2, 2), one.weights, SEQUENCE)
            assert given == pytest.approx(np.array(expected), abs=1e-12)
            genome.fitness = -sum(np.abs(np.array(given)[:, 0] - np.array(SEQUENCE)[:, 1] ** 2))
            scores.append(genome.fitness)
            grown.add(len(one.graph.neurons))
        search.tell(scores)
        random.seed(int(draws.integers(1 << 63)))

    before = random.getstate()
    try:
        population = neat.Population(config, seed=int(draws.integers(1 << 63)))
        population.run(judged, 30)
    finally:
        random.setstate(before)
    assert search.generation == 30
    assert max(grown) > 4


def test_where_all_species_die_out_a_generation_is_drawn_anew():
    dying = {"population": 10, "stagnation": 2, "species_elite": 0}
    search = Neat((2, 1), 1, dict.fromkeys(UNCHANGED, 0.0) | dying)
    first = search.ask()
    search.tell(np.arange(10.0))
    drawn, anew = weights_of(first), 0
    for _ in range(8):
        genomes = search.ask()
        restored = Neat((2, 1), 5, dict(search.settings))
        restored.restore(search.state())
        assert restored.ask() == genomes
        search.tell(np.zeros(10))
        weights = weights_of(genomes)
        # Without mutations, all weights come from the last draw.
        assert weights <= drawn or not weights & drawn
        anew += not weights & drawn
        drawn = drawn if weights <= drawn else weights
    assert anew >= 2
    assert search.best == first[9]


def test_the_past_of_species_is_restored():
    """With noise, the best of a species lies generations back, and it dies out soon after."""
    settings = {"population": 30, "stagnation": 3, "threshold": 1.5}
    search, restored = Neat((3, 2), 1, settings), Neat((3, 2), 1, settings)
    for generation in range(40):
        scores = np.random.default_rng(generation).normal(size=30)
        state = restored.state()
        restored = Neat((3, 2), 2, settings)
        restored.restore(state)
        assert restored.ask() == search.ask()
        for one in (search, restored):
            one.tell(scores)


@pytest.mark.parametrize("threshold", [0.0, 0.5])
@pytest.mark.parametrize(("elite", "least"), [(0, 1), (2, 2), (0, 3), (10, 1)])
def test_more_species_than_there_is_room_for_do_no_harm(threshold, elite, least):
    settings = {"population": 10, "threshold": threshold, "elite": elite, "species_least": least}
    search = Neat((3, 2), 2, settings)
    noise = np.random.default_rng(1)
    for _ in range(60):
        assert len(search.ask()) == 10
        search.tell(noise.normal(size=10))


def test_the_elite_lives_on():
    search = Neat((3, 2), 2)
    genomes = search.ask()
    for generation in range(19):
        scores = np.random.default_rng(generation).normal(size=len(genomes))
        search.tell(scores)
        best, genomes = genomes[scores.argmax()], search.ask()
        assert best in genomes


def test_mutations_that_are_off_do_not_happen():
    search = Neat((3, 2), 2, dict.fromkeys(STRUCTURAL, 0.0))
    for _ in range(20):
        genomes = search.ask()
        assert {len(one.graph.neurons) for one in genomes} == {2}
        assert {len(one.weights) for one in genomes} == {8}
        search.tell([one.weights[0] for one in genomes])
    assert search.best.weights[0] > 5.0
    search = Neat((3, 2), 2, dict.fromkeys(UNCHANGED, 0.0))
    drawn = weights_of(search.ask())
    for _ in range(5):
        search.tell(np.arange(150.0))
        assert weights_of(search.ask()) <= drawn


def test_weights_are_held_to_their_bound():
    search = Neat((3, 2), 2, {"bound": 0.25, "step": 9.0, "bias_step": 9.0})
    for _ in range(5):
        weights = np.concatenate([one.weights for one in search.ask()])
        search.tell(np.zeros(150))
    # A split connection's first half weighs 1, as the paper has it.
    assert set(np.unique(np.abs(weights[np.abs(weights) > 0.25]))) <= {1.0}
    assert (np.abs(weights) == 0.25).any()


def test_first_individuals_with_hidden_neurons_evolve_further():
    graph = NeatGraph(
        2,
        1,
        (GraphNeuron(7, (-1, -2), "tanh"), GraphNeuron(0, (7, -1), "sigmoid")),
    )
    first = [NeatGenome(graph, np.arange(6.0) / 6), NeatGenome(NeatGraph.minimal(2, 1), [1, 2, 3])]
    search = Neat((2, 1), 1, {"population": 20, "add_neuron": 1.0}, first)
    assert search.ask()[:2] == first
    search.tell(np.linspace(1.0, 0.0, 20))
    for _ in range(10):
        genomes = search.ask()
        again = Neat((2, 1), 2, {"population": 20, "add_neuron": 1.0})
        again.restore(search.state())
        assert again.ask() == genomes
        search.tell([len(one.graph.neurons) for one in genomes])
    assert len(search.best.graph.neurons) > 3


def test_optimisers_in_threads_do_not_disturb_each_other():
    def run(search, kept):
        for _ in range(15):
            genomes = search.ask()
            search.tell([one.weights.sum() for one in genomes])
        kept.append(search.best)

    expected = []
    for seed in range(4):
        run(Neat((3, 2), seed), expected)
    found = [[] for _ in range(4)]
    threads = [
        threading.Thread(target=run, args=(Neat((3, 2), seed), found[seed])) for seed in range(4)
    ]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    assert [one[0] for one in found] == expected


def test_a_skill_gives_the_numbers_of_inputs_and_outputs():
    skill = Skill("Go", ["SE:A", "SE:B", "SE:C"], ["MO:L", "MO:R"], NeatGraph())
    first = NeatGenome(NeatGraph.minimal(3, 2), np.arange(8.0))
    search = Neat.of_skill(skill, 4, {"population": 30}, [first])
    assert search.ask() == Neat((3, 2), 4, {"population": 30}, [first]).ask()


def test_individuals_are_equal_by_graph_and_weights():
    one, other = (NeatGenome(NeatGraph.minimal(1, 1), [weight, 0.5]) for weight in (1.0, 2.0))
    assert one == NeatGenome(NeatGraph.minimal(1, 1), [1.0, 0.5])
    assert hash(one) == hash(NeatGenome(NeatGraph.minimal(1, 1), [1.0, 0.5]))
    assert one != other
    assert one != "graph"
    with pytest.raises(ValueError, match="read-only"):
        one.weights[0] = 3.0


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: Neat(5, 1), "genome size=5 of NEAT; expected the numbers of inputs and outputs"),
        (lambda: Neat((0, 1), 1), "inputs=0 of an optimiser"),
        (lambda: Neat((1, 0), 1), "outputs=0 of an optimiser"),
        (lambda: Neat((2, 1), 1, {"population": 3, "elite": 4}), "elite=4 of 3 graphs"),
        (lambda: Neat((2, 1), 1, {"recurrent": 2}), "recurrent=2"),
        (lambda: Neat((2, 1), 1, first=[[1.0]]), "list as a first individual"),
        (
            lambda: Neat((2, 1), 1, first=[NeatGenome(NeatGraph.minimal(3, 1), [0.0] * 4)]),
            "a configuration of 2 inputs",
        ),
        (
            lambda: Neat((2, 1), 1, first=[NeatGenome(NeatGraph.minimal(2, 1), [0.0])]),
            "1 weights for",
        ),
        (
            lambda: Neat((2, 1), 1, first=[NeatGenome(NeatGraph(), [0.0])]),
            "not drawn yet",
        ),
        (
            lambda: Neat((2, 1), 1).restore(Neat((2, 1), 1, {"recurrent": 1}).state()),
            "[2, 1, 1]; expected [2, 1, 0]; restore with the same genome size and settings",
        ),
        (
            lambda: Neat((2, 1), 1).restore(Neat((2, 1), 1, {"population": 9}).state()),
            "'genomes' of shape (9, 3)",
        ),
    ],
)
def test_refusals(made, message):
    with pytest.raises(ModelError) as refused:
        made()
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_without_the_library_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.delitem(sys.modules, "socialmind.learning.optimisers.neat_library", False)
    monkeypatch.setitem(sys.modules, "neat", None)
    with pytest.raises(SocialmindError, match=r"pip install 'socialmind\[learning\]'"):
        Neat((2, 1), 1)
