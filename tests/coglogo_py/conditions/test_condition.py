"""Conditions as schemes write them, in Python and in YAML, and what is refused."""

import pickle
from dataclasses import replace

import pytest

from coglogo_py import CognitiveScheme, Cogniton, SchemeError
from coglogo_py.conditions.condition import Condition

HUNGER = Cogniton(
    "Hunger",
    starting=False,
    start_value=2.5,
    conditional=("eat",),
    activated_when="energy<5",
    deactivated_when=("energy > full", "age >= -1.5e0"),
    type="need",
)
FASHION = Cogniton("Fashion", influence={"eat": 1}, type="meme", chance=0.25, inherited=0)
COLD = Cogniton("Cold", active_while=["warmth != .5"], type="percept")
SCHEME = CognitiveScheme("humans", (HUNGER, FASHION, COLD))


def test_a_comparison_is_a_field_an_operator_and_a_number_or_a_parameter():
    assert HUNGER.activated_when == (Condition("energy", "<", 5.0),)
    assert HUNGER.deactivated_when == (
        Condition("energy", ">", "full"),
        Condition("age", ">=", -1.5),
    )
    assert [str(one) for one in HUNGER.conditions] == ["energy < 5", "energy > full", "age >= -1.5"]


def test_schemes_with_conditions_are_written_read_copied_and_pickled(tmp_path):
    file = tmp_path / "humans.yaml"
    SCHEME.save(file)
    found = CognitiveScheme.load(file)
    assert found == SCHEME and found.cognitons == SCHEME.cognitons
    assert (
        found.cognitons[0].activated_when[0].line
        == file.read_text().split("\n").index('    activated_when: "energy < 5"') + 1
    )
    assert pickle.loads(pickle.dumps(SCHEME)).cognitons == SCHEME.cognitons
    assert replace(HUNGER, start_value=3).activated_when == HUNGER.activated_when
    assert replace(HUNGER, activated_when="energy < 6") != HUNGER


@pytest.mark.parametrize("one", [HUNGER, FASHION, COLD], ids=["when", "meme", "while"])
def test_coglogo_files_hold_none_of_it(one, tmp_path):
    with pytest.raises(SchemeError, match=r"a\.cogscheme: found .* a CogLogo file does not hold"):
        CognitiveScheme("a", (one,)).save(tmp_path / "a.cogscheme")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"active_while": "energy"}, "found 'energy' as active_while of cogniton 'A'"),
        ({"active_while": "energy =< 5"}, "write energy < 5 or energy < hunger_limit"),
        ({"active_while": "5 < energy"}, "a field of the agent, one of"),
        ({"active_while": "energy < 1e999"}, "a number or a parameter"),
        ({"active_while": 5}, "found 5 as active_while"),
        ({"active_while": {"energy": 5}}, "as active_while"),
        ({"active_while": "e < 5", "activated_when": "e < 4"}, "active_while and activated_when"),
        ({"active_while": "e < 5", "deactivated_when": "e > 4"}, "leave the other out"),
        ({"active_while": "e < 5", "chance": 0.5}, "chance and active_while of cogniton 'A'"),
        ({"starting": False, "chance": 0.5}, "which no mind has at birth"),
        ({"chance": 1.5}, "found 1.5 as chance of cogniton 'A'; expected a number, 0 … 1"),
        ({"inherited": True}, "found True as inherited"),
        ({"type": "memes"}, "expected one of belief, need, percept, skill, trait, meme; did you"),
        ({"type": 3}, "found 3 as the type"),
    ],
)
def test_what_is_no_condition_type_or_share_is_refused(given, message):
    with pytest.raises(SchemeError) as error:
        Cogniton("A", **given)
    assert message in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("field", "line"),
    [
        ("active_while: energy", 5),
        ("active_while: [energy < 5,\n      energy]", 6),
        ("active_while: {energy: 5}", 5),
        ("chance: 2", 5),
        ("chance: x", 5),
        ("inherited: -1", 5),
        ("type: taste", 5),
        ("active_when: energy < 5", 5),
        ("active_while: a < 1\n    chance: 0.5", 5),
    ],
)
def test_errors_in_files_have_a_line(tmp_path, field, line):
    file = tmp_path / "a.yaml"
    file.write_text(f"name: a\ncognitons:\n  A:\n    start: 1\n    {field}\n")
    with pytest.raises(SchemeError) as error:
        CognitiveScheme.load(file)
    assert str(error.value).startswith(f"{file}:{line}: ") and "\n" not in str(error.value)
