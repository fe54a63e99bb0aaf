"""Farmers and artisans who were taught: a learned mind weighs the plans, not the scheme's links.

World, people and cognitons are those of `farmer_artisan` (thesis, section 3.3). A hierarchy of
skills reads the cognitons and weighs the plans in place of the scheme's influence links; which
plans are available, what trade does to the callings and how a plan is drawn stay the scheme's.
"""

from socialmind import Population
from socialmind.catalogue import load_file, model_folder
from socialmind.mind.weighing import Weighing

FARMERS = load_file(model_folder("farmer_artisan") / "model.py")
REACHES = {  # the value of each cogniton at which its sensor reads 1
    "ToolStock": 20.0,
    "WheatStock": 1000.0,
    "WheatNeed": 1000.0,
    "WheatDemand": 50.0,
    "Farmer": FARMERS.CALLING_BOUND,
    "Artisan": FARMERS.CALLING_BOUND,
    "ToolDemand": 50.0,
}
LARGEST_WEIGHT = 1000.0  # of a plan


class FarmerArtisanLearned(FARMERS.FarmerArtisan):
    """A learned mind decides in the place of the farmers' and artisans' scheme."""

    humans = Population(
        FARMERS.Human,
        "n_agents",
        mind="../farmer_artisan/scheme.yaml",
        plans=FARMERS.FarmerArtisan.humans.plans,
        hierarchy="mind",
        weighing=Weighing(REACHES, LARGEST_WEIGHT),
    )
