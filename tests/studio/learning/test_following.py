"""A training is followed from its folder: the whole of it, and only what is new."""

import json
import os
import platform
import shutil

import pytest

from socialmind.learning import Curriculum, Cycle, Lesson, Training, learn, resume
from socialmind.learning.training.execution import TrainingInterrupted
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.runs.folders import hold
from socialmind.studio.learning.following import Follower
from socialmind.studio.learning.listing import summary, trainings_below
from socialmind.studio.learning.time_left import Done, seconds_left


class Outcome:
    def __init__(self, score, ticks):
        self.score, self.ticks = score, ticks


class Slope:
    """The nearer the weights to 1, the better."""

    ticks = 1

    def __init__(self, parameters, hierarchy, master, skill, drive, ticks, physics):
        self.genome_size = hierarchy.skill(skill).genome_size

    def run(self, genomes, seeds):
        import numpy as np

        score = -((genomes - 1.0) ** 2).sum(axis=1)[:, None].repeat(len(seeds), 1)
        return Outcome(score, np.full(score.shape, 7))


MIND = MindDescription(
    "robot",
    ["S"],
    ["M"],
    skills=[
        Skill("One", ["SE:S"], ["MO:M"], Perceptron(layers=0)),
        Skill("Two", ["SE:S"], ["SK:One"], Perceptron(layers=0)),
    ],
)
LESSONS = Curriculum(
    [
        Lesson(name, Slope, generations=5, repetitions=1, settings={"population": 6}, finals=1)
        for name in ("One", "Two")
    ],
    mind=MIND,
)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    return learn(None, LESSONS, attempts=2, seed=1, out=tmp_path_factory.mktemp("t") / "done")


def stopping(after):
    seen = []

    def stop(news, left):
        seen.append(news)
        if len(seen) == after:
            os.kill(os.getpid(), 2)

    return stop


@pytest.fixture(scope="module")
def paused(tmp_path_factory):
    out = tmp_path_factory.mktemp("t") / "paused"
    with pytest.raises(TrainingInterrupted):
        learn(None, LESSONS, attempts=2, seed=1, out=out, on_generation=stopping(8))
    return out


def rows(told):
    return [
        (one["attempt"], one["lesson"], generation, best)
        for one in told["curve"]
        for generation, best in zip(one["generation"], one["best"], strict=True)
    ]


def test_a_finished_one_is_told_as_the_training_tells_itself(finished):
    told = Follower(finished).told()
    curve = Training(finished).curve
    assert told["status"] == "finished"
    assert told["left"] is None and told["now"] is None
    assert [one[:3] for one in rows(told)] == list(
        curve[["attempt", "lesson", "generation"]].itertuples(index=False, name=None)
    )
    assert [one[3] for one in rows(told)] == pytest.approx(curve["best"].tolist(), rel=1e-6)
    results = Training(finished).lessons
    assert [one["score"] for one in told["results"]] == pytest.approx(results["score"].tolist())
    assert [one["generation"] for one in told["results"]] == results["generation"].tolist()


def test_only_what_is_new_is_told(finished):
    follower = Follower(finished)
    whole = rows(follower.told())
    assert rows(follower.told([10, 10])) == []
    assert rows(follower.told([7, 10])) == whole[7:10]
    assert rows(follower.told([5])) == whole[5:]
    assert rows(follower.told([99, 9])) == whole[19:]


def test_a_paused_one_says_where_it_stands_and_goes_on(paused, tmp_path):
    folder = shutil.copytree(paused, tmp_path / "copy")
    follower = Follower(folder)
    told = follower.told()
    assert told["status"] == "interrupted"
    assert told["now"]["lesson"] == "Two"
    assert (told["now"]["generation"], told["now"]["of"]) == (3, 5)
    assert told["left"] > 0
    assert len(rows(told)) == 8
    resume(folder, lessons=LESSONS)
    told = follower.told([8])
    assert told["status"] == "finished"
    assert len(rows(told)) == 12


def test_a_killed_one_is_told_from_one_that_goes_on(paused, tmp_path):
    folder = shutil.copytree(paused, tmp_path / "killed")
    manifest = json.loads((folder / "manifest.json").read_text())
    (folder / "manifest.json").write_text(json.dumps({**manifest, "status": "running"}))
    assert Follower(folder).told()["status"] == "stopped"
    # Of a process of another machine this one does not know whether it lives.
    away = {"host": f"not {platform.node()}", "pid": 1}
    changed = {**manifest, "status": "running", "process": away}
    (folder / "manifest.json").write_text(json.dumps(changed))
    told = Follower(folder).told()
    assert (told["status"], told["held"], told["process"]) == ("elsewhere", False, away)
    with hold(folder):
        assert Follower(folder).told()["status"] == "running"


def test_broken_ones_say_what_is_wrong(finished, tmp_path):
    folder = shutil.copytree(finished, tmp_path / "broken")
    manifest = json.loads((folder / "manifest.json").read_text())
    (folder / "manifest.json").write_text(json.dumps({**manifest, "attempts": "many"}))
    assert summary(folder)["status"] == "broken"
    assert "attempts" in Follower(folder).told()["error"]


def test_trainings_are_found_below_a_folder_and_nothing_else(finished, tmp_path):
    for place in ("a", "deep/er/b", "trainings/c", ".hidden/d", "e/inner"):
        shutil.copytree(finished, tmp_path / place)
    shutil.copytree(finished, tmp_path / "a" / "within")
    (tmp_path / "trainings" / "c" / "manifest.json").write_text("{")
    run = tmp_path / "runs" / "one"
    run.mkdir(parents=True)
    (run / "manifest.json").write_text("{}")
    found = {str(one.relative_to(tmp_path)) for one in trainings_below(tmp_path)}
    assert found == {"a", "deep/er/b", "trainings/c", "e/inner"}
    assert summary(tmp_path / "trainings" / "c")["status"] == "broken"


def test_the_time_left_by_hand():
    go, cycle = {"name": "Go", "generations": 10, "starts": 2}, {"name": "On", "generations": 4}
    rounds = {"lessons": [cycle], "cycles": 3, "budget": None}
    done = [Done(1, "Go", 1, True, [9.0, 1.0, 1.0]), Done(1, "On", 1, False, [2.0])]
    # Of the first attempt 3 + 4 + 4 generations of 2 s; of the second 20 of 1 s and 12 of 2 s.
    assert seconds_left([go, rounds], 2, done) == 22.0 + 20.0 + 24.0
    assert seconds_left([go, {**rounds, "cycles": None}], 2, done) is None
    assert seconds_left([go], 1, []) is None


def test_cycles_tell_their_rounds(tmp_path):
    cycle = Cycle([one.changed(generations=2) for one in LESSONS.lessons], cycles=2)
    folder = learn(None, Curriculum([cycle], mind=MIND), seed=1, out=tmp_path / "rounds")
    told = Follower(folder).told()
    assert [(one["cycle"], one["lesson"]) for one in told["curve"]] == [
        (1, "One"), (1, "Two"), (2, "One"), (2, "Two"),
    ]  # fmt: skip
    assert told["lessons"][0]["name"] == "One"
