"""A skill's own program as text: where it stands, checked without being run, and put among files.

Nothing of a text is executed here: names get functions from its compiled code, and plain numbers
from its syntax tree, which is all that typing a rule looks at.
"""

from __future__ import annotations

import ast
import itertools
import linecache
import math
import operator
import os
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType, FunctionType
from typing import Any

from socialmind.errors import ModelError, SocialmindError
from socialmind.language.syntax import compiled, parsed
from socialmind.mind.code.mind_code import check_program
from socialmind.mind.files.evoagents.ades import CLASS
from socialmind.mind.files.evoagents.text_file import Line, text_of
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Skill

MOST_TEXT = 200_000
"""Characters of a program."""
SUFFIX = ".py"
MODULES = {"math": math}
"""What a program may import; the language knows no other."""
_LARGEST = 2**63
_numbers = itertools.count(1)
"""Of texts that are checked, several at a time."""
_OPERATORS: Mapping[type[ast.operator], Any] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
}  # fmt: skip


def is_program(one: Mapping[str, Any]) -> bool:
    """Whether the function of a skill of a document is a program whose text the document has."""
    return bool(one["function"] == Programmed.keyword and one.get("program") is not None)


def file_of(one: Mapping[str, Any], called: str, there: Collection[str]) -> str:
    """Return the name of the file of a skill's program, as its `.ades` file leads to it.

    Args:
        one: the skill, of a document.
        called: the skill's name by which its files go.
        there: the names of the files in its folder.

    >>> file_of({"lines": ["class: grip"]}, "Claw", ["Claw.ades", "Claw.py"])
    'Claw.py'
    >>> file_of({"lines": ["class: grip"]}, "Claw", ["Claw.ades"])
    'grip.py'
    """
    fields = [Line(line, 1).fields for line in one["lines"]]
    named = next((f[1] for f in fields if f[0] == CLASS and len(f) == 2), called)
    own, other = f"{Path(named).name}{SUFFIX}", f"{called}{SUFFIX}"
    return other if own not in there and other in there else own


def names_in(folder: Path) -> list[str]:
    """Return the names of the files of a folder; none where there is no folder."""
    return [path.name for path in folder.iterdir()] if folder.is_dir() else []


