"""The scheme of a model, as the YAML that people read and edit."""

from __future__ import annotations

import json
import re

from socialmind.metaciv.description import Cogniton, Trigger
from socialmind.metaciv.writing.sheet import Sheet, written

MAKERS = {
    "MaxWeight": "MaximumWeight",
    "MaxWeightOx2": "MaximumWeight",
    "WeightedStochastic": "PositiveStochastic",
}
_PLAIN = re.compile(r"[^\W\d][\w-]*(?: [\w-]+)*")
_WORDS = frozenset(["yes", "no", "true", "false", "null", "on", "off", "y", "n"])


def scheme_text(sheet: Sheet) -> str:
    """Return the scheme that the agents of a model have."""
    people, model = sheet.people, sheet.model
    names = " and ".join(one.name for one in people.schemes)
    word = "schemes" if people.several else "scheme"
    title = people.schemes[0].name if len(people.schemes) == 1 else model.name
    lines = [f"# The minds of agents, from MetaCiv's {word} {names}."]
    if people.several:
        lines += [
            "#",
            "# They meet in one random order, so their schemes are one here: what is called alike",
            "# and differs bears the name of its scheme.",
        ]
    lines += [
        f"name: {text(title)}",
        "",
        f"decision_maker: {MAKERS[model.parameters.decision_maker]}",
    ]
    plans = chosen_plans(sheet)
    if plans:
        lines += ["", "# The order decides between plans of equal weight."]
        lines += flow("plans", [text(one) for one in plans], "")
    own, shared = own_cognitons(sheet), culturons(sheet)
    if own:
        lines += ["", "cognitons:"]
    for number, cogniton in enumerate(own):
        if number:
            lines.append("")
        lines += _cogniton(sheet, cogniton, "  ", plans, own=True)
    if people.groups:
        lines += ["", "groups:"]
    for number, group in enumerate(people.groups.values()):
        if number:
            lines.append("")
        lines.append(f"  {text(group.name)}:")
        for role in group.roles:
            lines.append(f"    {text(role.name)}:" + ("" if role.culturons else " {}"))
            for name in dict.fromkeys(role.culturons):
                lines += _cogniton(sheet, shared[name], "      ", plans, own=False)
    return "\n".join(lines) + "\n"


def chosen_plans(sheet: Sheet) -> list[str]:
    """Return the plans that agents choose, in the order in which cognitons permit them."""
    people = sheet.people
    cognitons = sorted(people.cognitons.values(), key=lambda one: not one.initial)
    permitted = [one.plan for cogniton in cognitons for one in cogniton.permits]
    known = [name for name, plan in people.plans.items() if plan.kind == "plan"]
    return [one for one in dict.fromkeys([*permitted, *known]) if one in known]


def culturons(sheet: Sheet) -> dict[str, Cogniton]:
    """Return the cognitons that roles of groups lend."""
    lent = {
        name: None
        for group in sheet.people.groups.values()
        for role in group.roles
        for name in role.culturons
    }
    return {one: sheet.people.cognitons[one] for one in lent}


def own_cognitons(sheet: Sheet) -> list[Cogniton]:
    """Return the cognitons that agents themselves can have."""
    lent, named = culturons(sheet), named_cognitons(sheet)
    return [
        one
        for name, one in sheet.people.cognitons.items()
        if name not in lent or name in named or one.initial or one.triggers
    ]


def named_cognitons(sheet: Sheet) -> set[str]:
    """Return the cognitons that rules name."""
    begun = {one for civ in sheet.people.civilisations for one in civ.cognitons}
    return _affected(sheet) | _named(sheet, ("A_", "I_", "L_")) | begun


def changed_cognitons(sheet: Sheet) -> set[str]:
    """Return the cognitons that rules add, take or change, and not only their triggers."""
    return _affected(sheet) | _named(sheet, ("A_", "I_")) - _named(sheet, ("A_AddObjectXCogniton",))


def _affected(sheet: Sheet) -> set[str]:
    """Return the cognitons that effects of things change."""
    return {one.removeprefix("cogniton ") for one in sheet.needs if one.startswith("cogniton ")}


def _named(sheet: Sheet, beginnings: tuple[str, ...]) -> set[str]:
    """Return the cognitons that actions name whose own name begins so."""
    return {
        str(one.value)
        for plan in sheet.people.plans.values()
        for action in plan.actions
        for inner in action.all()
        if inner.name.startswith(beginnings)
        for one in inner.arguments
        if one.type == "Cogniton"
    }


def at_birth(sheet: Sheet, name: str) -> bool:
    """Say whether all agents have a cogniton at birth, whatever their scheme, or may have it."""
    by_chance = _chance(sheet, sheet.people.cognitons[name]) is not None
    everybody = all(name in sheet.people.initial(scheme) for scheme in sheet.people.schemes)
    return everybody or by_chance


