"""Actions on facilities: building, stocking, finding and erasing them."""

from __future__ import annotations

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.acts.form import (
    Act,
    Ask,
    Writer,
    comparing,
    in_doc,
    in_name,
    name_of,
)
from socialmind.metaciv.writing.acts.ground import going
from socialmind.metaciv.writing.acts.groups import group_of
from socialmind.metaciv.writing.acts.things import (
    at_most,
    carries,
    gaining,
    losing,
    taking_effect,
    using_up,
)
from socialmind.metaciv.writing.sheet import Built, Sheet

OF_GROUP = '''
def nearest_of_group(human, model, facilities, group):
    """Return the nearest of some facilities that belongs to a group, or None."""
    nearest = None
    least = math.inf
    for facility in facilities:
        away = model.world.distance(human, facility.x, facility.y)
        if 0 <= facility.group == group and away < least:
            nearest = facility
            least = away
    return nearest
'''


def facility_of(sheet: Sheet, action: Action) -> Built:
    """Return the type of facility that an action names."""
    return sheet.facility(action.argument("Amenagement").value)


def nearest(sheet: Sheet, built: Built, group: str) -> str:
    """Return the expression for the nearest facility of the own group."""
    sheet.help("nearest_of_group", OF_GROUP)
    built.grouped[group.strip('"')] = None
    own = f"human.mind.get_group_id({group})"
    return f"nearest_of_group(human, model, model.{built.population}, {own})"


def own(sheet: Sheet, built: Built) -> str:
    """Return the field that says which facility of a type an agent has built."""
    built.private = True
    sheet.needs.add("private")
    return built.name


# Building ---------------------------------------------------------------------------------------


def _able(sheet: Sheet, built: Built, *more: str) -> str:
    sheet.needs.add("any facility here")
    conditions = [*more, "not any_facility_here(human, model)"]
    if built.facility.recipe:
        conditions.append(carries(sheet, built.facility.recipe))
    return " and ".join(conditions)


def _condition(test: str) -> list[str]:
    """Return the line of an if, laid out over several where it is long."""
    if len(test) <= 88:
        return [f"if {test}:"]
    first, *more = test.split(" and ")
    return ["if (", f"    {first}", *(f"    and {one}" for one in more), "):"]


def create_private(sheet: Sheet, action: Action) -> Act:
    """A_CreatePrivateFacility, A_CreatePrivateFacility_Efficacite."""
    built = facility_of(sheet, action)
    field, name = own(sheet, built), built.name
    sheet.use("socialmind.economy", "build_private")
    body = [
        *_condition(_able(sheet, built, f"human.{field} < 0")),
        *(f"    {line}" for line in using_up(sheet, built.facility.recipe)),
        f"    {name} = model.{built.population}.create()",
        f"    build_private({name}, human)",
        f"    human.{field} = {name}.id",
    ]
    if action.name.endswith("Efficacite"):
        built.efficient = True
        body += [
            f"    {name}.efficiency = rng.integers(100)",
            f"    {name}.counter = {name}.efficiency",
        ]
        doc = f"Build an own {built.facility.name} where none is, {_of(built)}, to be worked at."
        return Act((f"set_up_{name}",), doc, body)
    doc = f"Build an own {built.facility.name} where none is, {_of(built)}."
    return Act((f"build_{name}", f"build_own_{name}"), doc, body)


def _of(built: Built) -> str:
    recipe = " and ".join(f"{one.count} {one.object}" for one in built.facility.recipe)
    return f"of {recipe}" if recipe else "of nothing"


def create_for_group(sheet: Sheet, action: Action) -> Act:
    """A_CreateGroupFacility."""
    built, (group, group_name) = facility_of(sheet, action), group_of(action)
    built.grouped[group.strip('"')] = None
    name = built.name
    sheet.use("socialmind.economy", "build_for_group")
    body = [
        f"group = human.mind.get_group_id({group})",
        *_condition(_able(sheet, built, "group >= 0")),
        *(f"    {line}" for line in using_up(sheet, built.facility.recipe)),
        f"    {name} = model.{built.population}.create()",
        f"    build_for_group({name}, human, group)",
    ]
    doc = f"Build a {built.facility.name} of the own {group[1:-1]} where none is, {_of(built)}."
    return Act((f"build_{name}", f"build_{name}_of_{group_name}"), doc, body)


