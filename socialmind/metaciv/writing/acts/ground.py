"""Actions on the ground: walking, pheromones, terrain."""

from __future__ import annotations

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.acts.form import Act, Ask, Writer, comparing, in_name, name_of
from socialmind.metaciv.writing.acts.things import gaining
from socialmind.metaciv.writing.sheet import Sheet

HEADINGS = {"NORTH": 0, "EAST": 90, "SOUTH": 180, "WEST": 270}
SMELL = 20
"""How far agents smell and look for resources, in cells; MetaCiv has no parameter for it."""

GO = '''
def go_to(human, model, rng, x, y):
    """Work one tick on the way to a place; return whether it is reached."""
    if model.world.is_on(human, x, y):
        return True
    step_towards(human, model, x, y, model.vision_radius, EASIEST, ROADS, rng)
    return False
'''


def walking(sheet: Sheet) -> str:
    """Return the line by which an agent goes on ahead."""
    sheet.needs.add("walk")
    sheet.use("socialmind.terrain", "step_ahead")
    return f"step_ahead(human, model, {roads(sheet)}, rng)"


def roads(sheet: Sheet) -> str:
    """Return when a patch is a road; never, where nobody looks for the cheapest way."""
    if "ways" not in sheet.needs or sheet.model.parameters.road_creation <= 0:
        return "0"
    sheet.needs.add("roads")
    return "model.road_creation"


def going(sheet: Sheet, x: str, y: str) -> str:
    """Return the expression by which an agent goes on to a place: whether it is there."""
    sheet.needs |= {"walk", "ways"}
    sheet.use("socialmind.terrain", "step_towards")
    passable = [one.passability for one in sheet.model.terrains]
    sheet.constants["EASIEST"] = (
        f"{max(min(passable), 1)}.0  # effort that is expected of ground out of sight"
    )
    sheet.help("go_to", GO.replace("ROADS", roads(sheet)))
    return f"go_to(human, model, rng, {x}, {y})"


def wander(sheet: Sheet, action: Action) -> Act:
    """A_AvanceAleatoirement."""
    body = ["human.heading = rng.uniform(0, 360)", walking(sheet)]
    return Act(("wander",), "Go on in any direction.", body)


def move(sheet: Sheet, action: Action) -> Act:
    """A_Move."""
    direction = str(action.direction)
    body = [f"human.heading = {HEADINGS[direction]}", walking(sheet)]
    name = f"go_{direction.lower()}"
    return Act((name, f"walk_{direction.lower()}"), f"Go on to the {direction.lower()}.", body)


def move_askew(sheet: Sheet, action: Action) -> Act:
    """A_Move_Cardinals_Random."""
    direction = (action.direction or "NORTH").rpartition("=")[2].strip().upper()
    heading = HEADINGS.get(direction, 0)
    body = [f"human.heading = {heading} + rng.uniform(-90, 90)", walking(sheet)]
    name = f"stray_{direction.lower() if direction in HEADINGS else 'north'}"
    return Act((name,), f"Go on roughly to the {name.rpartition('_')[2]}.", body)


# Pheromones -------------------------------------------------------------------------------------

IN_SMELL = '''
def in_reach(human, patch):
    """Return whether a patch is near without going over the edge of the map."""
    return abs(patch.x - human.x) <= SMELL and abs(patch.y - human.y) <= SMELL
'''


def smell_and_move(sheet: Sheet, action: Action) -> Act:
    """A_SmellAndMove."""
    pheromone = str(action.argument("Pheromone").value)
    field = sheet.pheromone(pheromone)
    sheet.constants["SMELL"] = f"{SMELL}  # patches, as far as agents smell"
    sheet.help("in_reach", IN_SMELL)
    body = [
        "most = -math.inf",
        "for patch in model.world.neighbours(human, steps=SMELL):",
        "    if in_reach(human, patch):",
        f"        most = max(most, patch.{field})",
        "if most > -math.inf:  # else there is no other patch",
        "    spot = rng.choice(",
        "        patch",
        "        for patch in model.world.neighbours(human, steps=SMELL)",
        f"        if patch.{field} == most and in_reach(human, patch)",
        "    )",
        "    human.heading = math.degrees(math.atan2(spot.x - human.x, spot.y - human.y))",
        walking(sheet),
    ]
    return Act((f"follow_{field}",), f"Go where there is most {pheromone} around.", body)


