"""The schedule: which rules run in a tick, in what order, and the tick as interpreted Python.

Within a phase agents come in a fresh random order, one after another, and each sees what the
earlier ones did (NetLogo's `ask`). Those born in a tick act from the next tick on, the dead no
more.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.errors import ChoiceError
from socialmind.errors import ModelError, RuleError
from socialmind.language.shape import PhaseShape
from socialmind.population import Population
from socialmind.streams import ORDER_TAG, Stream, shuffle

if TYPE_CHECKING:
    from socialmind.language.program import Phase
    from socialmind.model import Model

Rule = Callable[..., Any]


class PhaseDeclaration:
    """One entry of a model's schedule; `each` and `once` make them."""

    def __init__(self, rule: Rule, population: Population | None, shuffled: bool) -> None:
        self.rule = rule
        self.population = population
        self.shuffled = shuffled

    @property
    def shape(self) -> PhaseShape:
        """The phase, with its population by name."""
        name = None if self.population is None else self.population.name
        return PhaseShape(self.rule, name, self.shuffled)

    def __str__(self) -> str:
        if self.population is None:
            return f"once: {self.rule.__name__}"
        order = "random order" if self.shuffled else "order of birth"
        return f"each of {self.population.name}, {order}: {self.rule.__name__}"


def each(population: Population, rule: Rule, *, shuffled: bool = True) -> PhaseDeclaration:
    """Declare a phase in which each agent of a population follows a rule.

    Args:
        population: the population, as declared in the same class.
        rule: a plain function `rule(agent, model, rng)`; it may leave out `model` and `rng`.
        shuffled: a fresh random order each tick (NetLogo's), or the order of birth.
    """
    if not isinstance(population, Population):
        raise ModelError(
            f"each({population!r}, …)", "a population of the class", "write each(humans, rule)"
        )
    return PhaseDeclaration(rule, population, shuffled)


def once(rule: Rule) -> PhaseDeclaration:
    """Declare a phase in which a rule runs once a tick.

    Args:
        rule: a plain function `rule(model, rng)`; it may leave out `rng`.
    """
    return PhaseDeclaration(rule, None, False)


def run_setup(model: Model, functions: dict[str, Rule]) -> None:
    """Run the setup of a model in interpreted Python."""
    with model.following_rules():
        for phase in model.program.setup:
            _run(model, functions, phase)
    _settle(model)


def run_tick(model: Model, functions: dict[str, Rule]) -> None:
    """Run one tick of a model in interpreted Python."""
    with model.following_rules():
        if model.arena is None:
            _run_schedule(model, functions)
        else:
            _run_plane(model, functions)
    _settle(model)
    model.context["_tick"] += 1


def _run_schedule(model: Model, functions: dict[str, Rule]) -> None:
    for phase in model.program.schedule:
        _run(model, functions, phase)


def _run_plane(model: Model, functions: dict[str, Rule]) -> None:
    """Run a tick on a plane, on which nothing happens any more after an interruption."""
    from socialmind.worlds.plane.interpreted import before_minds, settle_rewards, think

    over = model.over
    if over is None:
        before_minds(model, functions)
    if model.over is None:
        think(model)
        _run_schedule(model, functions)
        if model.arena is not None and model.arena.shifting:
            model.arena.build()
    settle_rewards(model, functions, model.over != over)


def _run(model: Model, functions: dict[str, Rule], phase: Phase) -> None:
    stream = Stream(model.seed)
    rule = functions[phase.symbol]
    if phase.shape.population is None:
        stream.begin(phase.tag, 0, model.tick)
        _follow(model, rule, phase, None, stream)
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


def _follow(model: Model, rule: Rule, phase: Phase, agent: Any, stream: Stream) -> None:
    """Let an agent, or the model, follow a rule; what fails is said with its place."""
    try:
        rule(*taken(phase.takes, agent, model, stream).values())
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


def place_of(error: Exception, place: str = "in a rule") -> str:
    """Return the last line of the author's that an error went through, or else `place`."""
    library = Path(__file__).parent
    for frame in traceback.extract_tb(error.__traceback__):
        inside = library in Path(frame.filename).parents
        if not inside and "coglogo_py" not in Path(frame.filename).parts:
            place = f"{frame.filename}:{frame.lineno}"
    return place


def taken(takes: tuple[str, ...], agent: Any, model: Model, rng: Stream) -> dict[str, Any]:
    """Return those of agent, model and stream that a rule takes, in its order."""
    values = {"agent": agent, "model": model, "rng": rng}
    return {name: values[name] for name in takes}


def _settle(model: Model) -> None:
    for table in model.tables.values():
        table.settle()
