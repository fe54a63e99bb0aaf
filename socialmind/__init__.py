"""A laboratory for societies of agents.

What a modeller needs is importable from here: `Model`, `Agent`, `Patch`, `Population`, `Grid`,
`Torus`, `Network`, `parameter`, `each` and `once`. A name is imported when it is first used, so
that what needs none of them (`socialmind --help`) starts fast.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from socialmind.agents.agent import Agent as Agent
    from socialmind.agents.interaction import Interaction as Interaction
    from socialmind.agents.message import Message as Message
    from socialmind.errors import IdleWarning as IdleWarning
    from socialmind.errors import ModelError as ModelError
    from socialmind.errors import RuleError as RuleError
    from socialmind.errors import SocialmindError as SocialmindError
    from socialmind.language.plans import repeat as repeat
    from socialmind.language.plans import sequence as sequence
    from socialmind.language.plans import until as until
    from socialmind.language.plans import when as when
    from socialmind.model import Model as Model
    from socialmind.networks.network import Link as Link
    from socialmind.networks.network import Network as Network
    from socialmind.networks.start import generator as generator
    from socialmind.society.founding.civilisations import Civilisation as Civilisation
    from socialmind.society.looks import Looks as Looks
    from socialmind.society.messages import Messages as Messages
    from socialmind.society.parameter import Parameter as Parameter
    from socialmind.society.parameter import parameter as parameter
    from socialmind.society.phases import each as each
    from socialmind.society.phases import once as once
    from socialmind.society.population import Population as Population
    from socialmind.version import __version__ as __version__
    from socialmind.worlds.grid.grid import Grid as Grid
    from socialmind.worlds.grid.grid import Patch as Patch
    from socialmind.worlds.grid.grid import Torus as Torus
    from socialmind.worlds.plane.plane import Plane as Plane
else:
    from coglogo_py.on_demand import on_demand

    __getattr__, __dir__, __all__ = on_demand(
        __name__,
        {
            "socialmind.agents.agent": "Agent",
            "socialmind.agents.interaction": "Interaction",
            "socialmind.agents.message": "Message",
            "socialmind.errors": "IdleWarning ModelError RuleError SocialmindError",
            "socialmind.language.plans": "repeat sequence until when",
            "socialmind.model": "Model",
            "socialmind.networks.network": "Link Network",
            "socialmind.networks.start": "generator",
            "socialmind.society.founding.civilisations": "Civilisation",
            "socialmind.society.looks": "Looks",
            "socialmind.society.messages": "Messages",
            "socialmind.society.parameter": "Parameter parameter",
            "socialmind.society.phases": "each once",
            "socialmind.society.population": "Population",
            "socialmind.version": "__version__",
            "socialmind.worlds.grid.grid": "Grid Patch Torus",
            "socialmind.worlds.plane.plane": "Plane",
        },
    )
