"""Variants of a mind (thesis, 6.2, 6.3 and 8.2): what changes, and what must not."""

import numpy as np
import pytest
from collectors import SENSORS, collector, refused, run, values, weights_of
from programs import steer
from random_minds import bits
from small_minds import constant, mind, wired

from socialmind.mind import (
    Hierarchy,
    MindDescription,
    Perceptron,
    Programmed,
    Sensor,
    Skill,
)
from socialmind.mind.variants import duplicates


@pytest.fixture
def collect():
    return collector()


def unchanged(original, made):
    """The original still does what it did when it was made."""
    return run(original) == run(made())


def test_a_skill_replaced_by_another(collect):
    """6.2: a learned skill makes room for another one of the same inputs and outputs."""
    before = weights_of(collect)
    own = wired("Avoid", {"MO:MotL": "SE:Wall", "MO:MotR": "SE:Enemy"})
    variant = collect.replace("Avoid", own)
    assert weights_of(variant).pop("Avoid") != before["Avoid"]
    assert {name: w for name, w in weights_of(variant).items() if name != "Avoid"} == {
        name: w for name, w in before.items() if name != "Avoid"
    }
    sensed = dict.fromkeys(SENSORS, 0.5) | {"Wall": 0.25, "Enemy": 0.75}
    variant.evaluate(sensed)
    assert variant.outputs()["Avoid", "MO:MotL"] == 0.25
    assert variant.outputs()["Avoid", "MO:MotR"] == 0.75
    assert weights_of(collect) == before
    assert unchanged(collect, collector)


def test_a_skill_replaced_by_one_of_another_name(collect):
    variant = collect.replace("Avoid", constant("Flee", {"MO:MotL": 1.0, "MO:MotR": 0.0}))
    assert "Avoid" not in variant.description.skills
    assert variant.skill("Collect").outputs == ("SK:GoToObject", "SK:GoToBase", "SK:Flee",
                                                "VA:Phase")  # fmt: skip
    assert weights_of(variant)["Collect"] == weights_of(collect)["Collect"]
    first, second = collect, variant
    for sensed in values():
        first.evaluate(sensed)
        second.evaluate(sensed)
        assert second.influences()["Flee"] == first.influences()["Avoid"]
        assert second.variables() == first.variables()


def test_a_skill_replaced_by_a_hierarchy(collect):
    claws = MindDescription(
        "claws", ["Wall", "Whisker"], ["MotL", "MotR", "Claw"], ["Alert"],
        [
            constant("Guard", {"SK:Turn": 0.5, "SK:Snap": 1.0}),
            wired("Turn", {"MO:MotL": "SE:Wall", "MO:MotR": "SE:Whisker"}),
            wired("Snap", {"MO:Claw": "SE:Whisker", "VA:Alert": "SE:Wall"}),
        ],
    )  # fmt: skip
    variant = collect.replace("Avoid", Hierarchy(claws, "Guard"))
    assert set(variant.skills) == {"Collect", "GoToObject", "GoToBase", "Guard", "Turn", "Snap"}
    motors = variant.evaluate(dict.fromkeys(SENSORS, 0.5) | {"Whisker": 0.75})
    assert motors["Claw"] in (0.75, 0.5)  # 0.5 where Collect sends Guard no influence
    influences = variant.influences()
    assert influences["Turn"] == 0.5 * influences["Guard"]
    assert unchanged(collect, collector)


def test_a_master_replaced(collect):
    """6.2: the naive variant, a master written by hand over skills that were learned."""
    order = Skill("Order", ["SE:Holds", "SE:Wall"], ["SK:GoToBase", "SK:Avoid"],
                  Programmed(steer))  # fmt: skip
    variant = collect.replace("Collect", order)
    assert variant.master == "Order"
    assert set(variant.skills) == {"Order", "GoToBase", "Avoid"}
    assert "GoToObject" in variant.description.skills  # it is there, and nobody influences it
    variant.evaluate(dict.fromkeys(SENSORS, 0.5))
    assert variant.influences()["Order"] == 1.0


