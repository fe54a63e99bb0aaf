"""Schemes in YAML: the form, the models' own files, YAML's pitfalls and the errors."""

import re
from pathlib import Path

import pytest
import yaml

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    MaximumWeight,
    Role,
    SchemeError,
    WeightedStochastic,
)
from coglogo_py.files.yaml_file import parse, written

MODELS = Path(__file__).parents[3] / "models"


def read(text):
    return parse(text, "cows.yaml", CognitiveScheme)


def test_the_whole_form():
    scheme = read("""
# A comment, which the reader skips.
name: cows
decision_maker: {name: BiasedWeightedStochastic, bias: 2.5}
breeds: [cows, Bulls]
plans: [rest, eat]
plan_positions: {eat: [97, -20]}
cognitons:
  hunger:
    at_birth: false
    start: -1.5
    colour: '#0102ff'
    position: [3, -4]
    influence: {eat: 2, rest: -1e-3}
    conditional: [eat]
    reinforcement: {eat: -.5}
  mood:
groups:
  herd:
    leader:
      trust:
        start: 1
        influence: {rest: 1}
    follower:
      trust:
  crowd:
""")
    trust = Culturon("trust", 1, influence={"rest": 1})
    assert scheme == CognitiveScheme(
        "cows",
        (
            Cogniton(
                "hunger",
                False,
                -1.5,
                (1, 2, 255),
                (3, -4),
                {"eat": 2, "rest": -0.001},
                ("eat",),
                {"eat": -0.5},
            ),
            Cogniton("mood"),
        ),
        (Group("herd", (Role("leader", (trust,)), Role("follower", (trust,)))), Group("crowd")),
        BiasedWeightedStochastic(2.5),
        ("cows", "Bulls"),
        {"eat": (97, -20)},
        ("rest", "eat"),
    )


def test_only_the_name_is_needed():
    assert read("name: cows") == CognitiveScheme("cows", decision_maker=MaximumWeight())


def test_a_decision_maker_may_stand_by_its_name_alone():
    maker = read("name: cows\ndecision_maker: WeightedStochastic").decision_maker
    assert maker == WeightedStochastic()


def test_the_farmer_artisan_scheme_is_the_original_one(shared_data):
    original = CognitiveScheme.load(shared_data("cogscheme/farmer_artisan.cogscheme"))
    ours = CognitiveScheme.load(MODELS / "farmer_artisan" / "scheme.yaml")
    assert ours == original
    assert [c.name for c in ours.cognitons] == [c.name for c in original.cognitons]
    assert ours.plans == original.plans
    assert repr(ours.cognitons) == repr(original.cognitons)


def test_the_farmer_artisan_scheme_by_the_thesis():
    scheme = CognitiveScheme.load(MODELS / "farmer_artisan" / "scheme.yaml")
    assert scheme.decision_maker == BiasedWeightedStochastic(2.6)
    assert [c.name for c in scheme.cognitons if not c.starting] == ["ToolStock"]
    farmer = next(c for c in scheme.cognitons if c.name == "Farmer")
    assert farmer.influence == {"GrowWheat": 5.0}
    assert farmer.reinforcement == {"TradeWheatForTools": 0.05, "TradeToolsForWheat": -0.05}
    assert scheme.check() == []


def test_the_tutorial_scheme_by_the_thesis():
    scheme = CognitiveScheme.load(MODELS / "tutorial" / "scheme.yaml")
    assert scheme.plans == ("goto-red", "goto-blue", "goto-green")
    assert {c.name: c.start_value for c in scheme.cognitons} == {
        "wantRed": 0.0,
        "wantBlue": 1.0,
        "wantGreen": 0.0,
    }
    assert scheme.cognitons[2].reinforcement == {"goto-red": 0.005, "goto-blue": 0.005}
    assert scheme.decision_maker == MaximumWeight()
    assert scheme.check() == []


@pytest.mark.parametrize("name", ["yes", "no", "on", "null", "~", "10", "1e3", "2024-01-01", "é"])
def test_names_are_taken_as_they_are_written(name):
    (cogniton,) = read(
        f"name: {name}\ncognitons: {{{name}: {{influence: {{{name}: 1}}, conditional: [{name}]}}}}"
    ).cognitons
    assert cogniton == Cogniton(name, influence={name: 1}, conditional=(name,))


@pytest.mark.parametrize(
    ("text", "value"),
    [("1e-3", 0.001), ("+5", 5.0), (".5", 0.5), ("3.", 3.0), ("1E2", 100.0), ("010", 10.0)],
)
def test_numbers_as_people_write_them(text, value):
    assert read(f"name: c\ncognitons: {{a: {{start: {text}}}}}").cognitons[0].start_value == value


