"""Actions that meet others: death, targets, messages, chiefs and employees, trade."""

from __future__ import annotations

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.acts.facilities import facility_of, own
from socialmind.metaciv.writing.acts.form import (
    Act,
    Ask,
    Writer,
    as_text,
    chosen,
    in_doc,
    in_name,
    name_of,
)
from socialmind.metaciv.writing.acts.ground import go_to_goal, going
from socialmind.metaciv.writing.acts.minds import strengthening
from socialmind.metaciv.writing.acts.things import gaining, losing
from socialmind.metaciv.writing.sheet import Sheet

LIVES = '''
def living(model, identity):
    """Return whether whoever has an identity lives; -1 is nobody's."""
    return identity >= 0 and model.humans.contains(identity)
'''
READ = '''
def is_asked_for(human, model, kind):
    """Return whether the first message asks for something; all messages are read then."""
    found = False
    first = True
    for message in model.messages.to(human):
        if first:
            found = message.kind == kind
        first = False
        message.die()
    return found
'''
ATTACKED = '''
def is_attacked(human, model):
    """Return whether the next message tells of an attack; it is read then."""
    for message in model.messages.to(human):
        found = message.kind == ATTACK
        message.die()
        return found
    return False
'''


def die(sheet: Sheet, action: Action) -> Act:
    """A_Die."""
    sheet.needs.add("deaths")
    return Act(("die",), "Be about to die: that is the next turn.", ["human.dying = True"])


def kill_stranger(sheet: Sheet, action: Action) -> Act:
    """A_killOtherAgentOnPatchThatIsNotInMyGroup."""
    sheet.needs.add("deaths")
    groups = [as_text(one) for one in sheet.people.groups]
    body = [
        *chosen("other", "model.humans.on(human)", "is_stranger(human, one)"),
        "if other is not None:",
        "    other.dying = True",
    ]
    doc = "Return whether two have no group in common."
    if not groups:
        body_of = ["return True"]
    elif len(groups) == 1:
        body_of = [
            f"own = human.mind.get_group_id({groups[0]})",
            f"return own < 0 or other.mind.get_group_id({groups[0]}) != own",
        ]
    else:
        body_of = ["common = False"]
        for one in groups:
            body_of += [
                f"own = human.mind.get_group_id({one})",
                f"if own >= 0 and other.mind.get_group_id({one}) == own:",
                "    common = True",
            ]
        body_of.append("return not common")
    text = "\n    ".join(body_of)
    sheet.help("is_stranger", f'\ndef is_stranger(human, other):\n    """{doc}"""\n    {text}\n')
    return Act(("kill_stranger",), "Kill somebody here who is in no group of the own.", body)


# Targets ----------------------------------------------------------------------------------------


def with_target_field(sheet: Sheet) -> None:
    """Let agents have a target."""
    sheet.field("target", "int = -1  # whom it deals with: an identity, -1 for nobody")
    sheet.help("living", LIVES)


def at_target(sheet: Sheet, here: list[str], who: str = "target") -> list[str]:
    """Return the lines that do something with a target that is here, and else go to it."""
    return [
        f"if living(model, human.{who}):",
        f"    other = model.humans[human.{who}]",
        "    if model.world.is_on(human, other.x, other.y):",
        *(f"        {line}" for line in here),
        "    else:",
        f"        {going(sheet, 'other.x', 'other.y')}",
    ]


def got_target(sheet: Sheet, action: Action) -> Ask:
    """L_GotTargetInteraction."""
    with_target_field(sheet)
    test = "human.target != human.id and living(model, human.target)"
    return Ask(("has_target",), "whether it deals with somebody who lives", test)


def attack(sheet: Sheet, action: Action) -> Act:
    """I_Attaquer."""
    with_target_field(sheet)
    _messages(sheet)
    attribute = sheet.attribute(action.argument("Attribute").value)
    here = [
        f"other.{attribute} -= 1",
        "message = model.messages.send(human, other)",
        "message.kind = ATTACK",
        "other.asker = human.id",
    ]
    doc = "Attack the target if it is here, else go on to it."
    return Act(("attack", f"attack_{attribute}"), doc, at_target(sheet, here))


