"""What a reader of the page may look up: words, references, marks of its tables."""

from __future__ import annotations

import numpy as np

from socialmind.experiments.measures.intervals import share_interval

BOUND, WORLDS = 0.75, 40
"""What the worst attempt was to reach; worlds of each choice in which nothing was chosen."""


def unsure(share: float, bound: float = BOUND, worlds: int = WORLDS) -> bool:
    """Whether a share of worlds has an interval that reaches below a bound.

    >>> unsure(0.95), unsure(0.85)
    (False, True)
    """
    return share_interval(np.arange(worlds) < round(share * worlds)).low < bound


WORDS = [
    {"word": word, "meaning": meaning}
    for word, meaning in (
        ("tick", "a step of the clock; a trip for an object takes some 800 of them"),
        ("object A, B", "what robots look for in the arena, carry to the drop zone in its middle, "
         "and are paid for; delivered ones are laid out anew"),
        ("market, decay", "counts of delivered objects of both kinds, of which 0.05 % fade each "
         "tick; they say how scarce a kind is beside the wanted ratio"),
        ("payoff", "what a delivered object is worth to all, 0 … 1: 0.5 where the counts stand in "
         "the wanted ratio, more for the scarcer kind; all that a robot is ever told"),
        ("role", "which kind a robot fetches, A or B; the split is how many have each, the "
         "wanted one 3 : 6"),
        ("keep the split", "be within one robot of the wanted split all through the last quarter"),
        ("settle", "come within one robot of the wanted split and stay there for 5,000 ticks"),
        ("programmed mind", "a cognitive scheme: cognitons, quantities such as beliefs and needs, "
         "whose links speak for plans and against them. Of the plans that are open one is drawn, "
         "the more probably the more speaks for it. Callings are cognitons that stand for a role"),
        ("learned mind", "a hierarchy of skills, small functions, most of them perceptrons, that "
         "give each other influence. ForageRole writes the variable ROLE, CollectSelect reads it "
         "and gives its influence to the skill that collects A or to the one that collects B. It "
         "draws nothing: what it does follows from what it reads"),
        ("genome", "the weights of the skills that learn; all robots of a society have the same"),
        ("lesson, attempt", "what an optimiser (CMA-ES) is to make better, in which worlds; one "
         "training at it from nothing, with luck of its own"),
        ("economy", "a world without an arena, in which a trip is a time that is drawn; "
         "roles are learned there, in far less time. The plain one has trips that differ as they "
         "like; the other has trips and distances as they were measured in bodies"),
        ("in bodies", "in the arena, where robots see, drive, grip and are in each other’s sight"),
        ("comfortable stock", "the wheat with which a farmer or artisan feels no need"),
        ("distilled", "of a scheme: fitted to choose as a learned mind does"),
    )
]  # fmt: skip
REFERENCES = (
    "Bonabeau, E., Theraulaz, G. & Deneubourg, J.-L. (1998). Fixed response thresholds and the "
    "regulation of division of labor in insect societies. Bulletin of Mathematical Biology 60, "
    "753–807.",
    "Efron, B. (1987). Better bootstrap confidence intervals. Journal of the American Statistical "
    "Association 82, 171–185.",
    "Gorelick, R., Bertram, S. M., Killeen, P. R. & Fewell, J. H. (2004). Normalized mutual "
    "entropy in biology: quantifying division of labor. The American Naturalist 164, 677–682.",
    "Newcombe, R. G. (1998). Interval estimation for the difference between independent "
    "proportions: comparison of eleven methods. Statistics in Medicine 17, 873–890.",
    "Owen, A. B. (2007). The pigeonhole bootstrap. The Annals of Applied Statistics 1, 386–411.",
    "Suro, F. (2020). Epigenetic learning of autonomous behaviours in a society of agents. Thesis, "
    "Université de Montpellier: the robots and their roles in 8.2, farmers and artisans in 3.3.",
    "Theraulaz, G., Bonabeau, E. & Deneubourg, J.-L. (1998). Response threshold reinforcement and "
    "division of labour in insect societies. Proceedings of the Royal Society B 265, 327–332.",
    "Wilson, E. B. (1927). Probable inference, the law of succession, and statistical inference. "
    "Journal of the American Statistical Association 22, 209–212.",
)
