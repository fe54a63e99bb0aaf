"""How figures for papers look: column widths, type sizes, colours, and direct labels.

Figures are made as `matplotlib.figure.Figure` inside `style()`, which sets Matplotlib's parameters
for the block and leaves the user's own alone. Type is never under 7 points at the printed size,
text in vector files stays text, and the colours are told apart by the colour-blind.
"""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import BytesIO
from itertools import chain, repeat
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator, ScalarFormatter
from PIL import Image

from socialmind.work.files import replace_file

COLUMN = 85.0
"""Width of a one-column figure, in mm."""
PAGE = 180.0
"""Width of a two-column figure, in mm."""

BLUE = "#2564ae"
RED = "#b22b19"
GOLD = "#d99a00"
PURPLE = "#6b4a86"
TEAL = "#35a294"
GREY = "#767676"
PALE = "#b0b0b0"
INK = "#222222"

BLUE_TO_RED = (
    "#2564ae", "#5780bc", "#839ac9", "#afb5d5", "#dccfe0",
    "#d6a9af", "#cd837f", "#c15c50", "#b22b19",
)  # fmt: skip
"""A diverging scale through pale purple: equal steps in OKLab, the two ends equally light."""

DASHES: Mapping[str, Any] = {RED: (0, (4, 1.2)), PURPLE: (0, (1, 1)), GREY: (0, (4, 1.2, 1, 1.2))}
"""Dashes of lines by colour, where only a legend names them: in print without colours these are as
dark as blue. Lines of other colours are solid."""

STYLE: Mapping[Any, object] = {
    "font.size": 7.5,
    "axes.titlesize": 8,
    "axes.labelsize": 7.5,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.titlelocation": "left",
    "axes.titlepad": 5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "lines.linewidth": 1.0,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "axes.axisbelow": True,
    "pdf.fonttype": 42,
    "svg.fonttype": "none",
    "svg.hashsalt": "socialmind",
}


@contextmanager
def style() -> Iterator[None]:
    """Set Matplotlib's parameters for figures of a paper, within a `with` block only.

    >>> before = mpl.rcParams["font.size"]
    >>> with style():
    ...     mpl.rcParams["font.size"]
    7.5
    >>> mpl.rcParams["font.size"] == before
    True
    """
    with mpl.rc_context(dict(STYLE)):
        yield


def figure(width: float, height: float, gap: float = 1.0) -> Figure:
    """An empty figure that belongs to no window and lays its parts out by itself.

    Args:
        width: in mm, usually `COLUMN` or `PAGE`.
        height: in mm.
        gap: white at the sides of each panel, in mm.

    Returns:
        The figure.

    >>> figure(90, 60).get_size_inches().round(2).tolist()
    [3.54, 2.36]
    """
    layout = ConstrainedLayoutEngine(w_pad=gap / 25.4)
    return _Paper(figsize=(width / 25.4, height / 25.4), layout=layout)


class _Paper(Figure):
    """A figure whose axes write numbers as texts do: 2,000.

    Formatters are put in when it is drawn: panels, insets and bars of colours are added to a
    figure, and scales bring formatters of their own.
    """

    def draw(self, renderer: RendererBase) -> None:
        for one in self.findobj(Axis):
            given = one.get_major_formatter()
            # Formatters that somebody chose stay.
            if type(given) is ScalarFormatter:
                grouped = _Grouped()
                vars(grouped).update(vars(given))
                one.set_major_formatter(grouped)
        super().draw(renderer)


