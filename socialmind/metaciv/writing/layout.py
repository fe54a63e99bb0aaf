"""How parts of a Python file are laid out: as `ruff format` does, at the width of this project."""

from __future__ import annotations

import re

from socialmind.metaciv.writing.acts.form import as_text
from socialmind.metaciv.writing.sheet import written

WIDTH = 100


def sentence(doc: str, indent: str = "    ") -> str:
    """Return a docstring, on as many lines as it needs."""
    doc = doc.replace("\\", "/").replace('"""', "'''").strip()
    if len(doc) + len(indent) + 6 <= WIDTH:
        return f'{indent}"""{doc}"""'
    summary, _, rest = doc.partition(". ")
    if rest and len(summary) + len(indent) + 4 <= WIDTH:
        return f'{indent}"""{summary}.\n\n{indent}{rest}\n{indent}"""'
    lines = [""]
    for word in doc.split():
        if lines[-1] and len(lines[-1]) + len(word) + len(indent) + 9 > WIDTH:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return f'{indent}"""' + f"\n{indent}".join(lines) + f'\n{indent}"""'


def taken(lines: list[str], *first: str) -> str:
    """Return what a function takes: what always, and what its lines use of the rest."""
    text = "\n".join(lines)
    more = [one for one in ("model", "rng") if re.search(rf"\b{one}\b", text)]
    return ", ".join([*first, *more])


def function(name: str, doc: str, lines: list[str], *first: str) -> str:
    """Return a function that takes what always, and of model and stream what its lines use."""
    head = f"def {name}({taken(lines, *first)}):\n{sentence(doc)}"
    return f"{head}\n{block(lines)}" if lines else head


def block(lines: list[str]) -> str:
    """Return lines as the body of a function."""
    return "\n".join(f"    {one}" for one in lines)


def fractional(value: float) -> str:
    """Return a number with a fraction, as 2.0."""
    text = written(value)
    return text if "." in text or "e" in text else f"{text}.0"


def plain(text: str) -> str:
    """Return a name as the text of a docstring."""
    return text.replace("\\", "/").replace('"""', "'''").strip('"') or "Unnamed"


def listed(names: list[str]) -> str:
    """Return names as a sentence lists them."""
    if len(names) <= 1:
        return "".join(names)
    return f"{', '.join(names[:-1])} and {names[-1]}"


def imported(module: str, names: set[str]) -> str:
    """Return the line that imports some names of a module, in the order of ruff."""
    ordered = sorted(names, key=lambda one: (not one.isupper(), not one[:1].isupper(), one))
    flat = f"from {module} import {', '.join(ordered)}"
    if len(flat) <= WIDTH:
        return flat
    return "\n".join([f"from {module} import (", *(f"    {one}," for one in ordered), ")"])


def laid_out(before: str, parts: list[str], after: str) -> list[str]:
    """Return parts between brackets, on one line if they fit."""
    single = "," if len(parts) == 1 and after[0] == ")" and before.endswith("=(") else ""
    single = "," if len(parts) == 1 and before.endswith("= (") else single
    flat = f"{before}{', '.join(parts)}{single}{after}"
    if len(flat) <= WIDTH:
        return [flat]
    indent = re.match(" *", before).group()  # type: ignore[union-attr]
    return [before, *(f"{indent}    {one}," for one in parts), f"{indent}{after}"]


def table(name: str, values: list[str]) -> list[str]:
    """Return a constant that is a tuple of numbers."""
    return laid_out(f"{name} = (", values, ")")


def parameter(
    name: str, kind: str, value: str, unit: str, doc: str, low: int | None = 0
) -> list[str]:
    """Return the declaration of a parameter of the model."""
    parts = [value]
    if unit:
        parts.append(f'unit="{unit}"')
    if low is not None:
        parts.append(f"low={low}")
    parts.append(f"doc={as_text(doc)}")
    flat = f"    {name}: {kind} = parameter({', '.join(parts)})"
    if len(flat) <= WIDTH:
        return [flat]
    return [f"    {name}: {kind} = parameter(", f"        {', '.join(parts)}", "    )"]


def heading(title: str) -> str:
    """Return a comment that begins a part of the file."""
    return f"# {title} ".ljust(WIDTH - 1, "-")
