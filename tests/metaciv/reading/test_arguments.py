"""Arguments of actions: told apart by type or label, in any order; names with blanks; constants."""

import pytest

from socialmind.metaciv.reading import read_folder

from .folders import FARMERS, written

PLAN = "schemasCognitifs/Farmer/plans/Work.metaciv"


@pytest.fixture
def read(tmp_path):
    """Read an action; gives it, or None, and what was found."""

    def reading(text):
        files = {**FARMERS, PLAN: f"Nom : Work\nAction : {text}\n"}
        found = read_folder(written(tmp_path, files))
        plans = found.model.schemes[0].plans if found.model else ()
        action = plans[0].actions[0] if plans else None
        return action, [one.told for one in found.findings]

    return reading


def test_types_tell_arguments_apart_in_any_order(read):
    action, odd = read("L_CompareObject,c(Comparator <),n(Double 1.0),x(Objet Sack of corn)")
    assert ([one.value for one in action.arguments], odd) == (["Sack of corn", "<", 1.0], [])


def test_labels_tell_alike_ones_apart(read):
    action, odd = read(
        "I_Commercer_Repondu,nObjectToTake(Integer 2),objectToTake(Objet Brown bread),"
        "objectToGive(Objet Sack of corn),nObjectToGive(Integer 5 Constant meal)"
    )
    assert odd == []
    assert [one.value for one in action.arguments] == ["Sack of corn", 5, "Brown bread", 2]
    assert [one.constant for one in action.arguments] == [None, "meal", None, None]


def test_labels_that_say_something_else_are_noise(read):
    action, odd = read("I_Commercer_Repondu,a(String Brown bread),b(Integer 1),"
                       "c(Objet Sack of corn),d(Integer 2)")  # fmt: skip
    assert odd == []
    assert [one.value for one in action.arguments] == ["Sack of corn", 1, "Brown bread", 2]


def test_a_value_may_end_at_its_first_blank(read):
    action, odd = read("A_AddCogniton,c(Cogniton Hungry indeed)")
    assert (action.arguments[0].value, odd) == ("Hungry", [])


def test_only_the_first_value_of_a_label_counts(read):
    action, odd = read("A_AddItem,x(Objet Brown bread;Objet Nothing),n(Integer 2;Integer 3)")
    assert ([one.value for one in action.arguments], odd) == (["Brown bread", 2], [])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "A_AddItem,x(Objet Brown bread)",
            "found A_AddItem without its Integer; expected an argument `label(Integer …)`",
        ),
        (
            "A_AddItem,x(Objet Brown bred),n(Integer 1)",
            "found 'Brown bred'; expected the name of an object; did you mean 'Brown bread'?",
        ),
        ("A_AddItem,x(Objet Brown bread),n(Integer 1.5)", "found '1.5'; expected a whole number"),
        ("A_AddItem,x(Objet Brown bread),n(Double 1e30)", "found 1e+30; expected a whole number"),
        ("A_AddItem,x(Objet Brown bread", None),
        (
            "L_CompareObject,x(Objet Brown bread),c(Comparator =),n(Double 1.0)",
            "found '='; expected one of > >= == <= <",
        ),
        (
            "A_CreateGroup,g(GroupAndRole Village:chef)",
            "found 'chef'; expected the name of a role of 'Village'; did you mean 'chief'?",
        ),
        ("A_CreateGroup,g(GroupAndRole Village)", "found 'Village'; expected `group:role`"),
        ("A_Move,UP", "found 'UP'; expected a direction: NORTH, EAST, SOUTH, WEST"),
        (
            "A_Die,x(Object Bread)",
            "found 'Object'; expected the name of a type of arguments; did you mean 'Objet'?",
        ),
    ],
)
def test_what_is_wrong_is_an_error(read, text, told):
    action, odd = read(text)
    assert action is None
    assert told is None or odd == [told]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "A_AddItem,x(Objet Brown bread),n(Integer 1 Constant mael)",
            "found 'mael'; expected the name of a constant; did you mean 'meal'?; 1 counts",
        ),
        (
            "A_GetObject,x(Objet Brown bread),n(Integer 1 Constant meal)",
            "the constant 'meal', which A_GetObject does not heed; 1 counts",
        ),
    ],
)
def test_a_constant_that_does_not_count_is_said(read, text, told):
    action, odd = read(text)
    assert (action.arguments[1].value, action.arguments[1].constant, odd) == (1, None, [told])


def test_old_names_are_the_kinds_of_today(read):
    action, odd = read("A_CreateAmenagement,a(Amenagement Mill)")
    assert (action.name, action.written, odd) == (
        "A_CreatePrivateFacility", "A_CreateAmenagement", [],
    )  # fmt: skip
