"""What readers of figures call parameters, measures and columns of the series, and their units.

Parameters declare a unit and a meaning; of what a model records its author says the units in
`odd_words.md`, under *Observation*, in tables `| column | unit | meaning |`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from socialmind.documents.markdown import tables_in
from socialmind.documents.odd.words import CONCEPTS, plain, words_of
from socialmind.experiments.figures.labels import Labels, word_name
from socialmind.experiments.sweeps.columns import Names
from socialmind.experiments.sweeps.measures.expressions import Expression

if TYPE_CHECKING:
    from socialmind.experiments.sweeps.capsule import SweepManifest
    from socialmind.model import Model

LONGEST = 28
"""Letters of a parameter's meaning that takes its name's place at an axis."""
KEEPING = ("mean", "median", "min", "max", "sum", "std", "first", "last", "abs", "quantile")
"""Functions of measures whose result has the unit of what they are given."""
SAID = {"min": "least", "max": "greatest", "std": "standard deviation", "first": "first value"}
"""What they are called, if not by their names."""
_GINI = re.compile(r"gini\((?:agents\.)?(\w+)\)")
_LATE = re.compile(r"(\w+)\((\w+)(?:\[-(\d+):\])?\)")


def labels_of_sweep(manifest: SweepManifest, model_class: type[Model] | None) -> Labels:
    """Return what the columns of a sweep's tables are called, and their units.

    Args:
        manifest: the sweep's.
        model_class: its model; None where it is not at hand: then names alone are known.
    """
    names: dict[str, str] = {}
    units: dict[str, str] = {}
    columns = Names(tuple(manifest.columns), tuple(manifest.measures))
    declared = Labels() if model_class is None else labels_of_parameters(model_class)
    for one in manifest.columns:
        column = columns.of_varied(one)
        if one in declared.names:
            names[column] = declared.names[one]
            units[column] = declared.units[one]
        else:
            names[column] = word_name(one)
    recorded = {} if model_class is None else units_recorded(model_class)
    for one in manifest.series_columns:
        names[columns.of_series(one)] = one.replace("_", " ")
        units[columns.of_series(one)] = recorded.get(one, "")
    for name, record in manifest.measures.items():
        text = record.get("expression", "")
        names[name], units[name] = _of_measure(name, text, manifest.every, recorded)
    return Labels(names, {name: unit for name, unit in units.items() if unit not in ("", "–")})


def labels_of_parameters(model_class: type[Model]) -> Labels:
    """Return what the parameters of a model are called, and their units."""
    declared = model_class.parameters
    names = {name: _short(name, one.doc) for name, one in declared.items()}
    return Labels(names, {name: one.unit for name, one in declared.items()})


def units_recorded(model_class: type[Model]) -> dict[str, str]:
    """Return the units of columns of the series, as far as the author's words say them."""
    folder = model_class.folder()
    section = words_of(folder, model_class.name).elements[CONCEPTS]
    found: dict[str, str] = {}
    text = section.part("observation")
    for _, _, (header, *rows) in tables_in(text):
        named = [plain(one) for one in header]
        if named[:2] == ["column", "unit"]:
            for row in rows:
                for name in re.findall(r"`([^`]+)`", row[0]):
                    # The table of the series comes first; agents have columns of the same names.
                    found.setdefault(name, row[1])
    return found


def defaults_of(model_class: type[Model] | None) -> dict[str, Any]:
    """Return the defaults of a model's parameters."""
    if model_class is None:
        return {}
    return {name: one.default for name, one in model_class.parameters.items()}


def _short(name: str, doc: str) -> str:
    """Return the meaning of a parameter where it is short, or its name."""
    return doc if doc and len(doc) <= LONGEST else name.replace("_", " ")


def _of_measure(name: str, text: str, every: int, recorded: Mapping[str, str]) -> tuple[str, str]:
    """Return what a measure is called, and its unit."""
    match = _LATE.fullmatch(text.replace(" ", ""))
    if match is not None:
        function, column, last = match.groups()
        said = SAID.get(function, function)
        span = f" of the last {int(last) * every:,} ticks" if last else " of the run"
        if function in ("first", "last"):
            span = ""
        unit = recorded.get(column, "") if function in KEEPING else ""
        return f"{column.replace('_', ' ')}, {said}{span}", unit
    if (of := _GINI.fullmatch(text)) is not None:
        return f"Gini coefficient of {of[1]}", "0 … 1"
    columns = [one for one in Expression(name, text).columns if one != "tick"] if text else []
    known = {recorded.get(one, "") for one in columns}
    keeps = not set("*/%<>=") & set(text) and all(
        one in KEEPING for one in re.findall(r"(\w+)\(", text)
    )
    return name.replace("_", " "), known.pop() if keeps and len(known) == 1 else ""
