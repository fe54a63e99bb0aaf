"""The figures of foraging robots, drawn from a short run."""

import warnings

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.text import Text

from socialmind.catalogue import load_figures, load_model
from socialmind.experiments import Run, run
from socialmind.sources.folders import model_folder

FOLDER = model_folder("foraging")
FIGURES = load_figures(FOLDER)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    out = tmp_path_factory.mktemp("runs") / "run"
    return Run(run(load_model("foraging"), 400, 1, every=10, agents_every=10, out=out))


@pytest.fixture(scope="module")
def course(recorded):
    return FIGURES.course_of(recorded)


def test_the_repeated_run_is_the_recorded_one(recorded, course):
    agents = recorded.agents
    assert course.tick.tolist() == sorted(set(agents["tick"]))
    for name in ("x", "y", "delivered"):
        mine = getattr(course, name)
        assert mine.shape == (41, 4)
        assert np.array_equal(mine.ravel(), agents[name].to_numpy())
    assert course.covered.tolist() == recorded.series["covered"].tolist()
    assert course.squares == 24**2


def test_figures_are_drawn_at_journal_width_and_legible(recorded, tmp_path):
    before = dict(mpl.rcParams)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures = FIGURES.draw(recorded)
        for name, figure in figures.items():
            figure.savefig(tmp_path / f"{name}.pdf")
    assert list(figures) == ["paths", "progress"]
    for figure in figures.values():
        assert 84.9 <= figure.get_size_inches()[0] * 25.4 <= 180.1
        texts = [text for text in figure.findobj(Text) if text.get_text().strip()]
        assert min(text.get_fontsize() for text in texts) >= 7
    legend = [text.get_text() for text in figures["paths"].legends[0].get_texts()]
    assert legend == [*(f"robot {n}" for n in range(4)), "an object gripped", "drop zone"]
    labels = [axes.get_ylabel() for axes in figures["progress"].axes]
    assert labels == ["objects (number)", "area seen (%)", "signal of robot"]
    assert dict(mpl.rcParams) == before
