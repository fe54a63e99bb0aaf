"""The types of the rule language: what an expression in a rule can be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar


class _Called:
    """What error messages call a type: words that may name its parts."""

    words: ClassVar[str]

    def __str__(self) -> str:
        return self.words.format(**vars(self))


@dataclass(frozen=True)
class Type(_Called):
    """A type without parts; its name is what error messages call it."""

    name: str
    words = "{name}"


BOOL = Type("a truth value")
INT = Type("a whole number")
FLOAT = Type("a number")
NONE = Type("None")
NOBODY = Type("None, where an agent may be")
MODEL = Type("the model")
RNG = Type("the random stream")
NUMBERS = (BOOL, INT, FLOAT)
SCALARS: dict[type, Type] = {float: FLOAT, int: INT, bool: BOOL}
"""The types of Python's numbers, as fields and constants have them."""


@dataclass(frozen=True)
class OptionalType(_Called):
    """A field's value that may be None."""

    of: Type
    words = "{of} or None"


@dataclass(frozen=True)
class ArrayType(_Called):
    """A fixed-size array of a field."""

    of: Type
    size: int
    words = "an array of {size}"


@dataclass(frozen=True)
class _OfPopulation(_Called):
    population: str


class RowType(_OfPopulation):
    """An agent of a population."""

    words = "an agent of {population!r}"


class MaybeRowType(_OfPopulation):
    """An agent of a population, or None."""

    words = "an agent of {population!r} or None"


@dataclass(frozen=True)
class FoundType(_OfPopulation):
    """The agents of a population that were found around somebody.

    Attributes:
        population: theirs; that of a network where these are links.
        through: the network by which they are linked with somebody, and of which of its lists
            ("out", "in"); None for others.
        by: by which index compiled rules find the others: of those that are "near", of the
            "members" of groups, of those "asking" to be members.
    """

    words = "a set of agents of {population!r}"
    through: tuple[str, str] | None = None
    by: str = "near"


@dataclass(frozen=True)
class PatchesType(_Called):
    """The patches that were found around somebody."""

    words = "a set of patches"


class MindType(_OfPopulation):
    """The mind of an agent of a population."""

    words = "the mind of an agent of {population!r}"


@dataclass(frozen=True)
class HierarchyType:
    """The hierarchy of skills of an agent of a population.

    Attributes:
        population: the population.
        driven: whether this is what a drive module holds, in the middle of an evaluation.
    """

    population: str
    driven: bool = False

    def __str__(self) -> str:
        return "the mind" if self.driven else f"the hierarchy of an agent of {self.population!r}"


class PopulationType(_OfPopulation):
    """A population."""

    words = "the population {population!r}"


@dataclass(frozen=True)
class InteractionType(_Called):
    """An interaction, whose outcome is drawn."""

    interaction: str
    words = "the interaction {interaction!r}"


@dataclass(frozen=True)
class WorldType(_Called):
    """The world that the agents stand on."""

    words = "the world"


@dataclass(frozen=True)
class PatchType(_Called):
    """A patch of the world."""

    words = "a patch"


class PlanType(_OfPopulation):
    """A plan of the scheme of a population's minds, or None."""

    words = "a plan"


@dataclass(frozen=True)
class ChoiceType:
    """A parameter that is one of several texts."""

    texts: tuple[str, ...]

    def __str__(self) -> str:
        return f"a choice among {', '.join(self.texts)}"


@dataclass(frozen=True)
class TextType(_Called):
    """A written text: the name of a plan, a cogniton, a group, a role or a culturon."""

    value: str
    words = "the text {value!r}"


@dataclass(frozen=True)
class TupleType:
    """Several values at once, as in `x, y = place(human)`."""

    items: tuple[AnyType, ...]

    def __str__(self) -> str:
        return f"{len(self.items)} values"


@dataclass(frozen=True)
class TableType:
    """A tuple of constants, as `((0, 1), (1, 0))`; its values are part of what it is.

    Attributes:
        values: numbers, truth values or texts, or tuples of equal length of these.
        item: the type of one; None among texts, which have no type in common.
    """

    values: tuple[Any, ...]
    item: Type | TupleType | None

    def __str__(self) -> str:
        return f"a tuple of {len(self.values)}"


AnyType = (
    Type
    | OptionalType
    | ArrayType
    | RowType
    | MaybeRowType
    | FoundType
    | PatchesType
    | MindType
    | HierarchyType
    | PopulationType
    | InteractionType
    | WorldType
    | PatchType
    | PlanType
    | ChoiceType
    | TextType
    | TupleType
    | TableType
)


def unified(one: AnyType, other: AnyType) -> AnyType | None:
    """Return the type that can hold both, or None when there is none.

    >>> unified(INT, FLOAT) is FLOAT
    True
    >>> unified(BOOL, INT) is None
    True
    """
    if one == other:
        return one
    if {one, other} == {INT, FLOAT}:
        return FLOAT
    if {one, other} <= {NOBODY, NONE}:
        return NOBODY
    agents = [kind for kind in (one, other) if isinstance(kind, RowType | MaybeRowType)]
    if agents and all(kind in (NOBODY, NONE) or kind in agents for kind in (one, other)):
        population = agents[0].population
        return MaybeRowType(population) if agents[-1].population == population else None
    if isinstance(one, TupleType) and isinstance(other, TupleType):
        if len(one.items) != len(other.items):
            return None
        items = [unified(a, b) for a, b in zip(one.items, other.items, strict=True)]
        found = tuple(item for item in items if item is not None)
        return TupleType(found) if len(found) == len(items) else None
    return None
