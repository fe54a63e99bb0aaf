"""Societies of a class share what they are made of, and nothing that would change what they do."""

import gc
import linecache
import textwrap
import weakref
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter
from socialmind.catalogue import load_model
from socialmind.errors import RuleError

SCHEME = """
name: walkers
plans: [Walk, Rest]
cognitons:
  Will: {start: WEIGHT, influence: {Walk: 1.0}, conditional: [Walk, Rest]}
  Ease: {start: 2, influence: {Rest: 1.0}}
"""


class Land(Patch):
    trodden: int = 0


class Walker(Agent):
    far: float = 0.0
    seen: list[bool] = [False, False]  # noqa: RUF012
    nest: int | None = None


def place(walker, model, rng):
    walker.x = rng.uniform(-3.0, 3.0)
    walker.nest = rng.integers(0, 9)
    model.drawn += 1
    if model.fails and walker.id == 3:
        walker.far = 1 / model.drawn_off


def brood(model):
    for number in range(model.young):
        child = model.walkers.create()
        child.far = number


def decide(walker, model, rng):
    walker.plan = walker.mind.choose_next_plan()
    walker.run_plan(model, rng)


def walk(walker, model, rng):
    model.world.right(walker, rng.uniform(-90.0, 90.0))
    model.world.forward(walker, model.speed)
    walker.far += model.speed
    walker.seen[1] = True
    model.world.patch(walker.x, walker.y).trodden += 1


def rest(walker):
    walker.far -= 1.0


class Walk(Model):
    """Agents with minds on a torus whose size is a parameter."""

    speed: float = parameter(1.0)
    n: int = parameter(5, low=0)
    size: int = parameter(7, low=1)
    young: int = parameter(0, low=0)
    fails: bool = parameter(False)
    drawn: int = 0
    drawn_off: int = 0
    walkers = Population(Walker, "n", mind="walkers.yaml", plans={"Walk": walk, "Rest": rest})
    world = Torus("size", Land)
    setup = (each(walkers, place), once(brood))
    schedule = (each(walkers, decide),)

    @classmethod
    def folder(cls):
        """Return where its scheme lies: each test has its own."""
        return cls.schemes_in


@pytest.fixture(autouse=True)
def scheme(tmp_path):
    """Put the scheme of the walkers into a folder of its own."""
    Walk.schemes_in = tmp_path
    return write_scheme(tmp_path / "walkers.yaml", 5)


def write_scheme(file, weight):
    file.write_text(SCHEME.replace("WEIGHT", str(weight)))
    return file


def bits(array):
    """What an array holds, but for the bytes between the columns of a record."""
    columns = array.dtype.names
    if columns is None:
        return array.shape, array.tobytes()
    return array.shape, [(name, array[name].tobytes()) for name in columns]


def same(one, other):
    """Whether two societies hold the same bits."""
    states = [{name: bits(array) for name, array in each.state().items()} for each in (one, other)]
    return states[0] == states[1]


def seen(society):
    """What is to be seen of a society, whatever room its arrays have."""
    agents = {name: list(column) for name, column in society.agents().items()}
    return agents, society.series(), society.world.trodden.tolist(), society.drawn


def advanced(ticks=4, **settings):
    society = Walk(**settings)
    society.advance(ticks)
    return society


@pytest.mark.parametrize(
    "settings",
    [{}, {"n": 0}, {"n": 40, "size": 1}, {"size": 12, "speed": 2.5}, {"n": 3, "young": 400}],
    ids=str,
)
def test_a_later_society_equals_a_first_one_and_an_interpreted_one(settings):
    advanced()  # from here on the setup is compiled
    compiled, interpreted = (advanced(seed=4, compiled=one, **settings) for one in (True, False))
    assert seen(compiled) == seen(interpreted)
    assert same(compiled, advanced(seed=4, **settings))
    assert not same(compiled, advanced(seed=5, **settings)) or settings.get("n") == 0


def test_a_setup_that_is_compiled_leaves_what_an_interpreted_one_does():
    advanced()
    assert same(Walk(seed=8), Walk(seed=8, compiled=False))


def test_societies_side_by_side_do_not_see_each_other():
    alone = [advanced(6, seed=1, speed=0.5), advanced(6, seed=2, n=9, size=4)]
    together = [Walk(seed=1, speed=0.5), Walk(seed=2, n=9, size=4)]
    for _ in range(6):
        for society in together:
            society.advance(1)
    assert all(map(same, alone, together))
    together[0].walkers.far = 7.0
    assert (together[1].walkers.far != 7.0).all()
    assert Walk(seed=1).walkers.far.tolist() == [0.0] * 5


