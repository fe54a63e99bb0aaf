"""Steps over fields of patches: by hand, against brute force, conserving, at both speeds alike."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind import Agent, Grid, Model, Patch, Population, Torus, each, once, parameter
from socialmind.errors import ModelError, RuleError, SocialmindError
from socialmind.worlds.grid.extent import of_grid, values_of
from socialmind.worlds.grid.fields import diffused
from socialmind.worlds.grid.patches import PatchWorld


def neighbours(x, y, width, height, wraps_x, wraps_y, count):
    """The patches beside one, each once and without itself."""
    found = set()
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            if (dx, dy) == (0, 0) or (count == 4 and dx and dy):
                continue
            i, j = x + dx, y + dy
            i, j = (i % width if wraps_x else i), (j % height if wraps_y else j)
            if 0 <= i < width and 0 <= j < height and (i, j) != (x, y):
                found.add((i, j))
    return found


def by_hand(values, share, count, wraps_x, wraps_y):
    """NetLogo's words: each neighbour gets an equal part of the share; what is left over stays."""
    after = values.copy()
    width, height = values.shape
    for x in range(width):
        for y in range(height):
            for place in neighbours(x, y, width, height, wraps_x, wraps_y, count):
                after[place] += values[x, y] * share / count
                after[x, y] -= values[x, y] * share / count
    return after


sides = st.integers(1, 7)


@given(sides, sides, st.floats(0, 1), st.sampled_from([4, 8]), st.booleans(), st.booleans(),
       st.integers(0, 2**32))  # fmt: skip
def test_diffusing_is_giving_to_each_neighbour(width, height, share, count, wraps_x, wraps_y, seed):
    values = np.random.default_rng(seed).random((width, height)) * 100
    found = diffused(values, share, count, wraps_x, wraps_y)
    np.testing.assert_allclose(found, by_hand(values, share, count, wraps_x, wraps_y), rtol=1e-12)
    assert math.fsum(found.flat) == pytest.approx(math.fsum(values.flat), rel=1e-14)


def test_netlogos_answers_at_borders():
    values = np.zeros((5, 5))
    values[0, 0] = 80.0  # in a corner three neighbours get an eighth each, the rest stays
    found = diffused(values, 1.0, 8, False, False)
    assert found[0, 0] == 50.0 and found[0, 1] == found[1, 0] == found[1, 1] == 10.0
    assert found.sum() == 80.0
    found = diffused(values, 0.5, 4, False, False)
    assert (found[0, 0], found[1, 0], found[0, 1], found[1, 1]) == (60.0, 10.0, 10.0, 0.0)
    found = diffused(values, 1.0, 8, True, True)
    assert found[0, 0] == 0.0 and (found == 10.0).sum() == 8 and found[4, 4] == 10.0
    found = diffused(values, 1.0, 8, True, False)
    assert found[0, 0] == 30.0 and found[4, 0] == found[4, 1] == 10.0 and found[0, 4] == 0.0


class Ant(Agent):
    load: float = 0.0
    trips: int = 0
    tired: bool = False
    sight: np.int16 = 3


class Land(Patch):
    scent: float = 0.0
    visits: np.int16 = 0
    food: float = 1.0


def walk(ant, model, rng):
    model.world.move_to(
        ant,
        rng.integers(model.world.low_x, model.world.high_x + 1),
        rng.integers(model.world.low_y, model.world.high_y + 1),
    )
    here = model.world.patch(ant.x, ant.y)
    here.scent += rng.uniform(0, 10)
    here.visits += 1
    ant.trips += here.visits
    ant.load += here.scent
    ant.tired = rng.random() < 0.3
    if ant.tired and ant.trips > 9:
        ant.die()
    elif rng.random() < 0.2:
        ant.hatch()


def spread(model):
    model.world.diffuse("scent", model.share)
    model.world.diffuse4("food", 0.25)
    model.world.evaporate("scent", 0.1)
    model.found_0 = model.world.sum("scent")
    model.found_1 = model.world.mean("visits")
    model.found_2 = model.world.min("food") + model.world.max("food")
    model.visits = model.world.sum("visits") + model.world.max("visits")
    model.tired = model.ants.sum("tired") + model.ants.sum("sight")
    if len(model.ants) > 0:
        model.found_3 = model.ants.mean("load") + model.ants.mean("tired")
        model.trips = model.ants.max("trips") - model.ants.min("trips")


