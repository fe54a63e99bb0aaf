"""The study: three sweeps, what they say, and whether screening and shares agree."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from socialmind.catalogue import load_model
from socialmind.documents.labels import labels_of_parameters
from socialmind.drawing import style as paper
from socialmind.experiments import Sensitivity, Sweep, sensitivity_of
from socialmind.experiments.figures.labels import Labels
from socialmind.experiments.measures.intervals import LEVEL, interval_of
from socialmind.experiments.sensitivity.figure import figure_of
from socialmind.experiments.sensitivity.indices import MORRIS, REGRESSION, SOBOL
from socialmind.experiments.sensitivity.words import report

from .sweeps import MODEL, OUTPUTS, QUICK, RANGES, SCREENING, SETTLING, SHARES, UNITS

KEPT = Path(__file__).parent / "results"
WINDOW = 25_000
"""Ticks over which the society's numbers are averaged, to see whether they still move."""
ENDS = ("artisans", "wheat", "tools")
"""Outputs of the long runs: what their series end with."""
BEFORE = "artisan_share_before"
"""The share of artisans in the third of a run before the last."""
NUMBERS = {"artisan_share": "artisans", "wheat_each": "wheat", "tools_each": "tools"}
NAMES = {
    **NUMBERS, "max_tool_production": "tool production, at most",
    "n_villages": "number of villages",
}  # fmt: skip
"""What figures call outputs, and parameters whose meaning is too long for an axis."""
METHODS = {"ends": REGRESSION, SCREENING.name: MORRIS, SHARES.name: SOBOL}


