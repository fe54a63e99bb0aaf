"""The files of a model's folder: which there are, read as lines `Key : value`.

Nothing outside the folder is read, also not by a link, and nothing but regular files of sane size.
"""

from __future__ import annotations

import os
import re
import stat
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from socialmind.metaciv.description import Place
from socialmind.metaciv.findings import Findings
from socialmind.sources.folders import spelled

SUFFIX = ".metaciv"
LARGEST_FILE = 2**20
"""Bytes of a file but a map."""
LARGEST_MAP = 16 * 2**20
"""Bytes; the largest map that is read needs about half of it."""
LONGEST_LINE = 20_000
"""Characters; a row of the widest map needs about half of it."""
MOST_FILES = 5_000
"""Files of one folder."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line `Key : value`.

    Args:
        number: from 1.
        tabs: before the key.
        key: up to the first ` : `.
        value: from there to the next ` : `.
        rest: from there to the end of the line, without blanks there.
    """

    number: int
    tabs: int
    key: str
    value: str
    rest: str


@dataclass(frozen=True, slots=True)
class Document:
    """A file's lines, but those without ` : `; its path is relative to the model's folder."""

    file: str
    lines: tuple[Line, ...]

    @property
    def stem(self) -> str:
        """The file's name without its suffix."""
        return self.file.rpartition("/")[2][: -len(SUFFIX)]

    def place(self, line: Line | None = None) -> Place:
        """Return where a line stands, or else the file's begin."""
        return Place(self.file, 1 if line is None else line.number)

    def all(self, *keys: str) -> list[Line]:
        """Return the lines with one of some keys that have a value."""
        return [one for one in self.lines if one.key in keys and one.tabs == 0 and one.value]

    def first(self, *keys: str) -> Line | None:
        """Return the first line with one of some keys and a value, None if there is none."""
        return next(iter(self.all(*keys)), None)


class Folder:
    """A model's folder.

    Args:
        root: the folder.
        findings: where to note what cannot be read.
    """

    def __init__(self, root: Path, findings: Findings) -> None:
        self.root = root.resolve()
        self.findings = findings

    def has(self, part: str) -> bool:
        """Return whether there is a folder below this one."""
        path = self._path(part)
        return self._inside(path) and path.is_dir()

    def folders(self, part: str) -> list[str]:
        """Return the names of the folders in a folder, sorted."""
        return [one for one in self._names(part) if (self._path(part) / one).is_dir()]

    def documents(self, part: str, largest: int = LARGEST_FILE) -> list[Document]:
        """Return the files of a folder, sorted by name; none where there is no such folder."""
        found = []
        for name in self._names(part):
            if name.lower().endswith(SUFFIX):
                document = self.document(f"{part}/{name}" if part else name, largest)
                found += [] if document is None else [document]
        return found

    def document(self, file: str, largest: int = LARGEST_FILE) -> Document | None:
        """Return a file, or None where there is none; says why if it cannot be read."""
        path = self._path(file)
        file = path.relative_to(self.root).as_posix()
        place = Place(displayed(file), 1)
        try:
            if not os.path.lexists(path):
                return None
            if not self._inside(path):
                self.findings.error(place, "a link that leads out of the model's folder")
                return None
            if not stat.S_ISREG(path.stat().st_mode):
                self.findings.warn(place, "this is no file", remedy="it was left out")
                return None
            with path.open("rb") as stream:
                content = stream.read(largest + 1)
        except (OSError, RuntimeError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else None
            self.findings.error(place, f"it cannot be read: {reason or type(error).__name__}")
            return None
        if len(content) > largest:
            found = f"a file of more than {largest // 2**20} MB"
            self.findings.error(place, found, "a smaller one")
            return None
        return self._parsed(displayed(file), content)

    def class_names(self, part: str) -> frozenset[str]:
        """Return the names of the Java classes below a folder; none of them is read."""
        found: set[str] = set()
        if self.has(part):
            for count, (_, _, files) in enumerate(os.walk(self._path(part))):
                found.update(one.removesuffix(".class") for one in files if one.endswith(".class"))
                if count > MOST_FILES:
                    break
        return frozenset(one for one in found if one.isidentifier())

    def _names(self, part: str) -> list[str]:
        """Return the names in a folder, sorted, without hidden ones."""
        path = self._path(part)
        if not self.has(part):
            return []
        try:
            names = sorted(one.name for one in path.iterdir() if not one.name.startswith("."))
        except OSError as error:
            self.findings.error(Place(displayed(part), 1), f"it cannot be read: {error.strerror}")
            return []
        if len(names) > MOST_FILES:
            found = f"a folder of {len(names)} files"
            self.findings.error(Place(displayed(part), 1), found, f"at most {MOST_FILES}")
        return names[:MOST_FILES]

    def _path(self, part: str) -> Path:
        """Return where a part of the folder is; one in other letter case where none is as asked."""
        path = self.root
        for name in PurePosixPath(part).parts:
            path = spelled(path / name) if self._inside(path) else path / name
        return path

    def _inside(self, path: Path) -> bool:
        try:
            return path.resolve().is_relative_to(self.root)
        except (OSError, RuntimeError, ValueError):
            return False

    def _parsed(self, file: str, content: bytes) -> Document:
        lines = []
        for number, text in enumerate(re.split("\r\n|\n|\r", self._text(file, content)), start=1):
            if len(text) > LONGEST_LINE:
                found = f"a line of {len(text)} characters"
                self.findings.error(Place(file, number), found, f"at most {LONGEST_LINE}")
                continue
            key, colon, rest = text.partition(" : ")
            if colon:
                bare, rest = key.lstrip("\t"), rest.rstrip()
                lines.append(Line(number, len(key) - len(bare), bare, rest.split(" : ")[0], rest))
        return Document(file, tuple(lines))

    def _text(self, file: str, content: bytes) -> str:
        try:
            return content.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = 1 + len(re.findall(b"\r\n|\n|\r", content[: error.start]))
            found = f"the byte 0x{content[error.start]:02x}"
            self.findings.warn(Place(file, line), found, "UTF-8", "the file was read as Latin-1")
            return content.decode("latin-1")


def displayed(name: str) -> str:
    r"""Return a path as it can be printed in a line.

    >>> displayed("a\nb")
    'a\\nb'
    """
    return "".join(one if one.isprintable() else ascii(one)[1:-1] for one in name)
