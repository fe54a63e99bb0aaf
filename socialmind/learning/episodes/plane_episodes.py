"""Episodes: genomes judged in worlds, many at once, on which all learning on a plane stands.

An episode is a model from its setup to an interruption or the limit of ticks. Its score is the sum
of its rewards, the mean of all robots that have lived in it. Worlds run in lockstep, a lane each,
so that their minds are evaluated together; what comes out does not depend on how many lanes there
are, or in what order episodes begin.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py.border.numbers import whole_number
from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.learning.episodes.batch import LANES, Batch, Crowded
from socialmind.learning.episodes.learners import Halted, learners_of, length_of, world_seeds
from socialmind.learning.episodes.lives import Lives
from socialmind.learning.outcome import Outcome, filled
from socialmind.mind.description import MindDescription
from socialmind.names import several

if TYPE_CHECKING:
    from socialmind.model import Model


class Episodes:
    """Judges genomes of skills, or whole minds, in the worlds of a model on a plane.

    Args:
        model_class: the model.
        parameters: values of its parameters that differ from the defaults.
        hierarchy: the mind of the robots instead of the model's own: a folder, a YAML file or a
            `MindDescription`; for several populations with minds a mapping.
        master: the name of the master skill instead of the population's own.
        skill: the skill that learns, or several: their genomes stand one after another.
        drive: a drive module (thesis, 5.1.3) instead of the population's own.
        ticks: the limit of an episode, 1 or more; the model's own by default.
        population: whose minds these are; the first one with a hierarchy by default.
        lanes: how many worlds run in lockstep.
        physics: "compiled", or "pymunk", which runs one world after another.
        record: what to give back: fields of the robots that the minds steer, of the dead as they
            were at last; variables of the model; or "population.field" for other robots.
        without: names of interruptions that are not heeded.

    Attributes:
        stopped: set by another thread, it ends `run` soon, with `Halted`.

    Raises:
        ModelError: no plane, no such skill or field, or a mind that does not fit the bodies.
    """

    def __init__(
        self,
        model_class: type[Model],
        parameters: Mapping[str, Any] | None = None,
        hierarchy: Any = None,
        master: str | None = None,
        skill: str | Sequence[str] | None = None,
        drive: Any = None,
        ticks: int | None = None,
        population: str | None = None,
        lanes: int = LANES,
        physics: str = "compiled",
        record: Sequence[str] = (),
        without: Sequence[str] = (),
    ) -> None:
        if not model_class.shape.world.has_episodes:
            raise ModelError(f"episodes of {model_class.name!r}", "a model on a plane")
        self.model_class = model_class
        self.parameters = dict(parameters or {})
        self.ticks = length_of(model_class, ticks)
        self.lanes = whole_number(lanes, "lanes", 1, None, SocialmindError)
        self.physics = physics
        self.record = several(record, "record")
        self.without = (without,) if isinstance(without, str) else several(without, "without")
        for name, one in model_class.populations.items():
            if one.hierarchy is not None and name not in model_class.shape.world.robots:
                raise ModelError(f"episodes with hierarchies of {name!r}", "those of robots alone")
        minded = [n for n, one in model_class.shape.world.robots.items() if one.hierarchy]
        self.learners = learners_of(
            model_class, minded, hierarchy, master, skill, drive, population
        )
        self.skills, self.population = self.learners.skills, self.learners.population
        self.steerings, self.genome_size = self.learners.steerings, self.learners.genome_size
        self.robots = model_class.shape.world.robots
        self.recorded = {name: self._place(name) for name in self.record}
        self.stopped = False
        self._batch: Batch | None = None
        self._room: dict[str, tuple[int, int]] = {}

    def _place(self, name: str) -> tuple[str | None, str]:
        """Return where something to record stands: a population, or None for the model's own."""
        shape = self.model_class.shape
        population, _, field = name.rpartition(".")
        population = population or self.population
        if population in self.robots and field in shape.populations[population].fields:
            return population, field
        if name in shape.variables:
            return None, name
        known = [*shape.populations[self.population].fields, *shape.variables]
        raise ModelError(f"{name!r} to record", "a field or a variable", nearest(name, known))

    @property
    def description(self) -> MindDescription:
        """The mind that learns, with zeros where a genome is still to be learned."""
        return self.learners.description

    def run(self, genomes: ArrayLike | None, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds.

        Args:
            genomes: (individuals, `genome_size`), or None for the mind as it is.
            seeds: of the worlds, 0 … 2⁶⁴ − 1, one for each repetition.

        Raises:
            ModelError: genomes of another shape, or that are not finite numbers.
            SocialmindError: an episode failed.
        """
        rows = self.learners.rows(genomes)
        individuals = 1 if genomes is None else len(rows)
        shape = (individuals, len(seeds))
        if 0 in shape:
            empty = np.zeros(shape)
            return Outcome(empty, empty.astype(int), empty.astype(int), {})
        individual = np.repeat(np.arange(individuals), len(seeds))
        keys = np.tile(np.array(world_seeds(seeds), np.uint64), individuals)
        if self.physics != "compiled":
            return self._one_by_one(rows, individual, keys, shape)
        lanes = min(self.lanes, len(keys))
        while True:
            if self._batch is None or len(self._batch.models) < lanes:
                self._batch = Batch(self, lanes, self._room)
            try:
                return self._batch.run(rows, individual, keys, shape)
            except Crowded as crowded:
                self._room, self._batch = crowded.room, None

    def model(self, seed: int, genome: ArrayLike | None = None) -> Model:
        """Return the model of one episode, before its first tick, to look at or to go on with.

        Args:
            seed: of the world.
            genome: (`genome_size`,), or None for the mind as it is.
        """
        return self.model_class(
            seed=int(seed),
            hierarchy=self.learners.steerings_with(genome),
            physics=self.physics,
            without=self.without,
            **self.parameters,
        )

    def _one_by_one(
        self,
        rows: NDArray[np.float64],
        individual: NDArray[np.int64],
        keys: NDArray[np.uint64],
        shape: tuple[int, int],
    ) -> Outcome:
        """Run one world after another."""
        score = np.zeros(len(keys))
        ticks, ended = np.zeros((2, len(keys)), int)
        fields: dict[str, list[Any]] = {name: [] for name in self.record}
        for job, (one, key) in enumerate(zip(individual.tolist(), keys.tolist(), strict=True)):
            model = self.model(key, rows[one] if len(rows) else None)
            lives = Lives(model)
            while model.over is None and model.tick < self.ticks:
                if self.stopped:
                    raise Halted
                lives.advance(last=model.tick + 1 == self.ticks)
            score[job] = lives.score
            ticks[job], ended[job] = model.tick, int(model.context["_over"])
            for name, values in fields.items():
                population, field = self.recorded[name]
                found_in = model.context if population is None else lives.rows(population)
                values.append(np.copy(found_in[field]))
        found, lived = {}, {}
        for name, values in fields.items():
            stacked = np.array(values) if self.recorded[name][0] is None else filled(values)
            found[name] = stacked.reshape(*shape, *stacked.shape[1:])
            if self.recorded[name][0] is not None:
                lived[name] = np.array([len(one) for one in values]).reshape(shape)
        ended = ended.reshape(shape)
        return Outcome(score.reshape(shape), ticks.reshape(shape), ended, found, lived)
