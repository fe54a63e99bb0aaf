"""The programmed fitted too: the scheme's numbers fitted as the networks' weights are.

python -m analysis.foraging_roles.scheme_evolution [ATTEMPTS]     # or gone on with; 10 by default
python -m analysis.foraging_roles.scheme_evolution --quick

Optimiser, individuals, worlds, generations and finals are those of the lesson `supervised_role`;
only what learns differs: eight numbers of the scheme instead of 39 weights of a network. An attempt
begins with each number drawn within e² times what somebody wrote, either way. A row of
`results/evolved_schemes.csv` is an attempt that is done; what is in hand stands in
`trainings/evolved_scheme/` after each generation.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pandas as pd

from socialmind.learning import Lesson
from socialmind.learning.lessons import keys
from socialmind.learning.training import archive
from socialmind.learning.training.finalists import Finalists, Individual
from socialmind.runs.arrays_file import load_arrays, save_arrays

from .scheme_economy import WRITTEN, SchemeEconomy, numbers_of, scheme_of
from .trainings import LESSONS
from .worlds import TRAINING

FOLDER = Path(__file__).parent
OUT = FOLDER / "results" / "evolved_schemes.csv"
HOME = FOLDER / "trainings" / "evolved_scheme"
NAME = "evolved_scheme"
ATTEMPTS = 10


class Search:
    """One attempt, generation by generation.

    Args:
        attempt: its number, from 1; its draws hang on it.
        lesson: the optimiser, its settings, and how much is judged.
    """

    def __init__(self, attempt: int, lesson: Lesson) -> None:
        self.lesson = lesson
        self.key = (TRAINING, attempt, NAME, 0)
        self.economy = SchemeEconomy(lesson.parameters)
        seed = keys.seed_for(keys.OPTIMISER, *self.key)
        self.optimiser = lesson.kind(self.economy.genome_size, seed, lesson.settings)
        self.finalists = Finalists(lesson.finalists)

    def advance(self) -> None:
        """Judge a generation and draw the next."""
        number = self.optimiser.generation + 1
        worlds = keys.seeds_for(self.lesson.repetitions, keys.WORLD, *self.key, number)
        genomes = self.optimiser.ask()
        scores = self.economy.run(genomes, worlds).score.mean(axis=1)
        self.optimiser.tell(scores)
        leader = int(scores.argmax())
        self.finalists.add(Individual(genomes[leader], None, float(scores[leader]), number))

    def winner(self) -> tuple[np.ndarray, float]:
        """Return the best genome of the finals, and what it comes to there."""
        chosen = self.finalists.chosen()
        worlds = keys.seeds_for(self.lesson.finals, keys.FINAL, *self.key)
        genomes = np.stack([one.genome for one in chosen])
        means = self.economy.run(genomes, worlds).score.mean(axis=1)
        return genomes[means.argmax()], float(means.max())

    def save(self, path: Path) -> None:
        """Make safe what is in hand."""
        arrays = {
            **archive.under("optimiser/", self.optimiser.state()),
            **archive.under("finalists/", self.finalists.state()),
        }
        path.parent.mkdir(parents=True, exist_ok=True)
        save_arrays(path, {"key": list(self.key)}, arrays)

    def go_on_from(self, path: Path) -> None:
        """Go on from what `save` wrote."""
        _, arrays = load_arrays(path)
        self.optimiser.restore(archive.part(arrays, "optimiser/"))
        self.finalists.restore(archive.part(arrays, "finalists/"))


def evolved(attempt: int, lesson: Lesson, home: Path) -> dict[str, Any]:
    """Make an attempt, or go on with it, and return its row.

    Args:
        attempt: its number.
        lesson: as that of `Search`.
        home: where what is in hand lies.
    """
    search, path = Search(attempt, lesson), home / f"attempt-{attempt}.npz"
    if path.is_file():
        search.go_on_from(path)
    while search.optimiser.generation < lesson.generations:
        search.advance()
        search.save(path)
    genome, score = search.winner()
    numbers = dict(zip(WRITTEN, numbers_of(genome).tolist(), strict=True))
    return {"attempt": attempt, "generations": lesson.generations, "score": score, **numbers}


def evolve_all(path: Path, home: Path, lesson: Lesson, attempts: int) -> pd.DataFrame:
    """Make the attempts that are not done, and keep each."""
    table = pd.read_csv(path) if path.is_file() else pd.DataFrame({"attempt": []})
    for attempt in range(1, attempts + 1):
        if attempt not in set(table["attempt"]):
            row = pd.DataFrame([evolved(attempt, lesson, home)])
            table = pd.concat([table, row], ignore_index=True) if len(table) else row
            path.parent.mkdir(parents=True, exist_ok=True)
            table.to_csv(path, index=False, float_format="%.12g", lineterminator="\n")
            print(row.to_string(), file=sys.stderr, flush=True)
    return table


def kept(path: Path = OUT) -> Mapping[int, np.ndarray]:
    """Return the numbers of the attempts that are kept, by attempt, in the order of `WRITTEN`."""
    if not path.is_file():
        return {}
    table = pd.read_csv(path)
    rows = table[list(WRITTEN)].to_numpy()
    return dict(zip(table["attempt"].astype(int).tolist(), rows, strict=True))


def programmed(numbers: np.ndarray) -> dict[str, Any]:
    """Return the parameters of robots whose scheme has other numbers, in the order of `WRITTEN`."""
    tolerance = float(dict(zip(WRITTEN, numbers.tolist(), strict=True))["tolerance"])
    return {"programmed": 1.0, "tolerance": tolerance, "scheme": scheme_of(numbers)}


def main(arguments: Sequence[str]) -> None:
    """Make attempts."""
    if "--quick" in arguments:
        small = LESSONS.lesson.changed(
            generations=2, repetitions=2, finals=4, settings={"population": 6, "step": 0.5}
        )
        with TemporaryDirectory() as home:
            print(pd.DataFrame([evolved(1, small, Path(home))]).to_string())
        return
    attempts = int(arguments[0]) if arguments else ATTEMPTS
    print(evolve_all(OUT, HOME, LESSONS.lesson, attempts).to_string())


if __name__ == "__main__":
    main(sys.argv[1:])
