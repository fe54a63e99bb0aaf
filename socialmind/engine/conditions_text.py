"""How compiled rules bring minds up to date with the conditions of their scheme, as text.

`agents.heeding` is the interpreted twin. Which conditions there are is data; that there are some
is part of the module.
"""

from __future__ import annotations

from socialmind.agents.heeding import comparable
from socialmind.compiling.layout import CONDITIONS, view_function_text
from socialmind.fields import presence
from socialmind.language.shape import PopulationShape

ASKED = """@_inner
def _asked_NAME(_model, agent):
    if agent._mind < 0:
        raise ValueError("the mind of an agent that is dead")
    return agent._mind"""
"""What gives the place of a mind that is asked something."""

_HEEDING = """from coglogo_py.conditions import heeding as _heeding


@_inner
def _heed_NAME(_model, agent):
    conditions = _conditions_NAME(_model)
    sides = _sides_NAME(_model)
    for row in range(conditions.shape[0]):
        sides[row, 0] = _field_of_NAME(agent, conditions[row, _heeding.FIELD])
    _heeding.heed(conditions, sides, _minds_NAME(_model).values, agent._mind)


@_inner
def _asked_NAME(_model, agent):
    if agent._mind < 0:
        raise ValueError("the mind of an agent that is dead")
    _heed_NAME(_model, agent)
    return agent._mind


@_inner
def _heed_all_NAME(_model):
    order = _order_NAME(_model)
    alive = _alive_NAME(_model)
    rows = _rows_NAME(_model)
    for place in range(_entries_NAME(_model)):
        slot = order[place]
        if alive[slot]:
            _heed_NAME(_model, rows[slot])"""


def heeding_text(population: PopulationShape) -> str:
    """Return the functions by which the minds of a population heed their conditions."""
    name = population.name
    views = [view_function_text(name, array, *kind) for array, kind in CONDITIONS.items()]
    lines = [f"@_inner\ndef _field_of_{name}(agent, code):"]
    for code, field in enumerate(comparable(population.fields)):
        value = f"agent.{field.name}"
        value = f"(1.0 if {value} else 0.0)" if field.kind is bool else f"float({value})"
        if field.optional:
            value = f"{value} if agent.{presence(field.name)} else np.nan"
        lines += [f"    if code == {code}:", f"        return {value}"]
    lines.append("    return np.nan")
    return "\n\n\n".join([*views, "\n".join(lines), _HEEDING.replace("NAME", name)])
