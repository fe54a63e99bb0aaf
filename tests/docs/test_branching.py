"""The page on branches: its code runs, and what it says comes true."""

import re
from pathlib import Path

import pytest

from socialmind.cli import app
from socialmind.experiments import Run

PAGE = (Path(__file__).parents[2] / "docs" / "branching.md").read_text("utf-8")
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The names of the page's code, run in a folder of its own."""
    folder = tmp_path_factory.mktemp("branching")
    file, *others = BLOCK.findall(PAGE)
    (folder / "plague.py").write_text(file, "utf-8")
    names = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        exec("\n".join(others), names)
        names["last"] = {
            name: Run(folder / "runs" / name).series.iloc[-1] for name in ("before", "after")
        }
    return names


def test_its_branch_says_what_changed(page):
    assert page["told"] == ["demand_intensity=2.0", "do hail"]


def test_its_figure_shows_how_far_the_futures_are_apart(page):
    away = page["last"]["after"]["wheat"] - page["last"]["before"]["wheat"]
    assert away != 0
    rows = page["found"].of("wheat", "after")
    assert rows["difference"].iloc[-1] == pytest.approx(away)
    assert (rows[rows["tick"] <= 100]["difference"] == 0).all()
    assert page["right"].get_ylabel() == "difference (units)"
    assert page["found"].branched == 100


def test_its_options_are_those_of_the_commands():
    import typer

    commands = typer.main.get_command(app).commands
    for line in re.findall(r"^socialmind .*$", PAGE, re.MULTILINE):
        name, *words = line.split()[1:]
        known = {one for parameter in commands[name].params for one in parameter.opts}
        assert {word for word in words if word.startswith("--")} <= known
