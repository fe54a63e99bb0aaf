"""Scores: what is measured, in which worlds, and that it does not depend on who does the work."""

from pathlib import Path

import numpy as np
import pytest

from socialmind import Model, Population
from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.scoring import COLLISION, SCORE, measures_of, score
from socialmind.learning.lessons import keys
from socialmind.learning.lessons.keys import seed_for
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import Disc, Measure, Plane, Robot, against, ratio, total, wheel

ROVERS = Path(__file__).parents[1] / "runs" / "rovers"


@pytest.fixture(scope="module")
def rovers():
    return load_model(ROVERS)


@pytest.fixture(scope="module")
def scored(rovers):
    return score(rovers, episodes=12, seed=3, workers=1)


def other_mind(*commands):
    skills = [Skill("Drive", [], ["MO:MotL", "MO:MotR"], Perceptron(layers=0), list(commands))]
    return MindDescription("other", ["AHEAD"], ["MotL", "MotR"], skills=skills)


def test_measures_are_those_of_the_episodes_run_one_by_one(rovers, scored):
    assert scored.episodes == 12
    assert list(scored.frame) == [
        "world", "ticks", "over", "objects", "survived", "collisions", "counted",
    ]  # fmt: skip
    for row in scored.frame.itertuples():
        model = rovers(seed=row.world)
        while model.over is None and model.tick < rovers.ticks:
            model.advance()
        assert (row.ticks, row.over) == (model.tick, model.over)
        assert row.objects == model.tables["rovers"].delivered[0] == model.counted // 10
        assert row.survived == model.tick / 45
        assert row.collisions == model.tables["rovers"].collisions[0]
        assert row.counted == model.counted / 45
    assert set(scored.frame["over"]) == {"collision", None}
    assert scored.ticks == scored.frame["ticks"].sum()
    assert scored.intervals["objects"] == interval_of(scored.frame["objects"])


def test_it_is_the_same_whoever_does_the_work_and_begins_the_same(rovers, scored):
    assert score(rovers, episodes=12, seed=3, workers=3).frame.equals(scored.frame)
    fewer = score(rovers, episodes=5, seed=3).frame
    assert fewer.equals(scored.frame[:5])
    told = []
    processes = score(
        rovers, episodes=6, seed=3, engine="pymunk", workers=2,
        on_progress=lambda done, count: told.append((done, count)),
    )  # fmt: skip
    # No contact comes before the one that ends the episode: the engines agree.
    assert processes.frame.equals(scored.frame[:6])
    assert told == [(3, 6), (6, 6)]
    alone = score(rovers, episodes=6, seed=3, engine="pymunk", workers=1)
    assert alone.frame.equals(processes.frame)


def test_minds_go_to_other_processes(rovers, tmp_path):
    mind = other_mind(0.5, 0.5)
    mind.save(tmp_path / "mind")
    options = {"episodes": 2, "engine": "pymunk", "workers": 2}
    for given in (mind, tmp_path / "mind", {"rovers": mind}):
        assert score(rovers, given, **options).intervals["survived"].mean == 1.0


def test_worlds_are_never_those_of_training(scored):
    assert scored.frame["world"].tolist() == [seed_for(SCORE, 3, n) for n in range(12)]
    words = {value for name, value in vars(keys).items() if name.isupper()}
    assert SCORE not in words and len(words) >= 4


def test_collisions_end_a_run_or_not(rovers, scored):
    ended = score(rovers, episodes=12, seed=3, on_collision="end")
    assert ended.frame.equals(scored.frame)
    going_on = score(rovers, episodes=12, seed=3, on_collision="continue")
    assert (going_on.frame["ticks"] == 45).all() and going_on.frame["over"].isna().all()
    assert going_on.intervals["survived"].record() == {"mean": 1.0, "low": 1.0, "high": 1.0}
    # The same episodes up to the collision, which counts.
    assert going_on.frame["world"].equals(scored.frame["world"])
    assert (going_on.frame["collisions"] >= scored.frame["collisions"]).all()
    assert COLLISION in rovers.interruptions


def test_options_reach_the_worlds(rovers):
    wide = score(rovers, episodes=4, parameters={"half_width": 50.0}, ticks=60)
    assert (wide.frame["ticks"] == 60).all()
    assert score(rovers, other_mind(0.5, 0.5), episodes=4).frame["collisions"].sum() == 0