def erase_private(sheet: Sheet, action: Action) -> Act:
    """A_ErasePrivateFacility."""
    built = facility_of(sheet, action)
    field = own(sheet, built)
    body = [
        f"if human.{field} >= 0:",
        f"    model.{built.population}[human.{field}].die()",
        f"    human.{field} = -1",
    ]
    names = (f"pull_down_{built.name}", f"pull_down_own_{built.name}")
    return Act(names, f"Pull the own {built.facility.name} down.", body)


def empty_and_erase(sheet: Sheet, action: Action) -> Act:
    """A_EmptyAndEraseGroupFacility."""
    built, (group, _) = facility_of(sheet, action), group_of(action)
    built.grouped[group.strip('"')] = None
    sheet.needs.add(f"emptied {built.facility.name}")
    name = built.name
    body = [
        f"for {name} in model.{built.population}.on(human):",
        f"    if {name}.group >= 0 and {name}.group == human.mind.get_group_id({group}):",
        *(
            f"        {line}"
            for thing in built.stock
            for line in gaining(sheet, thing, f"{name}.{sheet.thing(thing)}")
        ),
        f"        {name}.die()",
    ]
    doc = f"Empty and pull down the {built.facility.name} of the own {group[1:-1]} here."
    return Act((f"take_apart_{name}",), doc, body)


# Going there ------------------------------------------------------------------------------------


def go_to_group_facility(sheet: Sheet, action: Action) -> Act:
    """A_GoToClosestGroupFacility."""
    built, (group, group_name) = facility_of(sheet, action), group_of(action)
    name = built.name
    body = [
        f"{name} = {nearest(sheet, built, group)}",
        f"if {name} is None:",
        "    return True",
        f"return {going(sheet, f'{name}.x', f'{name}.y')}",
    ]
    doc = f"Go to the nearest {built.facility.name} of the own {group[1:-1]}, if there is one."
    return Act((f"go_to_{name}", f"go_to_{name}_of_{group_name}"), doc, body, True)


def _going_to_own(sheet: Sheet, built: Built, of: str) -> list[str]:
    field, name = own(sheet, built), built.name
    return [
        f"{name} = model.{built.population}[{of}.{field}]",
        f"{going(sheet, f'{name}.x', f'{name}.y')}",
    ]


def step_to_own(sheet: Sheet, action: Action) -> Act:
    """A_GoToPrivateFacility."""
    built = facility_of(sheet, action)
    body = [
        f"if human.{own(sheet, built)} >= 0:",
        *(f"    {line}" for line in _going_to_own(sheet, built, "human")),
    ]
    names = (f"go_towards_{built.name}", f"go_towards_own_{built.name}")
    return Act(names, f"Go a step towards the own {built.facility.name}.", body)


def go_to_own(sheet: Sheet, action: Action) -> Act:
    """A_GoToAmenagement."""
    built = facility_of(sheet, action)
    *before, last = _going_to_own(sheet, built, "human")
    body = [
        f"if human.{own(sheet, built)} < 0:",
        "    return True",
        *before,
        f"return {last}",
    ]
    names = (f"go_to_own_{built.name}",)
    return Act(names, f"Go to the own {built.facility.name}, if there is one.", body, True)


# Asking -----------------------------------------------------------------------------------------


def any_here(sheet: Sheet, action: Action) -> Ask:
    """L_IsAnyFacilityHere."""
    sheet.needs.add("any facility here")
    test = "any_facility_here(human, model)"
    return Ask(("stands_on_a_facility",), "whether a facility is here", test)


def own_here(sheet: Sheet, action: Action) -> Ask:
    """L_IsPrivateFacilityHere."""
    built = facility_of(sheet, action)
    field = own(sheet, built)
    test = f"any(one.id == human.{field} for one in model.{built.population}.on(human))"
    names = (f"is_at_{built.name}", f"is_at_own_{built.name}")
    return Ask(names, f"whether the own {built.facility.name} is here", test)


def owns(sheet: Sheet, action: Action) -> Ask:
    """L_OwnPrivateFacility."""
    built = facility_of(sheet, action)
    test = f"human.{own(sheet, built)} >= 0"
    names = (f"has_{built.name}", f"has_own_{built.name}")
    return Ask(names, f"whether it has an own {built.facility.name}", test)


