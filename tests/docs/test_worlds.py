"""The page of worlds: its code runs at both speeds, and its tables hold all that can be called."""

import re
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file
from socialmind.worlds.grid.fields import CALLS
from socialmind.worlds.grid.geometry import MOVING
from socialmind.worlds.grid.one_per_patch import CALLS as OF_ONE

PAGE = (Path(__file__).parents[2] / "docs" / "worlds.md").read_text("utf-8")
ASKED = ("is_inside", "can_move", "is_on", "distance", "towards", "face", "patch", "in_radius")
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """What the page's code makes."""
    file = tmp_path_factory.mktemp("page") / "model.py"
    file.write_text("\n".join(BLOCK.findall(PAGE)), "utf-8")
    return load_file(file)


def test_its_models_run_alike_at_both_speeds(page):
    for kind in (page.Town, page.Hill):
        fast, slow = kind(seed=3), kind(seed=3, compiled=False)
        for society in (fast, slow):
            if kind is page.Hill:
                society.world.patch(2, 1).scent = 50.0
            society.advance(20)
        for name, array in fast.state().items():
            assert array.tobytes() == slow.state()[name].tobytes(), name
    assert fast.scent > 0


def test_its_last_lines_are_right(page):
    assert page.hill.scent == pytest.approx(81.0)
    assert page.hill.world.patch(4, 2).rock == 12.0


def test_it_names_all_that_rules_call():
    for name in (*MOVING, *CALLS, *OF_ONE, *ASKED):
        assert re.search(rf"`(world\.)?{name}\b|`{name}`", PAGE), name


def test_its_travellers_leave_a_road(page):
    travels = page.Travels(seed=3, compiled=False)
    travels.advance(40)
    assert all((one.x, one.y) == (7.0, 2.0) for one in travels.travellers)
    assert travels.world.road.sum() > 1
