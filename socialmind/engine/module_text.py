"""The compiled module of a model: its rules for numba and the tick loop around them, as text.

The text depends on the shape of the model and its rules alone. Parameters, schemes and sizes are
data that the loop finds through the model's record, so a sweep over them compiles once.
"""

from __future__ import annotations

from collections.abc import Sequence

from socialmind.compiling.aggregates import aggregate_name, aggregate_text
from socialmind.compiling.layout import asked_for, dtype_text, model_dtype
from socialmind.compiling.lowering import lowered
from socialmind.compiling.prelude import HEAD, runtime_names
from socialmind.engine import interactions_text
from socialmind.engine.access import (
    AGENTS,
    THERE,
    events_text,
    population_text,
    with_other_text,
)
from socialmind.engine.conditions_text import ASKED, heeding_text
from socialmind.engine.imitation_text import imitation_text
from socialmind.engine.plans_text import call_text, plans_text
from socialmind.language.program import Phase, Program
from socialmind.language.shape import ModelShape
from socialmind.streams import ORDER_TAG


def module_text(
    program: Program, own_makers: frozenset[str], conditioned: tuple[str, ...] = ()
) -> str:
    """Return the source of a program's compiled module.

    Args:
        program: the typed functions and phases.
        own_makers: populations whose scheme has a decision maker of the modeller's own; the loader
            puts its function into the module as `_own_<population>`.
        conditioned: populations whose scheme has conditions.
    """
    shape = program.shape
    record = dtype_text(model_dtype(shape, asked_for(program, conditioned)))
    parts = [HEAD, AGENTS, runtime_names(), f"MODEL = {record}"]
    world = shape.world.text(program)
    parts.append(world.before)
    parts += [_SOME.replace("NAME", name) for name in _optional_names(shape)]
    if program.eventful:
        parts.append(events_text(program.eventful))
    networks = [one for one in shape.populations.values() if one.links is not None]
    if networks:
        from socialmind.networks import text as links

        parts += [links.HEAD, *map(links.network_text, networks)]
    for population in shape.populations.values():
        name = population.name
        leaving = [shape.world.leaving(name)]
        if population.links is not None:
            leaving = [links.untying(population)]
        elif networks:
            leaving += links.ending_links(name, networks)
        indexed, reconsiders = name in program.indexed, name in program.reconsidered
        own = name in own_makers
        kinds = [kind for of, kind in program.gathered if of == name]
        number = program.agents.index(name) if name in program.eventful else None
        parts.append(population_text(population, own, leaving, indexed, reconsiders, kinds, number))
        if population.minded:
            plain = ASKED.replace("NAME", name)
            heeds = name in conditioned
            parts.append(heeding_text(population) if heeds else plain)
    for name, command, other in program.between_minds:
        kinds = [kind for of, kind in program.gathered if of == other]
        parts.append(with_other_text(name, command, other, kinds))
    parts += [imitation_text(*one) for one in program.imitations]
    if program.sought:
        from socialmind.worlds.neighbours.text import text

        parts.append(text(shape, program))
    if program.gathered:
        from socialmind.society.groups import text as groups

        parts += [groups.HEAD, *(groups.lists_text(*one) for one in program.gathered)]
    parts += [THERE.replace("NAME", name) for name in program.perhaps_nobody]
    for name, what, field in program.aggregates:
        parts.append(aggregate_text(aggregate_name(name, what, field.name), what, field, name))
    minded = [one for one in shape.populations.values() if one.hierarchy]
    if minded:
        from socialmind.mind.code import text as minds

        parts += [
            minds.HEAD,
            *(minds.population_text(one.name, one.evaluated_by_world) for one in minded),
        ]
    if shape.interactions:
        parts.append(interactions_text.HEAD)
        parts += [interactions_text.interaction_text(*one) for one in shape.interactions.items()]
    for function in program.functions.values():
        parts.append(f"@_inner\n{lowered(function, shape, program)}")
    for name, plans in program.plans.items():
        parts.append(plans_text(name, plans))
    phases = (*program.setup, *program.schedule)
    parts += [_phase_text(shape, phase, program.indexed) for phase in phases]
    parts += _births_text(program.at_birth)
    listing = "".join(f"    _near_list_{name}(_model)\n" for name in program.sought)
    lists = "".join(f"    _{kind}_list_{name}(_model)\n" for name, kind in program.gathered)
    setup = listing + lists + _calls(program.setup) + _founders(program.at_birth)
    schedule = listing + lists.replace("_list_", "_begin_tick_") + _calls(program.schedule)
    tick = world.tick.replace("PHASES", schedule)
    parts.append(world.stages.replace("PHASES", schedule))
    parts.append(_loops_text(shape, program, setup, tick, conditioned))
    parts.append(world.after.replace("SETUP", setup or "    pass"))
    return "\n\n\n".join(part for part in parts if part) + "\n"


