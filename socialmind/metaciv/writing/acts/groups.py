"""Actions of groups: founding, joining, roles, births into them."""

from __future__ import annotations

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.acts.form import (
    Act,
    Ask,
    Writer,
    as_text,
    chosen,
    comparing,
    name_of,
)
from socialmind.metaciv.writing.acts.ground import going
from socialmind.metaciv.writing.sheet import Sheet


def role_of(action: Action, number: int = 0) -> tuple[str, str, str, str]:
    """Return a group and a role as texts of Python, and as parts of names."""
    arguments = [one for one in action.arguments if one.type == "GroupAndRole"]
    group, role = str(arguments[number].value), str(arguments[number].role)
    return as_text(group), as_text(role), name_of(group), name_of(role)


def group_of(action: Action) -> tuple[str, str]:
    """Return a group as a text of Python, and as part of a name."""
    argument = next(one for one in action.arguments if one.type in ("Group", "GroupAndRole"))
    return as_text(str(argument.value)), name_of(argument.value)


def is_in_group(sheet: Sheet, action: Action) -> Ask:
    """L_IsInGroup."""
    group, name = group_of(action)
    test = f"human.mind.get_group_id({group}) >= 0"
    return Ask((f"is_in_{name}",), f"whether it is in a group {group[1:-1]}", test)


def is_in_role(sheet: Sheet, action: Action) -> Ask:
    """L_IsInThatGroupInThatRole."""
    group, role, group_name, role_name = role_of(action)
    test = f"human.mind.get_group_role_id({group}, {role}) >= 0"
    names = (f"is_{role_name}", f"is_{role_name}_of_{group_name}")
    return Ask(names, f"whether it is {role[1:-1]} of a group {group[1:-1]}", test)


def create_group(sheet: Sheet, action: Action) -> Act:
    """A_CreateGroup."""
    group, role, group_name, role_name = role_of(action)
    body = [f"human.mind.create_and_join_group({group}, {role})"]
    names = (f"found_{group_name}", f"found_{group_name}_as_{role_name}")
    doc = f"Found a group {group[1:-1]}, as its {role[1:-1]}, if in none yet."
    return Act(names, doc, body)


def change_role(sheet: Sheet, action: Action) -> Act:
    """A_ChangeRoleForAnother."""
    group, role, group_name, role_name = role_of(action)
    body = [f"human.mind.change_role({group}, {role})"]
    names = (f"become_{role_name}", f"become_{role_name}_of_{group_name}")
    return Act(names, f"Become {role[1:-1]} of the own group {group[1:-1]}.", body)


def change_role_of_other(sheet: Sheet, action: Action) -> Act:
    """A_AskRandomMemberToChangeRoleForAnother."""
    group, role, group_name, role_name = role_of(action)
    body = [
        f"own = human.mind.get_group_id({group})",
        *chosen("other", f"model.humans.members_of({group}, own)", "one.id != human.id"),
        "if other is not None:",
        f"    other.mind.change_role({group}, {role})",
    ]
    names = (f"make_other_{role_name}", f"make_other_{role_name}_of_{group_name}")
    return Act(names, f"Make another member of {group[1:-1]} its {role[1:-1]}.", body)


def bear(sheet: Sheet, action: Action) -> Act:
    """A_BirthGroupAndRole."""
    group, role, group_name, role_name = role_of(action)
    sheet.needs.add("births")
    body = [
        "child = give_birth(human, model, rng)",
        f"own = human.mind.get_group_id({group})",
        "if own >= 0:",
        f"    child.mind.join_group({group}, {role}, own)",
    ]
    names = (f"bear_{role_name}", f"bear_{role_name}_of_{group_name}")
    doc = f"Give birth to a child, a {role[1:-1]} of the own group {group[1:-1]}."
    return Act(names, doc, body)


def disband(sheet: Sheet, action: Action) -> Act:
    """A_DisbandGroup."""
    group, name = group_of(action)
    body = [
        f"for other in model.humans.members_of({group}, human.mind.get_group_id({group})):",
        f"    other.mind.leave_group({group})",
    ]
    return Act((f"disband_{name}",), f"Let all leave the own group {group[1:-1]}.", body)


def hire(sheet: Sheet, action: Action) -> Act:
    """A_HireForRole."""
    group, role, group_name, role_name = role_of(action)
    several = len(sheet.people.civilisations) > 1
    same = "one.civilisation == human.civilisation" if several else ""
    body = [
        f"own = human.mind.get_group_id({group})",
        *chosen("other", "model.humans.on(human)", same),
        "if own >= 0 and other is not None:",
        f"    other.mind.join_group({group}, {role}, own)",
    ]
    names = (f"hire_{role_name}", f"hire_{role_name}_of_{group_name}")
    return Act(names, f"Let somebody here join as {role[1:-1]} of {group[1:-1]}.", body)


