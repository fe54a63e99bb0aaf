"""How compiled rules reach a population, as text: agents, births and deaths, minds and plans."""

from __future__ import annotations

from collections.abc import Sequence

from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.laying_out import ENGINE_ARRAYS
from socialmind.agents import events
from socialmind.compiling.layout import (
    dtype_text,
    population_arrays,
    row_dtype,
    view_function_text,
    view_text,
)
from socialmind.engine.plans_text import PLAN_STEPS, WEIGHED, reconsidering_text
from socialmind.language.shape import PopulationShape
from socialmind.language.typing.signatures import MIND, OTHER, Named

AGENTS = """from socialmind.agents import bookkeeping as _bookkeeping
from socialmind.mind.kernel import weights as _weights

_born = _bookkeeping.born
_died = _bookkeeping.died
_settle = _bookkeeping.settle
_short_of_room = _bookkeeping.short_of_room
_find_slot = _bookkeeping.slot_of_agent
_living = _bookkeeping.is_living
_nth_living = _bookkeeping.nth_living"""

_POPULATION = """NAME_ROW = DTYPE


@_inner
def _rows_NAME(_model):
    return carray(_as_pointer(_model._NAME_rows), (_model._NAME_room,), NAME_ROW)


@_inner
def _agent_NAME(_model, identity):
    return _rows_NAME(_model)[_find_slot(_slot_of_NAME(_model), identity)]


@_inner
def _there_NAME(_model, slot):
    if slot < 0:
        raise ValueError("an agent that is None was used")
    return _rows_NAME(_model)[slot]


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
    NEW_HIERARCHY
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
    HATCHED_HIERARCHY
    return agent


@_inner
def _die_NAME(_model, agent):
    alive = _alive_NAME(_model)
    if alive[agent._slot]:
        _died(_counters_NAME(_model), alive, _slot_of_NAME(_model), agent._slot, agent._id)
        DEAD_MIND"""

THERE = """@_inner
def _near_there_NAME(_model, slot):
    if slot < 0:
        raise ValueError("an agent that is None was used")
    return _rows_NAME(_model)[slot]"""
"""How rules reach an agent that may be None: by its slot, −1 for none."""

EVENTS = """from socialmind.agents import events as _events


@_inner
def _event_log(_model):
    return carray(_as_pointer(_model._events), (_model._events_0, _model._events_1), np.int64)


@_inner
def _short_of_events(_model):
    count = 0
MOST
    return _events.short_of_rows(_event_log(_model), count)"""
"""How births and deaths are noted."""

_NOTE = "_events.note(_event_log(_model), _model._tick + 1, NUMBER, agent._id, PARENT)"

_MESSAGES = """from socialmind.agents import message as _messages


@_inner
def _send_NAME(_model, sender, recipient):
    message = _create_NAME(_model)
    message.sender = sender._id
    message.recipient = recipient._id
    return message


@_inner
def _vanish_NAME(_model):
    rows = _rows_NAME(_model)
    _messages.vanish(
        _counters_NAME(_model),
        _order_NAME(_model),
        _alive_NAME(_model),
        _slot_of_NAME(_model),
        rows._id,
        rows.recipient,
        _slot_of_TO(_model),
    )


@_inner
def _deliver_NAME(_model):
    rows = _rows_NAME(_model)
    _messages.deliver(
        _counters_NAME(_model),
        _order_NAME(_model),
        _alive_NAME(_model),
        rows._next,
        rows.recipient,
        _counters_TO(_model),
        _order_TO(_model),
        _slot_of_TO(_model),
        _rows_TO(_model)._first_NAME,
    )"""

_MINDS = """@_inner
def _mind_choose_next_plan_NAME(_model, agent):
    plan = _decide_NAME(_model, agent)
    agent._decided = _model._tick
    if plan < 0:
        if _model._idle == 0:
            _model._idle_agent = agent._id
            _model._idle_tick = _model._tick
        _model._idle += 1
    return plan"""

_DECIDE = """@_inner
def _decide_NAME(_model, agent):
    return _choose_NAME(
        _scheme_NAME(_model),
        _minds_NAME(_model),
        _asked_NAME(_model, agent),
        _weights_NAME(_model),
        _plans_NAME(_model),
    )


_choose_NAME = _kernel.choose_next_plan"""

_DECIDE_IN_STEPS = """@_inner
def _decide_NAME(_model, agent):
    slot = _asked_NAME(_model, agent)
    scheme = _scheme_NAME(_model)
    minds = _minds_NAME(_model)
    weights = _weights_NAME(_model)
    plans = _plans_NAME(_model)
    count = _kernel.available_weights(scheme, minds, slot, weights, plans)
    WEIGH
    return _choose_NAME(scheme, minds, slot, weights, plans, count)"""