def target_with_tag(sheet: Sheet, action: Action) -> Act:
    """A_GetCibleInteraction_Tag."""
    with_target_field(sheet)
    attribute = sheet.attribute(action.argument("Attribute").value)
    body = [
        *chosen("other", "model.humans.near(human, 100)", f"one.{attribute} > 0"),
        "if other is not None:",
        "    human.target = other.id",
    ]
    doc = f"Take somebody around with some {attribute} for the target."
    return Act((f"target_{attribute}",), doc, body)


def target_asker(sheet: Sheet, action: Action) -> Act:
    """A_SetCibleInteractionInitiateur."""
    with_target_field(sheet)
    _asker(sheet)
    body = ["human.target = human.asker"]
    return Act(("target_asker",), "Take who has asked, or attacked, for the target.", body)


def target_empty_patch(sheet: Sheet, action: Action) -> Act:
    """A_SetTargetToClosestEmptyPatch."""
    go_to_goal(sheet, action)
    sheet.needs |= {"any facility here", "free ground"}
    known = sheet.model.parameters.vision_radius > 0
    reach = "model.vision_radius" if known else "model.world.width + model.world.height"
    body = [
        "best = -1.0",
        f"for patch in model.world.neighbours(human, steps={reach}):",
        "    away = model.world.distance(human, patch.x, patch.y)",
        "    if (best < 0 or away < best) and not any_facility_here(patch, model):",
        "        best = away",
        "        human.has_goal = True",
        "        human.goal_x = patch.x",
        "        human.goal_y = patch.y",
        "if not any_facility_here(human, model):",
        "    human.has_goal = True",
        "    human.goal_x = human.x",
        "    human.goal_y = human.y",
    ]
    return Act(("choose_free_ground",), "Want to go to the nearest patch without facility.", body)


# Messages ---------------------------------------------------------------------------------------


def _messages(sheet: Sheet) -> None:
    sheet.needs.add("messages")
    sheet.constants["ATTACK"] = "1  # kinds of messages"
    sheet.constants["TRADE"] = "2"
    sheet.constants["HIRING"] = "3"
    _asker(sheet)


def _asker(sheet: Sheet) -> None:
    sheet.needs.add("messages")
    sheet.field("asker", "int = -1  # who asked, or attacked, last: an identity, -1 for nobody")


def broadcast(sheet: Sheet, action: Action) -> Act:
    """A_BroadcastMessage_Commerce, _Embauche, _Commerce_SiObjet."""
    _messages(sheet)
    kind, name = ("HIRING", "offer_work") if "Embauche" in action.name else ("TRADE", "offer_trade")
    radius = sheet.radius(action.argument("Integer"))
    text = '''
def ask_around(human, model, radius, kind):
    """Ask all within a radius, oneself too, for something."""
    message = model.messages.send(human, human)
    message.kind = kind
    human.asker = human.id
    for other in model.humans.near(human, radius):
        message = model.messages.send(human, other)
        message.kind = kind
        other.asker = human.id
'''
    sheet.help("ask_around", text)
    body = [f"ask_around(human, model, {radius}, {kind})"]
    names: tuple[str, ...] = (name,)
    doc = f"Ask all within {in_doc(radius)} patches for {'work' if kind == 'HIRING' else 'trade'}."
    if action.name.endswith("SiObjet"):
        thing = str(action.argument("Objet").value)
        body = [f"if human.{sheet.thing(thing)} >= 1:", f"    {body[0]}"]
        names = (f"{name}_of_{name_of(thing)}",)
        doc = f"{doc[:-1]}, if there is some {thing}."
    return Act(names, doc, body)


def is_asked(sheet: Sheet, action: Action) -> Ask:
    """L_ARequeteCommerce, L_ARequeteEmbauche."""
    _messages(sheet)
    sheet.help("is_asked_for", READ)
    hiring = action.name.endswith("Embauche")
    name, doc = ("is_asked_for_work", "work") if hiring else ("is_asked_for_trade", "trade")
    test = f"is_asked_for(human, model, {'HIRING' if hiring else 'TRADE'})"
    return Ask((name, f"was_{name}"), f"whether somebody asks for {doc}", test)


def is_attacked(sheet: Sheet, action: Action) -> Ask:
    """L_IsAttacked."""
    _messages(sheet)
    sheet.help("is_attacked", ATTACKED)
    return Ask(("was_attacked",), "whether somebody has attacked it", "is_attacked(human, model)")


