"""What the linter of minds finds odd."""

import pytest

from socialmind.errors import ModelError
from socialmind.mind import Counter, MindDescription, Programmed, Skill, Variable, Wave
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.lint import findings, genome_sizes


def go():
    return 1.0


def base(name, output="MO:L", inputs=()):
    return Skill(name, inputs, [output], Perceptron(layers=0), [0.5] * (len(inputs) + 1))


def lines(mind, *arguments):
    return [str(one) for one in findings(mind, *arguments)]


def test_a_sound_mind_has_no_findings():
    top = base("Top", "SK:Go", ["SE:Eye", "VA:Clock"])
    mind = MindDescription("m", ["Eye"], ["L"], [Variable("Clock", Wave())], [top, base("Go")])
    assert lines(mind) == []


def test_unused_modules():
    mind = MindDescription("m", ["Eye"], ["L", "R"], ["X"], [base("Go")])
    assert lines(mind) == [
        "unused sensor: sensor 'Eye': no skill reads it",
        "unused variable: variable 'X': no skill reads or writes it",
        "unused actuator: actuator 'R': no skill commands it",
    ]


def test_variables_of_which_one_side_is_missing():
    reader = base("Go", inputs=["VA:Still", "VD:Count", "VA:Wave", "VA:Shared"])
    variables = [
        Variable("Still", default=0.25),
        Variable("Count", Counter()),
        Variable("Wave", Wave()),
        Variable("Shared", group="Herd"),
        Variable("Lost"),
    ]
    skills = [reader, base("A", "VA:Lost"), base("B", "VA:Lost")]
    assert lines(MindDescription("m", (), ["L"], variables, skills)) == [
        "never written: variable 'Still': no skill writes it: it stays 0.25 unless a drive module "
        "acts",
        "never written: variable 'Count': no skill writes it: it stays 0 unless a drive module "
        "acts",
        "never read: variable 'Lost': A and B write it, no skill reads it",
    ]


def test_skills_and_outputs_out_of_reach():
    top = base("Top", "SK:Go")
    mind = MindDescription("m", (), ["L", "R"], skills=[top, base("Go"), base("Stray", "MO:R")])
    expected = [
        "skill out of reach: skill 'Stray': no master influences it; link it from a skill above, "
        "or leave it out",
        "output nobody can influence: actuator 'R': only Stray would, out of a master's reach",
    ]
    assert lines(mind) == expected
    assert lines(mind, "Top") == expected
    assert lines(mind, ["Top", "Stray"]) == []
    assert [one.where for one in findings(mind, "Go")][:2] == ["skill 'Stray'", "skill 'Top'"]
    with pytest.raises(ModelError, match="did you mean 'Top'"):
        findings(mind, "Tap")


def test_base_skills_alone_are_all_masters():
    assert lines(MindDescription("m", (), ["L", "R"], skills=[base("A"), base("B", "MO:R")])) == []


def test_inputs_twice_and_weights_that_are_not_set():
    skill = Skill("Go", ["SE:Eye", "SD:Eye", "SE:Eye"], ["MO:L"], Perceptron(layers=0))
    assert lines(MindDescription("m", ["Eye"], ["L"], skills=[skill])) == [
        "input listed twice: skill 'Go': SE:Eye stands 2 times among its inputs",
        "no weights: skill 'Go': its 4 weights are not set; train it, or draw them at random",
    ]


def test_programs_are_typed_where_it_is_asked_for():
    def refuse(skill):
        raise ModelError("a dictionary", "a number", file="go.py", line=3)

    mind = MindDescription("m", (), ["L"], skills=[Skill("Go", (), ["MO:L"], Programmed(go))])
    assert lines(mind) == []
    (found,) = findings(mind, None, refuse)
    assert (found.kind, found.where) == ("outside the rule language", "skill 'Go'")
    assert found.message == "go.py:3: found a dictionary; expected a number"


def test_genome_sizes_from_the_top_down():
    skills = [Skill("Go", (), ["MO:L"], Programmed(go)), base("Top", "SK:Go", ["SE:Eye"])]
    sizes = genome_sizes(MindDescription("m", ["Eye"], ["L"], skills=skills))
    assert list(sizes.items()) == [("Top", 2), ("Go", 0)]
