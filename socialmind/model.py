"""Models: what a modeller subclasses and declares, and what runs.

A model class declares parameters, variables, populations, a world and the order of its rules; an
instance is a running society:

    society = FarmerArtisan(seed=1, n_agents=30)
    society.advance(1000)
    society.humans.wheat.mean()
"""

from __future__ import annotations

import copy
import copyreg
import inspect
import re
import sys
import warnings
from abc import ABCMeta
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.numbers import whole_number
from socialmind.agents.agent_columns import agent_columns
from socialmind.compiling.layout import model_dtype
from socialmind.engine.engine import Engine
from socialmind.engine.explaining import explained
from socialmind.engine.ticks import taken
from socialmind.errors import IdleWarning, SocialmindError, nearest
from socialmind.fields import Field, place_of_field
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape
from socialmind.language.source import hold_text
from socialmind.society.admitting import admitted
from socialmind.society.connection import connect, names_of_minds
from socialmind.society.declaration import declaration_of, kept_names
from socialmind.society.making import ignored, schemes_of, set_values, size_of, tables_of
from socialmind.society.parameter import Parameter
from socialmind.society.phases import PhaseDeclaration
from socialmind.society.population import Population
from socialmind.society.state import restore, state_of
from socialmind.society.table import Table
from socialmind.sources.provenance import note_definition
from socialmind.streams import STREAM
from socialmind.work.packing import is_private, packed, reference, unpacked
from socialmind.worlds.contract import Ground, World

if TYPE_CHECKING:
    from coglogo_py.receipts.receipt import Receipt
    from socialmind.mind.steering import Steering

Loaded = TypeVar("Loaded", bound="Model")


@dataclass(frozen=True)
class Idle:
    """Decisions that found no plan available: how many, and the first agent and tick of them."""

    count: int
    first_agent: int | None
    first_tick: int | None


class ModelKind(ABCMeta):
    """The class of model classes.

    They go to other processes wherever they were loaded from, and a society that is made takes no
    further attributes.
    """

    def __call__(cls, *arguments: Any, **settings: Any) -> Any:
        """Return a society, finished."""
        made = super().__call__(*arguments, **settings)
        made._made = True
        return made


def _reduced(kind: ModelKind) -> Any:
    return reference(kind) if is_private(kind) else kind.__qualname__


copyreg.pickle(ModelKind, _reduced)