def in_group(sheet: Sheet, action: Action) -> Ask:
    """L_IsFacilityInGroup."""
    built, (group, group_name) = facility_of(sheet, action), group_of(action)
    test = f"{nearest(sheet, built, group)} is not None"
    names = (f"{group_name}_has_{built.name}",)
    return Ask(names, f"whether the own {group[1:-1]} has a {built.facility.name}", test)


def of_group_here(sheet: Sheet, action: Action) -> Ask:
    """L_IsGroupFacilityHere."""
    built, (group, group_name) = facility_of(sheet, action), group_of(action)
    built.grouped[group.strip('"')] = None
    before = (f"group = human.mind.get_group_id({group})",)
    test = f"group >= 0 and any(one.group == group for one in model.{built.population}.on(human))"
    names = (f"is_at_{built.name}_of_{group_name}",)
    doc = f"whether a {built.facility.name} of the own {group[1:-1]} is here"
    return Ask(names, doc, test, before)


# Stock ------------------------------------------------------------------------------------------


def withdraw(sheet: Sheet, action: Action) -> Act:
    """A_WithdrawObjectFromFacilityHere."""
    return _moving(sheet, action, "take", "from")


def deposit(sheet: Sheet, action: Action) -> Act:
    """A_DepositObjectInFacilityHere."""
    return _moving(sheet, action, "put", "into")


def _moving(sheet: Sheet, action: Action, verb: str, way: str) -> Act:
    """Return what moves things between the bag and the facilities here."""
    built, thing = facility_of(sheet, action), str(action.argument("Objet").value)
    count, field = sheet.count(action.argument("Integer")), sheet.thing(thing)
    built.stock[thing] = None
    name, what = built.name, name_of(thing)
    if verb == "take":
        many = f"min({name}.{field}, {count})"
        moved = [f"{name}.{field} -= many", *gaining(sheet, thing, "many")]
    else:
        many = at_most(sheet, thing, count)
        moved = [*losing(sheet, thing, "many"), f"{name}.{field} += many"]
    body = [f"for {name} in model.{built.population}.on(human):"]
    body += [f"    {line}" for line in (f"many = {many}", *moved)]
    names = (f"{verb}_{what}_{way}_{name}", f"{verb}_{in_name(count)}_{what}_{way}_{name}")
    doc = f"{verb.title()} {in_doc(count)} {thing}, or what there is, {way} a"
    return Act(names, f"{doc} {built.facility.name} here.", body)


def compare_stock(sheet: Sheet, action: Action) -> Ask:
    """L_CompareAmenagementObject."""
    built, thing = facility_of(sheet, action), str(action.argument("Objet").value)
    how, number = str(action.argument("Comparator").value), sheet.number(action.argument("Double"))
    built.stock[thing] = None
    field = sheet.thing(thing)
    test = f"any(one.{field} {how} {number} for one in model.{built.population}.on(human))"
    ask = comparing(f"{name_of(thing)}_in_{built.name}", thing, how, number, "")
    return Ask(ask.names, f"{ask.doc} in a {built.facility.name} here", test)


def compare_stock_of_group(sheet: Sheet, action: Action) -> Ask:
    """L_CompareNombreObjetsInGroupAmenagement: of the first member's private facility."""
    built, thing = facility_of(sheet, action), str(action.argument("Objet").value)
    how, number = str(action.argument("Comparator").value), sheet.number(action.argument("Double"))
    built.stock[thing] = None
    field, name = own(sheet, built), built.name
    before = [f"{name} = -1"]
    for group in sheet.people.groups:
        text = f'"{group}"'
        before += [
            f"for other in model.humans.members_of({text}, human.mind.get_group_id({text})):",
            f"    if {name} < 0:",
            f"        {name} = other.{field}",
        ]
    stock = f"model.{built.population}[{name}].{sheet.thing(thing)}"
    ask = comparing(f"{name_of(thing)}_in_{name}_of_group", thing, how, number, stock)
    ask.test = f"{name} >= 0 and {ask.test}"
    ask.doc += f" in the {built.facility.name} of a member of the own group"
    ask.before = tuple(before)
    return ask


