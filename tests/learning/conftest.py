import importlib.util
from pathlib import Path

import pytest

from socialmind.learning import Lesson
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.sources.loading import load_file

FUNCTIONS = Path(__file__).parents[1] / "mind" / "functions"


def loaded(name):
    spec = importlib.util.spec_from_file_location(f"functions_{name}", FUNCTIONS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


CASES = loaded("conftest").CASES


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0]}, {case[1]} to {case[2]}")
def case(request):
    """An internal function, the number of inputs and the number of outputs."""
    return request.param


@pytest.fixture(scope="session")
def defined():
    """What a function computes by its definition."""
    pytest.importorskip("neat")  # its formulas are the definition of a graph's
    return loaded("definitions").defined


@pytest.fixture(scope="session")
def light():
    """The light seeker's world and vehicles."""
    path = Path(__file__).parent / "light_seeker.py"
    spec = importlib.util.spec_from_file_location("light_seeker", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def slopes():
    """Environments without bodies, loaded as a model's files are."""
    return load_file(Path(__file__).parent / "slopes.py")


@pytest.fixture(scope="session")
def robot():
    """A small mind without weights: a master above two base skills."""
    wheels = ["MO:MotL", "MO:MotR"]
    return MindDescription(
        "robot",
        ["S1", "S2"],
        ["MotL", "MotR"],
        skills=[
            Skill("Top", ["SE:S1"], ["SK:Go", "SK:Turn"], Perceptron(layers=0)),
            Skill("Go", ["SE:S1", "SE:S2"], wheels, Perceptron(layers=0)),
            Skill("Turn", ["SE:S1"], wheels, Perceptron(layers=0)),
        ],
    )


@pytest.fixture
def lesson(slopes):
    """Make a short lesson on a slope."""

    def made(name, luck=0.1, **changes):
        given = {
            "generations": 6,
            "repetitions": 2,
            "settings": {"population": 12},
            "finals": 5,
            "finalists": 4,
            "parameters": {"luck": luck},
        }
        return Lesson(name, slopes.Slope, **{**given, **changes})

    return made
