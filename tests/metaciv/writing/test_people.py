"""Civilisations with schemes of their own: one population, each with its own mind."""

import pytest

from .folders import files_of, followed, imported, joined

TIRE = {"Tire": "self"}


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """Farmers, who work, and raiders, who attack whom they meet; both have plans called alike."""
    farmers = files_of(
        scheme="Farmer",
        people="Farmers",
        plans={
            "Live": "A_AddItem,o(Objet Corn),n(Integer 2)",
            "Rest": "A_DoNothing",
            "Tire": "A_ChangeAttribute,a(Attribute energy),n(Integer -1 Constant effort)",
        },
        kinds=TIRE,
        cognitons={
            "Will": (True, "Live Rest", {"Live": 3}),
            "Alike": (True, "Rest", {"Rest": 1}),
            "Bond": (False, "", {}),
            "Fit": "Initial : 0\nTrigger : skill,2.0,-2,__NoConstant\n",
        },
        attributes={"energy": 10, "life": 5, "skill": 3},
        constants={"effort": -1},
        groups={"Home": "Culturon : one,Bond\nAutoJoin : true,one\n"},
        objects=("Corn",),
        agents=2,
    )
    raiders = files_of(
        scheme="Raider",
        people="Raiders",
        plans={
            "Live": "A_GetCibleInteraction_Tag,a(Attribute energy)\nI_Attaquer,a(Attribute life)",
            "Rest": "A_DoNothing",
            "Tire": "A_ChangeAttribute,a(Attribute energy),n(Integer -1 Constant effort)",
        },
        kinds=TIRE,
        cognitons={
            "Will": (True, "Live", {"Live": 2}),
            "Alike": (True, "Rest", {"Rest": 1}),
            "Bond": (False, "", {}),
        },
        attributes={"energy": 0, "life": 5},
        constants={"effort": 0.5},
        groups={"Home": "Culturon : one,Bond\nAutoJoin : true,one\n"},
        objects=("Corn",),
    )
    return imported(tmp_path_factory.mktemp("two"), joined(farmers, raiders, place=(2, 1)))


def test_what_is_alike_is_one_and_what_differs_bears_the_name_of_its_scheme(model):
    text = (model.folder() / "scheme.yaml").read_text()
    assert "conditional: [Live, Rest]" in text
    assert '"Will (Raider)":' in text and '"Live (Raider)"' in text
    assert text.count("  Alike:") == 1 and "Alike (Raider)" not in text
    assert set(model.parameters) >= {"effort", "effort_raider", "n_farmers", "n_raiders"}


def test_each_is_born_with_its_own_mind_attributes_and_group(model):
    society = model(seed=1, compiled=False)
    society.advance(2)
    farmer, other, raider = society.humans
    assert (farmer.civilisation, raider.civilisation) == ("Farmers", "Raiders")
    assert (farmer.energy, raider.energy) == (10.0, 0.0)
    assert (farmer.skill, raider.skill) == (3.0, 0.0)
    farmer.skill = 1.0
    society.advance(1)
    assert farmer.mind.is_active("Fit") and not raider.mind.is_active("Fit")
    assert farmer.mind.is_active("Will") and not farmer.mind.is_active("Will (Raider)")
    assert raider.mind.is_active("Will (Raider)") and not raider.mind.is_active("Will")
    homes = [one.mind.get_group_id("Home") for one in (farmer, other, raider)]
    assert homes[0] == homes[1] >= 0 and homes[2] not in (-1, homes[0])


def test_each_follows_its_own_plans_and_they_meet(model):
    society = model(seed=1, compiled=False)
    society.advance(6)
    farmer, other, raider = society.humans
    assert (farmer.plan, raider.plan) == ("Live", "Live (Raider)")
    assert (farmer.corn, raider.corn) == (8, 0)
    assert (farmer.energy, raider.energy) == (6.0, 2.0)
    assert farmer.life + other.life == 8.0  # attacked in ticks 4 and 6
    assert society.series()["raiders"] == 1


def test_a_blank_start_is_a_model_whose_agents_idle(tmp_path):
    model = imported(tmp_path, files_of(plans={}, cognitons={}, agents=4))
    society = model(seed=1, compiled=False)
    society.advance(4)
    assert len(society.humans) == 4
    assert {one.plan for one in society.humans} == {None}


def test_an_empty_plan_lets_ticks_pass(tmp_path):
    model = imported(tmp_path, files_of(plans={"Wait": ""}, cognitons={"W": (True, "Wait", {})}))
    assert followed(model, 3, "plan", "x") == [("Wait", 2.0)] * 3
