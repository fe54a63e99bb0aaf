"""Pages look at a society, and into its agents."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from socialmind.interventions.edit import Edit
from socialmind.studio.running.hierarchies import traced
from socialmind.studio.running.moment import Shown, frame_of
from socialmind.studio.running.plots import panel_of, table_of
from socialmind.studio.running.stage import Stage
from socialmind.studio.running.supposing import supposed

MOST_PLOTS = 8


def join(stage: Stage) -> None:
    """Tell somebody new all that was said so far."""
    stage.say_all()


def seen(stage: Stage) -> None:
    """Note that another frame is wanted."""
    stage.wanted = True


def show(stage: Stage, **what: Any) -> None:
    """Colour agents or patches by something else."""
    shown = Shown(**{**vars(stage.shown), **what})
    frame_of(stage.run.society, shown)  # refuses what there is not
    stage.shown = shown
    stage.show()


def watch(stage: Stage, population: str | None = None, id: int | None = None) -> None:
    """Look inside an agent from now on, or inside nobody."""
    stage.watch(None if population is None or id is None else (population, int(id)))


def trace(stage: Stage, population: str, id: int, ticks: int) -> None:
    """Say how an agent's hierarchy went in the last ticks."""
    found = traced(stage.run, population, int(id), ticks)
    stage.say("trace", population=population, id=int(id), **found)


def plots(stage: Stage, panels: list[dict[str, Any]]) -> None:
    """Send what these panels show of the agents with each frame (`plots.Panel`)."""
    for panel in panels:
        panel_of(stage.run.society, panel)  # refuses what there is not
    others = [one for one in stage.plots if one not in panels]  # of other pages
    stage.plots = [*others, *panels][-MOST_PLOTS:]
    stage.show()


def table(stage: Stage, panel: Mapping[str, Any]) -> None:
    """Say what a panel shows as a table, whole."""
    from socialmind.documents.labels import units_recorded

    run = stage.run
    columns = table_of(run.society, panel, stage.history.columns())
    kind = type(run.society)
    units = units_recorded(kind)
    stage.say("table", columns=columns, model=kind.name, tick=run.tick, units=units)


def suppose(stage: Stage, population: str, id: int, part: str, value: Any) -> None:
    """Say what an agent would decide if a value were another; nothing changes."""
    edit = Edit(stage.run.tick, population, id, part, value)
    stage.say("supposed", **supposed(stage.run.society, edit))
