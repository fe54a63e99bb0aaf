"""A hierarchy in the hands of its user: genomes, files, drives and cogniton minds."""

from dataclasses import replace

import numpy as np
import pytest
from collectors import SENSORS, collector, refused, run, weights_of
from programs import leak, mean, steer
from small_minds import constant, mind, wired

from coglogo_py import CognitiveScheme, Cogniton, Group, Role
from coglogo_py.decision import MaximumWeight, WeightedStochastic
from socialmind.errors import SocialmindError
from socialmind.mind import (
    CognitonScheme,
    Convolution,
    Counter,
    Elman,
    Hierarchy,
    InfluenceNetwork,
    MindDescription,
    NeatGraph,
    Perceptron,
    Programmed,
    Recurrent,
    Regulated,
    Skill,
    Variable,
    Wave,
    load_mind,
)
from socialmind.mind.functions.convolution import Kernel
from socialmind.mind.functions.neat.graph import GraphNeuron


@pytest.fixture
def collect():
    return collector()


# Skills and genomes -------------------------------------------------------------------------------


def test_a_skill_tells_what_it_is(collect):
    skill = collect.skill("GoToObject")
    assert skill.name == "GoToObject"
    assert skill.inputs == ("SE:SeesObject", "SH:SeesObject:2")
    assert skill.outputs == ("MO:MotL", "MO:MotR")
    assert skill.function == Perceptron(1)
    assert skill.description.genome.tobytes() == skill.genome.tobytes()
    assert collect.master == "Collect"
    assert collect.skills[0] == "Collect"
    assert set(collect.skills) == {"Collect", "GoToObject", "GoToBase", "Avoid"}


def test_a_genome_is_copied_in_and_out(collect):
    size = collect.description.skills["Avoid"].genome_size
    own = np.linspace(-1, 1, size)
    collect.skill("Avoid").genome = own
    own[:] = 5.0
    found = collect.skill("Avoid").genome
    assert found.tolist() == np.linspace(-1, 1, size).tolist()
    with pytest.raises(ValueError, match="read-only"):
        found[0] = 1.0
    collect.skill("Avoid").genome = list(found)
    collect.skill("Avoid").genome = found.reshape(1, -1)
    assert collect.skill("Avoid").genome.shape == (size,)
    before = run(collect)
    collect.reset()
    assert collect.skill("Avoid").genome.tolist() == found.tolist()
    assert run(collect) == before


def test_a_genome_that_does_not_fit_leaves_the_old_one(collect):
    before = weights_of(collect)
    size = collect.description.skills["Avoid"].genome_size
    for wrong in (None, [], [0.0] * (size + 1), [np.nan] * size, [np.inf] * size, ["a"] * size):
        refused(lambda wrong=wrong: setattr(collect.skill("Avoid"), "genome", wrong), "'Avoid'")
    for name in ("Avoidance", ""):
        refused(lambda name=name: collect.set_genome(name, [0.0]), repr(name))
        refused(lambda name=name: collect.genome(name), repr(name))
    assert weights_of(collect) == before


def test_randomise_is_the_same_for_a_seed_whatever_the_order(collect):
    first = weights_of(collect)
    collect.randomise(7)
    assert all(weights_of(collect)[name] != first[name] for name in first)
    collect.randomise(6)
    assert weights_of(collect) == first
    modules = collect.description
    turned = MindDescription("turned", SENSORS[::-1], modules.actuators.values(),
                             modules.variables.values(),
                             list(modules.skills.values())[::-1])  # fmt: skip
    other = Hierarchy(turned)
    other.randomise(6)
    assert weights_of(other) == first
    drawn = np.concatenate([collect.skill(name).genome for name in collect.skills])
    assert -1 <= drawn.min() < -0.5
    assert 0.5 < drawn.max() <= 1
    for seed in (-1, 0.5, "six", True):
        refused(lambda seed=seed: collect.randomise(seed), "seed", kind=SocialmindError)


# Files --------------------------------------------------------------------------------------------

CHOICE = CognitiveScheme(
    "choice",
    (
        Cogniton("A", influence={"See": 1.0, "Graph": 0.5}, conditional=("See", "Graph")),
        Cogniton("Pulse", influence={"Graph": 2.0}),
    ),
    decision_maker=WeightedStochastic(),
)


