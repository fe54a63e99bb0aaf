"""The figures of the farmer-artisan society, after figures 3.8 to 3.14 of the thesis.

`draw(run)` gives four of them: the stocks, the population, the lands coloured by activity, and the
inside of three minds. Blue stands for wheat and farmers, red for tools and artisans, gold for
trade.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure, SubFigure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.worlds.grid.geometry import lattice

if TYPE_CHECKING:
    from coglogo_py.scheme import CognitiveScheme
    from socialmind.experiments import Run

COLOURS = {  # of cognitons and plans
    "Farmer": paper.BLUE,
    "Artisan": paper.RED,
    "GrowWheat": paper.BLUE,
    "ProduceTools": paper.RED,
    "TradeWheatForTools": paper.GOLD,
    "TradeToolsForWheat": paper.GOLD,
}
# Of people whose plan has a colour: a mark, so that grey tells them too, and how large it is.
MARKS = {paper.BLUE: ("o", 1.0), paper.RED: ("^", 1.5), paper.GOLD: ("v", 1.3), "white": ("o", 1.0)}
ACTIVITY = LinearSegmentedColormap.from_list("wheat to tools", paper.BLUE_TO_RED)
# The ticks of figures 3.8, 3.9, 3.11 and 3.13.
THESIS_TICKS = (
    0, 27_000, 100_000, 150_000, 200_000, 250_000, 300_000, 350_000, 400_000, 450_000, 500_000,
)  # fmt: skip
LINES_DRAWN = 200  # trajectories in a panel; more would be a solid block
PATCHES_DRAWN = 99  # along a side of a map: of a larger world, its middle


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `stocks`, `population`, `lands` and `mind` by name.
    """
    series, agents = run.series, run.agents
    size = int(run.parameters.get("world_size", 33))
    villages = lattice(size, int(run.parameters.get("n_villages", 1)))
    with paper.style():
        return {
            "stocks": stocks(series),
            "population": population(series),
            "lands": lands(agents, size, villages),
            "mind": mind(agents, run.scheme),
        }


def stocks(series: pd.DataFrame) -> Figure:
    """Draw what the people and the villages hold, over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of four panels: wheat and tools, of the people and of the villages.
    """
    figure = paper.figure(paper.PAGE, 95)
    panels = figure.subplots(2, 2, sharex=True)
    shown = (
        ("wheat", "Wheat, all people", "wheat (units)", paper.BLUE),
        ("tools", "Tools, all people", "tools (number)", paper.RED),
        ("village_wheat", "Wheat, village stock", "wheat (units)", paper.BLUE),
        ("village_tools", "Tools, village stock", "tools (number)", paper.RED),
    )
    for axes, letter, (column, title, unit, colour) in zip(panels.flat, "abcd", shown, strict=True):
        scale = paper.time_axis(axes, _ticks(series))
        axes.plot(series["tick"] / scale, series[column], color=colour, linewidth=0.8)
        if letter in "ab":
            axes.set_xlabel("")  # the panel below says it
        axes.set_ylabel(unit)
        axes.set_ylim(*paper.limits_with_zero(series[column]))
        axes.yaxis.set_major_formatter("{x:,.0f}")
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        paper.panel_title(axes, letter, title)
    return figure