class _Grouped(ScalarFormatter):
    """Matplotlib's usual numbers, with commas between the thousands."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        whole, point, rest = super().__call__(x, pos).partition(".")
        return re.sub(r"\d{4,}", lambda found: f"{int(found[0]):,}", whole) + point + rest


def grid(count: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """Make a figure of panels, three in a row.

    Args:
        count: how many panels; the places left over in the last row stay empty.
        width: of a panel, in millimetres.
        height: of a panel, in millimetres.
    """
    across = min(3, max(1, count))
    down = max(1, -(-count // across))
    made = figure(width * across, height * down)
    panels = list(made.subplots(down, across, squeeze=False).flat)
    for axes in panels[count:]:
        axes.set_visible(False)
    return made, panels[:count]


FORMS: Mapping[str, Mapping[str, Any]] = {
    "pdf": {"metadata": {"CreationDate": None}},
    "svg": {"metadata": {"Date": None}},
    "png": {},
}
"""Forms of figures. Without its date a PDF or SVG of the same data is the same file."""


def save(
    figures: Mapping[str, Figure], folder: Path, forms: Sequence[str] = ("pdf", "png")
) -> list[Path]:
    """Write each figure in some forms: PDF and PNG (300 dots an inch) by default.

    Args:
        figures: figures by name.
        folder: made where it is missing.
        forms: of `FORMS`.

    Returns:
        The files written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with style():
        for name, drawn in figures.items():
            for form in forms:
                path = folder / f"{name}.{form}"
                write_figure(drawn, path, dpi=300, **FORMS[form])
                written.append(path)
    return written


def write_figure(drawn: Figure, path: Path, **options: Any) -> None:
    """Write a figure in the form that the suffix names, whole or not at all.

    It is drawn in memory: on a full disk Matplotlib's writers fail with errors of their own. A PNG
    has a palette of 256 colours, a third of the size; none of them is seen to differ.

    Args:
        drawn: the figure.
        path: the file.
        **options: as of `Figure.savefig`.
    """
    content = BytesIO()
    suffix = path.suffix[1:].lower()
    drawn.savefig(content, format=suffix, **options)
    replace_file(path, _with_palette(content) if suffix == "png" else content.getvalue())


def _with_palette(content: BytesIO) -> bytes:
    """Return a PNG with a palette, or as it is where it has transparent parts."""
    with Image.open(content) as image:
        clear: Any = image.getchannel("A").getextrema() if image.mode == "RGBA" else (255, 255)
        if clear[0] < 255:
            return content.getvalue()
        # The palette that is nowhere far off, not the one that is best where most is white.
        few = image.convert("RGB").quantize(
            256, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE
        )
        smaller = BytesIO()
        few.save(smaller, "png", dpi=image.info.get("dpi"))
    return smaller.getvalue()


def panel_title(axes: Axes, letter: str, title: str) -> None:
    """Head a panel with its bold letter and what it shows."""
    axes.set_title(rf"$\bf{{{letter}}}$   {title}")


def time_axis(axes: Axes, ticks: Sequence[float]) -> float:
    """Label the x axis with time, in thousand ticks for long runs.

    Args:
        axes: the panel.
        ticks: the recorded ticks, ascending, at least one.

    Returns:
        What to divide ticks by.

    >>> time_axis(figure(90, 60).subplots(), [0, 500_000])
    1000.0
    """
    last = float(ticks[-1])
    first = float(ticks[0]) if len(ticks) > 1 else 0.0
    unit = 1000.0 if last >= 10_000 else 1.0
    axes.set_xlabel("time (thousand ticks)" if unit > 1 else "time (ticks)")
    axes.set_xlim(first / unit, max(last, first + 1) / unit)
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10)))
    return unit


def attempts(
    axes: Axes,
    lines: Sequence[Sequence[float]],
    failed: Sequence[bool] = (),
    width: float = 0.7,
    step: float = 1.0,
) -> None:
    """Draw curves that are alike, such as attempts, in one pale colour, and their median.

    Which is which is of no interest, so no colours tell them apart. The median goes as far as all
    of them do; where one ends before the longest, a dot says so.

    Args:
        axes: the panel.
        lines: the values of each, the first one at `step` on the x axis.
        failed: for each whether it is red, being told of by itself; none by default.
        width: of a line, in points.
        step: between two values on the x axis.

    >>> axes = figure(85, 60).subplots()
    >>> attempts(axes, [[1.0, 2.0, 3.0], [3.0, 4.0]])
    >>> [line.get_ydata().tolist() for line in axes.lines]
    [[1.0, 2.0, 3.0], [3.0, 4.0], [4.0], [2.0, 3.0]]
    """
    longest = max(map(len, lines))
    for values, short in zip(lines, chain(failed, repeat(False)), strict=False):
        places = step * np.arange(1, len(values) + 1)
        colour, order = (RED, 2.2) if short else (PALE, 2.0)
        dashes = DASHES.get(colour, "-")
        axes.plot(places, values, color=colour, linestyle=dashes, linewidth=width, zorder=order)
        if len(values) < longest:
            axes.plot(places[-1:], values[-1:], "o", color=INK, markersize=2.2, zorder=4)
    if len(lines) > 1:
        shared = min(map(len, lines))
        middle = np.median([values[:shared] for values in lines], axis=0)
        places = step * np.arange(1, shared + 1)
        axes.plot(places, middle, color=BLUE, linewidth=1.3, zorder=3)
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10), integer=True))
    axes.set_xlim(step, step * max(2, longest))


