"""How well the minds of trainings do in the standard benchmark, over attempts and over worlds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from socialmind.catalogue import load_model
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.scoring import score
from socialmind.learning import Training

if TYPE_CHECKING:
    import pandas as pd

WORLDS = 200
SEED = 61
"""Of the worlds of the benchmark, in which nothing was learned."""
MEASURES = ("objects", "survived", "collisions")

Report = Callable[[str], None]


@dataclass(frozen=True)
class Structure:
    """What is compared: the minds of all attempts of a training, as they were after a lesson.

    Attributes:
        name: what a table calls it.
        plan: of the training.
        after: the lesson.
        thesis: what the thesis reports, by measure.
        budget: what the thesis gave an attempt.
    """

    name: str
    plan: str
    after: str
    thesis: Mapping[str, float]
    budget: str = ""


@dataclass(frozen=True)
class Benchmark:
    """A world that minds are scored in.

    Attributes:
        title: what a table calls it.
        model: the model.
        on_collision: `end` or `continue`.
        note: what keeps numbers from being compared with the thesis's.
    """

    title: str
    model: str
    on_collision: str = "end"
    note: str = ""


@dataclass(frozen=True)
class Standing:
    """What the attempts of a structure came to in a benchmark.

    Attributes:
        structure: which.
        benchmark: where.
        episodes: a row for each attempt and world: `attempt`, `world` and the measures.
        finals: the score of each attempt in the finals of its own lesson, by attempt.
        seed: of the worlds.
        spent: generations and million ticks that an attempt has up to the lesson's end, the mean.
    """

    structure: Structure
    benchmark: Benchmark
    episodes: pd.DataFrame
    finals: Mapping[int, float] = field(default_factory=dict)
    seed: int = SEED
    spent: tuple[float, float] = (math.nan, math.nan)

    @property
    def attempts(self) -> int:
        """How many attempts there are."""
        return len(self.finals)

    @property
    def worlds(self) -> int:
        """How many worlds each was scored in."""
        return int(self.episodes["world"].nunique()) if len(self.episodes) else 0

    @property
    def best(self) -> int:
        """The attempt that did best in its lesson's finals; the benchmark has no part in it."""
        return max(self.finals, key=lambda attempt: (self.finals[attempt], -attempt))

    def over_attempts(self, measure: str) -> Interval:
        """Return a measure with an interval for what another attempt would come to."""
        return interval_of(self.episodes.groupby("attempt")[measure].mean().to_numpy())

    def over_worlds(self, measure: str) -> Interval:
        """Return it with one for what these same minds would come to in other worlds."""
        return interval_of(self.episodes.groupby("world", sort=False)[measure].mean().to_numpy())

    def of_best(self, measure: str) -> Interval:
        """Return the measure of the best attempt, with an interval over worlds."""
        own = self.episodes[self.episodes["attempt"] == self.best]
        return interval_of(own[measure].to_numpy())

    def by_attempt(self) -> list[dict[str, object]]:
        """Return a row for each attempt."""
        means = self.episodes.groupby("attempt")[list(MEASURES)].mean().to_dict("index")
        return [
            {
                "benchmark": self.benchmark.title,
                "structure": self.structure.name,
                "training": self.structure.plan,
                "after": self.structure.after,
                "attempt": attempt,
                "finals": round(finals, 4),
                "best": attempt == self.best,
                **{name: round(means[attempt][name], 4) for name in MEASURES},
                "worlds": self.worlds,
                "seed": self.seed,
            }
            for attempt, finals in self.finals.items()
        ]


def standing(
    training: Training | None,
    structure: Structure,
    benchmark: Benchmark,
    worlds: int = WORLDS,
    seed: int = SEED,
    report: Report = lambda line: None,
) -> Standing:
    """Score all attempts of a training that have come to a lesson's end.

    Args:
        training: of the structure's plan; None where there is none, which comes to no attempts.
        structure: what is scored.
        benchmark: where.
        worlds: how many, the same ones for all attempts.
        seed: of the worlds.
        report: takes a line for each attempt.
    """
    import pandas as pd

    model = load_model(benchmark.model)
    columns = ["attempt", "world", *MEASURES]
    parts: list[pd.DataFrame] = []
    finals = finals_of(training, structure.after)
    minds = {one: training.mind(one, structure.after) for one in finals} if training else {}
    for attempt, mind in minds.items():
        found = score(
            model,
            mind,
            episodes=worlds,
            seed=seed,
            on_collision=benchmark.on_collision,
        )
        part = found.frame[["world", *MEASURES]].assign(attempt=attempt)
        parts.append(part[columns])
        objects = found.intervals["objects"].mean
        report(f"{structure.name}, {benchmark.title}, attempt {attempt}: {objects:.2f} objects")
    none = pd.DataFrame(columns=columns)
    episodes = pd.concat(parts, ignore_index=True) if parts else none
    return Standing(
        structure, benchmark, episodes, finals, seed, spent_on(training, structure.after)
    )


def spent_on(training: Training | None, after: str) -> tuple[float, float]:
    """Return the generations and the million ticks of an attempt up to a lesson's end, the mean.

    An attempt that has not come to it does not count.
    """
    done = finals_of(training, after)
    if training is None or not done:
        return math.nan, math.nan
    curve = training.curve[training.curve["attempt"].isin(list(done))]
    order = list(dict.fromkeys(curve["lesson"]))
    spent = curve[curve["lesson"].isin(order[: order.index(after) + 1])]
    last = spent.groupby(["attempt", "lesson"])[["generation", "ticks"]].max()
    each = last.groupby("attempt").sum().mean()
    return float(each["generation"]), float(each["ticks"]) / 1e6


def finals_of(training: Training | None, after: str) -> dict[int, float]:
    """Return the score of each attempt in the finals of a lesson, by attempt."""
    if training is None or training.lessons.empty:
        return {}
    done = training.lessons[training.lessons["lesson"] == after]
    return dict(zip(done["attempt"].tolist(), done["score"].tolist(), strict=True))
