"""The page on figures: its `draw` draws a run, and its tables say what there is."""

import inspect
import re
import shutil
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.commands.starting import write_model
from socialmind.drawing import style as paper
from socialmind.experiments import Run, draw_figures, run

PAGE = (Path(__file__).parents[2] / "docs" / "drawing.md").read_text("utf-8")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """A run of the model that `new` writes, with the page's figures."""
    home = tmp_path_factory.mktemp("drawing")
    write_model(home / "grazers")
    code = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL)[1]
    (home / "grazers" / "figures.py").write_text(code, "utf-8")
    made = run(load_model(home / "grazers"), ticks=30, out=home / "run", compiled=False)
    yield made
    shutil.rmtree(home)


def test_its_figures_are_drawn(drawn):
    names = [path.name for path in draw_figures(drawn)]
    assert names == ["energy.pdf", "energy.png", "plans.pdf", "plans.png"]
    assert all((drawn / "figures" / name).stat().st_size > 2000 for name in names)


def test_it_names_all_that_a_run_gives():
    given = [name for name in vars(Run) if not name.startswith("_")]
    assert set(re.findall(r"`run\.(\w+)`", PAGE)) == set(given)


def test_it_names_all_that_paper_gives():
    functions = [
        name
        for name, value in vars(paper).items()
        if inspect.isfunction(value) and value.__module__ == paper.__name__ and name[0] != "_"
    ]
    table = PAGE.split("| Of `paper` |")[1]
    assert [name for name in functions if f"`paper.{name}(" not in table] == []
    constants = ["BLUE", "RED", "GOLD", "PURPLE", "GREY", "PALE", "INK", "BLUE_TO_RED"]
    assert [name for name in constants if name not in table or not hasattr(paper, name)] == []
    assert f"`paper.COLUMN` is {paper.COLUMN:g}, `paper.PAGE` {paper.PAGE:g}" in table
