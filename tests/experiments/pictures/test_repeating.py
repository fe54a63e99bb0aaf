"""A run repeated tick by tick is the run that was recorded."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, run
from socialmind.experiments.pictures import repeating
from socialmind.experiments.pictures.repeating import Repeated, _Path
from socialmind.runs.capsule import Capsule

MODELS = Path(__file__).parents[2]
SEEKERS = MODELS / "worlds" / "plane" / "seekers"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A run of 40 ticks whose robots are recorded at each, from another half-width."""
    out = tmp_path_factory.mktemp("seekers") / "run"
    parameters = {"half_width": 25.0}
    return run(
        load_model(SEEKERS), 40, 3, parameters, every=1, agents_every=1, out=out, compiled=False
    )


@pytest.fixture(scope="module")
def recorded(folder):
    """Where the robots were, by tick and identity."""
    model = load_model(SEEKERS)(seed=3, compiled=False, half_width=25.0)
    places = {}
    for tick in range(41):
        columns = model.tables["robots"].columns
        for identity in (0, 1):
            places[tick, identity] = columns["x"].item(identity), columns["y"].item(identity)
        model.advance()
    assert Run(folder).ticks == 40
    return places


@pytest.mark.parametrize("mind", [False, True])
def test_scenes_and_paths_are_those_of_the_run(folder, recorded, mind):
    repeated = Repeated(Capsule(folder), mind=mind)
    for tick in repeated.at([0, 7, 40]):
        scene = repeated.scene
        assert (scene.tick, scene.half_width) == (tick, 25.0)
        for robot in scene.robots:
            assert (robot.x, robot.y) == recorded[tick, robot.identity]
            path = repeated.paths()["robots", robot.identity]
            wanted = [recorded[earlier, robot.identity] for earlier in range(tick + 1)]
            assert path.tolist() == [list(place) for place in wanted]
    assert len(repeated.paths(5)["robots", 0]) == 6
    assert (repeated.mind is not None) == mind


def test_the_hierarchy_is_that_of_the_robot(folder):
    repeated = Repeated(Capsule(folder), ("robots", 1), mind=True)
    for _ in repeated.at([5]):
        assert repeated.robot == ("robots", 1)
        first, second = repeated._model.tables["robots"].columns["readings"][:, 1]
        assert first != second
        assert repeated.mind.sensors() == {"RADBALL": second}


def test_progress_is_told(folder, monkeypatch):
    monkeypatch.setattr(repeating, "TOLD", 4)
    told = []
    list(Repeated(Capsule(folder)).at([2, 9], lambda *numbers: told.append(numbers)))
    assert told == [(2, 9), (4, 9), (8, 9), (9, 9)]


@pytest.mark.parametrize("robot", [(None, 2), ("stones", 0)])
def test_robots_that_there_are_not_are_refused(folder, robot):
    with pytest.raises(SocialmindError, match=r"expected a robot at the start of seekers, which"):
        Repeated(Capsule(folder), robot)


def test_a_path_is_broken_where_the_robot_was_moved():
    path = _Path(jump=2.0)
    for x in (0.0, 1.0, 2.0, 9.0, 10.0):
        path.add(x, 0.0)
    assert np.array_equal(path.last(None)[:, 0], [0, 1, 2, np.nan, 9, 10], equal_nan=True)
    assert np.array_equal(path.last(1)[:, 0], [9, 10])
    assert path.last(0).tolist() == [[10, 0]]
