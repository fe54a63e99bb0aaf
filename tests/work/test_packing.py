"""Copies of running societies and minds, in this process and in others."""

import copy
import multiprocessing
import pickle
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, Society
from socialmind import Agent, Model, Population, each
from socialmind.catalogue import load_model
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill
from socialmind.mind.hierarchy import Hierarchy
from socialmind.mind.minds import Minds
from socialmind.society.declaration import kept_names
from socialmind.sources.loading import load_file


def bits(state):
    """Return a state's columns as bytes; what fills a record up between its columns is no state."""
    return {
        (part, name): (array[name] if name else array).tobytes()
        for part, array in state.items()
        for name in array.dtype.names or [""]
    }


def same(one, other):
    """Return whether two societies are in the same state, to the last bit."""
    return bits(one.state()) == bits(other.state())


def pickled(thing):
    return pickle.loads(pickle.dumps(thing))


WAYS = [copy.copy, copy.deepcopy, pickled]
CASES = [
    ("farmer_artisan", {"compiled": False, "n_agents": 10}),
    ("foraging", {"compiled": False}),
    ("foraging", {"compiled": False, "physics": "pymunk"}),
    ("collect", {"compiled": False, "hierarchy": False}),
    ("braitenberg", {"compiled": False}),
    ("counter", {}),
]


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(("name", "settings"), CASES)
def test_a_copy_goes_on_bit_by_bit_and_apart_from_the_original(name, settings, way):
    society = load_model(name)(seed=2, **settings)
    society.advance(3)
    made = way(society)
    before = society.state()
    made.advance(4)
    assert society.tick == 3 and made.tick == 7
    assert bits(society.state()) == bits(before)
    society.advance(4)
    assert same(society, made)
    assert made.fresh().tick == 0
    assert made.parameter_values() == society.parameter_values()


def test_what_a_model_keeps_is_known():
    assert set(vars(load_model("foraging")(compiled=False))) <= kept_names(Model)


class Walker(Agent):
    energy: float = 1.0


def tire(walker):
    walker.energy -= 0.25


class Walkers(Model):
    walkers = Population(Walker, 3)
    schedule = (each(walkers, tire),)

    def __init__(self, seed=0, note="", **settings):
        super().__init__(seed, **settings)
        self._note = [note]


def test_rows_tables_and_a_modellers_attributes_come_along():
    society = Walkers(4, note="pilot", compiled=False)
    society._first = society.walkers[0]
    for made in (copy.deepcopy(society), pickled(society)):
        assert made._note == ["pilot"] and made._note is not society._note
        made._first.energy = 5.0
        assert made.walkers[0].energy == 5.0 and society.walkers[0].energy == 1.0
    model, walker, walkers = pickled((society, society.walkers[2], society.walkers))
    walker.energy = 7.0
    assert walkers is model.walkers and model.walkers.energy.tolist() == [1.0, 1.0, 7.0]


def test_a_class_within_a_function_is_copied_but_not_pickled():
    class Here(Model):
        walkers = Population(Walker, 2)

    society = Here(compiled=False)
    assert copy.deepcopy(society).walkers.energy.tolist() == [1.0, 1.0]
    with pytest.raises(pickle.PicklingError, match=r"Here.*top of a file"):
        pickle.dumps(society)


def go_on(society):
    """Run a society in another process."""
    society.advance(2)
    return society


def first_size(kind, seed):
    """Make a society in another process."""
    return len(kind(seed, compiled=False, n_agents=7).humans)


OWN_MODEL = """
from socialmind import Agent, Model, Population, each
from .rules import tire


class Walker(Agent):
    energy: float = 1.0


class Walkers(Model):
    walkers = Population(Walker, 3)
    schedule = (each(walkers, tire),)
"""


def test_other_processes_take_and_give_back_societies(tmp_path):
    (tmp_path / "model.py").write_text(OWN_MODEL)
    (tmp_path / "rules.py").write_text("def tire(walker):\n    walker.energy *= 0.5\n")
    kind = load_model(tmp_path)
    societies = [kind(seed, compiled=False) for seed in (1, 2)]
    farmers = load_model("farmer_artisan")
    societies.append(farmers(3, compiled=False, n_agents=6))
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        gone_on = list(pool.map(go_on, societies))
        assert pool.submit(first_size, farmers, 5).result() == 7
    for society, other in zip(societies, gone_on, strict=True):
        assert type(other) is type(society)
        society.advance(2)
        assert same(society, other)


