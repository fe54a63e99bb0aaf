"""Many agents in lockstep, driven to the edges: programs, drives, groups, names and failures."""

import math
import tracemalloc

import numpy as np
import pytest
from small_minds import constant, mind, wired

from socialmind.errors import ModelError, SocialmindError
from socialmind.mind import (
    Elman,
    Hierarchy,
    MindDescription,
    Minds,
    Perceptron,
    Programmed,
    Recurrent,
    Skill,
    Variable,
    Wave,
)


@pytest.fixture
def walkers(herd):
    """Makes many of the minds of the herd's walkers, with all that a hierarchy can have."""

    def make(agents, **settings):
        own = {"drive": herd.push, "instances": 3, "seed": 5}
        return Minds(herd.WALKER, "Wish", agents, **(own | settings))

    return make


def sensed(agents, ticks=6, seed=1):
    """Values of the walkers' sensors, tick by tick."""
    rng = np.random.default_rng(seed)
    for _ in range(ticks):
        yield {"L": rng.random(agents), "R": rng.uniform(0.2, 1.0, agents)}


def everything(minds, ticks):
    """All that shows of a run, to the last bit, agent by agent."""
    description = minds.description
    seen = []
    for values in ticks:
        motors = minds.evaluate(values)
        seen += [motors[name].tobytes() for name in description.actuators]
        seen += [minds.variable(name).tobytes() for name in description.variables]
        seen += [minds.influence(name).tobytes() for name in minds.assembly.skills]
    return seen


def in_groups(minds):
    agents = np.arange(minds.agents)
    for instance in range(3):
        minds.join("herd", agents[agents % 4 == instance], instance, 0.25 + instance)
    return minds


def alone(description, **settings):
    return Hierarchy(description, "Wish", **settings)


def test_lanes_change_nothing_with_programs_schemes_and_a_drive(walkers):
    runs = [everything(walkers(300, lanes=n), sensed(300)) for n in (1, 7, 256)]
    assert runs[0] == runs[1] == runs[2]


def test_lanes_change_nothing_in_groups(walkers):
    """Members speak in the order of their numbers, whatever the lanes."""
    runs = [everything(in_groups(walkers(300, lanes=n)), sensed(300)) for n in (1, 7, 256)]
    assert runs[0] == runs[1] == runs[2]


@pytest.mark.parametrize("agents", [1, 255, 256, 257, 1000])
def test_each_of_so_many_agents_is_like_one_alone(walkers, herd, agents):
    minds = walkers(agents)
    # Only the first agent draws from the stream of the one mind of a single hierarchy.
    first = alone(herd.WALKER, drive=herd.push, seed=5)
    for values in sensed(agents, 5):
        motors = minds.evaluate(values)
        assert {name: column.shape for name, column in motors.items()} == {
            "ML": (agents,),
            "MR": (agents,),
        }
        expected = first.evaluate({name: column[0] for name, column in values.items()})
        assert {name: float(column[0]) for name, column in motors.items()} == expected
        assert {name: float(minds.variable(name)[0]) for name in first.variables()} == (
            first.variables()
        )


NET = MindDescription(
    "net",
    ["A", "B"],
    ["M", "N"],
    ["V", Variable("W", Wave())],
    [
        Skill("Top", ["SE:A", "SD:B", "VA:W"], ["SK:Left", "SK:Right", "VA:V"], Elman(1)),
        Skill("Left", ["VA:V", "SH:A:3"], ["MO:M", "VA:W"], Perceptron(1)),
        Skill("Right", ["SE:B", "VD:V"], ["MO:M", "MO:N"], Recurrent(1)),
    ],
)


def genomes(agents, seed=3):
    rng = np.random.default_rng(seed)
    return {
        name: rng.uniform(-0.6, 0.8, (agents, skill.genome_size))
        for name, skill in NET.skills.items()
    }


@pytest.mark.parametrize("lanes", [1, 4, 256])
def test_own_genomes_are_those_of_separate_hierarchies(lanes):
    agents = 9
    minds = Minds(NET, agents=agents, own_genomes=True, lanes=lanes)
    single = [Hierarchy(NET) for _ in range(agents)]
    for name, weights in genomes(agents).items():
        minds.set_genome(name, weights)
        assert minds.genome(name).tobytes() == weights.tobytes()
        for hierarchy, row in zip(single, weights, strict=True):
            hierarchy.skill(name).genome = row
    rng = np.random.default_rng(0)
    for _ in range(20):
        values = {"A": rng.random(agents), "B": rng.random(agents)}
        motors = minds.evaluate(values)
        for number, hierarchy in enumerate(single):
            expected = hierarchy.evaluate({name: one[number] for name, one in values.items()})
            assert {name: float(one[number]) for name, one in motors.items()} == expected


