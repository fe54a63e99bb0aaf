"""What columns are called on axes, and in what unit they are."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

_LINK = re.compile(r"(influence|reinforcement|conditional)\.(.+)\.(\w+)")
_START = re.compile(r"(start|at_birth|chance|inherited)\.(.+)")
_STARTS = {
    "start": "{} at the start", "at_birth": "{} at birth", "chance": "chance of {} at birth",
    "inherited": "inherited {}",
}  # fmt: skip


@dataclass(frozen=True)
class Labels:
    """What a reader of a figure calls the columns of a table.

    Attributes:
        names: by column; others are called as they are, with spaces for `_`.
        units: by column.

    >>> labels = Labels({"settled": "artisans"}, {"settled": "agents"})
    >>> labels.axis("settled"), labels.axis("tool_price")
    ('artisans (agents)', 'tool price')
    """

    names: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)

    def name(self, column: str) -> str:
        """Return what a column is called."""
        return self.names.get(column) or column.replace("_", " ")

    def axis(self, column: str, prefix: str = "") -> str:
        """Return what stands at an axis: the name, and the unit in brackets."""
        return with_unit(f"{prefix}{self.name(column)}", self.units.get(column, ""))

    def also(self, names: Mapping[str, str], units: Mapping[str, str]) -> Labels:
        """Return these labels with others in front of them."""
        return Labels({**self.names, **names}, {**self.units, **units})


def with_unit(name: str, unit: str) -> str:
    """Return a name with its unit in brackets, but where the name says it already.

    >>> with_unit("artisans", "agents"), with_unit("stones in the way", "stones")
    ('artisans (agents)', 'stones in the way')
    """
    said = not unit or re.search(rf"(?<!\w){re.escape(unit)}(?!\w)", name)
    return name if said else f"{name} ({unit})"


def value_name(value: Any) -> str:
    """Return a value of what varies as a figure writes it: a file or a folder by its name.

    >>> value_name(0.5), value_name(True), value_name("schemes/very_bold.yaml"), value_name(2000)
    ('0.5', 'true', 'very bold', '2,000')
    """
    if isinstance(value, str):
        path = Path(value)
        name = path.stem if path.suffix in (".yaml", ".yml", ".cogscheme") else path.name or value
        # A mind beside a model's own is called mind_NAME.
        return name.removeprefix("mind_").replace("_", " ") or name
    if isinstance(value, bool) or type(value).__name__ in ("bool", "bool_"):
        return str(bool(value)).lower()
    return f"{value:,.6g}" if abs(value) >= 1000 else f"{value:.6g}"


def word_name(word: str) -> str:
    """Return what a word of a scheme is called.

    >>> word_name("humans.influence.WheatNeed.GrowWheat"), word_name("start.Farmer")
    ('influence of WheatNeed on GrowWheat (humans)', 'Farmer at the start')
    """
    link, start = _LINK.search(word), _START.search(word)
    owner = word[: (link or start).start()].rstrip(".") if link or start else ""  # type: ignore[union-attr]
    if link:
        said = {
            "influence": "influence of {} on {}", "reinforcement": "reinforcement of {1} by {0}",
            "conditional": "condition {} of {}",
        }[link[1]].format(link[2], link[3])  # fmt: skip
        return f"{said} ({owner})" if owner else said
    if start:
        said = _STARTS[start[1]].format(start[2])
        return f"{said} ({owner})" if owner else said
    return word.replace("decision_maker.", "decision maker: ").replace("_", " ").replace(".", " ")