def test_a_folder_with_dots_in_its_name_is_a_model_as_others_are(tmp_path):
    folder = tmp_path / "farm(v2.0)"
    folder.mkdir()
    (folder / "rules.py").write_text("def grow(cow):\n    cow.x += 1\n")
    (folder / "model.py").write_text(
        "from socialmind import Agent, Model, Population, Torus, each\n"
        "from .rules import grow\n"
        "class Farm(Model):\n"
        "    world = Torus(9)\n"
        "    cows = Population(Agent, 2)\n"
        "    schedule = (each(cows, grow),)\n"
    )
    society = load_model(folder)(seed=1, compiled=False)
    society.advance(2)
    assert same(pickled(society), society)


def test_a_file_that_has_changed_since_is_refused(tmp_path, monkeypatch):
    (tmp_path / "model.py").write_text(OWN_MODEL)
    (tmp_path / "rules.py").write_text("def tire(walker):\n    walker.energy *= 0.5\n")
    kind = load_model(tmp_path)
    content = pickle.dumps(kind(compiled=False))
    (tmp_path / "rules.py").write_text("def tire(walker):\n    walker.energy *= 0.4\n")
    for name in [one for one in sys.modules if one.startswith(kind.__module__)]:
        monkeypatch.delitem(sys.modules, name)
    with pytest.raises(Exception, match=r"model\.py: found another file than the one"):
        pickle.loads(content)


def cross(left, right):
    return right, left


def vehicle(function=None):
    seek = Skill(
        "Seek", ["SE:L", "SH:R:1"], ["MO:L", "MO:R"], function or Perceptron(layers=0), None
    )
    return MindDescription("vehicle", ["L", "R"], ["L", "R"], [], [seek])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("function", [None, Programmed(cross)])
def test_a_hierarchy_is_copied_in_its_state(way, function):
    mind = Hierarchy(vehicle(function), seed=3)
    mind.randomise(1)
    mind.evaluate({"L": 0.2, "R": 0.9})
    made = way(mind)
    assert made.tick == 1 and made.actuators() == mind.actuators()
    assert made.evaluate({"L": 0.5, "R": 0.1}) == mind.evaluate({"L": 0.5, "R": 0.1})
    made.evaluate({"L": 0.7, "R": 0.1})
    assert (made.tick, mind.tick) == (3, 2)
    if function is None:
        assert not made.genome("Seek").flags.writeable
        assert np.array_equal(made.genome("Seek"), mind.genome("Seek"))


@pytest.mark.parametrize("way", WAYS)
def test_many_minds_are_copied_in_their_state(way):
    minds = Minds(vehicle(), agents=3, own_genomes=True, lanes=2)
    minds.set_genome("Seek", np.arange(18).reshape(3, 6) / 18)
    minds.evaluate({"L": [0.1, 0.2, 0.3], "R": 0.5})
    made = way(minds)
    one, other = (m.evaluate({"L": 0.3, "R": [0.9, 0.1, 0.4]}) for m in (minds, made))
    assert all(one[name].tobytes() == other[name].tobytes() for name in one)
    made.set_genome("Seek", np.zeros(6))
    assert minds.genome("Seek")[2, 5] == 17 / 18


def test_a_mind_of_a_folder_is_read_in_another_process(tmp_path):
    (tmp_path / "wires.py").write_text("def wire(left, right):\n    return right, left\n")
    wire = load_file(tmp_path / "wires.py").wire
    mind = pickled(Hierarchy(vehicle(Programmed(wire))))
    assert mind.evaluate({"L": 0.25, "R": 0.5})["R"] == 0.25
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        other = pool.submit(copy.copy, mind).result()
    assert other.evaluate({"L": 0.75, "R": 0.5})["R"] == 0.75


def test_minds_take_no_attributes_but_their_own():
    mind = Hierarchy(vehicle())
    society = Society(CognitiveScheme("humans", (Cogniton("Tired", influence={"rest": 1}),)), 1)
    for one, name in (
        (mind, "sed"), (mind.skill("Seek"), "genom"), (Minds(vehicle(), agents=2), "agent"),
        (society, "sede"), (society.new_mind(), "scoiety"),
    ):  # fmt: skip
        with pytest.raises(AttributeError, match=name):
            setattr(one, name, 3)
    mind.skill("Seek").genome = [0] * 6
    mind._note = "mine"


@pytest.mark.parametrize("way", [copy.deepcopy, pickled])
def test_a_society_of_minds_is_copied(way):
    tired = Cogniton("Tired", start_value=2, influence={"rest": 3, "go": 1},
                     conditional=("rest", "go"))  # fmt: skip
    society = Society(CognitiveScheme("humans", (tired,)), seed=1)
    mind = society.new_mind()
    mind.choose_next_plan()
    other, twin = way((society, mind))
    assert twin.society is other and twin.id == mind.id
    chosen = [[one.choose_next_plan() for _ in range(20)] for one in (mind, twin)]
    assert chosen[0] == chosen[1]
    twin.set_cogniton_value("Tired", 9.0)
    assert mind.get_cogniton_value("Tired") == 2.0
