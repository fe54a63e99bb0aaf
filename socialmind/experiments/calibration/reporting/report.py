"""The report of a fit, as a page of Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from socialmind.experiments.calibration.plan import NEW_RUNS, OFTENER
from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.calibration.reporting.pictures import plain_number as number
from socialmind.experiments.calibration.result import Fit
from socialmind.experiments.calibration.target import SERIES

if TYPE_CHECKING:
    import pandas as pd

UNCHECKED = (
    "**It was not checked whether such data can tell these parameters** (`--recover 0`). The "
    "values below may be some of many that do as well: of 41 published models, half of those that "
    "are agent-based could not be identified in full (Carrella 2021, JASSS 24(2) 7)."
)


def report_of(fit: Fit) -> str:
    """Return the report of a fit."""
    parts = [
        f"# {fit.manifest.model['name']}, fitted by {fit.manifest.method}",
        _made(fit),
        *([] if fit.manifest.recover else [UNCHECKED]),
        "## What was found",
        _table(_parameters(fit)),
        *_plausible(fit),
        "## The best on new seeds",
        *_again(fit),
        "![The data in black, the model in blue](figures/best.png)",
        *(_recovery(fit) if fit.manifest.recover else ()),
        "## Profiles",
        "The best distance in each tenth of a parameter's range (blue) over the trials of the fit "
        "(grey), and a smooth surface through all of them (purple). Where they are flat, the "
        "parameter hardly matters to these data. Below the golden line values are plausible. A "
        "search looks little where trials are bad: there the blue line lies too high rather than "
        "too low. Strokes at the upper edge are trials farther away. The surface is one of squared "
        "distances, and where these would be below 0 it is cut at 0; an interval that is taken "
        "from it holds all values there.",
        "![Distance by each parameter](figures/profiles.png)",
        "## To repeat it",
        "In this folder:",
        f"```\n{fit.best['run']}\n{fit.best['sweep']}\n```",
        "The seeds of the trials, of the recoveries and of the runs reported here are different "
        f"ones, all derived from the fit's seed, {fit.manifest.seed}.",
    ]
    return "\n\n".join(parts) + "\n"


def _made(fit: Fit) -> str:
    manifest, target = fit.manifest, fit.target
    own = fit.trials[fit.trials["search"] == 0]
    trials, finalists = len(own), int(own["final"].notna().sum())
    final = f", the {finalists} nearest once more with {OFTENER} times as many" * bool(finalists)
    what = (
        f"the series {', '.join(target.columns)} at {len(target.ticks):,} ticks"
        f"{f' ({target.name})' if target.name else ''}"
        if target.kind == SERIES
        else "the statistics "
        + ", ".join(
            f"{name} = {number(value)} ± {number(error)}"
            for name, value, error in zip(
                target.columns, target.values[0].tolist(), target.errors, strict=True
            )
        )
    )
    fixed = ", ".join(f"{name} = {value}" for name, value in manifest.fixed.items())
    measures = ", ".join(
        f"`{name} = {one.get('expression') or one.get('file') or one.get('function')}`"
        for name, one in manifest.measures.items()
    )
    said = [
        f"Fitted to {what}.",
        *([f"Measures: {measures}."] if measures else []),
        *([f"Fixed: {fixed}."] if fixed else []),
        f"{trials:,} trials of {manifest.seeds} runs of {manifest.ticks:,} ticks{final}; "
        f"{manifest.runs:,} runs in all, with recovery and what is reported.",
    ]
    return " ".join(said)


def _parameters(fit: Fit) -> list[dict[str, str]]:
    rows = []
    ranges = {one["name"]: one for one in fit.manifest.vary}
    for row in fit.parameters.to_dict("records"):
        one = ranges[row["parameter"]]
        said = {
            "parameter": f"`{row['parameter']}`",
            "found": number(row["found"]),
            "interval": f"{number(row['low'])} … {number(row['high'])}",
            "looked for in": f"{one['low']:g} … {one['high']:g}{', log' * one['log']}",
        }
        if fit.manifest.recover:
            said["missed in recovery by"] = (
                "–" if row["error"] != row["error"] else f"{100 * row['error']:.0f} % of the range"
            )
        rows.append({**said, "the data tell it": row["verdict"]})
    return rows


def _plausible(fit: Fit) -> Iterable[str]:
    best = fit.best
    luck, distance = best["luck"], best["distance"]
    posterior = fit.manifest.method == "abc"
    there = not posterior and any(best["intervals"].values())
    if luck is None:
        yield "**The best trial's runs failed on new seeds**, so nothing is known of luck."
        return
    if best["plausible_trials"] or there:
        yield (
            f"Values are plausible that are no farther from the data than luck explains, "
            f"{number(luck)}: the 95 % quantile of the distance between a trial and data that are "
            f"both made with the values found. {best['plausible_trials']:,} trials are as near."
        )
    else:
        yield (
            f"**No values are plausible**: the nearest trial is {number(distance)} away, and luck "
            f"explains {number(luck)}. In these ranges, and with this budget, the model does not "
            "come to such data; more runs, other ranges or another method may come nearer."
        )
    if posterior:
        yield "Intervals are the middle 95 % of the posterior's sample (column `weight` of trials)."
    elif there:
        yield (
            "Intervals hold the plausible values of a parameter, the others being as good as they "
            "can be, on a smooth surface through all trials. They are wide rather than narrow."
        )


def _again(fit: Fit) -> Iterable[str]:
    best = fit.best
    yield (
        f"Distance of the best trial: {number(best['distance'])} on its own seeds, "
        f"{number(best['distance_on_new_seeds'])} on new ones, as the mean of such trials from "
        f"{NEW_RUNS} runs. The first was chosen for being small; report the second."
    )
    target, runs = fit.target, fit.best_runs
    if target.kind != SERIES and len(runs):
        yield _table(
            [
                {
                    "statistic": f"`{name}`",
                    "data": f"{number(value)} ± {number(error)}",
                    "model, mean": number(runs[name].mean()),
                    "standard deviation between runs": number(runs[name].std()),
                }
                for name, value, error in zip(
                    target.columns, target.values[0].tolist(), target.errors, strict=True
                )
            ]
        )
    failed = NEW_RUNS - (runs["run"].nunique() if len(runs) else 0)
    if failed:
        yield f"**{failed} of {NEW_RUNS} of these runs failed.**"


def _recovery(fit: Fit) -> Iterable[str]:
    manifest, summary = fit.manifest, identifying.summary(fit.recovery)
    data = "one run" if manifest.data_runs == 1 else f"the mean of {manifest.data_runs} runs"
    yield "## Recovery"
    yield (
        f"{manifest.recover} times, values were drawn all over the ranges, data were made with "
        f"them ({data}{', and an error as given' if fit.target.errors else ''}), and the same fit "
        "was made to these. What it finds of values that are known is what it can find of yours."
    )
    yield _table(_recovered(summary))
    yield (
        "*Gain*: 1 is perfect, at 0 one may as well name the middle of the range. *Told* is a gain "
        "of 0.5 or more, *roughly* of 0.35 or more."
    )
    yield from _verdicts(fit, summary)
    yield "![Found against true; red squares where the interval misses](figures/recovery.png)"
    yield (
        "Dots are the best trials, bars the intervals. An interval is taken from all trials (a "
        "surface through them, or a posterior), so the best of them may lie outside."
    )


def _recovered(summary: pd.DataFrame) -> list[dict[str, str]]:
    return [
        {
            "parameter": f"`{row['parameter']}`",
            "missed by (share of the range)": number(row["error"]),
            "blind guess": number(row["guess"]),
            "gain": "–" if row["gain"] != row["gain"] else f"{row['gain']:.2f}",
            "the data tell it": row["verdict"],
            "95 % intervals that hold the truth": f"{100 * row['coverage']:.0f} % "
            f"({100 * row['coverage_low']:.0f} … {100 * row['coverage_high']:.0f} %)",
        }
        for row in summary.to_dict("records")
    ]


def _verdicts(fit: Fit, summary: pd.DataFrame) -> Iterable[str]:
    blind = _named(summary, "not told")
    if blind:
        yield (
            f"**The data do not tell {blind}**: do not interpret the values found. Fix them by "
            "`--set`, or take data that hang on them."
        )
    for one, other, both in identifying.combinations(fit.recovery):
        way = "the other is found too low" if both < 0 else "so is the other"
        yield (
            f"`{one}` and `{other}` are mistaken for each other (where one is found too high, "
            f"{way}; correlation of errors {both:.2f}): the data tell a combination of both, and "
            "not each."
        )
    narrow = summary[summary["coverage_high"] < 0.95]["parameter"].tolist()
    if narrow:
        names = ", ".join(f"`{name}`" for name in narrow)
        yield (
            f"**Intervals of {names} hold the truth too seldom**: they are too narrow; go by what "
            "recovery misses by."
        )
    failed = fit.recovery["problem"].dropna().unique().tolist()
    if failed:
        yield f"**Recoveries without a result**, which count as missed: {'; '.join(failed)}."


def _named(summary: pd.DataFrame, verdict: str) -> str:
    names = summary[summary["verdict"] == verdict]["parameter"].tolist()
    return ", ".join(f"`{name}`" for name in names)


def _table(rows: Sequence[dict[str, Any]]) -> str:
    head = list(rows[0])
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    lines += [f"| {' | '.join(str(one) for one in row.values())} |" for row in rows]
    return "\n".join(lines)
