"""What failed in a compiled evaluation of many agents, as errors that name it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from socialmind.errors import ModelError, written_at
from socialmind.mind.modules import Skill, Variable


def failure_of(skill: Skill, agent: int, nodes: Any) -> ModelError:
    """Return the error of a programmed function that failed.

    Args:
        skill: the skill.
        agent: the number of the agent.
        nodes: the agent's nodes, which begin with the function's inputs.
    """
    program: Any = skill.function
    inputs = nodes[: len(skill.inputs)].tolist()
    try:
        found = program.function(inputs) if program.takes_array else program.function(*inputs)
        what = f"gave {found!r}"
    except Exception as error:  # whatever the author's function raises
        what = f"failed with {type(error).__name__}: {error}"
    return skill.refused(
        f"of agent {agent}, whose function {program.name}() {what} for the inputs {inputs}",
        "numbers, 0 … 1",
    )


def failure_of_regulation(variable: Variable, agent: int) -> ModelError:
    """Return the error of a variable's regulation that failed."""
    regulation: Any = variable.regulation
    return ModelError(
        f"no number from {regulation.function.__name__}(), the regulation of the variable "
        f"{variable.name!r}, for agent {agent}",
        "a number, 0 … 1",
        None,
        variable.file,
        variable.line,
    )


def failure_of_drive(drive: Callable[..., None] | None, agent: int) -> ModelError:
    """Return the error of a drive that failed."""
    return ModelError(
        f"the drive {getattr(drive, '__name__', drive)!r} failed for agent {agent}",
        None,
        "a Hierarchy with this agent's sensors and variables shows why",
        *written_at(drive),
    )