def population(series: pd.DataFrame) -> Figure:
    """Draw how many are farmers, artisans and undecided, and how specialised the lands are.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of two panels.
    """
    figure = paper.figure(paper.COLUMN, 95)
    counts, special = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    ticks = _ticks(series)
    scale = paper.time_axis(special, ticks)
    lines = [
        ("farmers", paper.BLUE, "-"),
        ("artisans", paper.RED, "-"),
        ("undecided", paper.GREY, (0, (3, 1.5))),
    ]
    if series["population"].nunique() > 1:
        lines.insert(0, ("population", paper.INK, ":"))
    ends = []
    for column, colour, dashes in lines:
        counts.plot(
            series["tick"] / scale, series[column], color=colour, linestyle=dashes,
            drawstyle="steps-post", clip_on=False,
        )  # fmt: skip
        if len(series):
            ends.append((float(series[column].iloc[-1]), column, colour))
    counts.set_ylim(0, max(1.0, float(series["population"].max() if len(series) else 1)) * 1.02)
    counts.yaxis.set_major_locator(MaxNLocator(6, integer=True))
    counts.set_ylabel("people (number)")
    counts.tick_params(labelbottom=False)
    paper.panel_title(counts, "a", "People by specialisation")
    paper.label_ends(counts, ends)

    special.plot(series["tick"] / scale, series["specialisation"], color=paper.PURPLE)
    special.set_ylim(0, 1.02)
    special.set_ylabel("mean |t − w| / (t + w)")
    paper.panel_title(special, "b", "Specialisation of the lands")
    return figure