def follow_role(sheet: Sheet, action: Action) -> Act:
    """A_FollowRoleInGroup."""
    group, role, group_name, role_name = role_of(action)
    body = [
        f"for other in model.humans.members_of({group}, human.mind.get_group_id({group})):",
        f"    if other.id != human.id and other.mind.get_group_role_id({group}, {role}) >= 0:",
        f"        {going(sheet, 'other.x', 'other.y')}",
    ]
    names = (f"follow_{role_name}", f"follow_{role_name}_of_{group_name}")
    return Act(names, f"Go a step towards each {role[1:-1]} of the own group.", body)


def compare_role_members(sheet: Sheet, action: Action) -> Ask:
    """L_CompareRoleMembers."""
    group, role, _, role_name = role_of(action)
    how, number = (
        str(action.argument("Comparator").value),
        sheet.number(action.argument("Double")),
    )
    before = (
        "count = 0",
        f"for other in model.humans.members_of({group}, human.mind.get_group_id({group})):",
        f"    if other.mind.get_group_role_id({group}, {role}) >= 0:",
        "        count += 1",
    )
    ask = comparing(f"{role_name}s", f"members as {role[1:-1]}", how, number, "count")
    ask.before = before
    return ask


def compare_attribute_of_groups(sheet: Sheet, action: Action) -> Ask:
    """L_CompareGroupAttributeToPopulation."""
    attribute = str(action.argument("Attribute").value)
    how, field = str(action.argument("Comparator").value), sheet.attribute(attribute)
    before = ["total = 0.0", "count = 0"]
    for group in sheet.people.groups:
        text = as_text(group)
        before += [
            f"for other in model.humans.members_of({text}, human.mind.get_group_id({text})):",
            f"    total += other.{field}",
            "    count += 1",
        ]
    short = {">": "above", ">=": "at_least", "==": "equals", "<=": "at_most", "<": "below"}[how]
    doc = f"whether {attribute} of all members of the own groups is {how} their number"
    name = f"{name_of(attribute)}_of_groups_{short}_members"
    return Ask((name,), doc, f"total {how} count", tuple(before))


def elect(sheet: Sheet, action: Action) -> Act:
    """A_CreateElectedGroup."""
    group, leader, group_name, leader_name = role_of(action)
    _, follower, _, _ = role_of(action, 1)
    cogniton = as_text(str(action.argument("Cogniton").value))
    radius = sheet.radius(action.argument("Integer"))
    same = (
        " and other.civilisation == human.civilisation"
        if len(sheet.people.civilisations) > 1
        else ""
    )
    own = same.removeprefix(" and ")
    inner = [f"    if {own}:"] if own else []
    pad = "    " if own else ""
    body = [
        "voters = 0",
        "votes = 0",
        f"for other in model.humans.near(human, {radius}):",
        *inner,
        f"{pad}    voters += 1",
        f"{pad}    chance = int(other.mind.get_cogniton_value({cogniton})) / 10",
        f"{pad}    if rng.random() < chance:",
        f"{pad}        votes += 1",
        f"if voters > 0 and 2 * votes >= voters and human.mind.create_and_join_group("
        f"{group}, {leader}):",
        f"    own = human.mind.get_group_id({group})",
        f"    for other in model.humans.near(human, {radius}):",
        *[f"    {line}" for line in inner],
        f"{pad}        other.mind.join_group({group}, {follower}, own)",
    ]
    names = (f"stand_for_{leader_name}", f"stand_for_{leader_name}_of_{group_name}")
    doc = f"Be elected {leader[1:-1]} of a new group {group[1:-1]} by half of those around."
    return Act(names, doc, body)


WRITERS: dict[str, Writer] = {
    "A_AskRandomMemberToChangeRoleForAnother": change_role_of_other,
    "A_BirthGroupAndRole": bear,
    "A_ChangeRoleForAnother": change_role,
    "A_CreateElectedGroup": elect,
    "A_CreateGroup": create_group,
    "A_DisbandGroup": disband,
    "A_FollowRoleInGroup": follow_role,
    "A_HireForRole": hire,
    "L_CompareGroupAttributeToPopulation": compare_attribute_of_groups,
    "L_CompareRoleMembers": compare_role_members,
    "L_IsInGroup": is_in_group,
    "L_IsInThatGroupInThatRole": is_in_role,
}
