"""Text files of minds: lines of fields between colons, `#` before comments.

All the grammars of the thesis's appendix A are made of such lines. Blank lines and blanks around
fields count for nothing; lines end in LF, CR LF or CR.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath

from coglogo_py.border.errors import shown
from coglogo_py.files.reading import MOST_BYTES, text_in
from socialmind.errors import ModelError, of_model_file

NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?", re.A)
WHOLE_NUMBER = re.compile(r"[0-9]{1,9}", re.A)
MOST_GENOME = 200_000_000
"""Bytes of a file of weights, of which a skill may have some millions."""
BYTE_ORDER_MARK = "\ufeff"
CONTROL = re.compile(rf"[\x00-\x08\x0a-\x1f\x7f-\x9f{BYTE_ORDER_MARK}]")
"""Control characters, but for the tab."""


@dataclass(frozen=True)
class Line:
    """A line that says something.

    Attributes:
        text: the line without comment and blanks around it.
        number: its number in the file, from 1.

    >>> Line("SH: S1 :5", 7).fields
    ('SH', 'S1', '5')
    """

    text: str
    number: int

    @property
    def fields(self) -> tuple[str, ...]:
        """What stands between the colons."""
        return tuple(field.strip() for field in self.text.split(":"))


class Lines:
    r"""The lines of a file that say something, taken one after another.

    Args:
        text: the file's content.
        file: its path, for messages.

    Raises:
        ModelError: it holds control characters.

    >>> lines = Lines("Avoid  # turns away\n\ninput: 2\n", "Avoid.ades")
    >>> [line.text for line in lines.rest()]
    ['Avoid', 'input: 2']
    """

    def __init__(self, text: str, file: str | Path) -> None:
        self.file = str(file)
        # Not splitlines, which also splits at characters that a name may hold.
        text = text.removeprefix(BYTE_ORDER_MARK).replace("\r\n", "\n").replace("\r", "\n")
        whole = text.split("\n")
        self.lines: list[Line] = []
        for number, content in enumerate(whole, start=1):
            said = content.partition("#")[0].strip()
            self._check_characters(said, number)
            if said:
                self.lines.append(Line(said, number))
        self.last = max(len(whole) - (whole[-1] == ""), 1)
        self.taken = 0

    def _check_characters(self, said: str, number: int) -> None:
        control = CONTROL.search(said)
        if control is not None:
            raise self.error(
                f"the control character {control[0]!r}",
                "text",
                "take it out; is it a text file in UTF-8?",
                number,
            )

    @property
    def next(self) -> Line | None:
        """The line to be taken next; None at the end of the file."""
        return self.lines[self.taken] if self.taken < len(self.lines) else None

    def take(self, expected: str, remedy: str = "the file may have been cut off") -> Line:
        """Take the next line; `expected` and `remedy` say what is wrong when there is none."""
        line = self.next
        if line is None:
            raise self.unexpected(expected, remedy)
        self.taken += 1
        return line

    def keyword(self, expected: str, remedy: str, if_cut: str | None = None) -> Line:
        """Take the next line, which is to be this one.

        Args:
            expected: the line, blanks around its fields aside.
            remedy: what to do where it is another one.
            if_cut: what to do where the file ends.

        Raises:
            ModelError: so it is.
        """
        if self.next is None:
            raise self.unexpected(expected, if_cut or remedy)
        if self.next.fields != tuple(expected.split(":")):
            raise self.unexpected(expected, remedy)
        return self.take(expected)

    def put_back(self) -> None:
        """Make the line just taken the next one again."""
        self.taken -= 1

    def rest(self) -> list[Line]:
        """Take all lines that are left."""
        left = self.lines[self.taken :]
        self.taken = len(self.lines)
        return left

    def unexpected(self, expected: str, remedy: str | None = None) -> ModelError:
        """Return the error that the next line is not what is expected."""
        line = self.next
        if line is None:
            return self.error("the end of the file", expected, remedy, self.last)
        return self.error(shown(line.text), expected, remedy, line.number)

    def error(
        self, found: str, expected: str | None, remedy: str | None, line: int | None
    ) -> ModelError:
        """Return an error at a line of the file."""
        return ModelError(found, expected, remedy, self.file, line)

    @contextmanager
    def placing(self, line: int | None, remedy: str, where: str = "") -> Iterator[None]:
        """Make something of a line: what is wrong with it says where it stands and what to do.

        Args:
            line: of errors that name none.
            remedy: what to do about errors that do not say it.
            where: the place in words, for errors that do not know the file.
        """
        try:
            yield
        except ModelError as error:
            if error.file not in (None, self.file):
                raise
            found = error.found if error.file else f"{error.found} {where}".strip()
            place = error.line or line
            raise self.error(found, error.expected, error.remedy or remedy, place) from None

    def number(self, text: str, what: str, line: int) -> float:
        """Return a finite number."""
        if not NUMBER.fullmatch(text):
            raise self.error(
                f"{shown(text)} as {what}", "a number", "write it with a point, as 0.5", line
            )
        value = float(text)
        if value in (float("inf"), float("-inf")):
            raise self.error(f"{shown(text)} as {what}", "a number", "it is too large", line)
        return value

    def whole_number(self, text: str, what: str, line: int) -> int:
        """Return a whole number, 0 or more."""
        if not WHOLE_NUMBER.fullmatch(text):
            raise self.error(
                f"{shown(text)} as {what}",
                "a whole number, 0 or more",
                "write it in digits, as 2",
                line,
            )
        return int(text)


def text_of(path: Path, most: int = MOST_BYTES) -> str:
    """Return a file's text.

    Args:
        path: the file.
        most: bytes that it may have.

    Raises:
        ModelError: there is no such file, it is too large, or it is not text in UTF-8.
    """
    with of_model_file():
        return text_in(path, most)


def inside(
    folder: Path, written: str, what: str, named_in: str | Path, line: int | None = None
) -> Path:
    """Return the path that a file names, which may not lead out of a folder.

    Args:
        folder: the folder from which the path leads.
        written: the path, with `/` between its parts.
        what: what it is, in words.
        named_in: the file that names it, for messages.
        line: its line there.

    Raises:
        ModelError: it is absolute, names `..` or leads out by a link.
    """
    forms = PurePosixPath(written), PureWindowsPath(written)
    out = "\\" in written or any(one.anchor or ".." in one.parts for one in forms)
    path = folder / written
    try:
        out = out or not path.resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError):
        out = True  # links in a circle, or a name that no file can have
    if out:
        raise ModelError(
            f"{what} {shown(written)}, outside of {folder}",
            "a file within that folder, without '..' and links that lead out",
            "copy the file there",
            named_in,
            line,
        )
    return path


def is_file(path: Path) -> bool:
    """Whether there is a file of this name; none has a name that files cannot have."""
    try:
        return path.is_file()
    except (OSError, ValueError):  # too long, or with a null character
        return False


def write_text(path: Path, text: str) -> None:
    """Write a file in one step: whenever the process is killed, a whole one stands there.

    Raises:
        ModelError: the file cannot be written.
    """
    unfinished = path.with_name(path.name + ".partial")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with unfinished.open("wb") as file:
            file.write(text.encode("utf-8"))
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)
    except (OSError, UnicodeEncodeError) as error:
        reason = error.reason if isinstance(error, UnicodeEncodeError) else error.strerror
        raise ModelError(
            f"the file cannot be written ({reason or error})",
            remedy="check the folder and whether you may write there",
            file=path,
        ) from None


def one_line(text: str, what: str, barred: str = "#") -> str:
    """Return a text that a line can hold, or refuse it.

    Args:
        text: the text.
        what: what it is, in words.
        barred: the signs that it may not have.

    Raises:
        ModelError: a barred sign, a control character or blanks around it.

    >>> one_line("Minds/2026", "the root folder")
    'Minds/2026'
    """
    control = CONTROL.search(text) or "\t" in text
    if text != text.strip() or control or any(sign in text for sign in barred):
        signs = " and ".join(repr(sign) for sign in barred)
        raise ModelError(
            f"{shown(text)} as {what}",
            f"a text without {signs}, control characters and blanks around it",
            "change it",
        )
    return text


def field(text: str, what: str) -> str:
    """Return a text as a field between colons, or refuse it as `one_line` does."""
    return one_line(text, what, ":#")
