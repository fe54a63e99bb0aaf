"""Worlds on a plane as environments of imprinting: a demonstrator steers a robot, a skill learns.

Whoever demonstrates stands in for one skill of the robot's mind: the inputs that the skill would
have, variables and derivatives too, go to the demonstrator, whose answers go where the skill's
outputs go. So a skill that influences others is shown as one that turns wheels is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning.episodes.lives import Lives
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.imprinting.controllers import AnswerRecorder, controller_of
from socialmind.learning.imprinting.recording import Recording, of_episodes
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.course import curriculum_of, mind_of
from socialmind.mind.description import MindDescription
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.hierarchy import Hierarchy
from socialmind.model import Model

Asked = Callable[[NDArray[np.float64]], Any]


class PlaneWorld:
    """A model with one robot as an environment of `imprint_in` and `record`.

    It is called with a controller and the seed of a world, and gives the episode's score. An
    episode is the same as in a training: whoever answers as a skill does gets its score, to the
    last digit.

    Args:
        model_class: a model on a plane, such as a lesson's environment.
        skill: the name of the skill that is shown.
        master: the skill that steers the robot; the one that is shown by default. Skills below it
            have their genomes.
        mind: the robot's mind instead of the model's own: a folder, a YAML file or a
            `MindDescription`.
        ticks: the limit of an episode; the model's own by default.
        parameters: values of the model's parameters that differ from the defaults.
        drive: a drive module of the hierarchy (thesis, 5.1.3).
        physics: "compiled" or "pymunk".
        without: names of interruptions that are not heeded.

    Attributes:
        skill: the skill without a genome, as the target of an imprint.

    Raises:
        ModelError: no plane, no such skill, or a mind that does not fit the body.
    """

    def __init__(
        self,
        model_class: type[Model],
        skill: str,
        master: str | None = None,
        mind: Any = None,
        ticks: int | None = None,
        parameters: Mapping[str, Any] | None = None,
        drive: Any = None,
        physics: str = "compiled",
        without: Sequence[str] = (),
    ) -> None:
        self._episodes = Episodes(
            model_class,
            parameters,
            mind,
            master or skill,
            skill,
            drive,
            ticks,
            physics=physics,
            without=without,
        )
        led = self._episodes.steerings[self._episodes.population]
        shown = self._episodes.description.skills[skill]
        self.skill = shown.changed(genome=None)
        self._asked: Asked = np.copy
        self._given = 0  # which of the commands that are played is given
        stand_in = self.skill.changed(function=Programmed(self._answer))
        description = self._episodes.description.with_modules(skills=[stand_in])
        population = self._episodes.population
        self._hierarchy = Hierarchy(description, led.master, drive=led.drive, population=population)
        robots = model_class.shape.world.robots[population]
        self._read = [
            (place, name)
            for place, name in enumerate(robots.sensors)
            if name in description.sensors
        ]
        self._actuators = list(robots.actuators)

    @classmethod
    def of(
        cls,
        model: str | Path | type[Model] | None,
        lesson: str | Lesson,
        mind: str | Path | MindDescription | None = None,
        physics: str = "compiled",
    ) -> PlaneWorld:
        """Return the world of a lesson, in which the skill that learns is shown.

        Args:
            model: a model's name or folder, or its class.
            lesson: the name of one of its lessons, a `.simbatch` file, or a `Lesson`.
            mind: the robot's, as in `learn`: by default the curriculum's or the model's.
            physics: "compiled" or "pymunk".

        Raises:
            SocialmindError: there is no such lesson.
            ModelError: a lesson of several skills, or whose environment is no model.
        """
        curriculum, folder = curriculum_of(model, lesson)
        if len(curriculum.lessons) > 1:
            names = ", ".join(one.name for one in curriculum.lessons)
            raise SocialmindError(f"{lesson} is a curriculum; expected one of its lessons, {names}")
        (found,) = curriculum.lessons
        if len(found.skills) > 1:
            raise found.refused(f"with the skills {', '.join(found.skills)}", "one, which is shown")
        if not issubclass(found.environment, Model):
            raise found.refused(f"in {found.environment.__name__}", "a model on a plane")
        begun = mind_of(model, curriculum, folder, mind)
        return cls(
            found.environment,
            found.skills[0],
            found.master,
            begun.on_stand_ins(found.master, found.stand_ins) if found.stand_ins else begun,
            found.ticks,
            found.parameters,
            found.drive,
            physics,
        )

    def _answer(self, inputs: NDArray[np.float64]) -> Any:
        """Ask whoever demonstrates."""
        return self._asked(inputs)

    def __call__(self, controller: Asked, seed: int) -> float:
        """Run an episode and return its score.

        Args:
            controller: called in each tick in which the skill receives influence, with its inputs;
                returns its outputs.
            seed: of the world, 0 … 2⁶⁴ − 1.

        Raises:
            SocialmindError: the model has another number of robots than one.
        """
        return self._run(controller, seed, None)

    def played(self, commands: ArrayLike, seed: int) -> Recording:
        """Return the recording of a robot that somebody steered, from what its actuators were told.

        The world is run once more with these commands, which shows what the skill would have read.

        Args:
            commands: 0 … 1, (ticks, actuators), in the body's order, such as the actions of a
                Gymnasium environment: the first is given at the end of the first tick.
            seed: of the world that it was, as in `Model(seed=…)`, or `world` of the environment.

        Raises:
            ModelError: commands of another shape, or outside [0, 1]; or a skill whose outputs
                are not actuators alone.

        >>> PlaneWorld(GoToObject, "GoToObject").played(actions, seed=7)      # doctest: +SKIP
        <recording of 412 records in 1 episode: 1 input, 2 outputs>
        """
        try:
            rows = np.asarray(commands, np.float64)
        except (TypeError, ValueError):
            raise ModelError("commands that are no table", "rows of numbers, 0 … 1") from None
        names = [output.name for output in self.skill.outputs if output.module == "actuator"]
        if len(names) != len(self.skill.outputs):
            raise self.skill.refused("to be shown by commands", "outputs that are actuators alone")
        if rows.ndim != 2 or rows.shape[1] != len(self._actuators) or not len(rows):
            raise ModelError(
                f"commands of the shape {rows.shape}",
                f"(ticks, {len(self._actuators)}): {', '.join(self._actuators)}",
            )
        if not ((rows >= 0.0) & (rows <= 1.0)).all():
            raise ModelError("commands outside their range", "numbers, 0 … 1")
        columns = [self._actuators.index(name) for name in names]
        recorder = AnswerRecorder(
            controller_of(lambda inputs: rows[self._given, columns], self.skill)
        )
        recorder.reset(seed)
        self._run(recorder, seed, rows)
        return of_episodes(recorder.episodes, self.skill)

    def _run(self, controller: Asked, seed: int, commands: NDArray[np.float64] | None) -> float:
        """Run an episode; with commands, these go to the actuators, and it ends with them."""
        model, population = self._episodes.model(seed), self._episodes.population
        table = model.tables[population]
        if len(table.slots) != 1:
            raise SocialmindError(
                f"{model.name} has {len(table.slots)} robots in {population!r}; expected one, "
                "which the demonstrator steers"
            )
        slot = table.slots[0]
        robot, lives = int(table.rows["_id"][slot]), Lives(model)
        self._asked = controller
        self._hierarchy.seed = seed
        self._hierarchy.reset()
        limit = self._episodes.ticks
        if commands is not None:
            limit = min(limit, len(commands) + 1)
        model.steer(population, np.full(len(self._actuators), 0.5))
        lives.advance(last=limit == 1)
        for tick in range(1, limit):
            if model.over is not None or not table.contains(robot):
                break
            self._given = tick - 1
            told = self._think(table.rows["readings"][slot])
            if commands is not None:
                told = commands[self._given]
            model.steer(population, told)
            lives.advance(last=tick + 1 == limit)
        rows = lives.rows(population)
        return float(rows["score"][rows["_id"] == robot][0])

    def _think(self, readings: NDArray[np.float64]) -> NDArray[np.float64]:
        """Evaluate the hierarchy; return what the actuators are told."""
        told = self._hierarchy.evaluate({name: readings[place] for place, name in self._read})
        return np.array([told.get(name, 0.5) for name in self._actuators])