@pytest.mark.parametrize(
    ("text", "value"),
    [("true", True), ("True", True), ("yes", True), ("no", False), ("off", False)],
)
def test_truth_as_people_write_it(text, value):
    assert read(f"name: c\ncognitons: {{a: {{at_birth: {text}}}}}").cognitons[0].starting is value


def test_a_culturon_named_again_is_the_earlier_one_and_may_add_to_it():
    (group,) = read("""
name: c
groups:
  g:
    r: {k: {start: 3, colour: '#ff0000', influence: {p: 1, q: 1}, conditional: [p]}}
    s: {k: {influence: {p: 2}, conditional: [q]}}
""").groups
    k = Culturon("k", 3, (255, 0, 0), influence={"p": 2, "q": 1}, conditional=("p", "q"))
    assert group == Group("g", (Role("r", (k,)), Role("s", (k,))))


def test_groups_and_roles_stand_where_a_drawing_has_them():
    group, other = read("""
name: c
groups:
  g: {r: {k: {position: [5, 6]}}, s: }
  h:
nested_groups: {h: {g: r}}
group_positions: {g: [-480, 0]}
role_positions: {g: {s: [-290, 90]}}
""").groups
    assert group == Group(
        "g", (Role("r", (Culturon("k", position=(5, 6)),)), Role("s", (), (-290, 90))),
        position=(-480, 0),
    )  # fmt: skip
    assert (other.position, other.within) == (None, ("g", "r"))


def test_other_readers_of_yaml_see_the_same_values():
    scheme = CognitiveScheme(
        "yes",
        (Cogniton("null", True, 1e-7, influence={"#p: q": 1e22, "10": -2.5}, conditional=("no",)),),
        plan_positions={f"a plan with a long name, number {i}": (i, -i) for i in range(5)},
    )
    content = yaml.safe_load(written(scheme))
    assert content["name"] == "yes"
    cogniton = content["cognitons"]["null"]
    assert cogniton["influence"] == {"#p: q": 1e22, "10": -2.5}
    assert cogniton["start"] == 1e-7
    assert cogniton["conditional"] == ["no"]
    assert content["plans"] == list(scheme.plans)
    assert content["plan_positions"]["a plan with a long name, number 4"] == [4, -4]
    assert max(len(line) for line in written(scheme).splitlines()) <= 100


