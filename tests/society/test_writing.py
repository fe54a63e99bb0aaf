"""What is written into a society from outside its rules, and what its rules write at the border."""

import math

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from socialmind import Agent, Model, Patch, Population, RuleError, SocialmindError, Torus, each
from socialmind.errors import UnknownNameError, ValueRefusedError
from socialmind.society.population import TAKEN_NAMES
from socialmind.society.table import KEPT_BY_TABLES


class Human(Agent):
    wheat: float = 1.0
    age: int = 0
    rank: np.int16 = 0
    awake: bool = True
    land: int | None = None
    fields: list[float] = [0.0] * 3  # the declaration of an array field
    unknown: float = math.nan


class Land(Patch):
    grass: float = 0.0
    owner: int | None = None
    crops: list[int] = [0] * 2


def age(human):
    human.age += 1


class Village(Model):
    n: int = 4
    price: float = 2.0
    debt: float | None = None
    stocks: list[float] = [0.0] * 3
    humans = Population(Human, 4)
    world = Torus(5, Land)
    schedule = (each(humans, age),)

    def __init__(self, *arguments, **settings):
        super().__init__(*arguments, **settings)
        self.notes = []


@pytest.fixture
def village():
    return Village(compiled=False)


# Columns -----------------------------------------------------------------------------------------


def test_assignment_to_a_column_writes_through(village):
    village.humans[1].die()
    village.humans.settle()
    village.humans.wheat = 5
    village.humans.age = [3, 4.0, 5]
    village.humans.land = [None, 7, None]
    village.humans.awake = np.array([True, False, True])
    village.humans.fields = [[1, 2, 3]] * 3
    assert village.humans.wheat.tolist() == [5.0] * 3
    assert [human.age for human in village.humans] == [3, 4, 5]
    assert [human.land for human in village.humans] == [None, 7, None]
    assert village.humans.awake.tolist() == [True, False, True]
    village.humans.fields = [4, 5, 6]  # one row for all
    assert village.humans[3].fields[2] == 6.0
    assert village.series()["humans"] == 3
    assert village.agents()["wheat"].tolist() == [5.0] * 3


def test_augmented_assignment_to_a_column_writes_through(village):
    village.humans.wheat += 1
    village.humans.wheat *= np.arange(4)
    village.humans.age -= 2
    village.world.grass += 0.5
    assert village.humans.wheat.tolist() == [0.0, 2.0, 4.0, 6.0]
    assert village.humans.age.tolist() == [-2] * 4
    assert village.world.grass.sum() == 12.5
    with pytest.raises(ValueRefusedError, match="whole number"):
        village.humans.age += 0.5
    assert village.humans.age.tolist() == [-2] * 4


@pytest.mark.parametrize(
    "write",
    [
        lambda society: society.humans.wheat.__setitem__(slice(None), 0),
        lambda society: society.humans.wheat.__setitem__(society.humans.wheat > 0, 0),
        lambda society: society.humans.wheat[1:].__setitem__(0, 0),
        lambda society: society.humans.wheat.fill(0),
        lambda society: society.humans.wheat.sort(),
        lambda society: society.humans.land.__setitem__(0, 3),
        lambda society: society.humans.id.__setitem__(0, 3),
        lambda society: society.world.grass.__setitem__((0, 0), 3),
    ],
)
def test_a_column_is_a_copy_that_says_what_to_write(village, write):
    with pytest.raises(
        ValueError, match=r"society\.\w+\.\w+ is a copy.* write society\.\w+\.\w+ = "
    ):
        write(village)
    assert village.humans.wheat.tolist() == [1.0] * 4


