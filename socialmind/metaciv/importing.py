"""A folder of MetaCiv's, read and written as a model of ours, or refused with all that is wrong."""

from __future__ import annotations

import secrets
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from socialmind.errors import SocialmindError
from socialmind.metaciv.findings import Finding
from socialmind.metaciv.reading import read_folder
from socialmind.metaciv.writing import write_model
from socialmind.work.files import remove

WORDS = {
    "error": ("error", "errors"),
    "warning": ("warning", "warnings"),
    "unsupported": ("thing not supported", "things not supported"),
}
"""What findings are called, one and several."""


class ImportRefusedError(SocialmindError):
    """A folder of MetaCiv's that was not imported.

    Args:
        folder: the folder.
        findings: all that was found in it; one at least is no warning.
    """

    def __init__(self, folder: str, findings: Sequence[Finding]) -> None:
        self.folder, self.findings = folder, tuple(findings)
        stops = [one for one in findings if one.severity != "warning"]
        first = min(stops, key=lambda one: one.severity)  # an error, if there is one
        super().__init__(f"{folder}: {counted(findings)}; nothing was written; first {first}")

    def __reduce__(self) -> tuple[type[ImportRefusedError], tuple[object, ...]]:
        """Keep the fields when the error crosses a process boundary."""
        return type(self), (self.folder, self.findings)


def import_model(folder: str | Path, out: str | Path, strict: bool = False) -> tuple[Finding, ...]:
    """Read a model of MetaCiv's and write it as one of this toolkit.

    Args:
        folder: the folder with `parametres.metaciv`, of the format V2.0 or the older one.
        out: the folder to make; it may be there when it is empty.
        strict: refuse what is not supported, rather than write rules that do nothing.

    Returns:
        What was found odd: warnings, and what is not supported.

    Raises:
        ImportRefusedError: there are errors, which it lists all; nothing was written.
        SocialmindError: there is no such folder, or `out` holds something.
    """
    target = Path(out).expanduser().absolute()
    if target.is_dir() and any(target.iterdir()):
        raise SocialmindError(f"{out}: is not empty; give a fresh folder")
    if target.exists() and not target.is_dir():
        raise SocialmindError(f"{out}: is a file; give a folder")
    reading = read_folder(folder)
    if reading.model is None:
        raise ImportRefusedError(str(folder), reading.findings)
    target.parent.mkdir(parents=True, exist_ok=True)
    unfinished = target.parent / f".{target.name}-{secrets.token_hex(4)}.partial"
    try:
        said = {one.place for one in reading.findings if _is_left_out(one)}
        written = write_model(reading.model, unfinished)
        lacking = [Finding("unsupported", one.place, one.what) for one in written]
        findings = (*reading.findings, *(one for one in lacking if one.place not in said))
        _say_in_readme(unfinished / "README.md", reading.findings)
        if strict and any(map(_is_left_out, findings)):
            raise ImportRefusedError(str(folder), findings)
        if target.is_dir():  # it may be the current folder, which must stay the one it is
            for one in sorted(unfinished.iterdir()):
                one.rename(target / one.name)
        else:
            unfinished.rename(target)
    finally:
        remove(unfinished)
    return findings


def counted(findings: Sequence[Finding]) -> str:
    """Return how many findings there are of each severity, in words.

    >>> from socialmind.metaciv.description import Place
    >>> counted([Finding("error", Place("a.metaciv", 1), "x")] * 2)
    '2 errors'
    """
    counts = Counter[str](one.severity for one in findings)
    words = [f"{counts[one]} {WORDS[one][counts[one] > 1]}" for one in WORDS if counts[one]]
    return ", ".join(words) or "nothing odd"


def _say_in_readme(file: Path, findings: Sequence[Finding]) -> None:
    """Add to a model's README how what is odd in its files was read."""
    odd = [
        f"- `{one.place.file}:{one.place.line}`: {one.told}"
        for one in findings
        if one.severity == "warning"
    ]
    if odd:
        said = file.read_text("utf-8").rstrip("\n")
        lines = (said, "", "## What is odd in the files", "", *odd, "")
        file.write_text("\n".join(lines), "utf-8")


def _is_left_out(one: Finding) -> bool:
    return one.severity == "unsupported"
