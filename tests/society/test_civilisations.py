"""Civilisations: founders at their places with what they begin with, and descendants."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import (
    Agent,
    Civilisation,
    Model,
    ModelError,
    Patch,
    Population,
    SocialmindError,
    Torus,
    each,
    parameter,
)
from socialmind.errors import ValueRefusedError
from socialmind.society.civilisations import half_square

SCHEME = CognitiveScheme(
    "people",
    (
        Cogniton("Greed", start_value=1.0, influence={"take": 1.0}, conditional=("take",)),
        Cogniton("Faith", False, influence={"pray": 1.0}, conditional=("pray",)),
    ),
)


class Human(Agent):
    wheat: float = 0.0
    tools: list[int] = [0] * 2
    north: int = 0
    strangers: int = 0


def take(human):
    human.wheat += 1


def pray(human):
    human.wheat += 100


def live(human, model, rng):
    human.plan = human.mind.choose_next_plan()
    human.run_plan(model, rng)
    if human.civilisation == "North":
        human.north += 1
    for other in model.humans:
        if other.civilisation != human.civilisation:
            human.strangers += 1
    if model.tick == 2:
        child = human.hatch()
        child.wheat = 0.0
        if human.civilisation == "South" and rng.random() < 0.5:
            child.civilisation = "East"
        elif rng.random() < 0.5:
            made = model.humans.create()
            made.civilisation = human.civilisation
        human.die()


PEOPLES = (
    Civilisation("North", "n_north", place=(2.0, 9.0), colour="#c04000", scattered=1.5),
    Civilisation("South", 10, place=(-3.0, -4.0), cognitons={"Greed": 0.5, "Faith": 2.0}),
    Civilisation("East", 2, place=(9.8, 0.0), scattered=0.0, values={"wheat": 7, "tools": [1, 2]}),
)


class Peoples(Model):
    n_north: int = parameter(4, low=0)
    world = Torus(21, Patch)
    humans = Population(Human, mind=SCHEME, plans={"take": take, "pray": pray},
                        civilisations=PEOPLES)  # fmt: skip
    schedule = (each(humans, live),)


def test_founders_stand_around_their_places_with_what_they_begin_with():
    society = Peoples(seed=1, compiled=False)
    humans = society.humans
    assert len(humans) == 16
    assert humans.civilisation.tolist() == ["North"] * 4 + ["South"] * 10 + ["East"] * 2
    north = np.array([humans.x[:4] - 2.0, humans.y[:4] - 9.0])
    assert (np.abs(north) <= 1.5).all()
    assert len(np.unique(north)) == 8
    south = np.array([humans.x[4:14] + 3.0, humans.y[4:14] + 4.0])
    assert (np.abs(south) <= 2.5).all()  # ten want a square of 5 by 5
    assert np.abs(south).max() > 1.5
    assert humans.x[14:].tolist() == [9.8, 9.8]
    assert humans.wheat.tolist() == [0.0] * 14 + [7.0] * 2
    assert humans.tools[14:].tolist() == [[1, 2], [1, 2]]
    assert humans.cogniton("Greed").tolist() == [1.0] * 4 + [0.5] * 10 + [1.0] * 2
    np.testing.assert_array_equal(
        humans.cogniton("Faith"), [np.nan] * 4 + [2.0] * 10 + [np.nan] * 2
    )


@pytest.mark.parametrize(("agents", "half"), [(0, 0.5), (1, 0.5), (2, 1.5), (25, 2.5), (26, 3.5)])
def test_the_smallest_square_has_a_patch_for_each(agents, half):
    assert half_square(agents) == half


def test_both_speeds_give_the_same_and_descendants_inherit():
    fast, slow = Peoples(seed=3), Peoples(seed=3, compiled=False)
    for society in (fast, slow):
        society.advance(2)
        assert society.humans.north.tolist() == [2] * 4 + [0] * 12
        # 4 of the North meet 12 strangers each tick, and so on.
        assert society.humans.strangers.tolist() == [24] * 4 + [12] * 10 + [28] * 2
        society.advance(1)
    for column in fast.humans.dtype.names:
        np.testing.assert_array_equal(
            *(one.humans.columns[column][one.humans.slots] for one in (fast, slow))
        )
    counts = {name: list(slow.humans.civilisation).count(name) for name in ("North", "South")}
    assert counts["North"] >= 4
    assert counts["South"] >= 1
    assert "East" in slow.humans.civilisation[:14].tolist()
    assert slow.agents()["civilisation"].tolist() == slow.humans.civilisation.tolist()


def test_more_founders_of_one_leave_the_others_where_they_begin():
    # Places depend on the identity.
    few, many = Peoples(seed=5), Peoples(seed=5, n_north=4)
    assert few.humans.x.tolist() == many.humans.x.tolist()
    none = Peoples(seed=5, n_north=0)
    assert len(none.humans) == 12


def test_it_can_be_set_from_outside_and_nothing_else_than_one_of_them():
    society = Peoples(seed=1, compiled=False)
    society.humans[0].civilisation = "East"
    society.humans.civilisation = ["South"] * 15 + ["East"]
    assert society.humans[15].civilisation == "East"
    with pytest.raises(ValueRefusedError, match="found 'West'; expected one of North, South, East"):
        society.humans[0].civilisation = "West"
    with pytest.raises(ValueRefusedError, match=r"of agent 1 \(row 1\): found 'West'; expected"):
        society.humans.civilisation = ["South", "West"] + ["East"] * 14
    assert society.humans[0].civilisation == "South"


def test_a_checkpoint_with_another_civilisation_is_none():
    society = Peoples(seed=1, compiled=False)
    state = society.state()
    state["humans.rows"]["civilisation"][3] = 3
    with pytest.raises(SocialmindError, match="no civilisation of the model"):
        society.restore(state)


@pytest.mark.parametrize(
    ("make", "found"),
    [
        (lambda: Civilisation("", 3), "'' as the name of a civilisation; expected a text"),
        (lambda: Civilisation("A", -1), "agents=-1 of 'A'; expected a whole number, 0 or more, or"),
        (lambda: Civilisation("A", 1, place=3), r"place=3 of 'A'; expected two numbers, \(x, y\)"),
        (lambda: Civilisation("A", 1, scattered=-1), "scattered=-1 of 'A'; expected a number, 0"),
        (lambda: Civilisation("A", 1, colour="red"), "colour='red' of 'A'; expected one as '#c04"),
        (lambda: Civilisation("A", 1, cognitons=["Greed"]), r"cognitons=\['Greed'\] of 'A'; expe"),
        (lambda: Civilisation("A", 1, cognitons={"Greed": "x"}), "'x' as the cogniton 'Greed' of"),
    ],
)
def test_a_wrong_civilisation_is_refused_where_it_is_written(make, found):
    with pytest.raises(ModelError, match=rf"test_civilisations.py:\d+: found {found}"):
        make()


def people(*civilisations, **settings):
    settings = {"mind": SCHEME, "civilisations": civilisations} | settings
    return type("Wrong", (Model,), {"humans": Population(Human, **settings)})


@pytest.mark.parametrize(
    ("make", "found"),
    [
        (lambda: people(), "neither size nor table nor civilisations of 'humans'; expected one of them"),
        (lambda: people(*PEOPLES[1:], size=3), "a size and civilisations of 'humans'"),
        (lambda: people(PEOPLES[1], PEOPLES[1]), "two civilisations called 'South'"),
        (lambda: people(PEOPLES[1], mind=None), "cognitons of 'South', whose agents have no minds"),
        (
            lambda: people(Civilisation("A", 1, values={"wheet": 1})),
            "the field 'wheet' of 'A'.*d",
        ),
        (lambda: people(Civilisation("A", 1, values={"wheat": "x"})), "a value for the field 'whe"),
        (lambda: people(Civilisation("A", "n")), "the size 'n'"),
        (lambda: people(Civilisation("A", 1, cognitons={"Gred": 1.0}))(), "the cogniton 'Gred' of"),
    ],
)
def test_civilisations_that_do_not_fit_are_refused(make, found):
    with pytest.raises(ModelError, match=f"found {found}|: {found}"):
        make()


def rename(human):
    human.civilisation = "West"


def test_a_rule_that_names_none_of_them_is_refused():
    schedule = (each(Peoples.humans, rename),)
    kind = type("Renaming", (Peoples,), {"schedule": schedule})
    with pytest.raises(ModelError, match=r"test_civilisations.py:\d+: found the text 'West' for"):
        kind(compiled=False)