def test_a_column_does_not_follow_the_society_and_what_comes_of_it_is_free(village):
    wheat = village.humans.wheat
    village.humans.wheat = 9.0
    assert wheat.tolist() == [1.0] * 4
    twice = wheat * 2
    assert type(twice) is np.ndarray
    own = wheat.copy()
    own[0] = 3
    twice[0] = 3
    assert type(wheat.sum()) is np.float64 and repr(wheat) == "array([1., 1., 1., 1.])"
    wheat += 1  # of the modeller's own array
    assert wheat.tolist() == [2.0] * 4 and village.humans.wheat.tolist() == [9.0] * 4


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("wheat", math.nan, "found nan; expected a finite number"),
        ("wheat", [1, 2, math.inf, 4], r"agent 2 \(row 2\): found inf"),
        ("wheat", [1, 2, 3], "found 3 values; expected 4"),
        ("wheat", "rye", "found 'rye'"),
        ("wheat", None, "found None"),
        ("wheat", True, "found True"),
        ("wheat", [True] * 4, "found True"),
        ("wheat", 10**400, "found 1000"),
        ("wheat", [[1, 2], [3]], "rows of several lengths"),
        ("age", 2.5, "found 2.5; expected a whole number"),
        ("age", [0, 1, 2, 2.5], r"agent 3 \(row 3\): found 2.5"),
        ("age", 2**63, "expected a whole number"),
        ("age", np.full(4, 2.0**63), "expected a whole number"),
        ("rank", 40_000, "-32768 … 32767"),
        ("rank", np.full(4, 32_768), "-32768 … 32767"),
        ("awake", 1, "expected True or False"),
        ("awake", [0, 1, 0, 1], "expected True or False"),
        ("land", "north", "or None"),
        ("fields", [1, 2], "expected"),
        ("fields", [[1, 2, math.nan]] * 4, "found nan"),
        ("x", math.inf, "found inf"),
    ],
)
def test_a_column_is_checked_as_a_whole(village, name, value, line):
    before = village.humans.rows.copy()
    with pytest.raises(ValueRefusedError, match=line):
        setattr(village.humans, name, value)
    for one in before.dtype.names:
        assert village.humans.rows[one].tobytes() == before[one].tobytes()


def test_a_field_whose_default_is_not_finite_takes_such_numbers(village):
    village.humans.unknown = math.inf
    village.humans[0].unknown = math.nan
    assert math.isnan(village.humans.unknown[0]) and village.humans.unknown[1] == math.inf


def test_several_fields_are_set_or_none(village):
    with pytest.raises(ValueRefusedError, match="age"):
        village.humans.set(wheat=3.0, age=2.5)
    assert village.humans.wheat.tolist() == [1.0] * 4
    village.humans.set(wheat=np.arange(4), age=2)
    assert village.humans.wheat.tolist() == [0.0, 1.0, 2.0, 3.0] and village.humans.age[0] == 2


# Data --------------------------------------------------------------------------------------------


DATA = {"agent": [2, 0], "wheat": [20.0, 0.5], "land": [math.nan, 7.0]}


@pytest.mark.parametrize("made", [dict, pd.DataFrame, pa.table])
def test_fields_are_set_from_data_by_identity(village, made):
    village.humans.land = 1
    village.humans.set_from(made(DATA))
    assert village.humans.wheat.tolist() == [0.5, 1.0, 20.0, 1.0]
    assert [human.land for human in village.humans] == [7, 1, None, 1]


def test_data_without_identities_are_for_all_in_order_of_birth(village):
    village.humans.set_from(
        pd.DataFrame({"wheat": [1, 2, 3, 4], "land": pd.array([1, None, 3, 4])})
    )
    assert village.humans.wheat.tolist() == [1.0, 2.0, 3.0, 4.0]
    assert village.humans[1].land is None and village.humans[3].land == 4
    village.humans.set_from({"who": [3], "wheat": [0]}, by="who")
    assert village.humans[3].wheat == 0.0


@pytest.mark.parametrize(
    ("data", "line"),
    [
        ({"agent": [0, 9], "wheat": [1, 2]}, "row 1: found 9 as agent.* living agent, 0 … 3"),
        ({"agent": [0, 0], "wheat": [1, 2]}, "row 1: agent 0 again, as in row 0"),
        ({"agent": [0, 1.5], "wheat": [1, 2]}, "row 1: found 1.5"),
        ({"agent": [0, 1], "wheat": [1, math.nan]}, r"agent 1 \(row 1\): found nan"),
        ({"agent": [0, 1], "whaet": [1, 2]}, "'whaet'; did you mean 'wheat'"),
        ({"wheat": [1, 2]}, "found 2 values; expected 4"),
        ({"wheat": [1, 2], "age": [1]}, "columns of several lengths: wheat 2, age 1"),
        ([1, 2], "expected a data frame"),
    ],
)
def test_data_that_do_not_fit_are_refused_with_their_row(village, data, line):
    with pytest.raises(SocialmindError, match=line):
        village.humans.set_from(data)
    assert village.humans.wheat.tolist() == [1.0] * 4


