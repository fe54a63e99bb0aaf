"""What every regulation of variables keeps to, run over all that are registered."""

import numpy as np
import pytest

from socialmind.mind import (
    Counter,
    Hierarchy,
    MindDescription,
    Minds,
    Programmed,
    Regulated,
    Simple,
    Skill,
    Variable,
    Wave,
)
from socialmind.mind.regulation import REGULATIONS

TICKS = 60


def drift(command, value, memory, commanded):
    if commanded:
        memory = 0.5 * memory + command
    return 0.9 * value + 0.2 * memory, memory


def write(command):
    return command, command, command, command


def gate(share):
    return share


EXAMPLES = {
    "simple": Simple(),
    "wave": Wave(),
    "counter": Counter(maximum=3, increment=0.6, reset=0.3),
    "regulated": Regulated(drift),
}
MIND = MindDescription(
    "writer",
    ["COMMAND", "GATE"],
    [],
    [Variable(name, one) for name, one in EXAMPLES.items()],
    [
        Skill("Gate", ["SE:GATE"], ["SK:Write"], Programmed(gate)),
        Skill("Write", ["SE:COMMAND"], [f"VA:{name}" for name in EXAMPLES], Programmed(write)),
    ],
)


def commands(seed):
    """Commands and influences of a run; about half of the ticks are without influence."""
    rng = np.random.default_rng(seed)
    return rng.random(TICKS).tolist(), (rng.random(TICKS).round(1) * (rng.random(TICKS) < 0.5))


def run(hierarchy, seed):
    values = []
    for command, share in zip(*commands(seed), strict=True):
        hierarchy.evaluate({"COMMAND": command, "GATE": share})
        values.append(hierarchy.variables())
    return values


@pytest.fixture(scope="module")
def many():
    """The values of 20 agents in compiled code, by tick, variable and agent."""
    minds = Minds(MIND, agents=20)
    runs = [commands(seed) for seed in range(20)]
    values = []
    for tick in range(TICKS):
        told = [run[0][tick] for run in runs]
        minds.evaluate({"COMMAND": told, "GATE": [run[1][tick] for run in runs]})
        values.append({name: minds.variable(name) for name in EXAMPLES})
    return values


def test_every_regulation_has_an_example():
    assert {type(one) for one in EXAMPLES.values()} == set(REGULATIONS.values())


@pytest.mark.parametrize("name", EXAMPLES)
class TestContract:
    def test_values_stay_between_0_and_1_and_move(self, name):
        values = [tick[name] for tick in run(Hierarchy(MIND), 3)]
        assert all(0.0 <= value <= 1.0 for value in values)
        assert len(set(values)) > 2

    def test_a_reset_gives_the_same_run_again(self, name):
        hierarchy = Hierarchy(MIND)
        first = [tick[name] for tick in run(hierarchy, 5)]
        hierarchy.reset()
        assert [tick[name] for tick in run(hierarchy, 5)] == first

    @pytest.mark.parametrize("agent", [0, 7, 19])
    def test_compiled_for_many_is_interpreted_for_one(self, name, many, agent):
        alone = [tick[name] for tick in run(Hierarchy(MIND), agent)]
        assert [tick[name][agent] for tick in many] == alone

    def test_nothing_of_a_command_is_seen_before_the_next_tick(self, name):
        told, untold = Hierarchy(MIND), Hierarchy(MIND)
        told.evaluate({"COMMAND": 0.9, "GATE": 1.0})
        untold.evaluate({"COMMAND": 0.1, "GATE": 0.0})
        assert told.variables()[name] == untold.variables()[name]
        for hierarchy in (told, untold):
            hierarchy.evaluate({"COMMAND": 0.5, "GATE": 0.0})
        assert told.variables()[name] != untold.variables()[name]
