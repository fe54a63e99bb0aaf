"""Fields: what an annotated class declares, and what is refused."""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

from socialmind import Agent, Model, ModelError, Patch, Population, Torus, each
from socialmind.fields import class_fields, place_of_field


class Human(Agent):
    wheat: float = 3
    age: int = 20
    well: bool = True
    land: int | None = None
    debt: float | None = 2.5
    grudge: bool | None
    seen: list[int] = [0, 1, 2]  # noqa: RUF012  # every agent has its own
    hopes: list[float] = [0.5] * 4
    small: np.int16 = 7
    plain: float


def test_fields_of_a_class_and_its_bases_in_order():
    fields = class_fields(Human)
    assert list(fields)[:3] == ["x", "y", "heading"]
    assert [
        (one.name, one.kind, one.storage, one.default, one.size, one.optional)
        for one in list(fields.values())[3:]
    ] == [
        ("wheat", float, "f8", 3.0, None, False),
        ("age", int, "i8", 20, None, False),
        ("well", bool, "?", True, None, False),
        ("land", int, "i8", None, None, True),
        ("debt", float, "f8", 2.5, None, True),
        ("grudge", bool, "?", None, None, True),
        ("seen", int, "i8", (0, 1, 2), 3, False),
        ("hopes", float, "f8", (0.5, 0.5, 0.5, 0.5), 4, False),
        ("small", int, "i2", 7, None, False),
        ("plain", float, "f8", 0.0, None, False),
    ]
    assert fields["small"].limits == (-32768, 32767)
    assert fields["age"].limits is None
    assert fields["land"].dtype == [("land", "i8"), ("_has_land", "?")]
    assert fields["seen"].dtype == [("seen", "i8", (3,))]


def stay(human):
    human.age += 1


class Town(Model):
    mood: float | None = None
    counts: list[int] = [0] * 3
    year: int = 1900
    humans = Population(Human, 2)
    schedule = (each(humans, stay),)


@pytest.mark.parametrize("compiled", [True, False])
def test_agents_begin_with_their_defaults(compiled):
    town = Town(compiled=compiled)
    town.advance(3)
    for human in town.humans:
        assert (human.wheat, human.age, human.well) == (3.0, 23, True)
        assert (human.land, human.debt, human.grudge) == (None, 2.5, None)
        assert (list(human.seen), list(human.hopes), human.small) == ([0, 1, 2], [0.5] * 4, 7)
    assert list(town.humans.land) == [None, None]
    assert town.humans.seen.shape == (2, 3)


def test_fields_are_read_and_written_as_plain_values():
    town = Town(compiled=False)
    human, other = town.humans
    human.land, human.wheat, human.well = 4, 2, False
    human.seen[1] = 9
    assert (human.land, human.well) == (4, False)
    assert type(human.wheat) is float
    assert type(human.land) is int
    assert list(human.seen) == [0, 9, 2]
    assert (other.land, list(other.seen)) == (None, [0, 1, 2])
    assert list(town.humans.land) == [4, None]
    assert town.humans.filled("land", -1).tolist() == [4, -1]
    assert town.humans.holds("land").tolist() == [True, False]
    human.land = None
    assert human.land is None


