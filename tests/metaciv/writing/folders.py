"""Folders of MetaCiv's for tests, from a few words each."""

import itertools
from urllib.parse import quote_plus

from socialmind.catalogue import load_model
from socialmind.metaciv.importing import import_model

from ..reading.folders import written

_NUMBER = itertools.count()


def files_of(
    *,
    plans,
    cognitons,
    attributes=(),
    constants=(),
    groups=None,
    objects=(),
    recipes=None,
    carried_effects=None,
    facilities=(),
    effects=None,
    pheromones=None,
    terrains=None,
    rows=None,
    width=5,
    height=4,
    agents=1,
    place=(2, 1),
    scattered=0,
    maker="MaxWeight",
    settings="",
    kinds=None,
    scheme="Folk",
    people="People",
):
    """Return the files of a model with one civilisation.

    Args:
        plans: name -> lines of its actions.
        cognitons: name -> (initial, permitted plans, influences), or lines of its file.
        groups: name -> lines.
        recipes: object or facility -> how many of which.
        carried_effects: object -> effects.
        effects: name -> lines.
        pheromones: name -> (initial, growth), on grass.
        terrains: name -> (passability, impassable); grass is 25.
        kinds: plan -> "self" or "birth".
    """
    home = f"schemasCognitifs/{quote_plus(scheme)}"
    recipes, kinds = recipes or {}, kinds or {}
    files = {
        "parametres.metaciv": (
            f"Carte : Field.metaciv\nDecisionMaker : {maker}DecisionMaker\nMaxWeight : 9\n"
            + (
                settings
                or "RoadCreation : 30\nRoadEvaporation : 1\nVisionRadius : 10\nDispersion : 0\n"
            )
        ),
        f"{home}/{quote_plus(scheme)}.metaciv": f"Nom : {scheme}\n",
        f"simulation/civilisations/{people}.metaciv": (
            f"Nom : {people}\nAgents : {agents}\nScattered : {scattered}\n"
            f"Couleur : 0.1,1.0,1.0\nSchemaCognitif : {scheme}\n"
        ),
    }
    for name, start in dict(attributes).items():
        files[f"{home}/attributes/{name}.metaciv"] = f"Name : {name}\nStarting value : {start}\n"
    for name, value in dict(constants).items():
        files[f"{home}/constants/{name}.metaciv"] = f"Name : {name}\nValue : {value}\n"
    for name, said in cognitons.items():
        if isinstance(said, tuple):
            initial, permits, influences = said
            said = f"Type : BELIEF\nStartChance : 0\nInitial : {int(initial)}\n"
            said += "".join(f"Permet : {one}\n" for one in permits.split())
            said += "".join(f"Influence : {one},{w}\n" for one, w in influences.items())
        files[f"{home}/cognitons/{quote_plus(name)}.metaciv"] = f"Nom : {name}\n{said}"
    for name, lines in (groups or {}).items():
        files[f"{home}/groups/{name}.metaciv"] = f"Name : {name}\n{lines}"
    for name, lines in plans.items():
        kind = kinds.get(name)
        birth, every = (str(kind == one).lower() for one in ("birth", "self"))
        head = f"Nom : {name}\nBirth : {birth}\nSelf : {every}\n"
        body = "\n".join(
            "\t" * ((len(one) - len(one.lstrip())) // 2) + f"Action : {one.strip()}"
            for one in lines.strip("\n").split("\n")
            if one.strip()
        )
        files[f"{home}/plans/{quote_plus(name)}.metaciv"] = f"{head}{body}\n"

    def recipe(name):
        wanted = recipes.get(name, {})
        return (
            f"Objets : {''.join(f'{one},' for one in wanted)}\n"
            f"Nombre : {''.join(f'{many},' for many in wanted.values())}\n"
        )

    for name in objects:
        own = "".join(f"{one}," for one in (carried_effects or {}).get(name, ()))
        files[f"simulation/objets/{name}.metaciv"] = (
            f"Nom : {name}\nEffects : {own}\n{recipe(name)}"
        )
    for name in facilities:
        own = "".join(f"{one}," for one in (carried_effects or {}).get(name, ()))
        files[f"simulation/amenagements/{name}.metaciv"] = (
            f"Nom : {name}\nCouleur : -1\nEffects : {own}\n{recipe(name)}"
        )
    for name, lines in (effects or {}).items():
        files[f"simulation/effects/{name}.metaciv"] = f"Nom : {name}\n{lines}"
    smelt = pheromones or {}
    for name in smelt:
        files[f"simulation/itemPheromones/{name}.metaciv"] = f"Nom : {name}\n"
    deposits = "".join(f"Pheromone : {n},{first},{more}\n" for n, (first, more) in smelt.items())
    grounds = {"Grass": (25, False), **(terrains or {})}
    for name, (passability, closed) in grounds.items():
        files[f"simulation/terrains/{name}.metaciv"] = (
            f"Nom : {name}\nCouleur : 0.3,0.8,0.8\nPassabilite : {passability}\n"
            f"Infranchissable : {str(closed).lower()}\n{deposits if name == 'Grass' else ''}"
        )
    rows = rows or [",".join(["0"] * width)] * height
    files["simulation/environnements/Field.metaciv"] = (
        f"Nom : Field\nLargeur : {width}\nHauteur : {height}\n"
        f"Civilisation : {people},{place[0]},{place[1]}\n"
        + "".join(f"Terrain : {one}\n" for one in grounds)
        + "".join(f"Rang : {row}\n" for row in rows)
    )
    return files


def imported(tmp_path, files, strict=True):
    """Return the class of the model that some files are imported as."""
    name = f"model_{next(_NUMBER)}"
    import_model(written(tmp_path / f"{name}_there", files), tmp_path / name, strict=strict)
    return load_model(tmp_path / name)


def followed(model, ticks, *names, agent=0, **parameters):
    """Return what an agent has at the end of each tick, from tick 3 on, interpreted."""
    society = model(seed=1, compiled=False, **parameters)
    society.advance(2)
    rows = []
    for _ in range(ticks):
        society.advance(1)
        human = society.humans[agent]
        rows.append(tuple(getattr(human, name) for name in names))
    return rows


ARGUMENTS = {
    "Objet": "Objet Corn",
    "Amenagement": "Amenagement Barn",
    "Terrain": "Terrain Grass",
    "Pheromone": "Pheromone Seed",
    "Attribute": "Attribute energy",
    "Cogniton": "Cogniton Joy",
    "Group": "Group Clan",
    "GroupAndRole": "GroupAndRole Clan:one",
    "Integer": "Integer 2",
    "Double": "Double 1.5",
    "String": "String tag",
    "Comparator": "Comparator >=",
}
"""An argument of each type, of the model `everything`."""


def line_of(kind, prefix=""):
    """A line with an action of a kind."""
    parts = [prefix + kind.name]
    if kind.has_direction:
        parts.append("EAST")
    parts += [f"{one.label or 'n'}({ARGUMENTS[one.types[0]]})" for one in kind.arguments]
    return ",".join(parts)


def everything(kinds, per_plan=4, **more):
    """The files of a model whose plans hold each kind of action, some of them in a plan.

    Args:
        kinds: of `ACTIONS`.
        per_plan: how many.
    """
    plans, lines = {}, []
    for kind in kinds:
        lines.append(line_of(kind))
        children = kind.most_children if kind.most_children is not None else 2
        lines += ["  A_AddItem,o(Objet Corn),n(Integer 1)"] * children
        if sum(not one.startswith(" ") for one in lines) == per_plan:
            plans[f"Plan {len(plans) + 1}"], lines = "\n".join(lines), []
    if lines:
        plans[f"Plan {len(plans) + 1}"] = "\n".join(lines)
    will = "Type : BELIEF\nInitial : 1\n"
    will += "".join(f"Permet : {one}\nInfluence : {one},2\n" for one in plans)
    return files_of(
        plans=plans,
        cognitons={"Will": will, "Joy": (True, "", {}), "Lead": (False, "", {})},
        attributes={"energy": 5},
        groups={"Clan": "Culturon : one,Lead\nCulturon : two,Lead\nAutoJoin : false,null\n"},
        objects=("Corn", "Wood"),
        facilities=("Barn",),
        recipes={"Barn": {"Wood": 0}},
        pheromones={"Seed": (1.5, 1.0)},
        terrains={"Hill": (45, False), "Rock": (90, True)},
        rows=["0,0,0,1,0,0,2", "0,1,0,0,0,2,2", "0,0,0,0,0,0,0", "1,1,0,0,0,0,0", "0,0,2,0,0,0,1"],
        width=7,
        height=5,
        agents=12,
        scattered=2,
        maker="WeightedStochastic",
        **more,
    )


def joined(one, other, place=(3, 2)):
    """The files of two models as one of two civilisations, each with its scheme, on one map."""
    files = {**other, **one}
    name = next(file for file in other if file.startswith("simulation/civilisations/"))
    people = name.rpartition("/")[2].removesuffix(".metaciv")
    field = "simulation/environnements/Field.metaciv"
    first, rest = files[field].split("Terrain : ", 1)
    files[field] = f"{first}Civilisation : {people},{place[0]},{place[1]}\nTerrain : {rest}"
    return files
