"""The class of model classes: what a class declares becomes a shape, and its rules a program."""

from __future__ import annotations

import copyreg
import re
import sys
from abc import ABCMeta
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.fields import place_of_field
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape
from socialmind.language.source import hold_text
from socialmind.society.declaration import declaration_of
from socialmind.society.founding.blueprint import Blueprint
from socialmind.society.founding.making import begin_networks
from socialmind.society.messages import with_mailboxes
from socialmind.sources.cells import refuse_outdated, taken_by
from socialmind.sources.folders import file_of_class
from socialmind.sources.modules import note_definition
from socialmind.sources.typed_in import MAIN, is_typed_in, note_place
from socialmind.work.packing import is_private, reference

if TYPE_CHECKING:
    from socialmind.mind.steering import Steering


class ModelKind(ABCMeta):
    """The class of model classes.

    They go to other processes wherever they were loaded from, and a society that is made takes no
    further attributes.
    """

    def __call__(cls, *arguments: Any, **settings: Any) -> Any:
        """Return a society, finished."""
        if cls.__module__ == MAIN:
            refuse_outdated(cls)
        made = super().__call__(*arguments, **settings)
        made._made = True
        return made

    def declare(cls: Any, model: type) -> None:
        """Read what a class declares, once it is made.

        Args:
            model: `Model`, whose names are taken.

        Raises:
            ModelError: a part of a wrong kind or under a name that is taken, with file and line.
        """
        if cls.__module__ == MAIN:
            note_place(cls)
            cls._took = taken_by(cls)
        hold_text(getattr(sys.modules.get(cls.__module__), "__file__", None) or "")
        note_definition(cls.__module__)
        found = declaration_of(cls, model)
        cls.parameters, cls.variables, cls.populations, cls.networks = found[:4]
        cls.declared_world, cls.rewards, cls.interruptions, cls.measures = found[4:8]
        cls.name = cls.__dict__.get("name") or _snake_case(cls.__name__)
        world = cls.declared_world.shape(cls, partial(place_of_field, cls))
        cls.shape = ModelShape(
            name=cls.name,
            parameters={name: one.field for name, one in cls.parameters.items()},
            variables=cls.variables,
            populations=with_mailboxes(
                {n: world.inhabited(one.shape) for n, one in cls.populations.items()}
            )
            | {name: one.shape for name, one in cls.networks.items()},
            world=world,
            setup=tuple(phase.shape for phase in cls.setup),
            schedule=tuple(phase.shape for phase in cls.schedule),
            interactions=found.interactions,
        )
        cls._programs = dict[bool, Program]()
        cls._blueprint = Blueprint(cls.shape)

    def typed(cls: Any, compiled: bool = True) -> Program:
        """Return the typed rules of a model; typed anew once a constant or helper is another.

        Raises:
            ModelError: a rule outside the language.
        """
        known: Program | None = cls._programs.get(compiled)
        if known is None or known.outdated:
            known = cls._programs[compiled] = Program(cls.shape, compiled)
        return known

    def steerings(cls: Any, given: Any = None) -> dict[str, Steering]:
        """Return the hierarchies of skills of the populations that have some.

        Args:
            given: what `hierarchy` of the model is.
        """
        if given is None and all(one.hierarchy is None for one in cls.populations.values()):
            return {}
        from socialmind.mind.steering import steerings_of

        return steerings_of(
            cls.populations, cls.folder(), given, cls.name, cls._blueprint.minds.load
        )

    def before_setup(cls: Any, **arguments: Any) -> Any:
        """Return a society whose setup has not run; arguments as of the class."""
        made = cls.__new__(cls)
        made._sets_up = False
        made.__init__(**arguments)
        begin_networks(made)
        made._made = True
        return made

    def folder(cls) -> Path:
        """Return the folder of a model's class; for one that was typed in, the working folder."""
        file = file_of_class(cls)
        return Path.cwd() if file is None else file.parent


def _reduced(kind: ModelKind) -> Any:
    return reference(kind) if is_private(kind) or is_typed_in(kind) else kind.__qualname__


copyreg.pickle(ModelKind, _reduced)


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