def menagerie():
    """A mind with a function of every kind, and a variable of every kind."""
    graph = NeatGraph(2, 2, (GraphNeuron(2, (-1, -2), "tanh", "max"),
                             GraphNeuron(0, (2, -1), "gauss", "sum"),
                             GraphNeuron(1, (2,), "sigmoid", "product")))  # fmt: skip
    skills = [
        Skill("Top", ["SE:A", "VD:Pulse"], ["SK:Choose", "SK:Mix", "SK:Fed", "VA:Pulse"],
              Perceptron(2, "sigmoid", 1)),
        Skill("Choose", ["SE:A", "VA:Pulse"], ["SK:See", "SK:Graph"], CognitonScheme(CHOICE)),
        Skill("Mix", ["SE:A", "SE:B", "SE:C"], ["MO:M", "SK:Own", "VA:Slow"],
              InfluenceNetwork(2, (0,), 1, "relu", 1)),
        Skill("Fed", ["SE:B", "SH:C:4"], ["SK:Mean", "VA:Count"], Recurrent(1)),
        Skill("See", ["SE:A", "SE:B", "SE:C"], ["MO:M", "MO:N"],
              Convolution((Kernel(2, ((0, 1), (1, 2))),), (2,), 1)),
        Skill("Graph", ["SE:A", "VA:Slow"], ["MO:M", "MO:N"], graph),
        Skill("Own", ["VA:Count", "SE:C"], ["MO:M", "MO:N"], Programmed(steer)),
        Skill("Mean", ["SE:A", "SE:B", "SE:C"], ["MO:N"], Programmed(mean)),
        Skill("Past", ["SE:A"], ["MO:N"], Elman(1)),
    ]  # fmt: skip
    skills[0] = skills[0].changed(outputs=[*skills[0].outputs, "SK:Past"])
    variables = [Variable("Pulse", Wave()), Variable("Slow", Regulated(leak), 0.25),
                 Variable("Count", Counter(3)), Variable("Herd", group="herd"),
                 Variable("Set", default=0.75)]  # fmt: skip
    made = Hierarchy(MindDescription("menagerie", ["A", "B", "C"], ["M", "N"], variables, skills),
                     seed=4)  # fmt: skip
    made.randomise(1)
    return made


@pytest.mark.parametrize("file", ["", ".yaml"])
def test_a_saved_mind_does_the_same_to_the_last_bit(tmp_path, file):
    made = menagerie()
    first = run(made, 40)
    path = tmp_path / f"menagerie{file}"
    made.save(path)
    loaded = load_mind(path, seed=4)
    assert weights_of(loaded) == weights_of(made)
    assert run(loaded, 40) == first
    loaded.reset()
    assert run(loaded, 40) == first
    # Once more, from what was read.
    loaded.save(tmp_path / f"again{file}" if file else tmp_path / "again" / "menagerie")
    again = load_mind(tmp_path / f"again{file}" if file else tmp_path / "again" / "menagerie",
                      "Top", seed=4)  # fmt: skip
    assert run(again, 40) == first


def test_a_folder_with_several_masters(tmp_path):
    two = MindDescription("two", ["S"], ["M"], [], [wired("A", {"MO:M": "SE:S"}),
                                                   constant("B", {"MO:M": 0.25})])  # fmt: skip
    two.save(tmp_path / "two")
    refused(lambda: load_mind(tmp_path / "two"), "'two'", "A, B", "master=")
    refused(lambda: load_mind(tmp_path / "two", "C"), "'C'")
    assert load_mind(tmp_path / "two", "B").evaluate({}) == {"M": 0.25}
    assert load_mind(tmp_path / "two", "A").evaluate({"S": 0.5}) == {"M": 0.5}
    refused(lambda: load_mind(tmp_path / "three"), "three", "no such folder")
    refused(lambda: load_mind(tmp_path / "three.yaml"), "three.yaml")


# Variables and drives -----------------------------------------------------------------------------

SHOWN = {"MO:value": "VA:V", "MO:change": "VD:V", "MO:before": "VH:V:1", "MO:long": "VH:V:3"}


def showing(regulation=None):
    """A mind that shows a variable; with the sensor On it commands it by the sensor By."""
    skills = [
        wired("Top", {"SK:Write": "SE:On", "SK:Show": "SE:One"}),
        wired("Write", {"VA:V": "SE:By"}),
        wired("Show", SHOWN),
    ]
    return mind(skills, [Variable("V", regulation) if regulation else "V"])


def shows(hierarchy, by=0.0, on=0.0):
    motors = hierarchy.evaluate({"By": by, "On": on, "One": 1.0})
    return tuple(motors[name] for name in ("value", "change", "before", "long"))


