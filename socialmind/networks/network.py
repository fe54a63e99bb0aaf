"""Networks: what a modeller declares of links between agents.

- `Link`: the base of annotated classes that say which fields a link has;
- `Network`: the declaration in a model: whose agents are linked, and how it begins.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_truth
from socialmind.errors import ModelError
from socialmind.fields import class_fields, place_of_field
from socialmind.language.shape import LinksShape, PopulationShape
from socialmind.networks.start import Generator
from socialmind.networks.table import NetworkTable
from socialmind.society.population import TAKEN_NAMES, Population

if TYPE_CHECKING:
    from socialmind.agents.running import Running
    from socialmind.society.founding.blueprint import TableForm


class Link:
    """What every link is; a modeller's class inherits from it and declares fields.

    >>> class Job(Link):
    ...     wage: float = 1.0
    """


class Network(Population):
    """The declaration of a network, as an attribute of a model behind its populations.

    ``friends = Network(people)``, ``follows = Network(people, directed=True)``, and from one
    population to another ``jobs = Network(people, firms, Job)``. There is at most one link between
    two agents (in a directed one, at most one each way), and none from an agent to itself.

    Args:
        source: the population whose agents are linked, or that links come from.
        target: the population that they lead to; the same one unless given.
        link: the annotated class of its links, which inherits from `Link`.
        directed: whether a link from one agent to another is not also one the other way.
        start: the links that it begins with: a `generator` of networkx, an edge list (a CSV or
            Parquet file beside the model, a data frame or another table with the columns source
            and target and those of fields), or a graph of networkx; none unless given.
    """

    joins: ClassVar[bool] = True

    def __init__(
        self,
        source: Population,
        target: Population | type | None = None,
        link: type = Link,
        *,
        directed: bool = False,
        start: Any = None,
    ) -> None:
        of_itself = target is None or isinstance(target, type)
        # Network(people, Friendship)
        super().__init__(agent=target if isinstance(target, type) else link, size=0)
        self.source = source
        self.target: Any = source if of_itself else target
        self.directed = directed
        self.start = start

    def __str__(self) -> str:
        """What listings call it."""
        way = "→" if self.directed or self.source is not self.target else "–"
        return f"{self.name} ({self.source.name} {way} {self.target.name})"

    def check(self) -> None:
        """Refuse links of a wrong class, names that are taken, and ends that are no populations.

        Raises:
            ModelError: so it is.
        """
        for end in (self.source, self.target):
            if not isinstance(end, Population) or isinstance(end, Network):
                raise ModelError(
                    f"{shown(end)} as what the network {self.name!r} links",
                    "a population of the class",
                    f"write {self.name} = Network(people), behind people = Population(…)",
                )
        if not (isinstance(self.agent, type) and issubclass(self.agent, Link)):
            raise ModelError(
                f"{shown(self.agent)} as the links of {self.name!r}",
                "a class that inherits from socialmind.Link",
                "write class Job(Link): …",
            )
        if not is_truth(self.directed):
            raise ModelError(f"directed={shown(self.directed)} of {self.name!r}", "True or False")
        for name in class_fields(self.agent):
            taken = {*TAKEN_NAMES, "x", "y", "heading", "source", "target", "other"}
            if name in taken or hasattr(NetworkTable, name):
                expected = "a name that links and networks do not use"
                place = place_of_field(self.agent, name)
                raise ModelError(f"a field called {name!r}", expected, None, *place)

    def check_within(self, cls: type, parameters: Mapping[str, Any]) -> None:
        """Refuse populations that are not the class's, and a start that names no parameter.

        Args:
            cls: the model's class.
            parameters: its parameters.

        Raises:
            ModelError: so it is.
        """
        for end in (self.source, self.target):
            # One that a subclass declares anew keeps the networks of that in whose place it stands.
            if not any(vars(base).get(end.name) is end for base in cls.__mro__):
                raise ModelError(
                    f"a network {self.name!r} of a population that the class does not have",
                    "a population of the class",
                    "declare it before: people = Population(…)",
                )
        if isinstance(self.start, Generator):
            self.start.check(parameters)

    @property
    def shape(self) -> PopulationShape:
        """What rules may know of the network."""
        joined = LinksShape(self.source.name, self.target.name, bool(self.directed))
        return PopulationShape(self.name, class_fields(self.agent), links=joined)

    def links_in(self, society: Running, form: TableForm) -> NetworkTable:
        """Return the network of a running society, without links.

        Args:
            society: the society.
            form: what its tables have in common in all societies.
        """
        return NetworkTable(society, society.shape.populations[self.name], form)