class Hill(Model):
    width: int = parameter(7, low=1)
    height: int = parameter(5, low=1)
    share: float = parameter(0.4)
    found_0: float = 0.0
    found_1: float = 0.0
    found_2: float = 0.0
    found_3: float = 0.0
    visits: int = 0
    tired: int = 0
    trips: int = 0
    world = Grid("width", "height", wraps=False, patch=Land)
    ants = Population(Ant, 12)
    schedule = (each(ants, walk), once(spread))


class OnTube(Hill):
    world = Grid("width", "height", wraps="y", patch=Land)


class OnTorus(Hill):
    world = Torus("width", patch=Land)


@pytest.mark.parametrize("kind", [Hill, OnTube, OnTorus])
def test_both_speeds_agree_to_the_last_bit(kind):
    for seed, (width, height) in enumerate([(7, 5), (1, 4), (2, 3), (3, 1), (1, 1), (12, 2)]):
        fast = kind(seed=seed, width=width, height=height)
        slow = kind(seed=seed, width=width, height=height, compiled=False)
        for society in (fast, slow):
            society.advance(15)
        other = slow.state()
        for name, array in fast.state().items():
            np.testing.assert_array_equal(array, other[name], err_msg=name)
    assert fast.visits > 0 and fast.found_0 > 0


def test_what_is_summed_up_by_hand():
    society = Hill(seed=1, compiled=False)
    society.world.scent = np.arange(35.0).reshape(7, 5)
    assert society.world.sum("scent") == 595.0
    assert (society.world.min("scent"), society.world.max("scent")) == (0.0, 34.0)
    assert society.world.mean("scent") == 17.0
    society.ants.load = np.arange(12.0)
    society.ants.tired = [True, *[False] * 11]
    assert (society.ants.sum("load"), society.ants.mean("load")) == (66.0, 5.5)
    assert (society.ants.sum("tired"), society.ants.max("sight")) == (1, 3)
    society.world.evaporate("scent", 0.5)
    assert society.world.sum("scent") == 297.5
    society.world.diffuse("scent", 1)
    assert society.world.sum("scent") == pytest.approx(297.5, rel=1e-14)
    society.world.diffuse4("scent", 0.3)


def test_conserving_over_many_ticks():
    values = np.random.default_rng(1).random((20, 30))
    for wraps in (True, False, "x"):
        world = PatchWorld(Hill.shape.world.patch, values_of(of_grid(wraps), 20, 30, None))
        world.scent = values
        for _ in range(300):
            world.diffuse("scent", 0.7)
        assert world.sum("scent") == pytest.approx(values.sum(), rel=1e-11)


def test_models_without_these_steps_keep_their_record():
    class Plain(Hill):
        schedule = (each(Hill.ants, walk),)

    names = Plain().contexts.dtype.names
    assert not [name for name in names if "scratch" in name]
    assert "_world_scratch" in Hill().contexts.dtype.names


def other_field(model):
    model.world.diffuse("visits", 0.1)


def misspelt(model):
    model.world.evaporate("scnt", 0.1)


def no_text(model):
    model.world.sum(model.share)


def one_argument(model):
    model.world.diffuse("scent")


def of_agents(model):
    model.found_0 = model.ants.sum("lod")


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        (other_field, "'visits' as a field of the patches; expected .* of the type float"),
        (misspelt, "'scnt' as a field of the patches; .*did you mean 'scent'"),
        (no_text, "a number as the name of a field; write the field's name as a text"),
        (one_argument, r"world.diffuse\(\) like this; write model.world.diffuse\(\"field\", share"),
        (of_agents, "'lod' as a field of agents of 'ants'; .*did you mean 'load'"),
    ],
)
def test_wrong_fields_are_refused_before_the_run(rule, expected):
    kind = type("Wrong", (Hill,), {"schedule": (once(rule),)})
    with pytest.raises(ModelError, match=expected):
        kind()


def too_much(model):
    model.world.diffuse("scent", model.share + 1)


def of_nobody(model):
    for ant in model.ants:
        ant.die()
    model.found_0 = model.ants.mean("load")


@pytest.mark.parametrize("compiled", [True, False])
def test_what_cannot_be_is_an_error(compiled):
    for rule, expected in ((too_much, "share beyond 0 … 1"), (of_nobody, "without agents")):
        kind = type("Wrong", (Hill,), {"schedule": (once(rule),)})
        with pytest.raises(RuleError, match=expected):
            kind(compiled=compiled).advance(1)
    society = Hill(compiled=compiled)
    for wrong in (lambda: society.world.diffuse("scnt", 0.1), lambda: society.ants.sum("lod")):
        with pytest.raises(SocialmindError, match="did you mean"):
            wrong()
    with pytest.raises(ValueError, match="share"):
        society.world.evaporate("scent", 1.5)
