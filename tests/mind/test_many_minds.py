"""Many agents at once: each as plain Python has it, and as a single hierarchy to the last bit."""

import copy
import random
from contextlib import nullcontext
from itertools import pairwise

import numpy as np
import pytest
from independent import Society
from random_minds import MASTER, bits, other_genomes, random_mind, sensor_values, shuffled

from socialmind.errors import ModelError
from socialmind.mind import Hierarchy, Minds

TICKS = 30
CLOSE = {"rel": 1e-9, "abs": 1e-9}
BOTH = pytest.mark.parametrize("own_genomes", [False, True], ids=["shared genome", "own genomes"])


def sensed(description, draw, agents, ticks=TICKS):
    """Values of all sensors for each agent, tick by tick."""
    return zip(*(list(sensor_values(description, draw, ticks)) for _ in range(agents)), strict=True)


def together(tables):
    """Tables of several agents as one table of arrays."""
    return {name: np.array([table[name] for table in tables]) for name in tables[0]}


def one_by_one(arrays, agents):
    """A table of arrays as a table for each agent."""
    return [{name: float(one[agent]) for name, one in arrays.items()} for agent in range(agents)]


def set_genomes(many, description, draw, agents):
    """Give each agent weights of its own; return them."""
    genomes = [other_genomes(description, draw) for _ in range(agents)]
    for name in genomes[0]:
        many.set_genome(name, np.array([genome[name] for genome in genomes]))
    return genomes


def run(many, description, agents, seed):
    """Everything that shows of a run, to the last bit."""
    seen = []
    for values in sensed(description, random.Random(seed), agents):
        motors = many.evaluate(together(values))
        variables = {name: many.variable(name) for name in sorted(description.variables)}
        tables = [one_by_one(motors, agents), one_by_one(variables, agents)]
        seen.append([[bits(one) for one in table] for table in tables])
    return seen


# Programmed functions are compiled for each mind, so only some of the minds have any.
MINDS = [*((seed, False) for seed in range(2000, 2040)), *((seed, True) for seed in range(6))]


@BOTH
@pytest.mark.parametrize(("seed", "programs"), MINDS)
def test_each_agent_gives_what_plain_python_gives(seed, programs, own_genomes):
    draw = random.Random(seed)
    description = random_mind(draw, programs=programs)
    agents = draw.choice([1, 2, 7, 8, 9, 33])
    many = Minds(description, MASTER, agents, own_genomes=own_genomes)
    genomes = set_genomes(many, description, draw, agents) if own_genomes else None
    society = Society(description, [MASTER], agents, genomes)
    for values in sensed(description, draw, agents):
        expected = society.evaluate(values)
        found = one_by_one(many.evaluate(together(values)), agents)
        for motors, one in zip(found, expected, strict=True):
            assert motors == pytest.approx(one, **CLOSE)
        for number, agent in enumerate(society.agents):
            variables = {name: many.variable(name)[number] for name in description.variables}
            assert variables == pytest.approx(agent.values(), **CLOSE)
            influences = {name: many.influence(name)[number] for name in agent.skills}
            assert influences == pytest.approx(agent.influences, **CLOSE)


@BOTH
@pytest.mark.parametrize(("seed", "programs"), MINDS[::3])
@pytest.mark.parametrize("agents", [1, 5, 19])
def test_each_agent_equals_a_single_hierarchy(seed, programs, agents, own_genomes):
    draw = random.Random(seed)
    description = random_mind(draw, programs=programs)
    many = Minds(description, MASTER, agents, own_genomes=own_genomes)
    single = [Hierarchy(description, MASTER) for _ in range(agents)]
    if own_genomes:
        genomes = set_genomes(many, description, draw, agents)
        for hierarchy, genome in zip(single, genomes, strict=True):
            for name, weights in genome.items():
                hierarchy.skill(name).genome = weights
    for values in sensed(description, draw, agents):
        found = one_by_one(many.evaluate(together(values)), agents)
        for number, hierarchy in enumerate(single):
            assert bits(found[number]) == bits(hierarchy.evaluate(values[number]))
            variables = {name: many.variable(name)[number] for name in description.variables}
            assert bits(variables) == bits(hierarchy.variables())
            influences = {name: many.influence(name)[number] for name in hierarchy.skills}
            assert bits(influences) == bits(hierarchy.influences())


@pytest.mark.parametrize("seed", range(2060, 2070))
@pytest.mark.parametrize("agents", [1, 19])
def test_agents_may_have_weights_of_their_own_for_some_skills_alone(seed, agents):
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    learned = [name for name, skill in description.skills.items() if skill.genome_size][::2]
    many = Minds(description, MASTER, agents, own_genomes=learned, lanes=8)
    single = [Hierarchy(description, MASTER) for _ in range(agents)]
    own, common = [other_genomes(description, draw) for _ in single], {}
    for name in own[0]:
        if name in learned:
            many.set_genome(name, np.array([genome[name] for genome in own]))
        else:
            common[name] = own[0][name]
            many.set_genome(name, common[name])
            assert many.genome(name).tobytes() == common[name].tobytes()
            with pytest.raises(ModelError) if len(common[name]) else nullcontext():
                many.set_genome(name, np.array([genome[name] for genome in own * 2]))
    for hierarchy, genome in zip(single, own, strict=True):
        for name, weights in (genome | common).items():
            hierarchy.skill(name).genome = weights
    again = copy.deepcopy(many)
    for values in sensed(description, draw, agents):
        found = one_by_one(many.evaluate(together(values)), agents)
        for number, hierarchy in enumerate(single):
            assert bits(found[number]) == bits(hierarchy.evaluate(values[number]))
        copied = one_by_one(again.evaluate(together(values)), agents)
        assert [bits(one) for one in copied] == [bits(one) for one in found]


