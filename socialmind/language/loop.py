"""The compiled module of a model: its rules for numba and the tick loop around them, as text.

The text depends on the shape of the model and its rules alone. Parameters, schemes and sizes are
data that the loop finds through the model's record, so a sweep over them compiles once.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from coglogo_py.arrays import MindArrays, SchemeArrays
from socialmind.fields import Field
from socialmind.language.lowering import lowered
from socialmind.language.program import RUNTIME, Phase, Program
from socialmind.language.shape import ModelShape, PopulationShape
from socialmind.language.signatures import MIND, Named
from socialmind.streams import ORDER_TAG, SCHEDULE_TAG, SETUP_TAG

Columns = list[Any]

TABLE_ARRAYS: dict[str, tuple[str, int]] = {
    "order": ("int64", 1),
    "acting": ("int64", 1),
    "slot_of": ("int64", 1),
    "free": ("int64", 1),
    "alive": ("bool_", 1),
    "counters": ("int64", 1),
    "names": ("int64", 1),
}
"""The arrays of every population beside its rows: NumPy type and dimensions."""

MIND_SCRATCH: dict[str, tuple[str, int]] = {
    "weights": ("float64", 1),
    "plans": ("int64", 1),
    "functions": ("int64", 1),
}
"""Further arrays of a population with minds: room for a decision, the function of each plan."""


ENGINE_ARRAYS: dict[str, tuple[str, int]] = {
    "influence": ("float64", 2),
    "conditional": ("bool_", 2),
    "reinforcement": ("float64", 2),
    "start": ("float64", 1),
    "culturon_start": ("float64", 1),
    "role_group": ("int64", 1),
    "role_culturons": ("bool_", 2),
    "group_culturons": ("int64", 2),
    "maker": ("float64", 1),
    "mind_id": ("int64", 1),
    "values": ("float64", 2),
    "draws": ("int64", 1),
    "group_slot": ("int64", 2),
    "role": ("int64", 2),
    "participation": ("float64", 2),
    "instance_id": ("int64", 1),
    "instance_group": ("int64", 1),
    "members": ("int64", 1),
    "culturons": ("float64", 2),
    "free_minds": ("int64", 1),
    "free_instances": ("int64", 1),
    "counters": ("int64", 1),
}
"""Types and dimensions of `SchemeArrays` and `MindArrays`."""


def population_arrays(population: PopulationShape) -> dict[str, tuple[str, int]]:
    """Return the names, types and dimensions of all plain arrays of a population."""
    arrays = dict(TABLE_ARRAYS)
    if population.minded:
        arrays |= MIND_SCRATCH
        arrays |= {f"scheme_{name}": ENGINE_ARRAYS[name] for name in SchemeArrays._fields}
        arrays |= {f"minds_{name}": ENGINE_ARRAYS[name] for name in MindArrays._fields}
    return arrays


def row_dtype(fields: dict[str, Field], population: PopulationShape | None) -> np.dtype[Any]:
    """Return the record of an agent, or of a patch when there is no population."""
    columns: Columns = []
    if population is not None:
        columns += [("_id", "i8"), ("_slot", "i8")]
        if population.minded:
            columns += [("_mind", "i8"), ("_plan", "i8"), ("_decided", "i8")]
    for field in fields.values():
        columns += field.dtype
    # A patch may be a few bytes, and there are many: no padding between them.
    return np.dtype(columns or [("_empty", "i1")], align=population is not None)


def model_dtype(shape: ModelShape) -> np.dtype[Any]:
    """Return the model's record: parameters, variables, and where everything else is."""
    columns: Columns = []
    for field in [*shape.parameters.values(), *shape.variables.values()]:
        columns += field.dtype
    plain = "tick stream idle idle_agent idle_tick world_size world_low world_high patches"
    columns += [(f"_{name}", "i8") for name in plain.split()]
    for population in shape.populations.values():
        name = population.name
        columns += [(f"_{name}_rows", "i8"), (f"_{name}_default", "i8"), (f"_{name}_room", "i8")]
        for array, (_, dimensions) in population_arrays(population).items():
            columns.append((f"_{name}_{array}", "i8"))
            columns += [(f"_{name}_{array}_{axis}", "i8") for axis in range(dimensions)]
    return np.dtype(columns, align=True)


