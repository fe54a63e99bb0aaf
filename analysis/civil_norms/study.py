"""Two civilisations alone and together, with and without their norms, over many seeds.

    python -m analysis.civil_norms.study
    python -m analysis.civil_norms.study --seeds 5 --ticks 500 --out /tmp/study

Writes results.csv (one row a run), table.md, norms.png and norms.pdf.
"""

import argparse
import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import Interval, interval_of

HERE = Path(__file__).parent
SAMPLES = 50  # ticks between two counts of the living
ALONE: dict[str, Mapping[str, float | bool]] = {
    "sharers": {"share_of_sharers": 1.0},
    "keepers": {"share_of_sharers": 0.0},
    "sharers, no sanctions": {"share_of_sharers": 1.0, "sanctions_on": False},
    "keepers, no sanctions": {"share_of_sharers": 0.0, "sanctions_on": False},
    "sharers, no culturons": {"share_of_sharers": 1.0, "norm": 0.0},
    "keepers, no culturons": {"share_of_sharers": 0.0, "norm": 0.0},
    "sharers, small finds": {"share_of_sharers": 1.0, "find_size": 4.0},
    "keepers, small finds": {"share_of_sharers": 0.0, "find_size": 4.0},
}
OPEN: Mapping[str, float | bool] = {"parochial": False}
LOOK: Mapping[str, float | bool] = {"curiosity": 0.01}
TOGETHER: dict[str, Mapping[str, float | bool]] = {
    "no culturons": {"norm": 0.0},
    "no culturons, gifts to all": {"norm": 0.0, **OPEN},
    "norms": {},
    "norms, no sanctions": {"sanctions_on": False},
    "norms, gifts to all": OPEN,
    "norms, may change sides": LOOK,
    "norms, gifts to all, may change sides": {**OPEN, **LOOK},
    "norms, small finds": {"find_size": 4.0},
    "norms, small finds, may change sides": {"find_size": 4.0, **LOOK},
    "norms, few sharers": {"share_of_sharers": 0.1},
    "norms, few sharers, may change sides": {"share_of_sharers": 0.1, **LOOK},
    "norms, few keepers": {"share_of_sharers": 0.9},
    "norms, few keepers, gifts to all": {"share_of_sharers": 0.9, **OPEN},
}
CONDITIONS = {
    **{f"alone: {name}": values for name, values in ALONE.items()},
    **{f"together: {name}": values for name, values in TOGETHER.items()},
}


def outcome(condition: str, seed: int, ticks: int) -> dict[str, float | str]:
    """Run a condition from a seed and say what became of it.

    Args:
        condition: its name.
        seed: of every draw.
        ticks: to run.

    Returns:
        A row: the mean number of the living in the last half, deaths by hunger for each thousand
        ticks lived, shares of gifts and of punished breaches, what is left in store and how
        unequal it is, of both civilisations together; and how many of each are left.
    """
    model = load_model("civil_norms")(seed, **CONDITIONS[condition])
    living, store, inequality = [], [], []
    while model.tick < ticks:
        model.advance(SAMPLES)
        now = model.series()
        living.append(now["sharers"] + now["keepers"])
        sums = [now[f"{who}_store"] * now[who] for who in ("sharers", "keepers")]
        store.append(sum(sums) / max(living[-1], 1))
        inequality.append(max(now["sharers_inequality"], now["keepers_inequality"]))
    last = len(living) // 2

    def both(what: str) -> float:
        return now[f"sharers_{what}"] + now[f"keepers_{what}"]

    return {
        "condition": condition,
        "seed": seed,
        "living": float(np.mean(living[last:])),
        "starved": 1000 * both("starved") / (SAMPLES * sum(living)),
        "given": both("gifts") / max(both("occasions"), 1),
        "punished": both("sanctions") / both("breaches") if both("breaches") else np.nan,
        "store": float(np.mean(store[last:])),
        "inequality": float(np.mean(inequality[last:])),
        "sharers": now["sharers"],
        "keepers": now["keepers"],
    }


