"""The curve of a training as a table and as a figure."""

import pandas as pd

from socialmind.learning.training.curve import draw_curve, write_curve


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
    assert [len(axes.lines) for axes in panels] == [4, 4, 4, 4]  # and the median
    assert panels[0].lines[1].get_ydata().tolist() == [2.1, 2.2]
    assert panels[3].lines[0].get_xdata().tolist() == [1, 2, 3, 4]
    assert panels[0].lines[3].get_ydata().tolist() == [2.1, 2.2]
    assert len({line.get_color() for line in panels[0].lines}) == 2  # attempts are alike


def test_seconds_do_not_count_in_the_hash(tmp_path):
    curve = pd.DataFrame({"attempt": [1], "best": [0.5], "seconds": [0.1]})
    first = write_curve(curve, tmp_path / "curve.parquet")
    assert pd.read_parquet(tmp_path / "curve.parquet").equals(curve)
    assert write_curve(curve.assign(seconds=9.0), tmp_path / "curve.parquet") == first
    assert write_curve(curve.assign(best=0.6), tmp_path / "curve.parquet") != first
    assert first["columns"] == {"attempt": "int64", "best": "double"}
