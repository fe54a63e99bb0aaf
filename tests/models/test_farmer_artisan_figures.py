"""The figures of the farmer-artisan society, drawn from small tables made by hand."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from coglogo_py import CognitiveScheme, Cogniton
from coglogo_py.decision import BiasedWeightedStochastic
from socialmind.catalogue import load_figures

FOLDER = Path(__file__).parents[2] / "models" / "farmer_artisan"
PLANS = ("TradeWheatForTools", "TradeToolsForWheat", "GrowWheat", "ProduceTools")
SCHEME = CognitiveScheme(
    "humans",
    tuple(Cogniton(f"opens {plan}", conditional=(plan,)) for plan in PLANS),
    decision_maker=BiasedWeightedStochastic(2.6),
)


@pytest.fixture(scope="module")
def figures() -> ModuleType:
    module = load_figures(FOLDER)
    assert module is not None
    return module


def people(tick: int, leanings: list[float], land: bool = True) -> pd.DataFrame:
    """One recorded tick: a row for each leaning, Farmer being the leaning and Artisan its minus."""
    n = len(leanings)
    table = pd.DataFrame({"tick": tick, "agent": range(n)})
    table["x"] = np.linspace(-16.5, 16.4, n)
    table["y"] = 3.0
    table["plan"] = pd.array([PLANS[i % 4] if tick else None for i in range(n)], dtype="str")
    table["farmer"] = leanings
    table["artisan"] = [-leaning for leaning in leanings]
    table["wheat"] = 800.0
    table["tools"] = 10.0
    for column, value in (
        ("land_x", -16),
        ("land_y", 16),
        ("land_tools", 0),
        ("land_wheat", 25500),
    ):
        table[column] = pd.array([value if land else None] * n, dtype="Int64")
    table["cogniton_ToolStock"] = np.nan
    table["cogniton_Farmer"] = table["farmer"]
    table["cogniton_Artisan"] = table["artisan"]
    table["weight_TradeWheatForTools"] = 1.0
    table["weight_TradeToolsForWheat"] = np.nan
    table["weight_GrowWheat"] = 5.0
    table["weight_ProduceTools"] = 3.0
    return table


def series(agents: pd.DataFrame, ticks: list[int]) -> pd.DataFrame:
    """The series of some people; 0 where nobody is left."""
    rows = []
    for tick in ticks:
        now = agents[agents["tick"] == tick]
        alive = len(now)
        rows.append(
            {
                "tick": tick,
                "population": alive,
                "farmers": int((now["farmer"] > now["artisan"]).sum()),
                "artisans": int((now["farmer"] < now["artisan"]).sum()),
                "undecided": int((now["farmer"] == now["artisan"]).sum()),
                "wheat": 800.0 * alive,
                "tools": 10.0 * alive,
                "village_wheat": 8350.0,
                "village_tools": 50.0,
                "wheat_demand": 0.0,
                "tool_demand": 0.0,
                "specialisation": 0.5 if now["land_x"].notna().any() else float("nan"),
                "idle": 0,
            }
        )
    return pd.DataFrame(rows)


def recorded(
    agents: pd.DataFrame, ticks: list[int] | None = None, scheme: object = SCHEME
) -> SimpleNamespace:
    """A run as its reader would give it."""
    return SimpleNamespace(
        series=series(agents, ticks or sorted({int(tick) for tick in agents["tick"]})),
        agents=agents,
        parameters={"world_size": 33, "n_villages": 1},
        scheme=scheme,
    )


def usual() -> SimpleNamespace:
    return recorded(
        pd.concat(
            [
                people(0, [0.0, 0.0, 0.0], land=False),
                people(10, [2.0, -1.0, 0.5]),
                people(20, [20.0, -9.0, 0.5]),
            ],
            ignore_index=True,
        )
    )


def died_out() -> SimpleNamespace:
    agents = pd.concat([people(0, [0.0, 0.0]), people(10, [1.0])], ignore_index=True)
    return recorded(agents, ticks=[0, 10, 20])


def nobody() -> SimpleNamespace:
    return recorded(people(0, [0.0]).iloc[:0], ticks=[0, 1])


def crowd() -> SimpleNamespace:
    run = recorded(people(30_000, [float(lean) for lean in np.linspace(-30, 30, 6000)]))
    run.parameters = {"world_size": 2087, "n_villages": 4000}
    return run


CASES: dict[str, Callable[[], SimpleNamespace]] = {
    "usual": usual,
    "one person, one tick": lambda: recorded(people(0, [0.0], land=False)),
    "no artisans": lambda: recorded(people(5, [1.0, 2.0])),
    "all died": died_out,
    "nobody recorded": nobody,
    "no scheme": lambda: recorded(people(5, [1.0, -2.0]), scheme=None),
    "a crowd": crowd,
}


@pytest.fixture(params=CASES, ids=lambda name: name.replace(" ", "-"))
def drawn(request: pytest.FixtureRequest, figures: ModuleType) -> Iterator[dict[str, Figure]]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = figures.draw(CASES[request.param]())
        for figure in found.values():
            figure.savefig(io.BytesIO(), format="pdf")
        yield found


def data_panels(figure: Figure) -> list[mpl.axes.Axes]:
    """The panels that show data: neither switched off nor a colour scale."""
    return [axes for axes in figure.axes if axes.axison]


def test_all_four_are_drawn_at_journal_width(drawn: dict[str, Figure]) -> None:
    assert list(drawn) == ["stocks", "population", "lands", "mind"]
    for figure in drawn.values():
        width = figure.get_size_inches()[0] * 25.4
        assert 84.9 <= width <= 180.1


def test_type_is_at_least_seven_points(drawn: dict[str, Figure]) -> None:
    for figure in drawn.values():
        sizes = [text.get_fontsize() for text in figure.findobj(Text) if text.get_text().strip()]
        assert min(sizes) >= 7


def test_axes_are_labelled_with_units(drawn: dict[str, Figure]) -> None:
    for axes in drawn["stocks"].axes:
        assert axes.get_ylabel() in ("wheat (units)", "tools (number)")
    for name in ("stocks", "population"):
        assert "ticks)" in drawn[name].axes[-1].get_xlabel()
    for axes in drawn["population"].axes:
        assert axes.get_ylabel()
    assert drawn["lands"].get_supxlabel().startswith("x (patches")
    assert drawn["lands"].get_supylabel() == "y (patches)"
    for axes in data_panels(drawn["mind"]):
        assert axes.get_xlabel()


def test_settings_of_the_user_are_left_alone(figures: ModuleType) -> None:
    before = dict(mpl.rcParams)
    figures.draw(usual())
    assert dict(mpl.rcParams) == before


def test_stocks_show_the_series(figures: ModuleType) -> None:
    run = usual()
    panels = figures.draw(run)["stocks"].axes
    for axes, column in zip(
        panels, ("wheat", "tools", "village_wheat", "village_tools"), strict=True
    ):
        assert axes.lines[0].get_ydata().tolist() == run.series[column].tolist()


def test_deaths_add_the_population(figures: ModuleType) -> None:
    names = {text.get_text() for text in figures.draw(died_out())["population"].axes[0].texts}
    assert names == {"population", "farmers", "artisans", "undecided"}
    names = {text.get_text() for text in figures.draw(usual())["population"].axes[0].texts}
    assert names == {"farmers", "artisans", "undecided"}


def test_lands_are_coloured_from_wheat_to_tools(figures: ModuleType) -> None:
    agents = people(20, [1.0, -1.0, 0.0])
    agents["land_x"] = pd.array([-5, 0, 5], dtype="Int64")
    agents["land_tools"] = pd.array([0, 25500, 12700], dtype="Int64")
    agents["land_wheat"] = pd.array([25500, 0, 12800], dtype="Int64")
    axes = figures.draw(recorded(agents))["lands"].axes[0]
    assert axes.get_title("left") == "tick 20"
    assert axes.get_xlim() == (-16.5, 16.5)
    assert axes.get_aspect() == 1.0
    land = axes.collections[0]
    np.testing.assert_allclose(land.get_array(), [0.0, 1.0, 12700 / 25500])
    low, middle, high = (land.cmap(share)[:3] for share in (0.0, 0.5, 1.0))
    assert low[2] > low[0]  # more blue than red
    assert high[0] > high[2]
    assert min(middle) > 0.75  # pale


def test_a_large_world_shows_its_middle(figures: ModuleType) -> None:
    figure = figures.draw(crowd())["lands"]
    assert figure.axes[0].get_xlim() == (-49.5, 49.5)
    assert "99 of 2,087" in figure.get_supxlabel()


@pytest.mark.parametrize(
    ("ticks", "chosen"),
    [
        ([7], [7]),
        (list(range(0, 500_001, 10_000)), [0, 30_000, *range(100_000, 500_001, 50_000)]),
        (list(range(0, 101)), list(range(0, 101, 10))),
        (list(range(0, 1_000_001, 1_000)), [0, 27_000, *range(100_000, 500_001, 50_000)]),
    ],
)
def test_chosen_ticks(figures: ModuleType, ticks: list[int], chosen: list[int]) -> None:
    assert figures.chosen_ticks(ticks) == chosen


def test_minds_shown_are_typical(figures: ModuleType) -> None:
    agents = people(20, [30.0, 20.0, 10.0, -25.0, 0.1])
    headings = [
        part.get_suptitle().split("   ")[1]
        for part in figures.draw(recorded(agents))["mind"].subfigs[:-1]
    ]
    assert headings == [
        "Typical farmer: agent 2, tick 20",
        "Typical artisan: agent 3, tick 20",
        "Least specialised: agent 4, tick 20",
    ]


def test_probabilities_are_the_decision_makers(figures: ModuleType) -> None:
    weights = {
        "TradeWheatForTools": 1.0,
        "TradeToolsForWheat": float("nan"),
        "GrowWheat": 5.0,
        "ProduceTools": 3.0,
    }
    chances = figures.probabilities(weights, SCHEME)
    # Shares 5/9, 3/9, 1/9 by rank; C^(1/2.6), equation of the biased decision maker.
    best = 100 * (5 / 9) ** (1 / 2.6)
    second = 100 * (8 / 9) ** (1 / 2.6) - best
    assert chances["GrowWheat"] == pytest.approx(best)
    assert chances["ProduceTools"] == pytest.approx(second)
    assert chances["TradeWheatForTools"] == pytest.approx(100 - best - second)
    assert np.isnan(chances["TradeToolsForWheat"])


def test_what_is_missing_is_said(figures: ModuleType) -> None:
    def words(run: SimpleNamespace) -> set[str]:
        return {text.get_text() for text in figures.draw(run)["mind"].findobj(Text)}

    assert {"inactive", "closed"} <= words(recorded(people(5, [1.0])))
    assert "no scheme" in words(recorded(people(5, [1.0]), scheme=None))