def attacker_got_tag(sheet: Sheet, action: Action) -> Ask:
    """L_AttackerGotTag."""
    _asker(sheet)
    sheet.help("living", LIVES)
    attribute = sheet.attribute(action.argument("Attribute").value)
    test = f"living(model, human.asker) and model.humans[human.asker].{attribute} > 0"
    doc = f"whether who attacked has some {attribute}"
    return Ask((f"attacker_has_{attribute}",), doc, test)


def accept_trade(sheet: Sheet, action: Action) -> Act:
    """A_AccepterCommerce."""
    with_target_field(sheet)
    _asker(sheet)
    body = [
        "if living(model, human.asker) and not living(model, model.humans[human.asker].target):",
        "    model.humans[human.asker].target = human.id",
    ]
    return Act(("accept_trade",), "Become the target of who has asked, if he has none.", body)


def accept_work(sheet: Sheet, action: Action) -> Act:
    """A_AccepterEmbauche."""
    with_target_field(sheet)
    _asker(sheet)
    _chief(sheet)
    body = [
        "if living(model, human.asker) and not living(model, model.humans[human.asker].chief):",
        "    model.humans[human.asker].target = human.id",
    ]
    return Act(("accept_work",), "Become the target of who has asked, if he has no chief.", body)


# Chiefs and employees ---------------------------------------------------------------------------


def _chief(sheet: Sheet) -> None:
    sheet.field("chief", "int = -1  # for whom it works: an identity, -1 for nobody")
    sheet.help("living", LIVES)


def has_chief(sheet: Sheet, action: Action) -> Ask:
    """L_AUnChef."""
    _chief(sheet)
    return Ask(("has_chief",), "whether it works for somebody", "living(model, human.chief)")


def has_employees(sheet: Sheet, action: Action) -> Ask:
    """L_ADesEmployes."""
    _chief(sheet)
    test = "any(one.chief == human.id for one in model.humans)"
    return Ask(("has_employees",), "whether somebody works for it", test)


def employee_on_mission(sheet: Sheet, action: Action) -> Ask:
    """L_AEmployeeEnMission."""
    _chief(sheet)
    sheet.field("on_mission", "bool = False")
    test = "any(one.chief == human.id and one.on_mission for one in model.humans)"
    return Ask(("has_employee_on_mission",), "whether an employee is on a mission", test)


def go_on_mission(sheet: Sheet, action: Action) -> Act:
    """A_SetEnMissionTrue."""
    sheet.field("on_mission", "bool = False")
    return Act(("begin_mission",), "Be on a mission.", ["human.on_mission = True"])


def change_employee(sheet: Sheet, action: Action) -> Act:
    """I_ModifierCognitonsEmployee."""
    _chief(sheet)
    cogniton = str(action.argument("Cogniton").value)
    amount = sheet.number(action.argument("Double"))
    body = [
        "for other in model.humans:",
        "    if other.chief == human.id:",
        f"        {strengthening(sheet, 'other', cogniton, amount)}",
        "        break",
    ]
    doc = f"Add {amount} to {cogniton} of the first employee."
    return Act((f"move_employee_to_{name_of(cogniton)}",), doc, body)


def join_chief(sheet: Sheet, action: Action) -> Act:
    """I_RejoindreGroupe."""
    with_target_field(sheet)
    _chief(sheet)
    body = ["if living(model, human.target):", "    human.chief = human.target"]
    return Act(("work_for_target",), "Work for the target.", body)


def share_with_employees(sheet: Sheet, action: Action) -> Act:
    """A_PartagerRessourceEmployes."""
    _chief(sheet)
    thing = str(action.argument("Objet").value)
    count = sheet.count(action.argument("Integer"))
    field = sheet.thing(thing)
    wanted = "employees" if count == "1" else f"{count} * employees"
    body = [
        "employees = sum(1 for one in model.humans if one.chief == human.id)",
        f"if employees > 0 and human.{field} >= {wanted}:",
        "    for other in model.humans:",
        "        if other.chief == human.id:",
        *(f"            {line}" for line in losing(sheet, thing, count)),
        *(f"            {line}" for line in gaining(sheet, thing, count, "other")),
    ]
    name = f"share_{name_of(thing)}_with_employees"
    return Act((name,), f"Give {in_doc(count)} {thing} to each employee, if all can have it.", body)


