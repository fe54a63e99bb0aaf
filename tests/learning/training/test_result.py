"""Reading a training's folder, and its figure."""

import pytest

from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, learn
from socialmind.mind import MindDescription


def test_a_training_can_be_read_while_it_goes_on(lesson, robot, tmp_path):
    seen = []

    def look(news, left):
        training = Training(tmp_path / "out")
        curve = training.curve
        seen.append((len(curve), len(training.lessons)))
        assert curve["best"].iloc[-1] == news.best

    two = Curriculum([lesson("Go"), lesson("Turn")], mind=robot)
    learn(None, two, out=tmp_path / "out", on_generation=look)
    assert seen == [(n, 0) for n in range(1, 7)] + [(n, 1) for n in range(7, 13)]


def test_what_is_not_there_is_refused(lesson, robot, tmp_path):
    with pytest.raises(SocialmindError, match="nothing: no such folder"):
        Training(tmp_path / "nothing")
    with pytest.raises(SocialmindError, match=r"holds no manifest\.json"):
        Training(tmp_path)
    (tmp_path / "manifest.json").write_text('{"format": 1, "model": {}}')
    with pytest.raises(SocialmindError, match="not a training's folder; `socialmind run --resume"):
        Training(tmp_path)
    training = Training(learn(None, [lesson("Go")], mind=robot, out=tmp_path / "out"))
    with pytest.raises(SocialmindError, match="attempt 2 has finished no lesson"):
        training.mind(2)
    with pytest.raises(SocialmindError, match="attempt 1 has finished no lesson called Turn"):
        training.mind(after="Turn")
    with pytest.raises(SocialmindError, match="attempt 1 has not finished Turn"):
        training.best("Turn")


def test_minds_are_those_after_each_lesson(lesson, robot, tmp_path):
    two = Curriculum([lesson("Go"), lesson("Turn")], mind=robot)
    training = Training(learn(None, two, out=tmp_path / "out"))
    saved = MindDescription.load(tmp_path / "out" / "mind-attempt-1")
    whole, first = training.mind(), training.mind(after="Go")
    for skill in ("Go", "Turn"):
        assert (whole.skill(skill).genome == saved.skill(skill).genome).all()
    assert (first.skill("Go").genome == saved.skill("Go").genome).all()
    assert first.skill("Turn").genome is None
    assert (training.mind(after="Turn").skill("Turn").genome == whole.skill("Turn").genome).all()


def test_a_curve_has_a_column_for_validation_where_a_lesson_has_it(lesson, robot, tmp_path):
    two = Curriculum([lesson("Go", validation=3), lesson("Turn")], mind=robot)
    curve = Training(learn(None, two, out=tmp_path / "out")).curve
    assert (curve["validated"].notna() == (curve["lesson"] == "Go")).all()