def test_the_record_is_plain_json(scored):
    record = scored.record()
    assert list(record) == ["episodes", "ticks", "objects", "survived", "collisions", "counted"]
    assert record["episodes"] == 12
    assert list(record["objects"]) == ["mean", "low", "high"]
    assert record["objects"]["mean"] == np.mean(scored.frame["objects"])


class Wanderer(Robot):
    """A robot that has delivered something."""

    delivered: int = 3


def test_robots_have_measures_anyway():
    class Wanderers(Model):
        world = Plane(0.0)
        robots = Population(
            Wanderer, 2, body=Disc(), hierarchy=other_mind(1, 1),
            actuators={"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))},
        )  # fmt: skip

    assert list(measures_of(Wanderers)) == ["objects", "survived", "collisions"]
    found = score(Wanderers, episodes=2, ticks=5)
    assert [one.mean for one in found.intervals.values()] == [6.0, 1.0, 0.0]
    assert score(Wanderers, episodes=2, ticks=5, on_collision="continue").frame.equals(found.frame)
    with pytest.raises(SocialmindError, match="wanderers has no interruption called 'collision'"):
        score(Wanderers, on_collision="end")
    with pytest.raises(ModelError, match="what other processes cannot load"):
        score(Wanderers, episodes=2, ticks=5, engine="pymunk", workers=2)


def minus(own, other):
    """Return how much more."""
    return own - other


def test_a_measure_is_set_against_another_mind_in_the_same_worlds(rovers, scored, tmp_path):
    resting, told = other_mind(0.5, 0.5), []
    resting.save(tmp_path / "resting")

    measures = {
        "pace": ratio("collisions", "delivered"),
        "survived": against(rovers.measures["survived"], tmp_path / "resting"),
        "ticks_lost": against(Measure(lambda ticks: ticks), resting, compare=minus),
        "itself": against(total("delivered"), rovers.populations["rovers"].hierarchy),
    }
    compared = type("Compared", (rovers,), {"measures": measures})
    found = score(
        compared, episodes=12, seed=3, workers=1,
        on_progress=lambda done, count: told.append((done, count)),
    )  # fmt: skip
    own = scored.frame
    assert found.frame["world"].equals(own["world"]) and found.ticks == scored.ticks
    # Who rests survives to the end, so the share is that of the mind itself.
    assert found.frame["survived"].tolist() == own["survived"].tolist()
    assert found.intervals["survived"].mean == pytest.approx(own["survived"].mean())
    assert found.frame["ticks_lost"].tolist() == (own["ticks"] - 45).tolist()
    pace = own["collisions"].sum() / own["objects"].sum()
    assert found.intervals["pace"].mean == pytest.approx(pace)
    assert found.intervals["itself"] == Interval(1.0, 1.0, 1.0)
    assert told[-1] == (48, 48)


def lost(delivered):
    """Return what is no number."""
    return "three"


MISSPELT = {"objects": total("deliverd")}
LOST = {"objects": Measure(lost)}


def test_what_is_wrong_is_said(rovers):
    with pytest.raises(SocialmindError, match="the model boids has no plane, so there are no epis"):
        score(load_model("boids"))
    for options, said in [
        ({"engine": "jet"}, "engine 'jet'"),
        ({"episodes": 0}, "episodes: found 0; expected a whole number, 1 or more"),
        ({"seed": -1}, "seed: found -1; expected"),
        ({"workers": 0}, "workers: found 0; expected a whole number, 1 or more"),
        ({"on_collision": "stop"}, "on a collision 'stop'; there is end, continue"),
        ({"ticks": 0}, "ticks: found 0"),
    ]:
        with pytest.raises(SocialmindError, match=said):
            score(rovers, **options)

    class Wrong(rovers):
        measures = MISSPELT

    with pytest.raises(ModelError, match=r"'deliverd' to record; .*did you mean 'delivered'"):
        score(Wrong)

    class Lost(rovers):
        measures = LOST

    with pytest.raises(
        ModelError, match=r"test_scoring.py:\d+: .*the measure 'objects', which stop"
    ):
        score(Lost, episodes=1)