class Model(metaclass=ModelKind):
    """A society of agents.

    Class attributes that a modeller declares:

    - `ticks`: how long a run is unless it says otherwise;
    - `score_every`: where it is taught without a plane, after how many ticks its method `score()`
      is asked again; 0, at the end alone;
    - parameters: `price: float = parameter(167.0, unit="wheat", low=0.0)`;
    - variables: `warmth: float = 0.0`;
    - populations: `humans = Population(Human, "n_agents", mind="scheme.yaml", plans={…})`;
    - `world = Torus("world_size", Land)`;
    - `setup` and `schedule`: tuples of `each(population, rule)` and `once(rule)`.

    And two methods that say what a run records: `series()` and `agents()`; and one that says
    whether it stops before its time, `stop_when()`.

    Args:
        seed: the key of all random draws, 0 … 2⁶⁴ − 1.
        compiled: run the rules compiled, or interpreted with the same results.
        scheme: a scheme to use instead of the model's own: a file, or a `CognitiveScheme`; with
            several populations that have minds, a mapping from their names.
        hierarchy: a hierarchy of skills to use instead of the model's own: a mind's folder or YAML
            file, or a `MindDescription`; with several populations that have one, a mapping; or
            False for none: robots stand still until somebody steers them with `steer`.
        physics: on a plane, what moves the bodies: "compiled", or "pymunk", the reference.
        without: on a plane, names of interruptions that are not heeded.
        parameters: values of parameters that differ from the defaults.

    Raises:
        ModelError: the model's class or rules are wrong, with file and line.
        SocialmindError: a parameter is unknown or out of range.
    """

    name: ClassVar[str] = ""
    ticks: ClassVar[int] = 1000
    score_every: ClassVar[int] = 0
    setup: ClassVar[tuple[PhaseDeclaration, ...]] = ()
    schedule: ClassVar[tuple[PhaseDeclaration, ...]] = ()
    parameters: ClassVar[dict[str, Parameter]] = {}
    variables: ClassVar[dict[str, Field]] = {}
    populations: ClassVar[dict[str, Population]] = {}
    declared_world: ClassVar[World] = World()
    rewards: ClassVar[dict[str, Any]] = {}
    interruptions: ClassVar[dict[str, Any]] = {}
    measures: ClassVar[dict[str, Any]] = {}
    shape: ClassVar[ModelShape]
    _programs: ClassVar[dict[bool, Program]] = {}

    # What an instance keeps; `socialmind.agents.running` says what it is.
    seed: int
    compiled: bool
    physics: str
    without: tuple[str, ...]
    program: Program
    contexts: NDArray[Any]
    context: Any
    stream: NDArray[Any]
    ground: Ground
    schemes: dict[str, CognitiveScheme]
    assemblies: dict[str, Any]
    names: dict[str, NDArray[Any]]
    tables: dict[str, Table]
    engine: Engine
    connected: list[NDArray[Any]]
    watch: tuple[str, int] | None
    watched: Receipt | None
    _scheme: Any
    _hierarchy: Any
    _steerings: dict[str, Steering]
    _sets_up: bool = True
    _made: bool = False
    _in_rules: bool = False

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        hold_text(getattr(sys.modules.get(cls.__module__), "__file__", None) or "")
        note_definition(cls.__module__)
        found = declaration_of(cls, Model)
        cls.parameters, cls.variables, cls.populations, cls.declared_world = found[:4]
        cls.rewards, cls.interruptions, cls.measures = found[4:]
        cls.name = cls.__dict__.get("name") or _snake_case(cls.__name__)
        world = cls.declared_world.shape(cls, partial(place_of_field, cls))
        cls.shape = ModelShape(
            name=cls.name,
            parameters={name: one.field for name, one in cls.parameters.items()},
            variables=cls.variables,
            populations={n: world.inhabited(one.shape) for n, one in cls.populations.items()},
            world=world,
            setup=tuple(phase.shape for phase in cls.setup),
            schedule=tuple(phase.shape for phase in cls.schedule),
        )
        cls._programs = {}

    @classmethod
    def typed(cls, compiled: bool = True) -> Program:
        """Return the typed rules of the model; typed anew once a constant or helper is another.

        Raises:
            ModelError: a rule outside the language.
        """
        known = cls._programs.get(compiled)
        if known is None or known.outdated:
            known = cls._programs[compiled] = Program(cls.shape, compiled)
        return known

    @classmethod
    def steerings(cls, given: Any = None) -> dict[str, Steering]:
        """Return the hierarchies of skills of the populations that have some.

        Args:
            given: what `hierarchy` of the model is.
        """
        if given is None and all(one.hierarchy is None for one in cls.populations.values()):
            return {}
        from socialmind.mind.steering import steerings_of

        return steerings_of(cls.populations, cls.folder(), given, cls.name)

    @classmethod
    def before_setup(cls: type[Loaded], **arguments: Any) -> Loaded:
        """Return a society whose setup has not run; arguments as of the class."""
        model = cls.__new__(cls)
        model._sets_up = False
        model.__init__(**arguments)  # type: ignore[misc]  # what __new__ left out
        model._made = True
        return model

    @classmethod
    def folder(cls) -> Path:
        """Return the folder in which the model's class stands."""
        return Path(inspect.getfile(cls)).parent

    def __init__(
        self,
        seed: int = 0,
        compiled: bool = True,
        scheme: str | Path | CognitiveScheme | Mapping[str, Any] | None = None,
        hierarchy: Any = None,
        physics: str = "compiled",
        without: Sequence[str] = (),
        **parameters: Any,
    ) -> None:
        self.seed = whole_number(seed, "seed", 0, 2**64 - 1, SocialmindError)
        self.compiled = compiled
        self._scheme = scheme
        self._hierarchy = hierarchy
        self.physics = physics
        engines = self.shape.world.engines
        if physics not in engines:
            why = nearest(physics, engines) if len(engines) > 1 else "it has no plane"
            raise SocialmindError(f"physics={physics!r} for {self.name}; {why}")
        self.without = (without,) if isinstance(without, str) else tuple(without)
        self.watch = self.watched = None
        self._steerings = self.steerings(hierarchy)
        self.assemblies = {name: one.assembly for name, one in self._steerings.items()}
        self.program = self.typed(compiled)
        self.contexts = np.zeros(1, model_dtype(self.shape))
        self.context = self.contexts[0]
        set_values(self.context, self.parameters, self.variables, parameters, self.name)
        bits = ignored(self.interruptions, self.without, self.name)
        if bits:
            self.context["_ignored"] = bits
        size = type(self).declared_world.size
        self.ground = type(self).declared_world.ground(
            self, None if size is None else size_of(self.context, size, 1)
        )
        self.schemes, files = schemes_of(self.populations, self.folder(), scheme, self.name)
        self.tables = tables_of(self, self._steerings)
        self.ground.settle_in()
        self.stream = np.zeros(1, STREAM)
        self.stream["key_0"], self.stream["key_1"] = self.seed & 0xFFFFFFFF, self.seed >> 32
        self.connected = []
        self.names = {
            name: np.array(
                names_of_minds(
                    self.program,
                    name,
                    self.schemes.get(name),
                    self.assemblies.get(name),
                    files.get(name),
                ),
                np.int64,
            )
            for name in self.populations
        }
        self.engine = Engine(self, compiled)
        if self._sets_up:
            self.engine.set_up()
            self.ground.build()

    def __setattr__(self, name: str, value: Any) -> None:
        if self._made and name not in self.variables and not name.startswith("_"):
            value = admitted(self, kept_names(Model), name, value)
        object.__setattr__(self, name, value)

    def connect(self) -> None:
        """Write into the society's record where its arrays are."""
        connect(self)

    # Running ----------------------------------------------------------------------------------

    @contextmanager
    def following_rules(self) -> Iterator[None]:
        """Hand out agents and patches as rules hold them, bare, while interpreted rules run."""
        within = self._in_rules
        self._hand_out(True)
        try:
            yield
        finally:
            self._hand_out(within)

    def _hand_out(self, bare: bool) -> None:
        self._in_rules = bare
        for table in self.tables.values():
            table.hand_out(bare)
        self.ground.hand_out(bare)

    @property
    def tick(self) -> int:
        """How many ticks have run."""
        return int(self.context["_tick"])

    def advance(self, ticks: int = 1) -> None:
        """Run a number of ticks.

        Args:
            ticks: a whole number, 0 or more; a society that stops (`stop_when`) runs no further.

        Raises:
            SocialmindError: `ticks` is none.
            RuleError: a rule failed, with its file, line, agent and tick.

        Warns:
            IdleWarning: for the first decision of the society that found no plan available.
        """
        ticks = whole_number(ticks, "ticks", 0, error=SocialmindError)
        known = self.idle.count
        if type(self).stop_when is Model.stop_when:
            self.engine.advance(ticks)
        else:
            end = self.tick + ticks
            while self.tick < end and not self.stopped:
                self.engine.advance(1)
        idle = self.idle
        if idle.count > known == 0 and idle.first_tick is not None:
            warnings.warn(
                f"agent {idle.first_agent} of {self.name} found no available plan in tick "
                f"{idle.first_tick} and did nothing; `idle` counts such decisions, "
                f"`explain({idle.first_agent}, {idle.first_tick + 1})` shows why",
                IdleWarning,
                stacklevel=2,
            )

    def step(self) -> None:
        """Run one tick."""
        self.advance(1)

    def stop_when(self) -> bool | str | None:
        """Say whether the society stops here; a model overrides it, and nothing else calls it.

        It is asked before each tick, and may look at anything but change nothing. Runs and
        `advance` end where it says so. On a plane interruptions say it.

        Returns:
            True, or in a word why, which `over` then gives.
        """
        return None

    @property
    def stopped(self) -> bool:
        """Whether the society has stopped: `advance` runs no further tick."""
        return bool(self.stop_when())

    def run_plan(self, population: str, plan: int, agent: Any, rng: Any) -> None:
        """Carry out a plan, by its number in the population's scheme, in an interpreted run."""
        name = self.schemes[population].plans[plan]
        symbol, takes = self.program.plans[population][name]
        self.engine.functions[symbol](*taken(takes, agent, self, rng).values())

    @property
    def over(self) -> str | None:
        """The interruption that ended it, or what `stop_when` said; None while it goes on."""
        why = self.stop_when()
        if why:
            return why if isinstance(why, str) else "stop_when"
        return self.ground.over

    @property
    def minded(self) -> bool:
        """Whether robots have minds: not in a model made with `hierarchy=False`."""
        return self._hierarchy is not False

    def steer(self, population: str, commands: ArrayLike | None) -> None:
        """Steer robots from outside, in place of their minds.

        Actuators carry commands out from the next tick on, until others are given.

        Args:
            population: the robots' population.
            commands: 0 … 1, (robots, actuators) in the order of the living and of the body's
                actuators, or (actuators,) for all of them; None gives them back to their minds.

        Raises:
            SocialmindError: no plane, no such robots, or wrong commands.
        """
        self.ground.steer(population, commands)

    # Observing --------------------------------------------------------------------------------

    def series(self) -> dict[str, Any]:
        """Return what a run records of the society at a tick: a name and a number for each column.

        A model overrides it. Unless it does: the size of each population, and the variables; on a
        plane also the mean score of the robots, the dead included, and what ended it, if any.
        """
        sizes: dict[str, Any] = {name: len(table) for name, table in self.tables.items()}
        plain = {
            name: getattr(self, name) for name, one in self.variables.items() if one.size is None
        }
        stops = (
            type(self).declared_world.has_episodes or type(self).stop_when is not Model.stop_when
        )
        return sizes | self.ground.series() | plain | ({"over": self.over} if stops else {})

    def agents(self) -> dict[str, Any]:
        """Return what a run records of each agent at a tick: a name and a sequence for each column.

        A model overrides it. Unless it does: identity, plan, place and fields of all agents; on a
        plane where the robots are and how they fare, and the fields of their class. Where several
        populations are recorded, a column `population` comes first. None stands for no value.
        """
        if not self.tables:
            return {}
        there = self.ground.agents()
        return agent_columns(self) if there is None else there

    def plans(self, table: Table) -> list[str | None]:
        """Return the names of the plans of a population's living, None where there is none."""
        names = [*self.schemes[table.shape.name].plans, None]
        return [names[plan] for plan in table.columns["_plan"][table.slots].tolist()]

    def parameter_values(self) -> dict[str, float | int | bool | str]:
        """Return the values of the parameters."""
        return {name: getattr(self, name) for name in self.parameters}

    @property
    def idle(self) -> Idle:
        """The decisions that found no plan available."""
        count = int(self.context["_idle"])
        if count == 0:
            return Idle(0, None, None)
        return Idle(count, int(self.context["_idle_agent"]), int(self.context["_idle_tick"]))

    def count_idle(self, agent: int) -> None:
        """Count a decision that found no plan available."""
        if self.context["_idle"] == 0:
            self.context["_idle_agent"] = agent
            self.context["_idle_tick"] = self.tick
        self.context["_idle"] += 1

    def fresh(self: Loaded) -> Loaded:
        """Return the same society before its first tick."""
        return type(self)(
            self.seed,
            self.compiled,
            self._scheme,
            self._hierarchy,
            self.physics,
            self.without,
            **self.parameter_values(),
        )

    def explain(self, agent: int, tick: int) -> Receipt:
        """Explain the decision that was in force at a tick: the agent's last one up to it.

        The run is repeated up to the decision, from its seed and parameters.

        Args:
            agent: the agent's identity, in the first population with minds.
            tick: 1 or more.

        Raises:
            SocialmindError: there is no such agent at that tick, or it has not decided yet.
        """
        return explained(self, agent, tick)

    # State ------------------------------------------------------------------------------------

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays that change in a run, by name; `restore` takes them back."""
        return state_of(self)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take back the arrays of a checkpoint of the same model with the same parameters."""
        restore(self, state)

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked_model, (packed(self._parts()),), self._own() or None

    def __copy__(self: Loaded) -> Loaded:
        return _remade(*self._parts(), self._own())

    def __deepcopy__(self: Loaded, memo: dict[int, Any]) -> Loaded:
        made = _remade(*self._parts(), {})
        memo[id(self)] = made
        vars(made).update(copy.deepcopy(self._own(), memo))
        return made

    def _parts(self: Loaded) -> tuple[type[Loaded], dict[str, Any], dict[str, NDArray[Any]]]:
        """Return what the society is made of anew: its class, its settings and its state."""
        settings: dict[str, Any] = {
            "seed": self.seed,
            "compiled": self.compiled,
            "scheme": self.schemes or None,
            "hierarchy": False if not self.minded else self._steerings or None,
            "physics": self.physics,
            "without": self.without,
        }
        return type(self), settings | self.parameter_values(), self.state()

    def _own(self) -> dict[str, Any]:
        """Return the attributes that a modeller's methods gave the society."""
        return {name: one for name, one in vars(self).items() if name not in kept_names(Model)}

    def mesa(self) -> Any:
        """Return a real `mesa.Model` over this society; see docs/mesa.md."""
        from socialmind.mesa.model import mesa_model

        return mesa_model(self)


def _unpacked_model(content: bytes) -> Model:
    kind, settings, state = unpacked(content)
    made: Model = _remade(kind, settings, state, {})
    return made


def _remade(
    kind: type[Loaded],
    settings: Mapping[str, Any],
    state: Mapping[str, NDArray[Any]],
    own: Mapping[str, Any],
) -> Loaded:
    """Return a society in a state, with attributes that a modeller's methods gave it."""
    made = kind.__new__(kind)
    made._sets_up = False  # until it has its state
    Model.__init__(made, **settings)
    del made._sets_up
    made.restore(state)
    vars(made).update(own)
    made._made = True
    return made


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