def attempts_key(lines: Sequence[Sequence[float]], failed: Sequence[bool] = ()) -> list[Line2D]:
    """Return the key of `attempts`, for a legend; the arguments are the same."""
    handles = [Line2D([], [], color=PALE, label="an attempt")]
    if len(lines) > 1:
        handles.append(Line2D([], [], color=BLUE, linewidth=1.3, label="median attempt"))
    if any(failed):
        handles.append(Line2D([], [], color=RED, linestyle=DASHES[RED], label="fell short"))
    if len(set(map(len, lines))) > 1:
        dot: dict[str, Any] = {"marker": "o", "markersize": 2.2, "color": INK, "linestyle": "none"}
        handles.append(Line2D([], [], label="its lesson ends", **dot))
    return handles


def label_ends(axes: Axes, ends: Sequence[tuple[float, str, str]]) -> None:
    """Name lines at their right ends, each in its colour, moved apart where they would meet.

    Args:
        axes: the panel, its y limits set.
        ends: for each line its last value, its name and its colour.
    """
    low, high = axes.get_ylim()
    # A line of type takes about 9 points; the panel may lose a fifth of its height to labels.
    points = 0.8 * axes.bbox.height / axes.figure.dpi * 72.0
    step = 9.0 * (high - low) / points
    placed: list[float] = []
    for value, name, colour in sorted(ends, key=lambda end: end[0]):
        height = value if not placed else max(value, placed[-1] + step)
        placed.append(height)
        axes.annotate(
            name,
            (1.0, height),
            xycoords=("axes fraction", "data"),
            xytext=(4, 0),
            textcoords="offset points",
            color=colour,
            va="center",
            annotation_clip=False,
        )


def bars(axes: Axes, values: Mapping[str, float], colours: Mapping[str, str], absent: str) -> None:
    """Draw named horizontal bars with their numbers in a column at the right.

    Args:
        axes: the panel.
        values: the lengths of the bars by name, from the top down; NaN for none.
        colours: of the bars, by name; grey for the others.
        absent: the word that stands for a missing number.
    """
    axes.set_ylim(len(values) - 0.4, -0.6)
    axes.set_yticks(range(len(values)), list(values))
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.axvline(0, color=INK, linewidth=0.6)
    for place, (name, value) in enumerate(values.items()):
        known = math.isfinite(value)
        if known:
            axes.barh(place, value, height=0.62, color=colours.get(name, GREY))
        axes.annotate(
            f"{round(value, 1) + 0.0:.1f}".replace("-", "−") if known else absent,
            (1.0, place),
            xycoords=("axes fraction", "data"),
            xytext=(26, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=7,
            color=INK if known else GREY,
            style="normal" if known else "italic",
            annotation_clip=False,
        )


def limits_with_zero(values: Iterable[float]) -> tuple[float, float]:
    """Limits of an axis that show 0 and all values, with a little air beyond them.

    Args:
        values: any numbers; NaN is left out.

    Returns:
        The lower and the upper limit.

    >>> limits_with_zero([50.0, 100.0])
    (0.0, 104.0)
    >>> limits_with_zero([])
    (0.0, 1.0)
    """
    known = [float(value) for value in values if math.isfinite(value)]
    low, high = min(known, default=0.0), max(known, default=0.0)
    low, high = min(low, 0.0), max(high, 0.0)
    if low == high:
        return 0.0, 1.0
    air = 0.04 * (high - low)
    return (low - air if low < 0 else 0.0), (high + air if high > 0 else 0.0)