# Names -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("write", "line"),
    [
        (lambda s: setattr(s.humans, "weat", 3), "'weat'; did you mean 'wheat'"),
        (lambda s: setattr(s.humans[0], "weat", 3), "'weat'; did you mean 'wheat'"),
        (lambda s: s.humans[0].weat, "'weat'; did you mean 'wheat'"),
        (lambda s: s.humans.weat, "'weat'; did you mean 'wheat'"),
        (lambda s: setattr(s, "prize", 3), "'prize'; did you mean 'price'"),
        (lambda s: setattr(s.world, "gras", 3), "'gras'; did you mean 'grass'"),
        (lambda s: setattr(s.world.patch(0, 0), "gras", 3), "'gras'; did you mean 'grass'"),
        (lambda s: setattr(s.world.patch(0, 0), "x", 3), "'x' of 'patch' cannot be set"),
        (lambda s: setattr(s.humans, "id", 3), "'id' of 'humans' cannot be set"),
        (lambda s: setattr(s.humans[0], "id", 3), "'id' of 'humans' cannot be set"),
        (lambda s: setattr(s, "humans", 3), r"society\.humans\.FIELD = "),
        (lambda s: setattr(s, "world", 3), r"society\.world\.FIELD = "),
        (lambda s: setattr(s, "seed", 3), "'seed' of village stays"),
        (lambda s: setattr(s, "advance", 3), "which is a method"),
    ],
)
def test_names_that_there_are_not_are_refused(village, write, line):
    with pytest.raises(UnknownNameError, match=line):
        write(village)
    with pytest.raises(AttributeError):
        write(village)


def test_a_modeller_keeps_attributes_of_their_own(village):
    village.notes = ["rain"]  # made in __init__
    village._cache = 3  # theirs, by its name
    village.ticks = 20  # declared by the class
    assert village.notes == ["rain"] and village._cache == 3 and village.ticks == 20
    with pytest.raises(SocialmindError, match=r"ticks: found 2\.5"):
        village.ticks = 2.5


def test_what_a_table_keeps_is_taken():
    assert KEPT_BY_TABLES <= TAKEN_NAMES


# Agents, patches, variables ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("wheat", math.nan),
        ("wheat", "rye"),
        ("wheat", True),
        ("age", 2.5),
        ("age", False),
        ("rank", 2**15),
        ("awake", 1),
        ("awake", None),
        ("fields", [1, 2]),
        ("heading", math.inf),
    ],
)
def test_an_agents_field_is_checked(village, name, value):
    with pytest.raises(ValueRefusedError, match=rf"the field '{name}' of agent 2"):
        setattr(village.humans[2], name, value)


def test_an_agents_field_takes_numpys_numbers(village):
    human = village.humans[2]
    human.wheat, human.age, human.awake = np.float32(0.5), np.int8(3), np.False_
    human.fields = (1, 2, 3)
    human.fields[1] = 9
    human.fields[0:1] = [5]
    assert (human.wheat, human.age, human.awake) == (0.5, 3, False)
    assert list(human.fields) == [5.0, 9.0, 3.0] and human.fields[:2] == [5.0, 9.0]
    with pytest.raises(ValueRefusedError, match="fields"):
        human.fields[0] = math.nan


def test_patches_are_checked(village):
    patch = village.world.patch(1, -2)
    patch.grass, patch.owner, patch.crops = 3, 4, [1, 2]
    assert village.world.grass[1 - village.world.low, -2 - village.world.low] == 3.0
    with pytest.raises(ValueRefusedError, match="'grass' of the patch 1 -2: found nan"):
        patch.grass = math.nan
    with pytest.raises(ValueRefusedError, match="found the shape"):
        village.world.grass = [1.0] * 25
    with pytest.raises(ValueRefusedError, match=r"'grass' of the world of <patch -2 -1>"):
        village.world.grass = [[0, math.nan, 0, 0, 0]] + [[0] * 5] * 4
    village.world.set(grass=np.arange(25).reshape(5, 5), owner=None)
    assert village.world.patch(-2, -1).grass == 1.0
    assert village.world.owner[3, 3] is None


