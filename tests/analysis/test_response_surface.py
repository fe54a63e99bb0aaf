"""The response surface: its page and figure, of runs that are made up, and of those kept."""

from pathlib import Path

import pandas as pd

from socialmind.experiments.studies import Way, topics
from socialmind.sources.loading import load_file

TOPIC = topics()["response_surface"]
KEPT = Path(TOPIC) / "results" / "response-surface-runs.csv"
surface = load_file(TOPIC / "surface.py")


def made_up(seeds=4):
    """Runs whose artisans are a fiftieth of the price, and one more for each seed."""
    rows = [
        {"tool_price": p, "demand_intensity": d, "replicate": s, "seed": s,
         "settled": p / 50 + s + (d == 4.0), "before": p / 50 + s + 0.5 * (s == 0)}
        for p in surface.GRID["tool_price"]
        for d in surface.GRID["demand_intensity"]
        for s in range(seeds)
    ]  # fmt: skip
    return pd.DataFrame(rows)


def test_its_page_tells_what_runs_come_to():
    runs = made_up()
    found = surface.estimates(runs, ["tool_price", "demand_intensity"], "settled")
    text = "\n".join(surface.lines(runs, found))
    assert "| demand intensity | price 50 | price 100 |" in text
    assert "| 0.25 | 2.5 (" in text and "| 4 | 3.5 (" in text
    assert "| 400 | +1.00 (+1.00 … +1.00) |" in text
    assert "25 intervals leave 0 out" in text


def test_its_figure_is_a_map_and_curves_with_units():
    runs = made_up()
    found = surface.estimates(runs, ["tool_price", "demand_intensity"], "settled")
    figure = surface.draw(found, surface.labels_here(50_000))
    left, right = figure.axes[:2]
    assert left.get_xlabel() == "price of a tool (wheat a tool)"
    assert left.get_ylabel() == "demand intensity (demand a signal)"
    assert " ".join(right.get_ylabel().split()).endswith("of the last 50,000 ticks (agents)")
    assert "4 runs a point" in figure._supxlabel.get_text()


def test_what_is_kept_of_it_is_whole(tmp_path):
    written = {path.name for path in surface.write_surface(Way.KEPT, tmp_path)}
    assert {"response-surface.png", "response-surface.md", "response-surface.csv"} <= written
    runs = pd.read_csv(KEPT)
    (size,) = set(runs.groupby(["tool_price", "demand_intensity"]).size())
    assert size in (surface.SEEDS, surface.QUICK_SEEDS)
    page = (Path(TOPIC) / "results" / "response-surface.md").read_text()
    assert (tmp_path / "response-surface.md").read_text() == page
