"""Environments without bodies: a genome's score is how near it is to a target, and luck.

They have the interface of `Episodes` but for the model, so that lessons are tested by themselves.
"""

import hashlib
import os
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np

TICKS = 50


class Slope:
    """The nearer all weights are to `target`, the better; worlds differ by `luck`.

    With the genomes of other skills below the master it goes up by their sum, so that what was
    learned before counts.
    """

    name = "slope"
    ticks = TICKS

    def __init__(
        self, parameters, hierarchy, master, skill, drive=None, ticks=None, physics="compiled"
    ):
        self.target = parameters.get("target", 0.5)
        self.luck = parameters.get("luck", 0.1)
        self.seconds = parameters.get("seconds", 0.0)
        self.dies = parameters.get("dies", "")
        self.limit = ticks or TICKS
        skills = (skill,) if isinstance(skill, str) else skill
        self.sizes = [hierarchy.skill(one).genome_size for one in skills]
        self.genome_size = sum(self.sizes)
        below = [hierarchy.skill(one) for one in hierarchy.below(master) if one not in skills]
        self.before = sum(float(one.genome.sum()) for one in below if one.genome_size)
        self.own = [hierarchy.skill(one).genome for one in skills]

    def run(self, genomes, seeds):
        self.die()
        time.sleep(self.seconds)
        if genomes is None:
            genomes = np.concatenate(self.own)[None]
        score = np.empty((len(genomes), len(seeds)))
        ticks = np.empty(score.shape, np.int64)
        for column, seed in enumerate(seeds):
            away = self.target + self.luck * np.random.default_rng(seed).normal()
            for row, genome in enumerate(genomes):
                score[row, column] = self.before - float(((genome - away) ** 2).sum())
                ticks[row, column] = self.limit - seed % 7
        return SimpleNamespace(score=score, ticks=ticks)

    def die(self):
        """Kill the worker that comes first to a file that is there."""
        if self.dies:
            try:
                Path(self.dies).unlink()
            except FileNotFoundError:
                return
            os.kill(os.getpid(), 9)


class Broken(Slope):
    """Gives no numbers."""

    def run(self, genomes, seeds):
        outcome = super().run(genomes, seeds)
        outcome.score[:] = np.nan
        return outcome


def digest(folder):
    """What has to be the same in two trainings: the curve but for seconds, and the minds."""
    import pandas as pd

    total = hashlib.sha256()
    curve = pd.read_parquet(folder / "curve.parquet").drop(columns="seconds")
    total.update(curve.to_csv().encode())
    for path in sorted(folder.glob("mind-attempt-*/**/*")):
        if path.is_file():
            total.update(f"{path.relative_to(folder)}".encode() + path.read_bytes())
    return total.hexdigest()
