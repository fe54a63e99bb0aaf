from pathlib import Path

import pytest

from socialmind.sources.loading import load_file


@pytest.fixture(scope="session")
def tiny_plans():
    """A plan of a training that takes no time, and what makes others."""
    return load_file(Path(__file__).parent / "tiny_plans.py")


@pytest.fixture(scope="session")
def whole(tiny_plans, tmp_path_factory):
    """The folder of a training of the plan that was never stopped."""
    folder = tmp_path_factory.mktemp("whole") / "tiny"
    return tiny_plans.PLAN.train(folder, workers=1).folder
