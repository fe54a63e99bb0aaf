import sys
from pathlib import Path

import pytest

pytest.importorskip("gymnasium")

from socialmind.catalogue import load_model
from socialmind.envs import PlaneEnv

ROVERS = Path(__file__).parents[1] / "runs" / "rovers"
LESSONS = """
from socialmind import Model, Population, each
from socialmind.worlds.plane import Disc, Plane, wheel
from .model import Rover, start


class Empty(Model):
    \"\"\"A rover that senses nothing, without borders, and whose mind nobody has learned.\"\"\"

    ticks = 5
    world = Plane(0.0)
    rovers = Population(Rover, 1, body=Disc(), actuators={"Mot": wheel(at=(0.0, 0.0))},
                        hierarchy="nowhere")
    setup = (each(rovers, start),)


class Pair(Model):
    \"\"\"Two rovers.\"\"\"

    world = Plane(70.0)
    rovers = Population(Rover, 2, body=Disc(), actuators={"Mot": wheel(at=(0.0, 0.0))})
"""


@pytest.fixture(scope="session")
def rovers():
    """A model with one robot that drives into a border."""
    return load_model(ROVERS)


@pytest.fixture
def rover(rovers):
    """The environment of that robot."""
    return PlaneEnv(rovers)


@pytest.fixture(scope="session")
def taught(tmp_path_factory):
    """The folder of that model with lessons: one without a mind, one with two robots."""
    folder = tmp_path_factory.mktemp("models") / "taught_rovers"
    folder.mkdir()
    (folder / "model.py").write_text((ROVERS / "model.py").read_text().replace(
        "class Rovers", "class TaughtRovers"))  # fmt: skip
    (folder / "lessons.py").write_text(LESSONS)
    yield folder
    for name in [name for name in sys.modules if "taught_rovers" in name]:
        del sys.modules[name]