def module_text(program: Program, own_makers: frozenset[str]) -> str:
    """Return the source of a program's compiled module.

    Args:
        program: the typed functions and phases.
        own_makers: populations whose scheme has a decision maker of the modeller's own; the loader
            puts its function into the module as `_own_<population>`.
    """
    shape = program.shape
    parts = [_HEAD, _runtime_names(), f"MODEL = {_dtype_text(model_dtype(shape))}"]
    if shape.patch is not None:
        parts.append(f"PATCH = {_dtype_text(row_dtype(dict(shape.patch), None))}")
        parts.append(_PATCHES)
    parts += [_SOME.replace("NAME", name) for name in _optional_names(shape)]
    for population in shape.populations.values():
        parts.append(_population_text(population, population.name in own_makers))
    for function in program.functions.values():
        parts.append(f"@_inner\n{lowered(function)}")
    for name, plans in program.plans.items():
        parts.append(_plans_text(name, list(plans.values())))
    for tag, phases in ((SETUP_TAG, program.setup), (SCHEDULE_TAG, program.schedule)):
        parts += [_phase_text(shape, tag, place, phase) for place, phase in enumerate(phases)]
    parts.append(_loops_text(shape, program))
    return "\n\n\n".join(parts) + "\n"


_HEAD = '''"""Generated from a model's rules; see ARCHITECTURE.md, "One definition, two speeds"."""

import numpy as np
from numba import carray, njit

from coglogo_py import kernel as _kernel
from coglogo_py.arrays import MindArrays as _MindArrays
from coglogo_py.arrays import SchemeArrays as _SchemeArrays
from socialmind import bookkeeping as _bookkeeping
from socialmind import streams as _streams
from socialmind.language import arithmetic as _arithmetic
from socialmind.language.memory import as_pointer as _as_pointer
from socialmind.language.memory import fetch_ahead as _fetch_ahead
from socialmind.language.memory import some as _some
from socialmind.worlds import torus as _torus

# What only compiled code calls needs no door for Python; each would cost time to compile.
_inner = njit(no_cpython_wrapper=True, no_cfunc_wrapper=True)
_int64 = np.int64
_as_int = int
_as_float = float
_abs = abs
_len = len
_range = range
_nan = np.nan
STREAM = _streams.STREAM
_rng_random = _streams.random
_rng_uniform = _streams.uniform
_rng_integers = _streams.integers
_rng_normal = _streams.normal
_rng_exponential = _streams.exponential
_begin = _streams.begin
_shuffle = _streams.shuffle
_born = _bookkeeping.born
_died = _bookkeeping.died
_settle = _bookkeeping.settle
_short_of_room = _bookkeeping.short_of_room
_slot_of_agent = _bookkeeping.slot_of_agent
_living = _bookkeeping.is_living
_nth_living = _bookkeeping.nth_living
_patch_index = _inner(_torus.patch_index)
_patches_in_radius = _inner(_torus.patches_in_radius)


@_inner
def _stream(_model):
    return carray(_as_pointer(_model._stream), (1,), STREAM)[0]'''

_PATCHES = """@_inner
def _patches(_model):
    size = _model._world_size
    return carray(_as_pointer(_model._patches), (size * size,), PATCH)"""


_SOME = """@_inner
def _some_NAME(holder):
    return _some(holder._has_NAME, holder.NAME)"""


def _optional_names(shape: ModelShape) -> list[str]:
    owners = [shape.variables, shape.patch or {}, *(p.fields for p in shape.populations.values())]
    return sorted({field.name for own in owners for field in own.values() if field.optional})