def test_a_genome_for_all_replaces_own_ones():
    minds = Minds(NET, agents=5, own_genomes=True, lanes=2)
    for name, weights in genomes(5).items():
        minds.set_genome(name, weights)
        minds.set_genome(name, weights[3])
        assert minds.genome(name).tobytes() == np.tile(weights[3], (5, 1)).tobytes()
    shared = Minds(NET, agents=5)
    for name, weights in genomes(5).items():
        shared.set_genome(name, weights[3])
        assert shared.genome(name).tobytes() == weights[3].tobytes()
    values = {"A": [0.1, 0.2, 0.3, 0.4, 0.5], "B": 0.5}
    expected = shared.evaluate(values)
    found = minds.evaluate(values)
    assert all(found[name].tobytes() == expected[name].tobytes() for name in expected)


def test_reset_of_some_touches_no_other(walkers):
    minds, unbroken, fresh = (in_groups(walkers(20, lanes=7)) for _ in range(3))
    there = [2, 6, 19]
    others = np.setdiff1d(np.arange(20), there)
    everything(minds, sensed(20))
    everything(unbroken, sensed(20))
    before = minds.state()
    minds.reset(there)
    after = minds.state()
    for name in ("values", "memory", "command", "sensors", "remembered", "totals", "actuators"):
        lanes = [np.moveaxis(s[name], 2, 1).reshape(21, -1)[:20] for s in (before, after)]
        assert lanes[0][others].tobytes() == lanes[1][others].tobytes()
        start = np.moveaxis(fresh.state()[name], 2, 1).reshape(21, -1)[:20]
        assert lanes[1][there].tobytes() == start[there].tobytes()
    assert (after["group"] == before["group"]).all()


def test_reset_of_all_gives_the_same_run_again(walkers):
    minds = in_groups(walkers(20))
    first = everything(minds, sensed(20))
    assert everything(minds, sensed(20)) != first
    minds.reset()
    assert everything(minds, sensed(20)) == first


def test_a_state_goes_into_other_minds_with_groups_and_schemes(walkers):
    minds = in_groups(walkers(20))
    everything(minds, sensed(20))
    kept = minds.state()
    goes_on = everything(minds, sensed(20, seed=2))
    other = walkers(20, seed=77)
    everything(other, sensed(20, seed=9))
    other.restore(kept)
    assert everything(other, sensed(20, seed=2)) == goes_on
    kept["values"][:] = 0.123  # what was restored is a copy
    assert 0.123 not in other.variable("Slow")


def test_members_hear_each_other(walkers):
    together, apart = walkers(4, seed=8), walkers(4, seed=8)
    together.join("herd", [0, 1, 2], 1)
    for values in sensed(4, 12):
        together.evaluate(values)
        apart.evaluate(values)
    assert len(set(together.variable("Herd")[:3].tolist())) == 1
    assert len(set(apart.variable("Herd").tolist())) == 4
    assert together.variable("Herd")[3] == apart.variable("Herd")[3]


@pytest.mark.parametrize("make", ["walkers", "net"])
def test_a_step_allocates_nothing(walkers, make):
    minds = walkers(600) if make == "walkers" else Minds(NET, agents=600, own_genomes=True)
    for name, weights in (genomes(600) if make == "net" else {}).items():
        minds.set_genome(name, weights)
    for name in minds.description.sensors:
        minds.set_sensor(name, 0.5)
    for _ in range(3):
        minds.step()
    tracemalloc.start()
    try:
        for _ in range(100):
            minds.step()
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        for _ in range(200):
            minds.step()
        # An array of a number for each agent would be 4,800 bytes.
        assert tracemalloc.get_traced_memory()[1] - before < 2000
    finally:
        tracemalloc.stop()


# Failures -----------------------------------------------------------------------------------------


def refused(call, *words):
    with pytest.raises(SocialmindError) as raised:
        call()
    message = str(raised.value)
    assert "\n" not in message
    for word in words:
        assert word in message
    return message


