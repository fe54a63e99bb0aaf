"""What a folder of MetaCiv's says: a model as data, each part with its file and line.

Names are as written in the files. What the reader returns without an error is whole: every name
that is used is declared, every value is in range, every action has the arguments that it needs
(`actions.ACTIONS`). So nothing needs to be checked again.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, NamedTuple


class Place(NamedTuple):
    """Where something stands: a file, relative to the model's folder, and a line from 1."""

    file: str
    line: int


class Hsb(NamedTuple):
    """A colour as hue, saturation and brightness, each 0 … 1."""

    hue: float
    saturation: float
    brightness: float


# ------------------------------------------------------------------------------------- schemes


@dataclass(frozen=True, slots=True)
class Attribute:
    """A number that each agent of a scheme has."""

    name: str
    start: float
    place: Place


@dataclass(frozen=True, slots=True)
class Constant:
    """A number of a scheme that arguments and triggers may name."""

    name: str
    value: float
    place: Place


@dataclass(frozen=True, slots=True)
class Permit:
    """A plan that is available while a cogniton is owned."""

    plan: str
    place: Place


@dataclass(frozen=True, slots=True)
class Influence:
    """What a cogniton adds to the weight of a plan, times its value."""

    plan: str
    weight: int
    place: Place


@dataclass(frozen=True, slots=True)
class Trigger:
    """A comparison of an attribute that brings a cogniton, and takes it away.

    Args:
        attribute: whose value is compared.
        threshold: with what, unless there is a constant.
        comparison: `attribute comparison threshold` must hold.
        constant: a constant of the scheme that stands for the threshold.
    """

    attribute: str
    threshold: float
    comparison: Literal["<", "<=", "==", ">=", ">"]
    constant: str | None
    place: Place


