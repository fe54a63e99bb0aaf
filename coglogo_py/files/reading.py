"""Reading text files that a user gives: whatever they are, one line says what is wrong."""

from __future__ import annotations

import codecs
import stat
from pathlib import Path

from coglogo_py.border.errors import SchemeError

MOST_BYTES = 4_000_000
"""Length of a file; beyond this it is none that anybody wrote."""
_MARKS = {
    codecs.BOM_UTF32_LE: "UTF-32",  # before UTF-16, whose mark it begins with
    codecs.BOM_UTF32_BE: "UTF-32",
    codecs.BOM_UTF16_LE: "UTF-16",
    codecs.BOM_UTF16_BE: "UTF-16",
}
_REMEDY = "save it as UTF-8 (Save as …, Encoding: UTF-8, in most editors)"


def text_in(path: Path, most: int = MOST_BYTES, latin_1: bool = False) -> str:
    """Return a file's text, which is UTF-8 with or without a byte order mark.

    Args:
        path: the file.
        most: bytes that it may have.
        latin_1: take what is no UTF-8 for Latin-1, in which old editors wrote.

    Raises:
        SchemeError: there is no such file, it cannot be read, it is too large or in another
            encoding.
    """
    return text_of(content_of(path, most), path, latin_1)


def text_of(content: bytes, path: Path, latin_1: bool = False) -> str:
    """Return what a file's bytes say; arguments and errors as of `text_in`."""
    for mark, encoding in _MARKS.items():
        if content.startswith(mark):
            raise SchemeError(f"text in {encoding}", "text in UTF-8", _REMEDY, path, 1)
    zero = content.find(b"\0")
    if zero >= 0:
        line = content.count(b"\n", 0, zero) + 1
        halves = len(content) > 3 and 2 * content.count(b"\0") > 0.6 * len(content)
        if halves:
            raise SchemeError("what looks like UTF-16", "text in UTF-8", _REMEDY, path, line)
        raise SchemeError(
            "a byte 0, a control character", "text", "take it out; is it a text file in UTF-8?",
            path, line,
        )  # fmt: skip
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if latin_1:
            return content.decode("latin-1")
        raise SchemeError(
            f"the byte 0x{content[error.start]:02x}, as in Latin-1 or Windows-1252",
            "text in UTF-8",
            _REMEDY,
            path,
            content.count(b"\n", 0, error.start) + 1,
        ) from None


def content_of(path: Path, most: int = MOST_BYTES) -> bytes:
    """Return the bytes of a regular file: others, such as pipes, may never end.

    Raises:
        SchemeError: there is no such file, it cannot be read, or it is too large.
    """
    try:
        found = path.stat()
        mode, content = found.st_mode, b""
        if stat.S_ISREG(mode):
            with path.open("rb") as file:
                # Room for as much as there is: that for the most would take longer than to read.
                content = file.read(min(found.st_size, most) + 1)
                if len(content) > found.st_size:  # it has grown since
                    content += file.read(max(most + 1 - len(content), 0))
    except (OSError, ValueError) as error:  # ValueError: a null character in its name
        reason = getattr(error, "strerror", None) or error
        raise SchemeError(
            f"the file cannot be read ({reason})",
            remedy="check its name and whether you may read it",
            file=path,
        ) from None
    if not stat.S_ISREG(mode):
        kind = "a folder" if stat.S_ISDIR(mode) else "a device or pipe"
        raise SchemeError(f"the file cannot be read (it is {kind})", None, "give a file", path)
    if len(content) > most:
        raise SchemeError(
            f"more than {most // 1_000_000} MB", f"a file of at most {most // 1_000_000} MB",
            "is it the right file?", path,
        )  # fmt: skip
    return content
