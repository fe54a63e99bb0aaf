"""The study of what the farmer-artisan society depends on: its sweeps and its tables."""

from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.experiments import Sensitivity
from socialmind.experiments.sensitivity.figure import figure_of
from socialmind.experiments.studies import find
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "sensitivity"
SWEEPS, STUDY = (load_file(FOLDER / f"{name}.py") for name in ("sweeps", "study"))


def test_it_varies_round_what_the_thesis_has():
    parameters = load_model("farmer_artisan").parameters
    numbers = {name for name, one in parameters.items() if one.kind in (int, float)}
    assert set(SWEEPS.RANGES) == numbers
    assert {name for name in numbers if parameters[name].kind is int} == set(SWEEPS.WHOLE)
    for name, (low, high) in SWEEPS.RANGES.items():
        if name != "n_villages":
            middle = parameters[name].default
            assert low == pytest.approx(middle / 2, abs=0.5 if name in SWEEPS.WHOLE else None)
            assert high == pytest.approx(1.5 * middle, abs=0.5 if name in SWEEPS.WHOLE else None)


def test_stretches_of_time_are_means_over_runs_with_intervals_over_points():
    # Four runs at two points; artisans of four in the first and the second stretch.
    artisans = [(1, 2), (1, 4), (3, 2), (3, 0)]
    series = pd.DataFrame(
        {
            "run": [run for run in range(4) for _ in range(3)],
            "tick": [0, 10, 20] * 4,
            "artisans": [number for pair in artisans for number in (4, *pair)],
            "tools": [0.0, 4.0, 8.0] * 4,
        }
    ).assign(population=4, wheat=8.0)
    runs = pd.DataFrame({"run": range(4), "point": [0, 0, 1, 1]})
    table = STUDY.windows(SimpleNamespace(series=series, runs=runs), 10)
    share = table[table["output"] == "artisan_share"]
    assert share["mean"].tolist() == [50.0, 50.0]
    assert share["begin"].tolist() == [0, 10] and share["end"].tolist() == [10, 20]
    # Two points, 25 and 75 %: their standard error is 25, and t of one degree of freedom 12.7.
    assert share["low"].tolist()[0] == pytest.approx(50.0 - 12.706 * 25.0, abs=0.01)
    # The end is the mean of both stretches, here: 25 % more to come at one point, 25 % less at the
    # other in the first stretch.
    assert share["to_come"].tolist() == [0.0, 0.0]
    assert share["to_come_high"].tolist()[0] == pytest.approx(12.706 * 25.0, abs=0.01)
    tools = table[table["output"] == "tools_each"]
    assert tools["mean"].tolist() == [1.0, 2.0]
    assert tools[["to_come", "to_come_low", "to_come_high"]].iloc[0].tolist() == [0.5] * 3


def test_both_designs_stand_side_by_side():
    def found(index, values, floor):
        names = list(values)
        table = pd.concat(
            pd.DataFrame(
                {
                    "output": one, "index": index, "parameter": names, "other": "",
                    "value": values.values(), "low": [v - 0.1 for v in values.values()],
                    "high": [v + 0.1 for v in values.values()],
                }
            )
            for one in SWEEPS.OUTPUTS
        )  # fmt: skip
        luck = pd.DataFrame({"output": SWEEPS.OUTPUTS, "floor": floor})
        options = dict.fromkeys(("method", "design", "parameters", "ranges", "outputs"))
        return Sensitivity(**options, table=table, luck=luck, level=0.95, seed=0, notes=())

    both = STUDY.agreement(
        found("mu_star", {"a": 0.3, "b": 2.0, "c": 0.2}, 0.25),
        found("total", {"a": 0.5, "b": 0.9}, 0.1),
    )
    for order, words in (
        (
            [0.9, 0.5],
            "Both order the four alike; they differ on whether it is above luck for: `a`.",
        ),
        ([0.5, 0.9], "They differ in what comes first: `b` screened, `a` by share"),
    ):
        known = both[both["output"] == "wheat_each"].iloc[:2].assign(total=order)
        assert STUDY._compared(known.sort_values("total", ascending=False)).startswith(words)
    rows = both[both["output"] == "wheat_each"].set_index("parameter")
    assert rows.index.tolist() == ["b", "a", "c"]
    assert rows["screened"].tolist() == [True, False, False]
    assert rows["counts"].tolist()[:2] == [True, True] and pd.isna(rows.loc["c", "counts"])


def test_figures_are_drawn_from_the_kept_tables():
    kept = {name: STUDY.kept(name) for name in STUDY.METHODS}
    assert all(len(one.outputs) == 3 for one in kept.values())
    assert len(kept["screening"].parameters) == len(SWEEPS.RANGES)
    names = [text.get_text() for text in figure_of(kept["shares"], STUDY.labels()).legends[0].texts]
    assert "second order" in names and "total order by luck alone" in names


@pytest.mark.study
def test_a_small_version_goes_all_the_way(tmp_path):
    ((study, _),) = find("sensitivity")
    written = study.quick(tmp_path)
    assert all(path.is_file() for path in written)
    again = {path.name: path.read_bytes() for path in written if path.suffix == ".csv"}
    for path in study.quick(tmp_path):  # from the same sweeps
        assert again.get(path.name, b"") in (b"", path.read_bytes())
    both = pd.read_csv(tmp_path / "agreement.csv")
    assert set(both["parameter"]) == set(SWEEPS.RANGES)
    assert both.groupby("output")["total"].count().tolist() == [len(SWEEPS.COUNTING)] * 3