_WEIGH = """@_inner
def _weigh_NAME(_model, agent, slot, minds, weights, plans, count):
    sensor = _weighing_sensor_NAME(_model)
    reach = _weighing_reach_NAME(_model)
    for cogniton in range(len(sensor)):
        if sensor[cogniton] >= 0:
            read = _weights.sensed(minds.values[slot, cogniton], reach[cogniton])
            _hierarchy_set_sensor_NAME(_model, agent._slot, sensor[cogniton], read)
    _hierarchy_evaluate_NAME(_model, agent._slot)
    actuator = _weighing_actuator_NAME(_model)
    most = _weighing_plans_NAME(_model)[0]
    for place in range(count):
        command = _hierarchy_actuator_NAME(_model, agent._slot, actuator[plans[place]])
        weights[place] = _weights.weighed(command, most)"""

_CHOOSE_AMONG = "_choose_NAME = _kernel.choose_among"

_CHOOSE_BY_OWN_MAKER = """from coglogo_py.compiled.own_maker import position_of as _position_of


@_inner
def _choose_NAME(scheme, minds, slot, weights, plans, count):
    plan = -1
    if count > 0:
        u = _kernel.next_draw(minds, slot)
        place = _own_NAME(weights[:count].copy(), scheme.maker[1], u)
        plan = plans[_position_of(place, count)]
    minds.draws[slot] += 1
    return plan"""


def population_text(
    population: PopulationShape,
    own_maker: bool,
    leaving: Sequence[str] = (),
    indexed: bool = False,
    reconsiders: bool = False,
    lists: Sequence[str] = (),
    number: int | None = None,
) -> str:
    """Return the functions by which compiled rules reach a population.

    Args:
        population: its shape.
        own_maker: whether its minds have a decision maker of the modeller's own.
        leaving: the lines by which an agent that dies leaves the world and its networks.
        indexed: whether an index is kept, by which rules find its agents.
        reconsiders: whether its agents reconsider their plans.
        lists: the lists of its agents in groups that rules ask for.
        number: its number among populations, where its births and deaths are noted.
    """
    name = population.name
    parts = []
    for array, (kind, dimensions) in population_arrays(population).items():
        if array.startswith(("scheme_", "minds_")):
            continue
        parts.append(view_function_text(name, array, kind, dimensions))
    fills = {
        "NEW_MIND": "pass",
        "HATCHED_MIND": "pass",
        "DEAD_MIND": "pass",
        "NEW_HIERARCHY": "pass",
        "HATCHED_HIERARCHY": "pass",
        "DTYPE": dtype_text(row_dtype(dict(population.fields), population)),
    }
    if population.minded:
        for prefix, cls in (("scheme", SchemeArrays), ("minds", MindArrays)):
            views = "".join(
                f"        {view_text(name, f'{prefix}_{array}', *ENGINE_ARRAYS[array])},\n"
                for array in cls._fields
            )
            made = f"_{cls.__name__}(\n{views}    )"
            parts.append(f"@_inner\ndef _{prefix}_{name}(_model):\n    return {made}")
        fills |= {
            "NEW_MIND": (
                f"agent._mind = _kernel.new_mind(_scheme_{name}(_model), _minds_{name}(_model))"
            ),
            "HATCHED_MIND": (
                f"agent._decided = -1\n    agent._mind = _kernel.hatch("
                f"_scheme_{name}(_model), _minds_{name}(_model), _asked_{name}(_model, parent), "
                f"keep_groups)" + _following(name, lists, "    ")
            ),
            "DEAD_MIND": (
                f"_kernel.die(_scheme_{name}(_model), _minds_{name}(_model), agent._mind)"
                + _following(name, lists, "        ")
                + "\n        agent._mind = -1"
            ),
        }
        parts += [text.replace("NAME", name) for text in _decision(own_maker, population.weighed)]
        parts.append(_MINDS.replace("NAME", name))
        if population.steps is not None:
            parts.append(PLAN_STEPS.replace("NAME", name))
        if reconsiders:
            parts.append(reconsidering_text(population, own_maker))
        parts += [
            _command_text(name, command, lists)
            for command, signature in MIND.items()
            if command != "choose_next_plan" and OTHER not in signature.arguments
        ]
    if population.hierarchy:
        fills |= {
            "NEW_HIERARCHY": f"_begin_hierarchy_{name}(_model, slot)",
            "HATCHED_HIERARCHY": f"_copy_hierarchy_{name}(_model, parent._slot, slot)",
        }
    if population.steps is not None:
        fills["HATCHED_MIND"] += f"\n    _begin_plan_{name}(-1, agent)"
    if population.own:
        born = f"born = carray(_as_pointer(_model._{name}_default), (1,), {name}_ROW)[0]"
        lines = [born, *(f"agent.{field} = born.{field}" for field in population.own)]
        fills["HATCHED_MIND"] = "\n    ".join([*lines, fills["HATCHED_MIND"]])
    fills["DEAD_MIND"] = "\n        ".join([*filter(None, leaving), fills["DEAD_MIND"]])
    if indexed:
        fills["DEAD_MIND"] = f"_near_died_{name}(_model, agent)\n        {fills['DEAD_MIND']}"
        for mark in ("NEW_MIND", "HATCHED_MIND"):
            fills[mark] = f"_near_born_{name}(_model, agent)\n    {fills[mark]}"
    if number is not None:
        noted = {
            "NEW_MIND": ("    ", str(events.CREATED)),
            "HATCHED_MIND": ("    ", "parent._id"),
            "DEAD_MIND": ("        ", str(events.DIED)),
        }
        for mark, (indent, parent) in noted.items():
            note = _NOTE.replace("NUMBER", str(number)).replace("PARENT", parent)
            fills[mark] = f"{note}\n{indent}{fills[mark]}"
    if population.messages_to is not None:
        parts.append(_MESSAGES.replace("NAME", name).replace("TO", population.messages_to))
    text = _POPULATION
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return "\n\n\n".join([text.replace("NAME", name), *parts])


