"""Steering by hand: one robot is told what to do, others obey their minds, and a run repeats it."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, Steer, replay, run
from socialmind.interventions.following import advanced

ROVERS = Path(__file__).parent / "rovers"
LEFT, STILL = Steer(10, "rovers", 1, (0.25, 1.0)), Steer(40, "rovers", 1, (0.5, 0.5))
BACK = Steer(60, "rovers", 1, None)


@pytest.fixture(scope="module")
def kind():
    return load_model(ROVERS)


@pytest.mark.parametrize("compiled", [True, False])
def test_one_is_steered_and_the_others_obey_their_minds(kind, compiled):
    society = kind(seed=1, compiled=compiled)
    society = advanced(society, 11, [LEFT])
    told = society.tables["rovers"].rows["commands"][:, :2].tolist()
    assert told == [[0.75, 0.75], [0.25, 1.0], [0.75, 0.75]]
    assert society.rovers[1].hierarchy.actuator("MotL") == 0.75  # what its mind would have done
    society.advance(20)
    turned = society.rovers.angle
    assert turned[1] > 0.5  # to the left, while the others go straight on
    assert turned[0] == turned[2] == 0.0
    society = advanced(society, 40, [STILL, BACK])
    told = society.tables["rovers"].rows["commands"][:, :2].tolist()
    assert told == [[0.75, 0.75]] * 3


def test_both_speeds_are_equal(kind):
    ways = [LEFT, STILL, BACK]
    fast, slow = (advanced(kind(seed=1, compiled=one), 80, ways) for one in (True, False))
    for name, array in fast.state().items():
        assert np.array_equal(array, slow.state()[name], equal_nan=array.dtype.kind == "f"), name


def test_a_run_keeps_it_and_repeats_it(kind, tmp_path):
    folder = run(kind, 80, seed=2, interventions=[LEFT, STILL, BACK], out=tmp_path / "run")
    kept = Run(folder).manifest.interventions
    assert kept[0] == {"tick": 10, "population": "rovers", "agent": 1, "commands": [0.25, 1.0]}
    assert kept[2]["commands"] is None
    assert replay(folder).equal


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("rovers", 9, (0.5, 0.5)), "no robot 9"),
        (("rovers", 1, (0.5,)), "MotL, MotR"),
        (("rovers", 1, (0.5, 1.5)), "0 … 1"),
        (("rivers", 1, (0.5, 0.5)), "rovers"),
    ],
)
def test_what_is_wrong_is_said_and_changes_nothing(kind, given, said):
    society = kind(seed=1)
    before = society.state()
    with pytest.raises(SocialmindError, match=said):
        advanced(society, 1, [Steer(0, *given)])
    for name, array in society.state().items():
        assert np.array_equal(array, before[name], equal_nan=array.dtype.kind == "f"), name


def test_where_there_is_no_plane_nobody_is_steered():
    society = load_model("farmer_artisan")(seed=1)
    with pytest.raises(SocialmindError, match="no plane"):
        advanced(society, 1, [Steer(0, "humans", 1, (0.5,))])
