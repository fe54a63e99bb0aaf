"""A society imported from MetaCiv's files, beside the same written by hand.

Gatherers walk over grass and forest, gather the berries that grow there, eat when they are hungry,
and rest. The imported one is what `socialmind import` writes of the files in `FILES`; the other,
below, is what somebody writes who knows the toolkit and nothing of MetaCiv. Both do the same,
action for action, at the same weights; they draw other luck. They take turns, each round with a
seed of its own, and a ratio is taken within a round.

    python benchmarks/imported.py

The results go to benchmarks/imported.json and, as a table, to benchmarks/README.md.
"""

import argparse
import math
import tempfile
import time
from pathlib import Path
from typing import Any

from harness import HERE, describe_machine, spread, write

from coglogo_py import CognitiveScheme, Cogniton, PositiveStochastic
from socialmind import (
    Agent,
    Grid,
    Model,
    Patch,
    Population,
    each,
    once,
    parameter,
    repeat,
    sequence,
    when,
)
from socialmind.catalogue import load_model
from socialmind.metaciv.importing import import_model

SIZE, AGENTS = 100, 1000
WARM, TICKS = 50, 400
WILL = "Type : BELIEF\nInitial : 1\n"
ROWS = [",".join(str(int((3 * x + 7 * y) % 11 > 7)) for x in range(SIZE)) for y in range(SIZE)]
FILES = {
    "parametres.metaciv": (
        "Carte : Wood.metaciv\nDecisionMaker : WeightedStochasticDecisionMaker\nMaxWeight : 9\n"
        "RoadCreation : 30\nRoadEvaporation : 1\nVisionRadius : 10\nDispersion : 0\n"
    ),
    "schemasCognitifs/Gatherer/Gatherer.metaciv": "Nom : Gatherer\n",
    "schemasCognitifs/Gatherer/attributes/energy.metaciv": "Name : energy\nStarting value : 9\n",
    "schemasCognitifs/Gatherer/constants/meal.metaciv": "Name : meal\nValue : 4\n",
    "schemasCognitifs/Gatherer/cognitons/Will.metaciv": (
        f"Nom : Will\n{WILL}Permet : Gather\nPermet : Rest\nInfluence : Gather,3\n"
        "Influence : Rest,1\n"
    ),
    "schemasCognitifs/Gatherer/cognitons/Hungry.metaciv": (
        "Nom : Hungry\nType : PERCEPT\nInitial : 0\nPermet : Eat\nInfluence : Eat,9\n"
        "Trigger : energy,5.0,-2,__NoConstant\n"
    ),
    "schemasCognitifs/Gatherer/plans/Tire.metaciv": (
        "Nom : Tire\nBirth : false\nSelf : true\n"
        "Action : A_ChangeAttributeDouble,a(Attribute energy),n(Double -0.1)\n"
    ),
    "schemasCognitifs/Gatherer/plans/Gather.metaciv": (
        "Nom : Gather\nBirth : false\nSelf : false\nAction : L_Repeat,n(Integer 3)\n"
        "\tAction : A_AvanceAleatoirement\n"
        "Action : L_ComparePhero,p(Pheromone Berries),c(Comparator >=),n(Double 1.0)\n"
        "\tAction : A_Transform,p(Pheromone Berries),o(Objet Berry)\n\tAction : A_DoNothing\n"
    ),
    "schemasCognitifs/Gatherer/plans/Rest.metaciv": (
        "Nom : Rest\nBirth : false\nSelf : false\nAction : A_DoNothing\nAction : A_DoNothing\n"
    ),
    "schemasCognitifs/Gatherer/plans/Eat.metaciv": (
        "Nom : Eat\nBirth : false\nSelf : false\n"
        "Action : L_OwnObject,o(Objet Berry)\n\tAction : L_Instant\n"
        "\t\tAction : A_DropItem,o(Objet Berry),n(Integer 1)\n"
        "\t\tAction : A_ChangeAttribute,a(Attribute energy),n(Integer 1 Constant meal)\n"
        "\tAction : A_AvanceAleatoirement\n"
    ),
    "simulation/civilisations/Gatherers.metaciv": (
        f"Nom : Gatherers\nAgents : {AGENTS}\nScattered : {SIZE // 2}\nCouleur : 0.1,1.0,1.0\n"
        "SchemaCognitif : Gatherer\n"
    ),
    "simulation/environnements/Wood.metaciv": (
        f"Nom : Wood\nLargeur : {SIZE}\nHauteur : {SIZE}\nCivilisation : Gatherers,0,{SIZE}\n"
        "Terrain : Grass\nTerrain : Forest\n" + "".join(f"Rang : {row}\n" for row in ROWS)
    ),
    "simulation/terrains/Grass.metaciv": (
        "Nom : Grass\nCouleur : 0.3,0.8,0.8\nPassabilite : 25\nInfranchissable : false\n"
        "Pheromone : Berries,2.5,1.5\n"
    ),
    "simulation/terrains/Forest.metaciv": (
        "Nom : Forest\nCouleur : 0.4,0.8,0.5\nPassabilite : 45\nInfranchissable : false\n"
        "Pheromone : Berries,4.0,3.0\n"
    ),
    "simulation/itemPheromones/Berries.metaciv": "Nom : Berries\n",
    "simulation/objets/Berry.metaciv": "Nom : Berry\nEffects : \nObjets : \nNombre : \n",
}
"""The folder of MetaCiv's that is imported."""

# By hand ------------------------------------------------------------------------------------------

