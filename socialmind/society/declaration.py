"""What a model's class declares: its parts, read and checked when the class is made."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import cache, partial
from types import FunctionType
from typing import Any, NamedTuple

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.agents.attributes import ArrayField, HeldArray
from socialmind.agents.interaction import Interaction
from socialmind.agents.running import Running
from socialmind.errors import ModelError, nearest
from socialmind.fields import Field, declared, place_of_field, presence
from socialmind.society.messages import Messages
from socialmind.society.parameter import Parameter
from socialmind.society.phases import PhaseDeclaration
from socialmind.society.population import Population
from socialmind.values import fitted
from socialmind.worlds.contract import World

SETTINGS: Mapping[str, tuple[tuple[type, ...], str]] = {
    "name": ((str,), "a text"),
    "ticks": ((int,), "a whole number, 0 or more"),
    "score_every": ((int,), "a whole number, 0 or more"),
    "record_links": ((bool,), "True or False"),
    "record_events": ((bool,), "True or False"),
    "setup": ((tuple, list), "a tuple of each(population, rule) and once(rule)"),
    "schedule": ((tuple, list), "a tuple of each(population, rule) and once(rule)"),
    "rewards": ((dict,), "rewards by name, on a plane"),
    "interruptions": ((dict,), "interruptions by name, on a plane"),
    "measures": ((dict,), "measures by name, on a plane"),
    "buttons": ((dict,), "functions of the society by what stands on their buttons"),
}
"""The class attributes of `Model` that a modeller sets, and what they are."""


class Variable:
    """A variable of a model (a NetLogo global), readable and writable on its instances."""

    def __init__(self, field: Field) -> None:
        self.field = field

    def __get__(self, model: Any, owner: type) -> Any:
        if model is None:
            return self
        if self.field.size is not None:
            values = model.context[self.field.name]
            return ArrayField(values) if model._in_rules else HeldArray(values, self.field)
        if self.field.optional and not model.context[presence(self.field.name)]:
            return None
        return model.context[self.field.name].item()

    def __set__(self, model: Any, value: Any) -> None:
        if not model._in_rules:
            value = fitted(self.field, value, f"the variable {self.field.name!r} of {model.name}")
        if self.field.optional:
            model.context[presence(self.field.name)] = value is not None
            value = 0 if value is None else value
        model.context[self.field.name] = value


class Declaration(NamedTuple):
    """The parts that a model's class and its bases declare, by name."""

    parameters: dict[str, Parameter]
    variables: dict[str, Field]
    populations: dict[str, Population]
    networks: dict[str, Any]
    world: World
    rewards: dict[str, Any]
    interruptions: dict[str, Any]
    measures: dict[str, Any]
    interactions: dict[str, Interaction]


@cache
def kept_names(model: type) -> frozenset[str]:
    """Return the names under which an instance keeps what is its own, and what it is made with."""
    made_with = list(inspect.signature(vars(model)["__init__"]).parameters)[1:-1]
    return frozenset((*Running.__annotations__, *model.__annotations__, *made_with, "world"))


def declaration_of(cls: type, model: type) -> Declaration:
    """Read what a model's class declares, and put a `Variable` where a variable stands.

    Args:
        cls: the class.
        model: `Model`, whose names are taken.

    Raises:
        ModelError: a part of a wrong kind or under a name that is taken, with file and line.
    """
    annotations = {
        name: kind
        for name, kind in inspect.get_annotations(cls, eval_str=True).items()
        if not str(kind).startswith("typing.ClassVar")
    }
    for name, value in list(vars(cls).items()):
        _check_attribute(cls, model, name, value)
    for name, kind in annotations.items():
        value = cls.__dict__.get(name)
        if isinstance(value, Parameter):
            _check_kind(cls, value, kind)
        elif not isinstance(value, Population | World) and name not in SETTINGS:
            _check_name(cls, model, name, "a variable")
            missing: tuple[Any, ...] = () if name not in cls.__dict__ else (value,)
            setattr(cls, name, Variable(declared(cls, name, kind, *missing)))
    own = {name: value for base in reversed(cls.__mro__) for name, value in vars(base).items()}
    world = own.get("world")
    kinds = {name: value for name, value in own.items() if isinstance(value, Population)}
    found = Declaration(
        {name: value for name, value in own.items() if isinstance(value, Parameter)},
        {name: value.field for name, value in own.items() if isinstance(value, Variable)},
        {name: value for name, value in kinds.items() if not value.joins},
        {name: value for name, value in kinds.items() if value.joins},
        world if isinstance(world, World) else World(),
        dict(own.get("rewards", {})),
        dict(own.get("interruptions", {})),
        dict(own.get("measures", {})),
        {name: value for name, value in own.items() if isinstance(value, Interaction)},
    )
    _check_sizes(cls, found)
    _check_recipients(cls, found.populations)
    _check_devices(cls, model, found)
    for name, network in found.networks.items():
        _placed(cls, name, partial(network.check_within, cls, found.parameters))
    for name in ("setup", "schedule"):
        _check_phases(cls, name, own.get(name, ()), found.populations)
    return found


