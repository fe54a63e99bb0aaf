"""What notebooks show of things: rows as a table of HTML."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape


def as_html(rows: Sequence[Sequence[object]]) -> str:
    """Return rows as a table of HTML, the first column as what they are called.

    >>> as_html([("seed", 3), ("model", "a < b")])
    '<table><tr><th>seed</th><td>3</td></tr><tr><th>model</th><td>a &lt; b</td></tr></table>'
    """
    lines = []
    for name, *cells in rows:
        texts = "".join(f"<td>{escape(str(cell))}</td>" for cell in cells)
        lines.append(f"<tr><th>{escape(str(name))}</th>{texts}</tr>")
    return f"<table>{''.join(lines)}</table>"
