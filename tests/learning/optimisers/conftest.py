import importlib.util
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def stepped():
    """What a network's steps compute."""
    path = Path(__file__).parents[2] / "mind" / "functions" / "stepping.py"
    spec = importlib.util.spec_from_file_location("functions_stepping", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.stepped