def _runtime_names() -> str:
    builtins = (
        "_present",
        "_as_int",
        "_as_float",
        "_abs",
        "_len",
        "_range",
        "_print",
        "_breakpoint",
    )
    return "\n".join(f"{name} = _arithmetic.{name[1:]}" for name in RUNTIME if name not in builtins)


def _dtype_text(dtype: np.dtype[Any]) -> str:
    assert dtype.fields is not None  # a record
    columns = []
    for name, (column, *_) in dtype.fields.items():
        shape = f", {column.shape}" if column.shape else ""
        # numba knows no arrays of truth values in a record; bytes are laid out alike.
        kind = "u1" if shape and column.base == np.bool_ else column.base.str[1:]
        columns.append(f"    ({name!r}, {kind!r}{shape}),\n")
    return f"np.dtype(\n    [\n{''.join(columns)}    ],\n    align={dtype.isalignedstruct},\n)"


def _view(population: str, array: str, kind: str, dimensions: int) -> str:
    place = f"_model._{population}_{array}"
    shape = "".join(f"{place}_{axis}, " for axis in range(dimensions))
    return f"carray(_as_pointer({place}), ({shape}), np.{kind})"


_POPULATION = """NAME_ROW = DTYPE


@_inner
def _rows_NAME(_model):
    return carray(_as_pointer(_model._NAME_rows), (_model._NAME_room,), NAME_ROW)


@_inner
def _agent_NAME(_model, identity):
    return _rows_NAME(_model)[_slot_of_agent(_slot_of_NAME(_model), identity)]


@_inner
def _contains_NAME(_model, identity):
    return _living(_slot_of_NAME(_model), identity)


@_inner
def _entries_NAME(_model):
    return _counters_NAME(_model)[_bookkeeping.ENTRIES]


@_inner
def _living_NAME(_model):
    return _counters_NAME(_model)[_bookkeeping.ALIVE]


@_inner
def _is_living_NAME(_model, place):
    return _alive_NAME(_model)[_order_NAME(_model)[place]]


@_inner
def _entry_NAME(_model, place):
    return _rows_NAME(_model)[_order_NAME(_model)[place]]


@_inner
def _one_of_NAME(_model, rng):
    counters = _counters_NAME(_model)
    if counters[_bookkeeping.ALIVE] == 0:
        raise ValueError("one_of() of a population without agents")
    place = _rng_integers(rng, 0, counters[_bookkeeping.ALIVE])
    return _rows_NAME(_model)[
        _nth_living(counters, _order_NAME(_model), _alive_NAME(_model), place)
    ]


@_inner
def _place_for_NAME(_model):
    slot = _born(
        _counters_NAME(_model),
        _order_NAME(_model),
        _alive_NAME(_model),
        _slot_of_NAME(_model),
        _free_NAME(_model),
    )
    if slot < 0:
        raise _bookkeeping.NoRoomError("more births in a tick than there is room for")
    return slot


@_inner
def _named_NAME(_model, slot):
    agent = _rows_NAME(_model)[slot]
    agent._slot = slot
    agent._id = _counters_NAME(_model)[_bookkeeping.NEXT_ID] - 1
    return agent


@_inner
def _create_NAME(_model):
    slot = _place_for_NAME(_model)
    rows = _rows_NAME(_model)
    rows[slot] = carray(_as_pointer(_model._NAME_default), (1,), NAME_ROW)[0]
    agent = _named_NAME(_model, slot)
    NEW_MIND
    return agent


@_inner
def _hatch_NAME(_model, parent, keep_groups):
    if not _alive_NAME(_model)[parent._slot]:
        raise ValueError("hatch() of an agent that is dead")
    slot = _place_for_NAME(_model)
    rows = _rows_NAME(_model)
    rows[slot] = parent
    agent = _named_NAME(_model, slot)
    HATCHED_MIND
    return agent


@_inner
def _die_NAME(_model, agent):
    alive = _alive_NAME(_model)
    if alive[agent._slot]:
        _died(_counters_NAME(_model), alive, _slot_of_NAME(_model), agent._slot, agent._id)
        DEAD_MIND"""