def test_a_variable_set_from_outside_is_seen_with_its_history():
    hierarchy = Hierarchy(showing())
    assert shows(hierarchy) == (0.0, 0.5, 0.0, 0.0)
    hierarchy.set_variable("V", 0.5)
    assert shows(hierarchy) == (0.5, 0.75, 0.0, 0.0)
    assert shows(hierarchy) == (0.5, 0.5, 0.5, 0.0)
    hierarchy.set_variable("V", 0.25)
    hierarchy.set_variable("V", 1.0)
    assert shows(hierarchy) == (1.0, 0.75, 0.5, 0.0)
    assert shows(hierarchy) == (1.0, 0.5, 1.0, 0.5)
    for wrong in (-0.1, 1.1, float("nan"), "half", None):
        refused(lambda wrong=wrong: hierarchy.set_variable("V", wrong), "'V'", "0 … 1")
    refused(lambda: hierarchy.set_variable("W", 0.5), "'W'", "V")
    assert hierarchy.variables() == {"V": 1.0}


def test_a_variable_overridden_by_a_drive_has_that_for_its_history():
    given = iter([0.25, 1.0, None, 0.5, None, None])

    def drive(mind):
        value = next(given)
        if value is not None:
            mind.set_variable("V", value)

    hierarchy = Hierarchy(showing(), drive=drive)  # closures are for single hierarchies
    # At the first evaluation history is the first value, and that is the drive's.
    assert shows(hierarchy) == (0.25, 0.5, 0.25, 0.25)
    assert shows(hierarchy) == (1.0, 0.875, 0.25, 0.25)
    assert shows(hierarchy) == (1.0, 0.5, 1.0, 0.25)
    assert shows(hierarchy) == (0.5, 0.25, 1.0, 0.25)
    assert shows(hierarchy) == (0.5, 0.5, 0.5, 1.0)


def test_a_counter_goes_on_from_where_a_drive_puts_it():
    now = {"value": None}

    def drive(mind):
        if now["value"] is not None:
            mind.set_variable("V", now["value"])

    hierarchy = Hierarchy(showing(Counter(4)), drive=drive)
    counted = []
    for by, value in [(1.0, None), (0.5, 0.5), (1.0, None), (0.5, None), (0.0, None), (0.0, None)]:
        now["value"] = value
        counted.append(shows(hierarchy, by=by, on=1.0)[:2])
    # Rising edges are counted in the tick after; the drive sets 2 of 4, and the reset is a fall.
    assert counted == [
        (0.0, 0.5), (0.5, 0.75), (0.5, 0.5), (0.75, 0.625), (0.75, 0.5), (0.0, 0.125),
    ]  # fmt: skip


def test_a_wave_overridden_goes_on_with_its_own_phase():
    now = {"value": None}

    def drive(mind):
        if now["value"] is not None:
            mind.set_variable("V", now["value"])

    hierarchy = Hierarchy(showing(Wave()), drive=drive)
    plain = Hierarchy(showing(Wave()))
    for tick in range(6):
        now["value"] = 1.0 if tick == 2 else None
        value, change, *_ = shows(hierarchy)
        expected, *_ = shows(plain)
        if tick == 2:
            assert value == 1.0
        else:
            assert value == expected
        if tick == 3:
            assert change == 0.5 + (expected - 1.0) / 2


def test_a_drive_may_not_do_what_rules_do():
    for name, *arguments in (("evaluate",), ("restart",), ("set_sensor", "On", 0.5),
                             ("join_group", "g", 0), ("leave_group", "g")):  # fmt: skip

        def drive(mind, name=name, arguments=arguments):
            getattr(mind, name)(*arguments)

        refused(lambda drive=drive: shows(Hierarchy(showing(), drive=drive)), "drive")
    refused(lambda: Hierarchy(showing(), drive="push"), "'push'")


# Cogniton minds inside ----------------------------------------------------------------------------


def chooser(maker=None, seed=0, threshold=2.0):
    """A scheme as the master of two skills, with feedback."""
    scheme = CognitiveScheme(
        "habits",
        (
            Cogniton("Left", start_value=1.0, influence={"L": 1.0}, reinforcement={"L": 5.0},
                     conditional=("L",)),
            Cogniton("Right", start_value=1.0, influence={"R": 1.0}, reinforcement={"R": 5.0},
                     conditional=("R",)),
            Cogniton("Light", start_value=0.0, influence={"L": threshold}),
        ),
        decision_maker=maker or WeightedStochastic(),
    )  # fmt: skip
    top = Skill("Top", ["SE:Eye"], ["SK:L", "SK:R"],
                CognitonScheme(scheme, {"SE:Eye": "Light"}))  # fmt: skip
    skills = [top, constant("L", {"MO:M": 0.0}), constant("R", {"MO:M": 1.0})]
    return Hierarchy(mind(skills), seed=seed)


def decisions(hierarchy, ticks=60, eye=0.0):
    return [hierarchy.evaluate({"Eye": eye})["M"] for _ in range(ticks)]


