"""The page of the plane: its code runs, and its tables hold all devices."""

import inspect
import re
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file
from socialmind.worlds.plane.devices.actuators import ACTUATORS
from socialmind.worlds.plane.devices.device import GIVEN
from socialmind.worlds.plane.devices.interruptions import INTERRUPTIONS
from socialmind.worlds.plane.devices.rewards import REWARDS
from socialmind.worlds.plane.devices.sensors import SENSORS

PAGE = (Path(__file__).parents[2] / "docs" / "plane.md").read_text("utf-8")
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """What the page's code makes."""
    file = tmp_path_factory.mktemp("page") / "model.py"
    file.write_text("\n".join(BLOCK.findall(PAGE)), "utf-8")
    return load_file(file)


def test_its_code_runs(page):
    assert page.model.hunters.score.shape == (1,)
    assert page.outcome.score.shape == (2, 3)
    assert page.outcome.fields["caught"].shape == (2, 3, 1)


def test_its_worlds_run_alike_at_both_speeds(page):
    for model in (page.Hunt, page.CarefulHunt):
        fast, slow = model(seed=3), model(seed=3, compiled=False)
        fast.advance(60)
        slow.advance(60)
        assert fast.hunters.score.tolist() == slow.hunters.score.tolist()
        assert fast.hunters.x.tolist() == slow.hunters.x.tolist()


@pytest.mark.parametrize("makers", [SENSORS, ACTUATORS, REWARDS, INTERRUPTIONS])
def test_its_tables_hold_every_device_with_its_parameters(makers):
    for name, maker in makers.items():
        first = inspect.getdoc(maker).splitlines()[0]
        assert f"| `{name}({', '.join(inspect.signature(maker).parameters)})` | {first} |" in PAGE


def test_it_names_all_that_functions_may_take():
    for name, words in GIVEN.items():
        assert f"| `{name}` | {words} |" in PAGE
