"""How many brokers a market needs, with groups in common and with groups of their own.

    python -m analysis.travel_agency.study

Writes results.csv (one row a run), table.md, brokers.png and brokers.pdf.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of

HERE = Path(__file__).parent
BROKERS = (1, 2, 4, 8, 16, 32)
MEASURES = {  # and digits after the point
    "served": 2, "contracts": 0, "broken": 1, "waited": 1, "price": 1, "buyers_gain": 1,
    "sellers_gain": 1,
}  # fmt: skip


def outcome(brokers: int, apart: bool, seed: int, ticks: int) -> dict[str, float]:
    """Run a market from a seed and say what became of it.

    Args:
        brokers: how many.
        apart: whether each has groups of its own.
        seed: of every draw.
        ticks: to run.

    Returns:
        A row: the share of the requests done with that were served; contracts for a thousand ticks,
        bargainings broken off for a contract; and means over contracts of the ticks from request
        to contract, the price and what both sides gained.
    """
    model = load_model("travel_agency")(seed, n_brokers=brokers, apart=apart)
    model.advance(ticks)
    now = model.series()
    return {
        "brokers": brokers,
        "apart": apart,
        "seed": seed,
        "served": now["contracts"] / max(now["contracts"] + now["withdrawn"], 1),
        "contracts": 1000 * now["contracts"] / ticks,
        "broken": now["broken"] / max(now["contracts"], 1),
        **{name: now[name] for name in ("waited", "price", "buyers_gain", "sellers_gain")},
    }


def table(results: pd.DataFrame) -> str:
    """Return the table of the README: means with their intervals."""
    lines = [
        "| groups | brokers | requests served | contracts, 1,000 ticks | broken off for a contract "
        "| ticks to a contract | price | buyer's gain | seller's gain |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for (apart, brokers), rows in results.groupby(["apart", "brokers"]):
        cells = []
        for name, places in MEASURES.items():
            found = interval_of(rows[name])
            cells.append(
                f"{found.mean:.{places}f} ({found.low:.{places}f} – {found.high:.{places}f})"
            )
        groups = "each its own" if apart else "in common"
        lines.append(f"| {groups} | {brokers} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def draw(results: pd.DataFrame) -> Figure:
    """Draw the share of requests served and the contracts over the number of brokers.

    Args:
        results: one row a run.

    Returns:
        A figure at column width, means with their intervals.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 90)
        panels = figure.subplots(2, 1, sharex=True)
        shown = (
            ("served", "share of requests", "Served"),
            ("contracts", "for 1,000 ticks", "Contracts"),
        )
        for axes, letter, (name, unit, title) in zip(panels, "ab", shown, strict=True):
            ends = []
            for apart, label, colour, mark in (
                (False, "groups in common", paper.BLUE, "o"),
                (True, "each its own", paper.RED, "s"),
            ):
                rows = results[results["apart"] == apart].groupby("brokers")[name]
                found = [interval_of(values) for _, values in rows]
                numbers = list(rows.groups)
                means = [one.mean for one in found]
                axes.plot(numbers, means, color=colour, marker=mark, markersize=3)
                axes.fill_between(
                    numbers, [one.low for one in found], [one.high for one in found],
                    color=colour, alpha=0.2, linewidth=0,
                )  # fmt: skip
                ends.append((found[-1].mean, label, colour))
            axes.set_xscale("log", base=2)
            axes.set_xticks(BROKERS, [str(one) for one in BROKERS])
            axes.set_ylim(bottom=0)
            axes.set_ylabel(unit)
            paper.panel_title(axes, letter, title)
            paper.label_ends(axes, ends)
        panels[1].set_xlabel("brokers")
    return figure


def main(arguments: Sequence[str] | None = None) -> None:
    """Run all markets and write what was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--ticks", type=int, default=2_000)
    parser.add_argument("--out", type=Path, default=HERE / "results")
    given = parser.parse_args(arguments)
    results = pd.DataFrame(
        [
            outcome(brokers, apart, seed, given.ticks)
            for apart in (False, True)
            for brokers in BROKERS
            for seed in range(given.seeds)
        ]
    )
    given.out.mkdir(parents=True, exist_ok=True)
    results.to_csv(given.out / "results.csv", index=False, float_format="%.6g")
    (given.out / "table.md").write_text(table(results), encoding="utf-8")
    paper.save({"brokers": draw(results)}, given.out)
    print(table(results))


if __name__ == "__main__":
    main()
