"""Names and histories that cannot be, and names that can, in memory and in files."""

import math

import pytest
from programs import mean

from socialmind.errors import ModelError
from socialmind.mind import (
    Actuator,
    Hierarchy,
    Input,
    MindDescription,
    Output,
    Perceptron,
    Programmed,
    Regulated,
    Sensor,
    Skill,
    Variable,
    load_mind,
)
from socialmind.mind.links import MOST_TICKS

MAKERS = {
    "sensor": Sensor,
    "actuator": Actuator,
    "variable": Variable,
    "group": lambda name: Variable("V", group=name),
    "skill": lambda name: Skill(name, [], ["MO:M"], Perceptron(0)),
    "input": lambda name: Input("SE", name),
    "output": lambda name: Output("MO", name),
}
CONTROL = ["a\x00b", "a\x1bb", "a\tb", "a\nb", "a\rb", "a\x7fb", "a\x85b", "a\u2028b", "a\u2029b",
           "\ufeffa", "a\ufeff", "\ufeff", "\ud800"]  # fmt: skip


def refused(call, *words):
    with pytest.raises(ModelError) as raised:
        call()
    message = str(raised.value)
    assert "\n" not in message
    assert "\x1b" not in message
    assert message.isprintable()
    for word in words:
        assert word in message


@pytest.mark.parametrize("what", MAKERS)
@pytest.mark.parametrize("name", CONTROL)
def test_control_characters_are_named_by_their_number(what, name):
    bad = next(c for c in name if c != "a" and c != "b")
    refused(lambda: MAKERS[what](name), f"U+{ord(bad):04X}", "without control characters")


@pytest.mark.parametrize("what", MAKERS)
@pytest.mark.parametrize("name", ["", " ", " a", "a ", "a:b", "a#b", "a/b", "a\\b", None, 3, b"a"])
def test_names_that_files_cannot_hold(what, name):
    if not (what == "group" and name is None):
        refused(lambda: MAKERS[what](name), "name")


@pytest.mark.parametrize("file", ["mind", "mind.yaml"])
@pytest.mark.parametrize(
    "word", ["Œil gauche", "眼", "a-b.c", "👁\u200d🗨", "true", "12", "null", "~"]
)
def test_names_of_all_scripts_come_back_from_files(tmp_path, file, word):
    skill = Skill(word, [f"SE:{word}", f"VH:{word}:2"], [f"MO:{word}", f"VA:{word}"],
                  Perceptron(0), [0.5, 0.25, 0.125, 0.5, 0.0, 0.25])  # fmt: skip
    made = Hierarchy(MindDescription(word, [word], [word], [word], [skill]))
    made.save(tmp_path / file)
    loaded = load_mind(tmp_path / file)
    assert loaded.skills == (word,)
    for value in (0.25, 1.0, 0.0):
        assert loaded.evaluate({word: value}) == made.evaluate({word: value})
        assert loaded.variables() == made.variables()


def test_a_name_too_long_for_a_file_is_refused_when_it_is_saved(tmp_path):
    word = "x" * 4000
    skill = Skill(word, [f"SE:{word}"], [f"MO:{word}"], Perceptron(0), [1.0, 0.0])
    made = Hierarchy(MindDescription("long", [word], [word], [], [skill]))
    assert made.evaluate({word: 0.5}) == {word: 0.5}
    for file in ("long", "long.yaml"):
        refused(lambda file=file: made.save(tmp_path / file), "cannot be written", "too long")


@pytest.mark.parametrize(
    "digits", ["0", "00", "100001", "9" * 20, "9" * 5000, "-1", "1.5", "x", ""]
)
def test_histories_that_cannot_be(digits):
    refused(lambda: Input.parse(f"SH:Eye:{digits}"))


def test_the_longest_history():
    assert Input.parse(f"SH:Eye:{MOST_TICKS}").ticks == MOST_TICKS
    assert Input.parse("SH:Eye:" + "0" * 5000 + "7").ticks == 7
    assert Input.parse("VH: Eye : ٣").ticks == 3
    refused(lambda: Input("SH", "Eye", MOST_TICKS + 1), "100,000", "'Eye'")
    refused(lambda: Input("SE", "Eye", 5), "SE:Eye", "SH or VH")
    refused(lambda: Input.parse("SE:Eye:1:2"), "SE:Eye:1:2")


def named_only(left, *, right):
    return left + right


@pytest.mark.parametrize("function", [5, None, "f", min])
def test_what_is_no_plain_function(function):
    refused(lambda: Programmed(function), "a plain function")
    refused(lambda: Regulated(function), "a plain function")


def test_functions_that_do_not_fit_their_inputs():
    refused(lambda: Programmed(named_only), "named_only()", "must be named")
    refused(lambda: Skill("A", ["SE:L", "SE:R"], ["MO:M"], Programmed(math.sin)), "'A'", "1 value")
    assert Skill("A", ["SE:L", "SE:R"], ["MO:M"], Programmed(mean)).genome_size == 0


def test_a_shared_variable_has_no_regulation_of_its_own():
    def calm(value):
        return value / 2

    with pytest.raises(ModelError, match="shared in 'Village'") as caught:
        Variable("V", Regulated(calm), group="Village")
    assert "\n" not in str(caught.value)