def text_as_lines(text: str) -> str:
    """Return a text whose lines end as a page's do."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def program_text(folder: Path, one: Mapping[str, Any]) -> str | None:
    """Return the text of a skill's program; None where its function is none, or has no file.

    Args:
        folder: of the skill's files.
        one: the skill, as its file says.
    """
    if one["function"] != Programmed.keyword:
        return None
    file = folder / file_of(one, one["name"], names_in(folder))
    return text_as_lines(text_of(file)) if file.is_file() else None


@contextmanager
def with_text(one: Mapping[str, Any], called: str, folder: Path) -> Iterator[Path]:
    """Give the folder of a skill's files with its program as the document has it.

    Args:
        one: the skill, of a document.
        called: the skill's name by which its files go.
        folder: of its files; there may be none.

    Raises:
        ModelError: what is raised in the block, which names files without the passing folder.
    """
    if not is_program(one):
        yield folder
        return
    there = names_in(folder)
    with TemporaryDirectory(prefix="socialmind-program-") as passing:
        inner = Path(passing)
        (inner / file_of(one, called, there)).write_text(one["program"], "utf-8")
        try:
            yield inner
        except ModelError as error:
            found, expected, remedy = (
                part and part.replace(f"{inner}{os.sep}", "")
                for part in (error.found, error.expected, error.remedy)
            )
            raise ModelError(found or "", expected, remedy, error.file, error.line) from None


def put_program(own: dict[str, bytes], one: Mapping[str, Any], before: str | None) -> None:
    """Put a skill's program among its files; one that says the same stays as it is.

    Args:
        own: the content of the skill's files, by name.
        one: the skill, of a document.
        before: the name of the file in which its program lay, if it had one.
    """
    file = file_of(one, one["name"], own)
    old = own.pop(before, None) if before not in (None, file) else own.get(file)
    text = one["program"]
    if old is not None and text_as_lines(old.decode("utf-8-sig")) == text:
        own[file] = old
        return
    ending = "\r\n" if old is not None and b"\r\n" in old else "\n"
    whole = text if text.endswith("\n") or not text else f"{text}\n"
    own[file] = whole.replace("\n", ending).encode()


def checked_text(program: Any) -> str | None:
    """Return the text of a program that a page sent, if it can be one.

    Raises:
        SocialmindError: it cannot.
    """
    if program is None:
        return None
    if not isinstance(program, str) or len(program) > MOST_TEXT:
        raise SocialmindError(f"expected a program of {MOST_TEXT:,} characters at most")
    try:
        program.encode()
    except UnicodeEncodeError:
        raise SocialmindError("a program holds characters that no file can") from None
    return text_as_lines(program)


# The language of rules -----------------------------------------------------------------------


@dataclass(frozen=True)
class Finding:
    """What is odd about a program, and its line."""

    text: str
    line: int | None


def findings_of_text(text: str, skill: Skill) -> Iterator[Finding]:
    """Yield why a program could not be compiled for a skill, in the words of the compiler.

    Args:
        text: of the program, which is Python.
        skill: whose inputs and outputs it is for; its function says which of the text's it is.
    """
    function = skill.function
    assert isinstance(function, Programmed)
    file = f"program {next(_numbers)} of {skill.name}"
    try:
        names, unknown = _names_in(text, file)
    except SyntaxError as error:  # such as `return` outside of a function
        yield Finding(f"not valid Python ({error.msg})", error.lineno)
        return
    called = function.name
    found = _first_unknown(called, names, unknown)
    if found is not None:
        name, line = found
        yield Finding(
            f"{name} is known only when the program runs, so whether the rest is in the language "
            "of rules is not checked here; a plain number or function is",
            line,
        )
        return
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    try:
        check_program(skill.changed(function=Programmed(names[called], function.written)))
    except ModelError as error:
        yield Finding(f"it could not run: {said(error)}", error.line)
    finally:
        linecache.cache.pop(file, None)


def said(error: ModelError) -> str:
    """Return an error in one sentence, without file and line."""
    parts = [error.found, error.expected and f"expected {error.expected}", error.remedy]
    return "; ".join(filter(None, parts))


def _names_in(text: str, file: str) -> tuple[dict[str, Any], dict[str, int]]:
    """Return what the names of a file stand for, without running it, and the lines of others."""
    tree = parsed(text)
    made = compiled(tree, file)
    codes = {
        (one.co_name, one.co_firstlineno): one
        for one in made.co_consts
        if isinstance(one, CodeType)
    }
    names: dict[str, Any] = {"__name__": "program"}
    unknown: dict[str, int] = {}
    for node in tree.body:
        known = _known(node, names, codes)
        for name in _bound(node):
            names.pop(name, None)
            unknown.pop(name, None)
            if known is None:
                unknown[name] = node.lineno
        names |= known or {}
    return names, unknown


def _known(
    node: ast.stmt, names: dict[str, Any], codes: Mapping[tuple[str, int], CodeType]
) -> dict[str, Any] | None:
    """Return what a statement gives names to; None where only running it would tell."""
    match node:
        case ast.FunctionDef(name=name, decorator_list=[], args=given):
            code = codes.get((name, node.lineno))
            defaults = [_value(one, names) for one in given.defaults]
            if code is None or given.kwonlyargs or None in defaults:
                return None
            return {name: FunctionType(code, names, name, tuple(defaults) or None)}
        case (
            ast.Assign(targets=[ast.Name(id=name)], value=value)
            | ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value)
        ):
            if isinstance(value, ast.Name) and isinstance(names.get(value.id), FunctionType):
                return {name: names[value.id]}
            found = _value(value, names)
            return None if found is None else {name: found}
        case ast.Import(names=[ast.alias(name=module, asname=called)]) if module in MODULES:
            return {called or module: MODULES[module]}
        case ast.ImportFrom(module=str(module), level=0, names=some) if module in MODULES:
            own = vars(MODULES[module])
            if all(one.name in own for one in some):
                return {one.asname or one.name: own[one.name] for one in some}
            return None
        case ast.Expr() | ast.Pass():
            return {}
    return None


def _value(node: ast.expr, names: Mapping[str, Any]) -> Any:
    """Return the number that an expression plainly is; None for any other."""
    found: Any = None
    match node:
        case ast.Constant(value=int() | float() | bool() | str() as found):
            pass
        case ast.Name(id=name):
            found = names.get(name)
        case ast.Attribute(value=ast.Name(id=module), attr=name) if module in names:
            found = getattr(names[module], name, None) if module in MODULES else None
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            one = _value(inner, names)
            found = -one if isinstance(one, int | float) else None
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            both = _value(left, names), _value(right, names)
            if all(isinstance(one, int | float) for one in both):
                try:
                    found = _OPERATORS[type(op)](*both)
                except ArithmeticError:
                    return None
    if isinstance(found, int) and abs(found) >= _LARGEST:
        return None
    return found if isinstance(found, int | float | str) else None


def _bound(node: ast.stmt) -> Iterator[str]:
    """Yield the names that a statement at the top of a file may give something to."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield node.name
        return
    for one in ast.walk(node):
        if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store):
            yield one.id
        elif isinstance(one, ast.alias):
            yield one.asname or one.name.partition(".")[0]
        elif isinstance(one, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield one.name


def _first_unknown(
    called: str, names: Mapping[str, Any], unknown: Mapping[str, int]
) -> tuple[str, int] | None:
    """Return a name that a function or what it calls reads and that is not known, and its line."""
    waiting, seen = [called], set()
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        if name in unknown:
            return name, unknown[name]
        if isinstance(names.get(name), FunctionType):
            waiting += names[name].__code__.co_names
    return None
