"""Edits of documents at random, as the page makes them: each leaves a document whose parts fit."""

import copy

from hypothesis import strategies as st

NAMES = ("Hope", "no", "10", "a b", "yes", "colon: here", "#7", "Müde", 'say "it"', "-")
WEIGHTS = (0.0, 1.0, -0.5, 2.6, 1e-30, 1e17)
_new = {"position": None, "influence": [], "conditional": [], "reinforcement": []}


def cogniton(identity, name):
    return {
        "id": identity, "name": name, "start": 0.0, "colour": "#808080", **copy.deepcopy(_new),
        "starting": True, "active_while": [], "activated_when": [], "deactivated_when": [],
        "type": None, "chance": 1.0, "inherited": 1.0,
    }  # fmt: skip


def culturon(identity, name):
    return {"id": identity, "name": name, "start": 0.0, "colour": "#808080", **copy.deepcopy(_new)}


def holders(document):
    return [*document["cognitons"], *(c for g in document["groups"] for c in g["culturons"])]


def boxes(document):
    groups = document["groups"]
    roles = [role for group in groups for role in group["roles"]]
    return [*holders(document), *document["plans"], *groups, *roles]


def one_of(draw, values):
    values = list(values)
    return draw(st.sampled_from(values)) if values else None


def fresh(draw, parts):
    taken = {one["name"] for one in parts}
    return draw(st.sampled_from([name for name in NAMES if name not in taken] or ["another one"]))


def without_plan(document, identity):
    document["plans"] = [one for one in document["plans"] if one["id"] != identity]
    for one in holders(document):
        for field in ("influence", "reinforcement"):
            one[field] = [link for link in one[field] if link[0] != identity]
        one["conditional"] = [plan for plan in one["conditional"] if plan != identity]


def add_plan(draw, document, number):
    name = fresh(draw, document["plans"])
    place = draw(st.sampled_from([None, [3, -4]]))
    document["plans"].append({"id": f"n{number}", "name": name, "position": place, "listed": True})


def add_cogniton(draw, document, number):
    name = fresh(draw, document["cognitons"])
    document["cognitons"].append(cogniton(f"n{number}", name))


def add_group(draw, document, number):
    name = fresh(draw, document["groups"])
    role = {"id": f"n{number}r", "name": "member", "position": [190, 0], "culturons": []}
    document["groups"].append(
        {
            "id": f"n{number}",
            "name": name,
            "attributes": [],
            "within": None,
            "position": [0, 0],
            "roles": [role],
            "culturons": [],
        }
    )


def add_role(draw, document, number):
    group = one_of(draw, document["groups"])
    if group:
        name = fresh(draw, group["roles"])
        role = {"id": f"n{number}", "name": name, "position": None, "culturons": []}
        group["roles"].append(role)


def add_culturon(draw, document, number):
    group = one_of(draw, [one for one in document["groups"] if one["roles"]])
    if group:
        name = fresh(draw, group["culturons"])
        group["culturons"].append(culturon(f"n{number}", name))
        one_of(draw, group["roles"])["culturons"].append(f"n{number}")


def share_culturon(draw, document, number):
    group = one_of(draw, [one for one in document["groups"] if one["culturons"]])
    if group:
        role, held = one_of(draw, group["roles"]), one_of(draw, group["culturons"])
        if held["id"] in role["culturons"]:
            role["culturons"].remove(held["id"])
            drop_orphans(group)
        else:
            role["culturons"].append(held["id"])


def drop_orphans(group):
    held = {each for role in group["roles"] for each in role["culturons"]}
    group["culturons"] = [one for one in group["culturons"] if one["id"] in held]


def rename(draw, document, number):
    sets = [document["plans"], document["cognitons"], document["groups"]]
    sets += [one[part] for one in document["groups"] for part in ("roles", "culturons")]
    parts = one_of(draw, [one for one in sets if one])
    if parts:
        one_of(draw, parts)["name"] = fresh(draw, parts)


def rename_scheme(draw, document, number):
    document["name"] = draw(st.sampled_from(NAMES))


def weigh(draw, document, number):
    holder, plan = one_of(draw, holders(document)), one_of(draw, document["plans"])
    if holder and plan:
        field = draw(st.sampled_from(["influence", "reinforcement"]))
        weight = draw(st.sampled_from(WEIGHTS))
        links = dict(map(tuple, holder[field])) | {plan["id"]: weight}
        holder[field] = [list(link) for link in links.items()]