def test_variables_are_checked_and_parameters_refused(village):
    village.price, village.debt, village.stocks = np.int64(3), 4.5, [1, 2, 3]
    assert (village.price, village.debt, list(village.stocks)) == (3.0, 4.5, [1.0, 2.0, 3.0])
    village.debt = None
    assert village.debt is None
    wrong = [("price", math.nan), ("price", "dear"), ("debt", True), ("stocks", [1]), ("n", 1.5)]
    for name, value in wrong:
        with pytest.raises(ValueRefusedError, match=f"the variable '{name}' of village"):
            setattr(village, name, value)


# The dead ----------------------------------------------------------------------------------------


def bear_or_die(human, model):
    if model.tick == 0 and human.id == 0:
        human.die()
    if model.tick == 1:
        human.hatch()


class Mortal(Model):
    humans = Population(Human, 2)
    schedule = (each(humans, bear_or_die),)


def test_an_agent_that_died_is_nobody_else():
    society = Mortal(compiled=False)
    human, kept = society.humans[0], society.humans[1]
    society.advance(1)
    with pytest.raises(UnknownNameError, match="agent 0 of 'humans' is dead"):
        human.wheat = 3.0
    society.advance(1)
    assert society.humans[2].wheat == 1.0  # in the slot of the dead
    with pytest.raises(UnknownNameError, match="agent 0 of 'humans' is dead"):
        print(human.wheat)
    assert human.id == 0 and human != society.humans[2] and kept == society.humans[1]
    assert repr(human) == "<humans 0: dead>"


# The border --------------------------------------------------------------------------------------


class Walker(Agent):
    x: float = 4.0
    step: float = 0.0
    here: bool = False


def go(walker, model):
    walker.x += walker.step
    walker.y -= walker.step
    walker.heading -= 100.0
    walker.here = model.world.is_on(walker, walker.x, walker.y)
    if walker.id == 2:
        walker.heading = -1e-20
        other = model.walkers[0]
        other.y = other.y + 5.0
    model.world.patch(walker.x, walker.y).grass += 1.0


def go_nowhere(walker):
    walker.x = walker.x + 1e300


class Walkers(Model):
    walkers = Population(Walker, 3)
    world = Torus(5, Land)
    schedule = (each(walkers, go),)


def test_places_and_headings_are_kept_within_at_both_speeds():
    found = []
    for compiled in (True, False):
        society = Walkers(compiled=compiled)
        society.walkers.step = [1.0, 0.25, 7.5]
        society.advance(3)
        walkers = society.walkers
        assert all(-2.5 <= x < 2.5 for x in [*walkers.x, *walkers.y])
        assert all(0 <= heading < 360 for heading in walkers.heading)
        assert walkers.here.all()
        assert walkers.heading.tolist() == [60.0, 60.0, 0.0]
        assert walkers.x.tolist() == [2.0, -0.25, 1.5]
        found.append((walkers.x.tobytes(), walkers.y.tobytes(), society.world.grass.tobytes()))
    assert found[0] == found[1]


def test_places_and_headings_are_kept_within_from_outside():
    society = Walkers(compiled=False)
    assert society.walkers.x.tolist() == [-1.0] * 3  # the default
    walker = society.walkers[0]
    walker.x, walker.y, walker.heading = 3, -2.75, 360.0
    assert (walker.x, walker.y, walker.heading) == (-2.0, 2.25, 0.0)
    society.walkers.set(x=[2.5, 0.0, 1000], heading=-90)
    assert society.walkers.x.tolist() == [-2.5, 0.0, 0.0]
    assert society.walkers.heading.tolist() == [270.0] * 3
    society.walkers.heading += 1000
    assert society.walkers.heading.tolist() == [190.0] * 3
    society.walkers.set_from({"id": [1], "y": [12.25]})
    assert society.walkers[1].y == 2.25
    assert society.walkers.create().x == -1.0


def test_a_place_that_is_nowhere_is_refused():
    for compiled in (False, True):
        kind = type("Lost", (Walkers,), {"schedule": (each(Walkers.walkers, go_nowhere),)})
        with pytest.raises(
            RuleError, match=r"test_writing\.py:\d+: ValueError: a point that is nowhere"
        ):
            kind(compiled=compiled).advance(1)
