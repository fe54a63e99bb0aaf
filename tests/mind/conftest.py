"""Lets the tests of this folder import the evaluator and the random minds that lie in it."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

HERD = Path(__file__).parent / "societies" / "herd"


@pytest.fixture(scope="session")
def herd_folder():
    """The folder of a model whose agents have hierarchies with all that these can have."""
    return HERD


@pytest.fixture(scope="session")
def herd():
    """The module of that model: its minds, its drive and its class `Herd`."""
    from socialmind.catalogue import load_model

    return sys.modules[load_model(HERD).__module__]