@pytest.mark.parametrize("seed", range(2070, 2080))
@pytest.mark.parametrize("alike", [1, 5, 24, 150])
def test_those_with_equal_weights_may_take_them_once(seed, alike):
    """As where worlds run side by side, and the robots of several are one individual's."""
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    agents, lanes = 150, 64
    apart, at_once = (
        Minds(description, MASTER, agents, own_genomes=True, lanes=lanes) for _ in range(2)
    )
    bearers = np.arange(agents) // alike
    genomes = [other_genomes(description, draw) for _ in range(bearers[-1] + 1)]
    for name in genomes[0]:
        weights = np.array([genomes[bearer][name] for bearer in bearers])
        apart.set_genome(name, weights)
        at_once.set_genome(name, weights)
    at_once.state_arrays.individual.reshape(-1)[:agents] = bearers
    assert run(apart, description, agents, seed) == run(at_once, description, agents, seed)


@BOTH
@pytest.mark.parametrize("seed", range(2080, 2085))
def test_each_of_a_crowd_equals_a_single_hierarchy(seed, own_genomes):
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    agents = 600  # more than go in lockstep
    many = Minds(description, MASTER, agents, own_genomes=own_genomes)
    genomes = set_genomes(many, description, draw, agents) if own_genomes else None
    single = {number: Hierarchy(description, MASTER) for number in (0, 31, 255, 256, 511, 512, 599)}
    for number, hierarchy in single.items():
        for name, weights in (genomes[number] if genomes else {}).items():
            hierarchy.skill(name).genome = weights
    for values in sensed(description, draw, agents, ticks=8):
        found = one_by_one(many.evaluate(together(values)), agents)
        for number, hierarchy in single.items():
            assert bits(found[number]) == bits(hierarchy.evaluate(values[number]))


@pytest.mark.parametrize("seed", range(2100, 2110))
def test_how_many_go_in_lockstep_changes_nothing(seed):
    description = random_mind(random.Random(seed), programs=False)
    runs = [run(Minds(description, MASTER, 13, lanes=n), description, 13, seed) for n in (1, 4, 64)]
    assert all(one == other for one, other in pairwise(runs))


@BOTH
@pytest.mark.parametrize("seed", range(2120, 2140))
def test_the_order_of_declaration_changes_nothing(seed, own_genomes):
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    first, second = (
        run(Minds(one, MASTER, 9, own_genomes=own_genomes), description, 9, seed)
        for one in (description, shuffled(description, draw))
    )
    assert first == second


@pytest.mark.parametrize("seed", range(2140, 2150))
def test_a_run_can_be_had_again(seed):
    description = random_mind(random.Random(seed), programs=False)
    many = Minds(description, MASTER, 6)
    first = run(many, description, 6, seed)
    many.reset()
    assert run(many, description, 6, seed) == first


@pytest.mark.parametrize("seed", range(2150, 2160))
def test_a_run_goes_on_from_what_was_kept(seed):
    description = random_mind(random.Random(seed), programs=False)
    many = Minds(description, MASTER, 6)
    run(many, description, 6, seed)
    kept = many.state()
    first = run(many, description, 6, seed + 1)
    many.restore(kept)
    assert run(many, description, 6, seed + 1) == first
    other = Minds(description, MASTER, 6)
    other.restore(kept)
    assert run(other, description, 6, seed + 1) == first


@pytest.mark.parametrize("seed", range(2160, 2170))
def test_agents_that_are_reset_begin_anew_among_others(seed):
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    many, unbroken = (Minds(description, MASTER, 4) for _ in range(2))
    fresh = {number: Hierarchy(description, MASTER) for number in (1, 3)}
    for tick, values in enumerate(sensed(description, draw, 4)):
        if tick == 10:
            many.reset(agents=np.array([1, 3]))
        found = one_by_one(many.evaluate(together(values)), 4)
        kept = one_by_one(unbroken.evaluate(together(values)), 4)
        for number in (0, 2):
            assert bits(found[number]) == bits(kept[number])
        if tick >= 10:
            for number, hierarchy in fresh.items():
                assert bits(found[number]) == bits(hierarchy.evaluate(values[number]))


@pytest.mark.parametrize("seed", range(2170, 2175))
def test_sensors_may_be_set_before_a_step(seed):
    draw = random.Random(seed)
    description = random_mind(draw, programs=False)
    at_once, by_steps = (Minds(description, MASTER, 3) for _ in range(2))
    for values in sensed(description, draw, 3):
        expected = at_once.evaluate(together(values))
        for name, column in together(values).items():
            by_steps.set_sensor(name, column)
            assert by_steps.sensor(name).tolist() == column.tolist()
        by_steps.step()
        for name in description.actuators:
            assert by_steps.actuator(name).tobytes() == expected[name].tobytes()
