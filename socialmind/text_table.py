"""Tables as plain text, and as HTML for notebooks."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from html import escape


def aligned(rows: Sequence[Sequence[str]], right: Collection[int] = ()) -> list[str]:
    r"""Return the rows of a table as lines with straight columns.

    Args:
        rows: all of the same length.
        right: the columns, counted from 0, whose texts stand at the right.

    >>> print(*aligned([("skill", "weights"), ("Seek", "12")], right=[1]), sep="\n")
    skill  weights
    Seek        12
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            text.rjust(width) if column in right else text.ljust(width)
            for column, (text, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


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
