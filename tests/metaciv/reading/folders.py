"""Small folders of MetaCiv's, written as its program does."""

from pathlib import Path

_HOMES = (one / "shared" / "data" / "metaciv" for one in Path(__file__).parents)
SAMPLES = next((one for one in _HOMES if one.is_dir()), None)
"""Folders with what must happen in them; None where they are not."""

WORLD = {
    "parametres.metaciv": (
        "Carte : Valley.metaciv\nDecisionMaker : MaxWeightDecisionMaker\nMaxWeight : 10\n"
        "RoadCreation : 30\nRoadEvaporation : 1\nVisionRadius : 10\nDispersion : 0\n"
    ),
    "simulation/civilisations/Farmers.metaciv": (
        "Nom : Farmers\nAgents : 2\nScattered : 1\nCouleur : 0.1,1.0,1.0\nSchemaCognitif : Farmer\n"
    ),
    "simulation/environnements/Valley.metaciv": (
        "Nom : Valley\nLargeur : 3\nHauteur : 2\nCivilisation : Farmers,0,1\n\n"
        "Terrain : Grass\nTerrain : Rock\nRang : 0,0,1\nRang : 0,0,0\n"
    ),
    "simulation/terrains/Grass.metaciv": (
        "Nom : Grass\nCouleur : 0.3,0.8,0.8\nPassabilite : 25\nInfranchissable : false\n"
        "Pheromone : Corn,2.5,0.0\n"
    ),
    "simulation/terrains/Rock.metaciv": (
        "Nom : Rock\nCouleur : 0.0,0.0,0.4\nPassabilite : 80\nInfranchissable : true\n"
    ),
    "simulation/itemPheromones/Corn.metaciv": "Nom : Corn\n",
    "simulation/objets/Bread.metaciv": (
        "Nom : Brown bread\nDescription : to eat\nIcone : b.png\nEffects : Fed,\n"
        "Objets : Sack of corn,\nNombre : 2,\n"
    ),
    "simulation/objets/Sack.metaciv": "Nom : Sack of corn\nEffects : \nObjets : \nNombre : \n",
    "simulation/amenagements/Mill.metaciv": (
        "Nom : Mill\nCouleur : -1\nEffects : \nObjets : Brown bread,\nNombre : 1,\n"
    ),
    "simulation/effects/Fed.metaciv": (
        "Nom : Fed\nCible : attribut\nNomCible : energy\nValeur : 1.5\nPermanence : true\n"
        "Type : 1\nActivation : 1\n"
    ),
}
SCHEME = {
    "Farmer.metaciv": "Nom : Farmer\nWeightInterval : __WIBOTH\nWeightBound : 10.0\n",
    "attributes/energy.metaciv": "Name : energy\nStarting value : 4.5\n",
    "constants/meal.metaciv": "Name : meal\nValue : 3.0\n",
    "cognitons/Will.metaciv": (
        "Nom : Will\nDescription : wants : more\nType : BELIEF\nStartChance : 0\nCouleur : -1\n"
        "Initial : 1\nPermet : Work\nInfluence : Work,2\n"
    ),
    "cognitons/Hungry.metaciv": (
        "Nom : Hungry\nType : PERCEPT\nStartChance : 0\nInitial : 0\nPermet : Work\n"
        "Influence : Work,-3\nTrigger : energy,2.0,-2,meal\nTrigger : energy,1.0,0,__NoConstant\n"
    ),
    "groups/Village.metaciv": (
        "Name : Village\nCulturon : chief,Hungry\nCulturon : member,Will\nAutoJoin : true,member\n"
    ),
    "plans/Work.metaciv": (
        "Nom : Work\nBirth : false\nSelf : false\nCouleur : -1\n"
        "Action : L_CompareObject,what(Objet Brown bread),comparator(Comparator >=),n(Double 1.0)\n"
        "\tAction : A_UseObject,what(Objet Brown bread),n(Integer 1)\n"
        "\tAction : L_Instant\n"
        "\t\tAction : A_CreateObject,what(Objet Brown bread)\n"
        "\t\tAction : A_ChangeAttribute,n(Integer -1 Constant meal),which(Attribute energy)\n"
        "Action : A_ChangeRoleForAnother,Change to that role :(GroupAndRole Village:chief)\n"
        "Action : A_Move,NORTH\n"
    ),
}
FARMERS = WORLD | {f"schemasCognitifs/Farmer/{file}": text for file, text in SCHEME.items()}
"""A folder of the format V2.0 in which nothing is odd."""


def flat() -> dict[str, str]:
    """Return the same in the older format."""
    files = {file.removeprefix("simulation/"): text for file, text in WORLD.items()}
    files |= {file: text for file, text in SCHEME.items() if "/" in file}
    files.pop("constants/meal.metaciv")
    files["parametres.metaciv"] = "Carte : Valley.metaciv\nDecisionMaker : MaxWeightDecisionMaker\n"
    files["civilisations/Farmers.metaciv"] = (
        "Nom : Farmers\nAgents : 2\nScattered : 1\nCouleur : 0.1,1.0,1.0\nCogniton : Hungry\n"
    )
    files["cognitons/Hungry.metaciv"] = (
        "Nom : Hungry\nType : PERCEPT\nStartChance : 40\nHue0 : 1\nPermet : Work\n"
        "Influence : Work,-3\nTrigger : energy,2.0,-2\n"
    )
    return files


def written(folder: Path, files: dict[str, str | bytes]) -> Path:
    """Write files into a folder, and return it."""
    for file, content in files.items():
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder
