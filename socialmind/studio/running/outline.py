"""The outline of a model and of its society: what a page must know to offer it."""

from __future__ import annotations

import inspect
import math
from typing import Any

from socialmind.learning.imprinting.steered import shown_skills
from socialmind.model import Model
from socialmind.studio.running.colouring import colourings, patch_fields
from socialmind.studio.running.turns import turnless
from socialmind.worlds.plane.arena import Arena


def outline_of_model(model_class: type[Model]) -> dict[str, Any]:
    """Return what a model declares: about, parameters with units and ranges, populations."""
    return {
        "name": model_class.name,
        "about": (inspect.getdoc(model_class) or "").partition("\n")[0],
        "ticks": model_class.ticks,
        "parameters": [
            {
                "name": one.name,
                "kind": one.kind.__name__,
                "default": one.default,
                "unit": one.unit,
                "low": one.low,
                "high": one.high,
                "choices": list(one.choices),
                "doc": one.doc,
            }
            for one in model_class.parameters.values()
        ],
        "populations": {
            name: {
                "about": (inspect.getdoc(one.agent) or "").partition("\n")[0],
                "scheme": one.mind is not None,
                "skills": one.hierarchy is not None,
            }
            for name, one in model_class.populations.items()
        },
        "buttons": {
            label: (inspect.getdoc(function) or "").partition("\n")[0]
            for label, function in model_class.buttons.items()
        },
        "turnless": turnless(model_class),
    }


def outline_of_society(society: Model) -> dict[str, Any]:
    """Return how large its world is, and what it can be coloured by."""
    extent, ground = society.ground.extent, society.ground
    ends = extent is not None and math.isfinite(extent.width)
    return {
        "world": extent._asdict() if extent is not None and ends else None,
        "plane": {"half_width": ground.half_width} if isinstance(ground, Arena) else None,
        "robots": _robots(society) if isinstance(ground, Arena) else {},
        "colourings": {name: colourings(society, name) for name in society.populations},
        "patches": patch_fields(society),
        "networks": {
            name: [network.shape.links.source, network.shape.links.target]
            for name, network in society.networks.items()
        },
        "series": [name for name in society.series() if name != "tick"],
    }


def _robots(society: Model) -> dict[str, Any]:
    """Return what robots can be told, and which of their skills one can show by steering them."""
    return {
        name: {
            "actuators": [
                {"name": one, "side": _side(act)} for one, act in robots.actuators.items()
            ],
            "skills": shown_skills(society, name),
        }
        for name, robots in type(society).shape.world.robots.items()
        if robots.actuators
    }


def _side(act: Any) -> str:
    """Return on which side of the body a wheel pushes; nothing for what is no wheel."""
    left = act.settings.get("left")
    if left is None or not isinstance(left, int | float):
        return ""
    return "left" if left > 0 else "right" if left < 0 else "middle"
