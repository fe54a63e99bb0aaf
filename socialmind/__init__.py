"""A laboratory for societies of agents.

What a modeller needs is importable from here: `Model`, `Agent`, `Patch`, `Population`, `Torus`,
`parameter`, `each` and `once`. A name is imported when it is first used, so that what needs none of
them (`socialmind --help`) starts fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from socialmind.errors import IdleWarning, ModelError, RuleError, SocialmindError

# At once: else the module of this name would stand for the function, once something imports it.
from socialmind.parameter import Parameter, parameter

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.population import Agent, Population
    from socialmind.schedule import each, once
    from socialmind.worlds.grid import Patch, Torus
    from socialmind.worlds.plane.plane import Plane

__version__ = "0.1.0"

_HOMES = {
    "Agent": "socialmind.population",
    "Model": "socialmind.model",
    "Patch": "socialmind.worlds.grid",
    "Plane": "socialmind.worlds.plane.plane",
    "Population": "socialmind.population",
    "Torus": "socialmind.worlds.grid",
    "each": "socialmind.schedule",
    "once": "socialmind.schedule",
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