def lands(agents: pd.DataFrame, size: int, villages: Sequence[tuple[float, float]]) -> Figure:
    """Draw maps of the lands, coloured by what was worked on them, at chosen ticks.

    Of a world of more than 99 patches a side, the maps show the middle.

    Args:
        agents: one row an agent and recorded tick.
        size: patches along one side of the world.
        villages: the villages' patches.

    Returns:
        A figure of up to eleven maps and their key.
    """
    ticks = chosen_ticks(agents["tick"].unique())
    columns = min(4, len(ticks) + 1)
    rows = -(-(len(ticks) + 1) // columns)
    cell = paper.PAGE / 4
    figure = paper.figure(max(cell * columns, paper.COLUMN), (cell + 1.5) * rows + 6)
    panels = figure.subplots(rows, columns, squeeze=False)
    side = min(size, PATCHES_DRAWN)
    low = -(side // 2) - 0.5
    high = low + side
    inside = [(x, y) for x, y in villages if low < x < high and low < y < high]
    for place, axes in enumerate(panels.flat):
        if place >= len(ticks):
            axes.set_axis_off()
            continue
        tick = ticks[place]
        _map(axes, agents[agents["tick"] == tick], (low, high), inside)
        axes.spines[["top", "right"]].set_visible(True)
        axes.set(xlim=(low, high), ylim=(low, high), aspect="equal")
        axes.set_title(f"tick {tick:,}")
        reach = 15 * max(1, int(high) // 15) if side > 30 else side // 2
        axes.set(xticks=(-reach, 0, reach), yticks=(-reach, 0, reach))
        # The maps share their axes: only the outer ones carry numbers.
        axes.tick_params(labelbottom=place // columns == rows - 1, labelleft=place % columns == 0)
    middle = f"; the middle {side} of {size:,}" if side < size else ""
    figure.supxlabel(f"x (patches{middle})", fontsize=7.5)
    figure.supylabel("y (patches)", fontsize=7.5)
    _map_key(figure, panels.flat[len(ticks)])
    return figure


def chosen_ticks(recorded: Sequence[int]) -> list[int]:
    """The recorded ticks to draw maps of: nearest to the thesis's, or spread over a shorter run.

    Args:
        recorded: the ticks at which agents were recorded.

    Returns:
        At most eleven of them, ascending.

    >>> chosen_ticks([0, 10, 20])
    [0, 10, 20]
    >>> chosen_ticks(range(0, 500_001, 10_000))[:4]
    [0, 30000, 100000, 150000]
    """
    ticks = np.unique(np.asarray(recorded, dtype=np.int64))
    if len(ticks) <= len(THESIS_TICKS):
        return [int(tick) for tick in ticks]
    if ticks[-1] >= THESIS_TICKS[-1]:
        wanted = np.array(THESIS_TICKS)
    else:
        wanted = np.linspace(ticks[0], ticks[-1], len(THESIS_TICKS))
    nearest = {int(ticks[np.abs(ticks - tick).argmin()]) for tick in wanted}
    return sorted(nearest)


def _map(
    axes: Axes,
    now: pd.DataFrame,
    extent: tuple[float, float],
    villages: Sequence[tuple[float, float]],
) -> None:
    """Draw one world: lands, villages, people."""
    low, high = extent
    patch = paper.PAGE / 4 / 25.4 * 72 * 0.8 / (high - low)  # its side in points, about
    owned = now.dropna(subset=["land_x", "land_y", "land_tools", "land_wheat"])
    owned = owned[owned["land_x"].between(low, high) & owned["land_y"].between(low, high)]
    people = now[now["x"].between(low, high) & now["y"].between(low, high)]
    crowd = len(owned) + len(people) > 5000  # pixels, where shapes would make a heavy file
    if len(owned):
        tools = owned["land_tools"].to_numpy(float)
        both = tools + owned["land_wheat"].to_numpy(float)
        share = np.divide(tools, both, out=np.full(len(both), 0.5), where=both > 0)
        axes.scatter(
            owned["land_x"].to_numpy(float), owned["land_y"].to_numpy(float),
            c=share, cmap=ACTIVITY, vmin=0, vmax=1, marker="s", s=(2.1 * patch) ** 2,
            linewidths=np.where(share > 0.5, 0.7, 0.3), zorder=2, rasterized=crowd, clip_on=False,
            # The two ends of the scale are equally dark in print without colours.
            edgecolors=np.where(share > 0.5, paper.INK, "white"),
        )  # fmt: skip
    if villages:
        x, y = zip(*villages, strict=True)
        axes.scatter(
            x, y, marker="D", s=(2.4 * patch) ** 2, color="white", edgecolors=paper.INK,
            linewidths=min(0.9, 0.3 * patch), zorder=3,
        )  # fmt: skip
    if len(people):
        plans = people["plan"].astype(object).where(people["plan"].notna(), None)
        colours = np.array([COLOURS.get(plan, "white") for plan in plans])
        for colour, (marker, larger) in MARKS.items():
            own = people[colours == colour]
            axes.scatter(
                own["x"].to_numpy(float), own["y"].to_numpy(float), color=colour, marker=marker,
                s=(larger * min(2.55, 0.9 * patch)) ** 2,
                # A dark one on a land of its colour would not be seen.
                edgecolors=paper.INK if colour == "white" else "white",
                linewidths=min(0.45, 0.15 * patch), zorder=4, rasterized=crowd, clip_on=False,
            )  # fmt: skip


def _map_key(figure: Figure, axes: Axes) -> None:
    """Say what the colours and marks of the maps mean, in a cell of its own."""
    marks = [
        Line2D([], [], marker="s", color="none", markerfacecolor="#dccfe0",
               markeredgecolor="none", markersize=6, label="land (enlarged)"),
        Line2D([], [], marker="s", color="none", markerfacecolor=paper.BLUE_TO_RED[6],
               markeredgecolor=paper.INK, markeredgewidth=0.7, markersize=6,
               label="more tools than wheat"),
        *(
            Line2D([], [], marker=MARKS[colour][0], color="none", markerfacecolor=colour,
                   markeredgecolor=paper.INK if colour == "white" else "white",
                   markeredgewidth=0.45, label=name, markersize=3 * MARKS[colour][1])
            for name, colour in (
                ("person growing wheat", paper.BLUE),
                ("making tools", paper.RED),
                ("trading", paper.GOLD),
                ("without a plan", "white"),
            )
        ),
        Line2D([], [], marker="D", color="none", markerfacecolor="white",
               markeredgecolor=paper.INK, markeredgewidth=0.9, markersize=5, label="village"),
    ]  # fmt: skip
    axes.legend(handles=marks, loc="upper left", bbox_to_anchor=(-0.06, 1.04), handletextpad=0.3)
    bar = axes.inset_axes((0.08, 0.16, 0.84, 0.07))
    scale = figure.colorbar(
        ScalarMappable(Normalize(0, 1), ACTIVITY), cax=bar, orientation="horizontal"
    )
    scale.set_ticks([0, 0.5, 1], labels=["wheat", "½", "tools"])
    scale.outline.set_visible(False)
    bar.set_title("share of toolmaking, t / (t + w)", fontsize=7, pad=3)


def mind(
    agents: pd.DataFrame,
    scheme: CognitiveScheme | None,
    shown: Sequence[tuple[str, pd.Series]] | None = None,
    over_time: bool = True,
) -> Figure:
    """Draw the inside of three minds at the last recorded tick, and all specialisations over time.

    The three are the farmer and the artisan of median specialisation, and the person whose Farmer
    and Artisan cognitons are closest to one another.

    Args:
        agents: one row an agent and recorded tick.
        scheme: the scheme whose decision maker gives the probabilities; without it, none are drawn.
        shown: other minds in place of these three: for each its heading, and its row of `agents`.
        over_time: whether there are trajectories.

    Returns:
        A figure with a row for each mind and one for the trajectories.
    """
    shown = _typical(agents) if shown is None else shown
    heights = [38.0] * len(shown) + [58.0] * over_time
    figure = paper.figure(paper.PAGE, sum(heights), gap=2.0)
    parts = figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
    letters = iter("abcdefgh")

    def headed(title: str) -> str:
        return f"$\\bf{{{next(letters)}}}$   {title}" if len(heights) > 1 else title

    drawn = [
        _one_mind(part, headed(title), row, scheme)
        for part, (title, row) in zip(parts, shown, strict=False)
    ]
    for panels in zip(*drawn, strict=True):  # alike for every mind, so that minds compare
        low = min(axes.get_xlim()[0] for axes in panels)
        high = max(axes.get_xlim()[1] for axes in panels)
        for axes in panels:
            axes.set_xlim(low, high)
    if over_time:
        _trajectories(parts[-1], agents, letters)
    return figure


def _typical(agents: pd.DataFrame) -> list[tuple[str, pd.Series]]:
    """The minds to show, each with its heading; none twice."""
    if agents.empty:
        return []
    now = agents[agents["tick"] == agents["tick"].max()]
    leaning = now["farmer"] - now["artisan"]
    picks = []
    for kind, lean in (("Typical farmer", leaning), ("Typical artisan", -leaning)):
        ranked = lean[lean > 0].sort_values()
        if len(ranked):
            picks.append((kind, ranked.index[(len(ranked) - 1) // 2]))
    picks.append(("Least specialised", leaning.abs().idxmin()))
    shown = []
    seen: list[object] = []
    for kind, index in picks:
        if index not in seen:
            seen.append(index)
            row = now.loc[index]
            shown.append((f"{kind}: agent {row['agent']}, tick {row['tick']:,}", row))
    return shown


def _one_mind(
    part: SubFigure, title: str, row: pd.Series, scheme: CognitiveScheme | None
) -> tuple[Axes, Axes, Axes]:
    """Draw one mind: its cognitons, the weights of its plans and their probabilities."""
    cognitons = _named(row, "cogniton_")
    weights = _named(row, "weight_")
    chances = probabilities(weights, scheme)
    part.suptitle(title, x=0.005, ha="left", fontsize=8)
    values, plans, odds = part.subplots(1, 3, width_ratios=(1.15, 1, 0.8))
    values.set_xscale("symlog", linthresh=10.0)
    values.set_xticks((-100, 0, 100), ("−100", "0", "100"))
    values.set_xticks((-1000, -10, 10, 1000), minor=True)
    for axes, named, label, absent in (
        (values, cognitons, "cogniton value (log beyond ±10)", "inactive"),
        (plans, weights, "plan weight", "closed"),
        (odds, chances, "probability (%)", "closed" if scheme else "no scheme"),
    ):
        paper.bars(axes, named, COLOURS, absent)
        axes.set_xlabel(label)
    odds.set_yticks([])  # the plans are named beside their weights
    plans.xaxis.set_major_locator(MaxNLocator(4))
    odds.set_xlim(0, 100)
    return values, plans, odds


def probabilities(weights: dict[str, float], scheme: CognitiveScheme | None) -> dict[str, float]:
    """The probability of each plan, in percent.

    Args:
        weights: the plans' weights, NaN for those not available.
        scheme: the scheme whose decision maker decides.

    Returns:
        A percentage for each plan, NaN for those not available and for all without a scheme.
    """
    available = [plan for plan, weight in weights.items() if np.isfinite(weight)]
    if scheme is None or not available:
        return dict.fromkeys(weights, float("nan"))
    order = [plan for plan in scheme.plans if plan in available]
    maker = scheme.decision_maker
    shares = maker.probabilities(np.array([weights[plan] for plan in order]), maker.bias)
    percent = {plan: 100.0 * float(share) for plan, share in zip(order, shares, strict=True)}
    return {plan: percent.get(plan, float("nan")) for plan in weights}


def _trajectories(part: SubFigure, agents: pd.DataFrame, letters: Iterator[str]) -> None:
    """Draw the Farmer and the Artisan cognitons of the people over time.

    Where one is the other with its sign turned, as the model's own scheme reinforces them, the
    Artisan cogniton alone is drawn.
    """
    people = np.sort(agents["agent"].unique())
    step = max(1, -(-len(people) // LINES_DRAWN))
    drawn = agents[agents["agent"].isin(people[::step])].sort_values(["agent", "tick"])
    last = drawn.groupby("agent").tail(1).set_index("agent")
    some = f", {len(last)} of {len(people):,} people" if step > 1 else ", all people"
    mirrored = np.allclose(drawn["farmer"], -drawn["artisan"], equal_nan=True)
    columns = ("artisan",) if mirrored else ("farmer", "artisan")
    panels = part.subplots(1, len(columns), sharey=True, squeeze=False)[0]
    furthest = drawn[["farmer", "artisan"]].abs().to_numpy(float).max(initial=0.0)
    reach = max(1.0, 1.07 * furthest)
    also = "; Farmer is its negative" if mirrored else ""
    for axes, column in zip(panels, columns, strict=True):
        paper.panel_title(axes, next(letters), f"{column.capitalize()} cogniton{some}{also}")
        scale = paper.time_axis(axes, _ticks(drawn))
        for agent, rows in drawn.groupby("agent"):
            lead = float(last.loc[agent, "artisan"] - last.loc[agent, "farmer"])
            colour = paper.RED if lead > 0 else paper.BLUE if lead < 0 else paper.GREY
            axes.plot(rows["tick"] / scale, rows[column], color=colour, linewidth=0.7, alpha=0.75)
        axes.set_ylim(-reach, reach)
        axes.yaxis.set_major_locator(MaxNLocator(5, steps=(1, 1.5, 2, 5, 10)))
        axes.axhline(0, color=paper.GREY, linewidth=0.5, zorder=0)
    panels[0].set_ylabel("cogniton value")
    leaning = last["artisan"] - last["farmer"]
    ends = [
        (float(last.loc[group, "artisan"].median()), name, colour)
        for name, colour, group in (
            ("artisans", paper.RED, leaning > 0),
            ("farmers", paper.BLUE, leaning < 0),
        )
        if group.any()
    ]
    paper.label_ends(panels[-1], ends)


def _named(row: pd.Series, prefix: str) -> dict[str, float]:
    """The values of the columns with a prefix, by the rest of their names; NaN for null."""
    return {
        str(column).removeprefix(prefix): float("nan") if pd.isna(value) else float(value)
        for column, value in row.items()
        if str(column).startswith(prefix)
    }


def _ticks(table: pd.DataFrame) -> list[float]:
    """The recorded ticks of a table, [0] for an empty one."""
    return sorted(float(tick) for tick in table["tick"].unique()) or [0.0]
