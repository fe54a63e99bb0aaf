"""Values of a YAML file, read from its nodes so that every error names the line and the field.

Names are taken as they are written (one may be `no` or `10`), values are of the kind that the field
asks for and not of one that YAML guesses, and no name stands twice in a mapping.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from coglogo_py.border.errors import SchemeError, nearest, shortened, shown

NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
WHOLE_NUMBER = re.compile(r"[+-]?[0-9]{1,15}")
COLOUR = re.compile(r"#[0-9a-fA-F]{6}")
TRUTH = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
NOTHING = yaml.ScalarNode("tag:yaml.org,2002:null", "")
"""What stands where a field is left out."""


MOST_NODES = 200_000
"""Names, values, lists and mappings of a file; what an alias stands for counts each time."""
MOST_DEPTH = 50
"""Lists and mappings within each other."""


class _Loader(yaml.SafeLoader):
    """Composes nodes, and stops where there are more than anybody writes."""

    def __init__(self, text: str, file: str | Path) -> None:
        super().__init__(text)
        self.file = file
        self.depth = 0
        self.count = 0
        self.sizes: dict[str, int] = {}
        """How many nodes each finished anchor stands for."""

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        event = self.peek_event()
        line = event.start_mark.line + 1
        before = self.count
        self.depth += 1
        if self.depth > MOST_DEPTH:
            raise SchemeError(
                f"brackets or indents {MOST_DEPTH} deep", "YAML", "close the brackets",
                self.file, line,
            )  # fmt: skip
        if isinstance(event, yaml.AliasEvent) and event.anchor in self.anchors:
            if event.anchor not in self.sizes:
                raise SchemeError(
                    f"the alias *{shown(event.anchor)[1:-1]}, within what it stands for",
                    "a name or value of its own",
                    "write it out", self.file, line,
                )  # fmt: skip
            self.count += self.sizes[event.anchor]
        else:
            self.count += 1
        if self.count > MOST_NODES:
            raise SchemeError(
                f"more than {MOST_NODES:,} names and values, aliases written out",
                f"at most {MOST_NODES:,} in a file", "is it the right file?", self.file, line,
            )  # fmt: skip
        node: yaml.Node | None = super().compose_node(parent, index)
        self.depth -= 1
        if not isinstance(event, yaml.AliasEvent) and event.anchor is not None:
            self.sizes[event.anchor] = self.count - before
        return node


def composed(text: str, file: str | Path, what: str = "a cognitive scheme") -> yaml.Node:
    """Return the root node of a YAML text.

    Args:
        text: the file's content.
        file: its path, for messages.
        what: what the text should describe, for messages.

    Raises:
        SchemeError: the text is empty, or no YAML.
    """
    try:
        root = _Loader(text, file).get_single_node()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        remedy = "check quotes, brackets and indentation"
        if mark is not None and "\t" in "".join(text.split("\n")[mark.line : mark.line + 1]):
            remedy = "indent with spaces; YAML takes no tabs"
        line = None if mark is None else mark.line + 1
        raise SchemeError(
            f"text that is not YAML ({error.problem})", "YAML", remedy, file, line
        ) from None
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise SchemeError(
            "a control character", "text", "write it as an escape, in quotes", file, line
        ) from None
    if root is None:
        raise SchemeError("an empty file", what, "begin with name:", file, 1)
    return root


@dataclass(frozen=True)
class Nodes:
    """Reads the nodes of one file; `where` in its functions names the field for messages."""

    file: str | Path

    def wrong(
        self, node: yaml.Node, where: str, expected: str, remedy: str | None = None
    ) -> SchemeError:
        """Return the error that a node is not what is expected."""
        found = "several values" if isinstance(node, yaml.SequenceNode) else "fields"
        if isinstance(node, yaml.ScalarNode):
            found = "nothing" if self.is_nothing(node) else shown(node.value)
        return self.error(node, f"{found} as {where}", expected, remedy)

    def error(
        self, node: yaml.Node, found: str, expected: str | None = None, remedy: str | None = None
    ) -> SchemeError:
        """Return an error at the line of a node."""
        return SchemeError(found, expected, remedy, self.file, node.start_mark.line + 1)

    @staticmethod
    def is_nothing(node: yaml.Node) -> bool:
        """Whether nothing, or null, stands there."""
        return isinstance(node, yaml.ScalarNode) and node.tag.endswith(":null")

    @staticmethod
    def is_plain(node: yaml.Node) -> bool:
        """Whether a single value without quotes stands there."""
        return isinstance(node, yaml.ScalarNode) and node.style is None

    def name(self, node: yaml.Node, where: str) -> str:
        """Return a name, exactly as it is written."""
        if not isinstance(node, yaml.ScalarNode) or (node.value == "" and self.is_plain(node)):
            raise self.wrong(node, where, "a name")
        return str(node.value)

    def entries(self, node: yaml.Node, where: str) -> Iterator[tuple[str, yaml.Node, yaml.Node]]:
        """Yield each name in a mapping, with its node and that of its value."""
        if self.is_nothing(node):
            return
        if not isinstance(node, yaml.MappingNode):
            raise self.wrong(node, where, "name: value", "write one name: value a line, indented")
        lines: dict[str, int] = {}
        for key, value in node.value:
            if key.tag.endswith(":merge"):
                raise self.error(key, f"'<<' in {where}", "a name", "write the merged fields out")
            name = self.name(key, f"a name in {where}")
            if name in lines:
                raise self.error(
                    key,
                    f"{shown(name)} stands twice in {where}, first in line {lines[name]}",
                    remedy="rename one or join them",
                )
            lines[name] = key.start_mark.line + 1
            yield name, key, value

    def fields(self, node: yaml.Node, where: str, known: Collection[str]) -> dict[str, yaml.Node]:
        """Return the fields that stand in a mapping, all of them known ones."""
        found = {}
        for name, key, value in self.entries(node, where):
            if name not in known:
                raise self.error(
                    key, f"field {shown(name)} in {where}", f"one of {', '.join(known)}",
                    nearest(name, known),
                )  # fmt: skip
            found[name] = value
        return found

    def items(self, node: yaml.Node, where: str) -> list[yaml.Node]:
        """Return the nodes of a list; of nothing, none."""
        if self.is_nothing(node):
            return []
        if not isinstance(node, yaml.SequenceNode):
            one = isinstance(node, yaml.ScalarNode)
            raise self.wrong(
                node,
                where,
                "a list",
                f"write [{shortened(node.value, 40)}]" if one else "write [one, two]",
            )
        return list(node.value)

    def names(self, node: yaml.Node, where: str) -> tuple[str, ...]:
        """Return the names in a list, each of which stands there once."""
        lines: dict[str, int] = {}
        for item in self.items(node, where):
            name = self.name(item, f"a name in {where}")
            if name in lines:
                raise self.error(
                    item, f"{shown(name)} stands twice in {where}", remedy="remove one"
                )
            lines[name] = item.start_mark.line + 1
        return tuple(lines)

    def number(self, node: yaml.Node, where: str) -> float:
        """Return a finite number."""
        if not self.is_plain(node) or not NUMBER.fullmatch(node.value):
            quoted = isinstance(node, yaml.ScalarNode) and NUMBER.fullmatch(node.value)
            raise self.wrong(
                node,
                where,
                "a number",
                "remove the quotes" if quoted else "write it with a point, as 0.5 or 1e-3",
            )
        number = float(node.value)
        if not math.isfinite(number):
            raise self.wrong(node, where, "a number under 1.8e308")
        return number

    def truth(self, node: yaml.Node, where: str) -> bool:
        """Return True or False; yes, no, on and off will do."""
        if not self.is_plain(node) or node.value.lower() not in TRUTH:
            raise self.wrong(node, where, "true or false", "write it without quotes")
        return TRUTH[node.value.lower()]

    def colour(self, node: yaml.Node, where: str) -> tuple[int, int, int]:
        """Return red, green and blue of a text such as '#ff8800'."""
        if not isinstance(node, yaml.ScalarNode) or not COLOUR.fullmatch(node.value):
            raise self.wrong(
                node,
                where,
                "a colour such as '#ff8800'",
                "keep the quotes: without them # begins a comment",
            )
        rgb = int(node.value[1:], 16)
        return rgb >> 16, rgb >> 8 & 255, rgb & 255

    def position(self, node: yaml.Node, where: str) -> tuple[int, int]:
        """Return x and y of a list of two whole numbers."""
        parts = self.items(node, where)
        if len(parts) != 2:
            raise self.wrong(node, where, "two whole numbers", "write [97, -20]")
        for part in parts:
            if (
                not self.is_plain(part)
                or not WHOLE_NUMBER.fullmatch(part.value)
                or not -(2**31) <= int(part.value) < 2**31
            ):
                raise self.wrong(part, where, "a whole number of 32 bits", "write [97, -20]")
        return int(parts[0].value), int(parts[1].value)

    def weights(self, node: yaml.Node, where: str) -> dict[str, float]:
        """Return the plans and weights of links."""
        return {
            plan: self.number(value, f"{where} to {plan!r}")
            for plan, _, value in self.entries(node, where)
        }
