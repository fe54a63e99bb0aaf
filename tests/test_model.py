"""Models: what a class may declare, and how what is wrong with it is said."""

import re
from pathlib import Path
from typing import ClassVar

import pytest

from socialmind import (
    Agent,
    Model,
    ModelError,
    Patch,
    Population,
    SocialmindError,
    Torus,
    each,
    once,
    parameter,
)


class Cow(Agent):
    energy: float = 5.0


def graze(cow, model, rng):
    cow.energy += rng.random() * model.grass


def dawn(model):
    model.days += 1


class Meadow(Model):
    """A meadow that uses every kind of part."""

    ticks = 12
    note: ClassVar[str] = "neither a variable nor a parameter"
    grass: float = parameter(2.0, unit="energy", low=0.0)
    n_cows: int = parameter(4, low=0)
    days: int = 0
    world = Torus(5)
    cows = Population(Cow, "n_cows")
    schedule = (once(dawn), each(cows, graze))

    def series(self):
        return {"days": self.days, "energy": float(self.cows.energy.sum())}

    @property
    def hungry(self):
        return int((self.cows.energy < 6).sum())


def made(parts, name="Wrong"):
    """Make a model's class out of attributes and annotations."""
    annotations = parts.pop("annotations", {})
    return type(name, (Model,), {"__annotations__": annotations, "__module__": __name__, **parts})


# Parts -------------------------------------------------------------------------------------------


def test_the_parts_of_a_class():
    assert Meadow.name == "meadow"
    assert list(Meadow.parameters) == ["grass", "n_cows"]
    assert list(Meadow.variables) == ["days"]
    assert list(Meadow.populations) == ["cows"]
    assert isinstance(Meadow.world, Torus)
    assert [str(phase) for phase in Meadow.schedule] == [
        "once: dawn",
        "each of cows, random order: graze",
    ]
    assert Meadow.folder().name == "tests"


def test_a_society_has_its_parts():
    meadow = Meadow(seed=3, compiled=False, n_cows=2)
    meadow.advance(3)
    assert (meadow.tick, meadow.days, len(meadow.cows), meadow.world.size) == (3, 3, 2, 5)
    assert meadow.series()["energy"] == meadow.cows.energy.sum() > 10
    assert meadow.hungry in (0, 1, 2)
    assert meadow.fresh().tick == 0


def test_parts_are_inherited():
    class Pasture(Meadow):
        """A meadow with another price and a dog."""

        barks: int = 0
        dogs = Population(Agent, 1)

    assert list(Pasture.parameters) == ["grass", "n_cows"]
    assert list(Pasture.variables) == ["days", "barks"]
    assert list(Pasture.populations) == ["cows", "dogs"]
    pasture = Pasture(3, compiled=False)
    pasture.advance(2)
    assert (pasture.name, pasture.days, pasture.barks) == ("pasture", 2, 0)
    assert list(Meadow.variables) == ["days"]


def test_without_series_and_agents_a_model_tells_of_sizes_variables_and_fields():
    class Plain(Model):
        days: int = 7
        counts: list[int] = [0, 0]  # noqa: RUF012  # every society has its own
        cows = Population(Cow, 2)

    plain = Plain(compiled=False)
    assert plain.series() == {"cows": 2, "days": 7}
    table = plain.agents()
    assert list(table) == ["agent", "x", "y", "energy"]
    assert list(table["energy"]) == [5.0, 5.0]


def test_methods_may_be_overridden():
    class Told(Meadow):
        def agents(self):
            return {"agent": self.cows.id}

        def step(self):
            self.advance(2)

    told = Told(compiled=False)
    told.step()
    assert told.tick == 2
    assert list(told.agents()) == ["agent"]


# What is refused ---------------------------------------------------------------------------------


@pytest.mark.parametrize("value", [{"GrowWheat": graze}, 3, None, "text", [1]])
@pytest.mark.parametrize("name", ["plans", "series", "agents", "advance", "state", "mesa", "tick"])
def test_an_attribute_that_hides_what_models_have_is_refused(name, value):
    with pytest.raises(ModelError, match=f"class attribute '{name}', which hides") as error:
        made({name: value})
    assert "call it something else" in str(error.value)


def test_the_error_of_a_hidden_method_names_the_line():
    with pytest.raises(ModelError, match="'plans', which hides a method that every model") as error:

        class Hiding(Model):
            days: int = 0
            plans = {"GrowWheat": graze}  # noqa: RUF012

    assert error.value.file == __file__
    assert line_of("plans = {" + '"GrowWheat"') == error.value.line


def line_of(text):
    """Return the first line of this file that contains a text, counted from 1."""
    lines = Path(__file__).read_text("utf-8").splitlines()
    return next(n for n, line in enumerate(lines, 1) if line.strip().startswith(text))


