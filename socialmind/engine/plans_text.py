"""How compiled rules carry plans out, begin them and let others take over, as text."""

from __future__ import annotations

from socialmind.language.plan_calls import TypedPlans
from socialmind.language.plans import PlanSteps
from socialmind.language.shape import PopulationShape
from socialmind.language.types import NONE

PLAN_STEPS = """from socialmind.agents import plan_steps as _plan_steps


@_inner
def _begin_plan_NAME(plan, agent):
    agent._plan = plan
    agent._step = _plan_steps.BEGUN if plan >= 0 else _plan_steps.ENDED"""

_RECONSIDER = """from socialmind.agents.plan_steps import outweighed as _outweighed


@_inner
def _reconsider_plan_NAME(_model, agent, factor):
    if not factor >= 1.0:
        raise ValueError("reconsider_plan() wants a factor of 1 or more")
    slot = _asked_NAME(_model, agent)
    before = agent._plan
    if before < 0ENDED:
        plan = _mind_choose_next_plan_NAME(_model, agent)
    else:
        scheme = _scheme_NAME(_model)
        minds = _minds_NAME(_model)
        weights = _weights_NAME(_model)
        plans = _plans_NAME(_model)
        count = _kernel.available_weights(scheme, minds, slot, weights, plans)
        WEIGH
        if not _outweighed(weights, plans, count, before, factor):
            return False
        plan = CHOOSE(scheme, minds, slot, weights, plans, count)
        agent._decided = _model._tick
        if plan == before:
            return False
    BEGIN
    return plan >= 0"""

WEIGHED = "_weigh_NAME(_model, agent, slot, minds, weights, plans, count)"
"""What lets a hierarchy weigh the plans."""


def reconsidering_text(population: PopulationShape, own_maker: bool) -> str:
    """Return the function in which another plan may take over from the one that goes on."""
    in_steps = own_maker or population.weighed
    fills = {
        "        WEIGH\n": f"        {WEIGHED}\n" if population.weighed else "",
        "CHOOSE": "_choose_NAME" if in_steps else "_kernel.choose_among",
        "ENDED": " or agent._step < 0" if population.steps is not None else "",
        "BEGIN": "agent._plan = plan"
        if population.steps is None
        else "_begin_plan_NAME(plan, agent)",
    }
    text = _RECONSIDER
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text.replace("NAME", population.name)


def call_text(symbol: str, takes: tuple[str, ...]) -> str:
    """Return the call of a rule with those of agent, model and stream that it takes."""
    values = {"agent": "agent", "model": "_model", "rng": "rng"}
    return f"{symbol}({', '.join(['_model', *(values[one] for one in takes)])})"


def plans_text(population: str, plans: TypedPlans) -> str:
    """Return the dispatcher that carries out an agent's plan, or goes on in it."""
    if plans.steps is not None:
        return _steps_text(population, plans, plans.steps)
    lines = [
        f"@_inner\ndef _run_plan_{population}(_model, agent, rng):",
        "    plan = agent._plan",
        "    if plan < 0:",
        "        return",
        f"    function = _functions_{population}(_model)[plan]",
    ]
    for place, call in enumerate(plans.calls):
        word = "if" if place == 0 else "elif"
        lines += [
            f"    {word} function == {place}:",
            f"        {call_text(call.symbol, call.takes)}",
        ]
    return "\n".join(lines)


_RUN_STEPS = """STEPS_NAME = np.array(STEPS)
ENTRIES_NAME = np.array(ENTRIES)


CALLS


@_inner
def _run_plan_NAME(_model, agent, rng):
    step = agent._step
    if agent._plan < 0 or step < 0:
        return
    if step == _plan_steps.BEGUN:
        step = ENTRIES_NAME[_functions_NAME(_model)[agent._plan]]
    acted = False
    idle = False
    while True:
        step = _plan_steps.followed(STEPS_NAME, step, agent._rounds, idle)
        agent._step = step
        if step < 0 or acted or STEPS_NAME[step, _plan_steps.KIND] == _plan_steps.BACK:
            return
        answer = _plan_call_NAME(_model, agent, rng, STEPS_NAME[step, _plan_steps.CALL])
        if agent._step != step:  # it took up another plan, or gave this one up
            return
        kind = STEPS_NAME[step, _plan_steps.KIND]
        acted = kind == _plan_steps.ACT
        idle = idle or (kind == _plan_steps.UNTIL and answer == 0)
        step = _plan_steps.answered(STEPS_NAME, step, agent._rounds, answer)"""


def _steps_text(population: str, plans: TypedPlans, steps: PlanSteps) -> str:
    """Return how agents go on in plans that are trees; interpreted it is `plan_steps.carry_on`."""
    lines = ["@_inner", "def _plan_call_NAME(_model, agent, rng, call):"]
    for place, call in enumerate(plans.calls):
        called = call_text(call.symbol, call.takes)
        lines.append(f"    if call == {place}:")
        if call.result == NONE:
            lines += [f"        {called}", "        return 1"]
        else:
            lines.append(f"        return int({called})")
    lines.append("    return 0")
    entries = [steps.entries[name] for name in plans.names]
    fills = {
        "STEPS)": f"{steps.steps})",
        "ENTRIES)": f"{entries})",
        "CALLS": "\n".join(lines),
        "NAME": population,
    }
    text = _RUN_STEPS
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text
