"""Populations: what a modeller declares of agents.

- `Agent`: the base of annotated classes; every agent has a place and a heading.
- `Population`: the declaration in a model: which agents, how many, with what mind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from numbers import Real
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_truth, is_whole
from socialmind.agents.agent import Agent
from socialmind.errors import ModelError
from socialmind.fields import class_fields, place_of_field
from socialmind.language.plans import PlanTree
from socialmind.language.shape import PopulationShape
from socialmind.society.founding.beginning import is_table
from socialmind.society.founding.civilisations import FIELD, Civilisation, civilisation_field
from socialmind.society.table import KEPT_BY_TABLES, Table

if TYPE_CHECKING:
    from socialmind.mind.description import MindDescription
    from socialmind.mind.weighing import Weighing
    from socialmind.worlds.plane.bodies import Disc
    from socialmind.worlds.plane.devices.device import Act, Sense
    from socialmind.worlds.plane.devices.sensors import RangeFinder


_OF_AGENTS = (
    *("id", "mind", "plan", "run_plan", "die", "hatch", "hierarchy"),
    *("plan_ended", "plan_step", "reconsider_plan"),
)
TAKEN_NAMES = KEPT_BY_TABLES.union(_OF_AGENTS)
"""What an agent, and a population's table, keep under these names beside its methods."""


