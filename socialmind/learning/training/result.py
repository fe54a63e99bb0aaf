"""Reading a training's folder, for analysis and for what is done with the minds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.errors import SocialmindError
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import (
    CHECKPOINT,
    is_through,
    load_checkpoint,
    results_of,
)
from socialmind.learning.training.capsule import TrainingCapsule, TrainingManifest
from socialmind.learning.training.curve import read_curve
from socialmind.learning.training.finalists import Individual, individual_of
from socialmind.mind.description import MindDescription
from socialmind.sources.trust import programs_in, require

if TYPE_CHECKING:
    import pandas as pd


class Training:
    """A training as its folder tells it, up to its last generation; it may still be going on.

    >>> from socialmind.learning import Training                           # doctest: +SKIP
    >>> training = Training("trainings/collect-001")                       # doctest: +SKIP
    >>> training.curve.groupby("lesson")["best"].max()                     # doctest: +SKIP

    Args:
        folder: the training's.

    Raises:
        SocialmindError: the folder is no training's.
    """

    def __init__(self, folder: str | Path, trust: bool = False) -> None:
        self._capsule = TrainingCapsule(folder)
        self._trust = trust

    @property
    def folder(self) -> Path:
        """The training's folder."""
        return self._capsule.folder

    @property
    def manifest(self) -> TrainingManifest:
        """What the training is: model, lessons, seed, versions, status."""
        return self._capsule.manifest

    @property
    def attempts(self) -> list[int]:
        """The numbers of the attempts that have begun."""
        numbers = range(1, self.manifest.attempts + 1)
        return [one for one in numbers if (self._capsule.attempt(one) / CHECKPOINT).is_file()]

    @property
    def finished(self) -> list[int]:
        """The numbers of the attempts that have been through all their lessons."""
        lessons = self.manifest.lessons
        records = {one: load_checkpoint(self._capsule.attempt(one))[0] for one in self.attempts}
        return [one for one, record in records.items() if is_through(record, lessons)]

    @property
    def curve(self) -> pd.DataFrame:
        """One row a generation.

        Columns: attempt, cycle, lesson, generation, the scores ``best``, ``mean`` and ``deviation``
        of its individuals, ``best_so_far``, the lesson's ``ticks`` so far, and the ``seconds`` that
        it took. Where a lesson has validation, ``validated`` is the best individual's score there.
        """
        return read_curve([(one, self._capsule.attempt(one)) for one in self.attempts])

    @property
    def lessons(self) -> pd.DataFrame:
        """One row a finished lesson.

        Columns: attempt, cycle, lesson, ``score`` of the winner of the finals and its
        ``deviation`` over worlds, the ``generation`` that it is from, the ``best`` score of all
        generations, and ``ticks``.
        """
        import pandas as pd

        rows = []
        for attempt in self.attempts:
            for file, record, arrays in results_of(self._capsule.attempt(attempt)):
                with archive.reading(file):
                    winner = individual_of(archive.part(arrays, "winner/"))
                    best = individual_of(archive.part(arrays, "best/"))
                    rows.append(
                        {
                            "attempt": attempt,
                            "cycle": record["cycle"],
                            "lesson": record["lesson"],
                            "score": record["score"],
                            "deviation": record["deviation"],
                            "generation": winner.generation,
                            "best": best.score,
                            "ticks": record["ticks"],
                        }
                    )
        return pd.DataFrame(rows)

    def best(self, lesson: str, attempt: int = 1) -> Individual:
        """Return the best individual of all generations of a lesson (Algorithm 1).

        It need not be the one that won the finals.

        Args:
            lesson: its name; of one taught over and over, the last time counts.
            attempt: the attempt.

        Raises:
            SocialmindError: the attempt has not finished such a lesson.
        """
        results = list(results_of(self._capsule.attempt(attempt)))
        for file, record, arrays in reversed(results):
            if record["lesson"] == lesson:
                with archive.reading(file):
                    return individual_of(archive.part(arrays, "best/"))
        raise SocialmindError(f"{self.folder}: attempt {attempt} has not finished {lesson}")

    def mind(self, attempt: int = 1, after: str | None = None) -> MindDescription:
        """Return the mind that an attempt has learned.

        Args:
            attempt: the attempt.
            after: the lesson after which; of one taught over and over, the last time counts. The
                last finished one by default.

        Raises:
            SocialmindError: the attempt has not finished this lesson, or none.
        """
        results = list(results_of(self._capsule.attempt(attempt)))
        names = [record["lesson"] for _, record, _ in results]
        if not names or (after is not None and after not in names):
            what = "no lesson" if after is None else f"no lesson called {after}"
            raise SocialmindError(f"{self.folder}: attempt {attempt} has finished {what}")
        last = max(place for place, name in enumerate(names) if name == (after or names[-1]))
        require(programs_in(self._capsule.mind), self._trust, f"{self.folder}: its copy of a mind")
        mind = MindDescription.load(self._capsule.mind)
        for file, record, arrays in results[: last + 1]:
            with archive.reading(file):
                winner = individual_of(archive.part(arrays, "winner/"))
                skills = [mind.skill(name) for name in record["skills"]]
                mind = mind.with_modules(skills=winner.given_to(skills))
        return mind