_SOME = """@_inner
def _some_NAME(holder):
    return _some(holder._has_NAME, holder.NAME)"""


def _optional_names(shape: ModelShape) -> list[str]:
    owners = [
        shape.variables,
        shape.world.patch or {},
        *(p.fields for p in shape.populations.values()),
    ]
    return sorted({field.name for own in owners for field in own.values() if field.optional})


CACHED_AGENTS = 10_000
"""Up to so many agents the processor's cache holds a population without being asked."""
FETCH_AHEAD = 4
"""How many agents ahead the memory of a mind is asked for; that of its body twice as many."""


def _phase_text(shape: ModelShape, phase: Phase, indexed: tuple[str, ...]) -> str:
    function = f"_phase_{phase.tag}"
    rng = "rng" in phase.takes
    population = phase.shape.population
    if population is None:
        begin = f"    _begin(rng, {phase.tag}, 0, _model._tick)\n" if rng else ""
        body = call_text(phase.symbol, phase.takes)
        return f"@_inner\ndef {function}(_model, rng):\n{begin}    {body}"
    lines = [
        f"@_inner\ndef {function}(_model, rng):",
        f"    counters = _counters_{population}(_model)",
        f"    alive = _alive_{population}(_model)",
        f"    rows = _rows_{population}(_model)",
        "    count = counters[_bookkeeping.COUNT]",
        f"    acting = _order_{population}(_model)",
    ]
    if phase.shape.shuffled:
        minded = shape.populations[population].minded
        lines += [
            f"    acting = _acting_{population}(_model)",
            f"    order = _order_{population}(_model)",
            "    for place in range(count):",
            "        acting[place] = order[place]",
            f"    _begin(rng, {ORDER_TAG}, {phase.tag}, _model._tick)",
            "    _shuffle(rng, acting, count)",
        ]
        if minded:
            lines.append(f"    values = _minds_{population}(_model).values")
        lines.append(f"    large = count > {CACHED_AGENTS}")
    lines.append("    for place in range(count):")
    if phase.shape.shuffled:
        # First the row; when it is there, it tells where its mind is. Small populations are in
        # the cache anyway.
        lines += [
            f"        if large and place + {2 * FETCH_AHEAD} < count:",
            f"            _fetch_ahead(rows, acting[place + {2 * FETCH_AHEAD}])",
        ]
        if population in indexed:
            for name, ahead in (("starts", 6), ("entries", 3)):
                lines.append(
                    f"            _near_ask_{name}_{population}"
                    f"(_model, rows[acting[place + {ahead}]])"
                )
        if minded:
            lines += [
                f"            mind = rows[acting[place + {FETCH_AHEAD}]]._mind",
                "            if mind >= 0:",
                "                _fetch_ahead(values, mind)",
            ]
    lines += [
        "        slot = _index(acting[place])",
        "        if alive[slot]:",
        "            agent = rows[slot]",
    ]
    if rng:
        lines.append(f"            _begin(rng, {phase.tag}, agent._id, _model._tick)")
    lines.append(f"            {call_text(phase.symbol, phase.takes)}")
    return "\n".join(lines)


