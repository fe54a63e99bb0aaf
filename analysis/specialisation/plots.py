"""The figures of the study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Affine2D

from socialmind.drawing import style as paper
from socialmind.drawing.scheme import draw_scheme, key, lines_of
from socialmind.experiments.measures.intervals import FEW

from .societies import CONDITIONS, FALL_SHORT, MIXED, REFERENCE, SOCIETIES, Condition, Size
from .tables import MEASURED, OVER_SHARES

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from coglogo_py import CognitiveScheme

A, B = paper.GOLD, paper.PURPLE
COLOURS = {"programmed": paper.RED, "learned": paper.BLUE}
"""Of both kinds of robots in one society; marks of the latter are hollow."""
FAR_FROM_ZERO = ("delivered", "in_ratio")
"""Measures whose axis does not begin at 0."""
LETTERS = "abcdefghijklmnop"
ACROSS = 4
"""Panels of robots side by side."""
BEGINNING = 2_000
"""Ticks in which most robots have brought nothing yet, and count as in A."""


def attempts(each: pd.DataFrame, table: pd.DataFrame) -> Figure:
    """Draw every attempt's share of worlds within one robot of the wanted split, and the means.

    Args:
        each: `society`, `attempt`, `condition`, `within`.
        table: `society`, `condition`, `measure`, `mean`, `low`, `high`.
    """
    figure = paper.figure(paper.PAGE, 104)
    panels = figure.subplots(1, len(CONDITIONS), sharey=True)
    own = table[table["measure"] == "within"]
    rows = {society: place for place, society in enumerate(SOCIETIES)}
    for letter, axes, condition in zip(LETTERS, panels, CONDITIONS.values(), strict=False):
        for society, row in rows.items():
            one = SOCIETIES[society]
            dots = each[(each["society"] == society) & (each["condition"] == condition.name)]
            if len(dots) > 1:
                # One below the other, so that every attempt is seen.
                high = np.linspace(-0.4, 0.2, len(dots))
                axes.plot(
                    dots["within"].sort_values(), row + high, linestyle="", marker="o",
                    markersize=2.2, mfc="white", mec=one.colour, mew=0.6,
                )  # fmt: skip
            ((_, found),) = own[
                (own["society"] == society) & (own["condition"] == condition.name)
            ].iterrows()
            dot(axes, row + (0.36 if len(dots) > 1 else 0.0), found, one.colour, "D")
        _rows(axes, rows)
        axes.set_xlim(-0.04, 1.04)
        axes.set_xticks((0, 0.5, 1), ("0", "0.5", "1"))
        axes.set_xlabel("share of worlds")
        paper.panel_title(axes, letter, condition.title)
    legend(figure, [
        Line2D([], [], color=paper.INK, linestyle="", marker="o", markersize=2.2, mfc="white",
               mew=0.6, label="an attempt"),
        Line2D([], [], color=paper.INK, marker="D", markersize=2.8, linewidth=0.9,
               label="mean with its interval"),
    ])  # fmt: skip
    return figure


def _rows(axes: Axes, rows: Mapping[str, int]) -> None:
    """A row for each society, from above."""
    for place in range(1, len(rows)):
        axes.axhline(place - 0.5, color="#e6e6e6", linewidth=0.6, zorder=0)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_yticks(list(rows.values()), [SOCIETIES[one].title for one in rows])
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)


def course(over_time: pd.DataFrame, size: Size) -> Figure:
    """Draw distance and specialised robots over time; the distance of rules that fall short apart.

    Args:
        over_time: `society`, `condition`, `tick`, `distance`, `specialised`.
        size: of the study.
    """
    settling = [one for one in SOCIETIES if one not in FALL_SHORT]
    learned = [
        one for one in settling if one == REFERENCE or "unlearned" in SOCIETIES[one].parameters
    ]
    rules = [REFERENCE, *(one for one in settling if one not in learned)]
    rows = (
        ("distance", rules), ("distance", learned), ("specialised", settling),
        ("distance", FALL_SHORT),
    )  # fmt: skip
    figure = paper.figure(paper.PAGE, 190)
    panels = figure.subplots(len(rows), len(CONDITIONS), sharey="row", sharex=True)
    letters = iter(LETTERS)
    for row, (measure, societies) in zip(panels, rows, strict=True):
        own = over_time[over_time["society"].isin(societies)]
        for axes, condition in zip(row, CONDITIONS.values(), strict=True):
            paper.panel_title(axes, next(letters), condition.title)
            _over_time(axes, own, measure, condition, size)
        if measure == "distance":
            seen = own if societies is FALL_SHORT else own[own["tick"] > BEGINNING]
            row[0].set_ylim(*paper.limits_with_zero(seen["distance"].tolist()))
            row[0].set_ylabel("distance (robots)")
        else:
            row[0].set_ylim(-0.03, 1.04)
            row[0].set_ylabel("specialised (share)")
    for axes in panels[:-1].flat:
        axes.set_xlabel("")
    legend(figure, [_line(one) for one in SOCIETIES], 5)
    return figure


def _over_time(
    axes: Axes, table: pd.DataFrame, measure: str, condition: Condition, size: Size
) -> None:
    """Draw means over time, a line a society."""
    unit = paper.time_axis(axes, [0, size.ticks])
    for society, part in _parts(table, condition.name):
        x = part["tick"].to_numpy() / unit
        axes.plot(x, part[measure], **_look(society))
    for shock in condition.shocks(size.half):
        axes.axvline(shock / unit, color=paper.INK, linewidth=0.6, linestyle=(0, (3, 2)))


def _parts(table: pd.DataFrame, condition: str) -> list[tuple[str, pd.DataFrame]]:
    """The rows of each society under a condition, in their order."""
    own = table[table["condition"] == condition]
    return [(one, own[own["society"] == one]) for one in SOCIETIES]


def _line(society: str) -> Line2D:
    return Line2D([], [], **_look(society), label=SOCIETIES[society].title)


def _look(society: str) -> dict[str, Any]:
    """How a society's lines look; the one that others are compared with has broad ones."""
    one = SOCIETIES[society]
    width = 1.8 if society == REFERENCE else 1.0
    return {"color": one.colour, "linestyle": one.dash, "linewidth": width}


