"""What the tests of the engine share: the recorded behaviour of CogLogo, and random schemes."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[2]


@pytest.fixture
def shared_data() -> Callable[[str], Path]:
    """Find a file of CogLogo's recorded behaviour; the test is skipped where there is none."""

    def find(name: str) -> Path:
        beside = CHECKOUT.parent / "shared" / "data"
        path = Path(os.environ.get("SOCIALMIND_SHARED_DATA", beside)) / name
        if not path.exists():
            pytest.skip(f"no {path}: set SOCIALMIND_SHARED_DATA to the folder of CogLogo's vectors")
        return path

    return find
