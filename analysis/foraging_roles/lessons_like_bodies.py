"""Lessons by deliveries in an economy that is like bodies, for choosing among what they come to.

CollectSelect, then ForageRole, begun anew until a start is good enough, then ForageRole once more:
there each change of what robots bring costs, whenever it is. Robots that all answer to the same
payoff at the same time overshoot, again and again, until by luck they are as wanted; what does not
overshoot is found by what it costs to.
"""

from __future__ import annotations

from socialmind.catalogue import load_file
from socialmind.learning import Curriculum

from .economy_like_bodies import DeliveryEconomy, Errands
from .trainings import MODEL

LESSONS = load_file(MODEL / "role_lessons.py")
NOTHING, REVERSED, REMOVED, ADDED = range(4)

choose = LESSONS.choose.changed(environment=Errands)
settle = LESSONS.delivered_narrow.changed(
    name="delivered, like bodies",
    environment=DeliveryEconomy,
    generations=220,
    starts=3,
    enough=-0.2,
    finalists=12,
    finals=192,
    parameters={
        "numbers": (6, 8, 9, 9, 9, 12),
        "ratios": (1 / 3, 2 / 3, 1 / 3, 2 / 3, 1 / 2),
        "events": (NOTHING, REVERSED, REVERSED, REMOVED, REMOVED, ADDED),
        "out_late": 1.0,
    },
)
"""What is hard to learn comes up the more often: ratios that turn, and robots that are gone."""
steadily = settle.changed(
    name="delivered, like bodies, steadily",
    settings={"population": 40, "step": 0.2},
    repetitions=24,
    generations=140,
    starts=1,
    enough=None,
    start="known",
    spread=0.1,
    finalists=20,
    finals=256,
    parameters={
        "numbers": (8, 9, 9, 10),
        "ratios": (1 / 3, 2 / 3),
        "events": (NOTHING, REVERSED, REVERSED, REMOVED, REMOVED, REMOVED, ADDED),
        "out_late": 1.0,
        "unsettled": 0.5,
        "turns": 0.15,
    },
)

like_bodies = Curriculum((choose, settle, steadily), mind=LESSONS.choosing())