def legend(figure: Figure, marks: Sequence[Line2D | Patch], columns: int = 6) -> None:
    figure.legend(handles=list(marks), loc="outside lower center", ncols=min(len(marks), columns),
                  columnspacing=1.4, handlelength=1.9)  # fmt: skip


def measures(table: pd.DataFrame) -> Figure:
    """Draw every measure of every society and condition, with intervals.

    Args:
        table: `society`, `condition`, `measure`, `attempts`, `mean`, `low`, `high`.
    """
    figure = paper.figure(paper.PAGE, 210)
    panels = figure.subplots(3, 3, sharey=True).flat
    rows = {society: place for place, society in enumerate(SOCIETIES)}
    offsets = np.linspace(-0.27, 0.27, len(CONDITIONS))
    for letter, axes, measured in zip(LETTERS, panels, MEASURED.values(), strict=False):
        own = table[table["measure"] == measured.name]
        luck = table[table["measure"] == "agents_to_tasks_by_chance"]
        for offset, condition in zip(offsets, CONDITIONS.values(), strict=True):
            for society, part in _parts(own, condition.name):
                row = rows[society] + offset
                dot(axes, row, part.iloc[0], SOCIETIES[society].colour, condition.marker)
                if measured.name == "agents_to_tasks":
                    chance = dict(_parts(luck, condition.name))[society]["mean"].iloc[0]
                    axes.plot([chance] * 2, [row - 0.07, row + 0.07], color=paper.GREY)
        _rows(axes, rows)
        own = own[own["society"].isin(rows)]
        # Those of a handful of attempts are so wide that they would hide all others.
        few = own["attempts"].between(2, FEW - 1)
        own = own.assign(
            low=own["low"].mask(few, own["mean"]), high=own["high"].mask(few, own["mean"])
        )
        across(axes, own, zero=measured.name not in FAR_FROM_ZERO)
        axes.set_xlabel(measured.unit)
        paper.panel_title(axes, letter, measured.title)
    legend(figure, [
        Line2D([], [], color=paper.INK, marker=one.marker, markersize=3, linewidth=0.8,
               label=one.title)
        for one in CONDITIONS.values()
    ])  # fmt: skip
    return figure