def test_decisions_are_those_of_the_seed_and_come_again_after_reset():
    first = decisions(chooser(seed=1))
    assert decisions(chooser(seed=1)) == first
    assert decisions(chooser(seed=2)) != first
    assert set(first) == {0.0, 1.0}
    hierarchy = chooser(seed=1)
    decisions(hierarchy, 13)
    hierarchy.skill("Top").mind.set_cogniton_value("Right", 50.0)
    hierarchy.reset()
    assert decisions(hierarchy) == first


def test_feedback_changes_what_is_decided():
    hierarchy = chooser(MaximumWeight())
    inner = hierarchy.skill("Top").mind
    inner.set_cogniton_value("Left", 1.5)
    assert decisions(hierarchy, 3) == [0.0] * 3
    inner.feed_back_from_plan("R", 1.0)  # reinforced, R weighs 1 + 5
    assert inner.get_cogniton_value("Right") == 6.0
    assert decisions(hierarchy, 3) == [1.0] * 3
    # The sensor still writes its own cogniton: 1.5 + 10 · 0.5 is more than 6.
    assert decisions(chooser(MaximumWeight(), threshold=10.0), 2, eye=0.5) == [0.0] * 2
    assert hierarchy.skill("Top").mind.get_cogniton_value("Light") == 0.0


def test_no_plan_available_leaves_all_without_influence():
    hierarchy = chooser()
    inner = hierarchy.skill("Top").mind
    inner.deactivate_cogniton("Left")
    inner.deactivate_cogniton("Right")
    assert hierarchy.evaluate({"Eye": 1.0}) == {"M": 0.5}
    assert hierarchy.influences() == {"Top": 1.0, "L": 0.0, "R": 0.0}
    inner.activate_cogniton("Right")
    assert hierarchy.evaluate({"Eye": 1.0}) == {"M": 1.0}


def test_what_is_no_cogniton_mind_has_none(collect):
    refused(lambda: collect.skill("Avoid").mind, "'Avoid'", "perceptron")
    refused(lambda: collect.skill("Fly"), "'Fly'")


class Lazy(MaximumWeight):
    """A decision maker of the modeller's own."""


def test_schemes_that_do_not_fit_their_skill():
    def made(inputs=("SE:A", "SE:Pulse"), outputs=("SK:See", "SK:Graph"), scheme=CHOICE, names=()):
        return Skill("Choose", inputs, outputs, CognitonScheme(scheme, dict(names)))

    made()
    made(outputs=("MO:See", "VA:Graph"))  # plans may command actuators and variables
    refused(lambda: made(outputs=("SK:See",)), "'Choose'", "'Graph'")
    refused(lambda: made(outputs=("SK:See", "SK:Graph", "MO:M")), "'Choose'", "MO:M")
    refused(lambda: made(outputs=("SK:See", "SK:Grape")), "'Graph'", "'Grape'")
    refused(lambda: made(inputs=("SE:B",)), "SE:B", "'B'", "A, Pulse")
    refused(lambda: made(inputs=("SE:B",), names={"SE:B": "Puls"}), "'Puls'", "'Pulse'")
    refused(lambda: made(inputs=("SE:B",), names={"SE:C": "A"}), "SE:C")
    refused(lambda: made(inputs=("SE:A", "SD:A")), "two inputs", "'A'")
    lazy = CognitiveScheme("lazy", CHOICE.cognitons, decision_maker=Lazy())
    refused(lambda: made(scheme=lazy), "Lazy", "'lazy'")
    for given, word in (({"active_while": "x > 0"}, "conditions"), ({"chance": 0.5}, "chances")):
        odd = replace(CHOICE, cognitons=(*CHOICE.cognitons, Cogniton("Odd", **given)))
        refused(lambda odd=odd: made(scheme=odd), "'Odd'", word)


def test_an_inner_mind_may_join_groups_and_is_put_back_by_reset():
    scheme = CognitiveScheme(
        "social", (Cogniton("Eye", influence={"Go": 1.0}, conditional=("Go",)),),
        (Group("G", (Role("r"),)),), decision_maker=MaximumWeight(),
    )  # fmt: skip
    top = Skill("Top", ["SE:Eye"], ["SK:Go"], CognitonScheme(scheme))
    hierarchy = Hierarchy(mind([top, constant("Go", {"MO:M": 1.0})]))
    hierarchy.skill("Top").mind.create_and_join_group("G", "r")
    assert hierarchy.evaluate({"Eye": 0.5}) == {"M": 1.0}
    hierarchy.reset()
    assert hierarchy.skill("Top").mind.get_group_id("G") == -1
