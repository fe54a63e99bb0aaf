"""The second element of ODD: entities, their state variables, and the parameters of a model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from socialmind.documents.markdown import table
from socialmind.documents.odd import docstrings
from socialmind.documents.odd.known_fields import ON_A_PLANE, PLACES, PUT, SET
from socialmind.documents.odd.words import ENTITIES, Facts, Words, facts_in, plain

if TYPE_CHECKING:
    from socialmind.fields import Field
    from socialmind.language.shape import PopulationShape
    from socialmind.model import Model
    from socialmind.society.parameter import Parameter
    from socialmind.society.population import Population

PATCHES, WHOLE, PARAMETERS, BODIES = "patches", "the model", "parameters", "bodies on the plane"
"""Headings of what is no population."""
PLAN = ("plan", "the name of a plan", "–", "none", "the plan that it follows")
NONE = "–"
Gap = Callable[[str], None]
"""What is told of something that the author has not said."""


def parts_of(model: type[Model]) -> dict[str, Population]:
    """Return the populations, messages and networks of a model, by name."""
    return {**model.populations, **model.networks}


def overview(model: type[Model]) -> str:
    """Return the table of all entities."""
    rows = []
    for name, one in parts_of(model).items():
        what = docstrings.own(one.agent)
        rows.append((f"`{name}`", _joined(model, name) or _number(model, one), _minds(one), what))
    if model.shape.world.patch:
        kind = getattr(model.declared_world, "patch", None)
        about = docstrings.own(kind) if isinstance(kind, type) else ""
        rows.append((PATCHES, str(model.declared_world), "", about))
    rows.append((WHOLE, "1", "", docstrings.own(model)))
    return table(("entity", "how many at the start", "mind", "what it is"), rows)


def _joined(model: type[Model], name: str) -> str:
    shape = model.shape.populations[name]
    if shape.messages_to is not None:
        return f"messages to `{shape.messages_to}`"
    if shape.links is not None:
        way = "to" if shape.links.apart else "and"
        return f"links between `{shape.links.source}` {way} `{shape.links.target}`"
    return ""


def _number(model: type[Model], one: Population) -> str:
    if one.table is not None:
        return f"a row each of `{one.table}`" if isinstance(one.table, str) else "a row each"
    sizes = [_size(model, size) for size in one.sizes]
    if one.civilisations:
        return ", ".join(f"{size} {people.name}" for size, people in
                         zip(sizes, one.civilisations, strict=True))  # fmt: skip
    return "none; rules make them" if sizes == ["0"] else " and ".join(sizes)


def _size(model: type[Model], size: int | str) -> str:
    if isinstance(size, str):
        return f"`{size}` ({written(model.parameters[size].default)})"
    return str(size)


def _minds(one: Population) -> str:
    minds = []
    if one.mind is not None:
        minds.append("cognitive scheme")
    if one.hierarchy is not None:
        minds.append("hierarchy of skills")
    if one.weighing is not None:
        return "hierarchy of skills that weighs the plans of a cognitive scheme"
    return ", ".join(minds)


def entity_sections(
    model: type[Model], words: Words, minds: Mapping[str, str], gap: Gap
) -> Iterator[str]:
    """Yield a section for each population, the patches and the model, and then the author's others.

    Args:
        model: the model.
        words: its author's.
        minds: what to say of the minds of a population, below its variables.
        gap: told of what is missing.
    """
    said = words.elements[ENTITIES]
    headings = {plain(PARAMETERS), plain(BODIES)}
    bodies: dict[str, tuple[Field, list[str]]] = {}
    for name, shape in model.shape.populations.items():
        one = parts_of(model)[name]
        headings.add(plain(name))
        text, facts = facts_in(said.part(plain(name)))
        meanings = docstrings.attributes(one.agent)
        fields = shape_fields(model, name)
        if model.shape.world.has_episodes:  # where all bodies have a dozen fields alike
            for key in [key for key in fields if key in ON_A_PLANE and key not in facts]:
                bodies.setdefault(key, (fields.pop(key), []))[1].append(name)
        rows = list(_rows(name, fields, facts, meanings, gap))
        if shape.minded:
            fact = facts.pop("plan", {})
            rows.append((f"`{PLAN[0]}`", *PLAN[1:4], fact.get("meaning") or PLAN[4]))
        _refuse_unknown(words, name, facts, gap)
        yield _section(name, [text, _variables(rows), minds.get(name, "")])
    if bodies:
        yield _section(BODIES, [said.part(plain(BODIES)), _of_bodies(bodies)])
    patch = model.shape.world.patch
    if patch:
        headings.add(PATCHES)
        yield _fields_of(PATCHES, said.part(PATCHES), dict(patch), words, gap)
    if model.variables:
        headings.add(WHOLE)
        yield _fields_of(WHOLE, said.part(WHOLE), model.variables, words, gap)
    for heading, text in said.others(headings | {plain(f"mind of {one}") for one in minds}
                                     | {plain(f"skills of {one}") for one in minds}):  # fmt: skip
        if facts_in(text)[1]:
            known = ", ".join(sorted(headings))
            gap(f"the table of variables under {heading!r}, which is none of {known}")
        yield f"### {heading}\n\n{text}"


def _of_bodies(bodies: Mapping[str, tuple[Field, list[str]]]) -> str:
    """Return the table of the fields that the library gives to what is on a plane."""
    rows = []
    for name in (key for key in ON_A_PLANE if key in bodies):
        one, owners = bodies[name]
        unit, meaning = ON_A_PLANE[name]
        start = SET if name in PUT or name == "heading" else _default(one)
        kind = "numbers" if one.size is not None else _kind(one)
        of = ", ".join(f"`{owner}`" for owner in owners)
        rows.append((f"`{name}`", of, kind, unit, start, meaning))
    return table(("variable", "of", "type", "unit", "at the start", "meaning"), rows)


def _fields_of(heading: str, text: str, fields: Mapping[str, Field], words: Words, gap: Gap) -> str:
    text, facts = facts_in(text)
    rows = list(_rows(heading, fields, facts, {}, gap))
    _refuse_unknown(words, heading, facts, gap)
    return _section(heading, [text, _variables(rows)])


def shape_fields(model: type[Model], name: str) -> dict[str, Field]:
    """Return the fields of a population that a reader should know of."""
    world = model.shape.world
    fields = model.shape.populations[name].fields
    nowhere = not (world.extent or world.has_episodes)
    return {
        key: one
        for key, one in fields.items()
        if not key.startswith("_")
        and not (key in PLACES and (nowhere or not _placed(model.shape.populations[name])))
    }


def _placed(shape: PopulationShape) -> bool:
    """Whether agents are anywhere: links and messages are not."""
    return shape.links is None and shape.messages_to is None


def known_meanings(model: type[Model]) -> Mapping[str, tuple[str, str]]:
    """Return what the library's own fields mean in a model's world."""
    return ON_A_PLANE if model.shape.world.has_episodes else PLACES


def _rows(
    owner: str, fields: Mapping[str, Field], facts: Facts, meanings: Mapping[str, str], gap: Gap
) -> Iterator[tuple[str, ...]]:
    """Yield the row of each field; what is said of it is taken out of the facts."""
    known = ON_A_PLANE if "angle" in fields else PLACES
    for name, one in fields.items():
        fact = facts.pop(name, {})
        unit, meaning = known.get(name, ("", ""))
        meaning = fact.get("meaning") or meanings.get(name) or meaning
        if not meaning:
            gap(f"the meaning of `{name}` of {owner}")
        unit = fact.get("unit") or unit or NONE
        start = fact.get("start") or (SET if name in known and name in PUT else _default(one))
        yield f"`{name}`", _kind(one), unit, start, meaning


def _refuse_unknown(words: Words, owner: str, facts: Facts, gap: Gap) -> None:
    for name in facts:
        gap(f"`{name}` of {owner}, which the model does not have: take it out of {words.file.name}")


def _variables(rows: list[tuple[str, ...]]) -> str:
    if not rows:
        return ""
    return table(("variable", "type", "unit", "at the start", "meaning"), rows)


def _kind(one: Field) -> str:
    if one.choices:
        return f"one of {', '.join(one.choices)}"
    kind = {float: "number", int: "whole number", bool: "true or false"}[one.kind]
    if one.size is not None:
        several = "s" if one.size > 1 else ""
        return f"{one.size} times {kind}" if one.kind is bool else f"{one.size} {kind}{several}"
    if one.limits:
        return f"{kind}, {one.limits[0]:,} … {one.limits[1]:,}".replace("-", "−")
    return f"{kind}, or none" if one.optional else kind


def _default(one: Field) -> str:
    if isinstance(one.default, tuple):
        values = list(dict.fromkeys(one.default))
        return f"{written(values[0])} each" if len(values) == 1 else ", ".join(map(written, values))
    if one.choices and isinstance(one.default, int):
        return one.choices[one.default]
    return "none" if one.default is None else written(one.default)


def written(value: Any) -> str:
    """Return a value as documents have it.

    >>> [written(one) for one in (167.0, 0.003312, False, 1e-06, -1)]
    ['167', '0.003312', 'false', '1e-06', '−1']
    """
    if isinstance(value, bool):
        return str(value).lower()
    text = repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
    return f"−{text[1:]}" if text.startswith("-") else text


def _section(heading: str, parts: list[str]) -> str:
    title = heading.replace("_", " ")
    return "\n\n".join([f"### {title[:1].upper()}{title[1:]}", *filter(None, parts)])


def parameters(model: type[Model], words: Words, gap: Gap) -> str:
    """Return the section of parameters: a table, and what the author says of them."""
    rows = [_parameter(one, gap) for one in model.parameters.values()]
    header = ("name", "unit", "range", "default", "meaning")
    text = words.elements[ENTITIES].part(PARAMETERS)
    shown = table(header, rows, keep=header) if rows else "The model has no parameters."
    return _section(PARAMETERS, [shown, text])


def _parameter(one: Parameter, gap: Gap) -> tuple[str, ...]:
    if not one.doc:
        gap(f"what the parameter `{one.name}` means: write doc=… in its declaration")
    default = one.default if isinstance(one.default, str) else written(one.default)
    return f"`{one.name}`", one.unit or NONE, one.range, default.replace("−", "-"), one.doc
