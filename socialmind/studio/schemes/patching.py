"""A YAML text changed at some of its fields alone: all other bytes stay, comments too.

Round-trip libraries write a text anew from what they read: they mend indents and quotes that nobody
asked about, and keep a comment with the entry before it, whichever it speaks of. Here the places of
nodes in the text say what is cut out and what is put in.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Union

import yaml

from coglogo_py.files.yaml_nodes import composed
from coglogo_py.files.yaml_text import name_text
from socialmind.errors import SocialmindError

Value = Union[str, "dict[str, Value]"]
"""What is put in: a text on one line, or a mapping of several."""


@dataclass
class Items:
    """What a list of names is to be.

    Attributes:
        names: all of them, in order.
        renamed: those that stand there under another name, by that.
    """

    names: list[str]
    renamed: Mapping[str, str] = field(default_factory=dict)


@dataclass
class Patch:
    """What is to become of a mapping; names are those that stand there.

    Attributes:
        renamed: new names by old.
        inner: what is to become of values.
        removed: entries that go.
        added: entries that come; behind all others, unless `order` says before which.
        order: names in the order in which entries are to stand.
    """

    renamed: dict[str, str] = field(default_factory=dict)
    inner: dict[str, Patch | Items | str] = field(default_factory=dict)
    removed: set[str] = field(default_factory=set)
    added: dict[str, Value] = field(default_factory=dict)
    order: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.renamed or self.inner or self.removed or self.added)


def patched(text: str, patch: Patch) -> str:
    """Return a text with the mapping that it holds changed.

    Args:
        text: YAML, its lines ending in LF.
        patch: of the mapping that the whole text is.

    Raises:
        SocialmindError: the text repeats parts of itself by anchors; which are meant is not known.

    >>> text = "a: 1  # one" + chr(10) + "b: {c: 2}" + chr(10)
    >>> print(patched(text, Patch(inner={"a": "5", "b": Patch(added={"d": "3"})})), end="")
    a: 5  # one
    b: {c: 2, d: 3}
    """
    if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text)):
        raise SocialmindError("the file repeats parts of itself (*name)")
    cutting = _Cutting(text)
    cutting.mapping(composed(text, "text"), patch)
    return cutting.done()


def entries(node: yaml.Node | None) -> dict[str, yaml.Node]:
    """Return the values of a mapping by their names; none of nothing."""
    if not isinstance(node, yaml.MappingNode):
        return {}
    return {key.value: value for key, value in node.value}


class _Cutting:
    """Where a text is cut, and what is put in there."""

    def __init__(self, text: str) -> None:
        self.text = text if text.endswith("\n") else text + "\n"
        self.cuts: list[tuple[int, int, str]] = []

    def done(self) -> str:
        """Return the text as it is then."""
        pieces, at = [], 0
        for start, end, new in sorted(self.cuts, key=lambda cut: cut[:2]):
            pieces += [self.text[at:start], new]
            at = max(at, end)
        return "".join((*pieces, self.text[at:]))

    def mapping(self, node: yaml.Node, patch: Patch) -> None:
        """Change a mapping, or put one in place of nothing."""
        if not patch:
            return
        if isinstance(node, yaml.MappingNode) and not node.flow_style:
            self._block(node, patch)
        else:
            self.cuts.append((*_span(node), self._flow(node, patch)))

    def _block(self, node: yaml.MappingNode, patch: Patch) -> None:
        for key, value in node.value:
            name = key.value
            if name in patch.removed:
                self._cut(key, value)
                continue
            if name in patch.renamed:
                self.cuts.append((*_span(key), name_text(patch.renamed[name])))
            if name in patch.inner:
                self._value(key, value, patch.inner[name])
        for name, added in patch.added.items():
            later = patch.order[patch.order.index(name) + 1 :] if name in patch.order else ()
            behind = next((key for key, _ in node.value if key.value in later), None)
            indent = node.value[0][0].start_mark.column
            lines = _lines(name, added, indent)
            if behind is not None:
                at = self._begin(behind)
            else:
                at = self._end(node.value[-1][1])
                lines = self._apart(node) + lines
            self.cuts.append((at, at, lines))

    def _value(self, key: yaml.Node, value: yaml.Node, change: Patch | Items | str) -> None:
        if isinstance(change, Patch):
            if not change:
                return
            nothing = not (isinstance(value, yaml.MappingNode) and value.value)
            if nothing and change.added:
                # What was nothing becomes a mapping on lines of its own.
                start, end = key.end_mark.index + 1, _span(value)[1]
                self.cuts.append((start, max(start, end), ""))
                at = self._end(value)
                indent = key.start_mark.column + 2
                lines = "".join(_lines(n, one, indent) for n, one in change.added.items())
                self.cuts.append((at, at, lines))
            else:
                self.mapping(value, change)
        elif isinstance(change, Items) and isinstance(value, yaml.SequenceNode):
            self._items(value, change)
        else:
            text = change if isinstance(change, str) else _flow_list(change.names)
            start = key.end_mark.index + 1
            if isinstance(value, yaml.CollectionNode) and not value.flow_style:
                self.cuts.append((start, self._end(value), f" {text}\n"))
            elif _span(value)[0] == _span(value)[1]:
                self.cuts.append((start, start, f" {text}"))
            else:
                self.cuts.append((*_span(value), text))

    def _items(self, node: yaml.SequenceNode, items: Items) -> None:
        kept = {items.renamed.get(one.value, one.value): one for one in node.value}
        if node.flow_style or not node.value:
            texts = [
                self._raw(kept[name])
                if name in kept and kept[name].value == name
                else name_text(name)
                for name in items.names
            ]
            self.cuts.append((*_span(node), f"[{', '.join(texts)}]"))
            return
        first = node.value[0]
        line = self.text.rfind("\n", 0, first.start_mark.index) + 1
        dash = self.text[line : first.start_mark.index]
        staying = [name for name in kept if name in items.names]
        same = items.names[: len(staying)] == staying
        for name, one in kept.items():
            if not same or name not in items.names:
                self._cut(one, one)
            elif one.value != name:
                self.cuts.append((*_span(one), name_text(name)))
        at = self._end(node.value[-1])
        new = items.names[len(staying) :] if same else items.names
        lines = "".join(f"{dash}{name_text(name)}\n" for name in new)
        self.cuts.append((at, at, lines))

    def _flow(self, node: yaml.Node, patch: Patch) -> str:
        found = []
        for key, value in node.value if isinstance(node, yaml.MappingNode) else []:
            name = key.value
            if name in patch.removed:
                continue
            title = name_text(patch.renamed[name]) if name in patch.renamed else self._raw(key)
            change = patch.inner.get(name)
            if change is None:
                text = self._raw(value)
            elif isinstance(change, Patch):
                text = self._flow(value, change)
            else:
                text = change if isinstance(change, str) else _flow_list(change.names)
            found.append(f"{title}: {text}".rstrip())
        found += [_pair(name, one) for name, one in patch.added.items()]
        return f"{{{', '.join(found)}}}"

    def _raw(self, node: yaml.Node) -> str:
        start, end = _span(node)
        return self.text[start:end]

    def _cut(self, key: yaml.Node, value: yaml.Node) -> None:
        """Let the lines of an entry go; of two empty lines around it, one."""
        start, end = self._begin(key), self._end(value)
        around = self.text[:start].endswith("\n\n") and self.text[end : end + 1] in ("\n", "")
        self.cuts.append((start - around, end, ""))

    def _begin(self, node: yaml.Node) -> int:
        """Return where the lines of an entry begin: with the comment right above it."""
        start = self.text.rfind("\n", 0, node.start_mark.index) + 1
        while start:
            before = self.text.rfind("\n", 0, start - 1) + 1
            if not self.text[before:start].lstrip().startswith("#"):
                break
            start = before
        return start

    def _end(self, node: yaml.Node) -> int:
        """Return where the line ends on which a value ends."""
        at = _last(node)
        return self.text.find("\n", at) + 1 or len(self.text)

    def _apart(self, node: yaml.MappingNode) -> str:
        """Return the empty line that parts the last two entries, if one does."""
        if len(node.value) < 2:
            return ""
        between = self.text[self._end(node.value[-2][1]) : self._begin(node.value[-1][0])]
        return "\n" if "\n" in between else ""


def _span(node: yaml.Node) -> tuple[int, int]:
    return node.start_mark.index, node.end_mark.index


def _last(node: yaml.Node) -> int:
    """Return the place behind the last character of a node."""
    if isinstance(node, yaml.MappingNode) and not node.flow_style:
        return max(_last(part) for part in node.value[-1])
    if isinstance(node, yaml.SequenceNode) and not node.flow_style:
        return _last(node.value[-1])
    if isinstance(node, yaml.ScalarNode) and node.style in ("|", ">"):
        return int(node.end_mark.index) - 1
    return int(node.end_mark.index)


def _lines(name: str, value: Value, indent: int) -> str:
    return "".join(f"{line}\n" for line in _block_lines(name, value, " " * indent))


def _block_lines(name: str, value: Value, indent: str) -> Iterator[str]:
    title = f"{indent}{name_text(name)}:"
    if isinstance(value, str):
        yield f"{title} {value}".rstrip()
        return
    yield title
    for inner, one in value.items():
        yield from _block_lines(inner, one, indent + "  ")


def _flow_value(value: Value) -> str:
    if isinstance(value, str):
        return value
    return f"{{{', '.join(_pair(name, one) for name, one in value.items())}}}"


def _pair(name: str, value: Value) -> str:
    return f"{name_text(name)}: {_flow_value(value)}".rstrip()


def _flow_list(names: list[str]) -> str:
    return f"[{', '.join(map(name_text, names))}]"
