"""A society as a real `mesa.Model`, over the same rows and the same scheduler.

Nothing else in socialmind imports Mesa; `Model.mesa()` imports this file when it is called.
"""

from __future__ import annotations

import inspect
from functools import partial
from typing import Any, ClassVar

import mesa
import numpy as np
from mesa.datacollection import DataCollector

from socialmind.errors import ModelError, UnknownNameError, nearest
from socialmind.mesa.agents import SocietyAgent, class_of_agents, through
from socialmind.mesa.grid import SocietyGrid

_MESA_NAMES = frozenset(
    ("current_step", "random", "rng", "running", "scenario", "seed", "steps", "time")
)
"""What a Mesa model keeps under these names, in one version or another."""


class SocietyModel(mesa.Model):
    """A society under Mesa; `mesa_model` makes it.

    Parameters, variables and populations of the society are attributes of it, and so are the
    columns of its `series()`.

    Attributes:
        society: the society.
        running: whether it is younger than the model's own length, `ticks`, and no interruption
            has ended it.
        datacollector: holds the series at the start and after every step; another in its place
            collects then too, and anew after SolaraViz's Reset.
    """

    agent_class: ClassVar[dict[str, type[SocietyAgent]]] = {}
    """The class of the agents of each population."""
    _reporters: ClassVar[dict[str, Any] | None] = None
    _made = False

    def __init__(self, society: Any) -> None:
        self.society = society
        self._living: dict[str, dict[int, SocietyAgent]] = {name: {} for name in society.tables}
        self._following = False
        self._grid: SocietyGrid | None = None
        super().__init__(rng=society.seed)
        self.follow()
        self._observed = {"tick": society.tick, **society.series()}
        reporters = type(self)._reporters
        if reporters is None:
            columns = {name: partial(_observed, name=name) for name in self._observed}
            reporters = {"model_reporters": columns}
        self._datacollector = DataCollector(**reporters)
        self._end_tick()
        self._made = True

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a variable of the society, or what Mesa's own tools keep in a model."""
        own = name.startswith("_") or name in self.__dict__ or name in _MESA_NAMES
        if self._made and not own and not hasattr(type(self), name):
            kind = type(self.society)
            raise UnknownNameError(
                f"{kind.name} has no variable {name!r}; {nearest(name, kind.variables)}; declare "
                f"it in the society's class ({name}: float = 0.0), or call it _{name}"
            )
        super().__setattr__(name, value)

    def __getattr__(self, name: str) -> Any:
        """Return a column of the society's series, or fail as Python does."""
        if not name.startswith("_") and "society" in self.__dict__:
            if name in ("grid", "space", "space_of_cells") and not self.society.ground.layered:
                # Python comes here when these raised AttributeError; say why.
                raise AttributeError(f"{self.society.name} has no patches, hence no grid")
            series = self.society.series()
            if name in series:
                return series[name]
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    @property
    def tick(self) -> int:
        """How many ticks of the society have run."""
        return self.society.tick

    def step(self) -> None:
        """Run one tick of the society."""
        self.society.advance(1)
        self.follow()
        self._observed = {"tick": self.society.tick, **self.society.series()}
        self._end_tick()

    def _end_tick(self) -> None:
        self._datacollector.collect(self)
        self.running = self.society.tick < self.society.ticks and self.society.over is None

    # Agents -----------------------------------------------------------------------------------

    @property
    def agents(self) -> Any:
        """All living agents, an AgentSet: population by population, then in order of birth."""
        self.follow()
        return super().agents

    @property
    def agents_by_type(self) -> Any:
        """The AgentSet of each class of agents."""
        self.follow()
        return super().agents_by_type

    def follow(self) -> None:
        """Register those born since, and strike off the dead; reading `agents` does it too."""
        if self._following:
            return
        self._following = True
        try:
            for name, table in self.society.tables.items():
                known = self._living[name]
                before = np.fromiter(known, np.int64, len(known))
                now = table.id
                if not np.array_equal(before, now):
                    for identity in np.setdiff1d(before, now, assume_unique=True).tolist():
                        known[identity].remove()
                    for identity in np.setdiff1d(now, before, assume_unique=True).tolist():
                        self.agent_class[name](self, identity)
                if self._grid is not None:
                    self._grid.see_patches()
                    self._grid.place(table, known)
        finally:
            self._following = False

    def enrol(self, agent: SocietyAgent) -> None:
        """Take note of an agent, which calls this when it is made."""
        self._living[agent.population][agent.id] = agent

    def strike_off(self, agent: SocietyAgent) -> None:
        """Forget an agent, which calls this when it is removed."""
        self._living[agent.population].pop(agent.id, None)

    # Space ------------------------------------------------------------------------------------

    @property
    def space_of_cells(self) -> SocietyGrid:
        """The grid, made when it is first asked for.

        Raises:
            AttributeError: the model has no world.
        """
        if self._grid is None:
            if not self.society.ground.layered:
                raise AttributeError(f"{self.society.name} has no patches, hence no grid")
            self._grid = SocietyGrid(self.society.ground.world, self.random)
        return self._grid

    @property
    def grid(self) -> SocietyGrid:
        """The world as a grid of Mesa, with the agents in its cells."""
        grid = self.space_of_cells
        self.follow()
        return grid

    @property
    def space(self) -> SocietyGrid:
        """The same as `grid`."""
        return self.grid

    # Data -------------------------------------------------------------------------------------

    @property
    def datacollector(self) -> Any:
        """What collects the society's data after each step."""
        return self._datacollector

    @datacollector.setter
    def datacollector(self, collector: Any) -> None:
        self._datacollector = collector
        # SolaraViz's Reset makes another model of this class, which belongs to this one alone.
        type(self)._reporters = {
            "model_reporters": collector.model_reporters,
            "agent_reporters": collector.agent_reporters,
            "agenttype_reporters": collector.agenttype_reporters,
            "tables": {name: list(columns) for name, columns in collector.tables.items()},
        }


