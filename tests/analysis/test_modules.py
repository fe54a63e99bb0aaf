"""Every module of every study can be imported, those too that only some of its commands load."""

import sys
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file

ANALYSIS = Path(__file__).parents[2] / "analysis"
MODULES = sorted(ANALYSIS.glob("*/*.py"))


@pytest.fixture
def forgetting():
    """Forget what a test imports: the scripts of farmer_artisan import their neighbours by name."""
    before = dict(sys.modules)
    yield
    for name, module in sys.modules.copy().items():
        file = getattr(module, "__file__", None)
        if name not in before and file and Path(file).is_relative_to(ANALYSIS):
            del sys.modules[name]


def test_there_are_modules():
    assert {path.name for path in MODULES} >= {"studies.py", "trainings.py"}


@pytest.mark.parametrize("path", MODULES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_it_can_be_imported(path, forgetting, monkeypatch):
    monkeypatch.syspath_prepend(path.parent)
    assert load_file(path).__doc__