HALFWAY = math.sqrt(2) / 2
SCHEME = CognitiveScheme(
    "gatherers",
    (
        Cogniton(
            "Will",
            start_value=1,
            influence={"gather": 3, "rest": 1},
            conditional=("gather", "rest"),
        ),
        Cogniton(
            "Hungry",
            starting=False,
            start_value=1,
            influence={"eat": 9},
            conditional=("eat",),
            active_while="energy < 5",
        ),
    ),
    decision_maker=PositiveStochastic(),
)


class Gatherer(Agent):
    """A gatherer."""

    energy: float = 9.0
    berries: int = 0
    crossed: int = 0


class Wood(Patch):
    """A patch of grass or forest."""

    forest: bool = False
    berries: float = 0.0


def lay(model):
    """Let the first berries hang."""
    for patch in model.world.patches:
        patch.forest = (3 * patch.x + 7 * (model.world.height - 1 - patch.y)) % 11 > 7
        patch.berries = 4 if patch.forest else 2.5


def arrive(gatherer, model, rng):
    """Stand anywhere."""
    gatherer.x = rng.integers(model.world.width)
    gatherer.y = rng.integers(model.world.height)


def live(gatherer, model, rng):
    """Tire, and go on with the plan or choose another."""
    gatherer.energy -= 0.1
    if gatherer.plan_ended:
        gatherer.plan = gatherer.mind.choose_next_plan()
    gatherer.run_plan(model, rng)


def grow(model):
    """Let berries grow, every 150 ticks."""
    if (model.tick + 1) % 150 == 0:
        for patch in model.world.patches:
            patch.berries += 3 if patch.forest else 1.5


def stroll(gatherer, model, rng):
    """Go a patch in any direction; a forest takes two ticks."""
    gatherer.heading = rng.uniform(0, 360)
    gatherer.crossed += 1
    if gatherer.crossed < 2 and model.world.patch(gatherer.x, gatherer.y).forest:
        return
    gatherer.crossed = 0
    angle = math.radians(45 * round(gatherer.heading / 45))
    gatherer.x += round(math.sin(angle) / HALFWAY / 1.5)
    gatherer.y += round(math.cos(angle) / HALFWAY / 1.5)


def hangs_full(gatherer, model):
    """Say whether there is a berry here."""
    return model.world.patch(gatherer.x, gatherer.y).berries >= 1


def pick(gatherer, model):
    """Pick all berries here."""
    here = model.world.patch(gatherer.x, gatherer.y)
    gatherer.berries += int(here.berries)
    here.berries = 0


def has_berries(gatherer):
    """Say whether there is something to eat."""
    return gatherer.berries > 0


def eat(gatherer, model):
    """Eat a berry."""
    gatherer.berries -= 1
    gatherer.energy += model.meal


def wait(gatherer):
    """Let a tick pass."""


class ByHand(Model):
    """Gatherers, as somebody writes them who knows nothing of MetaCiv."""

    meal: float = parameter(4.0)
    gatherers = Population(
        Gatherer,
        AGENTS,
        mind=SCHEME,
        plans={
            "gather": sequence(repeat(3, stroll), when(hangs_full, pick, otherwise=wait)),
            "rest": sequence(wait, wait),
            "eat": when(has_berries, eat, otherwise=stroll),
        },
    )
    world = Grid(SIZE, SIZE, patch=Wood, low=(0, 0))
    setup = (once(lay), each(gatherers, arrive))
    schedule = (each(gatherers, live), once(grow))


# Measuring ----------------------------------------------------------------------------------------


def seconds(kind: Any, seed: int) -> float:
    """Processor seconds of some ticks of a society, after others."""
    society = kind(seed=seed)
    society.advance(WARM)
    start = time.process_time()
    society.advance(TICKS)
    return time.process_time() - start


def imported() -> Any:
    """The class of the imported model."""
    folder = Path(tempfile.mkdtemp(prefix="socialmind-imported-"))
    for file, text in FILES.items():
        path = folder / "there" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    import_model(folder / "there", folder / "gatherers", strict=True)
    return load_model(folder / "gatherers")


def measure(rounds: int) -> dict:
    """Measure both, in turns."""
    kinds = {"imported": imported(), "by hand": ByHand}
    for kind in kinds.values():
        seconds(kind, 0)  # compiled, or loaded
    found: dict[str, list[float]] = {name: [] for name in kinds}
    for seed in range(1, rounds + 1):
        for name, kind in kinds.items():
            found[name].append(seconds(kind, seed))
    return {
        "machine": describe_machine("numba", "numpy"),
        "agents": AGENTS,
        "ticks": TICKS,
        "seconds": found,
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    steps = results["agents"] * results["ticks"] / 1e6
    found = results["seconds"]
    pairs = zip(found["by hand"], found["imported"], strict=True)
    rows = [("times as fast as by hand", [hand / own for hand, own in pairs], ".2f")]
    rows += [
        (f"{name} (million agent-steps a second)", [steps / one for one in taken], ".2f")
        for name, taken in found.items()
    ]
    machine = results["machine"]
    return "\n".join(
        [
            f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
            f"{machine['python']}, numba {machine['numba']}; {len(found['imported'])} rounds, "
            "processor time of one core.",
            "",
            "| | median | least – greatest |",
            "|---|---|---|",
            *(f"| {what} | {spread(values, form)} |" for what, values, form in rows),
        ]
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=9, help="how often both take turns")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments.rounds)
    write(results, table, "imported", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
