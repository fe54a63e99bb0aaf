"""Names, numbers, places and whole fields as a scheme's YAML file has them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from coglogo_py.files.yaml_nodes import TRUTH

WIDTH = 100
PLAIN = re.compile(r"[^\W\d][\w-]*( [\w-]+)*")
"""Names that need no quotes, but for the words that YAML takes for something else."""
TAKEN_WORDS = frozenset((*TRUTH, "y", "n", "null"))


def name_text(name: str, plain: re.Pattern[str] = PLAIN) -> str:
    """Return a name as YAML, in quotes where it needs them.

    Args:
        name: which.
        plain: what needs none, but for the words that YAML takes for something else.
    """
    if plain.fullmatch(name) and name.lower() not in TAKEN_WORDS:
        return name
    escaped = (
        f"\\{char}" if char in '"\\' else char if char.isprintable() else f"\\U{ord(char):08x}"
        for char in name
    )
    return f'"{"".join(escaped)}"'


def number_text(value: float) -> str:
    """Return a number as the file has it."""
    mantissa, e, exponent = repr(value).partition("e")
    if not e:
        return mantissa.removesuffix(".0")
    # With a point, other readers of YAML know it for a number too.
    return mantissa + ("" if "." in mantissa else ".0") + e + exponent


def position_text(position: Sequence[int]) -> str:
    """Return a place in the drawing as the file has it."""
    return f"[{position[0]}, {position[1]}]"


def mapping_lines(field: str, values: dict[str, str], indent: str) -> list[str]:
    """Return a field of name: value pairs, on one line if they fit; nothing if there are none."""
    pairs = [f"{name_text(name)}: {value}" for name, value in values.items()]
    if not pairs:
        return []
    line = f"{indent}{field}: {{{', '.join(pairs)}}}"
    return (
        [line] if len(line) <= WIDTH else [f"{indent}{field}:", *(f"{indent}  {p}" for p in pairs)]
    )


def list_lines(field: str, names: Iterable[str], indent: str) -> list[str]:
    """Return a field of several names, on one line if they fit."""
    texts = [name_text(name) for name in names]
    line = f"{indent}{field}: [{', '.join(texts)}]"
    return (
        [line]
        if len(line) <= WIDTH
        else [f"{indent}{field}:", *(f"{indent}  - {t}" for t in texts)]
    )
