"""The programs of a mind, typed: its programmed functions, regulations and drive."""

from __future__ import annotations

from dataclasses import dataclass

from socialmind.errors import ModelError
from socialmind.language.program import Program
from socialmind.language.types import BOOL, FLOAT, INT, AnyType, ArrayType, TupleType
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.regulation import Regulated


@dataclass(frozen=True)
class MindProgram:
    """The typed programs of a hierarchy.

    Attributes:
        programs: symbol, inputs, outputs and whether it takes an array, for each function.
        regulations: symbol, what it takes and whether it returns a memory, for each.
        drive: the drive's symbol, or None.
        schemes: how many cogniton schemes there are.
    """

    programs: tuple[tuple[str, int, int, bool], ...]
    regulations: tuple[tuple[str, tuple[str, ...], bool], ...]
    drive: str | None
    schemes: int


def typed_programs(program: Program, assembly: Assembly, drive: str | None = None) -> MindProgram:
    """Type a hierarchy's functions and regulations as parts of a program.

    Raises:
        ModelError: one is outside the language of rules, or returns what it should not.
    """
    return MindProgram(
        tuple(typed_function(program, *one) for one in assembly.programs),
        tuple(_typed_regulation(program, one) for one in assembly.regulations),
        drive,
        len(assembly.schemes),
    )


def typed_function(
    program: Program, one: Programmed, inputs: int, outputs: int
) -> tuple[str, int, int, bool]:
    """Type a programmed function for so many inputs and outputs.

    Returns:
        Its symbol, inputs, outputs, and whether it takes its inputs as one array.

    Raises:
        ModelError: it is outside the language of rules, or returns other than its outputs.
    """
    source = program.source(one.function)
    kinds: tuple[AnyType, ...] = (FLOAT,) * inputs
    if one.takes_array:
        kinds = (ArrayType(FLOAT, inputs),)
    symbol, result = program.specialised(source, kinds, None, source.tree)
    items = result.items if isinstance(result, TupleType) else (result,)
    if len(items) != outputs or any(item not in (FLOAT, INT, BOOL) for item in items):
        raise ModelError(
            f"the function {source.name!r}, which returns {result}",
            f"{outputs} numbers, one for each output of its skill" if outputs > 1 else "a number",
            None,
            source.file,
            source.line,
        )
    return symbol, inputs, outputs, one.takes_array


def _typed_regulation(program: Program, one: Regulated) -> tuple[str, tuple[str, ...], bool]:
    source = program.source(one.function)
    kinds = tuple(BOOL if name == "commanded" else FLOAT for name in one.takes)
    symbol, result = program.specialised(source, kinds, None, source.tree)
    items = result.items if isinstance(result, TupleType) else (result,)
    if not 1 <= len(items) <= 2 or any(item not in (FLOAT, INT, BOOL) for item in items):
        raise ModelError(
            f"the regulation {source.name!r}, which returns {result}",
            "the variable's value, or the value and the memory",
            None,
            source.file,
            source.line,
        )
    return symbol, one.takes, len(items) == 2
