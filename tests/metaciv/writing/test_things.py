"""Objects, recipes and effects of imported models, worked out by hand."""

import pytest

from socialmind.metaciv.importing import ImportRefusedError

from .folders import files_of, followed, imported

DIG = (True, "Work", {"Work": 1})
ADD = "A_AddItem,o(Objet {}),n(Integer {} Constant __NoConstant)"


def test_recipes_are_used_up_and_nothing_is_made_of_too_little(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": "\n".join(
                    (
                        ADD.format("Wood", 3),
                        "A_CreateObject,o(Objet Chair)",
                        "A_CreateObject,o(Objet Chair)",
                        "A_CreateObject,o(Objet Song)",
                        "A_DropItem,o(Objet Wood),n(Integer 5)",
                        ADD.format("Chair", -1),
                    )
                )
            },
            cognitons={"Will": DIG},
            objects=("Wood", "Chair", "Song"),
            recipes={"Chair": {"Wood": 2}},
        ),
    )
    assert followed(model, 6, "wood", "chair", "song") == [
        (3, 0, 0), (1, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1)
    ]  # fmt: skip


def test_effects_come_and_go_with_what_is_carried_and_fractions_stay(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": "\n".join(
                    (
                        ADD.format("Axe", 2),
                        ADD.format("Meal", 3),
                        "A_DropObject,o(Objet Axe),n(Integer 1)",
                        "A_UseObject,o(Objet Meal),n(Integer 2)",
                        "A_DropObjectAndChangeAttribute,o(Objet Meal),n(Integer 1),"
                        "a(Attribute force),d(Double 0.25)",
                    )
                )
            },
            cognitons={"Will": DIG, "Proud": (False, "", {})},
            attributes={"force": 10, "energy": 1},
            objects=("Axe", "Meal"),
            carried_effects={"Axe": ("Strong", "Vain"), "Meal": ("Fed",)},
            effects={
                "Strong": "Cible : attribut\nNomCible : force\nValeur : 1.5\nPermanence : false\n"
                "Type : 1\nActivation : 0\n",
                "Vain": "Cible : cogniton\nNomCible : Proud\nValeur : 2.0\nPermanence : false\n"
                "Type : 1\nActivation : 0\n",
                "Fed": "Cible : attribut\nNomCible : energy\nValeur : 2.5\nPermanence : true\n"
                "Type : 1\nActivation : 1\n",
            },
        ),
    )
    assert followed(model, 5, "force", "energy", "axe", "meal") == [
        (13.0, 1.0, 2, 0), (13.0, 1.0, 2, 3), (11.5, 1.0, 1, 3), (11.5, 6.0, 1, 1),
        (11.75, 6.0, 1, 0),
    ]  # fmt: skip
    society = model(seed=1, compiled=False)
    society.advance(3)
    assert society.humans[0].mind.get_cogniton_value("Proud") == 4.0
    society.advance(2)
    assert society.humans[0].mind.get_cogniton_value("Proud") == 2.0


EFFECT = "Cible : {}\nNomCible : {}\nValeur : {}\nPermanence : {}\nType : {}\nActivation : 0\n"


def test_what_an_effect_brings_has_its_effects_too(tmp_path):
    files = files_of(
        plans={
            "Work": f"{ADD.format('Purse', 1)}\n{ADD.format('Crown', 1)}\n"
            "A_DropObject,o(Objet Purse),n(Integer 1)\n"
            "A_DropObject,o(Objet Coin),n(Integer 9)"
        },
        cognitons={"Will": DIG},
        attributes={"weight": 0},
        objects=("Purse", "Coin", "Crown"),
        carried_effects={"Purse": ("Filled",), "Coin": ("Heavy",), "Crown": ("Rich",)},
        effects={
            "Filled": EFFECT.format("objet", "Coin", 2, "false", 1),
            "Heavy": EFFECT.format("attribut", "weight", 0.5, "false", 1),
            "Rich": EFFECT.format("objet", "Coin", 5, "true", 0),
        },
    )
    model = imported(tmp_path, files)
    assert followed(model, 4, "coin", "weight") == [(2, 1.0), (5, 2.5), (3, 1.5), (0, 0.0)]


def test_effects_that_lead_back_to_themselves_are_said_and_end(tmp_path):
    files = files_of(
        plans={"Work": ADD.format("Hen", 1)},
        cognitons={"Will": DIG},
        objects=("Hen", "Egg"),
        carried_effects={"Hen": ("Lays",), "Egg": ("Hatches",)},
        effects={
            "Lays": EFFECT.format("objet", "Egg", 3, "true", 1),
            "Hatches": EFFECT.format("objet", "Hen", 1, "true", 1),
        },
    )
    with pytest.raises(ImportRefusedError, match="'Hen', whose effects lead back to it"):
        imported(tmp_path, files)
    model = imported(tmp_path, files, strict=False)
    assert followed(model, 1, "hen", "egg") == [(4, 3)]


@pytest.mark.parametrize("constant", [4.0, -2.0, 2.5])
def test_a_constant_is_a_parameter_that_counts(tmp_path, constant):
    line = "A_AddItem,o(Objet Coin),n(Integer 1 Constant pay)"
    model = imported(
        tmp_path,
        files_of(
            plans={"Work": f"{ADD.format('Coin', 5)}\n{line}"},
            cognitons={"Will": DIG},
            constants={"pay": constant},
            objects=("Coin",),
        ),
    )
    assert followed(model, 2, "coin")[1] == (5 + int(constant),)
    if constant == 4:
        assert followed(model, 2, "coin", pay=7)[1] == (12,)


def test_things_are_compared_and_added_by_a_cogniton(tmp_path):
    compare = "L_Compare{}(Objet Coin),c(Comparator {}),n({})"
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": f"""
{compare.format("NObject,o", "==", "Integer 0")}
  A_AddObjectXCogniton,o(Objet Coin),d(Double 1.5),n(Integer 1),c(Cogniton Will)
  {ADD.format("Loss", 1)}
{compare.format("NombreObjets,o", ">=", "Double 2.5 Constant __NoConstant")}
  {ADD.format("Loss", 1)}
  {ADD.format("Gain", 1)}
{compare.format("Object,o", "<", "Double 3.0")}
  {ADD.format("Gain", 1)}
L_OwnItem,o(Objet Loss)
  A_GetObject,o(Objet Loss),n(Integer 1)
  A_GetObject,o(Objet Gain),n(Integer 2)
"""
            },
            cognitons={"Will": DIG},
            objects=("Coin", "Gain", "Loss"),
        ),
    )
    assert followed(model, 4, "coin", "gain", "loss") == [
        (2, 0, 0), (2, 1, 0), (2, 2, 0), (2, 4, 0)
    ]  # fmt: skip
