"""What roles generalise to, in one figure, from the tables that are kept.

python -m analysis.foraging_roles.generalisation_figure
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import share_interval
from socialmind.experiments.studies import write_figure

from .contestants import PICKED
from .generalisation import ALONE, NINE, TURNED, read
from .large_groups import RESULTS, TICKS

COLOURS = {
    PICKED: paper.INK,
    "supervised_role": paper.BLUE,
    "delivered_role": paper.PURPLE,
    "delivered_narrow": paper.PURPLE,
    "delivered_anew": paper.PURPLE,
    "programmed": paper.RED,
    "evolved_scheme": paper.RED,
    "fixed_thresholds": paper.GOLD,
    "reinforced_thresholds": paper.GOLD,
}
LEGEND = {
    "the model's mind (picked)": (paper.INK, "o"),
    "learned, supervised": (paper.BLUE, "o"),
    "learned by deliveries": (paper.PURPLE, "s"),
    "scheme, written or evolved": (paper.RED, "^"),
    "thresholds": (paper.GOLD, "D"),
}
MARKERS = dict(LEGEND.values())
CASES = {
    "as\nit is": (1.0, False),
    "trips\neven": (1.0, True),
    "told 2×\nsharper": (2.0, False),
    "told 4×\nsharper": (4.0, False),
}
"""Gain, and whether trips are even, of panel b."""
PARTNERED = {
    "picked / programmed": (PICKED, 1, "programmed", 0),
    "supervised 1 / programmed": ("supervised_role", 1, "programmed", 0),
    "supervised 1 / supervised 3": ("supervised_role", 1, "supervised_role", 3),
    "deliveries 1 / programmed": ("delivered_narrow", 1, "programmed", 0),
}
LINES = ("-", "-", "--", "-")


def groups(axes: Axes, table: pd.DataFrame) -> None:
    """Show how far groups of 9, 18 and 36 are from the wanted split: a line for each attempt."""
    calm = table[(table["ticks"] == TICKS) & (table["gain"] == 1.0) & ~table["even"]]
    for (way, _), part in calm.groupby(["way", "attempt"], sort=False):
        if way in COLOURS:
            means = part.groupby("robots")["off"].mean()
            shares = 100 * means / means.index
            colour = COLOURS[way]
            axes.plot(
                range(len(means)),
                shares,
                color=colour,
                marker=MARKERS[colour],
                markersize=3,
                lw=0.8,
            )
    axes.set_xticks(range(3), ["9", "18", "36"])
    axes.set_xlabel("robots")
    axes.set_ylabel("distance from the wanted split\n(% of the robots)")
    axes.set_ylim(bottom=0)


def causes(axes: Axes, table: pd.DataFrame) -> None:
    """Show how far thirty-six robots are off: a dot for each attempt and case."""
    many = table[(table["ticks"] == TICKS) & (table["robots"] == 36)]
    ways = list(many[["way", "attempt"]].drop_duplicates().itertuples(index=False))
    for place, (gain, even) in enumerate(CASES.values()):
        part = many[(many["gain"] == gain) & (many["even"] == even)]
        for number, (way, attempt) in enumerate(ways):
            mine = part[(part["way"] == way) & (part["attempt"] == attempt)]
            if way in COLOURS and len(mine):
                colour = COLOURS[way]
                aside = 0.6 * (number / max(len(ways) - 1, 1) - 0.5)
                axes.plot(
                    place + aside, mine["off"].mean(), color=colour, marker=MARKERS[colour],
                    markersize=3, lw=0,
                )  # fmt: skip
    axes.set_xticks(range(len(CASES)), list(CASES))
    axes.set_ylabel("thirty-six robots:\nrobots off the wanted split")
    axes.set_ylim(bottom=0)


def partners(axes: Axes, table: pd.DataFrame, alone: pd.DataFrame) -> None:
    """Show how many worlds settle again among partners never met, by how many robots are focal."""
    for place, (line, (label, pair_of)) in enumerate(zip(LINES, PARTNERED.items(), strict=True)):
        way, attempt, other, other_attempt = pair_of
        pair = table[
            (table["way"] == way) & (table["attempt"] == attempt) & (table["partner"] == other)
            & (table["partner_attempt"] == other_attempt) & (table["situation"] == TURNED)
        ]  # fmt: skip
        if pair.empty:
            continue
        found = pair.groupby("focal")["within_one"].mean()
        for who, number, focal in ((other, other_attempt, 0), (way, attempt, NINE)):
            same = alone[
                (alone["way"] == who) & (alone["attempt"] == number)
                & (alone["situation"] == TURNED) & alone["world"].isin(pair["world"])
            ]  # fmt: skip
            if len(same):
                found[focal] = same["within_one"].mean()
        found = found.sort_index()
        colour = COLOURS[way]
        given = {"color": colour, "marker": MARKERS[colour], "markersize": 3, "lw": 0.8}
        aside = 0.12 * (place - 1.5)
        axes.plot(found.index + aside, 100 * found, line, label=label, **given)
        for focal, share in found.items():
            worlds = np.arange(pair["world"].nunique())
            known = share_interval(worlds < round(share * len(worlds)))
            axes.plot(
                [focal + aside] * 2, [100 * known.low, 100 * known.high], lw=0.6, color=colour
            )
    axes.legend(loc="lower left", frameon=False, handlelength=1.4, handletextpad=0.4, borderpad=0)
    axes.set_xticks([0, 3, 6, 9])
    axes.set_xlabel("focal robots of nine")
    axes.set_ylabel("worlds within one after\nthe ratio has turned (%)")
    axes.set_ylim(0, 104)


def draw(out: Path = RESULTS) -> list[Path]:
    """Draw the figure of the tables in `results`, and write it with its numbers."""
    large = pd.read_csv(RESULTS / "large_groups.csv")
    table = read(RESULTS / "generalisation.csv")
    among, alone = table[table["partner"] != ALONE], table[table["partner"] == ALONE]
    with paper.style():
        figure = paper.figure(paper.PAGE, 70.0)
        first, second, third = figure.subplots(1, 3, width_ratios=(0.8, 1.0, 1.0))
        groups(first, large)
        causes(second, large)
        partners(third, among, alone)
        for axes, letter, title in (
            (first, "a", "groups of other sizes"),
            (second, "b", "why the largest are less sharp"),
            (third, "c", "partners never met"),
        ):
            paper.panel_title(axes, letter, title)
        for name, (colour, marker) in LEGEND.items():
            second.plot([], [], color=colour, marker=marker, markersize=3, lw=0, label=name)
        handles, names = second.get_legend_handles_labels()
        figure.legend(handles, names, loc="outside lower center", ncols=5, frameon=False,
                      columnspacing=1.0, handletextpad=0.2)  # fmt: skip
        shown = large.groupby(
            ["way", "attempt", "robots", "ticks", "gain", "even"], sort=False
        )["off"].mean()  # fmt: skip
        return write_figure(
            "figure-generalisation", figure, shown.reset_index().to_dict("records"), out
        )


if __name__ == "__main__":
    for path in draw():
        print(path)
