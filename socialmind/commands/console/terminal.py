"""What a terminal can show: characters that its encoding lacks, and paths that a shell takes."""

from __future__ import annotations

import codecs
import os
import shlex
import sys
import unicodedata
from io import TextIOWrapper
from pathlib import Path

PLAIN_ASCII = "plain_ascii"
PLAIN = {"…": "...", "–": "-", "—": "-", "−": "-", "·": "*", "×": "x", "≤": "<=", "≥": ">="} | {
    **{"“": '"', "”": '"', "’": "'", "→": "->", "√": "sqrt", "π": "pi", "æ": "ae", "ø": "o"},
    **{"ß": "ss", "ı": "i", "│": "|", "─": "-", "━": "-", "╸": "-", "╺": "-"},
}
"""What stands for a character where a terminal has no such one; others lose their accents."""


def open_what_is_closed() -> None:
    """Give input, output and messages that were closed before the start somewhere to go.

    Else the next file that is opened takes the number of the output, and what is meant for a
    reader is written into it.
    """
    for stream, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, stream) is None:
            number = os.open(os.devnull, os.O_RDWR)  # the lowest that is free
            os.set_inheritable(number, True)
            setattr(sys, stream, os.fdopen(number, mode, encoding="utf-8"))


def silence_what_is_broken() -> None:
    """Let streams whose reader has gone write nowhere; Python would complain at its own end."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def write_plainly() -> None:
    """Let what a terminal cannot show be written in characters that it has."""
    codecs.register_error("plainly", _plainly)
    codecs.register(_plain_ascii)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # Click takes an ASCII terminal for a mistake, and writes UTF-8 to it.
            ascii_only = codecs.lookup(stream.encoding).name == "ascii"
            stream.reconfigure(encoding=PLAIN_ASCII if ascii_only else None, errors="plainly")


def _plain_ascii(name: str) -> codecs.CodecInfo | None:
    """Give ASCII under another name; see `codecs.register`."""
    if name != PLAIN_ASCII:
        return None
    found = codecs.lookup("ascii")
    return codecs.CodecInfo(
        found.encode,
        found.decode,
        found.streamreader,
        found.streamwriter,
        found.incrementalencoder,
        found.incrementaldecoder,
        PLAIN_ASCII,
    )


def plain(text: str) -> str:
    """Return a text in ASCII.

    >>> plain("1 … 5 × 10⁶, Suró, 雪")
    '1 ... 5 x 106, Suro, ?'
    """
    return "".join(one if one.isascii() else _plain_character(one) for one in text)


def _plain_character(character: str) -> str:
    if character in PLAIN:
        return PLAIN[character]
    near = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return near or ("" if unicodedata.combining(character) else "?")


def _plainly(error: UnicodeError) -> tuple[str | bytes, int]:
    """Give what is written for characters that an encoding lacks; see `codecs.register_error`."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    if all("\udc80" <= one <= "\udcff" for one in lacking):
        # Bytes of a path that are no text in the file system's encoding go out as they came.
        return bytes(ord(one) - 0xDC00 for one in lacking), error.end
    return plain(lacking), error.end


def quoted(path: str | Path) -> str:
    """Return a path as a shell takes it for one word, and `socialmind` for a path.

    >>> quoted("runs/my model-001")
    "'runs/my model-001'"
    """
    text = str(path)
    return shlex.quote(f"./{text}" if text.startswith("-") else text)
