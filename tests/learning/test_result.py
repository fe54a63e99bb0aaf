"""Reading a training's folder, and its figure."""

import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, learn
from socialmind.learning.curve import draw_curve, write_curve


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


def test_the_figure_has_a_panel_for_each_lesson_and_a_line_for_each_attempt():
    rows = [
        {"attempt": attempt, "lesson": name, "cycle": cycle, "generation": generation,
         "best": attempt + generation / 10}
        for attempt in (1, 2, 3)
        for name in ("Go", "Turn", "Top", "Again")
        for cycle in ((1, 2) if name == "Again" else (1,))
        for generation in (1, 2)
    ]  # fmt: skip
    figure = draw_curve(pd.DataFrame(rows))
    panels = [axes for axes in figure.axes if axes.get_visible()]
    assert [axes.get_title("left") for axes in panels] == ["Go", "Turn", "Top", "Again"]
    assert [len(axes.lines) for axes in panels] == [3, 3, 3, 3]
    assert panels[0].lines[1].get_ydata().tolist() == [2.1, 2.2]
    assert panels[3].lines[0].get_xdata().tolist() == [1, 2, 3, 4]
    assert len({line.get_color() for line in panels[0].lines}) == 3


def test_seconds_do_not_count_in_the_hash(tmp_path):
    curve = pd.DataFrame({"attempt": [1], "best": [0.5], "seconds": [0.1]})
    first = write_curve(curve, tmp_path / "curve.parquet")
    assert pd.read_parquet(tmp_path / "curve.parquet").equals(curve)
    assert write_curve(curve.assign(seconds=9.0), tmp_path / "curve.parquet") == first
    assert write_curve(curve.assign(best=0.6), tmp_path / "curve.parquet") != first
    assert first["columns"] == {"attempt": "int64", "best": "double"}
