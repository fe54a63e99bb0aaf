"""A moment of a society as a page sees it: who stands where, and in which colour."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.looks import Looks
from socialmind.model import Model
from socialmind.studio.running.colouring import (
    LOOKS,
    Coloured,
    colourings,
    looks_of,
    of_agents,
    of_patches,
    patch_fields,
)
from socialmind.studio.running.frames import packed
from socialmind.studio.running.plots import Panel
from socialmind.worlds.plane.arena import Arena
from socialmind.worlds.plane.scene import scene_of

TURNED = ("heading", "angle")


@dataclass
class Shown:
    """What of a society is shown.

    Attributes:
        agents: by population, what its agents are coloured by.
        patches: the field that patches are coloured by; "" for none.
        networks: whose links are drawn.
    """

    agents: dict[str, str] = field(default_factory=dict)
    patches: str = ""
    networks: tuple[str, ...] = ()

    @classmethod
    def of(cls, society: Model) -> Shown:
        """Return what is shown unless somebody chooses.

        As the model says it looks; or plans, the first field of patches, all networks.
        """
        agents = {}
        for name in society.populations:
            known = colourings(society, name)
            agents[name] = next(one for one in (LOOKS, "plan", "one") if one in known)
        fields = patch_fields(society)
        return cls(agents, fields[0] if fields else "", tuple(society.networks))


def frame_of(
    society: Model, shown: Shown, plots: Sequence[Panel] = (), before: bytes = b"", **said: Any
) -> bytes:
    """Return a society at this moment as a frame.

    Args:
        society: whose moment.
        shown: what of it.
        plots: what panels show of its agents.
        before: what stands before the frame.
        said: what else the header says.
    """
    header: dict[str, Any] = {"tick": society.tick, "populations": {}, **said}
    columns: dict[str, NDArray[Any]] = {}
    if isinstance(society.ground, Arena):
        _plane(society, shown, header, columns)
    else:
        looks = looks_of(society)
        for name in society.populations:
            colouring = shown.agents.get(name, "one")
            _population(society, name, colouring, looks.get(name), header, columns)
    if shown.patches:
        colours, columns["patches"] = _colours(of_patches(society, shown.patches))
        header["patches"] = {"field": shown.patches, **colours}
    if plots:
        header["plots"] = [one.said for one in plots]
        for number, one in enumerate(plots):
            columns |= {f"plot{number}.{name}": values for name, values in one.columns.items()}
    for name in shown.networks:
        columns[f"{name}.links"] = _links(society, name)
    return packed(header, columns, before)


def _population(
    society: Model,
    name: str,
    colouring: str,
    looks: Looks | None,
    header: dict[str, Any],
    columns: dict[str, Any],
) -> None:
    table = society.tables[name]
    slots, fields = table.slots, table.shape.fields
    colours, columns[f"{name}.colour"] = _colours(of_agents(society, name, colouring))
    header["populations"][name] = {"count": len(slots), "by": colouring, **colours}
    columns[f"{name}.id"] = table.columns["_id"][slots].astype(np.uint32)
    for axis in ("x", "y"):
        if axis in fields:
            columns[f"{name}.{axis}"] = table.columns[axis][slots].astype(np.float32)
    if "heading" in fields:
        columns[f"{name}.heading"] = table.columns["heading"][slots].astype(np.float32)
    if looks is not None:
        header["populations"][name]["shape"] = looks.shape
        sizes = looks.sizes(name, len(slots))
        if sizes is not None:
            columns[f"{name}.size"] = sizes


def _plane(society: Model, shown: Shown, header: dict[str, Any], columns: dict[str, Any]) -> None:
    scene, looks = scene_of(society), looks_of(society)
    header["plane"] = {"half_width": scene.half_width, "over": scene.over}
    header["in_hand"] = [
        {"population": name, "id": robot}
        for name in type(society).shape.world.robots
        if (robot := society.ground.steered(name)) is not None
    ]
    teams = list(dict.fromkeys(one.team for one in scene.robots))
    header["populations"] = {team: {"count": 0} for team in teams}
    for team in teams:
        robots = [one for one in scene.robots if one.team == team]
        header["populations"][team] = {"count": len(robots), "kind": "robots"}
        rows = [(one.x, one.y, one.angle, one.radius, one.emits) for one in robots]
        columns[f"{team}.robots"] = np.array(rows, np.float32).reshape(-1, 5)
        columns[f"{team}.id"] = np.array([one.identity for one in robots], np.uint32)
    for part in ("rays", "lines"):
        segments = [getattr(one, part).reshape(-1, 4) for one in scene.robots]
        joined = np.concatenate([np.zeros((0, 4)), *segments])
        columns[part] = joined.astype(np.float32)
    for kind, bodies in (("objects", scene.objects), ("zones", scene.zones)):
        for name, found in bodies.items():
            header["populations"][name] = {"count": len(found), "kind": kind}
            columns[f"{name}.{kind}"] = found.astype(np.float32)
            columns[f"{name}.id"] = np.asarray(society.tables[name].id, np.uint32)
    columns["obstacles"] = scene.obstacles.astype(np.float32)
    for name, said in header["populations"].items():
        if name in looks:
            said["shape"] = looks[name].shape
        if (colouring := shown.agents.get(name, "one")) != "one":
            colours, columns[f"{name}.colour"] = _colours(of_agents(society, name, colouring))
            said.update(by=colouring, **colours)


def _links(society: Model, name: str) -> NDArray[np.uint32]:
    """Return the identities of both ends of each link, (links, 2)."""
    table: Any = society.tables[name]
    return np.column_stack([table.source, table.target]).astype(np.uint32)


def _colours(found: Coloured) -> tuple[Mapping[str, Any], NDArray[np.uint8]]:
    """Return what the header says of colours, and the place of each."""
    said: dict[str, Any] = {"colours": list(found.colours)} if found.colours else {}
    if found.words:
        return {"words": list(found.words), **said}, found.values
    low, high = found.range
    return {"range": [low, high], **said}, found.places(low, high)