def events_text(eventful: Sequence[str]) -> str:
    """Return the functions that note births and deaths.

    Args:
        eventful: the populations whose agents are born or die in ticks.
    """
    most = "\n".join(f"    count += _events.most(_counters_{name}(_model))" for name in eventful)
    return EVENTS.replace("MOST", most)


def _decision(own_maker: bool, weighed: bool) -> list[str]:
    """Return the functions that take a decision."""
    if not own_maker and not weighed:
        return [_DECIDE]
    weigh = WEIGHED if weighed else ""
    steps = _DECIDE_IN_STEPS.replace("    WEIGH\n", f"    {weigh}\n" if weigh else "")
    choose = _CHOOSE_BY_OWN_MAKER if own_maker else _CHOOSE_AMONG
    return [*([_WEIGH] if weighed else []), choose, steps]


_WITH_SCHEME = (
    *("feed_back_from_plan", "create_and_join_group", "join_group", "change_role", "ask_to_join"),
    *("enclose_group", "set_culturon_value", "add_to_culturon_value", "get_culturon_value"),
    *("set_group_attribute", "add_to_group_attribute", "get_group_attribute"),
)


_MOVING = (
    "create_and_join_group",
    "join_group",
    "leave_group",
    "leave_all_groups",
    "ask_to_join",
)
"""The commands after which a mind may be in other groups, or ask to be."""

_WITH_OTHER = """@_inner
def _mind_COMMAND_OTHER_NAME(_model, agent, group, other):
    done = _kernel.COMMAND(
        _minds_NAME(_model), _asked_NAME(_model, agent), group, _asked_OTHER(_model, other)
    )FOLLOWING
    return done"""


def with_other_text(population: str, command: str, other: str, lists: Sequence[str]) -> str:
    """Return what minds of a population do to those of another, whose lists follow."""
    following = _following(other, lists, "    ", "other")
    text = _WITH_OTHER.replace("FOLLOWING", following).replace("COMMAND", command)
    return text.replace("OTHER", other).replace("NAME", population)


def _following(population: str, lists: Sequence[str], indent: str, agent: str = "agent") -> str:
    """Return the lines by which the lists of agents in groups follow what one has done."""
    return "".join(f"\n{indent}_{kind}_follow_{population}(_model, {agent})" for kind in lists)


def _command_text(population: str, command: str, lists: Sequence[str]) -> str:
    arguments = "".join(
        f", {one.part if isinstance(one, Named) else 'value'}" for one in MIND[command].arguments
    )
    scheme = f"_scheme_{population}(_model), " if command in _WITH_SCHEME else ""
    head = f"@_inner\ndef _mind_{command}_{population}(_model, agent{arguments}):\n"
    called = (
        f"_kernel.{command}({scheme}_minds_{population}(_model), "
        f"_asked_{population}(_model, agent){arguments})"
    )
    if not lists or command not in _MOVING:
        return f"{head}    return {called}"
    return f"{head}    done = {called}{_following(population, lists, '    ')}\n    return done"
