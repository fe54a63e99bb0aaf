"""Sums, means and extremes of a field in compiled code, as text."""

from __future__ import annotations

from socialmind.fields import Field

_TEXT = """@_inner
def NAME(_model):
    count = 0
    found = ZERO
    for row in ROWS:
        ALIVE
        value = VALUE
        FIND
        count += 1
    RETURN"""


def aggregate_name(population: str, what: str, field: str) -> str:
    """Return the name of the function that sums up a field of a population."""
    return f"_{what}_of_{population}_{field}"


def aggregate_text(name: str, what: str, field: Field, population: str | None) -> str:
    """Return the function that sums up a field of a population, or of the patches.

    `language.aggregates` has the interpreted twin.

    Args:
        name: the function's.
        what: one of `AGGREGATES`.
        field: the field.
        population: whose; None for the patches.
    """
    is_float = field.kind is float
    find = "found = found + value" if is_float else "found = _add_int(found, value)"
    if what in ("min", "max"):
        sign = "<" if what == "min" else ">"
        find = f"if count == 0 or value {sign} found:\n            found = value"
    fills = {
        "ROWS": "_patches(_model)",
        "ALIVE\n        ": "",
        "VALUE": "row.FIELD" if is_float else "_int64(row.FIELD)",
        "FIND": find,
        "ZERO": "0.0" if is_float else "_int64(0)",
        "RETURN": "return found / count" if what == "mean" else "return found",
    }
    if population is not None:
        fills["ROWS"] = "_order_POPULATION(_model)[: _entries_POPULATION(_model)]"
        fills["ALIVE\n        "] = (
            "if not _alive_POPULATION(_model)[row]:\n            continue\n        "
        )
        fills["VALUE"] = fills["VALUE"].replace("row.", "_rows_POPULATION(_model)[row].")
    if what != "sum":
        none = f"raise ValueError('{what}() of a population without agents')"
        fills["RETURN"] = f"if count == 0:\n        {none}\n    {fills['RETURN']}"
    text = _TEXT
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return (
        text.replace("POPULATION", population or "")
        .replace("FIELD", field.name)
        .replace("NAME", name)
    )
