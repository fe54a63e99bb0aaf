"""Random minds: hierarchies of skills over sensors, variables and actuators, from a seed."""

import random
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray
from random_functions import random_function, random_regulation

from socialmind.mind import (
    Actuator,
    Input,
    MindDescription,
    Output,
    Regulation,
    Sensor,
    Skill,
    Variable,
)
from socialmind.mind.functions.contract import InternalFunction

WORDS = (
    "Avoid",
    "GoTo",
    "zoom",
    "Object",
    "a",
    "Z",
    "Search+Avoid",
    "_claw",
    "Éviter",
    "drop zone",
)
MASTER = "Master of it"
T = TypeVar("T")


def random_mind(
    draw: random.Random,
    skills: int = 60,
    depth: int = 8,
    memory: bool = True,
    programs: bool = True,
    group: str | None = None,
) -> MindDescription:
    """Return a mind whose skill `MASTER` reaches all others.

    Args:
        draw: what to draw from; `random.Random(seed)` for a mind from a seed.
        skills: at most so many skills.
        depth: at most so many levels of skills.
        memory: whether networks that remember may be among the functions.
        programs: whether programmed functions and regulations may; each set of them is compiled.
        group: the group that shares some of the variables; None for none.
    """
    levels = _levels(draw, draw.randint(1, skills), draw.randint(1, depth))
    sensors = [Sensor(name) for name in _names(draw, "SE", draw.randint(1, 12))]
    actuators = [
        Actuator(name, neutral=draw.choice([0.5, 0.0, 1.0, draw.random()]))
        for name in _names(draw, "MO", draw.randint(1, 6))
    ]
    variables = [
        _variable(draw, name, random_regulation(draw, programs), group)
        for name in _names(draw, "V", draw.randint(0, 6))
    ]
    read = [module.name for module in sensors], [module.name for module in variables]
    written = [Output("MO", module.name) for module in actuators]
    written += [Output("VA", module.name) for module in variables]
    children = _children(draw, levels)
    made = []
    for name, below in children.items():
        outputs = [Output("SK", child) for child in below]
        if not below or draw.random() < 0.3:
            outputs += draw.sample(written, draw.randint(1, min(4, len(written))))
        draw.shuffle(outputs)
        inputs = _inputs(draw, *read)
        function = random_function(draw, len(inputs), len(outputs), memory, programs)
        made.append(_skill(draw, name, inputs, outputs, function))
    return MindDescription("random", sensors, actuators, variables, made)


def _skill(
    draw: random.Random,
    name: str,
    inputs: list[Input],
    outputs: list[Output],
    function: InternalFunction,
) -> Skill:
    network = function.network(len(inputs), len(outputs))
    if network is None:
        return Skill(name, inputs, outputs, function)
    # What is fed back must not grow, or rounding would.
    scale = 0.3 if network.memory else draw.choice([0.3, 1.0, 1.0, 2.0])
    genome = [draw.uniform(-scale, scale) + scale / 8 for _ in range(network.genome_size)]
    return Skill(name, inputs, outputs, function, genome)


def _names(draw: random.Random, prefix: str, count: int) -> list[str]:
    """Return names whose order has nothing to do with their modules' places."""
    names = [f"{draw.choice(WORDS)} {prefix}{number}" for number in range(count)]
    draw.shuffle(names)
    return names


def _levels(draw: random.Random, skills: int, depth: int) -> list[list[str]]:
    """Return the names of skills level by level, the master alone above; none is empty."""
    names = _names(draw, "", skills - 1)
    depth = min(depth, skills)
    levels: list[list[str]] = [[MASTER], *([] for _ in range(depth - 1))]
    for number, name in enumerate(names[: depth - 1], 1):
        levels[number].append(name)
    if depth > 1:
        for name in names[depth - 1 :]:
            levels[draw.randint(1, depth - 1)].append(name)
    else:
        levels[0] = [MASTER]
    return levels


def _children(draw: random.Random, levels: Sequence[Sequence[str]]) -> dict[str, list[str]]:
    """Give each skill parents: one a level above it, and up to three from any level above."""
    children: dict[str, list[str]] = {name: [] for level in levels for name in level}
    for number, level in enumerate(levels[1:], 1):
        above = [name for upper in levels[:number] for name in upper]
        for name in level:
            parents = [draw.choice(levels[number - 1])]
            parents += draw.sample(above, min(draw.choice([0, 0, 1, 2, 3]), len(above)))
            for parent in dict.fromkeys(parents):
                children[parent].append(name)
    return children


def _variable(
    draw: random.Random, name: str, regulation: Regulation, group: str | None
) -> Variable:
    default = None
    if regulation.keyword == "CounterVariableModule":
        default = draw.choice([None, 1.0, 0.0])
    elif regulation.keyword != "TickWaveSinVariableModule":
        default = draw.choice([None, draw.random()])
    shared = group if draw.random() < 0.6 else None
    return Variable(name, regulation, default, shared)


def _inputs(draw: random.Random, sensors: Sequence[str], variables: Sequence[str]) -> list[Input]:
    inputs = []
    for _ in range(draw.choice([0, 1, 1, 2, 2, 3, 4, 6])):
        module, names = ("V", variables) if variables and draw.random() < 0.4 else ("S", sensors)
        codes = {"V": ("VA", "VA", "VD", "VH"), "S": ("SE", "SE", "SD", "SH")}[module]
        code = draw.choice(codes)
        inputs.append(Input(code, draw.choice(names), draw.randint(1, 12) if code[1] == "H" else 0))
    return inputs


def shuffled(description: MindDescription, draw: random.Random) -> MindDescription:
    """Return the same mind, its modules declared in another order."""

    def mixed(modules: Mapping[str, T]) -> list[T]:
        return draw.sample(list(modules.values()), len(modules))

    return MindDescription(
        description.name,
        mixed(description.sensors),
        mixed(description.actuators),
        mixed(description.variables),
        mixed(description.skills),
    )


def sensor_values(
    description: MindDescription, draw: random.Random, ticks: int
) -> Iterator[dict[str, float]]:
    """Yield a value for each sensor, tick by tick: slow changes, jumps, and the very bounds.

    The order in which sensors are declared makes no difference to it.
    """
    values = {name: draw.random() for name in sorted(description.sensors)}
    for _ in range(ticks):
        for name in values:
            values[name] = draw.choice(
                [
                    values[name],
                    min(1.0, max(0.0, values[name] + draw.uniform(-0.1, 0.1))),
                    draw.random(),
                    draw.choice([0.0, 1.0]),
                ]
            )
        yield dict(values)


def bits(table: Mapping[Any, float]) -> list[tuple[str, str]]:
    """Return a table of numbers such that equal means equal to the last bit."""
    return sorted((str(name), float(value).hex()) for name, value in table.items())


def other_genomes(
    description: MindDescription, draw: random.Random
) -> Mapping[str, NDArray[np.float64]]:
    """Return other weights for each skill that has any."""
    return {
        name: np.array([weight + draw.uniform(-0.1, 0.1) for weight in skill.genome])
        for name, skill in description.skills.items()
        if skill.genome is not None
    }


def minds(skills: int = 8, depth: int = 4, memory: bool = True) -> st.SearchStrategy:
    """Small random minds for hypothesis."""
    draws = st.randoms(use_true_random=False)
    return st.builds(random_mind, draws, st.integers(1, skills), st.integers(1, depth),
                     st.just(memory))  # fmt: skip
