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
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.errors import shown
from coglogo_py.memory import check_memory
from coglogo_py.numbers import whole_number
from coglogo_py.society import Society
from socialmind.agent_columns import agent_columns
from socialmind.arena import Arena
from socialmind.bookkeeping import GONE, GONE_SCORE
from socialmind.connection import names_of_minds
from socialmind.declaration import SETTINGS, declaration_of
from socialmind.engine import Engine
from socialmind.errors import IdleWarning, ModelError, SocialmindError, UnknownNameError
from socialmind.fields import Field, place_of_field, presence
from socialmind.hindsight import explained
from socialmind.language.layout import model_dtype, row_dtype
from socialmind.language.nodes import nearest
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape
from socialmind.language.source import hold_text
from socialmind.model_state import restore, state_of
from socialmind.packing import is_private, packed, reference, unpacked
from socialmind.parameter import Parameter
from socialmind.population import Population
from socialmind.provenance import note_definition
from socialmind.schedule import PhaseDeclaration, taken
from socialmind.streams import STREAM
from socialmind.table import Table
from socialmind.worlds.grid import Grid, Torus
from socialmind.worlds.plane.bodies import OWN
from socialmind.worlds.plane.plane import Plane, plane_shape
from socialmind.worlds.plane.trajectories import trajectories

if TYPE_CHECKING:
    from coglogo_py.receipt import Receipt
    from socialmind.mind.inhabitants import Steering
    from socialmind.mind.population_minds import PopulationMinds

_KEPT = ("_tick", "_idle", "_idle_agent", "_idle_tick", "_over", "_ignored")
_KEPT_OF_POPULATIONS = ("_steered",)
"""Columns of the record with a leading underscore that are state, not addresses and sizes: their
names, and how the names of those of a population end."""