def test_a_program_that_fails_is_named_with_agent_and_inputs(walkers):
    minds = walkers(300, lanes=64)
    values = {"L": 0.5, "R": np.full(300, 0.5)}
    values["R"][131] = 0.125
    for _ in range(20):  # until agent 131 decides to rest
        try:
            minds.evaluate(values)
        except ModelError as error:
            message = str(error)
            break
    assert "\n" not in message
    for word in ("'Rest'", "agent 131", "rest()", "[0.125]", "ZeroDivisionError"):
        assert word in message
    # What failed is forgotten: the next failure is said to be what it is.
    minds.state_arrays.sensors[:] = np.nan
    refused(minds.step, "'L'", "agent 0")


def test_a_sensor_that_is_refused_leaves_no_agent_a_step_ahead(walkers):
    minds, untroubled = walkers(300, lanes=64), walkers(300, lanes=64)
    ticks = list(sensed(300))
    for number, values in enumerate(ticks):
        wrong = {"L": values["L"].copy(), "R": values["R"]}
        wrong["L"][290] = [math.nan, math.inf, -0.01, 1.01, -math.inf, 2.0][number]
        refused(lambda wrong=wrong: minds.evaluate(wrong), "'L'", "agent 290")
        assert everything(minds, [values]) == everything(untroubled, [values])


def test_wrong_arguments_are_refused(walkers):
    minds = walkers(5)
    for agents in (5, -1, [0, 7]):
        refused(lambda agents=agents: minds.reset(agents), "agent")
        refused(lambda agents=agents: minds.join("herd", agents, 0), "agent")
    for agents in ([0.5], "all", np.array([True] * 5)):
        refused(lambda agents=agents: minds.reset(agents), "agents")
    for instance in (-1, 3, 0.5, True):
        refused(lambda one=instance: minds.join("herd", 0, one), "instance", "0 … 2")
    for part in (-1, math.inf, math.nan, "much", [1.0, 2.0]):
        refused(lambda part=part: minds.join("herd", 0, 0, part), "participation")
    refused(lambda: minds.join("herb", 0, 0), "herb", "herd")
    refused(lambda: minds.set_variable("Slow", 1.5), "Slow", "0 … 1")
    refused(lambda: minds.set_variable("Slow", "fast"), "Slow")
    refused(lambda: minds.set_genome("Tune", ["a"]), "Tune")
    refused(lambda: minds.set_genome("Tune", np.zeros((5, 87))), "Tune", "435")
    for name in ("agents", "lanes", "instances"):
        for number in (-1, 1.5, "3", True):
            settings = {"agents": 2, name: number}
            refused(lambda settings=settings: Minds(NET, **settings), name, repr(number))
    for seed in (-1, 2**64, 0.5):
        refused(lambda seed=seed: Minds(NET, seed=seed), "seed")


def test_numpy_s_whole_numbers_are_whole_numbers():
    minds = Minds(NET, agents=np.int64(3), lanes=np.int32(2))
    assert (len(minds), minds.lanes) == (3, 2)


def test_a_state_of_others_is_refused():
    def made(agents=5, **settings):
        return Minds(NET, agents=agents, **settings)

    minds = made(lanes=1)
    others = (made(3, lanes=1), made(lanes=2), made(lanes=1, own_genomes=True))
    for other in others:
        refused(lambda other=other: minds.restore(other.state()), "a state")
    refused(lambda: minds.restore({}), "sensors")
    first, *others = NET.skills
    some = made(own_genomes=[first])
    for given in (True, [others[0]], [first, others[0]]):
        refused(lambda given=given: some.restore(made(own_genomes=given).state()), "own genomes")
    some.restore(made(own_genomes=(name for name in [first])).state())
    assert made(own_genomes=()).own_genomes is False
    older = {name: one for name, one in made().state().items() if name != "common"}
    made().restore(older)
    refused(lambda: some.restore(older), "genome")
    refused(lambda: made(own_genomes=first), f"own_genomes=['{first}']")
    refused(lambda: made(own_genomes=["Nobody"]), "Nobody")
    other = mind([wired("Top", {"MO:M": "SE:A"})])
    refused(lambda: minds.restore(Minds(other, agents=5, lanes=1).state()), "shape")


def test_a_drive_that_fails_is_named_with_its_agent(walkers, herd):
    minds = walkers(300)
    values = np.full(300, 0.5)
    values[277] = 0.05
    words = ("push", "agent 277", "model.py:")
    refused(lambda: minds.evaluate({"L": 0.5, "R": values}), *words)
    with pytest.raises(ModelError, match="an influence below 0"):
        alone(herd.WALKER, drive=herd.push).evaluate({"L": 0.5, "R": 0.05})