_MINDS = """@_inner
def _slot_of_mind_NAME(agent):
    if agent._mind < 0:
        raise ValueError("the mind of an agent that is dead")
    return agent._mind


@_inner
def _mind_choose_next_plan_NAME(_model, agent):
    plan = _decide_NAME(_model, _slot_of_mind_NAME(agent))
    agent._decided = _model._tick
    if plan < 0:
        if _model._idle == 0:
            _model._idle_agent = agent._id
            _model._idle_tick = _model._tick
        _model._idle += 1
    return plan"""

_DECIDE = """_choose_NAME = _kernel.choose_next_plan


@_inner
def _decide_NAME(_model, slot):
    return _choose_NAME(
        _scheme_NAME(_model), _minds_NAME(_model), slot, _weights_NAME(_model), _plans_NAME(_model)
    )"""

_DECIDE_BY_OWN_MAKER = """@_inner
def _decide_NAME(_model, slot):
    scheme = _scheme_NAME(_model)
    minds = _minds_NAME(_model)
    weights = _weights_NAME(_model)
    plans = _plans_NAME(_model)
    count = _kernel.available_weights(scheme, minds, slot, weights, plans)
    plan = -1
    if count > 0:
        u = _kernel.next_draw(minds, slot)
        plan = plans[_own_NAME(weights[:count], scheme.maker[1], u)]
    minds.draws[slot] += 1
    return plan"""


def _population_text(population: PopulationShape, own_maker: bool) -> str:
    name = population.name
    parts = []
    for array, (kind, dimensions) in population_arrays(population).items():
        if array.startswith(("scheme_", "minds_")):
            continue
        view = _view(name, array, kind, dimensions)
        parts.append(f"@_inner\ndef _{array}_{name}(_model):\n    return {view}")
    fills = {
        "NEW_MIND": "pass",
        "HATCHED_MIND": "pass",
        "DEAD_MIND": "pass",
        "DTYPE": _dtype_text(row_dtype(dict(population.fields), population)),
    }
    if population.minded:
        for prefix, cls in (("scheme", SchemeArrays), ("minds", MindArrays)):
            views = "".join(
                f"        {_view(name, f'{prefix}_{array}', *ENGINE_ARRAYS[array])},\n"
                for array in cls._fields
            )
            made = f"_{cls.__name__}(\n{views}    )"
            parts.append(f"@_inner\ndef _{prefix}_{name}(_model):\n    return {made}")
        fills |= {
            "NEW_MIND": (
                f"agent._mind = _kernel.new_mind(_scheme_{name}(_model), _minds_{name}(_model))"
            ),
            "HATCHED_MIND": (
                f"agent._mind = _kernel.hatch("
                f"_scheme_{name}(_model), _minds_{name}(_model), parent._mind, keep_groups)"
            ),
            "DEAD_MIND": (
                f"_kernel.die(_scheme_{name}(_model), _minds_{name}(_model), agent._mind)\n"
                f"        agent._mind = -1"
            ),
        }
        parts.append((_DECIDE_BY_OWN_MAKER if own_maker else _DECIDE).replace("NAME", name))
        parts.append(_MINDS.replace("NAME", name))
        parts += [_command_text(name, command) for command in MIND if command != "choose_next_plan"]
    text = _POPULATION
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return "\n\n\n".join([text.replace("NAME", name), *parts])


_WITH_SCHEME = ("feed_back_from_plan", "create_and_join_group", "join_group")


def _command_text(population: str, command: str) -> str:
    arguments = "".join(
        f", {one.part if isinstance(one, Named) else 'value'}" for one in MIND[command].arguments
    )
    scheme = f"_scheme_{population}(_model), " if command in _WITH_SCHEME else ""
    return (
        f"@_inner\ndef _mind_{command}_{population}(_model, agent{arguments}):\n"
        f"    return _kernel.{command}({scheme}_minds_{population}(_model), "
        f"_slot_of_mind_{population}(agent){arguments})"
    )