def across(axes: Axes, own: pd.DataFrame, dots: Iterable[float] = (), zero: bool = True) -> None:
    """Set the x axis so that all means with their intervals are seen, dots, and, if asked, 0."""
    shown = [*own["low"], *own["high"], *own["mean"], *dots]
    low, high = paper.limits_with_zero(shown) if zero else (np.nanmin(shown), np.nanmax(shown))
    air = 0.03 * (high - low)  # so that a mark at 0 is whole
    axes.set_xlim(low - air, high + air)
    axes.xaxis.set_major_locator(MaxNLocator(3, steps=(1, 2, 5, 10)))
    axes.xaxis.set_major_formatter("{x:,g}")


def dot(axes: Axes, row: float, found: Any, colour: str, marker: str = "o") -> None:
    """Draw a mean with its interval."""
    axes.plot([found["low"], found["high"]], [row, row], color=colour, linewidth=0.9)
    axes.plot(found["mean"], row, marker, color=colour, markersize=2.8, mew=0)


def robots(spells: pd.DataFrame, condition: str, size: Size) -> Figure:
    """Draw the role of each robot over time in one world, a panel a society.

    Args:
        spells: `society`, `condition`, `agent`, `since`, `until`, `role`.
        condition: its name.
        size: of the study.
    """
    figure = paper.figure(paper.PAGE, 128)
    panels = figure.subplots(-(-len(SOCIETIES) // ACROSS), ACROSS, sharex=True, sharey=True)
    for letter, axes, (society, part) in zip(
        LETTERS, panels.flat, _parts(spells, condition), strict=False
    ):
        unit = paper.time_axis(axes, [0, size.ticks])
        for role, colour in (("A", A), ("B", B)):
            axes.add_patch(PathPatch(_bars(part[part["role"] == role], unit), fc=colour, lw=0))
        for shock in CONDITIONS[condition].shocks(size.half):
            axes.axvline(shock / unit, color="white", linewidth=1.5)
            axes.axvline(shock / unit, color=paper.INK, linewidth=0.7, linestyle=(0, (3, 2)))
        axes.set_ylim(0.4, part["agent"].max() + 1.6)
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        paper.panel_title(axes, letter, SOCIETIES[society].title)
    for axes in panels.flat[len(SOCIETIES) :]:
        axes.set_axis_off()
    for axes in panels.flat[: len(SOCIETIES) - ACROSS]:
        axes.set_xlabel("")
    for axes in panels.flat[len(SOCIETIES) - ACROSS : len(SOCIETIES)]:
        axes.tick_params(labelbottom=True)
    for axes in panels[:, 0]:
        axes.set_ylabel("robot")
    legend(figure, [Patch(color=A, label="brings A"), Patch(color=B, label="brings B")])
    return figure


def _bars(spells: pd.DataFrame, unit: float) -> Path:
    """Return the bars of spells as one path, so that they are one part of the figure."""
    return Path.make_compound_path(
        *(
            Path.unit_rectangle().transformed(
                Affine2D()
                .scale((row.until - row.since) / unit, 0.8)
                .translate(row.since / unit, row.agent + 0.6)
            )
            for row in spells.itertuples()
        )
    )


KINDS = {
    "in_b": ("Time in B", "share of time, last quarter"),
    "changes": ("Role changes", "a robot and 10,000 ticks"),
    "late_changes": ("Late role changes", "a robot and 10,000 ticks"),
    "delivered": ("Delivered", "objects a robot"),
}


def mixed(societies: pd.DataFrame, kinds: pd.DataFrame) -> Figure:
    """Draw measures over the share of programmed robots, and what became of either kind.

    Args:
        societies: `condition`, `share`, `measure`, `mean`, `low`, `high`.
        kinds: the same with `kind`.
    """
    figure = paper.figure(paper.PAGE, 108)
    panels = figure.subplots(2, 4, sharex=True)
    nudge = 0.008
    for letter, axes, name in zip(LETTERS, panels[0], OVER_SHARES, strict=False):
        measured = MEASURED[name]
        for sign, condition in zip(cycle((-1, 1)), MIXED):
            own = societies[
                (societies["measure"] == name) & (societies["condition"] == condition)
            ].sort_values("share")
            _over_share(axes, own, paper.INK, condition, sign * nudge)
        _upwards(axes, societies[societies["measure"] == name])
        axes.set_ylabel(measured.unit)
        paper.panel_title(axes, letter, measured.title)
    for letter, axes, (name, (title, unit)) in zip(
        LETTERS[4:], panels[1], KINDS.items(), strict=False
    ):
        for sign, condition in zip(cycle((-1, 1)), MIXED):
            for aside, (kind, colour) in zip((-2, 2), COLOURS.items(), strict=True):
                own = kinds[
                    (kinds["measure"] == name)
                    & (kinds["condition"] == condition)
                    & (kinds["kind"] == kind)
                ].sort_values("share")
                hollow = kind == "learned"
                _over_share(axes, own, colour, condition, (sign + aside) * nudge, hollow)
        _upwards(axes, kinds[kinds["measure"] == name], zero=name != "delivered")
        axes.set_ylabel(unit)
        axes.set_xlabel("programmed (share)")
        axes.set_xlim(-0.05, 1.05)
        axes.set_xticks((0, 1 / 3, 2 / 3, 1), ("0", "⅓", "⅔", "1"))
        paper.panel_title(axes, letter, title)
    lines: list[Line2D | Patch] = [
        Line2D([], [], color=paper.INK, marker=CONDITIONS[one].marker, markersize=3,
               linestyle=_dashed(one), label=CONDITIONS[one].title)
        for one in MIXED
    ]  # fmt: skip
    lines += [
        Line2D([], [], color=colour, marker="o", markersize=3, label=f"{kind} robots",
               mfc="white" if kind == "learned" else colour)
        for kind, colour in COLOURS.items()
    ]  # fmt: skip
    legend(figure, lines)
    return figure


def _upwards(axes: Axes, own: pd.DataFrame, zero: bool = True) -> None:
    """Set the y axis so that all means with their intervals are seen, and 0 where asked for."""
    values = [*own["low"], *own["high"], *own["mean"]]
    if zero:
        low, high = paper.limits_with_zero(values)
    else:
        low, high = np.nanmin(values), np.nanmax(values)
    air = 0.03 * (high - low)  # so that a mark at 0, and the longest interval, are whole
    axes.set_ylim(low - air, high + air)
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10)))
    axes.yaxis.set_major_formatter("{x:,g}")


