"""Tables as plain text."""

from __future__ import annotations

from collections.abc import Collection, Sequence


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