def test_a_master_encapsulated(collect):
    """6.3: a master above, which chooses between collecting and something more."""
    before = weights_of(collect)
    guard = Skill("Guard", ["SE:Enemy", "VA:Alert"], ["SK:Collect", "SK:Attack", "VA:Alert"],
                  Perceptron(0), [-1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.5])  # fmt: skip
    attack = wired("Attack", {"MO:MotL": "SE:Enemy", "MO:Claw": "SE:Enemy"})
    variant = collect.encapsulate(guard, [attack])
    assert variant.master == "Guard"
    assert {name: weights_of(variant)[name] for name in before} == before
    # No enemy: the old mind has all the influence, and does to the last bit what it did alone.
    for sensed in values():
        calm = sensed | {"Enemy": 0.0}
        alone = collect.evaluate(calm)
        motors = variant.evaluate(calm)
        assert bits({n: motors[n] for n in ("MotL", "MotR")}) == bits(
            {n: alone[n] for n in ("MotL", "MotR")}
        )
        assert variant.variables()["Phase"] == collect.variables()["Phase"]
    # An enemy alone: only the attack is heard.
    motors = variant.evaluate(dict.fromkeys(SENSORS, 0.5) | {"Enemy": 1.0})
    assert variant.influences()["Collect"] == 0.0
    assert (motors["MotL"], motors["Claw"]) == (1.0, 1.0)


def test_a_subskill_grafted(collect):
    """6.3: the retrained variant, where the old master gets a skill and a sensor more."""
    before = weights_of(collect)
    attack = wired("Attack", {"MO:MotL": "SE:Enemy", "MO:Claw": "SE:Enemy"})
    variant = collect.graft(attack, inputs=["SE:Enemy", "VA:Alert"])
    master = variant.skill("Collect")
    assert master.inputs[-2:] == ("SE:Enemy", "VA:Alert")
    assert master.outputs[-1] == "SK:Attack"
    assert master.genome is None
    refused(lambda: variant.evaluate(dict.fromkeys(SENSORS, 0.5)), "'Collect'", "without a genome")
    kept = {name: w for name, w in before.items() if name != "Collect"}
    assert {name: weights_of(variant)[name] for name in kept} == kept
    variant.skill("Collect").genome = np.ones(variant.skill("Collect").description.genome_size)
    motors = variant.evaluate(dict.fromkeys(SENSORS, 0.5) | {"Enemy": 0.75})
    assert variant.influences()["Attack"] == 1.0
    assert motors["Claw"] == 0.75
    assert unchanged(collect, collector)


def test_a_hierarchy_grafted_under_a_skill_below(collect):
    deep = Hierarchy(mind([constant("Deep", {"SK:Deeper": 1.0}),
                           wired("Deeper", {"MO:Claw": "SE:Nose"})]), "Deep")  # fmt: skip
    variant = collect.graft(deep, under="Avoid", inputs=["SE:Nose"])
    assert variant.skills.index("Avoid") < variant.skills.index("Deep")
    assert variant.skills.index("Deep") < variant.skills.index("Deeper")
    assert variant.skill("Avoid").inputs == ("SE:Wall", "SE:Nose")
    assert variant.skill("Avoid").genome is None
    variant.randomise(3)
    assert set(variant.evaluate(dict.fromkeys([*SENSORS, "Nose"], 0.5))) == {
        "MotL",
        "MotR",
        "Claw",
    }


def test_variants_of_variants_keep_seed_drive_and_weights(collect):
    def drive(mind):
        mind.set_variable("Alert", 0.25)

    driven = Hierarchy(collect.trained(), seed=9, drive=drive)
    variant = driven.encapsulate(constant("Top", {"SK:Collect": 0.5})).replace(
        "Avoid", constant("Flee", {"MO:MotL": 1.0})
    )
    assert (variant.seed, variant.drive) == (9, drive)
    variant.evaluate(dict.fromkeys(SENSORS, 0.5))
    assert variant.variables()["Alert"] == 0.25
    assert weights_of(variant)["GoToBase"] == weights_of(collect)["GoToBase"]


