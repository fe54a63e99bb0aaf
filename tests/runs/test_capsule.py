"""What a run's manifest says: which run it is, and what another process has written since."""

from dataclasses import replace

import pytest

from socialmind.runs.capsule import Capsule, Manifest
from socialmind.runs.execution import run

MANIFEST = Manifest(
    model={"name": "Farm", "path": None, "source_sha256": None},
    parameters={"n": 5},
    seed=3,
    compiled=True,
    schemes={"humans": {"name": "h", "file": "h.yaml", "sha256": "0" * 64}},
    ticks=100,
    every=4,
    agents_every=20,
)


@pytest.mark.parametrize(
    "changes",
    [
        {"parameters": {"n": 6}},
        {"seed": 4},
        {"engine": "pymunk"},
        {"every": 5},
        {"agents_every": 10},
        {"schemes": {"humans": {"name": "h", "file": "h.yaml", "sha256": "1" * 64}}},
        {"minds": {"humans": {"name": "m", "folder": "m", "sha256": "1" * 64}}},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_what_decides_the_result_is_the_runs_identity(changes):
    assert replace(MANIFEST, **changes).identity() != MANIFEST.identity()


def test_what_does_not_decide_the_result_is_not():
    later = {"ticks": 200, "ticks_done": 50, "compiled": False, "status": "failed", "error": "e"}
    assert replace(MANIFEST, **later).identity() == MANIFEST.identity()


def test_identities_stay_as_they_are():
    """Checkpoints of before hold them: the hash of the fields as JSON, their names in order."""
    assert MANIFEST.identity() == (
        "090fd84d9bf4ea11377414d569da9b7d88e2566e06c5f0624fe9e01e33a7acd1"
    )


def test_a_folder_is_read_anew_once_it_is_held(drifters, tmp_path):
    capsule = Capsule(run(drifters, 5, out=tmp_path / "run"))
    Capsule(capsule.folder).update(error="of another process")
    with capsule.locked():
        assert capsule.manifest.error == "of another process"
