"""Imprinting: a skill learns what another already does (thesis, 5.2.3).

A source (a programmed skill, another network, a hierarchy, a person's recorded commands) is
recorded, the target is trained on the recording, and runs in the environment until it does as well.
What comes out is used as it is, or as the first population of an optimiser.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, whole_number
from socialmind.errors import ModelError
from socialmind.learning.imprinting.controllers import (
    AnswerRecorder,
    Controller,
    Source,
    controller_of,
)
from socialmind.learning.imprinting.recording import Recording, check_fits, of_episodes
from socialmind.learning.imprinting.supervised import train
from socialmind.learning.imprinting.twin import Twin
from socialmind.mind import Skill

Episode = Callable[[Callable[[Any], NDArray[np.float64]], int], float]
"""An environment: runs one episode, called with a controller and a seed, and gives its score (the
more the better). It calls the controller at each tick with the skill's inputs, 0 … 1, in order, and
gets its outputs."""

RECORDING, TRAINING, SCORING, STARTING = range(4)
"""What seeds are drawn for."""


@dataclass(frozen=True)
class Round:
    """How well a target did after a round of imprinting, beside its source on the same episodes.

    Attributes:
        source, target: mean scores.
        records: how many records the target was trained on.
        loss: the mean squared error in the last epoch, of outputs before they are held to [0, 1].
    """

    source: float
    target: float
    records: int
    loss: float


@dataclass(frozen=True, eq=False)
class Imprint:
    """A skill that was trained on a source.

    Attributes:
        skill: the skill with its genome.
        losses: the mean squared error over each epoch of the training that gave this genome, of
            outputs before they are held to [0, 1] (beyond the wanted 0 or 1 none).
        recording: what it was trained on.
        rounds: the rounds in the environment, if there were any.
        reached: whether it does as well as the source; None where that was not tried.
    """

    skill: Skill
    losses: tuple[float, ...]
    recording: Recording
    rounds: tuple[Round, ...] = ()
    reached: bool | None = None


def record(episode: Episode, source: Source, skill: Skill, seeds: Sequence[int]) -> Recording:
    """Return what a source answers while it steers through episodes.

    Args:
        episode: the environment.
        source: the source.
        skill: the skill whose inputs the environment gives, and whose outputs it takes.
        seeds: one for each episode.

    Raises:
        ModelError: the source does not fit the skill, or an episode has no score.
        SocialmindError: seeds that are none.
    """
    if isinstance(seeds, str) or not isinstance(seeds, Iterable):
        raise ModelError(f"seeds={shown(seeds)}", "several whole numbers, one for each episode")
    recorder = AnswerRecorder(controller_of(source, skill))
    _scores(episode, recorder, seeds)
    return of_episodes(recorder.episodes, skill)


def imprint(
    skill: Skill,
    recording: Recording,
    seed: int,
    epochs: int = 200,
    rate: float = 0.02,
    batch: int = 64,
    window: int = 20,
    starts: int = 5,
) -> Imprint:
    """Train a skill to answer as recorded.

    It begins from the skill's genome. Where it has none, several are drawn, each is trained for a
    tenth of the epochs, and the one that came nearest is trained in full: small networks get stuck
    from some beginnings. Networks with memory are trained on whole episodes, others on single
    records.

    Args:
        skill: the target; its internal function is a network.
        recording: what its source answered.
        seed: decides the first genome and the order of the records.
        epochs: how many times each record is seen by the genome that is trained in full; where
            several are drawn, a tenth more, once at least.
        rate: the learning rate of Adam at the start; it falls to 0.
        batch: how many records make a step, for networks without memory.
        window: through how many ticks the gradient goes back, for networks with memory.
        starts: how many genomes are drawn, for a skill without one.

    Raises:
        ModelError: the function is no network, or the recording does not fit the skill.

    >>> from socialmind.mind import Skill
    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> target = Skill("Invert", ["SE:Light"], ["MO:Lamp"], Perceptron(layers=0))
    >>> answers = Recording([[0.2], [0.3], [0.8]], [[0.8], [0.7], [0.2]])
    >>> done = imprint(target, answers, seed=1, epochs=500, rate=0.05)
    >>> done.skill.genome.round(3).tolist()
    [-1.0, 1.0]
    """
    check_fits(recording, skill)
    if not len(recording):
        raise skill.refused("to be trained on an empty recording", "one record or more")
    numbers = {"epochs": epochs, "batch": batch, "window": window, "starts": starts}
    for name, value in numbers.items():
        whole_number(value, name, 1, error=ModelError)
    if not is_number(rate) or not rate > 0.0:
        raise ModelError(f"rate={shown(rate)} of training", "a number above 0")
    whole_number(seed, "seed", 0, 2**64 - 1, ModelError)
    counts = len(skill.inputs), len(skill.outputs)
    if skill.genome is not None or starts == 1:
        twin = Twin(skill.function, *counts, skill.genome, seed)
    else:
        twins = [
            Twin(skill.function, *counts, seed=_seeds(seed, STARTING, number, 1)[0])
            for number in range(starts)
        ]
        trial = max(epochs // 10, 1)
        reached = [train(one, recording, seed, trial, rate, batch, window)[-1] for one in twins]
        twin = twins[reached.index(min(reached))]
    losses = train(twin, recording, seed, epochs, rate, batch, window)
    return Imprint(skill.changed(genome=twin.weights), tuple(losses), recording)


def imprint_in(
    episode: Episode,
    source: Source,
    skill: Skill,
    seed: int,
    tolerance: float,
    rounds: int = 10,
    episodes: int = 8,
    scored: int = 20,
    **training: Any,
) -> Imprint:
    """Imprint a source on a skill until the skill does as well in an environment.

    The source is recorded while it steers. In each round the target is trained on all that was
    recorded and both steer through the same fresh episodes. As long as the target's mean score is
    lower than the source's by more than the tolerance, it steers through further episodes and what
    the source would have done in the places where the target got to is added to the recording
    (dataset aggregation, Ross, Gordon and Bagnell 2011). Training goes on from round to round; a
    target that came without a genome begins anew after a round that brought it no nearer.

    Args:
        episode: the environment.
        source: a programmed skill, another network, a hierarchy or a function.
        skill: the target.
        seed: decides everything that is drawn, the seeds of the episodes too.
        tolerance: by how much the target's mean score may be lower, 0 or more.
        rounds: how many rounds at most.
        episodes: how many episodes are recorded in each.
        scored: over how many fresh episodes both are compared in each.
        training: `epochs`, `rate`, `batch`, `window` and `starts`, as for `imprint`.

    Returns:
        The imprint of the round that did best beside the source: the last one, where the target
        does as well.

    Raises:
        ModelError: source, target or numbers do not fit.
    """
    for name, value in (("rounds", rounds), ("episodes", episodes), ("scored", scored)):
        whole_number(value, name, 1, error=ModelError)
    if not is_number(tolerance) or tolerance < 0.0:
        raise ModelError(f"tolerance={shown(tolerance)} of imprinting", "a number, 0 or more")
    whole_number(seed, "seed", 0, 2**64 - 1, ModelError)
    teacher = controller_of(source, skill)
    recording = record(episode, source, skill, _seeds(seed, RECORDING, 0, episodes))
    done: list[Round] = []
    best: Imprint | None = None
    lead, beginning = -math.inf, skill
    for number in range(1, rounds + 1):
        (training_seed,) = _seeds(seed, TRAINING, number, 1)
        now = imprint(beginning, recording, training_seed, **training)
        learner = controller_of(now.skill, skill)
        fresh = _seeds(seed, SCORING, number, scored)
        means = [float(np.mean(_scores(episode, one, fresh))) for one in (teacher, learner)]
        done.append(Round(means[0], means[1], len(recording), now.losses[-1]))
        beginning = now.skill
        if best is None or means[1] - means[0] > lead:
            best, lead = now, means[1] - means[0]
        else:
            # Training that brings it no nearer is stuck; a given genome is not given up, though.
            beginning = skill if skill.genome is None else now.skill
        if lead >= -tolerance or number == rounds:
            break
        visited = AnswerRecorder(teacher, learner)
        _scores(episode, visited, _seeds(seed, RECORDING, number, episodes))
        recording = recording.joined(of_episodes(visited.episodes, skill))
    found = best or now
    return Imprint(found.skill, found.losses, found.recording, tuple(done), lead >= -tolerance)


def first_population(imprint: Imprint, size: int, spread: float, seed: int) -> NDArray[np.float64]:
    """Return genomes for an optimiser to begin from: the imprinted one, and mutations of it.

    Args:
        imprint: the imprint.
        size: how many genomes, 1 or more.
        spread: the standard deviation of the normal mutation of each weight, 0 or more.
        seed: decides the mutations.

    Returns:
        Shape (size, genome size); the first is the imprinted genome.
    """
    whole_number(size, "size", 1, error=ModelError)
    if not is_number(spread) or spread < 0.0:
        raise ModelError(f"spread={shown(spread)} of a first population", "a number, 0 or more")
    whole_number(seed, "seed", 0, 2**64 - 1, ModelError)
    genome = imprint.skill.genome
    if genome is None:
        raise imprint.skill.refused("without a genome", "an imprinted one")
    population = np.tile(genome, (size, 1))
    population[1:] += np.random.default_rng(seed).normal(0.0, spread, population[1:].shape)
    return population


def _scores(
    episode: Episode, controller: Controller | AnswerRecorder, seeds: Sequence[int]
) -> list[float]:
    """Return the scores of episodes that a controller steers through."""
    scores = []
    for seed in seeds:
        controller.reset(seed)
        score = episode(controller, seed)
        if not is_number(score):
            found = f"the score {shown(score)} of the episode of seed {seed}"
            raise ModelError(found, "a finite number")
        scores.append(float(score))
    return scores


def _seeds(seed: int, purpose: int, number: int, count: int) -> list[int]:
    """Return the seeds that a round draws for a purpose, each below 2³²."""
    drawn = np.random.SeedSequence([seed, purpose, number]).generate_state(count)
    return [int(one) for one in drawn]