_BORN = """@_inner
def _births_NAME(_model, rng):
    counters = _counters_NAME(_model)
    first = counters[_bookkeeping.COUNT]
    place = first
    while place < counters[_bookkeeping.ENTRIES]:
        slot = _order_NAME(_model)[place]
        place += 1
        if _alive_NAME(_model)[slot]:
            agent = _rows_NAME(_model)[slot]
            _begin(rng, TAG, agent._id, _model._tick)
            CALL
    counters[_bookkeeping.COUNT] = place
    return place > first"""


def _births_text(phases: Sequence[Phase]) -> list[str]:
    """Return what lets the newborn follow their rule: all between those who act and the last."""
    if not phases:
        return []
    parts, calls = [], ""
    for phase in phases:
        text = _BORN.replace("TAG", str(phase.tag))
        text = text.replace("CALL", call_text(phase.symbol, phase.takes))
        name = str(phase.shape.population)
        parts.append(text.replace("NAME", name))
        calls += f"        again = _births_{name}(_model, rng) or again\n"
    begin = "@_inner\ndef _births(_model, rng):\n    again = True\n    while again:\n"
    return [*parts, f"{begin}        again = False\n{calls}"]


def _founders(phases: Sequence[Phase]) -> str:
    """Return what lets the founders follow the rule at birth."""
    counts = "".join(
        f"    _counters_{phase.shape.population}(_model)[_bookkeeping.COUNT] = 0\n"
        for phase in phases
    )
    return f"{counts}    _births(_model, rng)\n" if phases else ""


def _calls(phases: Sequence[Phase]) -> str:
    return "".join(f"    _phase_{phase.tag}(_model, rng)\n" for phase in phases)


def _loops_text(
    shape: ModelShape, program: Program, setup: str, tick: str, conditioned: tuple[str, ...]
) -> str:
    settle = "    _births(_model, _stream(_model))\n" if program.at_birth else ""
    settle += "".join(f"    _heed_all_{name}(_model)\n" for name in conditioned)
    messages = [name for name, one in shape.populations.items() if one.messages_to is not None]
    settle += "".join(f"    _vanish_{name}(_model)\n" for name in messages)
    settle += "".join(
        f"    _settle(_counters_{name}(_model), _order_{name}(_model), _alive_{name}(_model), "
        f"_free_{name}(_model))\n"
        for name in shape.populations
    )
    settle += "".join(f"    _deliver_{name}(_model)\n" for name in messages)
    room = "".join(
        f"    if _short_of_room(_counters_{name}(_model), _slot_of_{name}(_model)):\n"
        "        return True\n"
        for name in program.births
    )
    if program.eventful:
        room += "    if _short_of_events(_model):\n        return True\n"
    room += "".join(
        f"    if _adjacency.short_of_space(_ties_{side}_{name}(_model)):\n        return True\n"
        for name in program.births
        if shape.populations[name].links is not None
        for side in ("out", "in")
    )
    return f'''@_inner
def _end_tick(_model):
{settle}    return


@_inner
def _no_room(_model):
{room}    return False


@_inner
def _tick(_model, rng):
{tick}    _end_tick(_model)
    _model._tick += 1


@_kept(__name__)
def prepare(models):
    """Run the setup of a society, whose record is given as an array of one MODEL."""
    _model = models[0]
    rng = _stream(_model)
{setup}    _end_tick(_model)


@_kept(__name__, nogil=True)
def advance(models, ticks):
    """Run up to so many ticks; return how many, fewer when there is no room for births."""
    _model = models[0]
    rng = _stream(_model)
    for done in range(ticks):
        if _no_room(_model):
            return done
        _tick(_model, rng)
    return ticks'''
