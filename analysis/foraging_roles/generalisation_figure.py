"""What roles generalise to, in one figure, from the tables that are kept.

python -m analysis.foraging_roles.generalisation_figure

Colours and names are those of `analysis/specialisation`. The lessons `delivered_role` and
`delivered_narrow`, which are not there, have marks of their own.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from socialmind.catalogue import load_file
from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import share_interval
from socialmind.experiments.studies import topics, write_figure

from .contestants import PICKED
from .generalisation import ALONE, NINE, PAIRS, TURNED, read
from .large_groups import RESULTS, TICKS

SOCIETIES = load_file(topics()["specialisation"] / "societies.py").SOCIETIES


class Sort(NamedTuple):
    """Ways that have a mark in common.

    Attributes:
        label: in the legend.
        ways: their names.
        colour: of the mark.
        marker: its shape.
        hollow: whether it is white inside.
    """

    label: str
    ways: tuple[str, ...]
    colour: str
    marker: str
    hollow: bool = False

    @property
    def mark(self) -> dict[str, Any]:
        """What Matplotlib is told of it."""
        face = "white" if self.hollow else self.colour
        return {"color": self.colour, "marker": self.marker, "markersize": 3, "mfc": face,
                "mew": 0.7}  # fmt: skip


def of_the_page(society: str, ways: tuple[str, ...], marker: str, label: str = "") -> Sort:
    """Return a sort with the colour that a society has on the page, and its title."""
    known = SOCIETIES[society]
    return Sort(label or known.title, ways, known.colour, marker)


SORTS = (
    of_the_page("picked", (PICKED,), "P"),
    of_the_page("supervised", ("supervised_role",), "o"),
    of_the_page("delivered", ("delivered_anew",), "s"),
    of_the_page("chosen", ("chosen_in_bodies",), "v", "by deliveries, chosen first"),
    Sort("other lessons by deliveries", ("delivered_role", "delivered_narrow"),
         SOCIETIES["delivered"].colour, "s", hollow=True),
    of_the_page("programmed", ("programmed", "evolved_scheme"), "^", "scheme, written or evolved"),
    of_the_page("fixed_thresholds", ("fixed_thresholds", "reinforced_thresholds"), "D",
                "thresholds"),
)  # fmt: skip
"""In the order in which they stand side by side."""
BY_WAY: Mapping[str, Sort] = {way: one for one in SORTS for way in one.ways}
SIZES = (9, 18, 36)
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
    "narrow 1 / programmed": ("delivered_narrow", 1, "programmed", 0),
}
"""The pairs of `PAIRS` that panel c shows."""
LINES = (":", "-", "--", "-")


def dots(axes: Axes, place: int, part: pd.DataFrame, value: pd.Series) -> None:
    """Draw a dot for each attempt at a place, ways of a sort above each other.

    Args:
        axes: where.
        place: along x.
        part: rows of worlds, with `way` and `attempt`.
        value: what is drawn, of each row.
    """
    means = value.groupby([part["way"], part["attempt"]]).mean()
    for number, sort in enumerate(SORTS):
        own = means[means.index.get_level_values("way").isin(sort.ways)]
        aside = 0.8 * ((number + 0.5) / len(SORTS) - 0.5)
        axes.plot([place + aside] * len(own), own, lw=0, clip_on=False, **sort.mark)


def groups(axes: Axes, table: pd.DataFrame) -> None:
    """Show how far groups of 9, 18 and 36 are from the wanted split: a dot for each attempt."""
    calm = table[(table["ticks"] == TICKS) & (table["gain"] == 1.0) & ~table["even"]]
    for place, robots in enumerate(SIZES):
        part = calm[calm["robots"] == robots]
        dots(axes, place, part, 100 * part["off"] / robots)
    axes.set_xticks(range(len(SIZES)), list(map(str, SIZES)))
    axes.set_xlabel("robots")
    axes.set_ylabel("distance from the wanted split\n(% of the robots)")
    axes.set_ylim(bottom=0)


def causes(axes: Axes, table: pd.DataFrame) -> None:
    """Show how far thirty-six robots are off: a dot for each attempt and case."""
    many = table[(table["ticks"] == TICKS) & (table["robots"] == SIZES[-1])]
    for place, (gain, even) in enumerate(CASES.values()):
        part = many[(many["gain"] == gain) & (many["even"] == even)]
        dots(axes, place, part, part["off"])
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
        mark = BY_WAY[way].mark
        aside = 0.12 * (place - 1.5)
        axes.plot(found.index + aside, 100 * found, line, label=label, lw=0.8, **mark)
        for focal, share in found.items():
            worlds = np.arange(pair["world"].nunique())
            known = share_interval(worlds < round(share * len(worlds)))
            axes.plot(
                [focal + aside] * 2,
                [100 * known.low, 100 * known.high],
                lw=0.6,
                color=mark["color"],
            )
    axes.legend(loc="lower left", frameon=False, handlelength=2.2, handletextpad=0.4, borderpad=0)
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
        figure = paper.figure(paper.PAGE, 78.0)
        first, second, third = figure.subplots(1, 3, width_ratios=(0.8, 1.0, 1.0))
        groups(first, large)
        causes(second, large)
        partners(third, among, alone)
        for axes, letter, title in (
            (first, "a", "groups of other sizes"),
            (second, "b", "why the largest are less sharp"),
            (third, "c", f"{len(PARTNERED)} of {len(PAIRS)} picked pairs"),
        ):
            paper.panel_title(axes, letter, title)
        for sort in SORTS:
            second.plot([], [], lw=0, label=sort.label, **sort.mark)
        handles, names = second.get_legend_handles_labels()
        figure.legend(handles, names, loc="outside lower center", ncols=4, frameon=False,
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
