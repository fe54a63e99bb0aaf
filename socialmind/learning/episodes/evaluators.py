"""Who evaluates individuals: workers who share out a generation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from socialmind.learning.episodes.evaluation import Evaluation, Genomes, Scores, pieces_of
from socialmind.mind.modules import Skill
from socialmind.work.workers import Stop, Threads, Workers, never

LANES = 64
"""How many episodes the compiled engine runs side by side; fewer in a piece would leave it idle."""


class Evaluators:
    """Evaluate generations with some workers; the scores are the same for all of them.

    Args:
        workers: who they are.
    """

    def __init__(self, workers: Workers) -> None:
        self._workers = workers

    def evaluate(
        self,
        evaluation: Evaluation,
        genomes: Genomes | Sequence[Skill],
        seeds: Sequence[int],
        stop: Stop = never,
    ) -> Scores:
        """Evaluate all individuals on the same worlds.

        Args:
            evaluation: how.
            genomes: shape (k, genome size); or one skill for each individual.
            seeds: of the worlds.
            stop: asked now and then whether to drop the work.

        Raises:
            Stopped: `stop` said so.
            ModelError: the environment failed.
        """
        pieces = pieces_of(genomes, seeds, self._pieces(evaluation, len(genomes) * len(seeds)))
        score = np.zeros((len(genomes), len(seeds)))
        ticks = np.zeros(score.shape, np.int64)
        task = evaluation if isinstance(genomes, np.ndarray) else evaluation.by_skill
        for piece, one in zip(pieces, self._workers.results(task, pieces, stop), strict=True):
            score[piece.individuals, piece.worlds] = one.score
            ticks[piece.individuals, piece.worlds] = one.ticks
        return Scores(score, ticks)

    def _pieces(self, evaluation: Evaluation, episodes: int) -> int:
        """Return into how many pieces so many episodes are cut, a few for each worker."""
        count = self._workers.count
        if isinstance(self._workers, Threads):
            if not evaluation.of_a_model:
                # Threads wait for each other in Python, and arrays are the faster the longer.
                return 1
            # The lanes of each are to be filled.
            return count * (2 if episodes >= 4 * LANES * count else 1)
        return 4 * count
