"""A model of MetaCiv's as a folder of ours: model.py, its scheme, the map, what readers need."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

from socialmind.metaciv.description import Model, Place
from socialmind.metaciv.writing.model_file import SCHEME_FILE, TERRAIN_FILE, ModelFile
from socialmind.metaciv.writing.people import people_of
from socialmind.metaciv.writing.pictures import figures
from socialmind.metaciv.writing.scheme_file import scheme_text
from socialmind.metaciv.writing.sheet import Sheet, Unsupported
from socialmind.metaciv.writing.words import odd_words, readme
from socialmind.sources.folders import FIGURES_FILE


def write_model(description: Model, folder: Path) -> list[Unsupported]:
    """Write a model as one of ours.

    Args:
        description: what the folder of MetaCiv's says.
        folder: where to, an empty folder or one that is to be made.

    Returns:
        What the model does not do, or does otherwise, with file and line; its README says the same.
    """
    description = printable(description)
    sheet = Sheet(description, people_of(description))
    file = ModelFile(sheet)
    scheme_text(sheet)
    for _ in range(2):  # what rules need, and what they are called, hangs on all of them
        sheet = sheet.again()
        file = ModelFile(sheet, file)
        scheme = scheme_text(sheet)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.py").write_text(file.text(), "utf-8")
    (folder / SCHEME_FILE).write_text(scheme, "utf-8")
    if file.map.mapped:
        rows = [",".join(map(str, row)) for row in description.environment.rows]
        (folder / TERRAIN_FILE).write_text("\n".join(rows) + "\n", "utf-8")
    (folder / FIGURES_FILE).write_text(figures(sheet, file.map), "utf-8")
    (folder / "odd_words.md").write_text(odd_words(file), "utf-8")
    (folder / "README.md").write_text(readme(file, sheet.unsupported), "utf-8")
    return sheet.unsupported


def printable(part: Any) -> Any:
    r"""Return a part of a description in which no name holds what ends a line or cannot be seen.

    Names go into comments of a program, of which a line's end would make code.

    >>> printable(("a\rb", 3))
    ('a?b', 3)
    """
    if isinstance(part, str):
        return part if part.isprintable() else "".join(c if c.isprintable() else "?" for c in part)
    if isinstance(part, Place):
        return part
    if is_dataclass(part) and not isinstance(part, type):
        own = {one.name: getattr(part, one.name) for one in fields(part)}
        changed = {name: printable(value) for name, value in own.items() if name != "rows"}
        return replace(part, **changed)
    if type(part) is tuple:
        return tuple(printable(one) for one in part)
    return part
