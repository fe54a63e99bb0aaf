"""Episodes of societies: genomes judged in models without a plane.

An episode is a model from its setup to its last tick; all agents of the population that learns
share the genome. What it was worth is what the model's method `score()` says at its end, or the
mean of what it says every `score_every` ticks. Worlds run one after another, compiled; a genome is
data, so that nothing is compiled anew for it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.learning.episodes.learners import Halted, learners_of, length_of, world_seeds
from socialmind.learning.outcome import Outcome
from socialmind.names import several

if TYPE_CHECKING:
    from socialmind.model import Model


class SocietyEpisodes:
    """Judges genomes of skills, or whole minds, in societies: models without a plane.

    Args:
        model_class: the model, with a method `score()` that returns a number.
        parameters: values of its parameters that differ from the defaults.
        hierarchy: the mind of the agents instead of the model's own: a folder, a YAML file or a
            `MindDescription`; for several populations with hierarchies a mapping.
        master: the name of the master skill instead of the population's own.
        skill: the skill that learns, or several: their genomes stand one after another.
        drive: a drive module (thesis, 5.1.3) instead of the population's own.
        ticks: the length of an episode, 1 or more; the model's own by default.
        population: whose minds these are; the first one with a hierarchy by default.
        physics: "compiled", the only engine of such models.
        record: what to give back: columns of the model's series, at the end.

    Attributes:
        stopped: set by another thread, it ends `run` soon, with `Halted`.

    Raises:
        ModelError: a plane, no such skill or column, or a model that says no score.
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
        physics: str = "compiled",
        record: Sequence[str] = (),
    ) -> None:
        if model_class.shape.world.has_episodes:
            raise ModelError(f"{model_class.name!r}, which has a plane", None, "use Episodes")
        if not callable(getattr(model_class, "score", None)):
            raise ModelError(
                f"episodes of {model_class.name!r}, which says no score",
                "a method score() that returns a number, the higher the better",
                "write def score(self): return …",
            )
        if physics != "compiled":
            raise SocialmindError(f"physics={physics!r} for {model_class.name}, which has no plane")
        self.model_class = model_class
        self.parameters = dict(parameters or {})
        self.ticks = length_of(model_class, ticks)
        minded = [n for n, one in model_class.populations.items() if one.hierarchy is not None]
        self.learners = learners_of(
            model_class, minded, hierarchy, master, skill, drive, population
        )
        self.genome_size = self.learners.genome_size
        self.record = several(record, "record")
        self.stopped = False
        self._worlds: dict[int, tuple[Any, dict[str, NDArray[Any]]]] = {}

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
        shape = (1 if genomes is None else len(rows), len(seeds))
        score, ticks = np.zeros(shape), np.zeros(shape, np.int64)
        fields: dict[str, list[Any]] = {name: [None] * score.size for name in self.record}
        seeds = world_seeds(seeds)
        for world, seed in enumerate(seeds):
            for individual in range(shape[0]):
                genome = rows[individual] if len(rows) else None
                model, score[individual, world] = self._finished(seed, genome)
                ticks[individual, world] = model.tick
                if self.record:
                    series = model.series()
                    for name, values in fields.items():
                        values[individual * shape[1] + world] = _column(series, name)
        self._worlds = {seed: one for seed, one in self._worlds.items() if seed in seeds}
        found = {name: np.array(values).reshape(shape) for name, values in fields.items()}
        return Outcome(score, ticks, np.zeros(shape, np.int64), found)

    def model(self, seed: int, genome: ArrayLike | None = None) -> Model:
        """Return the model of one episode, before its first tick, to look at or to go on with.

        Args:
            seed: of the world.
            genome: (`genome_size`,), or None for the mind as it is.
        """
        return self.model_class(
            seed=int(seed), hierarchy=self.learners.steerings_with(genome), **self.parameters
        )

    def _finished(self, seed: int, genome: NDArray[np.float64] | None) -> tuple[Any, float]:
        """Return the model of an episode at its end, and the score."""
        if seed not in self._worlds:
            made = self.model_class.before_setup(
                seed=seed, hierarchy=self.learners.steerings, **self.parameters
            )
            self._worlds[seed] = made, made.state()
        model, start = self._worlds[seed]
        model.restore(start)
        if genome is not None:
            for skill in self.learners.skills_with(genome):
                model.tables[self.learners.population].minds.set_genome(skill.name, skill.genome)
        model.engine.set_up()
        said = []
        every = self.model_class.score_every or self.ticks
        while model.tick < self.ticks and not model.stopped:
            if self.stopped:
                raise Halted
            model.advance(min(every, self.ticks - model.tick))
            said.append(float(model.score()))
        if not said:  # it stopped where it began
            said.append(float(model.score()))
        return model, sum(said) / len(said)


def _column(series: Mapping[str, Any], name: str) -> Any:
    if name not in series:
        raise ModelError(f"{name!r} to record", "a column of the series", nearest(name, series))
    return series[name]
