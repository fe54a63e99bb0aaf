"""What an action becomes: a rule that does something, or one that asks something."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.names import identifier
from socialmind.metaciv.writing.sheet import Sheet


@dataclass
class Act:
    """A rule that does something.

    Attributes:
        names: what it may be called, the shortest first; longer ones where that is taken.
        doc: what it does, one sentence.
        body: its lines.
        stays: whether it returns if it is done, and goes on else.
    """

    names: tuple[str, ...]
    doc: str
    body: list[str]
    stays: bool = False


@dataclass
class Ask:
    """A rule that asks something.

    Attributes:
        names: as of an act.
        doc: what it asks, "whether …".
        test: an expression.
        before: lines that come before it, where one expression does not do.
    """

    names: tuple[str, ...]
    doc: str
    test: str
    before: tuple[str, ...] = ()


Writer = Callable[[Sheet, Action], Act | Ask]

COMPARISONS = {
    ">": ("above", "more than"),
    ">=": ("at_least", "at least"),
    "==": ("is", "exactly"),
    "<=": ("at_most", "at most"),
    "<": ("below", "less than"),
}
"""How a comparison is called in names, and in sentences."""


def in_name(text: str) -> str:
    """Return a number, or a parameter, as part of a name.

    >>> in_name("-0.5"), in_name("12"), in_name("model.meal")
    ('minus_0_5', '12', 'meal')
    """
    text = text.removeprefix("int(").removesuffix(")").removeprefix("model.")
    if text.startswith("-"):
        return f"minus_{in_name(text[1:])}"
    return text.replace(".", "_").replace("+", "").replace("-", "_")


def in_doc(text: str) -> str:
    """Return a number, or a parameter, as part of a sentence."""
    bare = text.removeprefix("int(").removesuffix(")")
    return f"`{bare.removeprefix('model.')}`" if bare.startswith("model.") else text


def name_of(value: object) -> str:
    """Return a name of the files as part of one of ours."""
    return identifier(str(value))


def comparing(field: str, what: str, comparator: str, number: str, test: str) -> Ask:
    """Return the question whether something compares with a number.

    Args:
        field: how it is called in names.
        what: in sentences.
        comparator: as Python writes it.
        number: with what.
        test: the left side, an expression.
    """
    short, long = COMPARISONS[comparator]
    names = (f"{field}_{short}_{in_name(number)}",)
    return Ask(names, f"whether there is {long} {in_doc(number)} of {what}",
               f"{test} {comparator} {number}")  # fmt: skip


def as_text(name: str) -> str:
    """Return a name of the files as a text of Python."""
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def chosen(name: str, among: str, condition: str = "") -> list[str]:
    """Return the lines that choose somebody at random.

    Args:
        name: of the variable.
        among: whom to choose from, an expression.
        condition: which of them, about `one`; all if empty.
    """
    if not condition:
        return [f"{name} = {among}.one_of(rng)"]
    inner = f"one for one in {among} if {condition}"
    line = f"{name} = rng.choice({inner})"
    if len(line) + 4 <= 100:
        return [line]
    if len(inner) + 8 <= 100:
        return [f"{name} = rng.choice(", f"    {inner}", ")"]
    return [
        f"{name} = rng.choice(",
        "    one",
        f"    for one in {among}",
        f"    if {condition}",
        ")",
    ]