def open_or_close(draw, document, number):
    holder, plan = one_of(draw, holders(document)), one_of(draw, document["plans"])
    if holder and plan:
        links = holder["conditional"]
        (links.remove if plan["id"] in links else links.append)(plan["id"])


def unlink(draw, document, number):
    holder = one_of(draw, [one for one in holders(document) if one["influence"]])
    if holder:
        holder["influence"].remove(one_of(draw, holder["influence"]))


def set_field(draw, document, number):
    holder = one_of(draw, holders(document))
    if holder:
        choices = [("start", 7.5), ("colour", "#12abcd"), ("position", [5, 6]), ("position", None)]
        if "starting" in holder:
            choices += [
                ("starting", True), ("type", "meme"), ("type", None), ("inherited", 0.5),
                ("activated_when", ["energy < 5"]),
                ("deactivated_when", ["energy > full", "x == 1"]),
            ]  # fmt: skip
        field, value = draw(st.sampled_from(choices))
        if field.endswith("_when") and holder["active_while"]:
            return
        holder[field] = value


def drag(draw, document, number):
    one = one_of(draw, boxes(document))
    if one:
        one["position"] = draw(st.sampled_from([[-480, 7], [0, 0], [2**31 - 1, -(2**31)]]))


def set_maker(draw, document, number):
    name = draw(
        st.sampled_from(["MaximumWeight", "WeightedStochastic", "BiasedWeightedStochastic"])
    )
    document["decision_maker"] = {"name": name, "bias": draw(st.sampled_from([1.0, 2.5]))}


def set_breeds(draw, document, number):
    document["breeds"] = draw(st.sampled_from([[], ["calves"], ["calves", "no"]]))


def set_attribute(draw, document, number):
    group = one_of(draw, document["groups"])
    if group:
        numbers = dict(map(tuple, group["attributes"]))
        name = draw(st.sampled_from(["milk", "a b"]))
        if draw(st.booleans()):
            numbers[name] = draw(st.sampled_from(WEIGHTS))
        else:
            numbers.pop(name, None)
        group["attributes"] = [list(pair) for pair in numbers.items()]


def nest(draw, document, number):
    groups = document["groups"]
    if len(groups) > 1 and groups[0]["roles"] and groups[0]["within"] is None:
        role = groups[0]["roles"][0]["id"]
        groups[-1]["within"] = draw(st.sampled_from([None, [groups[0]["id"], role]]))


def reorder(draw, document, number):
    document["plans"] = draw(st.permutations(document["plans"]))
    document["ordered"] = True
    for one in document["plans"]:
        one["listed"] = True


def remove_plan(draw, document, number):
    plan = one_of(draw, document["plans"])
    if plan:
        without_plan(document, plan["id"])


def remove_cogniton(draw, document, number):
    one = one_of(draw, document["cognitons"])
    if one:
        document["cognitons"].remove(one)


def remove_role(draw, document, number):
    group = one_of(draw, [one for one in document["groups"] if one["roles"]])
    if group:
        role = one_of(draw, group["roles"])
        group["roles"].remove(role)
        drop_orphans(group)
        for one in document["groups"]:
            if one["within"] and one["within"][1] == role["id"]:
                one["within"] = None


def remove_group(draw, document, number):
    group = one_of(draw, document["groups"])
    if group:
        document["groups"].remove(group)
        for one in document["groups"]:
            if one["within"] and one["within"][0] == group["id"]:
                one["within"] = None


ADDING = (
    add_plan, add_cogniton, add_group, add_role, add_culturon, rename, rename_scheme, weigh,
    open_or_close, set_field, drag, set_maker, set_breeds, reorder, nest,
)  # fmt: skip
REMOVING = (
    unlink, share_culturon, set_attribute, remove_plan, remove_cogniton, remove_role, remove_group,
)  # fmt: skip


@st.composite
def edited(draw, document, kinds=(*ADDING, *REMOVING), most=6):
    """A document after some edits."""
    found = copy.deepcopy(document)
    for number, edit in enumerate(draw(st.lists(st.sampled_from(kinds), max_size=most))):
        edit(draw, found, number)
    return found