def _dashed(condition: str) -> Any:
    return "-" if condition == MIXED[0] else (0, (3, 2))


def _over_share(
    axes: Axes, own: pd.DataFrame, colour: str, condition: str, nudge: float, hollow: bool = False
) -> None:
    """Draw means over the share, each with its interval."""
    known = own[np.isfinite(own["mean"])]
    x = known["share"].to_numpy() + nudge
    axes.vlines(x, known["low"], known["high"], color=colour, linewidth=0.8)
    axes.plot(
        x, known["mean"], color=colour, marker=CONDITIONS[condition].marker, markersize=2.8,
        mew=0.7, mfc="white" if hollow else colour, linestyle=_dashed(condition), linewidth=0.8,
    )  # fmt: skip


def schemes(several: Mapping[str, CognitiveScheme], width: float = paper.PAGE) -> Figure:
    """Draw schemes side by side, to one scale.

    Args:
        several: by the title of their panels.
        width: of the figure, in mm.
    """
    lines = max(map(lines_of, several.values()))
    figure = paper.figure(width, 3.7 * lines + 16)
    panels = np.atleast_1d(figure.subplots(1, len(several)))
    for axes in panels:
        axes.set_axis_off()
    figure.draw_without_rendering()  # names are as large as their boxes let them be
    for letter, axes, (title, scheme) in zip(LETTERS, panels, several.items(), strict=False):
        draw_scheme(scheme, axes, lines)
        if len(several) > 1:
            paper.panel_title(axes, letter, title)
    legend(figure, key(*several.values()), 4 if len(several) > 1 else 2)
    return figure
