"""The log of a fit: a line for each trial that is whole. It is what a fit that goes on knows."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError

FILE = "log.jsonl"
Key = tuple[int, str, int]
"""The search, why runs were made, and the number of the trial."""


class Log:
    """Lines of JSON that are added one after another.

    Args:
        folder: the fit's.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE

    def read(self) -> dict[Key, dict[str, Any]]:
        """Return all lines; one that was cut off by the end of the program is taken away.

        Raises:
            SocialmindError: a line is none of a log.
        """
        if not self.path.exists():
            return {}
        content = self.path.read_bytes()
        whole = content[: content.rfind(b"\n") + 1]
        if len(whole) < len(content):
            os.truncate(self.path, len(whole))
        found = {}
        for number, line in enumerate(whole.splitlines()):
            try:
                record = json.loads(line)
                found[record["search"], record["kind"], record["number"]] = record
            except (ValueError, KeyError, TypeError):
                raise SocialmindError(
                    f"{self.path}:{number + 1}: not a line of a fit's log; take it from a copy of "
                    "the folder, or start another fit"
                ) from None
        return found

    def add(self, record: dict[str, Any]) -> None:
        """Add a line."""
        line = json.dumps(record, ensure_ascii=False).encode() + b"\n"
        with self.path.open("ab") as file:
            file.write(line)

    def clear(self) -> None:
        """Take the file away."""
        self.path.unlink(missing_ok=True)