# Shapes at the edges ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "word", ["x" * 4000, "Œil gauche", "眼", "a b\u00a0c", "eye-'\"\\n".replace("\\", ""), "NAME"]
)
def test_names_of_any_kind(word):
    skills = [
        Skill(word, [f"SE:{word}"], [f"SK:{word}2"], Perceptron(0), [0.5, 0.25]),
        Skill(f"{word}2", [f"VA:{word}"], [f"MO:{word}", f"VA:{word}"], Perceptron(0),
              [0.0, 0.75, 0.0, 0.5]),
    ]  # fmt: skip
    description = MindDescription(word, [word], [word], [word], skills)
    minds, single = Minds(description, agents=2), Hierarchy(description)
    for _ in range(2):
        motors = minds.evaluate({word: 0.5})
        assert single.evaluate({word: 0.5}) == {word: 0.75}
        assert motors[word].tolist() == [0.75, 0.75]
    assert minds.influence(f"{word}2").tolist() == [0.5, 0.5]
    assert single.variables() == {word: 0.5}


def test_a_mind_that_senses_nothing_and_one_that_moves_nothing():
    blind = MindDescription("blind", [], ["M"], [], [constant("Go", {"MO:M": 0.75})])
    assert Minds(blind, agents=3).evaluate({})["M"].tolist() == [0.75] * 3
    still = MindDescription("still", ["S"], [], ["V"], [wired("Note", {"VA:V": "SE:S"})])
    minds = Minds(still, agents=3)
    for _ in range(2):
        assert minds.evaluate({"S": [0.0, 0.5, 1.0]}) == {}
    assert minds.variable("V").tolist() == [0.0, 0.5, 1.0]
    idle = MindDescription("idle", [], [], ["V"], [constant("Note", {"VA:V": 0.5})])
    assert Hierarchy(idle).evaluate({}) == {}
    refused(lambda: Minds(MindDescription("empty", ["S"], ["M"])), "empty", "no skills")


def test_influence_flows_sixty_levels_down():
    skills = [constant(f"L{level:02}", {f"SK:L{level + 1:02}": 0.9}) for level in range(59)]
    description = mind([*skills, wired("L59", {"MO:M": "SE:S"})])
    expected = 1.0
    for _ in range(59):
        expected *= 0.9
    minds, single = Minds(description, agents=3), Hierarchy(description)
    assert minds.evaluate({"S": [0.0, 0.5, 1.0]})["M"] == pytest.approx([0.0, 0.5, 1.0])
    assert minds.influence("L59").tolist() == [expected] * 3
    assert single.evaluate({"S": 0.5}) == pytest.approx({"M": 0.5})
    assert single.influences()["L59"] == expected


def test_sixty_skills_of_one_master_command_one_motor():
    shares = {f"W{number:02}": (number % 7) / 7 for number in range(60)}
    master = constant("Top", {f"SK:{name}": share for name, share in shares.items()})
    bases = [
        Skill(name, ["SE:S"], ["MO:M"], Perceptron(0), [number / 60, 0.0])
        for number, name in enumerate(shares)
    ]
    minds = Minds(mind([master, *bases]), agents=2)
    found = minds.evaluate({"S": [1.0, 0.5]})["M"]
    pull = sum(share * number / 60 for number, share in enumerate(shares.values()))
    assert found == pytest.approx(np.array([1.0, 0.5]) * pull / sum(shares.values()))


def nothing_below_zero(value):
    return -0.0 * value


def test_zero_has_no_sign():
    """A sign would show nowhere but in the last bit, and the two evaluators might differ in it."""
    skill = Skill("Zero", ["SE:S"], ["MO:M", "VA:V"], Perceptron(0), [-0.0, -0.0, -0.0, -0.0])
    own = skill.changed(name="Own", outputs=["MO:N"], genome=None,
                        function=Programmed(nothing_below_zero))  # fmt: skip
    top = constant("Top", {"SK:Zero": 1.0, "SK:Own": 1.0})
    description = MindDescription("zero", ["S"], ["M", "N"], ["V"], [top, skill, own])
    motors = Hierarchy(description).evaluate({"S": 0.5})
    assert [math.copysign(1.0, value) for value in motors.values()] == [1.0, 1.0]