def search_resources(sheet: Sheet, action: Action) -> Act:
    """A_SearchForRessources."""
    pheromone = str(action.argument("Pheromone").value)
    field = sheet.pheromone(pheromone)
    sheet.constants["SMELL"] = f"{SMELL}  # patches, as far as agents smell"
    sheet.help("in_reach", IN_SMELL)
    _goal(sheet)
    body = [
        "if human.has_goal:",
        f"    human.has_goal = not {going(sheet, 'human.goal_x', 'human.goal_y')}",
        "    return not human.has_goal",
        f"least = 0 if model.world.patch(human.x, human.y).{field} >= 1 else 2 * SMELL + 1",
        "human.goal_x = human.x",
        "human.goal_y = human.y",
        "for patch in model.world.neighbours(human, steps=SMELL):",
        "    away = abs(patch.x - human.x) + abs(patch.y - human.y)",
        f"    if patch.{field} >= 1 and away < least and in_reach(human, patch):",
        "        least = away",
        "        human.goal_x = patch.x",
        "        human.goal_y = patch.y",
        "if least <= 2 * SMELL:",
        "    human.has_goal = True",
        "    return False",
        "human.heading = rng.uniform(0, 360)",
        walking(sheet),
        "return True",
    ]
    return Act((f"search_{field}",), f"Go to the nearest patch with {pheromone}.", body, True)


def _goal(sheet: Sheet) -> None:
    sheet.field("has_goal", "bool = False")
    sheet.field("goal_x", "float = 0.0  # where it wants to go")
    sheet.field("goal_y", "float = 0.0")


def go_to_goal(sheet: Sheet, action: Action) -> Act:
    """A_GoToTarget."""
    _goal(sheet)
    body = [
        f"if human.has_goal and not {going(sheet, 'human.goal_x', 'human.goal_y')}:",
        "    return False",
        "human.has_goal = False",
        "return True",
    ]
    return Act(("go_to_goal",), "Go where it wanted to go.", body, True)


def go_home(sheet: Sheet, action: Action) -> Act:
    """A_Rentrer."""
    sheet.field("home_x", "float = 0.0  # where its civilisation began")
    sheet.field("home_y", "float = 0.0")
    sheet.needs.add("home")
    body = [f"return {going(sheet, 'human.home_x', 'human.home_y')}"]
    return Act(("go_home",), "Go to where its civilisation began.", body, True)


def transform(sheet: Sheet, action: Action) -> Act:
    """A_Transform, A_Transformer."""
    pheromone, thing = (str(action.argument(one).value) for one in ("Pheromone", "Objet"))
    field = sheet.pheromone(pheromone)
    body = ["here = model.world.patch(human.x, human.y)"]
    body += gaining(sheet, thing, f"int(here.{field})")
    body += [f"here.{field} = 0"]
    name = f"gather_{name_of(thing)}"
    doc = f"Make {thing} of all {pheromone} here; a fraction is lost."
    return Act((name, f"{name}_of_{field}"), doc, body)


def collect(sheet: Sheet, action: Action) -> Act:
    """A_Collect."""
    pheromone = str(action.argument("Pheromone").value)
    field, amount = sheet.pheromone(pheromone), sheet.number(action.argument("Double"))
    here, bare = f"model.world.patch(human.x, human.y).{field}", amount.removeprefix("-")
    if bare != amount:
        names = (f"take_{field}", f"take_{in_name(bare)}_{field}")
        return Act(names, f"Take {bare} {pheromone} from the patch.", [f"{here} -= {bare}"])
    names = (f"leave_{field}", f"leave_{in_name(amount)}_{field}")
    return Act(names, f"Add {amount} {pheromone} to the patch.", [f"{here} += {amount}"])


def compare_pheromone(sheet: Sheet, action: Action) -> Ask:
    """L_ComparePhero, L_CompareResource."""
    pheromone = str(action.argument("Pheromone").value)
    number, how = sheet.number(action.argument("Double")), str(action.argument("Comparator").value)
    field = sheet.pheromone(pheromone)
    here = f"model.world.patch(human.x, human.y).{field}"
    ask = comparing(field, f"{pheromone} here", how, number, here)
    ask.names += (f"{field}_here{ask.names[0].removeprefix(field)}",)
    return ask


def on_terrain(sheet: Sheet, action: Action) -> Ask:
    """L_IsOnTerrain."""
    terrain = str(action.argument("Terrain").value)
    sheet.needs.add("terrains")
    names = list(sheet.model.environment.terrains)
    number = names.index(terrain) if terrain in names else -1
    wanted = name_of(terrain).upper()
    constant = sheet.constant_named("terrain", terrain, wanted, f"{wanted}_TERRAIN")
    sheet.constants[constant] = f"{number}  # a terrain" + (
        ", which the map does not have" if number < 0 else ""
    )
    test = f"model.world.patch(human.x, human.y).terrain == {constant}"
    return Ask((f"is_on_{name_of(terrain)}",), f"whether it stands on {terrain}", test)


WRITERS: dict[str, Writer] = {
    "A_AvanceAleatoirement": wander,
    "A_Collect": collect,
    "A_GoToTarget": go_to_goal,
    "A_Move": move,
    "A_Move_Cardinals_Random": move_askew,
    "A_Rentrer": go_home,
    "A_SearchForRessources": search_resources,
    "A_SmellAndMove": smell_and_move,
    "A_Transform": transform,
    "A_Transformer": transform,
    "L_ComparePhero": compare_pheromone,
    "L_CompareResource": compare_pheromone,
    "L_IsOnTerrain": on_terrain,
}
