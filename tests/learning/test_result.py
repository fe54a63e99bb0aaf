"""Reading a training's folder, and its figure."""

import pytest

from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, learn


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
    with pytest.raises(SocialmindError, match="attempt 1 has not finished Turn"):
        training.best("Turn")