def test_variables_of_a_model():
    town, other = Town(compiled=False), Town(compiled=False)
    assert (town.mood, list(town.counts), town.year) == (None, [0, 0, 0], 1900)
    town.mood, town.year = 0.5, 1901
    town.counts[2] = 8
    assert (town.mood, list(town.counts), town.year) == (0.5, [0, 0, 8], 1901)
    assert (other.mood, list(other.counts), other.year) == (None, [0, 0, 0], 1900)
    town.mood = None
    assert town.mood is None


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("name: str = ''", "found str as the type of 'name'; expected float, int, bool"),
        ("friends: dict = {}", "found dict as the type of 'friends'"),
        ("wheat: float = None", "found None as the default of 'wheat'; .*write float | None"),
        (
            "wheat: float = 'much'",
            "found 'much' as the default of 'wheat'; expected a value of float",
        ),
        ("age: int = 1.5", "found 1.5 as the default of 'age'; expected a value of int"),
        ("age: int = True", "found True as the default of 'age'"),
        ("well: bool = 1", "found 1 as the default of 'well'; expected a value of bool"),
        ("land: int | float = 1", "as the type of 'land'"),
        ("seen: list[int] = []", "found the array 'seen' without its elements"),
        ("seen: list[int]", "found the array 'seen' without its elements"),
        ("seen: list[str] = ['a']", "expected list.float., list.int. or list.bool."),
        ("seen: list = [1]", "found list as the type of 'seen'"),
        ("seen: list[int] = [0, 1.5]", "found 1.5 as the default of 'seen'"),
        ("small: np.int8 = 300", "found 300 as the default of 'small'; expected -128 … 127"),
        ("small: np.uint8 = 1", "as the type of 'small'"),
        ("_hidden: int = 1", "found the field name '_hidden'"),
    ],
)
@pytest.mark.parametrize("base", ["Agent", "Patch"])
def test_what_is_no_field_is_refused_with_file_and_line(tmp_path, base, line, message):
    file = tmp_path / "declared.py"
    file.write_text(
        "import numpy as np\nfrom socialmind import Agent, Patch\n\n\n"
        f'class Declared({base}):\n    """A class."""\n\n    first: int = 1\n    {line}\n'
    )
    declared = load(file).Declared
    with pytest.raises(ModelError, match=message) as error:
        class_fields(declared)
    assert (error.value.file, error.value.line) == (str(file), 9)


def load(file):
    spec = importlib.util.spec_from_file_location(f"fields_of_{file.parent.name}", file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def test_the_place_of_a_field():
    file, line = place_of_field(Human, "debt")
    assert file == __file__
    assert (
        Path(__file__).read_text("utf-8").splitlines()[line - 1] == "    debt: float | None = 2.5"
    )
    assert place_of_field(Human, "unknown") == (None, None)


AGENT_NAMES = ["id", "mind", "plan", "run_plan", "die", "hatch", "rows", "alive", "order", "free"]
AGENT_NAMES += ["slots", "grow", "cogniton", "contains", "create", "restore", "one_of", "model"]


@pytest.mark.parametrize("name", AGENT_NAMES)
def test_names_of_agents_and_populations_are_no_fields(name):
    agent = type("Taken", (Agent,), {"__annotations__": {name: float}})
    with pytest.raises(ModelError, match=f"found a field called '{name}'"):
        type("Society", (Model,), {"agents_": Population(agent, 1)})


@pytest.mark.parametrize("name", ["x", "y", "size", "low", "high", "patch", "patches", "distance"])
def test_names_of_patches_and_the_world_are_no_fields(name):
    patch = type("Taken", (Patch,), {"__annotations__": {name: float}})
    with pytest.raises(ModelError, match=f"found a field called '{name}'"):
        type("Society", (Model,), {"world": Torus(3, patch)})


def test_every_name_of_a_table_and_of_a_grid_is_taken():
    class Society(Model):
        world = Torus(3)
        people = Population(Agent, 1)

    society = Society(compiled=False)
    for name in (*vars(society.people), *dir(society.people)):
        if name.startswith("_"):
            continue
        agent = type("Taken", (Agent,), {"__annotations__": {name: float}})
        with pytest.raises(ModelError, match="found a field called"):
            type("Other", (Model,), {"people": Population(agent, 1)})
    for name in (*vars(society.world), *dir(society.world)):
        if name.startswith("_"):
            continue
        patch = type("Taken", (Patch,), {"__annotations__": {name: float}})
        with pytest.raises(ModelError, match="found a field called"):
            type("Other", (Model,), {"world": Torus(3, patch)})


def test_places_and_headings_stay_floats():
    class Rook(Agent):
        x: int = 3

    with pytest.raises(ModelError, match="found a field called 'x'; expected a float") as error:

        class Chess(Model):
            rooks = Population(Rook, 1)

    assert error.value.file == __file__

    class Settler(Agent):
        x: float = 2.5

    class Colony(Model):
        settlers = Population(Settler, 1)

    assert Colony(compiled=False).settlers[0].x == 2.5
