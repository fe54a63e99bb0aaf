"""Each kind of action: it is written, as a careful author would, and runs alike at both speeds."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from socialmind.documents.odd.document import odd
from socialmind.metaciv.actions import ACTIONS
from socialmind.metaciv.writing.acts.kinds import WRITERS

from .folders import everything, imported

ORDERING = {"L_EveryXTick", "L_Instant", "L_MultipleActions", "L_Repeat"}
SETTINGS = Path(__file__).parents[3] / "pyproject.toml"


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """The class of a model in whose plans each kind stands once."""
    return imported(tmp_path_factory.mktemp("everything"), everything(ACTIONS.values()))


def test_every_kind_is_written_or_orders_others():
    assert set(ACTIONS) == set(WRITERS) | ORDERING


def test_all_kinds_together_run(model):
    society = model(seed=3, compiled=False)
    society.advance(150)
    assert len(society.humans) > 0
    plans = {one.plan for one in society.humans}
    assert None not in plans


def test_it_is_formatted_and_clean(model):
    ruff = [sys.executable, "-m", "ruff"]
    if shutil.which("ruff") is None:
        pytest.skip("ruff is not installed")
    files = sorted(map(str, model.folder().glob("*.py")))
    for command in (["format", "--diff"], ["check", "--ignore", "INP001"]):
        done = subprocess.run(
            [*ruff, *command, "--no-cache", "--config", str(SETTINGS), *files],
            cwd=model.folder(),  # where its reader stands
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr


def test_its_odd_document_has_no_gaps(model):
    assert odd(model).gaps == ()


@pytest.mark.study
def test_all_kinds_run_alike_at_both_speeds(model):
    for seed in (1, 2):
        found = []
        for compiled in (True, False):
            society = model(seed=seed, compiled=compiled)
            rows = []
            for _ in range(6):
                society.advance(50)
                humans = [repr(one) for one in society.humans]
                minds = [one.mind.cognitons() for one in society.humans]
                rows.append((society.series(), humans, minds, [repr(one) for one in society.barns]))
            found.append(rows)
        assert found[0] == found[1]
