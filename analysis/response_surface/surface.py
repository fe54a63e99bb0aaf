"""The runs of the grid, what they come to, and whether the societies had settled."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from socialmind.catalogue import load_model
from socialmind.documents.methods import methods
from socialmind.drawing import style as paper
from socialmind.experiments import Sweep, designs, resume_sweep, sweep
from socialmind.experiments.figures.design import design_of
from socialmind.experiments.figures.estimates import Estimates, estimates
from socialmind.experiments.figures.labels import Labels
from socialmind.experiments.figures.layouts import put_caption, response_figure
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.studies import Way, write_page

NAME = "response-surface"
KEPT = Path(__file__).parent / "results"
PRICE, INTENSITY = "tool_price", "demand_intensity"
GRID = {PRICE: [50.0, 100.0, 167.0, 250.0, 400.0], INTENSITY: [0.25, 0.5, 1.01, 2.0, 4.0]}
"""Both ways from the model's defaults, 167 and 1.01."""
SEEDS, TICKS, EVERY = 20, 300_000, 2_500
QUICK_SEEDS, QUICK_TICKS, QUICK_EVERY = 5, 96_000, 800
WINDOW = 20
"""Records of a mean: the last sixth of a run; `before` is the mean of the sixth before."""
MEASURES = {
    "settled": f"mean(artisans[-{WINDOW}:])",
    "before": f"mean(artisans[-{2 * WINDOW}:-{WINDOW}])",
}
SWEEP = "response_surface_sweep"


def write_surface(way: Way, out: Path) -> list[Path]:
    """Write the figure, its numbers, the runs, the paragraph of methods, and a page.

    Args:
        way: whether the runs are made, fewer and shorter ones, or taken from those that are kept.
        out: the folder; the sweep stands in it, too, and is gone on with where it was stopped.

    Returns:
        The files.
    """
    out.mkdir(parents=True, exist_ok=True)
    if way is Way.KEPT:
        runs = pd.read_csv(KEPT / f"{NAME}-runs.csv")
        told = (KEPT / f"{NAME}-methods.txt").read_text("utf-8")
    else:
        folder = swept(way, out)
        runs, told = Sweep(folder).runs, methods(folder).replace(str(folder), folder.name)
    runs = runs[["ticks", PRICE, INTENSITY, "replicate", "seed", *MEASURES]]
    settled = estimates(runs, [PRICE, INTENSITY], "settled")
    ticks = int(runs["ticks"].max())
    written = paper.save({NAME: draw(settled, labels_here(ticks // 6))}, out)
    tables = {f"{NAME}.csv": settled.table, f"{NAME}-runs.csv": runs}
    for name, table in tables.items():
        table.to_csv(out / name, index=False, float_format="%.6g")
    (out / f"{NAME}-methods.txt").write_text(told.strip() + "\n", "utf-8")
    seeds = runs["seed"].nunique()
    made = (
        f"{len(runs)} runs: {len(settled.table)} points, {seeds} seeds, {ticks:,} ticks. The study "
        f"is {len(settled.table)} points, {SEEDS} seeds, {TICKS:,} ticks; `--quick` makes "
        f"{QUICK_SEEDS} seeds and {QUICK_TICKS:,} ticks."
    )
    page = write_page(NAME, "Artisans by price and demand", [made], lines(runs, settled), out)
    return [*written, *(out / name for name in tables), out / f"{NAME}-methods.txt", page]


def swept(way: Way, out: Path) -> Path:
    """Sweep the grid, with the same seeds at all points, or go on with a sweep of it."""
    quick = way is Way.QUICK
    folder = out / (f"{SWEEP}_quick" if quick else SWEEP)
    if folder.is_dir():
        return resume_sweep(folder)
    return sweep(
        "farmer_artisan", designs.grid(GRID), QUICK_TICKS if quick else TICKS,
        range(QUICK_SEEDS if quick else SEEDS), common=True, measures=MEASURES,
        every=QUICK_EVERY if quick else EVERY, out=folder,
    )  # fmt: skip


def labels_here(window: int) -> Labels:
    """Return the labels of the figure.

    Args:
        window: ticks of the mean.
    """
    declared = load_model("farmer_artisan").parameters
    return Labels(
        {PRICE: declared[PRICE].doc,
         "settled": f"artisans, mean of the last {window:,} ticks"},
        {**{one: declared[one].unit for one in GRID}, "settled": "agents"},
    )  # fmt: skip


def draw(settled: Estimates, labels: Labels) -> Figure:
    """Return the figure, as wide as a page."""
    points = settled.table[list(settled.by)]
    with paper.style():
        figure = response_figure(settled, design_of(points, list(GRID)), labels, paper.PAGE)
        runs = int(settled.table["runs"].min())
        put_caption(figure, f"Means of {runs} runs a point, 95 % bootstrap intervals.")
    return figure


def lines(runs: pd.DataFrame, settled: Estimates) -> list[str]:
    """Return what the page says: the table, what the two parameters do, what had settled."""
    wide = settled.table.set_index([INTENSITY, PRICE])
    text = ["Artisans of 25 agents, mean of the last sixth of a run, with 95 % intervals.", "",
            f"| demand intensity | {' | '.join(f'price {p:g}' for p in GRID[PRICE])} |",
            "|---|" + "---|" * len(GRID[PRICE])]  # fmt: skip
    for intensity in GRID[INTENSITY]:
        cells = [_shown(Interval(*wide.loc[(intensity, p), ["middle", "low", "high"]]))
                 for p in GRID[PRICE]]  # fmt: skip
        text.append(f"| {intensity:g} | {' | '.join(cells)} |")
    low, high = (GRID[INTENSITY][place] for place in (0, -1))
    text += ["", f"Demand intensity {high:g} less {low:g}, in pairs of equal seeds:", "",
             "| price | difference |", "|---|---|"]  # fmt: skip
    for price in GRID[PRICE]:
        text.append(f"| {price:g} | {_shown(_between(runs, price, high, low), '+.2f')} |")
    away = [interval_of(_drift(own)) for _, own in runs.groupby([PRICE, INTENSITY], sort=False)]
    moved = [one for one in away if math.isfinite(one.low) and (one.low > 0 or one.high < 0)]
    largest = max(away, key=lambda one: abs(one.mean))
    still = float((_drift(runs) == 0).mean())
    text += [
        "",
        "Whether the societies had settled: the last sixth of each run less the sixth before it. "
        f"The largest mean change at a point is {_shown(largest, '+.2f')} artisans; {len(moved)} "
        f"of {len(away)} intervals leave 0 out, where one or two would by chance. In {still:.0%} "
        "of the runs the number did not change at all.",
    ]
    return text


def _drift(runs: pd.DataFrame) -> np.ndarray:
    return (runs["settled"] - runs["before"]).to_numpy(float)


def _between(runs: pd.DataFrame, price: float, high: float, low: float) -> Interval:
    own = runs[runs[PRICE] == price].pivot_table("settled", "seed", INTENSITY)
    return interval_of((own[high] - own[low]).to_numpy(float))


def _shown(one: Interval, form: str = ".1f") -> str:
    if not math.isfinite(one.low):
        return f"{one.mean:{form}}".replace("-", "−")
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})".replace("-", "−")
