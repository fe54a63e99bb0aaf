import importlib.util
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def drifters():
    """The stand-in model class, from the file that stopped runs load it from as well."""
    path = Path(__file__).parent / "drifters.py"
    spec = importlib.util.spec_from_file_location("drifters", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["drifters"] = module
    spec.loader.exec_module(module)
    yield module.Drifters
    del sys.modules["drifters"]
