"""Figures of sweeps side by side: an outcome of each, and below it how far they are apart."""

from __future__ import annotations

from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.comparing.sweeps import COMPARED, SweepsCompared
from socialmind.experiments.figures.design import Varying
from socialmind.experiments.figures.estimates import Effects
from socialmind.experiments.figures.labels import Labels, value_name
from socialmind.experiments.figures.layouts import NARROWEST_PANEL, put_caption
from socialmind.experiments.figures.of_sweeps import MOST_EFFECTS
from socialmind.experiments.figures.palette import MOST_LINES
from socialmind.experiments.figures.panels import draw_effects, draw_response, draw_scatter


def comparison_figure(found: SweepsCompared, outcome: str, labels: Labels, width: float) -> Figure:
    """Return the figure of an outcome.

    Up to two columns whose values are crossed: curves of the sweeps, below them the differences, a
    pair of panels for each value of the second. More, or points that fill a space: the differences,
    a row a point, or against each column.

    Args:
        found: the sweeps.
        outcome: one of theirs.
        labels: names and units.
        width: in mm.

    Raises:
        SocialmindError: there are more sweeps than lines that all can tell apart.
    """
    if len(found.sweeps) > MOST_LINES:
        raise SocialmindError(
            f"{len(found.sweeps)} sweeps in one figure; expected {MOST_LINES} at most"
        )
    with paper.style():
        columns = found.design.columns
        few = len(columns) < 2 or len(columns[1].values) * NARROWEST_PANEL <= 1.3 * width
        if found.design.crossed and len(columns) <= 2 and few:
            figure = _curves(found, outcome, labels, width)
        else:
            figure = _differences(found, outcome, labels, width)
        share = f"{100 * found.level:g} %"
        told = f"Means with {share} intervals; differences {found.paired} from {found.sweeps[0]}"
        put_caption(figure, ". ".join([told, *found.notes]) + ".")
    return figure


def _curves(found: SweepsCompared, outcome: str, labels: Labels, width: float) -> Figure:
    """Return curves by the first column, with the differences below, by the second beside."""
    columns = found.design.columns
    x = columns[0].name if columns else COMPARED
    beside = columns[1] if len(columns) > 1 else None
    values = beside.values if beside is not None else (None,)
    figure = paper.figure(width, 100)
    panels = figure.subplots(
        2, len(values), squeeze=False, sharex=True, sharey="row",
        gridspec_kw={"height_ratios": (1.0, 0.75)},
    )  # fmt: skip
    sweeps = Varying(COMPARED, found.sweeps, False)
    by = COMPARED if columns else None
    for place, value in enumerate(values):
        above, below = panels[0][place], panels[1][place]
        means, apart = found.means(outcome), found.differences(outcome, not columns)
        if beside is not None:
            means, apart = means.only({beside.name: value}), apart.only({beside.name: value})
            above.set_title(f"{labels.name(beside.name)} {value_name(value)}", fontsize=7)
        draw_response(above, means, x, by, labels, sweeps if by else None).set_xlabel("")
        below.axhline(0.0, color=paper.INK, linewidth=0.6)
        draw_response(below, apart, x, by, labels, sweeps if by else None)
        if not columns:
            below.set_xlabel("")
        unit = labels.units.get(outcome, "")
        below.set_ylabel(f"difference ({unit})" if unit else "difference")
        if place:
            above.set_ylabel("")
            below.set_ylabel("")
    if by:
        handles, names = panels[0][0].get_legend_handles_labels()
        longest = max(map(len, names))
        figure.legend(handles, names, loc="outside upper left",
                      ncols=max(1, int(width / (12 + 1.4 * longest))))  # fmt: skip
    return figure


def _differences(found: SweepsCompared, outcome: str, labels: Labels, width: float) -> Figure:
    """Return the differences of each other sweep: a row a point, or against each column."""
    others = found.sweeps[1:]
    apart = found.differences(outcome)
    rows = len(apart.table) // max(len(others), 1)
    if rows <= 2 * MOST_EFFECTS:
        figure = paper.figure(width, 30 + 4.6 * max(rows, 3))
        panels = figure.subplots(1, len(others), squeeze=False, sharey=True)[0]
        for axes, name in zip(panels, others, strict=True):
            own = apart.only({COMPARED: name}).table.rename(columns={"middle": "difference"})
            effects = Effects(own.assign(paired=True), found.by, outcome, {}, found.level)
            draw_effects(axes, effects, labels)
            axes.set_title(name, fontsize=7)
            if axes is not panels[0]:
                axes.set_ylabel("")
        return figure
    columns = found.design.columns
    across = max(1, min(len(columns), int(width // NARROWEST_PANEL)))
    down = -(-len(columns) // across) * len(others)
    figure = paper.figure(width, 14 + 44 * down)
    panels = figure.subplots(down, across, squeeze=False, sharey=True)
    places = iter(panels.flat)
    for name in others:
        for one in columns:
            axes = next(places)
            axes.axhline(0.0, color=paper.INK, linewidth=0.6)
            draw_scatter(axes, apart.only({COMPARED: name}), one.name, labels)
            unit = labels.units.get(outcome, "")
            axes.set_ylabel(f"difference ({unit})" if unit else "difference")
            axes.set_title(name, fontsize=7)
    for axes in places:
        axes.set_visible(False)
    return figure
