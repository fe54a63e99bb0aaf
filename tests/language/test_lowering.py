"""Compiled modules of odd shapes: names that might meet others, fields of every kind everywhere."""

# ruff: noqa: RUF012  # the defaults of array fields are lists

import math
import struct

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter
from socialmind.compiling.lowering import lowered
from socialmind.engine.module_text import module_text


class Odd(Agent):
    ndim: float = 1.0
    base: int = 2
    real: bool = False
    größe: float = 3.0
    T: int = 0
    count: np.int32 = 5
    flags: list[bool] = [True, False, True]
    last: float | None = None


class Other(Agent):
    last: int | None = 4
    level: list[int] = [1, 2, 3]


class Ground(Patch):
    marks: list[bool] = [False, False]
    heights: list[float] = [0.5, 1.5, 2.5]
    last: bool | None = None


HOLE = -math.nan
HOLES = (math.nan, HOLE, -0.0, -math.inf)
SCHEME = CognitiveScheme("one", (Cogniton("Want", start_value=1.0, influence={"go": 1.0}),))


def go(agent, model, rng):
    agent.ndim += rng.random()


def act(model, rng):  # the agent is called model here
    model.ndim = model.ndim * 2 + rng.random()
    model.größe += model.ndim
    model.T += model.base
    model.count += 1
    model.real = not model.real
    model.flags[model.base % 3] = model.real
    if model.last is None:
        model.last = model.ndim
    else:
        model.last += 1
    flags = 0
    for flag in model.flags:
        if flag:
            flags += 1
    model.base = flags + sum(model.flags)
    if max(model.flags) and not min(model.flags):
        model.T += 100
    model.plan = model.mind.choose_next_plan()


def carry_on(agent, model, rng):
    agent.run_plan(model, rng)
    for other in model.order:
        other.level[agent.id % 3] += 1
        if other.last is not None:
            other.last += agent.base
    model.seen[agent.id % 2] = not model.seen[agent.id % 2]
    model.sums[agent.id % 3] += agent.ndim
    model.steps_taken += 1
    model.agent[0].T += 1
    if model.first is None:
        model.first = agent.id
    here = model.world.patch(agent.x, agent.y)
    here.marks[agent.id % 2] = True
    here.heights[-1] += 0.25
    if here.last is None:
        here.last = agent.real
    else:
        known = here.last
        here.last = not known
    agent.flags[0] = here.marks[0] and model.seen[1]
    for place in range(4):
        model.holes[place] = HOLES[place]
    model.holes[4] = HOLE


def wait(model):
    np = 3
    _ = 0
    for place in range(4):
        for _ in range(2):
            np += place
    model.steps_taken += np


class OddModel(Model):
    rate: float = parameter(1.5)
    steps_taken: int = 0
    first: int | None = None
    seen: list[bool] = [True, False]
    sums: list[float] = [0.0, 0.0, 0.0]
    holes: list[float] = [0.0] * 5
    agent = Population(Odd, 4, mind=SCHEME, plans={"go": go})
    order = Population(Other, 3)
    world = Torus(5, Ground)
    schedule = (each(agent, act), each(agent, carry_on), once(wait))


class Bare(Model):
    """No agents, no world, no rules."""


class WithoutAgents(Model):
    count: int = 0
    herd = Population(Other, 0)
    schedule = (once(wait),)
    steps_taken: int = 0


def test_odd_names_and_fields_run_alike(speeds):
    fast, slow = speeds.watched(OddModel(2)), OddModel(2, compiled=False)
    for model in (fast, slow):
        model.advance(6)
    assert fast._met == []
    assert not speeds.differences(fast, slow)
    assert list(fast.seen) == list(slow.seen)
    nan, minus_zero = struct.pack("d", math.nan), struct.pack("d", -0.0)
    written = [nan, nan, minus_zero, struct.pack("d", -math.inf), nan]
    for model in (fast, slow):  # bytes: what a table holds is compared with these
        assert [struct.pack("d", one) for one in model.holes] == written
    assert fast.agent.flags.dtype == bool
    assert fast.world.marks.any()


@pytest.mark.parametrize("cls", [Bare, WithoutAgents])
def test_models_with_little_in_them(cls, speeds):
    fast, slow = cls(1), cls(1, compiled=False)
    for model in (fast, slow):
        model.advance(5)
    assert fast.tick == slow.tick == 5
    assert not speeds.differences(fast, slow)


def test_the_text_depends_on_rules_and_fields_alone():
    text = module_text(OddModel.typed(), frozenset())
    assert text == module_text(OddModel.typed(), frozenset())
    assert "1.5" not in text.partition("def _do_act")[2].partition("\n\n\n")[0]  # no parameter
    assert "go" not in text.partition("def _do_act")[2].partition("\n\n\n")[0]  # no plan's name


def test_a_lowered_function_reads_records():
    functions = OddModel.typed().functions
    text = lowered(next(one for one in functions.values() if one.source.name == "wait"))
    assert text.splitlines()[0] == "def _do_wait(_model, model):"
    assert text.splitlines()[-1] == ("    _model.steps_taken = _add_int(_model.steps_taken, np)")