KEPT_BY_MODELS = frozenset(
    (
        "_addresses",
        "_hierarchy",
        "_in_rules",
        "_made",
        "_scheme",
        "_scheme_files",
        "_sets_up",
        "_steerings",
        "arena",
        "assemblies",
        "compiled",
        "connected",
        "context",
        "contexts",
        "engine",
        "grid",
        "names",
        "physics",
        "program",
        "schemes",
        "seed",
        "stream",
        "tables",
        "watch",
        "watched",
        "without",
    )
)
"""The attributes that an instance keeps beside those of the modeller."""
_REPLACED = ("connected", "watch", "watched")
"""Those that are replaced while it runs."""

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
    torus: ClassVar[Torus | None] = None
    plane: ClassVar[Plane | None] = None
    rewards: ClassVar[dict[str, Any]] = {}
    interruptions: ClassVar[dict[str, Any]] = {}
    measures: ClassVar[dict[str, Any]] = {}
    shape: ClassVar[ModelShape]

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        hold_text(getattr(sys.modules.get(cls.__module__), "__file__", None) or "")
        note_definition(cls.__module__)
        found = declaration_of(cls, Model)
        cls.parameters, cls.variables, cls.populations, cls.torus, cls.plane = found[:5]
        cls.rewards, cls.interruptions = found.rewards, found.interruptions
        cls.measures = found.measures
        cls.name = cls.__dict__.get("name") or _snake_case(cls.__name__)
        cls.shape = cls._shape()
        cls._programs = {}

    _programs: ClassVar[dict[bool, Program]] = {}
    _sets_up: ClassVar[bool] = True
    _made = False
    _in_rules = False

    @classmethod
    def _shape(cls) -> ModelShape:
        populations = {name: one.shape for name, one in cls.populations.items()}
        plane = None
        if cls.plane is not None:
            plane = plane_shape(
                cls.plane,
                cls.populations,
                cls.rewards,
                cls.interruptions,
                partial(place_of_field, cls),
            )
            for name, robots in plane.robots.items():
                fields = {**populations[name].fields, **robots.fields}
                populations[name] = replace(populations[name], fields=fields, own=OWN)
        return ModelShape(
            name=cls.name,
            parameters={name: one.field for name, one in cls.parameters.items()},
            variables=cls.variables,
            populations=populations,
            patch=None if cls.torus is None else cls.torus.fields,
            setup=tuple(phase.shape for phase in cls.setup),
            schedule=tuple(phase.shape for phase in cls.schedule),
            plane=plane,
        )

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
        from socialmind.mind.inhabitants import steerings_of

        return steerings_of(cls.populations, cls.folder(), given, cls.name)

    @classmethod
    def before_setup(cls: type[Loaded], **arguments: Any) -> Loaded:
        """Return a society whose setup has not run; arguments as of the class."""
        model = cls.__new__(cls)
        model._sets_up = False  # type: ignore[misc]  # of this one
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
        if physics != "compiled" and self.shape.plane is None:
            raise SocialmindError(f"physics={physics!r} for {self.name}, which has no plane")
        self.without = (without,) if isinstance(without, str) else tuple(without)
        self.watch: tuple[str, int] | None = None
        self.watched: Receipt | None = None
        self._steerings = self.steerings(hierarchy)
        self.assemblies = {name: one.assembly for name, one in self._steerings.items()}
        self.program = self.typed(compiled)
        self.contexts = np.zeros(1, model_dtype(self.shape))
        self.context: Any = self.contexts[0]
        self._set_values(parameters)
        self._set_ignored()
        torus = type(self).torus
        self._check_memory()
        self.grid = None if torus is None else Grid(torus.fields, self._size(torus.size, 1))
        self._scheme_files: dict[str, Path] = {}
        self.schemes = self._schemes()
        self.tables = self._tables()
        self.arena = None if self.shape.plane is None else Arena(self)
        if self.arena is not None and not self.minded:
            for name in self.arena.shape.robots:
                self.context[f"_{name}_steered"] = 1
        self.stream = np.zeros(1, STREAM)
        self.stream["key_0"], self.stream["key_1"] = self.seed & 0xFFFFFFFF, self.seed >> 32
        self.connected: list[NDArray[Any]] = []
        self._addresses = [
            name
            for name in self.contexts.dtype.names or ()
            if name.startswith("_")
            and name not in _KEPT
            and not name.startswith("_has_")
            and not name.endswith(_KEPT_OF_POPULATIONS)
        ]
        self.names = {
            name: np.array(
                names_of_minds(
                    self.program,
                    name,
                    self.schemes.get(name),
                    self.assemblies.get(name),
                    self._scheme_files.get(name),
                ),
                np.int64,
            )
            for name in self.populations
        }
        self.engine = Engine(self, compiled)
        if self._sets_up:
            self.engine.set_up()
            if self.arena is not None:
                self.arena.build()

    def _set_values(self, parameters: Mapping[str, Any]) -> None:
        for name in parameters:
            if name not in self.parameters:
                raise SocialmindError(
                    f"{self.name} has no parameter {name!r}; {nearest(name, self.parameters)}"
                )
        for name, one in self.parameters.items():
            self.context[name] = one.stored(parameters.get(name, one.default))
        for field in self.variables.values():
            default: Any = field.default
            if field.optional:
                self.context[presence(field.name)] = default is not None
            self.context[field.name] = 0 if default is None else default

    def _set_ignored(self) -> None:
        """Note which interruptions are not heeded, as bits."""
        names = list(self.interruptions)
        for name in self.without:
            if name not in names:
                raise SocialmindError(
                    f"no interruption called {name!r} in {self.name}; {nearest(name, names)}"
                )
            self.context["_ignored"] |= 1 << names.index(name)

    def _size(self, size: int | str, least: int) -> int:
        if isinstance(size, str):
            found = int(self.context[size])
            if found < least:
                raise SocialmindError(f"parameter {size}: found {found}; expected {least} or more")
            return found
        return size

    def _check_memory(self) -> None:
        """Refuse a world or a population that the machine's memory cannot hold."""
        torus = type(self).torus
        if torus is not None:
            size = self._size(torus.size, 1)
            row = row_dtype(dict(torus.fields), None).itemsize
            what = f"{shown(size)} × {shown(size)} patches of {self.name}"
            check_memory(size * size * row, what, SocialmindError)
        for name, population in self.populations.items():
            size = self._size(population.size, 0)
            shape = self.shape.populations[name]
            # Beside its row an agent has a place in five more arrays, and its mind.
            row = row_dtype(dict(shape.fields), shape).itemsize + 5 * 8
            what = f"{shown(size)} agents of {name!r} in {self.name}"
            check_memory(size * row, what, SocialmindError)

    def _schemes(self) -> dict[str, CognitiveScheme]:
        minded = {name: one for name, one in self.populations.items() if one.mind is not None}
        given = self._scheme
        if given is not None and not isinstance(given, Mapping):
            if len(minded) != 1:
                raise SocialmindError(
                    f"a scheme for {self.name}, which has {len(minded)} populations with minds; "
                    f"give a mapping from {', '.join(minded) or 'their names'}"
                )
            given = {next(iter(minded)): given}
        schemes = {}
        for name, population in minded.items():
            source: Any = (given or {}).get(name, population.mind)
            if isinstance(source, CognitiveScheme):
                schemes[name] = source
                continue
            own = given is None or name not in given
            path = self.folder() / source if own else Path(source)
            schemes[name] = CognitiveScheme.load(path, decision_makers=population.decision_makers)
            self._scheme_files[name] = path
        for name, population in minded.items():
            # Another scheme may have fewer plans than the model knows how to carry out.
            if given is None or name not in given:
                _check_plans(name, population, schemes[name], self._scheme_files.get(name))
        return schemes

    def _tables(self) -> dict[str, Table]:
        tables: dict[str, Table] = {}
        for place, (name, population) in enumerate(self.populations.items()):
            society = None
            if name in self.schemes:
                scheme = self.schemes[name]
                # Breeds that share a scheme share its groups.
                same = [n for n in self.schemes if self.schemes[n] == scheme and n in tables]
                society = tables[same[0]].society if same else Society(scheme, self.seed, place)
            shape = self.shape.populations[name]
            minds = None
            if name in self.assemblies:
                minds = partial(self._minds, name)
            tables[name] = Table(self, shape, self._size(population.size, 0), society, minds)
        return tables

    def _minds(self, name: str, capacity: int) -> PopulationMinds:
        """Return the hierarchies of a population for so many agents."""
        from socialmind.mind.population_minds import PopulationMinds

        population = self.populations[name]
        return PopulationMinds(
            self.assemblies[name],
            capacity,
            self.seed,
            name,
            population.own_genomes,
            population.instances,
            self._steerings[name].drive,
            lambda: self.tick,
        )

    def __setattr__(self, name: str, value: Any) -> None:
        if self._made and name not in self.variables and not name.startswith("_"):
            value = self._admitted(name, value)
        object.__setattr__(self, name, value)

    def _admitted(self, name: str, value: Any) -> Any:
        """Return what an attribute may be set to, or refuse it.

        A society takes its variables, what its class declares, what `__init__` made, and names
        with a leading underscore, which are the modeller's own.
        """
        if name in _REPLACED or isinstance(getattr(type(self), name, None), Parameter | property):
            return value  # these speak for themselves
        known = [*self.variables, *self.parameters, *self.populations]
        if name in self.populations:
            raise UnknownNameError(
                f"the population {name!r} of {self.name} stays; set fields of its agents: "
                f"society.{name}.FIELD = …"
            )
        if name == "world":
            raise UnknownNameError(
                f"the world of {self.name} stays; set fields of its patches: "
                "society.world.FIELD = …"
            )
        if name in ("ticks", "score_every"):
            return whole_number(value, name, 0, error=SocialmindError)
        there = getattr(type(self), name, None)
        if name in KEPT_BY_MODELS or name in SETTINGS:
            raise UnknownNameError(
                f"{name!r} of {self.name} stays as it was when the society was made; make another"
            )
        if inspect.isroutine(there) and not callable(value):
            raise UnknownNameError(f"{name!r} of {self.name}, which is a method; call it")
        if there is None and name not in vars(self):
            raise UnknownNameError(
                f"{self.name} has no variable {name!r}; {nearest(name, known)}; declare it in the "
                f"class ({name}: float = 0.0), set it in __init__, or call it _{name}"
            )
        return value

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
        if self.grid is not None:
            self.grid.hand_out(bare)

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

    # On a plane -------------------------------------------------------------------------------

    @property
    def over(self) -> str | None:
        """The interruption that ended it, or what `stop_when` said; None while it goes on."""
        why = self.stop_when()
        if why:
            return why if isinstance(why, str) else "stop_when"
        number = int(self.context["_over"]) if self.shape.plane is not None else 0
        return list(self.interruptions)[number - 1] if number else None

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
        if self.arena is None:
            raise SocialmindError(f"{self.name} has no plane with robots to steer")
        self.arena.steer(population, commands)

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
        plane = self.shape.plane
        if plane is None:
            stops = type(self).stop_when is not Model.stop_when
            return sizes | plain | ({"over": self.over} if stops else {})
        tables = [self.tables[name] for name in plane.robots]
        scores = [one for table in tables for one in table.score.tolist()]
        count = len(scores) + sum(int(table.counters[GONE]) for table in tables)
        # The dead count with what they had.
        scores += [float(table.counters.view(np.float64)[GONE_SCORE]) for table in tables]
        fared = {"score": sum(scores) / count if count else None} if plane.robots else {}
        return sizes | fared | plain | {"over": self.over}

    def agents(self) -> dict[str, Any]:
        """Return what a run records of each agent at a tick: a name and a sequence for each column.

        A model overrides it. Unless it does: identity, plan, place and fields of all agents; on a
        plane where the robots are and how they fare, and the fields of their class. Where several
        populations are recorded, a column `population` comes first. None stands for no value.
        """
        if not self.tables:
            return {}
        if self.shape.plane is not None and self.shape.plane.robots:
            return trajectories(self)
        return agent_columns(self)

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
        return {name: one for name, one in vars(self).items() if name not in KEPT_BY_MODELS}

    def mesa(self) -> Any:
        """Return a real `mesa.Model` over this society; see docs/mesa.md."""
        from socialmind.mesa_model import mesa_model

        return mesa_model(self)


def _check_plans(
    name: str, population: Population, scheme: CognitiveScheme, file: Path | None
) -> None:
    """Refuse functions of plans, and bounds of cognitons, that a model's own scheme has not."""
    cognitons = [one.name for one in scheme.cognitons]
    for cogniton in population.bounds:
        if cogniton not in cognitons:
            raise ModelError(
                f"bounds of the cogniton {cogniton!r} of {name!r}, which the scheme "
                f"{scheme.name!r} does not have",
                remedy=nearest(cogniton, cognitons),
                file=file,
            )
    for plan in population.plans:
        if plan not in scheme.plans:
            raise ModelError(
                f"a function for the plan {plan!r} of {name!r}, which the scheme {scheme.name!r} "
                "does not have",
                "a function for each of its plans",
                nearest(plan, scheme.plans),
                file,
            )


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
    made._sets_up = False  # type: ignore[misc]  # of this one, until it has its state
    Model.__init__(made, **settings)
    del made._sets_up
    made.restore(state)
    vars(made).update(own)
    made._made = True
    return made


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
