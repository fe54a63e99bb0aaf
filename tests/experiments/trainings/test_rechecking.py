"""Judging what is kept of a training again."""

import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.trainings.rechecking import recheck, rescore
from socialmind.experiments.trainings.store import differences, keep
from socialmind.learning import Training
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
    save_arrays(path, {**record, "score": record["score"] - 0.5}, arrays)
    (found,) = rescore(tmp_path / "tiny", plan)
    assert (found.attempt, found.lesson) == (2, "GoToDropZone")
    assert (found.before, found.now) == (record["score"] - 0.5, record["score"])
    assert archive.load(path)[0] == record
    assert rescore(tmp_path / "tiny", plan) == []
    assert recheck(tmp_path / "tiny", plan) == 4
