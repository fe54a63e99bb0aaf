"""Keeping trainings small, and going on from what is kept."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.trainings import store
from socialmind.experiments.trainings.store import differences, keep, take_out
from socialmind.learning import Training, resume
from socialmind.learning.training import archive
from socialmind.mind.files.layout import layout_file


@pytest.fixture
def stopped(tmp_path, tiny_plans):
    """The same training, stopped within the second lesson of its second attempt."""
    folder = tmp_path / "stopped" / "tiny"

    def stop(news, left):
        if (news.attempt, news.lesson.name, news.generation) == (2, "GoToDropZone", 2):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tiny_plans.PLAN.train(folder, workers=1, on_generation=stop)
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
    kept = Training(keep(whole, tmp_path))
    assert same(kept, Training(whole))
    assert kept.lessons.equals(Training(whole).lessons)
    assert (kept.manifest.status, kept.manifest.finished) == ("finished", 2)
    assert str(whole.parent) not in (tmp_path / "tiny" / "manifest.json").read_text()
    assert not list(tmp_path.rglob("mind-attempt-*"))
    assert not list(tmp_path.rglob("curve.parquet"))


@pytest.mark.parametrize("files", range(1, 8))
def test_keeping_that_was_killed_is_done_again(files, whole, tmp_path, monkeypatch):
    left = [files]

    def killed(save):
        def saved(*arguments, **options):
            left[0] -= 1
            if not left[0]:
                raise KeyboardInterrupt
            return save(*arguments, **options)

        return saved

    with monkeypatch.context() as patched:
        for name in ("save_arrays", "replace_file"):
            patched.setattr(store, name, killed(getattr(store, name)))
        with pytest.raises(KeyboardInterrupt):
            keep(whole, tmp_path)
    assert same(Training(keep(whole, tmp_path)), Training(whole))


def test_an_attempt_that_was_begun_to_be_kept_is_kept(whole, stopped, tmp_path):
    keep(stopped, tmp_path)
    shutil.rmtree(tmp_path / "tiny" / "attempts" / "2")
    (tmp_path / "tiny" / "attempts" / "2").mkdir()
    assert same(Training(keep(whole, tmp_path)), Training(whole))


def test_taking_out_that_was_killed_is_done_again(whole, tmp_path, monkeypatch):
    kept = keep(whole, tmp_path)

    def part(source, target):
        target.mkdir()
        shutil.copyfile(source / "manifest.json", target / "manifest.json")
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(store.shutil, "copytree", part)
        with pytest.raises(KeyboardInterrupt):
            take_out(kept, tmp_path / "out")
    assert not (tmp_path / "out").exists()
    assert take_out(kept, tmp_path / "out") and same(Training(tmp_path / "out"), Training(whole))


def test_finished_lessons_are_kept_as_they_come_in(whole, stopped, tmp_path):
    kept = Training(keep(stopped, tmp_path))
    assert list(kept.lessons["attempt"]) == [1, 1, 2]
    assert (kept.manifest.status, kept.manifest.finished) == ("interrupted", 1)
    _, arrays = archive.load(tmp_path / "tiny" / "attempts" / "2" / "checkpoint.npz")
    assert not [name for name in arrays if name.startswith("teaching/")]
    before = (tmp_path / "tiny" / "attempts" / "1" / "lesson-001.npz").stat().st_mtime_ns
    keep(whole, tmp_path)
    assert same(Training(tmp_path / "tiny"), Training(whole))
    assert (tmp_path / "tiny/attempts/1/lesson-001.npz").stat().st_mtime_ns == before
    keep(stopped, tmp_path)  # which knows less, and takes nothing away
    assert same(Training(tmp_path / "tiny"), Training(whole))


def test_a_training_goes_on_from_what_is_kept_as_if_never_stopped(
    whole, stopped, tiny_plans, tmp_path
):
    keep(stopped, tmp_path / "kept")
    assert take_out(tmp_path / "kept" / "tiny", tmp_path / "again" / "tiny")
    resume(tmp_path / "again" / "tiny", lessons=tiny_plans.PLAN.curriculum(), workers=1)
    assert same(Training(tmp_path / "again" / "tiny"), Training(whole))
    assert not take_out(tmp_path / "kept" / "other", tmp_path / "other")


def test_what_has_fewer_lessons_and_more_attempts_takes_nothing_away(whole, tiny_plans, tmp_path):
    more = tiny_plans.tiny("GoToObject", "GoToDropZone", "Avoid")
    longer = Training(shutil.copytree(whole, tmp_path / "longer" / "tiny"))
    more.train(longer.folder, workers=1)
    several = shutil.copytree(whole, tmp_path / "several" / "tiny")
    replace(tiny_plans.PLAN, attempts=3).train(several, workers=1)
    keep(longer.folder, tmp_path / "kept")
    kept = Training(keep(several, tmp_path / "kept"))
    assert kept.attempts == [1, 2, 3]
    assert kept.finished == [1, 2]
    assert (kept.manifest.status, kept.manifest.attempts) == ("interrupted", 3)
    assert differences(kept, more) == []
    assert kept.lessons.groupby("attempt").size().tolist() == [3, 3, 2]


def test_another_training_of_the_name_is_not_kept_over_it(whole, tiny_plans, tmp_path):
    keep(whole, tmp_path / "kept")
    other = tmp_path / "tiny"
    tiny_plans.tiny("GoToObject", generations=1).train(other, workers=1)
    with pytest.raises(SocialmindError, match="of other lessons, another mind, model or seed"):
        keep(other, tmp_path / "kept")


def test_it_is_said_in_what_a_training_differs_from_its_plan(whole, tiny_plans, tmp_path):
    training = Training(shutil.copytree(whole, tmp_path / "tiny"))
    assert differences(training, tiny_plans.PLAN) == []
    layout_file(training.folder / "mind").write_text("SKILLS\nGoToDropZone:1:2\n")
    assert differences(training, tiny_plans.PLAN) == []
    assert differences(training, tiny_plans.tiny("GoToObject")) == ["the lessons"]
    other = replace(tiny_plans.PLAN, mind=tiny_plans.monolith)
    assert differences(training, other) == ["the mind to begin from"]
