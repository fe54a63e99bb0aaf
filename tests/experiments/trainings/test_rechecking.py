"""Judging what is kept of a training again."""

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.trainings import rechecking
from socialmind.experiments.trainings.rechecking import in_common_worlds, recheck, rescore, winners
from socialmind.experiments.trainings.store import differences, keep
from socialmind.learning import Training
from socialmind.learning.lessons.keys import seeds_for
from socialmind.learning.training import archive
from socialmind.runs.arrays_file import save_arrays


def edited(whole, home):
    """Keep a training whose model's files are said to be others."""
    path = keep(whole, home) / "manifest.json"
    source = Training(whole).manifest.model["source_sha256"]
    path.write_text(path.read_text().replace(source, "0" * 64))
    return Training(path.parent)


def test_a_model_that_does_the_same_takes_the_trainings_over(whole, tiny_plans, tmp_path):
    plan = tiny_plans.PLAN
    training = edited(whole, tmp_path)
    assert differences(training, plan) == ["the model's source"]
    assert recheck(tmp_path / "tiny", plan) == 4
    assert differences(Training(tmp_path / "tiny"), plan) == []


def test_one_that_does_not_is_refused(whole, tiny_plans, tmp_path):
    plan = tiny_plans.PLAN
    edited(whole, tmp_path)
    path = tmp_path / "tiny" / "attempts" / "2" / "lesson-002.npz"
    record, arrays = archive.load(path)
    save_arrays(path, {**record, "score": record["score"] + 1e-9}, arrays)
    with pytest.raises(SocialmindError, match=r"attempt 2 comes to .* in the finals of GoToDropZ"):
        recheck(tmp_path / "tiny", plan)
    assert differences(Training(tmp_path / "tiny"), plan) == ["the model's source"]
    with pytest.raises(SocialmindError, match="of other lessons than the plan has"):
        recheck(tmp_path / "tiny", tiny_plans.tiny("GoToObject"))


def test_where_the_scoring_was_mended_scores_are_taken_as_they_are_today(
    whole, tiny_plans, tmp_path
):
    plan = tiny_plans.PLAN
    edited(whole, tmp_path)
    path = tmp_path / "tiny" / "attempts" / "2" / "lesson-002.npz"
    record, arrays = archive.load(path)
    faulty = {"score": record["score"] - 0.5, "deviation": 100.0, "finalists": [[1, 100.0]]}
    save_arrays(path, {**record, **faulty}, arrays)
    (found,) = rescore(tmp_path / "tiny", plan)
    assert (found.attempt, found.lesson) == (2, "GoToDropZone")
    assert (found.before, found.now) == (record["score"] - 0.5, record["score"])
    winner = max(record["finalists"], key=lambda one: one[1])
    assert archive.load(path)[0] == {**record, "finalists": [winner]}
    assert rescore(tmp_path / "tiny", plan) == []
    assert recheck(tmp_path / "tiny", plan) == 4


def test_winners_are_judged_in_worlds_that_all_attempts_share(whole, tiny_plans, monkeypatch):
    training, lessons = Training(whole), tiny_plans.PLAN.curriculum().lessons
    met = []
    monkeypatch.setattr(
        rechecking.Winner, "scores", lambda one, seeds: met.append(seeds) or np.array([1.0, 4.0])
    )
    found = in_common_worlds(training, lessons, ["GoToDropZone"], 3)
    assert found == {(1, "GoToDropZone"): 2.5, (2, "GoToDropZone"): 2.5}
    assert met[0] == met[1] == seeds_for(3, "judged", training.manifest.seed, "GoToDropZone")


def test_a_winner_comes_to_the_same_in_the_same_worlds(whole, tiny_plans):
    training, lessons = Training(whole), tiny_plans.PLAN.curriculum().lessons
    found = in_common_worlds(training, lessons, ["GoToObject", "GoToDropZone"], 4)
    assert list(found) == [
        (attempt, lesson) for attempt in (1, 2) for lesson in ("GoToObject", "GoToDropZone")
    ]
    assert found == in_common_worlds(training, lessons, ["GoToObject", "GoToDropZone"], 4)
    one = next(winners(training, lessons))
    assert one.scores([1, 2, 1]).tolist()[::2] == one.scores([1, 1]).tolist()


def test_winners_of_a_cycle_are_those_of_each_time_around(tiny_plans, tmp_path):
    plan = tiny_plans.turned(cycles=2)
    training = Training(plan.train(tmp_path / "turned", workers=1).folder)
    lessons = plan.curriculum().lessons
    found = list(winners(training, lessons))
    assert [(one.lesson.name, one.record["cycle"]) for one in found] == [
        (lesson, cycle) for cycle in (1, 2) for lesson in ("GoToObject", "GoToDropZone")
    ]
    keep(tmp_path / "turned", tmp_path / "kept")
    assert recheck(tmp_path / "kept" / "turned", plan) == 4
    last = found[2].scores(seeds_for(2, "judged", plan.seed, "GoToObject")).mean()
    assert in_common_worlds(training, lessons, ["GoToObject"], 2) == {(1, "GoToObject"): last}