def make(out: Path, quick: bool = False, workers: int | None = None) -> list[Path]:
    """Sweep, and write what comes of it; sweeps that were stopped are gone on with.

    Args:
        out: the folder; the sweeps lie in `sweeps` of it.
        quick: whether few and short runs will do.
        workers: processes.

    Returns:
        The files written.
    """
    out.mkdir(parents=True, exist_ok=True)
    swept = {
        plan.name: plan.swept(out / "sweeps" / plan.name, quick, workers)
        for plan in (SETTLING, SCREENING, SHARES)
    }
    long = swept[SETTLING.name]
    written = [_write(windows(long, WINDOW // (QUICK if quick else 1)), out / "settling.csv")]
    written += told("ends", long, sensitivity_of(long, ENDS), out)
    found = {}
    for name in (SCREENING.name, SHARES.name):
        found[name] = sensitivity_of(swept[name], OUTPUTS)
        written += told(name, swept[name], found[name], out)
    both = agreement(found[SCREENING.name], found[SHARES.name])
    before = sensitivity_of(swept[SHARES.name], [BEFORE])
    page = out / "findings.md"
    page.write_text("\n".join(findings(both, found[SHARES.name], before)) + "\n", "utf-8")
    return [*written, _write(both, out / "agreement.csv"), page]


def told(name: str, swept: Sweep, found: Sensitivity, out: Path) -> list[Path]:
    """Write what a sweep says: its runs, indices, luck, report and figure."""
    runs = swept.runs.drop(columns=["status", "error", "ticks"])
    ends = swept.manifest.series_columns
    kept = [one for one in runs if one not in ends or one in found.outputs]
    text = out / f"{name}.txt"
    text.write_text("\n".join(report(found)) + "\n", "utf-8")
    return [
        _write(runs[kept], out / f"{name}_runs.csv"),
        _write(found.table, out / f"{name}_indices.csv"),
        _write(found.luck, out / f"{name}_luck.csv"),
        text,
        *paper.save({name: figure_of(found, labels())}, out),
    ]


def redrawn(out: Path) -> list[Path]:
    """Draw the figures from the kept tables.

    Args:
        out: the folder.
    """
    return paper.save({name: figure_of(kept(name), labels()) for name in METHODS}, out)


def kept(name: str) -> Sensitivity:
    """Return what the kept tables of a sweep say, as far as figures go."""
    words = {"parameter": "string", "other": "string"}
    table = pd.read_csv(KEPT / f"{name}_indices.csv", dtype=words)
    luck = pd.read_csv(KEPT / f"{name}_luck.csv")
    parameters = tuple(one for one in RANGES if one in set(table["parameter"]))
    return Sensitivity(
        METHODS[name], name, parameters, RANGES, tuple(luck["output"]),
        table.fillna({"parameter": "", "other": ""}), luck, LEVEL, 0, (),
    )  # fmt: skip


def labels() -> Labels:
    """Return what the figures call parameters and outputs, and the units of outputs."""
    return labels_of_parameters(load_model(MODEL)).also(NAMES, UNITS)


def windows(swept: Sweep, width: int) -> pd.DataFrame:
    """Return the society's numbers in stretches of time, and how far they still were from the end.

    Means are over all runs; intervals over points, of which each is the mean of its runs.

    Args:
        swept: a sweep with its series.
        width: of a stretch, in ticks.

    Returns:
        A row for each output and stretch: `output`, `begin`, `end`, `mean`, `low`, `high`;
        `to_come`, `to_come_low`, `to_come_high`, what the last four stretches have more, point by
        point; and `correlation` with these, over runs.
    """
    series = swept.series[swept.series["tick"] > 0]
    place = (series["tick"] - 1) // width
    point = swept.runs.set_index("run")["point"]
    rows = []
    for output, column in NUMBERS.items():
        each = series[column] / series["population"] * (100 if output == "artisan_share" else 1)
        table = each.groupby([series["run"], place]).mean().unstack()
        last = table.iloc[:, -4:].mean(axis=1)
        for number in table:
            one, still = (
                interval_of(values.groupby(point).mean())
                for values in (table[number], last - table[number])
            )
            rows.append(
                {
                    "output": output, "begin": number * width, "end": (number + 1) * width,
                    "mean": one.mean, "low": one.low, "high": one.high,
                    "to_come": still.mean, "to_come_low": still.low, "to_come_high": still.high,
                    "correlation": table[number].corr(last),
                }
            )  # fmt: skip
    return pd.DataFrame(rows)


def agreement(screening: Sensitivity, shares: Sensitivity) -> pd.DataFrame:
    """Return, side by side, what both designs say of each output and parameter.

    Returns:
        A row each: `mu_star` and `total` with their bounds and what luck alone gives; `screened`
        and `counts` say whether an interval lies above that. Empty where a design has it not.
    """
    rows = []
    for output in OUTPUTS:
        parts = []
        for found, index, above in (
            (screening, "mu_star", "screened"),
            (shares, "total", "counts"),
        ):
            floor = float(found.luck.set_index("output").loc[output, "floor"])
            part = found.of(output, index).set_index("parameter")[["value", "low", "high"]]
            part.columns = [index, f"{index}_low", f"{index}_high"]
            part[f"{index}_floor"] = floor
            part[above] = (part[f"{index}_low"] > floor).astype(object)
            parts.append(part)
        both = parts[0].join(parts[1], how="left").sort_values("mu_star", ascending=False)
        rows.append(both.reset_index().assign(output=output))
    table = pd.concat(rows, ignore_index=True)
    return table[["output", *(name for name in table if name != "output")]]


def findings(both: pd.DataFrame, shares: Sensitivity, before: Sensitivity) -> list[str]:
    """Return what the tables say, in sentences.

    Args:
        both: screening and shares side by side, as `agreement` gives them.
        shares: indices of Saltelli's design.
        before: those of the share of artisans in the third before.
    """
    lines = ["# What the sweeps say", "", "Brackets: intervals of 95 %.", ""]
    for output in OUTPUTS:
        rows = both[both["output"] == output]
        known = rows.dropna(subset=["total"]).sort_values("total", ascending=False)
        luck = shares.luck.set_index("output").loc[output]
        lines += [
            f"## {output.replace('_', ' ')} ({UNITS[output]})",
            "",
            f"- Mean {luck['mean']:.3g}, deviation of the points {luck['deviation']:.2g}. Luck: "
            f"{100 * luck['luck_of_a_run']:.0f} % of the variance of single runs "
            f"({100 * luck['luck_of_a_run_low']:.0f} … {100 * luck['luck_of_a_run_high']:.0f} %); "
            f"a parameter without effect has a total order of {luck['floor']:.2f}.",
            f"- Total order: {_told(known, 'total')}. Above luck: {_names(known, 'counts')}.",
            f"- Pairs above 0: {_pairs(shares, output)}.",
            f"- Screening, mu*: {_told(rows, 'mu_star')}; {rows['mu_star_floor'].iloc[0]:.2g} by "
            f"luck. Above luck: {_names(rows, 'screened')}.",
            f"- {_compared(known)}",
            "",
        ]
    last = shares.of(OUTPUTS[0], "total")
    apart = (last["value"] - before.of(BEFORE, "total")["value"]).abs().max()
    means = [one.luck.set_index("output")["mean"] for one in (shares, before)]
    lines += [
        "## Settled?",
        "",
        f"The share of artisans is {means[0][OUTPUTS[0]]:.1f} % in the last third of the runs "
        f"of `shares` and {means[1][BEFORE]:.1f} % in the third before; no total order differs by "
        f"more than {apart:.2f}.",
    ]
    return lines


def _told(rows: pd.DataFrame, index: str) -> str:
    return ", ".join(
        f"`{row['parameter']}` {row[index]:.2g} ({row[f'{index}_low']:.2g} … "
        f"{row[f'{index}_high']:.2g})"
        for _, row in rows.iterrows()
    )


def _names(rows: pd.DataFrame, which: str) -> str:
    names = rows.loc[rows[which].eq(True), "parameter"]
    return ", ".join(f"`{one}`" for one in names) or "none"


def _pairs(shares: Sensitivity, output: str) -> str:
    rows = shares.of(output, "second")
    sure = rows[rows["low"] > 0]
    return (
        ", ".join(
            f"`{row['parameter']}` × `{row['other']}` {row['value']:.2f} ({row['low']:.2f} … "
            f"{row['high']:.2f})"
            for _, row in sure.iterrows()
        )
        or f"none of {len(rows)}"
    )


def _compared(known: pd.DataFrame) -> str:
    """Return whether both designs order the parameters that both have alike."""
    shares = known["parameter"].tolist()
    screened = known.sort_values("mu_star", ascending=False)["parameter"].tolist()
    apart = known[known["screened"].astype(bool) != known["counts"].astype(bool)]["parameter"]
    if shares == screened:
        order = "Both order the four alike"
    elif shares[0] == screened[0]:
        order = f"Both put `{shares[0]}` first, and order the others differently"
    else:
        order = f"They differ in what comes first: `{screened[0]}` screened, `{shares[0]}` by share"
    return (
        f"{order}; they differ on whether it is above luck for: "
        + (", ".join(f"`{one}`" for one in apart) or "none")
        + "."
    )


def _write(table: pd.DataFrame, path: Path) -> Path:
    table.to_csv(path, index=False, float_format="%.6g")
    return path