def _check_attribute(cls: type, model: type, name: str, value: Any) -> None:
    """Refuse an attribute of a class that is of a wrong kind or hides what models use."""
    if isinstance(value, Interaction):
        _check_name(cls, model, name, "an interaction")
    elif isinstance(value, Parameter | Population | World):
        if not isinstance(value, World):
            _check_name(cls, model, name, "a part of the model")
        elif name != "world":
            kind = type(value).__name__
            _refuse(cls, name, f"a {kind.lower()} called {name!r}", "world", f"world = {kind}(…)")
        _placed(cls, name, value.check)
    elif name in SETTINGS:
        kinds, expected = SETTINGS[name]
        right = is_whole(value) and value >= 0 if int in kinds else isinstance(value, kinds)
        if not right:
            alone = isinstance(value, PhaseDeclaration)
            remedy = f"write {name} = (…,), with a comma" if alone else None
            _refuse(cls, name, f"{name} = {value if alone else shown(value)}", expected, remedy)
        if name == "buttons":
            _check_buttons(cls, value)
    elif name in kept_names(model) or (hasattr(model, name) and not name.startswith("__")):
        there = getattr(model, name, None)
        allowed: tuple[type, ...] = ()
        if isinstance(there, property):
            allowed = (property,)
        elif inspect.isroutine(there):
            allowed = (FunctionType, classmethod, staticmethod)
        if not isinstance(value, allowed):
            what = "a method" if inspect.isroutine(there) else "something"
            _refuse(
                cls,
                name,
                f"a class attribute {name!r}, which hides {what} that every model has",
                None,
                "call it something else",
            )


def _check_buttons(cls: type, buttons: Mapping[Any, Any]) -> None:
    for label, function in buttons.items():
        if not isinstance(label, str) or not label.strip() or not callable(function):
            expected = "functions of the society by what stands on their buttons"
            remedy = 'write buttons = {"Drought": drought}'
            _refuse(cls, "buttons", f"{shown(label)}: {shown(function)}", expected, remedy)


def _placed(cls: type, name: str, check: Callable[[], None]) -> None:
    """Check an attribute of a class; what is refused is said with its file and line."""
    try:
        check()
    except ModelError as error:
        if error.file is not None:
            raise
        _refuse(cls, name, error.found, error.expected, error.remedy)


def _check_name(cls: type, model: type, name: str, what: str) -> None:
    if name.startswith("_"):
        _refuse(cls, name, f"{what} called {name!r}", "a name without a leading underscore")
    if name in kept_names(model) or hasattr(model, name):
        _refuse(cls, name, f"{what} called {name!r}", "a name that models do not use")


def _check_kind(cls: type, parameter: Parameter, kind: Any) -> None:
    """Hold a parameter's default against its annotation; a whole number may stand for a float."""
    if kind is float and parameter.kind is int:
        parameter.default = float(parameter.default)
    elif kind is not parameter.kind:
        wanted = getattr(kind, "__name__", kind)
        _refuse(
            cls,
            parameter.name,
            f"{parameter.default!r} as the default of the parameter {parameter.name!r}",
            f"a value of {wanted}"
            if kind in (float, int, bool)
            else "float, int or bool, or str with choices=",
        )


def _check_sizes(cls: type, found: Declaration) -> None:
    """Refuse a size that is neither a number nor a parameter of whole numbers."""
    sized: list[tuple[str, Any, int]] = [
        (name, size, 0)
        for name, one in found.populations.items()
        if one.table is None
        for size in one.sizes
    ]
    sized += [("world", one, 1) for one in found.world.sizes]
    whole = [name for name, one in found.parameters.items() if one.kind is int]
    for name, size, least in sized:
        if isinstance(size, str):
            if size not in whole:
                expected = "a number or the name of a parameter of whole numbers"
                _refuse(cls, name, f"the size {size!r}", expected, nearest(size, whole))
        elif not is_whole(size) or size < least:
            _refuse(cls, name, f"the size {shown(size)}", f"a whole number, {least} or more")


def _check_recipients(cls: type, populations: dict[str, Population]) -> None:
    """Refuse messages to a population of another class."""
    for name, one in populations.items():
        if isinstance(one, Messages) and one.to.name not in populations:
            found = f"messages {name!r} to a population that the class does not have"
            several = [n for n, other in populations.items() if not isinstance(other, Messages)]
            _refuse(cls, name, found, f"one of {', '.join(several)}" if several else None)


def _check_devices(cls: type, model: type, found: Declaration) -> None:
    """Refuse what the world knows nothing of."""
    kinds = found.world.devices
    for name in ("rewards", "interruptions", "measures"):
        for key, device in getattr(found, name).items():
            if name not in kinds:
                _refuse(cls, name, f"{name} without a plane", None, "write world = Plane(…)")
            if not isinstance(device, kinds[name]):
                _refuse(cls, name, f"{device!r} as {key!r}", f"one of the {name} of socialmind")
    if found.world.has_episodes and cls.stop_when is not model.stop_when:  # type: ignore[attr-defined]  # models have it
        kind = type(found.world).__name__.lower()
        _refuse(cls, "stop_when", f"stop_when() on a {kind}", "interruptions = {…}")


def _check_phases(cls: type, name: str, phases: Any, populations: dict[str, Population]) -> None:
    """Refuse what is no phase, and a phase for a population of another class."""
    for phase in phases:
        if not isinstance(phase, PhaseDeclaration):
            _refuse(cls, name, f"{phase!r} in {name}", "each(population, rule) or once(rule)")
        who = phase.population
        # One that a subclass declares anew keeps the phases of that in whose place it stands.
        if who is not None and not any(vars(base).get(who.name) is who for base in cls.__mro__):
            _refuse(
                cls,
                name,
                f"a phase in {name} for a population that the class does not have",
                f"one of {', '.join(populations)}" if populations else "once(rule): it has none",
            )


def _refuse(
    cls: type, name: str, found: str, expected: str | None, remedy: str | None = None
) -> None:
    file, line = place_of_field(cls, name)
    raise ModelError(found, expected, remedy, file, line)
