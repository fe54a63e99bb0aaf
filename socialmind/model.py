"""Models: what a modeller subclasses and declares, and what runs.

A model class declares parameters, variables, populations, a world and the order of its rules; an
instance is a running society:

    society = FarmerArtisan(seed=1, n_agents=30)
    society.advance(1000)
    society.humans.wheat.mean()
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from numpy.typing import ArrayLike, NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.border.html_table import as_html
from coglogo_py.border.numbers import whole_number
from socialmind.agents import idleness
from socialmind.agents.agent_columns import agent_columns, default_series
from socialmind.agents.events import Events, columns_of_events
from socialmind.engine.engine import Engine
from socialmind.engine.explaining import explained
from socialmind.errors import SocialmindError
from socialmind.fields import Field
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape
from socialmind.society import copying
from socialmind.society.admitting import admitted
from socialmind.society.declaration import kept_names
from socialmind.society.founding import making
from socialmind.society.founding.blueprint import Blueprint
from socialmind.society.kind import ModelKind
from socialmind.society.parameter import Parameter
from socialmind.society.phases import PhaseDeclaration
from socialmind.society.population import Population
from socialmind.society.state import restore, state_of
from socialmind.society.table import Table
from socialmind.worlds.contract import World

if TYPE_CHECKING:
    from coglogo_py.receipts.receipt import Receipt
    from socialmind.mind.steering import Steering
    from socialmind.society.looks import Looks

Loaded = TypeVar("Loaded", bound="Model")


class Model(metaclass=ModelKind):
    """A society of agents.

    Class attributes that a modeller declares:

    - `ticks`: how long a run is unless it says otherwise;
    - `score_every`: where it is taught without a plane, after how many ticks its method `score()`
      is asked again; 0, at the end alone;
    - `record_links`: whether a run records the links of its networks too, when it records agents;
    - `record_events`: whether a run records births and deaths, if rules bring any; True;
    - parameters: `price: float = parameter(167.0, unit="wheat", low=0.0)`;
    - variables: `warmth: float = 0.0`;
    - populations: `humans = Population(Human, "n_agents", mind="scheme.yaml", plans={…})`;
    - networks of links between their agents: `friends = Network(humans)`;
    - messages between agents, `offers = Messages(Offer, to=humans)`, and what two of them may come
      to, `theft = Interaction(…)`;
    - `world = Torus("world_size", Land)`;
    - `setup` and `schedule`: tuples of `each(population, rule)` and `once(rule)`;
    - `buttons`: functions of the society, as of shocks, by what stands on their buttons in the
      studio: `buttons = {"Drought": drought}`.

    And methods: `series()` and `agents()` say what a run records, `stop_when()` when it stops,
    `looks()` how the studio draws it.

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
        parameters: values of parameters that differ from the defaults; under a population's name a
            table that it begins with, in place of what the model declares: a CSV or Parquet file,
            a data frame, an Arrow table, or columns by their names.

    Raises:
        ModelError: the model's class or rules are wrong, with file and line.
        SocialmindError: a parameter is unknown or out of range.
    """

    name: ClassVar[str] = ""
    ticks: ClassVar[int] = 1000
    score_every: ClassVar[int] = 0
    record_links: ClassVar[bool] = False
    record_events: ClassVar[bool] = True
    setup: ClassVar[tuple[PhaseDeclaration, ...]] = ()
    schedule: ClassVar[tuple[PhaseDeclaration, ...]] = ()
    parameters: ClassVar[dict[str, Parameter]] = {}
    variables: ClassVar[dict[str, Field]] = {}
    populations: ClassVar[dict[str, Population]] = {}
    networks: ClassVar[dict[str, Any]] = {}
    declared_world: ClassVar[World] = World()
    rewards: ClassVar[dict[str, Any]] = {}
    interruptions: ClassVar[dict[str, Any]] = {}
    measures: ClassVar[dict[str, Any]] = {}
    buttons: ClassVar[dict[str, Callable[..., None]]] = {}
    shape: ClassVar[ModelShape]
    _programs: ClassVar[dict[bool, Program]] = {}
    _blueprint: ClassVar[Blueprint]

    _tables_given: dict[str, Any]
    _given: tuple[Any, Any]  # `socialmind.agents.running` names what else an instance keeps
    _steerings: dict[str, Steering]
    _sets_up: bool = True
    _made: bool = False
    _in_rules: bool = False

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        cls.declare(Model)

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
        kind = type(self)
        self.seed = whole_number(seed, "seed", 0, 2**64 - 1, SocialmindError)
        self.compiled = compiled
        self.physics = making.engine_named(physics, kind.shape.world.engines, kind.name)
        self.without = (without,) if isinstance(without, str) else tuple(without)
        self._given = scheme, hierarchy
        self.watch: Any = None
        self.watched: Any = None
        self._steerings = kind.steerings(hierarchy)
        self.assemblies = {name: one.assembly for name, one in self._steerings.items()}
        self.program = kind.typed(compiled)
        shared = kind._blueprint
        self.schemes, files = making.schemes_of(
            self.populations, kind.folder, scheme, kind.name, shared.schemes
        )
        self.conditioned = making.conditioned(self, files)
        self.record = shared.record_of(self.program, self.conditioned)
        self.contexts: NDArray[Any] = self.record.new()
        self.context: Any = self.contexts[0]
        tables = {name: parameters.pop(name) for name in kind.populations if name in parameters}
        self._tables_given: dict[str, Any] = tables
        making.set_values(self.context, kind.parameters, kind.variables, parameters, kind.name)
        making.ignore(self.context, kind.interruptions, self.without, kind.name)
        self.ground = making.ground_of(self, kind.declared_world)
        beginnings = making.beginnings_of(self, tables, parameters, kind.folder)
        self.tables: dict[str, Table] = making.tables_of(self, self._steerings, beginnings, shared)
        self.ground.settle_in()
        self.stream = making.new_stream(self.seed)
        self.connected: list[Any] = []
        self.event_log = Events(self.program.agents)
        self.names = making.names_in_minds(self, files)
        self.engine = Engine(self, compiled)
        if self._sets_up:
            making.begin_networks(self)
            self.engine.set_up(partial(copying.unbegun, self, Model))
            self.ground.build()

    def __setattr__(self, name: str, value: Any) -> None:
        if self._made and name not in self.variables and not name.startswith("_"):
            value = admitted(self, kept_names(Model), name, value)
        object.__setattr__(self, name, value)

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
        known = int(self.context["_idle"])
        if type(self).stop_when is Model.stop_when:
            self.engine.advance(ticks)
        else:
            end = self.tick + ticks
            while self.tick < end and not self.stopped:
                self.engine.advance(1)
        idleness.warn_of_first(self.context, known, self.name)

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
        return self._given[1] is not False

    def steer(self, population: str, commands: ArrayLike | None, agent: int | None = None) -> None:
        """Steer robots from outside, in place of their minds.

        Actuators carry commands out from the next tick on, until others are given.

        Args:
            population: the robots' population.
            commands: 0 … 1, (robots, actuators) in the order of the living and of the body's
                actuators, or (actuators,) for all of them; None gives them back to their minds.
            agent: the identity of a robot that is steered alone, one at a time. Its mind goes on
                thinking and is not obeyed; the others obey theirs.

        Raises:
            SocialmindError: no plane, no such robots, or wrong commands.
        """
        self.ground.steer(population, commands, agent)

    def series(self) -> dict[str, Any]:
        """Return what a run records of the society at a tick: a name and a number for each column.

        A model overrides it. Unless it does: the size of each population, and the variables; on a
        plane also the mean score of the robots, the dead included, and what ended it, if any.
        """
        stops = type(self).stop_when is not Model.stop_when
        return default_series(self, stops or type(self).declared_world.has_episodes)

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

    def looks(self) -> dict[str, Looks]:
        """Return how the studio draws agents, by their population, and patches, as "patches".

        A model in a world of patches, or in none, overrides it. It is asked for each picture, and
        may look at anything but change nothing.
        """
        return {}

    def keep_events(self) -> None:
        """Keep from now on who is born and who dies, for `kept_events`; copies do not."""
        self.event_log.keep()

    def kept_events(self) -> dict[str, Any]:
        """Return the births and deaths since `keep_events`, in the order in which they happened.

        Returns:
            A sequence for each column: ``tick``, the first whose tables show it; ``population``;
            ``agent``, its identity; ``event``, "born" or "died"; ``parent``, the identity of the
            agent of the same population that hatched it, masked for the created and the dead.

        Raises:
            SocialmindError: none are kept.
        """
        if not self.event_log.kept:
            raise SocialmindError(
                f"{self.name} keeps no births and deaths; call keep_events() before the ticks"
            )
        return columns_of_events(self.event_log.so_far(), self.event_log.populations)

    def plans(self, table: Table) -> list[str | None]:
        """Return the names of the plans of a population's living, None where there is none."""
        names = [*self.schemes[table.shape.name].plans, None]
        return [names[plan] for plan in table.columns["_plan"][table.slots].tolist()]

    def parameter_values(self) -> dict[str, float | int | bool | str]:
        """Return the values of the parameters."""
        return {name: getattr(self, name) for name in self.parameters}

    @property
    def idle(self) -> idleness.Idle:
        """The decisions that found no plan available."""
        return idleness.idle_in(self.context)

    def fresh(self: Loaded) -> Loaded:
        """Return the same society before its first tick."""
        return copying.fresh(self)

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

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays that change in a run, by name; `restore` takes them back."""
        return state_of(self)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take back the arrays of a checkpoint of the same model with the same parameters."""
        restore(self, state)

    def _repr_html_(self) -> str:
        living = ((name, f"{len(table):,}") for name, table in self.tables.items())
        values = {
            **self.parameter_values(),
            **{name: getattr(self, name) for name in self.variables},
        }
        told = [("society", self.name), ("seed", self.seed), ("tick", f"{self.tick:,}"), *living]
        return as_html([*told, *values.items()])

    def __reduce__(self) -> tuple[Any, ...]:
        return copying.reduced(self, Model)

    def __copy__(self: Loaded) -> Loaded:
        return copying.copied(self, Model)

    def __deepcopy__(self: Loaded, memo: dict[int, Any]) -> Loaded:
        return copying.copied(self, Model, memo)

    def mesa(self) -> Any:
        """Return a real `mesa.Model` over this society; see docs/mesa.md."""
        from socialmind.mesa.model import mesa_model

        return mesa_model(self)