def test_a_scheme_that_changes_on_disk_is_read_again(scheme):
    often = advanced(40)
    write_scheme(scheme, 0)  # of the same length
    never = advanced(40)
    assert often.schemes["walkers"].cognitons[0].start_value == 5.0
    assert never.schemes["walkers"].cognitons[0].start_value == 0.0
    write_scheme(scheme, 5)
    assert same(advanced(40), often)


def test_schemes_in_turn_are_those_that_were_given(tmp_path, scheme):
    other = write_scheme(tmp_path / "other.yaml", 1)
    runs = [advanced(20, scheme=one) for one in (None, other, scheme, other, None)]
    assert same(runs[0], runs[2]) and same(runs[0], runs[4]) and same(runs[1], runs[3])
    assert [one.schemes["walkers"].cognitons[0].start_value for one in runs] == [5, 1, 5, 1, 5]


def test_a_rule_that_fails_in_the_setup_of_a_later_society_names_its_place():
    advanced()
    with pytest.raises(RuleError, match=r"test_starting\.py.*agent 3 of 'walkers'"):
        Walk(fails=True)
    assert seen(advanced(seed=4)) == seen(advanced(seed=4, compiled=False))


def test_societies_made_in_threads_equal_those_made_one_after_another():
    seeds = list(range(24))
    with ThreadPoolExecutor(4) as threads:
        made = list(threads.map(lambda seed: advanced(seed=seed, n=seed), seeds))
    assert all(
        same(one, advanced(seed=seed, n=seed)) for seed, one in zip(seeds, made, strict=True)
    )


def test_a_state_taken_back_in_a_stretch_holds_no_addresses():
    society = advanced()
    record = society.state()["context"]
    kept = {"_tick", "_idle", "_idle_agent", "_idle_tick"}
    for name in record.dtype.names:
        if name.startswith("_") and not name.startswith("_has_") and name not in kept:
            assert record[name] == 0
        else:
            assert np.array_equal(record[name], society.contexts[name])


CELLS = """
from socialmind import Agent, Model, Population, each

FIRST = 2.0

class Hen(Agent):
    eggs: float = 0.0

def hatch(hen, model):
    hen.eggs = FIRST

def lay(hen, model):
    hen.eggs += 1.0

class Coop(Model):
    hens = Population(Hen, 3)
    setup = (each(hens, hatch),)
    schedule = (each(hens, lay),)
"""


def cell(names, text):
    """Execute a cell of a notebook, as IPython does it."""
    file = f"<cell {len(linecache.cache)} of test_starting>"
    text = textwrap.dedent(text)
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    exec(compile(text, file, "exec"), names)


def test_a_constant_that_the_setup_reads_is_seen_when_it_changes():
    names = {"__name__": "__main__"}
    cell(names, CELLS)
    coop = names["Coop"]
    found = []
    for text in ("", "", "FIRST = 5.0", "FIRST = 5.0", "FIRST = 2.0"):
        cell(names, text)
        society = coop()
        society.advance(1)
        found.append(society.hens.eggs.tolist())
    assert found == [[3.0] * 3, [3.0] * 3, [6.0] * 3, [6.0] * 3, [3.0] * 3]


def test_a_class_that_nobody_holds_takes_what_its_societies_shared_with_it(tmp_path):
    (tmp_path / "model.py").write_text(CELLS)
    names = {"__name__": "__main__"}
    cell(names, CELLS)
    society = names["Coop"](compiled=False)
    society.advance(1)
    shared = weakref.ref(names["Coop"]._blueprint), weakref.ref(society.program)
    del society
    names.clear()
    gc.collect()
    assert [one() for one in shared] == [None, None]


def test_a_model_whose_folder_is_loaded_again_has_its_own(tmp_path):
    (tmp_path / "model.py").write_text(CELLS)
    before = load_model(tmp_path)
    first = before()
    first.advance(1)
    (tmp_path / "model.py").write_text(CELLS.replace("2.0", "9.0"))
    after = load_model(tmp_path)()
    after.advance(1)
    again = before()
    again.advance(1)
    assert [one.hens.eggs[0] for one in (first, after, again)] == [3.0, 10.0, 3.0]
