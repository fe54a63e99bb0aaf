"""What rules read may be redefined, in the next cell or the file: it holds for the next society."""

import linecache
import textwrap

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import ModelError

CELLS = """
from socialmind import Agent, Model, Population, each

SPEED = 2

def twice(x):
    return 2 * x

class Walker(Agent):
    far: float = 0.0

def walk(walker, model):
    walker.far += twice(walker.far) + SPEED

class Walk(Model):
    walkers = Population(Walker, 1)
    schedule = (each(walkers, walk),)
"""


class Notebook:
    """Cells that are executed one after another, as IPython does it."""

    def __init__(self):
        self.names = {"__name__": "__main__"}
        self.count = 0

    def cell(self, text):
        self.count += 1
        file = f"<cell {id(self)} {self.count}>"
        text = textwrap.dedent(text)
        linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
        exec(compile(text, file, "exec"), self.names)


def far_after(model_class, ticks=2):
    """What both speeds come to, which must be the same."""
    found = []
    for compiled in (True, False):
        society = model_class(compiled=compiled)
        society.advance(ticks)
        found.append(society.walkers.far.tolist())
    assert found[0] == found[1]
    return found[0]


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        ("SPEED = 3", [12.0]),  # 3, then 3 + 6 + 3
        ("SPEED = 2.5", [10.0]),
        ("def twice(x):\n    return 3 * x", [10.0]),  # 2, then 2 + 6 + 2
        ("SPEED = None", ModelError),
        ("del twice", ModelError),
    ],
)
def test_a_cell_that_redefines_what_a_rule_reads_is_seen(cell, expected):
    notebook = Notebook()
    notebook.cell(CELLS)
    before = notebook.names["Walk"]
    assert far_after(before) == [8.0]  # 2, then 2 + 4 + 2
    notebook.cell(cell)
    if expected is ModelError:
        with pytest.raises(ModelError):
            far_after(before)
    else:
        assert far_after(before) == expected
    notebook.cell("SPEED = 2\ndef twice(x):\n    return 2 * x")
    assert far_after(before) == [8.0]


def test_nothing_is_typed_again_while_nothing_changes():
    notebook = Notebook()
    notebook.cell(CELLS)
    model = notebook.names["Walk"]
    program = model.typed()
    notebook.cell("SPEED = 1 + 1")
    assert model.typed() is program


def write_model(folder, text):
    folder.mkdir(exist_ok=True)
    (folder / "model.py").write_text(text)
    return folder


def test_a_loaded_model_stays_as_it_was_loaded_whatever_becomes_of_its_file(tmp_path):
    folder = write_model(tmp_path / "walk", CELLS)
    loaded = load_model(folder)
    write_model(folder, CELLS.replace("SPEED = 2", "SPEED = 7").replace("2 * x", "5 * x"))
    assert far_after(loaded) == [8.0]
    assert far_after(load_model(folder)) == [49.0]  # 7, then 7 + 35 + 7


def test_a_helper_of_an_edited_file_is_refused_rather_than_half_new(tmp_path):
    folder = tmp_path / "walk"
    folder.mkdir()
    helper = "def twice(x):\n    return 2 * x\n"
    (folder / "helper.py").write_text(helper)
    text = CELLS.replace("def twice(x):\n    return 2 * x", "from .helper import twice")
    write_model(folder, text)
    loaded = load_model(folder)
    (folder / "helper.py").write_text(helper.replace("2 * x", "2 * x + 1"))
    with pytest.raises(ModelError, match=r"helper.py.*has changed since"):
        loaded(compiled=False)


MAKER = """
import numpy as np
from numba.extending import register_jitable
from coglogo_py import CognitiveScheme, Cogniton, DecisionMaker
from socialmind import Agent, Model, Population, each

BEST = 0

@register_jitable
def place(u):
    return int(2 * u)

class Own(DecisionMaker):
    name = "Own"

    @staticmethod
    def choose(weights, bias, u):
        return BEST if place(u) < 1 else 0

    @staticmethod
    def probabilities(weights, bias):
        return np.ones(2) / 2

class Walker(Agent):
    chosen: int = -1

def east(walker):
    walker.chosen = 0

def west(walker):
    walker.chosen = 1

def act(walker, model, rng):
    walker.plan = walker.mind.choose_next_plan()
    walker.run_plan(model, rng)

NEED = Cogniton("Need", conditional=("east", "west"))
SCHEME = CognitiveScheme("scheme", (NEED,), decision_maker=Own())

class Walk(Model):
    walkers = Population(Walker, 40, mind=SCHEME, plans={"east": east, "west": west})
    schedule = (each(walkers, act),)
"""


def test_a_decision_maker_is_compiled_anew_with_its_constants_and_helpers(tmp_path):
    def west_walkers(constant, helper):
        text = MAKER.replace("BEST = 0", constant).replace("int(2 * u)", helper)
        model = load_model(write_model(tmp_path / "walk", text))
        found = []
        for compiled in (True, False):
            society = model(compiled=compiled)
            society.advance(1)
            found.append(int(society.walkers.chosen.sum()))
        assert found[0] == found[1]
        return found[0]

    assert west_walkers("BEST = 0", "int(2 * u)") == 0
    assert 8 < west_walkers("BEST = 1", "int(2 * u)") < 32
    assert west_walkers("BEST = 1", "int(0 * u)") == 40
    assert west_walkers("BEST = 1", "int(2 + u)") == 0