def table(results: pd.DataFrame) -> str:
    """Return the two tables of the README: each civilisation alone, and both together."""
    seeds = results["seed"].nunique()
    lines = [
        f"{seeds} seeds a row; in brackets the 95 % interval of the mean.",
        "",
        "| alone | living | starved for 1,000 ticks lived | gifts for an occasion | store "
        "| inequality |",
        "|---|---|---|---|---|---|",
    ]
    for name in ALONE:
        rows = results[results["condition"] == f"alone: {name}"]
        cells = [
            _cell(interval_of(rows[column]), places)
            for column, places in (
                ("living", 1), ("starved", 1), ("given", 2), ("store", 1), ("inequality", 2),
            )
        ]  # fmt: skip
        lines.append(f"| {name} | {' | '.join(cells)} |")
    lines += [
        "",
        "| together | only sharers left | only keepers left | both left | sharers' part of the "
        "living | living |",
        "|---|---|---|---|---|---|",
    ]
    for name in TOGETHER:
        rows = results[results["condition"] == f"together: {name}"]
        sharers, keepers = rows["sharers"] > 0, rows["keepers"] > 0
        counts = ((sharers & ~keepers).sum(), (keepers & ~sharers).sum(), (sharers & keepers).sum())
        cells = [str(one) for one in counts]
        cells.append(_cell(interval_of(part_of_sharers(rows)), 2))
        cells.append(_cell(interval_of(rows["living"]), 1))
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def part_of_sharers(rows: pd.DataFrame) -> pd.Series:
    """The sharers' part of those alive at the end; half where nobody is."""
    return (rows["sharers"] / (rows["sharers"] + rows["keepers"])).fillna(0.5)


def _cell(found: Interval, places: int) -> str:
    return f"{found.mean:.{places}f} ({found.low:.{places}f} – {found.high:.{places}f})"


def draw(results: pd.DataFrame) -> Figure:
    """Draw the sharers' part of the living at the end, for all conditions together.

    Args:
        results: one row a run.

    Returns:
        A figure at column width: each run a dot, the mean with its interval.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 82)
        axes = figure.subplots()
        for row, name in enumerate(TOGETHER):
            rows = results[results["condition"] == f"together: {name}"]
            _runs(axes, row, part_of_sharers(rows).to_numpy(float))
        axes.axvline(0.5, color=paper.GREY, linewidth=0.5, zorder=0)
        axes.set_yticks(range(len(TOGETHER)), list(TOGETHER))
        axes.invert_yaxis()
        axes.set_xlim(-0.06, 1.06)
        axes.set_xticks((0, 0.5, 1), ("0\nkeepers", "0.5\n", "1\nsharers"))
        axes.set_xlabel("sharers' part of the living")
    return figure


def _runs(axes: Axes, row: int, parts: np.ndarray) -> None:
    """Draw the runs of a condition, spread a little so that equal ones are seen."""
    spread = row + 0.5 * (np.arange(len(parts)) / max(len(parts) - 1, 1) - 0.5)
    axes.plot(parts, spread, ".", color=paper.GOLD, markersize=2.5, zorder=1)
    found = interval_of(parts)
    axes.plot([found.low, found.high], [row, row], color=paper.INK, linewidth=1.0, zorder=2)
    # Open, so that runs which all agree are seen within it.
    axes.plot(
        found.mean, row, "o", color=paper.BLUE, markerfacecolor="none", markersize=5.5, zorder=3
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Run all conditions and write what was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--ticks", type=int, default=2_000)
    parser.add_argument("--workers", type=int, default=min(2, os.cpu_count() or 1))
    parser.add_argument("--out", type=Path, default=HERE / "results")
    given = parser.parse_args(arguments)
    jobs = [(name, seed, given.ticks) for name in CONDITIONS for seed in range(given.seeds)]
    with ProcessPoolExecutor(given.workers) as pool:
        rows = list(pool.map(outcome, *zip(*jobs, strict=True), chunksize=given.seeds))
    results = pd.DataFrame(rows)
    given.out.mkdir(parents=True, exist_ok=True)
    results.to_csv(given.out / "results.csv", index=False, float_format="%.6g")
    (given.out / "table.md").write_text(table(results), encoding="utf-8")
    paper.save({"norms": draw(results)}, given.out)
    print(table(results))


if __name__ == "__main__":
    main()
