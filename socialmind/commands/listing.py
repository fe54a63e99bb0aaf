"""`socialmind list`: the models, and what one of them is made of."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.sources.folders import catalogue, model_folder
from socialmind.text_table import aligned

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.society.population import Population


def print_models() -> bool:
    """Print every model with its parameters; False when one of them cannot be loaded."""
    good = True
    for position, name in enumerate(catalogue()):
        if position:
            typer.echo()
        try:
            typer.echo(description(name, load_model(name)))
        except SocialmindError as error:
            typer.echo(f"socialmind: {error}", err=True)
            good = False
    return good


def print_model(name: str) -> None:
    """Print one model: parameters, populations, what it measures and learns.

    Args:
        name: its name, or its folder.

    Raises:
        SocialmindError: there is no such model, or it cannot be loaded.
    """
    folder, model_class = model_folder(name), load_model(name)
    typer.echo(description(folder.name, model_class))
    rows = [_population(one) for one in model_class.populations.values()]
    lines = [("population", "size", "agents", "mind", "fields"), *rows]
    tables = [indented(lines)] if rows else []
    facts = [
        ("variables", ", ".join(model_class.shape.variables)),
        ("world", _world(model_class)),
        ("networks", ", ".join(map(str, model_class.networks.values()))),
    ]
    if model_class.shape.world.has_episodes:
        from socialmind.experiments.scoring import measures_of

        facts.append(("measures", ", ".join(measures_of(model_class))))
    facts += [*_taught(folder), ("folder", str(folder))]
    tables.append(indented([fact for fact in facts if fact[1]]))
    for table in tables:
        typer.echo("\n".join(["", *table]))


def _population(one: Population) -> tuple[str, ...]:
    minds = []
    if one.mind is not None:
        minds.append(f"scheme {_called(one.mind)}")
    if one.hierarchy is not None:
        minds.append(f"skills {_called(one.hierarchy)}")
    fields = [name for name in one.shape.fields if name not in ("x", "y", "heading")]
    size = " + ".join(map(str, one.sizes))
    if one.table is not None:
        size = one.table if isinstance(one.table, str) else "a table"
    return one.name, size, one.agent.__name__, ", ".join(minds), ", ".join(fields)


def _called(mind: Any) -> str:
    return str(mind) if isinstance(mind, str | Path) else str(getattr(mind, "name", ""))


def _world(model_class: type[Model]) -> str:
    world = getattr(model_class, "world", None)
    return "" if world is None else str(world)


def _taught(folder: Path) -> list[tuple[str, str]]:
    """Return the curricula of a model's folder, where they have names, and the first one's lessons.

    `--lesson` of `socialmind learn` takes all of these names.
    """
    from socialmind.learning.training.course import can_be_taught, curricula_of, curriculum_of

    if not can_be_taught(folder):
        return []
    names = [name for name in curricula_of(folder) if name]
    curriculum, _ = curriculum_of(folder)
    lessons = dict.fromkeys(lesson.name for lesson in curriculum.lessons)
    if not names:
        return [("lessons", ", ".join(lessons))]
    return [("curricula", ", ".join(names)), (f"of {names[0]}", "; ".join(lessons))]


def description(name: str, model_class: type[Model]) -> str:
    """A model's name, what it is, and its parameters with default, unit and range."""
    about = (inspect.getdoc(model_class) or "").partition("\n")[0]
    lines = [f"{name}: {about}" if about else name]
    rows = [
        (p.name, _written(p.default), p.unit, p.range, p.doc)
        for p in model_class.parameters.values()
    ]
    if rows:
        lines += indented([("parameter", "default", "unit", "range", ""), *rows])
    return "\n".join(lines)


def indented(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the rows of a table as lines that stand below a heading."""
    return [f"  {line}" for line in aligned(rows)]


def _written(value: float | int | bool | str) -> str:
    if isinstance(value, str):
        return value
    return str(value).lower() if isinstance(value, bool) else f"{value:.10g}"
