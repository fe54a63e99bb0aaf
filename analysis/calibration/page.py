"""What the fits of weights come to, as tables and figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments import Fit
from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.calibration.reporting.pictures import draw_profiles, draw_recovery

from .weights import KNOWN

DIGITS = "%.5g"


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
    return [*_tables(tables, out), *paper.save({"methods": _gains(fits)}, out)]


def _gains(fits: Mapping[str, Fit]) -> Figure:
    """Draw what each method misses each weight by, beside a blind guess."""
    with paper.style():
        names = [one["name"] for one in next(iter(fits.values())).manifest.vary]
        figure, panels = paper.grid(len(names), 75, 50)
        for axes, name in zip(panels, names, strict=False):
            summaries = [
                identifying.summary(one.recovery).set_index("parameter") for one in fits.values()
            ]
            errors = [100 * one.loc[name, "error"] for one in summaries]
            axes.bar(list(fits), errors, color=paper.BLUE, width=0.6)
            axes.axhline(100 * summaries[0].loc[name, "guess"], color=paper.GREY)
            axes.set_title(name)
            axes.set_ylabel("missed by (% of the range)")
    return figure


def _tables(tables: Mapping[str, pd.DataFrame], out: Path) -> list[Path]:
    files = []
    for name, table in tables.items():
        files.append(out / f"{name}.csv")
        table.to_csv(files[-1], index=False, float_format=DIGITS)
    return files
