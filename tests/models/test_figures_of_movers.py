"""The figures of the models whose agents move by hierarchies of skills, drawn from short runs."""

import io
import warnings
from types import SimpleNamespace

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Text

from socialmind.catalogue import load_figures, load_model

CASES = [
    ("braitenberg", {}, ["paths", "distance"]),
    ("braitenberg", {"share_fleeing": 1.0, "n_vehicles": 1}, ["paths", "distance"]),
    ("braitenberg", {"share_inhibiting": 0.5, "n_lights": 1}, ["paths", "distance"]),
    ("boids", {}, ["snapshots", "order"]),
    ("boids", {"n_boids": 1}, ["snapshots", "order"]),
    ("fields_and_flocks", {}, ["maps", "outcome"]),
    ("fields_and_flocks", {"n_shepherds": 0, "n_farmers": 1}, ["maps", "outcome"]),
]


def recorded(name, ticks, **parameters):
    """Return a run as its reader would give it."""
    society = load_model(name)(1, **parameters)
    series, agents = [], []
    for tick in ticks:
        society.advance(tick - society.tick)
        series.append({"tick": tick, **society.series()})
        agents.append(pd.DataFrame({"tick": tick, **society.agents()}))
    return SimpleNamespace(
        series=pd.DataFrame(series),
        agents=pd.concat(agents, ignore_index=True),
        parameters=society.parameter_values(),
    )


@pytest.mark.filterwarnings("ignore:The behavior of DataFrame concatenation:FutureWarning")
@pytest.mark.parametrize("ticks", [(0, 5, 10, 20, 40), (0,)], ids=["run", "start"])
@pytest.mark.parametrize(("name", "parameters", "expected"), CASES)
def test_figures_are_drawn_at_journal_width_and_legible(name, parameters, expected, ticks):
    run = recorded(name, ticks, **parameters)
    before = dict(mpl.rcParams)
    module = load_figures(load_model(name).folder())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures = module.draw(run)
        for figure in figures.values():
            figure.savefig(io.BytesIO(), format="pdf")
    assert list(figures) == expected
    for figure in figures.values():
        assert 84.9 <= figure.get_size_inches()[0] * 25.4 <= 180.1
        texts = [text for text in figure.findobj(Text) if text.get_text().strip()]
        assert min(text.get_fontsize() for text in texts) >= 7
        labels = [axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()]
        assert labels
        assert all(label.endswith(("(patches)", "(ticks)")) for label in labels)
        assert figure.axes[0].get_ylabel()
    assert dict(mpl.rcParams) == before


def test_distance_shows_the_series():
    run = recorded("braitenberg", (0, 10, 20))
    seekers, avoiders = (
        load_figures(load_model("braitenberg").folder()).draw(run)["distance"].axes[0].lines
    )
    assert seekers.get_ydata().tolist() == run.series["seekers_distance"].tolist()
    assert avoiders.get_ydata().tolist() == run.series["avoiders_distance"].tolist()


def test_a_path_over_the_edge_is_drawn_at_both_edges():
    run = recorded("braitenberg", (0, 1), n_vehicles=1, share_fleeing=1.0)
    run.agents[["x", "y"]] = [[16.0, 0.0], [-16.0, 0.0]]
    figure = load_figures(load_model("braitenberg").folder()).draw(run)["paths"]
    lines = figure.axes[1].collections[-1].get_segments()
    assert [line.tolist() for line in lines] == [
        [[16.0, 0.0], [17.0, 0.0]],
        [[-17.0, 0.0], [-16.0, 0.0]],
    ]


def test_boids_are_coloured_by_the_skill_that_leads():
    run = recorded("boids", (0, 1), n_boids=3)
    names = ["cohesion_influence", "separation_influence", "alignment_influence"]
    run.agents.loc[run.agents["tick"] == 1, names] = [[0.2, 0.1, 0.0], [0, 0, 1], [0, 0, 0]]
    module = load_figures(load_model("boids").folder())
    arrows = module.draw(run)["snapshots"].axes[-1].collections[0]
    found = [mpl.colors.to_hex(colour) for colour in arrows.get_facecolor()]
    skills = module.SKILLS
    assert found == [skills["cohesion"], skills["alignment"], module.paper.GREY]


@pytest.mark.parametrize(
    ("recorded_ticks", "chosen"),
    [(range(0, 501, 10), [0, 20, 60, 500]), ([7], [7] * 4), ([0, 300], [0, 0, 0, 300])],
)
def test_snapshots_are_taken_early_and_at_the_end(recorded_ticks, chosen):
    module = load_figures(load_model("boids").folder())
    assert module.chosen_ticks(np.array(recorded_ticks)) == chosen
