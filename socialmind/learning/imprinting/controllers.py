"""Controllers: what steers an agent through an episode, called with inputs at each tick.

A skill, a hierarchy or a plain function serves as the source of an imprint; each is made into the
same thing here: called with the inputs of a skill in order, it gives its outputs in order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.errors import ModelError
from socialmind.mind import Hierarchy, MindDescription, Skill

Source = Skill | Hierarchy | Callable[[NDArray[np.float64]], Any]
"""What a target learns from: a skill with its function and genome, a hierarchy, which draws by the
seed of each episode, or a function that is called with an array of the inputs; where it has a
method `reset`, an episode begins with it."""


class Controller(Protocol):
    """What steers an agent."""

    def reset(self, seed: int = 0) -> None:
        """Begin an episode: nothing is remembered, and what is drawn follows from its seed."""

    def __call__(self, inputs: Sequence[float] | NDArray[Any]) -> NDArray[np.float64]:
        """Return the outputs, 0 … 1, for inputs, 0 … 1."""


def controller_of(source: Source, skill: Skill) -> Controller:
    """Return a source as a controller over the inputs and outputs of a skill.

    Args:
        source: a skill of as many inputs and outputs; a hierarchy over the sensors that the skill
            reads, which commands its actuators; or a function of an array.
        skill: the skill.

    Raises:
        ModelError: the source has other inputs or outputs.
    """
    if isinstance(source, Skill):
        found, expected = (
            f"{len(one.inputs)} inputs and {len(one.outputs)} outputs" for one in (source, skill)
        )
        if found != expected:
            raise source.refused(f"of {found} as a source", f"{expected}, as {skill.name!r} has")
        return _SkillController(source)
    if isinstance(source, Hierarchy):
        return _HierarchyController(source, skill)
    if callable(source):
        return _FunctionController(source, skill)
    raise ModelError(f"{source!r} as a source", "a skill, a hierarchy or a function")


class _HierarchyController:
    """A hierarchy, given the values of the sensors that a skill reads."""

    def __init__(self, hierarchy: Hierarchy, skill: Skill) -> None:
        self._hierarchy = hierarchy
        known = hierarchy.description
        # A hierarchy makes derivatives and histories of its own from the sensors' values.
        self._sensors = [
            (place, one.name)
            for place, one in enumerate(skill.inputs)
            if one.code == "SE" and one.name in known.sensors
        ]
        for output in skill.outputs:
            if output.module != "actuator" or output.name not in known.actuators:
                raise skill.refused(
                    f"with the output {output}, which the hierarchy does not command",
                    "actuators of the hierarchy",
                    "take a function as the source",
                    output.line,
                )
        self._actuators = [output.name for output in skill.outputs]
        self._inputs = len(skill.inputs)

    def reset(self, seed: int = 0) -> None:
        self._hierarchy.seed = seed
        self._hierarchy.reset()

    def __call__(self, inputs: Sequence[float] | NDArray[Any]) -> NDArray[np.float64]:
        if len(inputs) != self._inputs:
            raise ModelError(f"{len(inputs)} inputs for the source", f"{self._inputs}, as it has")
        given = self._hierarchy.evaluate({name: inputs[place] for place, name in self._sensors})
        return np.array([given[name] for name in self._actuators])


class _SkillController(_HierarchyController):
    """A skill by itself, with its inputs as sensors and its outputs as actuators."""

    def __init__(self, skill: Skill) -> None:
        sensors = [f"input {place}" for place in range(len(skill.inputs))]
        actuators = [f"output {place}" for place in range(len(skill.outputs))]
        alone = skill.changed(
            inputs=[f"SE:{name}" for name in sensors], outputs=[f"MO:{name}" for name in actuators]
        )
        mind = MindDescription(skill.name, sensors, actuators, skills=[alone])
        super().__init__(Hierarchy(mind), alone)


class _FunctionController:
    """A function of an array."""

    def __init__(self, function: Callable[[NDArray[np.float64]], Any], skill: Skill) -> None:
        self._function = function
        self._outputs = len(skill.outputs)

    def reset(self, seed: int = 0) -> None:
        begin = getattr(self._function, "reset", None)
        if begin is not None:
            begin()

    def __call__(self, inputs: Sequence[float] | NDArray[Any]) -> NDArray[np.float64]:
        answered = self._function(np.asarray(inputs))
        try:
            given = np.atleast_1d(np.asarray(answered, dtype=np.float64))
        except (TypeError, ValueError):
            given = np.zeros(0)
        if given.shape != (self._outputs,) or not np.isfinite(given).all():
            raise ModelError(
                f"{shown(answered)} from the source", f"{self._outputs} finite numbers"
            )
        return given.clip(0.0, 1.0)


class AnswerRecorder:
    """Notes what a teacher answers to all inputs, while it or another steers.

    Args:
        teacher: whose answers are noted.
        actor: who steers; None for the teacher itself.
    """

    def __init__(self, teacher: Controller, actor: Controller | None = None) -> None:
        self._teacher = teacher
        self._actor = actor
        self.episodes: list[tuple[list[Any], list[Any]]] = []

    def reset(self, seed: int = 0) -> None:
        """Begin an episode."""
        self._teacher.reset(seed)
        if self._actor is not None:
            self._actor.reset(seed)
        self.episodes.append(([], []))

    def __call__(self, inputs: Sequence[float] | NDArray[Any]) -> NDArray[np.float64]:
        """Return the outputs of the one that steers."""
        answer = self._teacher(inputs)
        # A copy: an environment may use one array for all ticks.
        self.episodes[-1][0].append(np.array(inputs, dtype=np.float64))
        self.episodes[-1][1].append(answer)
        return answer if self._actor is None else self._actor(inputs)