def test_every_name_of_a_society_is_taken():
    society = Meadow(compiled=False)
    society.advance(1)
    own = [name for name in vars(society) if not name.startswith("_")]
    methods = [name for name in dir(Model) if not name.startswith("_")]
    assert {"seed", "tables", "schemes"} <= set(own)
    settings = {"ticks", "setup", "schedule", "name", "buttons", "rewards", "interruptions",
                "measures", "score_every", "record_links", "record_events"}  # fmt: skip
    for name in {*own, *methods, "scheme", "shape", "world"} - settings:
        with pytest.raises(
            ModelError, match=f"found a variable called '{name}'|{name!r}, which hides"
        ):
            made({name: 0.0, "annotations": {name: float}})
        with pytest.raises(ModelError, match=f"found a part of the model called '{name}'"):
            made({name: parameter(1.0)})
        with pytest.raises(ModelError, match=f"found a part of the model called '{name}'"):
            made({name: Population(Agent, 1)})
    for name in {*own, "scheme", "parameters", "populations"}:
        with pytest.raises(ModelError, match=f"class attribute '{name}', which hides"):
            made({name: graze})


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"schedule": (graze,)}, "in schedule; expected each.population, rule. or once.rule."),
        ({"setup": ("dawn",)}, "found 'dawn' in setup"),
        ({"schedule": 3}, "found schedule = 3; expected a tuple"),
        ({"schedule": once(dawn)}, "found schedule = once: dawn; .*with a comma"),
        ({"ticks": -1}, "found ticks = -1; expected a whole number, 0 or more"),
        ({"ticks": 2.5}, "found ticks = 2.5"),
        ({"ticks": True}, "found ticks = True"),
        ({"name": 3}, "found name = 3; expected a text"),
        (
            {"schedule": (each(Population(Agent, 1), graze),)},
            "does not have; expected once.rule.: it has none",
        ),
        (
            {"cows": Population(Cow, 2), "schedule": (each(Meadow.cows, graze),)},
            "expected one of cows",
        ),
        ({"cows": Population(int, 3)}, "the agents of 'cows'; expected a class that inherits"),
        ({"cows": Population(Patch, 3)}, "the agents of 'cows'"),
        ({"cows": Population("Cow", 3)}, "found 'Cow' as the agents of 'cows'"),
        ({"cows": Population(Cow, 3, plans={"eat": graze})}, "plans for 'cows', which has no mind"),
        ({"cows": Population(Cow, 3, mind={})}, "as the mind of 'cows'; expected a file's name"),
        ({"cows": Population(Cow, -1)}, "found the size -1; expected a whole number, 0 or more"),
        ({"cows": Population(Cow, 2.0)}, "found the size 2.0"),
        (
            {"cows": Population(Cow, "n_cows")},
            "found the size 'n_cows'; expected a number or the name",
        ),
        ({"world": Torus(0)}, "found the size 0; expected a whole number, 1 or more"),
        ({"world": Torus(3, Cow)}, "as the patches of the world; expected a class that inherits"),
        ({"land": Torus(3)}, "found a torus called 'land'; expected world"),
        ({"world": 3}, "class attribute 'world', which hides something"),
        (
            {"_cows": Population(Cow, 3)},
            "called '_cows'; expected a name without a leading underscore",
        ),
        ({"mood": "x", "annotations": {"mood": str}}, "found str as the type of 'mood'"),
    ],
)
def test_wrong_declarations_are_refused(parts, message):
    with pytest.raises(ModelError, match=message):
        made(dict(parts))


def test_each_wants_a_population():
    with pytest.raises(ModelError, match=re.escape("each('cows', …); expected a population")):
        each("cows", graze)


def test_a_size_named_by_a_parameter_of_another_kind_is_refused():
    with pytest.raises(ModelError, match=r"found the size 'share'; expected .*; .*n_cows"):
        made({"share": parameter(0.5), "n_cows": parameter(1), "cows": Population(Cow, "share")})


def test_a_size_under_zero_is_refused_when_the_society_is_made():
    herd = made({"n_cows": parameter(4), "cows": Population(Cow, "n_cows")})
    with pytest.raises(SocialmindError, match="parameter n_cows: found -2; expected 0 or more"):
        herd(compiled=False, n_cows=-2)
    assert len(herd(compiled=False, n_cows=0).cows) == 0


@pytest.mark.parametrize("seed", [-1, 2**64, 1.0, True, None, "3"])
def test_a_wrong_seed_is_refused(seed):
    with pytest.raises(SocialmindError, match="seed: found"):
        Meadow(seed, compiled=False)


def test_a_scheme_for_a_model_without_minds_is_refused():
    with pytest.raises(SocialmindError, match="which has 0 populations with minds"):
        Meadow(compiled=False, scheme="some.yaml")


def test_a_state_of_another_model_is_refused():
    class Other(Meadow):
        """A meadow with one variable more."""

        extra: int = 0

    with pytest.raises(SocialmindError, match="not one of meadow"):
        Meadow(compiled=False).restore(Other(compiled=False).state())