def _call_text(symbol: str, takes: tuple[str, ...]) -> str:
    values = {"agent": "agent", "model": "_model", "rng": "rng"}
    return f"{symbol}({', '.join(['_model', *(values[one] for one in takes)])})"


def _plans_text(population: str, entries: list[tuple[str, tuple[str, ...]]]) -> str:
    lines = [
        f"@_inner\ndef _run_plan_{population}(_model, agent, rng):",
        "    plan = agent._plan",
        "    if plan < 0:",
        "        return",
        f"    function = _functions_{population}(_model)[plan]",
    ]
    for place, (symbol, takes) in enumerate(entries):
        word = "if" if place == 0 else "elif"
        lines += [f"    {word} function == {place}:", f"        {_call_text(symbol, takes)}"]
    return "\n".join(lines)


CACHED_AGENTS = 1000
"""Up to so many agents the processor's cache holds a population without being asked."""
FETCH_AHEAD = 4
"""How many agents ahead the memory of a mind is asked for; that of its body twice as many."""


def _phase_text(shape: ModelShape, tag: int, place: int, phase: Phase) -> str:
    function = f"_phase_{tag + place}"
    rng = "rng" in phase.takes
    population = phase.shape.population
    if population is None:
        begin = f"    _begin(rng, {tag + place}, 0, _model._tick)\n" if rng else ""
        body = _call_text(phase.symbol, phase.takes)
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
            f"    _begin(rng, {ORDER_TAG}, {tag + place}, _model._tick)",
            "    _shuffle(rng, acting, count)",
        ]
    if phase.shape.shuffled and minded:
        lines.append(f"    values = _minds_{population}(_model).values")
    if phase.shape.shuffled:
        lines.append(f"    large = count > {CACHED_AGENTS}")
    lines.append("    for place in range(count):")
    if phase.shape.shuffled:
        # First the row; when it is there, it tells where its mind is. Small populations are in
        # the cache anyway.
        lines += [
            f"        if large and place + {2 * FETCH_AHEAD} < count:",
            f"            _fetch_ahead(rows, acting[place + {2 * FETCH_AHEAD}])",
        ]
        if minded:
            lines += [
                f"            mind = rows[acting[place + {FETCH_AHEAD}]]._mind",
                "            if mind >= 0:",
                "                _fetch_ahead(values, mind)",
            ]
    lines += [
        "        slot = acting[place]",
        "        if alive[slot]:",
        "            agent = rows[slot]",
    ]
    if rng:
        lines.append(f"            _begin(rng, {tag + place}, agent._id, _model._tick)")
    lines.append(f"            {_call_text(phase.symbol, phase.takes)}")
    return "\n".join(lines)


def _loops_text(shape: ModelShape, program: Program) -> str:
    settle = "".join(
        f"    _settle(_counters_{name}(_model), _order_{name}(_model), _alive_{name}(_model), "
        f"_free_{name}(_model))\n"
        for name in shape.populations
    )
    room = "".join(
        f"    if _short_of_room(_counters_{name}(_model), _slot_of_{name}(_model)):\n"
        "        return True\n"
        for name in program.births
    )
    setup = "".join(f"    _phase_{SETUP_TAG + i}(_model, rng)\n" for i in range(len(program.setup)))
    tick = "".join(
        f"    _phase_{SCHEDULE_TAG + i}(_model, rng)\n" for i in range(len(program.schedule))
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


def prepare(models):
    """Run the setup."""
    _prepare(models.view(MODEL))


def advance(models, ticks):
    """Run up to so many ticks; return how many, fewer when there is no room for births."""
    return _advance(models.view(MODEL), ticks)


@njit(cache=True)
def _prepare(models):
    _model = models[0]
    rng = _stream(_model)
{setup}    _end_tick(_model)


@njit(cache=True)
def _advance(models, ticks):
    _model = models[0]
    rng = _stream(_model)
    for done in range(ticks):
        if _no_room(_model):
            return done
        _tick(_model, rng)
    return ticks'''
