"""What the fits of weights come to, as tables and figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from textwrap import fill

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments import Fit
from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.calibration.reporting.pictures import draw_profiles, draw_recovery
from socialmind.experiments.figures.labels import word_name

from .weights import KNOWN

DIGITS = "%.5g"
NAMES = {"cmaes": "CMA-ES", "tpe": "TPE", "lhs": "Latin\nhypercube", "abc": "ABC"}
LONGEST = 32
"""Characters of a line over a panel."""


def write_weights(found: Fit, out: Path) -> list[Path]:
    """Write the tables and figures of the fit of six weights.

    Args:
        found: the fit.
        out: the folder.

    Returns:
        The files.
    """
    out.mkdir(parents=True, exist_ok=True)
    table = found.parameters
    table.insert(1, "known", [KNOWN[name] for name in table["parameter"]])
    tables = {
        "weights": table, "weights-recovery": found.recovery, "weights-profiles": found.profiles,
    }  # fmt: skip
    with paper.style():
        figures = {
            "weights-recovery": draw_recovery(found), "weights-profiles": draw_profiles(found),
        }  # fmt: skip
    files = paper.save(figures, out)
    report = out / "weights-report.md"
    lines = (found.folder / "report.md").read_text("utf-8").splitlines(keepends=True)
    kept = [one.replace("(figures/", "(weights-") for one in lines if "figures/best" not in one]
    report.write_text("".join(kept), "utf-8")
    return [*files, report, *_tables(tables, out)]


def write_methods(fits: Mapping[str, Fit], out: Path) -> list[Path]:
    """Write what each method found and recovered, a row for each weight; arguments as above."""
    out.mkdir(parents=True, exist_ok=True)
    rows, recoveries = [], []
    for method, found in fits.items():
        for row in found.parameters.to_dict("records"):
            own = {"method": method, "known": KNOWN[row["parameter"]], **row}
            rows.append({**own, "distance on new seeds": found.best["distance_on_new_seeds"]})
        recoveries.append(found.recovery.assign(method=method))
    tables = {"methods": pd.DataFrame(rows), "methods-recovery": pd.concat(recoveries)}
    figure = draw_methods(tables["methods-recovery"])
    return [*_tables(tables, out), *paper.save({"methods": figure}, out)]


def draw_methods(recoveries: pd.DataFrame) -> Figure:
    """Draw by how much each method misses each weight, beside a blind guess.

    Args:
        recoveries: a row for each method, recovery and weight.

    Returns:
        A figure of a panel for each weight.
    """
    with paper.style():
        weights = list(dict.fromkeys(recoveries["parameter"]))
        figure = paper.figure(75 * len(weights), 62)
        panels = figure.subplots(1, len(weights), sharey=True, squeeze=False)[0]
        for letter, axes, weight in zip("abcdef", panels, weights, strict=False):
            own = recoveries[recoveries["parameter"] == weight]
            _missed(axes, {name: own[own["method"] == name] for name in own["method"].unique()})
            paper.panel_title(axes, letter, fill(word_name(weight), LONGEST))
        panels[0].set_ylim(bottom=0)
        panels[0].set_ylabel("missed by (% of the range)")
        key = panels[0].get_legend_handles_labels()
        figure.legend(*key, loc="outside lower center", ncols=3)
    return figure


def _missed(axes: Axes, methods: Mapping[str, pd.DataFrame]) -> None:
    """Draw a dot a recovery, each method's in the order of their numbers."""
    # All methods are tried on the same values, so a blind guess misses them alike.
    guess = identifying.summary(next(iter(methods.values())))["guess"].item()
    axes.axhline(100 * guess, color=paper.GREY, linewidth=0.9,
                 linestyle=paper.DASHES[paper.GREY], label="blind guess")  # fmt: skip
    for place, rows in enumerate(methods.values()):
        missed = 100 * (rows["found_place"] - rows["true_place"]).abs()
        error = 100 * identifying.summary(rows)["error"].item()
        named = {} if place else {"dot": "a recovery", "line": "root mean square of them"}
        axes.plot(place + np.linspace(-0.22, 0.22, len(rows)), missed, "o", color=paper.BLUE,
                  markersize=3, clip_on=False, label=named.get("dot"))  # fmt: skip
        axes.hlines(error, place - 0.32, place + 0.32, color=paper.INK, label=named.get("line"))
    axes.set_xticks(range(len(methods)), [NAMES[name] for name in methods])
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.5, len(methods) - 0.5)


def _tables(tables: Mapping[str, pd.DataFrame], out: Path) -> list[Path]:
    files = []
    for name, table in tables.items():
        files.append(out / f"{name}.csv")
        table.to_csv(files[-1], index=False, float_format=DIGITS)
    return files