def mesa_model(society: Any) -> SocietyModel:
    """Return a society as a `mesa.Model`.

    Its class is its own and named after the model. Calling it without arguments, as SolaraViz's
    Reset does, makes the society anew with the same seed, scheme and parameters; keyword arguments
    change `seed` and parameters.

    Args:
        society: the society, at any tick.

    Raises:
        ModelError: a name in the model is one that Mesa uses.
    """
    kind = type(society)
    taken = {*dir(SocietyModel), "society", *_MESA_NAMES}
    members: dict[str, Any] = {"__doc__": kind.__doc__, "__module__": kind.__module__}
    for name in (*kind.parameters, *kind.variables, *kind.populations):
        if name in taken:
            raise ModelError(
                f"{name!r} in {kind.name}, a name of Mesa's models",
                "another name",
                "rename it to use model.mesa()",
            )
        members[name] = through("society", name, writable=name not in kind.populations)
    members["agent_class"] = {name: class_of_agents(one) for name, one in kind.populations.items()}
    members["__init__"] = _initialiser(society)
    made: SocietyModel = type(kind.__name__, (SocietyModel,), members)(society)
    return made


def _initialiser(society: Any) -> Any:
    """Return the `__init__` of a society's class; its signature is what SolaraViz reads."""
    kind, compiled, schemes = type(society), society.compiled, society.schemes
    settings: dict[str, Any] = {"seed": society.seed, **society.parameter_values()}
    tables = society._tables_given

    def initialise(model: SocietyModel, society: Any = None, **changed: Any) -> None:
        if society is None:
            values = settings | {name: _read(kind, name, changed[name]) for name in changed}
            society = kind(compiled=compiled, scheme=schemes or None, **values, **tables)
        SocietyModel.__init__(model, society)

    named = inspect.Parameter
    initialise.__signature__ = inspect.Signature(  # type: ignore[attr-defined]  # inspect reads it
        [
            named("self", named.POSITIONAL_OR_KEYWORD),
            named("society", named.POSITIONAL_OR_KEYWORD, default=None),
            *(named(name, named.KEYWORD_ONLY, default=settings[name]) for name in settings),
        ]
    )
    return initialise


def _read(kind: Any, name: str, value: Any) -> Any:
    """Return a setting, which SolaraViz gives as a text from its field for texts."""
    if not isinstance(value, str):
        return value
    return int(value) if name == "seed" else kind.parameters[name].read(value)


def _observed(model: SocietyModel, name: str) -> Any:
    """Return a column of the series as it was at the last step."""
    return model._observed.get(name)
