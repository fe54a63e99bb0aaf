"""Keeping trainings small, going on from what is kept, and judging it again."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_file
from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, archive, resume

COLLECT = Path(__file__).parents[2] / "analysis" / "collect"
trainings = load_file(COLLECT / "trainings.py")
results = load_file(COLLECT / "results.py")
rechecking = load_file(COLLECT / "recheck.py")

SETTINGS = {"population": 6, "elite": 1}


def tiny(*names, generations=4):
    """A plan of some lessons of the curriculum that take no time."""
    lessons = [
        replace(
            one, ticks=40, repetitions=1, generations=generations, finals=2, settings=SETTINGS,
            budget=None,
        )
        for one in trainings.SIX
        if one.name in names
    ]  # fmt: skip
    plan = trainings.PLANS["hierarchy"]
    return replace(plan, attempts=2, curriculum=lambda: Curriculum(lessons))


PLAN = tiny("GoToObject", "GoToDropZone")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A training that was never stopped."""
    folder = tmp_path_factory.mktemp("whole") / "tiny"
    trainings.train("tiny", folder, PLAN, workers=1)
    return folder


@pytest.fixture
def stopped(tmp_path):
    """The same training, stopped within the second lesson of its second attempt."""
    folder = tmp_path / "stopped" / "tiny"

    def stop(news, left):
        if (news.attempt, news.lesson.name, news.generation) == (2, "GoToDropZone", 2):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        trainings.train("tiny", folder, PLAN, workers=1, on_generation=stop)
    return folder


def same(one, other):
    """Whether two trainings came to the same curves and minds."""
    curves = [training.curve.drop(columns="seconds") for training in (one, other)]
    minds = [
        {
            name: skill.genome
            for number in training.attempts
            for name, skill in training.mind(number).skills.items()
            if skill.genome is not None
        }
        for training in (one, other)
    ]
    assert curves[0].equals(curves[1])
    assert minds[0].keys() == minds[1].keys()
    return all(np.array_equal(minds[0][name], minds[1][name]) for name in minds[0])


def test_what_is_kept_reads_as_the_training(whole, tmp_path):
    kept = Training(results.keep(whole, tmp_path))
    assert same(kept, Training(whole))
    assert kept.lessons.equals(Training(whole).lessons)
    assert (kept.manifest.status, kept.manifest.finished) == ("finished", 2)
    assert str(whole.parent) not in (tmp_path / "tiny" / "manifest.json").read_text()
    assert not list(tmp_path.rglob("mind-attempt-*"))
    assert not list(tmp_path.rglob("curve.parquet"))


def test_finished_lessons_are_kept_as_they_come_in(whole, stopped, tmp_path):
    kept = Training(results.keep(stopped, tmp_path))
    assert list(kept.lessons["attempt"]) == [1, 1, 2]
    assert (kept.manifest.status, kept.manifest.finished) == ("interrupted", 1)
    _, arrays = archive.load(tmp_path / "tiny" / "attempts" / "2" / "checkpoint.npz")
    assert not [name for name in arrays if name.startswith("teaching/")]
    before = (tmp_path / "tiny" / "attempts" / "1" / "lesson-001.npz").stat().st_mtime_ns
    results.keep(whole, tmp_path)
    assert same(Training(tmp_path / "tiny"), Training(whole))
    assert (tmp_path / "tiny/attempts/1/lesson-001.npz").stat().st_mtime_ns == before
    results.keep(stopped, tmp_path)  # which knows less, and takes nothing away
    assert same(Training(tmp_path / "tiny"), Training(whole))


def test_a_training_goes_on_from_what_is_kept_as_if_never_stopped(whole, stopped, tmp_path):
    results.keep(stopped, tmp_path / "kept")
    assert results.take_out("tiny", tmp_path / "again" / "tiny", tmp_path / "kept")
    resume(tmp_path / "again" / "tiny", lessons=PLAN.curriculum(), workers=1)
    assert same(Training(tmp_path / "again" / "tiny"), Training(whole))
    assert not results.take_out("other", tmp_path / "other", tmp_path / "kept")


def test_another_training_of_the_name_is_not_kept_over_it(whole, tmp_path):
    results.keep(whole, tmp_path / "kept")
    other = tmp_path / "tiny"
    trainings.train("tiny", other, tiny("GoToObject", generations=1), workers=1)
    with pytest.raises(SocialmindError, match="of other lessons, another mind, model or seed"):
        results.keep(other, tmp_path / "kept")


def test_it_is_said_in_what_a_training_differs_from_its_plan(whole):
    training = Training(whole)
    assert results.differences(training, PLAN) == []
    assert results.differences(training, tiny("GoToObject")) == ["the lessons"]
    other = replace(PLAN, mind=trainings.monolith)
    assert results.differences(training, other) == ["the mind to begin from"]


# Judging again ---------------------------------------------------------------------------------


def edited(whole, home):
    """Keep a training whose model's files are said to be others."""
    path = results.keep(whole, home) / "manifest.json"
    source = Training(whole).manifest.model["source_sha256"]
    path.write_text(path.read_text().replace(source, "0" * 64))
    return Training(path.parent)


def test_a_model_that_does_the_same_takes_the_trainings_over(whole, tmp_path):
    training = edited(whole, tmp_path)
    assert results.differences(training, PLAN) == ["the model's source"]
    assert rechecking.recheck("tiny", PLAN, tmp_path) == 4
    assert results.differences(Training(tmp_path / "tiny"), PLAN) == []


def test_one_that_does_not_is_refused(whole, tmp_path):
    edited(whole, tmp_path)
    path = tmp_path / "tiny" / "attempts" / "2" / "lesson-002.npz"
    record, arrays = archive.load(path)
    archive.save(path, {**record, "score": record["score"] + 1e-9}, arrays)
    with pytest.raises(SocialmindError, match=r"attempt 2 comes to .* in the finals of GoToDropZ"):
        rechecking.recheck("tiny", PLAN, tmp_path)
    assert results.differences(Training(tmp_path / "tiny"), PLAN) == ["the model's source"]
    with pytest.raises(SocialmindError, match="of other lessons than the plan has"):
        rechecking.recheck("tiny", tiny("GoToObject"), tmp_path)