def test_what_is_saved_begins_with_a_comment_and_describes_a_culturon_once():
    k = Culturon("k", 3, influence={"p": 1})
    text = written(CognitiveScheme("c", groups=(Group("g", (Role("r", (k,)), Role("s", (k,)))),)))
    assert text.startswith("# A cognitive scheme")
    assert text.count("influence: {p: 1}") == 1


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 1, "found an empty file; expected a cognitive scheme; begin with name:"),
        ("# only a comment\n", 1, "found an empty file"),
        ("STARTCS\ncows\n", 1, "found 'STARTCS cows' as the scheme; expected name: value"),
        ("cognitons:\n", 1, "found a scheme without a name; expected name:"),
        ("name: a\nname: b\n", 2, "'name' stands twice in the scheme, first in line 1"),
        ("name: [a]\n", 1, "found several values as name of the scheme; expected a name"),
        ("name:\n", 1, "found nothing as name of the scheme; expected a name"),
        ("name: c\ncognitions:\n", 2, "field 'cognitions' in the scheme"),
        ("name: c\ncognitions:\n", 2, "did you mean 'cognitons'?"),
        ("name: c\n\n  x: [\n", 3, "text that is not YAML"),
        ("name: c\ncognitons:\n\ta:\n", 3, "indent with spaces; YAML takes no tabs"),
        ("name: c\n---\nname: d\n", 2, "text that is not YAML"),
        ("name: c\nx: \x01\n", 2, "found a control character; expected text"),
        ("name: c\ncognitons: [a]\n", 2, "found several values as cognitons; expected name: value"),
        ("name: c\ncognitons:\n  a:\n  b:\n  a:\n", 5, "'a' stands twice in cognitons, first"),
        ("name: c\ncognitons:\n  <<: {a: }\n", 3, "found '<<' in cognitons; expected a name"),
        ("name: c\ngroups:\n  g: {r: {k: {at_birth: true}}}\n", 3, "'at_birth' in culturon 'k'"),
        ("name: c\ndecision_maker: Maximum\n", 2, "'Maximum'; expected one of"),
        ("name: c\ndecision_maker: {bias: 2}\n", 2, "decision_maker without a name"),
        ("name: c\ndecision_maker:\n  name: MaximumWeight\n  bias: 0\n", 4, "bias 0.0 of"),
        ("name: c\ndecision_maker:\n  name: Maximum\n  bias: 2\n", 3, "did you mean"),
        ("name: c\nplans: [a, b, a]\n", 2, "'a' stands twice in plans"),
        ("name: c\nplans:\n  - \n", 3, "found nothing as a name in plans; expected a name"),
        ("name: c\nplan_positions: {a: 3}\n", 2, "as position of plan 'a'; expected a list"),
        ("name: c\nplan_positions: {a: [1, 3000000000]}\n", 2, "a whole number of 32 bits"),
        (
            "name: c\ngroups: {g: {r: }}\ngroup_positions: {g: [1, 2],\n  h: [0, 0]}\n",
            4,
            "the position of a group 'h'; expected a group of the scheme: g",
        ),
        (
            "name: c\ngroups: {g: {r: }}\nrole_positions:\n  g: {r: [1, 2], s: [0, 0]}\n",
            4,
            "the position of a role 's'; expected a role of the group: r",
        ),
        ("name: c\nrole_positions: {g: {r: [1, 2]}}\n", 2, "of a group 'g'; expected a group of"),
        ("name: c\ngroups: {g: }\ngroup_positions: {g: 3}\n", 3, "as position of group 'g'; exp"),
        (
            "name: c\ngroups: {g: {r: }}\nrole_positions: {g: {r: [1]}}\n",
            3,
            "as position of role 'r'; expected two whole numbers; write [97, -20]",
        ),
        ("name: &a [*a]\n", 1, "expected a name"),
        ("name: c\nbreeds: cows\n", 2, "found 'cows' as breeds; expected a list; write [cows]"),
    ],
)  # fmt: skip
def test_errors_say_the_line_the_field_and_what_to_do(text, line, message):
    with pytest.raises(SchemeError) as failure:
        read(text)
    assert str(failure.value).startswith(f"cows.yaml:{line}: ")
    assert message in str(failure.value)


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ("colour: #ff0000", "found nothing as colour of a"),
        ("colour: #ff0000", "without them # begins a comment"),
        ("colour: 'red'", "found 'red' as colour of a"),
        ("start: five", "found 'five' as start of a; expected a number"),
        ("start: 1,5", "write it with a point"),
        ("start: 1_000", "found '1_000' as start of a"),
        ("start: .nan", "found '.nan' as start of a"),
        ("start: .inf", "expected a number"),
        ("start: 1e999", "expected a number under 1.8e308"),
        ("start: '5'", "found '5' as start of a; expected a number; remove the quotes"),
        ("start:", "found nothing as start of a"),
        ("at_birth: 1", "found '1' as at_birth of a; expected true or false"),
        ("at_birth: 'true'", "write it without quotes"),
        ("position: [1]", "as position of a; expected two whole numbers"),
        ("position: [1, 2.5]", "found '2.5' as position of a"),
        ("conditional: eat", "expected a list; write [eat]"),
        ("conditional: {eat: 1}", "found fields as conditional of a"),
        ("conditional: [eat, eat]", "'eat' stands twice in conditional of a"),
        ("influence: [eat]", "found several values as influence of a"),
        ("influence: {eat: 1, eat: 2}", "'eat' stands twice in influence of a"),
        ("influence: {eat: much}", "found 'much' as influence of a to 'eat'"),
        ("influences: {eat: 1}", "did you mean 'influence'?"),
    ],
)  # fmt: skip
def test_errors_name_the_field_of_a_cogniton(field, message):
    with pytest.raises(SchemeError) as failure:
        read(f"name: c\ncognitons:\n  a:\n    {field}\n")
    assert str(failure.value).startswith("cows.yaml:4: ")
    assert message.replace(" of a", " of cogniton 'a'") in str(failure.value)


def test_the_example_in_the_documentation_loads_and_is_sound():
    page = (MODELS.parent / "docs" / "schemes.md").read_text(encoding="utf-8")
    whole, *others = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    scheme = read(whole + "".join(one for one in others if one.startswith("group_")))
    assert scheme.check() == []
    assert scheme.groups[0].attributes == (("milk", 0.0), ("land", 2.5))
    assert [role.position for role in scheme.groups[0].roles] == [(-290, 0), (-290, 92)]
    assert scheme.decision_maker == BiasedWeightedStochastic(2)
    trust = Culturon("trust", 1, influence={"lead": 10, "follow": 10}, conditional=("lead",))
    assert [role.culturons[0] for role in scheme.groups[0].roles] == [trust, trust]
