"""A laboratory for societies of agents.

What a modeller needs is importable from here: `Model`, `Agent`, `Patch`, `Population`, `Torus`,
`parameter`, `each` and `once`. A name is imported when it is first used, so that what needs none of
them (`socialmind --help`) starts fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from socialmind.errors import IdleWarning, ModelError, RuleError, SocialmindError
from socialmind.society.parameter import Parameter, parameter
from socialmind.version import __version__ as __version__

if TYPE_CHECKING:
    from socialmind.agents.agent import Agent
    from socialmind.model import Model
    from socialmind.society.phases import each, once
    from socialmind.society.population import Population
    from socialmind.worlds.plane.plane import Plane
    from socialmind.worlds.torus.torus import Patch, Torus

_HOMES = {
    "Agent": "socialmind.agents.agent",
    "Model": "socialmind.model",
    "Patch": "socialmind.worlds.torus.torus",
    "Plane": "socialmind.worlds.plane.plane",
    "Population": "socialmind.society.population",
    "Torus": "socialmind.worlds.torus.torus",
    "each": "socialmind.society.phases",
    "once": "socialmind.society.phases",
}

__all__ = [
    "Agent",
    "IdleWarning",
    "Model",
    "ModelError",
    "Parameter",
    "Patch",
    "Plane",
    "Population",
    "RuleError",
    "SocialmindError",
    "Torus",
    "each",
    "once",
    "parameter",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Import a name from where it is defined, once."""
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = getattr(import_module(_HOMES[name]), name)
        return globals()[name]

    def __dir__() -> list[str]:
        return sorted({*globals(), *_HOMES})