@dataclass(eq=False, repr=False)
class Population:
    """The declaration of a population, as an attribute of a model.

    Args:
        agent: the annotated class of its agents, which inherits from `Agent`.
        size: how many there are at the start: a number, or the name of a parameter; left out where
            a table or civilisations say it.
        mind: the scheme of their minds: a file beside the model, or a `CognitiveScheme`.
        plans: the rule of each plan, or a tree of rules (`sequence`, `repeat`, `until`, `when`),
            by the plan's name in the scheme.
        decision_makers: decision makers of the modeller's own that the scheme's file may name.
        hierarchy: the hierarchy of skills of its agents (MIND): a folder or YAML file beside the
            model, or a `MindDescription`. An agent may have both kinds of mind.
        master: the name of the hierarchy's master skill; may be left out where no other skill
            influences exactly one.
        drive: the hierarchy's drive module, a plain function `drive(mind)`.
        own_genomes: whether each agent has its own weights.
        instances: how many instances there are of the groups that share variables.
        weighing: how the hierarchy weighs the plans of the minds, in place of the scheme's
            influence links; None where it does not.
        body: what its bodies are made of, where the world is a plane and they move on it.
        sensors: the sensors of each body, by name.
        actuators: the actuators of each body, by name.
        at_birth: a rule that each agent follows once, founders too: at the end of the setup or of
            the tick in which it came into being, when what made it has set its fields, in order of
            birth, before it is recorded and before it acts.
        civilisations: the peoples of which its agents are, each with its founders.
        bounds: the smallest and largest value that the model's rules let cognitons take, by name
            (`{"Fear": (0.0, 10.0)}`); `explain` proposes no change beyond them.
        table: what they begin with, a row an agent, a column a field: a CSV or Parquet file beside
            the model, a data frame, an Arrow table, or columns by their names.
        culture: a name that several populations give: they form groups together, whatever their
            schemes, and groups of the same name are one type of group. None: populations share
            groups only if their schemes are equal.
    """

    agent: type
    size: int | str | None = None
    mind: str | Path | CognitiveScheme | None = None
    plans: Mapping[str, Callable[..., Any] | PlanTree] = field(default_factory=dict)
    decision_makers: tuple[Any, ...] = ()
    hierarchy: str | Path | MindDescription | None = None
    master: str | None = None
    drive: Callable[..., None] | None = None
    own_genomes: bool = False
    instances: int = 0
    weighing: Weighing | None = None
    body: Disc | None = None
    sensors: Mapping[str, Sense | RangeFinder] = field(default_factory=dict)
    actuators: Mapping[str, Act] = field(default_factory=dict)
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    table: Any = None
    culture: str | None = None
    at_birth: Callable[..., Any] | None = None
    civilisations: tuple[Civilisation, ...] = ()
    name: str = field(default="", init=False)
    joins: ClassVar[bool] = False
    """Whether it is no population but a network, whose rows join agents."""

    def __post_init__(self) -> None:
        for name in ("plans", "sensors", "actuators", "bounds"):
            setattr(self, name, dict(getattr(self, name) or {}))
        if isinstance(self.civilisations, list):
            self.civilisations = tuple(self.civilisations)

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def check(self) -> None:
        """Refuse agents of a wrong class, names that are taken, and plans without a mind.

        Raises:
            ModelError: so it is.
        """
        name = self.name
        if not (isinstance(self.agent, type) and issubclass(self.agent, Agent)):
            raise ModelError(
                f"{self.agent!r} as the agents of {name!r}",
                "a class that inherits from socialmind.Agent",
                "write class Human(Agent): …",
            )
        if not (self.mind is None or isinstance(self.mind, str | PathLike | CognitiveScheme)):
            raise ModelError(
                f"{shown(self.mind)} as the mind of {name!r}",
                "a file's name, or a CognitiveScheme",
                "write mind='scheme.yaml'",
            )
        if self.plans and self.mind is None:
            raise ModelError(
                f"plans for {name!r}, which has no mind",
                None,
                "name its scheme: mind='scheme.yaml'",
            )
        if self.culture is not None and not (isinstance(self.culture, str) and self.mind):
            raise ModelError(
                f"culture={shown(self.culture)} for {name!r}",
                "a name, of a population that has a mind",
                "write mind='scheme.yaml', culture='village'",
            )
        for plan, tree in self.plans.items():
            if not callable(tree) and not isinstance(tree, PlanTree):
                raise ModelError(
                    f"{shown(tree)} as the plan {plan!r} of {name!r}",
                    "a rule, or a tree of rules",
                    "write sequence(…) of the rules",
                )
        if self.at_birth is not None and not callable(self.at_birth):
            raise ModelError(f"at_birth={shown(self.at_birth)} of {name!r}", "a rule, or None")
        self._check_size()
        self._check_hierarchy()
        self._check_civilisations()
        for cogniton, ends in self.bounds.items():
            pair = isinstance(ends, tuple | list) and len(ends) == 2
            real = pair and all(isinstance(end, Real) and not is_truth(end) for end in ends)
            if self.mind is None or not real or not ends[0] <= ends[1]:
                raise ModelError(
                    f"the bounds {shown(ends)} of {cogniton!r} in {name!r}",
                    "a smallest and a largest value of a cogniton of its minds",
                    "write bounds={'Fear': (0.0, 10.0)}",
                )
        for held in class_fields(self.agent).values():
            file, line = place_of_field(self.agent, held.name)
            found = f"a field called {held.name!r}"
            if held.name in TAKEN_NAMES or hasattr(Table, held.name):
                expected = "a name that agents and populations do not use"
                raise ModelError(found, expected, None, file, line)
            if held.name in Agent.__annotations__ and (held.storage, held.size) != ("f8", None):
                raise ModelError(found, "a float, as in every agent", None, file, line)

    def _check_size(self) -> None:
        """Refuse a population of which not just one thing says how many there are."""
        parts = {
            "a size": self.size is not None,
            "a table": self.table is not None,
            "civilisations": bool(self.civilisations),
        }
        given = [name for name, there in parts.items() if there]
        if len(given) != 1:
            raise ModelError(
                f"{' and '.join(given) or 'neither size nor table nor civilisations'} of "
                f"{self.name!r}",
                "one of them",
                "write Population(Human, 10), or Population(Human, table='people.csv')",
            )
        if self.table is not None and not is_table(self.table):
            raise ModelError(
                f"the table {shown(self.table)} for {self.name!r}",
                "a CSV or Parquet file, a data frame, or columns by their names",
                "write table='people.csv'",
            )

    @property
    def sizes(self) -> tuple[int | str, ...]:
        """How many there are at the start: of each civilisation, or of all."""
        if self.civilisations:
            return tuple(one.agents for one in self.civilisations)
        return () if self.size is None else (self.size,)

    def _check_civilisations(self) -> None:
        """Refuse civilisations that are none."""
        several = self.civilisations
        if not isinstance(several, tuple) or not all(isinstance(o, Civilisation) for o in several):
            found = f"civilisations={shown(several)} of {self.name!r}"
            raise ModelError(found, "a tuple of Civilisation(…)")
        names = [one.name for one in several]
        fields = class_fields(self.agent)
        for place, one in enumerate(several):
            if one.name in names[:place]:
                raise one.error(f"two civilisations called {one.name!r}", "names of their own")
            one.check(fields, self.mind is not None)
        if several and FIELD in fields:
            file, line = place_of_field(self.agent, FIELD)
            found = f"a field called {FIELD!r} in {self.name!r}, which has civilisations"
            raise ModelError(found, None, "leave it out: agents have it", file, line)

    def _check_hierarchy(self) -> None:
        """Refuse what belongs to a hierarchy where there is none, and wrong instances."""
        number = self.instances
        if not is_whole(number) or number < 0:
            found = f"instances={shown(number)} for {self.name!r}"
            raise ModelError(found, "a whole number, 0 or more")
        self.instances = int(number)
        if not isinstance(self.own_genomes, bool):
            found = f"own_genomes={shown(self.own_genomes)} for {self.name!r}"
            raise ModelError(found, "True or False")
        given = {"master": self.master, "drive": self.drive, "own_genomes": self.own_genomes,
                 "instances": number}  # fmt: skip
        for setting, value in given.items():
            if value and self.hierarchy is None:
                raise ModelError(
                    f"{setting}= for {self.name!r}, which has no hierarchy",
                    None,
                    "give it one: hierarchy='mind'",
                )
        if self.weighing is not None and (self.mind is None or self.hierarchy is None):
            raise ModelError(
                f"weighing= for {self.name!r}, which has not both kinds of mind",
                "a scheme, whose plans a hierarchy weighs",
                "give it both: mind='scheme.yaml', hierarchy='mind'",
            )
        if self.weighing is not None and self.body is not None:
            raise ModelError(
                f"weighing= for {self.name!r}, whose hierarchies move bodies on a plane",
                "a population without bodies",
                "let a skill of the hierarchy be a CognitonScheme",
            )

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.tables[self.name]

    @property
    def shape(self) -> PopulationShape:
        """What rules may know of the population."""
        fields = class_fields(self.agent)
        if self.civilisations:
            fields[FIELD] = civilisation_field(self.civilisations)
        return PopulationShape(
            self.name,
            fields,
            self.mind is not None,
            self.plans,
            self.hierarchy is not None,
            self.weighing is not None,
            at_birth=self.at_birth,
        )
