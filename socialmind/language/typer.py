"""What types the expressions of a rule, as those know it that type one kind of them."""

from __future__ import annotations

import ast
from typing import Any, NoReturn, Protocol

from socialmind.language.nodes import Typed
from socialmind.language.shape import ModelShape
from socialmind.language.source import RuleSource
from socialmind.language.types import AnyType, OptionalType, TextType


class Typer(Protocol):
    """Types the expressions of one rule.

    Attributes:
        program: the program that the rule is a part of.
        shape: the model's.
        source: the rule's.
        variables: the types of its variables so far.
        assigned: those that have a value at this place.
    """

    program: Any
    shape: ModelShape
    source: RuleSource
    variables: dict[str, AnyType]
    assigned: set[str]

    def refuse(
        self, node: ast.AST, found: str, remedy: str, expected: str | None = None
    ) -> NoReturn:
        """Raise the error that names the place, what was found and what to write instead."""

    def refuse_syntax(self, node: ast.AST) -> NoReturn:
        """Refuse a construct that the language leaves out."""

    def expression(self, node: ast.expr) -> Typed:
        """Return an expression as both speeds run it, and its type."""

    def number(self, node: ast.expr) -> Typed:
        """Return an expression that must be a number (truth values count as 0 and 1)."""

    def as_number(self, value: ast.expr, kind: AnyType, near: ast.AST) -> Typed:
        """Return a typed expression as a whole number or a number."""

    def present(self, value: ast.expr, kind: OptionalType) -> Typed:
        """Return an optional value that is known to be there; None raises when the rule runs."""

    def there(self, node: ast.expr) -> Typed:
        """Return an expression whose value, if it may be None, must be there."""

    def to_float(self, value: ast.expr, kind: AnyType) -> ast.expr:
        """Return a numeric expression as a float."""

    def fitted(self, node: ast.expr, target: AnyType, what: str) -> ast.expr:
        """Return an expression as the type that its place needs, or refuse it."""

    def converted(
        self, value: ast.expr, kind: AnyType, target: AnyType, what: str, near: ast.AST
    ) -> ast.expr:
        """Return a typed expression as another type, or refuse."""

    def truth(self, node: ast.expr) -> ast.expr:
        """Return an expression as a condition."""

    def truth_value(self, node: ast.expr) -> Typed:
        """Return an expression as True or False, and the type of these."""

    def module_value(self, node: ast.expr, name: str, value: Any) -> Typed:
        """Return a constant of the author's file (or of `math`), written in its place."""

    def several(self, node: ast.expr) -> Typed:
        """Return an expression; constants written as a tuple are a table."""

    def plan_name(self, near: ast.expr, text: TextType, population: str) -> ast.expr:
        """Return a written text as the name of a plan of a population's scheme."""

    def name(self, node: ast.expr, population: str, part: str, keys: tuple[str, ...]) -> int:
        """Return the place in the population's table of names of a written name."""
