"""Asked to pause from anywhere, a training ends at its next checkpoint, and loses nothing."""

import json
import platform
from pathlib import Path

import pytest

from socialmind.errors import SocialmindError
from socialmind.learning import (
    Curriculum,
    Cycle,
    Lesson,
    Training,
    TrainingInterrupted,
    learn,
    pause,
)
from socialmind.learning import resume as go_on
from socialmind.learning.training.pausing import REQUEST
from socialmind.runs.folders import hold
from socialmind.sources.loading import load_file


@pytest.fixture(scope="module")
def whole(slopes, robot):
    """Lessons of 3, 3 and 2 generations, the last one in a cycle."""

    def lesson(name, **changes):
        given = {"generations": 3, "repetitions": 2, "settings": {"population": 12}}
        return Lesson(name, slopes.Slope, finals=5, finalists=4, **{**given, **changes})

    known = Cycle([lesson("Again", skill="Go", start="known", generations=2)], cycles=1)
    return Curriculum([lesson("Go"), lesson("Turn"), known], robot)


def digest(folder):
    return load_file(Path(__file__).parents[1] / "slopes.py").digest(folder)


def pausing(folder, after, asker="the studio"):
    """What asks a training to pause after some generations."""
    told = []

    def ask(news, left):
        told.append(news)
        if len(told) == after:
            pause(folder, asker)

    return ask


@pytest.fixture(scope="module")
def undisturbed(whole, tmp_path_factory):
    return digest(learn(None, whole, attempts=2, out=tmp_path_factory.mktemp("out") / "whole"))


@pytest.mark.parametrize(
    ("after", "options"),
    [(2, {"workers": 1}), (3, {"workers": 2}), (8, {"engine": "pymunk", "workers": 2})],
)
def test_paused_after_any_generation_it_goes_on_to_the_same_end(
    whole, undisturbed, tmp_path, after, options
):
    """In the middle of a lesson, before its finals; with threads, and with processes."""
    three, out = whole, tmp_path / "out"
    with pytest.raises(TrainingInterrupted) as paused:
        learn(None, three, attempts=2, out=out, on_generation=pausing(out, after), **options)
    assert str(paused.value).startswith("paused by the studio in attempt 1, ")
    assert (paused.value.asker, paused.value.signal_number) == ("the studio", 2)
    manifest = Training(out).manifest
    assert (manifest.status, manifest.process) == ("interrupted", {})
    # The generation in which it was asked is there, and none behind it.
    assert len(Training(out).curve) == after
    assert not (out / REQUEST).exists()
    go_on(out, lessons=three, workers=options["workers"])
    assert digest(out) == undisturbed


def test_asked_in_the_finals_it_ends_behind_them_and_between_attempts_too(
    whole, undisturbed, tmp_path
):
    three, out = whole, tmp_path / "out"

    def in_lesson(attempt, lesson, result):
        if lesson.name == "Go":
            pause(out)

    with pytest.raises(TrainingInterrupted, match=r"another program in attempt 1, Turn, .* 0"):
        learn(None, three, attempts=2, out=out, on_lesson=in_lesson)
    assert Training(out).lessons["lesson"].tolist() == ["Go"]

    def at_the_end(attempt, lesson, result):
        if lesson.name == "Again":
            pause(out)

    with pytest.raises(TrainingInterrupted, match=r"in attempt 2, Go, after generation 0"):
        go_on(out, lessons=three, on_lesson=at_the_end)
    assert Training(out).manifest.finished == 1
    # Behind the last lesson of the last attempt there is nothing to pause.
    last = []

    def the_very_last(attempt, lesson, result):
        last.append(lesson.name)
        if len(last) == 3:
            pause(out)

    go_on(out, lessons=three, on_lesson=the_very_last)
    assert Training(out).manifest.status == "finished"
    assert not (out / REQUEST).exists()
    assert digest(out) == undisturbed


def test_what_was_asked_of_a_process_that_was_killed_stops_no_other(whole, tmp_path):
    out = tmp_path / "out"
    with pytest.raises(TrainingInterrupted):
        learn(None, whole, out=out, on_generation=pausing(out, 1))
    (out / REQUEST).write_text("the studio\n")
    assert Training(go_on(out, lessons=whole)).manifest.status == "finished"
    assert not (out / REQUEST).exists()


def test_only_what_goes_on_can_be_asked_and_nothing_is_written_elsewhere(whole, tmp_path):
    folder = learn(None, whole, out=tmp_path / "out")
    with pytest.raises(SocialmindError, match="out does not go on, as far as this machine knows"):
        pause(folder)
    with pytest.raises(SocialmindError, match="no such folder"):
        pause(tmp_path / "none")
    (tmp_path / "empty").mkdir()
    with pytest.raises(SocialmindError, match="not a training's folder"):
        pause(tmp_path / "empty")
    # Killed: nobody holds it.
    manifest = json.loads((folder / "manifest.json").read_text())
    there = {"host": platform.node(), "pid": 1}
    changed = json.dumps({**manifest, "status": "running", "process": there})
    (folder / "manifest.json").write_text(changed)
    with pytest.raises(SocialmindError, match="does not go on"):
        pause(folder)
    # Begun by a version that said nothing of its process, and hears no requests.
    del manifest["process"]
    (folder / "manifest.json").write_text(json.dumps({**manifest, "status": "running"}))
    with hold(folder), pytest.raises(SocialmindError, match="press Ctrl-C where it was begun"):
        pause(folder)
    assert not (folder / REQUEST).exists()
    assert not list((tmp_path / "empty").iterdir())


@pytest.mark.parametrize("left", ["folder", "link", "words"])
def test_whatever_lies_in_the_place_of_a_request_is_harmless(whole, tmp_path, left):
    out, told = tmp_path / "out", []
    other = tmp_path / "other.txt"
    other.write_text("mine")

    def ask(news, seconds):
        told.append(news.generation)
        if len(told) == 1 and left == "folder":
            (out / REQUEST).mkdir()
            (out / REQUEST / "mine").write_text("mine")
        if len(told) == 1 and left == "link":
            (out / REQUEST).symlink_to(other)
        if len(told) == 1 and left == "words":
            (out / REQUEST).write_bytes(b"\x1b[2J\xff" * 1000)

    if left == "folder":
        learn(None, whole, out=out, on_generation=ask)
        assert (out / REQUEST / "mine").read_text() == "mine"
    else:
        said = "mine" if left == "link" else "another program"
        with pytest.raises(TrainingInterrupted, match=f"paused by {said} in attempt 1"):
            learn(None, whole, out=out, on_generation=ask)
        assert not (out / REQUEST).exists()
    assert other.read_text() == "mine"


def test_a_manifest_that_names_no_plan_is_refused(whole, tmp_path):
    folder = learn(None, whole, out=tmp_path / "out", generations=1)
    manifest = json.loads((folder / "manifest.json").read_text())
    for plan in (
        {"module": "os; rm", "name": "x"}, {"module": "a.b"}, {"module": "a", "name": "\n"}, [],
    ):  # fmt: skip
        (folder / "manifest.json").write_text(json.dumps({**manifest, "plan": plan}))
        with pytest.raises(SocialmindError, match="plan: found"):
            Training(folder)
