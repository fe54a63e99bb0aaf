"""Plans as trees: actions that go on over ticks, in turn, again and again, or by a condition.

An action is a rule. One that returns nothing takes a tick; one that returns a truth value is
carried out in each tick until it returns True. Conditions are functions that return a truth value;
they cost no tick. A tree is laid out as a list of steps, and where an agent stands in it is the
number of one of them (`agents.plan_steps` says how an agent goes on).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError, called_at

Rule = Callable[..., Any]

END, ACT, TEST, UNTIL, COUNT, TIMES, AGAIN, BACK, JUMP = range(9)
"""The kinds of steps: the plan's end; an action; a condition; the condition before a round of
`until`; a number of rounds, written or asked of a function; behind a round of `repeat`, and of
`until`; on to another step."""
KIND, CALL, TARGET, DEPTH = range(4)
"""What a step holds: its kind; the number of the function that it calls, or of rounds; where it
goes on if not at the next step; how many `repeat` are around it."""


@dataclass(frozen=True)
class PlanTree:
    """A plan of several parts; `sequence`, `repeat`, `until` and `when` make them."""

    parts: tuple[Any, ...]


@dataclass(frozen=True)
class Repeated(PlanTree):
    """Parts that are carried out so many times."""

    times: Any


@dataclass(frozen=True)
class Until(PlanTree):
    """Parts that are carried out until a condition holds."""

    condition: Rule


@dataclass(frozen=True)
class Branch(PlanTree):
    """One part or another (or nothing), as a condition says."""

    condition: Rule


def sequence(*parts: Any) -> PlanTree:
    """Carry parts out one after another.

    Args:
        parts: actions (rules) and further trees.

    >>> def sow(farmer): ...
    >>> def reap(farmer): ...
    >>> [part.__name__ for part in sequence(sow, reap).parts]
    ['sow', 'reap']
    """
    return PlanTree(_checked("sequence", parts))


def repeat(times: int | Rule, *parts: Any) -> PlanTree:
    """Carry parts out so many times, all of them in order each time.

    Args:
        times: a whole number, 0 or more, or a function of the agent (`model`, `rng`) that returns
            one; it is asked when the repetition begins.
        parts: actions (rules) and further trees.
    """
    if not callable(times) and not (is_whole(times) and times >= 0):
        _refuse(f"repeat({shown(times)}, …)", "a whole number, 0 or more, or a function", None)
    return Repeated(_checked("repeat", parts), times)


def until(condition: Rule, *parts: Any) -> PlanTree:
    """Carry parts out again and again, until a condition holds; it is asked before each round.

    A round in which nothing was done takes a tick.

    Args:
        condition: a function of the agent (`model`, `rng`) that returns True or False.
        parts: actions (rules) and further trees.
    """
    return Until(_checked("until", parts), _condition("until", condition))


def when(condition: Rule, then: Any, otherwise: Any = None) -> PlanTree:
    """Carry one part out if a condition holds, and another, or nothing, if not.

    Args:
        condition: a function of the agent (`model`, `rng`) that returns True or False.
        then: an action (a rule) or a tree.
        otherwise: likewise; None to go on at once.
    """
    parts = _checked("when", (then,) if otherwise is None else (then, otherwise))
    return Branch(parts, _condition("when", condition))


def _checked(name: str, parts: tuple[Any, ...]) -> tuple[Any, ...]:
    if not parts:
        _refuse(f"{name}(…) without parts", "actions, which are rules, and further trees", None)
    for part in parts:
        if not callable(part) and not isinstance(part, PlanTree):
            remedy = "name the function, without ()" if part is None else None
            _refuse(f"{shown(part)} in {name}(…)", "an action, which is a rule, or a tree", remedy)
    return parts


def _condition(name: str, condition: Any) -> Any:
    if not callable(condition):
        expected = "a function that returns True or False"
        _refuse(f"{shown(condition)} as the condition of {name}(…)", expected, "leave out its ()")
    return condition


def _refuse(found: str, expected: str, remedy: str | None) -> None:
    raise ModelError(found, expected, remedy, *called_at())


class Call(NamedTuple):
    """A function that a step calls: the function, and what it is: a kind of step."""

    function: Rule
    kind: int


@dataclass
class PlanSteps:
    """The plans of a population, laid out as steps.

    Attributes:
        calls: the functions that steps call, each once for each kind of step.
        steps: kind, call, target and depth of each; the first is nobody's.
        entries: by plan, the number of its first step.
        depth: how many `repeat` are inside one another at most, at least 1.
    """

    calls: list[Call] = field(default_factory=list)
    steps: list[list[int]] = field(default_factory=lambda: [[END, 0, 0, 0]])
    entries: dict[str, int] = field(default_factory=dict)
    depth: int = 1

    @cached_property
    def array(self) -> NDArray[np.int64]:
        """The steps as an array, once all are laid out."""
        return np.array(self.steps, np.int64)

    def name(self, step: int) -> str:
        """Return what is done next at a step: the name of its function, or of the next one."""
        while self.steps[step][KIND] not in (ACT, TEST, UNTIL, TIMES):
            kind, _, target, _ = self.steps[step]
            step = target if kind in (AGAIN, BACK, JUMP) else step + 1
        return str(self.calls[self.steps[step][CALL]].function.__name__)

    def _call(self, function: Rule, kind: int) -> int:
        call = Call(function, kind)
        if call not in self.calls:
            self.calls.append(call)
        return self.calls.index(call)

    def _step(self, kind: int, call: int = 0, target: int = 0, depth: int = 0) -> list[int]:
        self.steps.append([kind, call, target, depth])
        return self.steps[-1]

    def lay_out(self, part: Any, depth: int = 0) -> None:
        """Append the steps of an action or a tree."""
        if not isinstance(part, PlanTree):
            self._step(ACT, self._call(part, ACT))
        elif isinstance(part, Branch):
            test = self._step(TEST, self._call(part.condition, TEST))
            self.lay_out(part.parts[0], depth)
            if len(part.parts) > 1:
                jump = self._step(JUMP)
                test[TARGET] = len(self.steps)
                self.lay_out(part.parts[1], depth)
                jump[TARGET] = len(self.steps)
            else:
                test[TARGET] = len(self.steps)
        elif isinstance(part, Until):
            head = len(self.steps)
            test = self._step(UNTIL, self._call(part.condition, UNTIL))
            self._all(part, depth)
            self._step(BACK, target=head)
            test[TARGET] = len(self.steps)
        elif isinstance(part, Repeated):
            self.depth = max(self.depth, depth + 1)
            asked = callable(part.times)
            number = self._call(part.times, TIMES) if asked else int(part.times)
            begin = self._step(TIMES if asked else COUNT, number, depth=depth)
            head = len(self.steps)
            self._all(part, depth + 1)
            self._step(AGAIN, target=head, depth=depth)
            begin[TARGET] = len(self.steps)
        else:
            self._all(part, depth)

    def _all(self, tree: PlanTree, depth: int) -> None:
        for part in tree.parts:
            self.lay_out(part, depth)


def goes_on(plans: Mapping[str, Any]) -> bool:
    """Say whether some plan is a tree, so that agents stand somewhere in their plans."""
    return any(isinstance(plan, PlanTree) for plan in plans.values())


def steps_of(plans: Mapping[str, Any]) -> PlanSteps:
    """Return the plans of a population as steps."""
    made = PlanSteps()
    for plan, part in plans.items():
        made.entries[plan] = len(made.steps)
        made.lay_out(part)
        made._step(END)
    return made


def functions_of(plan: Any) -> Iterator[Rule]:
    """Yield the functions of a plan, conditions included, in the order in which they stand."""
    if not isinstance(plan, PlanTree):
        yield plan
        return
    for asked in ("condition", "times"):
        if callable(getattr(plan, asked, None)):
            yield getattr(plan, asked)
    for part in plan.parts:
        yield from functions_of(part)
