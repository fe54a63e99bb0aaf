"""The schedule: which rules run in a tick, in what order, and the tick as interpreted Python.

Within a phase agents come in a fresh random order, one after another, and each sees what the
earlier ones did (NetLogo's `ask`). Those born in a tick act from the next tick on, the dead no
more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import ChoiceError
from socialmind.agents.bookkeeping import COUNT, ENTRIES
from socialmind.errors import RuleError, place_of
from socialmind.society.messages import fill_mailboxes, let_vanish
from socialmind.society.phases import Rule
from socialmind.streams import ORDER_TAG, Stream, shuffle

if TYPE_CHECKING:
    from socialmind.agents.running import Running
    from socialmind.language.program import Phase

    AfterTurn = Callable[[Phase, Any], None]


@contextmanager
def following_rules(model: Any) -> Iterator[None]:
    """Hand out agents and patches as rules hold them, bare, while interpreted rules run."""
    within = model._in_rules
    _hand_out(model, True)
    try:
        yield
    finally:
        _hand_out(model, within)


def _hand_out(model: Any, bare: bool) -> None:
    model._in_rules = bare
    for table in model.tables.values():
        table.hand_out(bare)
    model.ground.hand_out(bare)


def run_setup(model: Running, functions: dict[str, Rule]) -> None:
    """Run the setup of a model in interpreted Python."""
    with following_rules(model):
        for phase in model.program.setup:
            _run(model, functions, phase)
        for phase in model.program.at_birth:
            model.tables[str(phase.shape.population)].counters[COUNT] = 0
        _bear(model, functions)
    _settle(model)


def run_tick(
    model: Running, functions: dict[str, Rule], after_turn: AfterTurn | None = None
) -> None:
    """Run one tick of a model in interpreted Python.

    Args:
        model: the society.
        functions: its rules.
        after_turn: called after each turn with the phase and who had it, None for the model.
    """
    with following_rules(model):
        model.ground.run_tick(functions, lambda: _run_schedule(model, functions, after_turn))
        _bear(model, functions)
    _settle(model)
    model.context["_tick"] += 1


def _run_schedule(model: Running, functions: dict[str, Rule], after_turn: AfterTurn | None) -> None:
    for phase in model.program.schedule:
        _run(model, functions, phase, after_turn)


def _run(
    model: Running, functions: dict[str, Rule], phase: Phase, after_turn: AfterTurn | None = None
) -> None:
    stream = Stream(model.seed)
    rule = functions[phase.symbol]
    if phase.shape.population is None:
        stream.begin(phase.tag, 0, model.tick)
        _follow(model, rule, phase, None, stream)
        if after_turn is not None:
            after_turn(phase, None)
        return
    table = model.tables[phase.shape.population]
    acting = table.acting_order
    if phase.shape.shuffled:
        stream.begin(ORDER_TAG, phase.tag, model.tick)
        shuffle(stream, acting, len(acting))
    for slot in acting.tolist():
        if table.alive[slot]:
            agent = table.row_class(table, slot)
            stream.begin(phase.tag, agent.id, model.tick)
            _follow(model, rule, phase, agent, stream)
            if after_turn is not None:
                after_turn(phase, agent)


def _bear(model: Running, functions: dict[str, Rule]) -> None:
    """Let all that came into being follow the rule at birth, and those that it brings."""
    stream = Stream(model.seed)
    again = True
    while again:
        again = False
        for phase in model.program.at_birth:
            table = model.tables[str(phase.shape.population)]
            while table.counters[COUNT] < table.counters[ENTRIES]:
                slot = int(table.order[table.counters[COUNT]])
                table.counters[COUNT] += 1
                again = True
                if table.alive[slot]:
                    agent = table.row_class(table, slot)
                    stream.begin(phase.tag, agent.id, model.tick)
                    _follow(model, functions[phase.symbol], phase, agent, stream)


def _follow(model: Running, rule: Rule, phase: Phase, agent: Any, stream: Stream) -> None:
    """Let an agent, or the model, follow a rule; what fails is said with its place."""
    try:
        rule(*taken(phase.takes, agent, model, stream).values())
    except MemoryError:
        raise  # of no rule's doing, nor of one agent
    except Exception as error:
        if agent is None:
            who = f"the model's rule {phase.shape.rule.__name__!r}"
        else:
            who = f"agent {agent.id} of {phase.shape.population!r}"
        what = f"{type(error).__name__}: {error}"
        place = place_of(error)
        if isinstance(error, ChoiceError):  # what is wrong is not where the decision was asked for
            what, place = error.found, error.place
        raise RuleError(what, place, model.tick, who) from error


def taken(takes: tuple[str, ...], agent: Any, model: Running, rng: Stream) -> dict[str, Any]:
    """Return those of agent, model and stream that a rule takes, in its order."""
    values = {"agent": agent, "model": model, "rng": rng}
    return {name: values[name] for name in takes}


def _settle(model: Running) -> None:
    for name in model.conditioned:
        model.tables[name].heed_conditions()
    let_vanish(model.tables)
    for table in model.tables.values():
        table.settle()
    fill_mailboxes(model.tables)
