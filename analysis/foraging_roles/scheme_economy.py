"""The scheme that decides about roles, as numbers that can be fitted: many schemes side by side.

`scheme_scan` asks the engine, a mind at a time; to fit links by evolution takes millions of
decisions. Here the same rules are written for whole arrays; tests hold them to the engine's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.decision import BiasedWeightedStochastic
from socialmind.catalogue import load_file
from socialmind.learning.outcome import Outcome

from .trainings import ECONOMY, MODEL

DECIDING = load_file(MODEL / "deciding.py")
WRITTEN: Mapping[str, float] = {
    "calling_a": 4.0,
    "calling_b": 4.0,
    "plenty_of_a": 1.0,
    "plenty_of_b": 1.0,
    "reinforcement_a": 0.2,
    "reinforcement_b": 0.2,
    "tolerance": 5.0,
    "bias": 1.0,
}
"""What somebody wrote: influence links of callings on their plan and of plenty on the other one,
reinforcement links, the parameter `tolerance` of the model, and the decision maker's bias."""
FOLD = 2.0
"""A gene of 1 multiplies a number by e to this power, of -1 divides it."""

Floats = NDArray[np.float64]


def numbers_of(genomes: ArrayLike) -> Floats:
    """Return the numbers of schemes by their genes, (…, 8), in the order of `WRITTEN`.

    >>> numbers_of(np.zeros(8)).tolist() == list(WRITTEN.values())
    True
    """
    genes = np.clip(np.asarray(genomes, np.float64), -5.0, 5.0)
    return np.asarray(np.array(list(WRITTEN.values())) * np.exp(FOLD * genes))


def scheme_of(numbers: ArrayLike, name: str = "evolved") -> CognitiveScheme:
    """Return the model's scheme with other numbers; the tolerance is a parameter of the model.

    Args:
        numbers: (8,), in the order of `WRITTEN`.
        name: of the scheme.
    """
    given = dict(zip(WRITTEN, np.asarray(numbers).tolist(), strict=True))
    scheme = CognitiveScheme.load(MODEL / "scheme.yaml")
    cognitons = []
    for one in scheme.cognitons:
        kind = one.name[-1].lower()
        calling = one.name.startswith("Calling")
        link = given[f"calling_{kind}" if calling else f"plenty_of_{kind}"]
        again = dict.fromkeys(one.reinforcement, given[f"reinforcement_{kind}"])
        cognitons.append(
            replace(one, influence=dict.fromkeys(one.influence, link), reinforcement=again)
        )
    maker = BiasedWeightedStochastic(given["bias"])
    return replace(scheme, name=name, cognitons=tuple(cognitons), decision_maker=maker)


def reinforced(calling: Floats, payoff: Floats, reinforcement: Floats) -> Floats:
    """Return callings after a delivery: a fifth fades, and what it was worth is added."""
    bound = DECIDING.CALLING_BOUND
    rested = np.where(calling > bound, bound, calling * DECIDING.CALLING_FACTOR)
    return np.asarray(rested + DECIDING.PERCENT * payoff * reinforcement)


def chance(own: Floats, other: Floats, is_b: NDArray[np.bool_], bias: Floats) -> Floats:
    """Return how probable the other plan is by `BiasedWeightedStochastic`, both plans being open.

    Args:
        own: what the plan of the robot's calling weighs, 0 or more; as all that follow (robots,).
        other: the other one.
        is_b: whether its own is CollectB, the second of the scheme, which of equals comes last.
        bias: of the decision maker.
    """
    least = np.minimum(own, other)
    offset = np.where(least < 1.0, 1.0 - least, 0.0)
    share = (other + offset) / (own + other + 2 * offset)
    first = (share > 0.5) | ((share == 0.5) & is_b)
    return np.where(first, share ** (1 / bias), 1.0 - (1.0 - share) ** (1 / bias))


class SchemeWorlds(ECONOMY.Worlds):
    """Worlds in which schemes decide, each of all robots of its worlds.

    Args:
        drawn: what is different in them.
        seeds: of the draws of decisions, one for each of `drawn`; all schemes meet the same ones.
        numbers: (schemes, 8), in the order of `WRITTEN`.
        ticks: how long they go on.
    """

    def __init__(
        self, drawn: Sequence[Any], seeds: Sequence[int], numbers: Floats, ticks: int
    ) -> None:
        super().__init__(drawn, len(numbers), ticks)
        columns = np.repeat(numbers, len(drawn), axis=0).T
        given = dict(zip(WRITTEN, columns, strict=True))
        self.own, self.other, self.again = (
            np.stack([given[f"{name}_a"], given[f"{name}_b"]])
            for name in ("calling", "plenty_of", "reinforcement")
        )
        self.tolerance, self.bias = given["tolerance"], given["bias"]
        self.calling = np.full(self.role.shape, DECIDING.FIRST_CALLING)
        self.luck = np.ones(self.trips.shape)
        for row, seed in enumerate(seeds):
            size = drawn[row].trips.shape
            self.luck[row, : size[0]] = np.random.default_rng([seed % 2**63, 2]).random(size)

    def decided(
        self,
        rows: NDArray[np.int64],
        who: NDArray[np.int64],
        before: Floats,
        payoff: Floats,
        minds: Any,
    ) -> Floats:
        """Return the roles by the plans that the robots choose."""
        robot = np.minimum(who, self.most - 1)
        is_b = before >= 0.5
        kind = is_b.astype(int)
        calling = reinforced(self.calling[self.rows, robot], payoff, self.again[kind, self.rows])
        lack = DECIDING.PERCENT * (DECIDING.AS_IT_SHOULD_BE - payoff)
        u = self.luck[self.which, robot, self.done[self.rows, robot]]
        own, other = self.own[kind, self.rows] * calling, self.other[kind, self.rows] * lack
        changes = u < chance(own, np.maximum(other, 0.0), is_b, self.bias)
        changed = (lack > self.tolerance) & changes
        calling = np.where(changed, DECIDING.FIRST_CALLING, calling)
        self.calling[rows, robot[rows]] = calling[rows]
        return np.where(is_b ^ changed, 1.0, 0.0)


class SchemeEconomy:
    """Judges genomes of schemes in the worlds of `Economy`, by its terms.

    Args:
        terms: those of `Economy`, where they are not its own.
        ticks: of a world.
    """

    genome_size = len(WRITTEN)

    def __init__(self, terms: Mapping[str, Any] | None = None, ticks: int | None = None) -> None:
        self.terms = ECONOMY.Terms(**(terms or {}))
        self.ticks = ECONOMY.TICKS if ticks is None else ticks

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds; what comes is that of `Economy.run`.

        Args:
            genomes: (individuals, 8).
            seeds: of the worlds.
        """
        return self.run_numbers(numbers_of(np.atleast_2d(genomes)), seeds)

    def run_numbers(self, numbers: Floats, seeds: Sequence[int]) -> Outcome:
        """Judge schemes by their numbers, (schemes, 8); else as `run`."""
        shape = len(numbers), len(seeds)
        drawn = [ECONOMY.World(seed, self.terms, self.ticks) for seed in seeds]
        worlds = SchemeWorlds(drawn, seeds, numbers, self.ticks)
        while worlds.go_on(None):
            pass
        fields = {"within": worlds.out_last == 0, "changes": worlds.late_changes()}
        fields = {name: values.reshape(shape) for name, values in fields.items()}
        score = -worlds.costs(self.terms).reshape(shape)
        ticks = np.full(shape, self.ticks)
        return Outcome(score, ticks, np.zeros(shape, int), fields)
