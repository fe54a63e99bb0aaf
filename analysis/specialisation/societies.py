"""Who is compared, and what happens to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import pandas as pd

from socialmind.catalogue import load_file
from socialmind.drawing import style as paper
from socialmind.experiments.studies import topics

TRAINED = topics()["foraging_roles"]
CONTROLLERS = load_file(TRAINED / "threshold_scan.py").CONTROLLERS

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
        dash: of its lines.
        lesson: whose attempts its minds are, all that are kept in `analysis/foraging_roles`; empty
            where nothing was learned.
    """

    name: str
    title: str
    about: str
    parameters: Mapping[str, float]
    colour: str
    dash: Any = "-"
    lesson: str = ""


def unlearned(which: int) -> Mapping[str, float]:
    """Return the parameters of robots of which neither a scheme nor a mind decides."""
    return {"unlearned": which}


LEARNED: Mapping[str, float] = {"unlearned": 0}
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
            "fixed_thresholds", "fixed thresholds",
            "response thresholds that differ between robots and stay (Bonabeau et al., 1998)",
            CONTROLLERS["fixed_thresholds"], paper.TEAL,
        ),
        Society(
            "reinforced_thresholds", "reinforced thresholds",
            "response thresholds that fall with doing and rise without (Theraulaz et al., 1998)",
            CONTROLLERS["reinforced_thresholds"], paper.TEAL, (0, (4, 2)),
        ),
        Society(
            "evolved", "scheme, evolved",
            "the same scheme, its eight numbers fitted by the optimiser, in the worlds and by the "
            "loss of the supervised lesson, in place of somebody's",
            {"programmed": 1.0}, paper.RED, (0, (4, 2)), lesson="evolved_scheme",
        ),
        Society(
            "delivered", "learned by deliveries",
            "the skill ForageRole of a hierarchy, learned by all robots as one genome, whose "
            "teacher sees what they bring home alone; CollectSelect was learned before (lesson "
            "`delivered_anew`)",
            LEARNED, paper.BLUE, lesson="delivered_anew",
        ),
        Society(
            "supervised", "learned, supervised",
            "the same skill, taught by a teacher that sees the variable ROLE; what ROLE means is a "
            "program (lesson `supervised_role`)",
            LEARNED, paper.BLUE, (0, (4, 2)), lesson="supervised_role",
        ),
        Society(
            "chosen", "by deliveries, chosen",
            "the same skill, learned by deliveries in an economy whose trips and distances are as "
            "in bodies; which of an attempt's minds counts was chosen in bodies, in 36 to 72 "
            "worlds for choosing (lesson `like_bodies`)",
            LEARNED, paper.BLUE, (0, (6, 1.5, 1, 1.5)), lesson="chosen_again",
        ),
        Society(
            "picked", "supervised, picked",
            "the mind of the model: one more attempt at the supervised lesson, picked because it "
            "came out well; shown for what picking does",
            LEARNED, paper.BLUE, (0, (1, 1.5)),
        ),
        Society(
            "counts", "learned by the counts",
            "the same skill, a perceptron taught with nine undecided robots, one ratio and no "
            "shock, judged by the counts alone; not in bodies, where the thesis's was",
            LEARNED, paper.BLUE, (0, (3, 1, 1, 1, 1, 1)), lesson="counts",
        ),
        Society(
            "fixed", "fixed roles",
            "nobody: robots begin in the wanted split and stay what they are",
            unlearned(1), paper.INK, (0, (8, 2)),
        ),
        Society(
            "random", "random roles",
            "luck: after each delivery the role is drawn by the ratio wanted at the start",
            unlearned(2), paper.GREY, (0, (1, 1.5)),
        ),
        Society(
            "greedy", "greedy",
            "the last payoff: a robot whose object was worth less than 0.5 takes the other role",
            unlearned(3), paper.GREY, (0, (5, 1.5, 1, 1.5)),
        ),
    )
}  # fmt: skip
"""By name. In all of them the same trained skills, Collect A and Collect B, carry out the role."""
FALL_SHORT = ("counts", "fixed", "random", "greedy")
"""The societies that are there to show what does not settle, or does not follow."""
REFERENCE = "programmed"
"""The society that the others are compared with."""
LESSONS = ("chosen", "delivered", "supervised")
COMPARED_WITH = (
    ("chosen", "delivered"),
    ("delivered", "supervised"),
    *product(LESSONS, ("fixed_thresholds", "reinforced_thresholds", "evolved", "random", "greedy")),
    ("fixed", "random"),
)
"""Societies that are compared with others too: with the lesson that theirs was to mend, with that
which looks into minds, with what nobody learned, with a scheme that was fitted with as much effort
as one of them, and with those who never divide the work."""
MIXED_WITH = "delivered"
"""The society whose robots share a society with programmed ones."""


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
            "removed", "three taken away",
            "three robots are taken away, of those in A as long as there are any",
            "With three robots taken away", "remove_at", "^",
        ),
        Condition(
            "added", "three added", "three robots are added",
            "With three robots added", "add_at", "D",
        ),
    )
}  # fmt: skip
"""By name. Robots that are taken away have the role A, of which the fewer are wanted; where fewer
than three have it others go too, so that in all worlds as many are left."""
MIXED = ("undisturbed", "turned")
"""The conditions of mixed societies."""


@dataclass(frozen=True)
class Size:
    """How much is run.

    Attributes:
        worlds: for each society and condition where nothing was learned.
        attempt_worlds: for each attempt at a lesson and condition, the first of these.
        ticks: of each.
        mixed_worlds: for each mixture and attempt.
        mixed: numbers of programmed robots among nine, in mixed societies.
        attempts: of a lesson at most; None for all that are kept.
        farmers: seeds of the societies of farmers and artisans.
        farmers_ticks: of each.
    """

    worlds: int
    attempt_worlds: int
    ticks: int
    mixed_worlds: int
    mixed: tuple[int, ...]
    attempts: int | None
    farmers: int
    farmers_ticks: int

    @property
    def half(self) -> int:
        """The tick of what happens half-way."""
        return self.ticks // 2


ROBOTS = 9
FULL = Size(20, 10, 60_000, 5, (3, 6), None, 20, 50_000)
QUICK = Size(4, 2, 20_000, 2, (3,), 2, 4, 20_000)
SEED = 6001
"""The seed of the first world of robots; worlds in which nothing was trained or chosen."""