def test_variants_that_cannot_be(collect):
    avoid = collect.skill("Avoid").description
    other = constant("Avoid", {"MO:MotL": 1.0})
    wrong = [
        (lambda: collect.replace("Flee", avoid), "'Flee'"),
        (lambda: collect.replace("Avoid", "Flee"), "'Flee'", "Skill or a Hierarchy"),
        (lambda: collect.replace("GoToBase", other), "'Avoid'", "another of this name"),
        (lambda: collect.replace("Avoid", wired("New", {"MO:MotL": "SE:Nose"})), "SE:Nose"),
        (lambda: collect.replace("Avoid", avoid, sensors=[Sensor("Wall", "laser")]), "'Wall'"),
        (lambda: collect.encapsulate(other), "'Avoid'", "SK:Collect"),
        (lambda: collect.encapsulate("Top"), "'Top'", "a Skill"),
        (lambda: collect.encapsulate(constant("Collect", {"SK:Collect": 1.0})), "'Collect'"),
        (lambda: collect.encapsulate(constant("Top", {"SK:Collect": 1.0}), [other]), "'Avoid'"),
        (lambda: collect.graft(avoid), "'Avoid' already"),
        (lambda: collect.graft(other), "'Avoid'", "another of this name"),
        (lambda: collect.graft(3), "Skill or a Hierarchy"),
        (lambda: collect.graft(constant("New", {"MO:MotL": 1.0}), under="Flee"), "'Flee'"),
        (lambda: collect.graft(constant("New", {"MO:MotL": 1.0}), inputs=["SE:Nose"]), "SE:Nose"),
        (lambda: collect.graft(constant("New", {"SK:Collect": 1.0})), "Collect > New > Collect"),
        (lambda: collect.graft(collect), "'Collect'"),
    ]
    for call, *words in wrong:
        refused(call, *words)
    assert unchanged(collect, collector)


# Duplicates (8.2.2) ------------------------------------------------------------------------------


def of_a_kind(kind):
    """Give a name its kind."""
    return f"{kind}{{}}".format


def test_a_duplicate_does_with_another_sensor_what_the_skill_does_with_its_own(collect):
    trained = collect.trained()
    found = duplicates(trained, "Collect", {"SeesObject": "SeesPrey"}, of_a_kind("Prey"))
    assert [one.name for one in found if one.name.startswith("Prey")] == [
        "PreyCollect", "PreyGoToObject"
    ]  # fmt: skip
    shared = {one.name: one for one in found}
    assert shared["GoToBase"] is trained.skills["GoToBase"]
    names = ["SeesPrey" if name == "SeesObject" else name for name in SENSORS]
    other = MindDescription("hunter", names, trained.actuators, trained.variables, found)
    hunter = Hierarchy(other, "PreyCollect")
    for sensed in values():
        prey = {"SeesPrey" if name == "SeesObject" else name: one for name, one in sensed.items()}
        assert hunter.evaluate(prey) == collect.evaluate(sensed)


def test_two_duplicates_stand_side_by_side(collect):
    trained = collect.trained()
    skills = {}
    for kind in ("Red", "Blue"):
        found = duplicates(trained, "Collect", {"SeesObject": f"Sees{kind}"}, of_a_kind(kind))
        skills |= {one.name: one for one in found}
    sensors = [*SENSORS, "SeesRed", "SeesBlue"]
    both = MindDescription("both", sensors, trained.actuators, trained.variables, skills.values())
    assert both.masters == ("BlueCollect", "RedCollect")
    assert both.parents["Avoid"] == ("BlueCollect", "RedCollect")
    assert (both.skills["RedGoToObject"].genome == trained.skills["GoToObject"].genome).all()


def test_duplicates_that_cannot_be(collect):
    trained = collect.trained()
    named = of_a_kind("Red")
    refused(lambda: duplicates(trained, "Flee", {"Wall": "Fence"}, named), "'Flee'")
    refused(lambda: duplicates(trained, "Avoid", {"Holds": "Bites"}, named), "'Holds'", "'Avoid'")
    refused(lambda: duplicates(trained, "Avoid", {}, named), "nothing")