def _chance(sheet: Sheet, cogniton: Cogniton) -> float | None:
    """Return how likely an agent has a cogniton at birth; None where that is no matter of luck."""
    percent = cogniton.start_chance
    by_chance = sheet.model.older and percent > 0 and not cogniton.initial
    return min(percent / 100, 1.0) if by_chance else None


def _cogniton(
    sheet: Sheet, cogniton: Cogniton, indent: str, plans: list[str], own: bool
) -> list[str]:
    lines = []
    description = " ".join(cogniton.description.split())
    if description.strip("- "):
        lines.append(f"{indent}# {description}")
    lines.append(f"{indent}{text(cogniton.name)}:")
    inner = f"{indent}  "
    if own:
        chance = _chance(sheet, cogniton)
        if not at_birth(sheet, cogniton.name):
            lines.append(f"{inner}at_birth: false")
        elif chance is not None and chance < 1:
            lines.append(f"{inner}chance: {written(chance)}")
    lines.append(f"{inner}start: 1")
    if cogniton.colour is not None:
        lines.append(f"{inner}colour: '#{cogniton.colour & 0xFFFFFF:06x}'")
    influences: dict[str, float] = {}
    for one in cogniton.influences:
        if one.plan in plans:
            influences[one.plan] = influences.get(one.plan, 0.0) + one.weight
    if influences:
        pairs = [f"{text(name)}: {written(weight)}" for name, weight in influences.items()]
        lines += flow("influence", pairs, inner, "{}")
    permits = [text(one) for one in dict.fromkeys(p.plan for p in cogniton.permits) if one in plans]
    if permits:
        lines += flow("conditional", permits, inner)
    if own and cogniton.triggers and is_condition(sheet, cogniton):
        conditions = [text(compared(sheet, one), True) for one in cogniton.triggers]
        if len(conditions) == 1:
            lines.append(f"{inner}active_while: {conditions[0]}")
        else:
            lines += flow("active_while", conditions, inner)
    if own and cogniton.type in ("belief", "percept", "skill", "trait", "meme"):
        lines.append(f"{inner}type: {cogniton.type}")
    return lines


def is_condition(sheet: Sheet, cogniton: Cogniton) -> bool:
    """Say whether a cogniton is there exactly while what its triggers compare holds.

    So it is with one trigger, or two that are the ends of a range. Else, and where it is there at
    birth, rules add and take it too, or some agents do not have it, the last crossing decides:
    rules called `notice_…` in the model's file.
    """
    if cogniton.name in changed_cognitons(sheet) or at_birth(sheet, cogniton.name):
        return False
    if any(cogniton.name in sheet.people.initial(one) for one in sheet.people.schemes):
        return False
    if not sheet.people.is_shared("cogniton", cogniton.name):
        return False
    if len(cogniton.triggers) == 1:
        return True
    ends = {one.comparison[0]: _bound(sheet, one) for one in cogniton.triggers}
    one_range = len(cogniton.triggers) == 2 and sorted(ends) == ["<", ">"]
    attributes = {one.attribute for one in cogniton.triggers}
    return one_range and len(attributes) == 1 and ends[">"] < ends["<"]


def _bound(sheet: Sheet, trigger: Trigger) -> float:
    if trigger.constant is not None:
        return sheet.people.constants[trigger.constant].value
    return trigger.threshold


def compared(sheet: Sheet, trigger: Trigger, own: str = "", model: str = "") -> str:
    """Return what a trigger compares, as a condition of a scheme or as an expression of rules.

    Args:
        sheet: the model file.
        trigger: the trigger.
        own: what stands before a field.
        model: what stands before a parameter.
    """
    if trigger.constant is not None:
        sheet.used_constants[trigger.constant] = None
        bound = f"{model}{sheet.parameters[trigger.constant]}"
    else:
        bound = written(trigger.threshold)
    return f"{own}{sheet.attribute(trigger.attribute)} {trigger.comparison} {bound}"


def flow(name: str, parts: list[str], indent: str, brackets: str = "[]") -> list[str]:
    """Return a list of YAML on one line, or on a few."""
    flat = f"{indent}{name}: {brackets[0]}{', '.join(parts)}{brackets[1]}"
    if len(flat) <= 100:
        return [flat]
    lines = [f"{indent}{name}: {brackets[0]}"]
    for part in parts:
        if len(lines[-1]) + len(part) + 3 > 100 or len(lines) == 1:
            lines.append(f"{indent}  {part},")
        else:
            lines[-1] += f" {part},"
    return [*lines, f"{indent}{brackets[1]}"]


def text(name: str, sentence: bool = False) -> str:
    """Return a name as YAML has it, in quotes where it needs them.

    >>> text("Try all"), text("no"), text("a: b")
    ('Try all', '"no"', '"a: b"')
    """
    plain = _PLAIN.fullmatch(name) and name.casefold() not in _WORDS
    if plain or (sentence and re.fullmatch(r"\w+ [<>=]+ -?[\w.]+", name)):
        return name
    return json.dumps(name, ensure_ascii=False)
