"""What happens, as an ODD document shows it: the schedule, the setup, and the rules one by one."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.documents.markdown import table
from socialmind.documents.odd import docstrings
from socialmind.documents.odd.entities import NONE, Gap
from socialmind.language.plans import PlanTree

if TYPE_CHECKING:
    from socialmind.language.program import Program
    from socialmind.language.shape import PhaseShape
    from socialmind.model import Model

LIBRARY = "socialmind.economy"
"""Rooms of the library whose functions are submodels of the models that call them."""


def phases(shapes: Iterable[PhaseShape]) -> str:
    """Return phases as a table, in order."""
    rows = []
    for number, phase in enumerate(shapes, 1):
        order = "once" if phase.population is None else "order of birth"
        if phase.population is not None and phase.shuffled:
            order = "random, drawn anew"
        who = f"each of `{phase.population}`" if phase.population else "the model"
        name = phase.rule.__name__
        rows.append((str(number), who, order, f"*{name}*", docstrings.said(phase.rule)))
    return table(("step", "who", "in which order", "rule", "what it does"), rows)


def schedule(model: type[Model], program: Program) -> str:
    """Return a tick as a table, and what is alike in all models."""
    parts = []
    if model.schedule:
        parts = ["Each tick:", phases(model.shape.schedule)]
    alike = (
        "Time goes in ticks. Within a step agents act one after another, and each sees what those "
        "before it have done; state variables change at once."
    )
    if program.eventful:
        alike += " Who is born in a tick acts from the next one on, and who has died acts no more."
    alike += f" A run has {model.ticks:,} ticks unless it is told otherwise"
    endings = [f"*{name}*" for name in model.interruptions]
    if endings:
        alike += f"; it may end before by {' or '.join(endings)}"
    from socialmind.model import Model as Base

    if model.stop_when is not Base.stop_when:
        reason = docstrings.said(model.stop_when)
        alike += f"; it ends before where `stop_when` says so ({reason.removesuffix('.')})"
    parts.append(alike + ".")
    return "\n\n".join(parts)


def setup(model: type[Model]) -> str:
    """Return the setup as a table, with what agents do as they come into being."""
    parts = []
    if model.setup:
        parts += ["Before the first tick:", phases(model.shape.setup)]
    for name, one in model.shape.populations.items():
        if one.at_birth is not None:
            what = docstrings.said(one.at_birth)
            parts.append(
                f"Each of `{name}` follows *{one.at_birth.__name__}* as it comes into being: {what}"
            )
    return "\n\n".join(parts)


def rules(model: type[Model], program: Program, gap: Gap) -> str:
    """Return all rules that a model follows as a table, with what their docstrings say."""
    rows = []
    for function, used in _in_order(model, program):
        what = docstrings.said(function)
        if not what:
            gap(f"a docstring of the rule {function.__name__}")
        rows.append((f"*{function.__name__}*", used, _file(model, function), what))
    return table(("rule", "used", "in", "what it does"), rows)


def _in_order(model: type[Model], program: Program) -> Iterator[tuple[Callable[..., Any], str]]:
    """Yield the functions of a model: setup, schedule, plans, devices, and what these call."""
    shape = model.shape
    entries: dict[Callable[..., Any], list[str]] = {}
    for word, some in (("setup", shape.setup), ("tick", shape.schedule)):
        for phase in some:
            entries.setdefault(phase.rule, []).append(f"{word}, {phase.population or 'once'}")
    for name, one in shape.populations.items():
        for plan, tree in one.plans.items():
            for rule in _actions(tree):
                entries.setdefault(rule, []).append(f"plan {plan} of {name}")
        if one.at_birth is not None:
            entries.setdefault(one.at_birth, []).append(f"birth, {name}")
    for source in program.sources:
        if _belongs(model, source.function):
            entries.setdefault(source.function, [])
    for function, used in entries.items():
        yield function, "; ".join(dict.fromkeys(used)) or NONE


def _actions(tree: Any) -> Iterator[Callable[..., Any]]:
    """Yield the rules of a plan: one, or those of a tree and of its conditions."""
    if isinstance(tree, PlanTree):
        for part in (getattr(tree, "condition", None), *tree.parts):
            if part is not None:
                yield from _actions(part)
    else:
        yield tree


def _belongs(model: type[Model], function: Callable[..., Any]) -> bool:
    """Whether a function is a submodel: of the model's files, or a part that the library lends."""
    if function.__module__.startswith(LIBRARY):
        return True
    if function.__module__.partition(".")[0] in ("socialmind", "coglogo_py"):
        return False
    file = getattr(sys.modules.get(function.__module__), "__file__", None)
    return file is not None


def _file(model: type[Model], function: Callable[..., Any]) -> str:
    """Return the file of a function as a reader of the model's folder finds it."""
    file = Path(function.__code__.co_filename)
    folder = model.folder()
    if file.parent == folder:
        return f"`{file.name}`"
    if function.__module__.startswith(LIBRARY):
        return f"`{LIBRARY}`"
    return f"`{file.parent.name}/{file.name}`"
