"""Pieces of which lowered trees are made."""

from __future__ import annotations

import ast
from typing import Any

from socialmind.language.syntax import parsed


def name_of(name: str) -> ast.Name:
    """Return the reading of a name."""
    return ast.Name(name, ast.Load())


def call_of(name: str, *arguments: ast.expr) -> ast.Call:
    """Return a call with the model's record and arguments."""
    return ast.Call(name_of(name), [name_of("_model"), *arguments], [])


def expression(text: str) -> Any:
    """Return the expression that a text is."""
    return parsed(text, "eval").body
