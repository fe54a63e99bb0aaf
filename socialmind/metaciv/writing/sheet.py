"""What a model file is made of while its parts are written: names, and what the rules need."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from socialmind.metaciv.description import Argument, Effect, Facility, Model, Place
from socialmind.metaciv.writing.names import (
    TAKEN_BY_AGENTS,
    TAKEN_BY_FILES,
    TAKEN_BY_MODELS,
    TAKEN_BY_PATCHES,
    Names,
    class_name,
    identifier,
    plural,
)
from socialmind.metaciv.writing.people import People


@dataclass
class Built:
    """A type of facility in the model file.

    Attributes:
        facility: what the files say.
        name: an identifier, of one of them, and of the field that says which is an agent's own.
        population: that of all.
        title: its class.
        stock: the objects that it can hold, by their names.
        private: whether agents build their own.
        grouped: the groups that build it.
        efficient: whether it has an efficiency.
    """

    facility: Facility
    name: str
    population: str
    title: str
    stock: dict[str, None] = field(default_factory=dict)
    private: bool = False
    grouped: dict[str, None] = field(default_factory=dict)
    efficient: bool = False


@dataclass
class Unsupported:
    """What the model file cannot do, or does otherwise, with where it stands."""

    place: Place
    what: str


class Sheet:
    """The names of a model, and what its rules came to need.

    Args:
        model: what the folder says.
        people: its schemes as one.
    """

    def __init__(self, model: Model, people: People) -> None:
        self.model, self.people = model, people
        self.unsupported: list[Unsupported] = []
        self.needs: set[str] = set()
        """Features that rules use: fields of agents, phases, imports hang on them."""
        self.helpers: dict[str, str] = {}
        self.imports: dict[str, set[str]] = {}
        self.fields: dict[str, str] = {}
        """Further fields of agents, name -> declaration."""
        self.constants: dict[str, str] = {}
        """Constants at the top of the file, name -> value as text."""
        self.objects = {one.name: one for one in model.objects}
        self.effects = {one.name: one for one in model.effects}
        patch = Names(TAKEN_BY_PATCHES)
        self.pheromone_fields = {
            one.name: patch.own(identifier(one.name)) for one in model.pheromones
        }
        smelt = [one.upper() for one in self.pheromone_fields.values()]
        tables = [name for one in smelt for name in (f"FIRST_{one}", f"{one}_GROWTH")]
        self._file = Names((*TAKEN_BY_FILES, *tables))
        self.joins = {
            one: self._file.own(f"join_{identifier(one)}")
            for one, group in people.groups.items()
            if group.auto_join
        }
        """How rules are called by which all join a group at birth."""
        own = Names(TAKEN_BY_AGENTS)
        self.attribute_fields = {one: own.own(identifier(one)) for one in people.attributes}
        self.object_fields = {
            one.name: own.own(identifier(one.name), f"{identifier(one.name)}_carried")
            for one in model.objects
        }
        model_names = Names(TAKEN_BY_MODELS)
        self.parameters = {one: model_names.own(identifier(one)) for one in people.constants}
        self.counts = {
            one.name: model_names.own(f"n_{identifier(one.name)}") for one in people.civilisations
        }
        self.settings = {
            one: model_names.own(one)
            for one in ("vision_radius", "road_creation", "road_evaporation")
        }
        self.whole: set[str] = set()
        """Constants that count things, and are whole numbers therefore."""
        self.used_constants: dict[str, None] = {}
        self.carried: dict[str, None] = {}
        """Objects that some rule names."""
        self.smelt: dict[str, None] = {}
        """Pheromones that some rule names."""
        self.built: dict[str, Built] = {}
        for facility in model.facilities:
            name = own.own(identifier(facility.name), f"own_{identifier(facility.name)}")
            population = model_names.own(plural(name), f"{name}_all")
            self.built[facility.name] = Built(facility, name, population, "")
        self.group_fields = {
            one: model_names.own(identifier(one), f"{identifier(one)}_group")
            for one in people.groups
        }
        self.title = self.class_named(model.name, "Imported")
        for one in self.built.values():
            one.title = self.class_named(one.facility.name, "Facility")
        self._handlers: dict[tuple[str, str], str] = {}
        self._constants: dict[tuple[str, str], str] = {}
        self.before: Sheet | None = None
        """What was written the last time: what rules need is known when all are written."""

    def again(self) -> Sheet:
        """Return a sheet to write the same on, which knows what rules will need."""
        made = Sheet(self.model, self.people)
        made.needs, made.before = set(self.needs), self
        made.carried, made.smelt = dict(self.carried), dict(self.smelt)
        for name, one in self.built.items():
            other = made.built[name]
            other.stock, other.grouped = dict(one.stock), dict(one.grouped)
            other.private, other.efficient = one.private, one.efficient
        return made

    def handler_named(self, what: str, thing: str) -> str:
        """Return the name of the rule by which an object comes or goes."""
        key = what, thing
        if key not in self._handlers:
            self._handlers[key] = self._file.own(f"{what}_{thing}")
        return self._handlers[key]

    def constant_named(self, kind: str, name: str, *wanted: str) -> str:
        """Return the constant that stands for a terrain, or a tag, by one of some names."""
        if (kind, name) not in self._constants:
            self._constants[kind, name] = self._file.own(*wanted)
        return self._constants[kind, name]

    # Names ------------------------------------------------------------------------------------

    def class_named(self, name: str, otherwise: str) -> str:
        """Return a name for a class that nothing in the file has."""
        taken = ("Agent", "Model", "Human", "Land", "Population", "Patch", "Grid", "Civilisation")
        made = class_name(name)
        return self._file.own(f"{made}{otherwise}" if made in taken else made)

    def function_named(self, *wanted: str) -> str:
        """Return a name for a function that nothing in the file has."""
        return self._file.own(*wanted)

    def thing(self, name: str | float) -> str:
        """Return how rules call the number of an object that an agent carries."""
        self.carried[str(name)] = None
        return self.object_fields[str(name)]

    def attribute(self, name: str | float) -> str:
        """Return the field of an attribute."""
        return self.attribute_fields[str(name)]

    def pheromone(self, name: str | float) -> str:
        """Return the field of patches that is a pheromone."""
        self.smelt[str(name)] = None
        return self.pheromone_fields[str(name)]

    def facility(self, name: str | float) -> Built:
        """Return a type of facilities, which the file comes to have."""
        self.needs.add("facilities")
        made = self.built[str(name)]
        self.needs.add(f"built {made.facility.name}")
        return made

    @property
    def used_facilities(self) -> list[Built]:
        """The types of facilities that rules name."""
        return [one for name, one in self.built.items() if f"built {name}" in self.needs]

    # Numbers ----------------------------------------------------------------------------------

    def number(self, argument: Argument) -> str:
        """Return a number as rules write it: a parameter, or as it is."""
        if argument.constant is not None:
            self.used_constants[argument.constant] = None
            return f"model.{self.parameters[argument.constant]}"
        return written(float(argument.value))

    def count(self, argument: Argument) -> str:
        """Return a whole number of things as rules write it."""
        if argument.constant is None:
            return written(int(float(argument.value)))
        if not self.people.constants[argument.constant].value.is_integer():
            return f"int({self.number(argument)})"
        self.whole.add(argument.constant)
        return self.number(argument)

    def radius(self, argument: Argument) -> str:
        """Return how far something reaches, in patches: below 0 nobody is reached, as with 0."""
        return written(max(int(float(argument.value)), 0))

    def sign(self, argument: Argument) -> int:
        """Return whether a number is above 0 (1), below (−1) or 0."""
        value = float(argument.value)
        if argument.constant is not None:
            value = self.people.constants[argument.constant].value
        return (value > 0) - (value < 0)

    # What is needed ---------------------------------------------------------------------------

    def field(self, name: str, declaration: str) -> str:
        """Let agents have a field; return its name."""
        self.fields[name] = declaration
        return name

    def use(self, module: str, *names: str) -> None:
        """Let the file import names of a module."""
        self.imports.setdefault(module, set()).update(names)

    def help(self, name: str, text: str) -> str:
        """Let the file have a helper; return its name."""
        self.helpers.setdefault(name, text)
        return name

    def not_supported(self, place: Place, what: str) -> None:
        """Note what the model does not do."""
        self.unsupported.append(Unsupported(place, what))

    def effects_of(self, name: str, activation: str) -> list[Effect]:
        """Return the effects of an object at some occasion."""
        owner = self.objects[name]
        known = [self.effects[one] for one in owner.effects if one in self.effects]
        return [one for one in known if one.activation == activation]


def written(value: float) -> str:
    """Return a number as people write it, without the noise of sliders.

    >>> written(-0.1000000000000188), written(2.0), written(0.5)
    ('-0.1', '2', '0.5')
    """
    value = round(value, 9)
    if value == int(value) and abs(value) < 1e15:
        return str(int(value))
    return repr(value)


def with_model(text: str, name: str) -> bool:
    """Say whether a text of a rule uses a name."""
    return re.search(rf"\b{name}\b", text) is not None
