"""The figures of models of societies, drawn from short runs and from the beginning."""

import io
import warnings
from types import SimpleNamespace

import pandas as pd
import pytest
from matplotlib.text import Text

from socialmind.catalogue import load_figures, load_model

CASES = [
    ("thresholds", {}, "thresholds", 3),
    ("thresholds", {"n_tasks": 7, "n_workers": 1}, "thresholds", 5),
    ("farmers_artisans_traders", {}, "villages", 9),
    ("farmers_artisans_traders", {"n_villages": 1, "n_agents": 1}, "villages", 3),
    ("flocking", {}, "flocking", 3),
    ("flocking", {"n_birds": 1, "world_size": 1}, "flocking", 3),
    ("schelling", {}, "segregation", 3),
    ("schelling", {"n_agents": 0}, "segregation", 3),
    ("wolves_sheep", {}, "numbers", 2),
    ("wolves_sheep", {"n_sheep": 0, "n_wolves": 0}, "numbers", 2),
    ("herds", {}, "herds", 4),
    ("herds", {"n_cows": 1}, "herds", 4),
    ("ant_foraging", {}, "ants", 4),
    ("ant_foraging", {"bridge": True, "n_ants": 1, "leaving": 0.0}, "ants", 4),
    ("termites", {}, "piles", 5),
    ("termites", {"density": 0.0, "n_termites": 1, "world_size": 3}, "piles", 5),
    ("wolf_cow", {}, "wolf_cow", 3),
    ("wolf_cow", {"n_bulls": 0, "n_wolves": 0}, "wolf_cow", 3),
]


@pytest.mark.filterwarnings("ignore:The behavior of DataFrame concatenation:FutureWarning")
@pytest.mark.parametrize("ticks", [(0, 50, 100, 300), (0,)], ids=["run", "start"])
@pytest.mark.parametrize(("name", "parameters", "figure", "panels"), CASES)
def test_figures_are_drawn(name, parameters, figure, panels, ticks):
    society = load_model(name)(1, **parameters)
    series, agents = [], []
    for tick in ticks:
        society.advance(tick - society.tick)
        series.append({"tick": tick, **society.series()})
        agents.append(pd.DataFrame({"tick": tick, **society.agents()}))
    run = SimpleNamespace(
        series=pd.DataFrame(series),
        agents=pd.concat(agents, ignore_index=True),
        parameters=society.parameter_values(),
        seed=1,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn = load_figures(load_model(name).folder()).draw(run)
        drawn[figure].savefig(io.BytesIO(), format="pdf")
    assert list(drawn) == [figure]
    assert len(drawn[figure].axes) == panels
    texts = [text for text in drawn[figure].findobj(Text) if text.get_text().strip()]
    assert min(text.get_fontsize() for text in texts) >= 7
