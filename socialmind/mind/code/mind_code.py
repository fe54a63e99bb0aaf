"""The programs of a hierarchy as code: typed, and compiled or interpreted."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from socialmind.compiling.modules import compiled_module
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape, PopulationShape, WorldShape
from socialmind.mind.code.drive import names_of, typed_drive
from socialmind.mind.code.programs import typed_function, typed_programs
from socialmind.mind.code.text import MIND_NAME, module_text
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Skill


def _outside_models() -> ModelShape:
    """Return the shape of what is no model: a mind alone."""
    shape = PopulationShape(MIND_NAME, {}, hierarchy=True)
    return ModelShape("the mind", {}, {}, {MIND_NAME: shape}, WorldShape(), (), ())


def check_program(skill: Skill) -> None:
    """Refuse a skill whose programmed function cannot be compiled.

    Raises:
        ModelError: the function is outside the language of rules, with file and line.
    """
    if isinstance(skill.function, Programmed):
        one = (skill.function, len(skill.inputs), len(skill.outputs))
        typed_function(Program(_outside_models(), compiled=True), *one)


def code_of(assembly: Assembly, drive: Callable[..., None] | None) -> MindCode:
    """Return the programs of a hierarchy, typed anew once a constant or helper is another.

    Raises:
        ModelError: as of `MindCode`.
    """
    known: MindCode | None = assembly.codes.get(drive)
    if known is None or known.outdated:
        known = assembly.codes[drive] = MindCode(assembly, drive)
    return known


class MindCode:
    """The programmed functions, regulations and drive of a hierarchy.

    Args:
        assembly: the hierarchy.
        drive: the drive module, or None.

    Raises:
        ModelError: one of them is outside the language of rules, or names what is not there.
    """

    def __init__(self, assembly: Assembly, drive: Callable[..., None] | None) -> None:
        self._program = Program(_outside_models(), compiled=True)
        symbol = None if drive is None else typed_drive(self._program, drive)
        self._programs = typed_programs(self._program, assembly, symbol)
        self.names = names_of(self._program, assembly)

    @property
    def outdated(self) -> bool:
        """Whether typing its programs again would read other constants or call other helpers."""
        return self._program.outdated

    @cached_property
    def module(self) -> Any:
        """The module of the compiled functions `evaluate` and `renew`."""
        return compiled_module(module_text(self._program, self._programs), {})

    @cached_property
    def _interpreted(self) -> dict[str, Callable[..., Any]]:
        return self._program.interpreted({})

    @property
    def functions(self) -> list[Callable[..., Any]]:
        """The programmed functions as interpreted Python, as the assembly numbers them."""
        return [self._interpreted[symbol] for symbol, *_ in self._programs.programs]

    @property
    def regulations(self) -> list[Callable[..., Any]]:
        """The modeller's regulations as interpreted Python."""
        return [self._interpreted[symbol] for symbol, *_ in self._programs.regulations]

    @property
    def drive(self) -> Callable[..., None] | None:
        """The drive as interpreted Python."""
        symbol = self._programs.drive
        return None if symbol is None else self._interpreted[symbol]