def give_to_chief(sheet: Sheet, action: Action) -> Act:
    """I_GiveItemToChef."""
    return _passing(sheet, action, "human", "other")


def take_from_chief(sheet: Sheet, action: Action) -> Act:
    """I_TakeItemsFromChef."""
    return _passing(sheet, action, "other", "human")


def _passing(sheet: Sheet, action: Action, giver: str, taker: str) -> Act:
    with_target_field(sheet)
    _chief(sheet)
    thing = str(action.argument("Objet").value)
    count, field = sheet.count(action.argument("Integer")), sheet.thing(thing)
    here = [
        f"if {giver}.{field} > {count}:",
        *(f"    {line}" for line in losing(sheet, thing, count, giver)),
        *(f"    {line}" for line in gaining(sheet, thing, count, taker)),
    ]
    body = ["human.target = human.chief", *at_target(sheet, here, "chief")]
    give = giver == "human"
    name = f"{'give' if give else 'take'}_{name_of(thing)}_{'to' if give else 'from'}_chief"
    verb = "Give the chief" if give else "Take from the chief"
    doc = f"{verb} {in_doc(count)} {thing}, if there are more; else go on to him."
    return Act((name, f"{name}_{in_name(count)}"), doc, body)


def chief_facility_here(sheet: Sheet, action: Action) -> Ask:
    """L_IsChefFacilityHere."""
    _chief(sheet)
    built = facility_of(sheet, action)
    field = own(sheet, built)
    before = (
        "if not living(model, human.chief):",
        "    return False",
        f"{built.name} = model.humans[human.chief].{field}",
    )
    test = f"any(one.id == {built.name} for one in model.{built.population}.on(human))"
    name = f"is_at_{built.name}_of_chief"
    return Ask((name,), f"whether the {built.facility.name} of the chief is here", test, before)


def go_to_chief_facility(sheet: Sheet, action: Action) -> Act:
    """A_GoToChefFacility."""
    _chief(sheet)
    built = facility_of(sheet, action)
    field, name = own(sheet, built), built.name
    body = [
        f"if living(model, human.chief) and model.humans[human.chief].{field} >= 0:",
        f"    {name} = model.{built.population}[model.humans[human.chief].{field}]",
        f"    {going(sheet, f'{name}.x', f'{name}.y')}",
    ]
    doc = f"Go a step towards the {built.facility.name} of the chief."
    return Act((f"go_towards_{name}_of_chief",), doc, body)


WRITERS: dict[str, Writer] = {
    "A_AccepterCommerce": accept_trade,
    "A_AccepterEmbauche": accept_work,
    "A_BroadcastMessage_Commerce": broadcast,
    "A_BroadcastMessage_Commerce_SiObjet": broadcast,
    "A_BroadcastMessage_Embauche": broadcast,
    "A_Die": die,
    "A_GetCibleInteraction_Tag": target_with_tag,
    "A_GoToChefFacility": go_to_chief_facility,
    "A_PartagerRessourceEmployes": share_with_employees,
    "A_SetCibleInteractionInitiateur": target_asker,
    "A_SetEnMissionTrue": go_on_mission,
    "A_SetTargetToClosestEmptyPatch": target_empty_patch,
    "A_killOtherAgentOnPatchThatIsNotInMyGroup": kill_stranger,
    "I_Attaquer": attack,
    "I_GiveItemToChef": give_to_chief,
    "I_ModifierCognitonsEmployee": change_employee,
    "I_RejoindreGroupe": join_chief,
    "I_TakeItemsFromChef": take_from_chief,
    "L_ADesEmployes": has_employees,
    "L_AEmployeeEnMission": employee_on_mission,
    "L_ARequeteCommerce": is_asked,
    "L_ARequeteEmbauche": is_asked,
    "L_AUnChef": has_chief,
    "L_AttackerGotTag": attacker_got_tag,
    "L_GotTargetInteraction": got_target,
    "L_IsAttacked": is_attacked,
    "L_IsChefFacilityHere": chief_facility_here,
}
