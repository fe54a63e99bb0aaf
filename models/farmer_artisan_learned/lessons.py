"""What the farmers and artisans are taught: to do well, all of them together.

One mind is learned for all, from nothing, in the society itself. Nobody is told to trade or to
specialise.
"""

from socialmind.learning import Curriculum, Lesson
from socialmind.mind import MindDescription, Perceptron, Skill

from .model import FARMERS, REACHES, FarmerArtisanLearned

PLANS = tuple(FARMERS.FarmerArtisan.humans.plans)

MIND = MindDescription(
    "villager",
    sensors=list(REACHES),
    actuators=list(PLANS),
    skills=[
        Skill(
            "Decide",
            [f"SE:{cogniton}" for cogniton in REACHES],
            [f"MO:{plan}" for plan in PLANS],
            Perceptron(layers=1),
        )
    ],
)


class Prosperity(FarmerArtisanLearned):
    """The wheat that a villager has, on the mean, over that which leaves no need.

    It is looked at all through the episode. What is there in the end alone teaches to make tools
    for so long at the beginning, and none later: a society that starves soon after.
    """

    ticks = 4_000
    score_every = 500

    def score(self):
        """Return the mean stock of wheat over a comfortable one."""
        return float(self.humans.wheat.mean()) / FARMERS.COMFORT


curriculum = Curriculum(
    (
        Lesson(
            "Decide",
            Prosperity,
            optimiser="CMAES",
            generations=45,
            repetitions=1,
            finalists=2,
            finals=3,
        ),
    ),
    mind=MIND,
)
