"""Who is compared, and what happens to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import pandas as pd

from socialmind.drawing import style as paper

WANTED_B = 2 / 3
"""The share of objects B that is wanted, until the ratio is turned round."""


@dataclass(frozen=True)
class Society:
    """A society of robots.

    Attributes:
        name: in tables.
        title: in figures and text.
        about: who decides about the robots' roles, in a line.
        parameters: of the model.
        colour: in figures.
        thesis: whether its mind is the one that was learned as in the thesis.
    """

    name: str
    title: str
    about: str
    parameters: Mapping[str, float] = field(default_factory=dict)
    colour: str = paper.INK
    thesis: bool = False


SOCIETIES = {
    one.name: one
    for one in (
        Society(
            "programmed", "programmed",
            "a cogniton scheme that somebody wrote; its plans are the callings, reinforced by the "
            "payoff of each delivery",
            {"programmed": 1.0}, paper.RED,
        ),
        Society(
            "learned", "learned",
            "the skill ForageRole of a hierarchy, learned by all robots as one genome",
            colour=paper.BLUE,
        ),
        Society(
            "fixed", "fixed roles",
            "nobody: robots begin in the wanted split and stay what they are",
            {"unlearned": 1}, paper.INK,
        ),
        Society(
            "random", "random roles",
            "luck: after each delivery the role is drawn by the ratio wanted at the start",
            {"unlearned": 2}, paper.GREY,
        ),
        Society(
            "greedy", "greedy",
            "the last payoff: a robot whose object was worth less than 0.5 takes the other role",
            {"unlearned": 3}, paper.GOLD,
        ),
        Society(
            "thesis", "as in the thesis",
            "a perceptron that was learned as in the thesis: nine undecided robots, one ratio, no "
            "shock, judged by the counts alone",
            colour=paper.PURPLE, thesis=True,
        ),
    )
}  # fmt: skip
"""By name. In all of them the same trained skills, Collect A and Collect B, carry out the role."""
REFERENCE = "learned"
"""The society that the others are compared with."""


@dataclass(frozen=True)
class Condition:
    """What happens to a society half-way.

    Attributes:
        name: in tables.
        title: in figures.
        about: what happens, in a clause.
        when: the same, at the beginning of a sentence.
        parameter: of the model, which says when it happens; empty for nothing.
        marker: in figures.
    """

    name: str
    title: str
    about: str
    when: str
    parameter: str = ""
    marker: str = "o"

    def parameters(self, half: int) -> dict[str, int]:
        """Return the parameters of the model.

        Args:
            half: the tick of the first record that sees what happened.
        """
        return {self.parameter: half - 1} if self.parameter else {}

    def shocks(self, half: int) -> tuple[int, ...]:
        """Return the ticks of its shocks."""
        return (half,) if self.parameter else ()

    def wanted(self, half: int) -> pd.DataFrame:
        """Return the wanted ratio, as `socialmind.experiments.measures.split` takes it."""
        before = {"tick": 0, "A": 1 - WANTED_B, "B": WANTED_B}
        after = {"tick": half, "A": WANTED_B, "B": 1 - WANTED_B}
        return pd.DataFrame([before, after] if self.name == "turned" else [before])


CONDITIONS = {
    one.name: one
    for one in (
        Condition("undisturbed", "undisturbed", "nothing happens", "Undisturbed"),
        Condition(
            "turned", "ratio turned round", "the wanted ratio is turned round",
            "With the ratio turned round", "reverse_at", "s",
        ),
        Condition(
            "removed", "three taken away", "three robots in A are taken away",
            "With three robots in A taken away", "remove_at", "^",
        ),
        Condition(
            "added", "three added", "three robots are added",
            "With three robots added", "add_at", "D",
        ),
    )
}  # fmt: skip
"""By name. Robots that are taken away have the role A, of which the fewer are wanted."""
MIXED = ("undisturbed", "turned")
"""The conditions of mixed societies."""


@dataclass(frozen=True)
class Size:
    """How much is run.

    Attributes:
        worlds: for each society and condition.
        ticks: of each.
        shares: of programmed robots, in mixed societies.
        farmers: seeds of the societies of farmers and artisans.
        farmers_ticks: of each.
    """

    worlds: int
    ticks: int
    shares: tuple[float, ...]
    farmers: int
    farmers_ticks: int

    @property
    def half(self) -> int:
        """The tick of what happens half-way."""
        return self.ticks // 2


FULL = Size(50, 60_000, tuple(n / 9 for n in range(10)), 20, 50_000)
QUICK = Size(6, 30_000, (0.0, 1 / 3, 2 / 3, 1.0), 6, 50_000)
SEED = 6001
"""Of the first world; the others follow. All societies meet the same ones."""
