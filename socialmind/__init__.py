"""A laboratory for societies of agents.

What a modeller needs is importable from here: `Model`, `Agent`, `Patch`, `Population`, `Torus`,
`parameter`, `each` and `once`.
"""

from socialmind.errors import IdleWarning, ModelError, RuleError, SocialmindError
from socialmind.model import Model
from socialmind.parameter import Parameter, parameter
from socialmind.population import Agent, Population
from socialmind.schedule import each, once
from socialmind.worlds.grid import Patch, Torus
from socialmind.worlds.plane.plane import Plane

__version__ = "0.1.0"

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