@dataclass(frozen=True, slots=True)
class Cogniton:
    """A part of a mind; culturons are cognitons that a role of a group names.

    Args:
        type: belief, meme, percept, skill, trait or culturon; changes nothing.
        initial: whether an agent has it at birth, with the value 1.
        start_chance: percent; works in the older format alone, `Model.older`.
        colour: signed RGB number as Java writes it.
    """

    name: str
    description: str
    type: str
    initial: bool
    start_chance: int
    colour: int | None
    permits: tuple[Permit, ...]
    influences: tuple[Influence, ...]
    triggers: tuple[Trigger, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Role:
    """A role of a group and the cognitons that it lends its holders, with the value 1."""

    name: str
    culturons: tuple[str, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Group:
    """A model of groups; `auto_join` is the role that everybody takes at birth, if any."""

    name: str
    roles: tuple[Role, ...]
    auto_join: str | None
    place: Place


@dataclass(frozen=True, slots=True)
class Argument:
    """What an action is given.

    Args:
        type: Objet, Amenagement, Terrain, Pheromone, Attribute, Cogniton, Group, GroupAndRole,
            Integer, Double, String or Comparator.
        value: a name, a number (int of Integer, float of Double), a comparator; of a GroupAndRole
            the group.
        label: what stands before it in the file; tells arguments of one type apart.
        role: of a GroupAndRole.
        constant: a constant of the scheme that stands for the number, if the action heeds any.
    """

    type: str
    value: str | int | float
    label: str
    place: Place
    role: str | None = None
    constant: str | None = None


@dataclass(frozen=True, slots=True)
class Action:
    """A node of a plan's tree.

    Args:
        name: the action's name in `actions.ACTIONS`.
        arguments: in the order of `actions.ACTIONS[name].arguments`, as many.
        children: what follows one tab deeper.
        direction: of A_Move NORTH, EAST, SOUTH or WEST; of A_Move_Cardinals_Random the one written.
        written: the name in the file, an older one of the same action perhaps.
    """

    name: str
    arguments: tuple[Argument, ...]
    children: tuple[Action, ...]
    place: Place
    direction: str | None = None
    written: str = ""

    def all(self) -> Iterator[Action]:
        """Yield the node and all under it."""
        yield self
        for child in self.children:
            yield from child.all()

    def argument(self, type_: str) -> Argument:
        """Return the first argument of a type."""
        return next(one for one in self.arguments if one.type == type_)


@dataclass(frozen=True, slots=True)
class Plan:
    """A plan: actions in order, some with children.

    Args:
        kind: "birth" runs once at birth, "self" in every tick, "plan" when it is chosen; there is
            one of the first two at most.
    """

    name: str
    kind: Literal["plan", "birth", "self"]
    actions: tuple[Action, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Scheme:
    """A cognitive scheme: what agents of a civilisation are made of."""

    name: str
    attributes: tuple[Attribute, ...]
    constants: tuple[Constant, ...]
    cognitons: tuple[Cogniton, ...]
    groups: tuple[Group, ...]
    plans: tuple[Plan, ...]
    place: Place


# ------------------------------------------------------------------------------------- the world


@dataclass(frozen=True, slots=True)
class Ingredient:
    """So many of an object, in a recipe."""

    object: str
    count: int


@dataclass(frozen=True, slots=True)
class Effect:
    """What having or using an object does to its owner."""

    name: str
    target: Literal["attribute", "cogniton", "object"]
    target_name: str
    value: float
    permanent: bool
    kind: Literal["set", "add", "remove"]
    activation: Literal["possession", "use", "never"]
    place: Place


@dataclass(frozen=True, slots=True)
class Object:
    """Something that agents carry, with the names of its effects."""

    name: str
    description: str
    effects: tuple[str, ...]
    recipe: tuple[Ingredient, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Facility:
    """Something that agents build on a cell, with the names of its effects."""

    name: str
    effects: tuple[str, ...]
    recipe: tuple[Ingredient, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Pheromone:
    """A number that each cell has."""

    name: str
    place: Place


@dataclass(frozen=True, slots=True)
class Deposit:
    """A pheromone of a terrain: what cells have at the start, and what comes every 150 ticks."""

    pheromone: str
    initial: float
    growth: float
    place: Place


@dataclass(frozen=True, slots=True)
class Terrain:
    """A kind of cell."""

    name: str
    colour: Hsb
    passability: int
    impassable: bool
    deposits: tuple[Deposit, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Civilisation:
    """A people: how many agents each of its places makes, and with what scheme.

    Args:
        scattered: cells; agents appear at the place + U(0, 2·scattered) in x and y.
        cognitons: with which its agents are born beside the scheme's initial ones (older format).
    """

    name: str
    agents: int
    scattered: int
    colour: Hsb
    scheme: str
    cognitons: tuple[str, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Settlement:
    """Where a civilisation begins: column `u`, row `v` counted as MetaCiv does.

    On the map, with y upwards, it is x = u, y = (height - v) mod height.
    """

    civilisation: str
    u: int
    v: int
    place: Place


@dataclass(frozen=True, slots=True)
class Environment:
    """The map.

    Args:
        terrains: names by index; one that no row uses may be unknown.
        rows: `height` rows from the top of `width` indices; row r is y = height - 1 - r.
    """

    name: str
    width: int
    height: int
    settlements: tuple[Settlement, ...]
    terrains: tuple[str, ...]
    rows: tuple[tuple[int, ...], ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Parameters:
    """What parametres.metaciv says; of the three integers 0 or less means infinite."""

    map: str
    decision_maker: Literal["MaxWeight", "WeightedStochastic", "MaxWeightOx2"]
    road_creation: int
    road_evaporation: int
    vision_radius: int
    dispersion: bool
    place: Place


@dataclass(frozen=True, slots=True)
class Model:
    """All that a folder says.

    Args:
        name: of the folder.
        older: whether it is of the flat format of 2014.
    """

    name: str
    older: bool
    parameters: Parameters
    environment: Environment
    schemes: tuple[Scheme, ...]
    civilisations: tuple[Civilisation, ...]
    terrains: tuple[Terrain, ...]
    objects: tuple[Object, ...] = field(default=())
    facilities: tuple[Facility, ...] = field(default=())
    pheromones: tuple[Pheromone, ...] = field(default=())
    effects: tuple[Effect, ...] = field(default=())
