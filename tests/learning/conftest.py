import importlib.util
from pathlib import Path

import pytest

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