def use_facility(sheet: Sheet, action: Action) -> Act:
    """A_UseAmenagement."""
    built = facility_of(sheet, action)
    field = own(sheet, built)
    effects = [sheet.effects[one] for one in built.facility.effects if one in sheet.effects]
    lines = [
        line
        for effect in effects
        if effect.activation == "use"
        for line in taking_effect(sheet, effect, "1", 1)
    ]
    body = [f"if human.{field} >= 0:", *(f"    {line}" for line in lines or ["pass"])]
    return Act((f"use_{built.name}",), f"Use the own {built.facility.name}.", body)


# Efficiency -------------------------------------------------------------------------------------


def _efficient(sheet: Sheet) -> list[Built]:
    sheet.needs.add("efficiency")
    return [one for one in sheet.used_facilities if one.efficient]


def wear_down(sheet: Sheet, action: Action) -> Act:
    """A_DecrementerAmenagement."""
    sheet.field("strike", "int = 1  # how much it does to what it works on")
    body = []
    for built in _efficient(sheet):
        body += [
            f"for {built.name} in model.{built.population}.on(human):",
            f"    if {built.name}.efficiency >= 0:",
            f"        {built.name}.counter -= human.strike",
        ]
    return Act(("work_here",), "Bring what is here nearer to being ready.", body or ["pass"])


def collect_ready(sheet: Sheet, action: Action) -> Act:
    """A_CollectFromFacilityEfficacite."""
    thing = str(action.argument("Objet").value)
    count = sheet.count(action.argument("Integer"))
    body = []
    for built in _efficient(sheet):
        body += [
            f"for {built.name} in model.{built.population}.on(human):",
            f"    if {built.name}.efficiency >= 0 and {built.name}.counter <= 0:",
            f"        {built.name}.counter = {built.name}.efficiency",
            *(f"        {line}" for line in gaining(sheet, thing, count)),
        ]
    names = (f"collect_{name_of(thing)}", f"collect_{in_name(count)}_{name_of(thing)}")
    return Act(names, f"Get {in_doc(count)} {thing} from what is ready here.", body or ["pass"])


def _here_with_efficiency(sheet: Sheet, test: str) -> str:
    tests = [
        f"any(one.efficiency >= 0{test} for one in model.{built.population}.on(human))"
        for built in _efficient(sheet)
    ]
    return " or ".join(tests) or "False"


def efficient_here(sheet: Sheet, action: Action) -> Ask:
    """Whether there is a facility that counts, for L_IsCounterAtZero."""
    return Ask(("something_grows_here",), "whether something here counts down",
               _here_with_efficiency(sheet, ""))  # fmt: skip


def counter_at_zero(sheet: Sheet, action: Action) -> Ask:
    """L_IsCounterAtZero."""
    return Ask(("is_ready",), "whether what is here is ready",
               _here_with_efficiency(sheet, " and one.counter <= 0"))  # fmt: skip


def compare_efficiency(sheet: Sheet, action: Action) -> Ask:
    """L_CompareEfficacite."""
    how, number = str(action.argument("Comparator").value), sheet.number(action.argument("Double"))
    ask = comparing("efficiency", "efficiency here", how, number, "")
    test = _here_with_efficiency(sheet, f" and one.efficiency {how} {number}")
    return Ask(ask.names, ask.doc, test)


WRITERS: dict[str, Writer] = {
    "A_CollectFromFacilityEfficacite": collect_ready,
    "A_CreateGroupFacility": create_for_group,
    "A_CreatePrivateFacility": create_private,
    "A_CreatePrivateFacility_Efficacite": create_private,
    "A_DecrementerAmenagement": wear_down,
    "A_DepositObjectInFacilityHere": deposit,
    "A_EmptyAndEraseGroupFacility": empty_and_erase,
    "A_ErasePrivateFacility": erase_private,
    "A_GoToAmenagement": go_to_own,
    "A_GoToClosestGroupFacility": go_to_group_facility,
    "A_GoToPrivateFacility": step_to_own,
    "A_UseAmenagement": use_facility,
    "A_WithdrawObjectFromFacilityHere": withdraw,
    "L_CompareAmenagementObject": compare_stock,
    "L_CompareEfficacite": compare_efficiency,
    "L_CompareNombreObjetsInGroupAmenagement": compare_stock_of_group,
    "L_IsAnyFacilityHere": any_here,
    "L_IsCounterAtZero": counter_at_zero,
    "L_IsFacilityInGroup": in_group,
    "L_IsGroupFacilityHere": of_group_here,
    "L_IsPrivateFacilityHere": own_here,
    "L_OwnPrivateFacility": owns,
}
