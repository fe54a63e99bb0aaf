"""Interactions whose outcome the abilities of both sides weigh, drawn by a decision maker.

Habilitons (thesis, section 9.2.1) are "units of ability or technical knowledge"; an interaction has
an instigator, a recipient and a location, and the habilitons weigh its outcomes as cognitons weigh
plans (equation 3.2): an outcome's weight is its weight at first, plus value times weight of each
link. Here habilitons are fields: of the two agents, and of the patch or agent that is the place.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from coglogo_py import kernel
from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from coglogo_py.decision import BUILT_IN, DecisionMaker, WeightedStochastic
from socialmind.errors import ModelError, called_at, nearest

SIDES = ("instigator", "recipient", "location")
"""Whose abilities weigh the outcomes, in the order in which their links are added."""
Links = Mapping[str, Mapping[str, float]]


@register_jitable
def weigh(weights: Any, begin: Any, abilities: Any, links: Any, values: Any) -> None:
    """Add the links to the weights of the outcomes.

    Args:
        weights: of the outcomes at first, which are changed.
        begin: by outcome, the first of its links.
        abilities: of each link, the place of its ability.
        links: their weights.
        values: the value of each ability.
    """
    for outcome in range(len(weights)):
        for link in range(begin[outcome], begin[outcome + 1]):
            weights[outcome] += links[link] * values[abilities[link]]
        if not math.isfinite(weights[outcome]):
            raise ValueError("an outcome's weight is beyond the largest number")


@dataclass(frozen=True)
class Interaction:
    """What two agents may come to, as an attribute of a model.

    Args:
        name: its name.
        outcomes: what may come of it; their order decides between equal weights.
        instigator: the abilities of the agent that begins: by field, the weight of its link to
            each outcome that it is linked to.
        recipient: likewise of the other agent.
        location: likewise of the place, a patch or an agent; empty where it plays no part.
        base: weights of outcomes before any ability; 0 unless given.
        decision_maker: who draws the outcome, one of the built-in ones.

    Raises:
        ModelError: a part is wrong, with the file and line of the interaction.

    >>> theft = Interaction("theft", ("caught", "gone"), {"skill": {"gone": 2}},
    ...                     {"sight": {"caught": 1}}, base={"caught": 1})
    >>> from types import SimpleNamespace as Some
    >>> theft.weights(Some(skill=3.0), Some(sight=0.5))
    {'caught': 1.5, 'gone': 6.0}
    """

    name: str
    outcomes: tuple[str, ...]
    instigator: Links = field(default_factory=dict)
    recipient: Links = field(default_factory=dict)
    location: Links = field(default_factory=dict)
    base: Mapping[str, float] = field(default_factory=dict)
    decision_maker: DecisionMaker = field(default_factory=WeightedStochastic)
    _at: tuple[str | Path | None, int | None] = field(
        default_factory=called_at, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        object.__setattr__(self, "outcomes", tuple(self.outcomes))
        texts = all(isinstance(one, str) and one for one in self.outcomes)
        if not self.outcomes or not texts or len(set(self.outcomes)) < len(self.outcomes):
            raise self._error(f"the outcomes {shown(self.outcomes)}", "names, each of them once")
        if type(self.decision_maker) not in BUILT_IN:
            known = ", ".join(one.name for one in BUILT_IN)
            raise self._error(f"{shown(self.decision_maker)} as decision maker", f"one of {known}")
        self._check_weights("base", self.base)
        for side in SIDES:
            links = getattr(self, side)
            if not isinstance(links, Mapping):
                expected = "links by ability, {'skill': {'OUTCOME': 1.0}}"
                raise self._error(f"{side}={shown(links)}", expected)
            for ability, weights in links.items():
                self._check_weights(f"the ability {ability!r} of the {side}", weights)

    def _check_weights(self, what: str, weights: Any) -> None:
        """Refuse weights of what is no outcome, and what is no number."""
        if not isinstance(weights, Mapping):
            raise self._error(f"{shown(weights)} as {what}", "weights by outcome")
        for outcome, weight in weights.items():
            if outcome not in self.outcomes:
                hint = nearest(str(outcome), self.outcomes)
                raise self._error(f"the outcome {shown(outcome)} in {what}", None, hint)
            if not is_number(weight):
                found = f"{shown(weight)} as the weight of {outcome!r} in {what}"
                raise self._error(found, "a finite number")

    def _error(self, found: str, expected: str | None, remedy: str | None = None) -> ModelError:
        return ModelError(f"{found} of the interaction {self.name!r}", expected, remedy, *self._at)

    @classmethod
    def load(cls, path: str | Path) -> Interaction:
        """Return the interaction that a YAML file describes (docs/metaciv.md#habilitons).

        Args:
            path: the file; a model's own stands beside it: `Path(__file__).parent / "theft.yaml"`.

        Raises:
            ModelError: it describes none, with the file's line.
        """
        from socialmind.agents.interaction_file import described

        return cls(**described(Path(path), SIDES))

    @property
    def abilities(self) -> tuple[tuple[str, str], ...]:
        """The abilities that weigh the outcomes: side and field."""
        return tuple((side, ability) for side in SIDES for ability in getattr(self, side))

    @cached_property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        """The weights at first, and begin, ability and weight of the links of each outcome."""
        begin, abilities, links = [0], list[int](), list[float]()
        for outcome in self.outcomes:
            for place, (side, ability) in enumerate(self.abilities):
                weights = getattr(self, side)[ability]
                if outcome in weights:
                    abilities.append(place)
                    links.append(float(weights[outcome]))
            begin.append(len(links))
        base = [float(self.base.get(outcome, 0.0)) for outcome in self.outcomes]
        return (
            np.array(base),
            np.array(begin, np.int64),
            np.array(abilities, np.int64),
            np.array(links, np.float64),
        )

    @property
    def maker(self) -> tuple[int, float]:
        """The code of the decision maker, and its bias."""
        return kernel.CODES[self.decision_maker.name], self.decision_maker.bias

    def _weights(self, sides: tuple[Any, ...]) -> NDArray[np.float64]:
        by_side = dict(zip(SIDES, sides, strict=False))
        values = [float(getattr(by_side[side], one)) for side, one in self.abilities]
        weights, *links = (array.tolist() for array in self.arrays)
        weigh(weights, *links, values)
        return np.array(weights)

    def weights(self, *sides: Any) -> dict[str, float]:
        """Return the weights of the outcomes between an instigator and a recipient, at a place."""
        return dict(zip(self.outcomes, self._weights(sides).tolist(), strict=True))

    def probabilities(self, *sides: Any) -> dict[str, float]:
        """Return how probable the outcomes are between two agents, at a place."""
        maker = self.decision_maker
        chances = maker.probabilities(self._weights(sides), maker.bias)
        return dict(zip(self.outcomes, chances.tolist(), strict=True))

    def outcome(self, *sides_and_rng: Any) -> str:
        """Draw the outcome: `outcome(instigator, recipient, rng)`, a place before `rng`."""
        *sides, rng = sides_and_rng
        code, bias = self.maker
        return self.outcomes[
            int(kernel.choose(code, bias, self._weights(tuple(sides)), rng.random()))
        ]
