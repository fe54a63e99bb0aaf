"""Actions on what agents carry: objects, recipes, effects."""

from __future__ import annotations

from socialmind.metaciv.description import Action, Effect, Ingredient
from socialmind.metaciv.writing.acts.form import (
    Act,
    Ask,
    Writer,
    as_text,
    comparing,
    in_doc,
    in_name,
    name_of,
)
from socialmind.metaciv.writing.acts.minds import changing_attribute, strengthening
from socialmind.metaciv.writing.sheet import Sheet, written

# What having an object does ---------------------------------------------------------------------


def gaining(sheet: Sheet, thing: str, amount: str, who: str = "human") -> list[str]:
    """Return the lines by which an agent gets some of an object."""
    if not sheet.effects_of(thing, "possession"):
        return _more(sheet, thing, amount, who)
    return [f"{_handler(sheet, thing, 'gain')}({who}, {amount})"]


def losing(sheet: Sheet, thing: str, amount: str, who: str = "human") -> list[str]:
    """Return the lines by which an agent loses some of an object, which it has."""
    if not sheet.effects_of(thing, "possession"):
        return _fewer(sheet, thing, amount, who)
    return [f"{_handler(sheet, thing, 'lose')}({who}, {amount})"]


def _more(sheet: Sheet, thing: str, amount: str, who: str = "human") -> list[str]:
    return [f"{who}.{sheet.thing(thing)} += {amount}"]


def _fewer(sheet: Sheet, thing: str, amount: str, who: str = "human") -> list[str]:
    return [f"{who}.{sheet.thing(thing)} -= {amount}"]


def at_most(sheet: Sheet, thing: str, amount: str, who: str = "human") -> str:
    """Return so many of an object, or as many as an agent carries."""
    return f"min({who}.{sheet.thing(thing)}, {amount})"


def _handler(sheet: Sheet, thing: str, what: str) -> str:
    """Return the rule by which an object comes or goes with what it does to its owner."""
    name = sheet.handler_named(what, name_of(thing))
    if name not in sheet.helpers:
        sheet.helpers[name] = ""  # an object whose effect is an object may lead back here
        field = sheet.thing(thing)
        effects = sheet.effects_of(thing, "possession")
        if what == "gain":
            doc = f"Get some {thing}, with what having it does."
            lines = [f"human.{field} += count"]
            for effect in effects:
                lines += taking_effect(sheet, effect, "count", 1)
        else:
            doc = f"Lose some {thing}, with what having it did."
            lines = [f"human.{field} -= count"]
            for effect in effects:
                if not effect.permanent and effect.kind == "add":
                    lines += taking_effect(sheet, effect, "count", -1)
        body = "\n    ".join(lines)
        sheet.helpers[name] = f'\ndef {name}(human, count):\n    """{doc}"""\n    {body}\n'
    return name


def taking_effect(sheet: Sheet, effect: Effect, count: str, sign: int) -> list[str]:
    """Return the lines of what an object does to its owner, or has done.

    Args:
        sheet: the model file.
        effect: the effect.
        count: how often, an expression.
        sign: 1, or −1 to undo it.
    """
    value = effect.value * sign
    times = count if value == 1 else f"{written(value)} * {count}"
    if effect.kind == "remove":
        times = count if value == -1 else f"{written(-value)} * {count}"
    setting = [f"if {count} > 0:"]
    target = effect.target_name
    if effect.target == "attribute":
        if target not in sheet.attribute_fields:
            sheet.not_supported(effect.place, f"the attribute {target!r}, which no agent has")
            return []
        if effect.kind == "set":
            return [*setting, f"    human.{sheet.attribute(target)} = {written(effect.value)}"]
        return changing_attribute(sheet, target, times)
    if effect.target == "cogniton":
        if target not in sheet.people.cognitons:
            sheet.not_supported(effect.place, f"the cogniton {target!r}, which no agent has")
            return []
        sheet.needs.add(f"cogniton {target}")
        if effect.kind == "add":
            return [*setting, f"    {strengthening(sheet, 'human', target, times)}"]
        if effect.kind == "remove" or effect.value <= 0:
            return [*setting, f"    human.mind.deactivate_cogniton({as_text(target)})"]
        return [
            *setting,
            f"    human.mind.activate_cogniton({as_text(target)})",
            f"    human.mind.set_cogniton_value({as_text(target)}, {written(effect.value)})",
        ]
    return _changing_object(sheet, effect, count, sign)


def _changing_object(sheet: Sheet, effect: Effect, count: str, sign: int) -> list[str]:
    """Return the lines of an effect on an object; a chain of effects that comes back is cut."""
    target = effect.target_name
    whole = written(int(abs(effect.value)))
    many = count if whole == "1" else f"{whole} * {count}"
    lowers = (effect.kind == "remove") == (sign > 0) or (effect.value < 0) != (sign < 0)
    chained = bool(sheet.effects_of(target, "possession"))
    begun = (sheet.handler_named(one, name_of(target)) for one in ("gain", "lose") if chained)
    if any(sheet.helpers.get(one) == "" for one in begun):
        said = f"an effect on {target!r}, whose effects lead back to it: they are not run"
        sheet.not_supported(effect.place, said)
        chained = False
    get, lose = (gaining, losing) if chained else (_more, _fewer)
    if effect.kind != "set":
        if lowers:
            return lose(sheet, target, at_most(sheet, target, many))
        return get(sheet, target, many)
    field, value = f"human.{sheet.thing(target)}", written(int(effect.value))
    if not chained:
        return [f"if {count} > 0:", f"    {field} = {value}"]
    lines = [f"if {count} > 0 and {field} < {value}:"]
    lines += [f"    {line}" for line in get(sheet, target, f"{value} - {field}")]
    lines.append(f"if {count} > 0 and {field} > {value}:")
    return lines + [f"    {line}" for line in lose(sheet, target, f"{field} - {value}")]


# Recipes ----------------------------------------------------------------------------------------


def carries(sheet: Sheet, recipe: tuple[Ingredient, ...]) -> str:
    """Return the question whether an agent carries what a recipe wants."""
    return " and ".join(f"human.{sheet.thing(one.object)} >= {one.count}" for one in recipe)


def using_up(sheet: Sheet, recipe: tuple[Ingredient, ...]) -> list[str]:
    """Return the lines by which what a recipe wants is used up."""
    return [
        line for one in recipe for line in losing(sheet, one.object, str(one.count))
    ]  # fmt: skip


def create_object(sheet: Sheet, action: Action) -> Act:
    """A_CreateObject."""
    thing = str(action.argument("Objet").value)
    recipe = sheet.objects[thing].recipe
    made = gaining(sheet, thing, "1")
    if not recipe:
        return Act((f"make_{name_of(thing)}",), f"Make 1 {thing}.", made)
    body = [f"if {carries(sheet, recipe)}:"]
    body += [f"    {line}" for line in (*using_up(sheet, recipe), *made)]
    wanted = " and ".join(f"{one.count} {one.object}" for one in recipe)
    return Act((f"make_{name_of(thing)}",), f"Make 1 {thing} of {wanted}.", body)


# In and out -------------------------------------------------------------------------------------


def add_item(sheet: Sheet, action: Action) -> Act:
    """A_AddItem, A_GetObject: below 0 it takes away."""
    thing = str(action.argument("Objet").value)
    argument = action.argument("Integer")
    count = sheet.count(argument)
    if sheet.sign(argument) < 0:
        less = f"-{count}" if argument.constant else count[1:]
        return _dropping(sheet, thing, less)
    return Act(
        (f"add_{name_of(thing)}", f"add_{in_name(count)}_{name_of(thing)}"),
        f"Get {in_doc(count)} {thing}.",
        gaining(sheet, thing, count),
    )


def drop(sheet: Sheet, action: Action) -> Act:
    """A_DropObject, A_RemoveItem, A_DropItem."""
    thing = str(action.argument("Objet").value)
    return _dropping(sheet, thing, sheet.count(action.argument("Integer")))


def _dropping(sheet: Sheet, thing: str, count: str) -> Act:
    return Act(
        (f"drop_{name_of(thing)}", f"drop_{in_name(count)}_{name_of(thing)}"),
        f"Lose {in_doc(count)} {thing}, or as many as there are.",
        losing(sheet, thing, at_most(sheet, thing, count)),
    )


def drop_and_change(sheet: Sheet, action: Action) -> Act:
    """A_DropObjectAndChangeAttribute."""
    thing, attribute = (str(action.argument(one).value) for one in ("Objet", "Attribute"))
    count, amount = sheet.count(action.argument("Integer")), sheet.number(action.argument("Double"))
    body = [
        f"if human.{sheet.thing(thing)} >= {count}:",
        *(f"    {line}" for line in losing(sheet, thing, count)),
        *(f"    {line}" for line in changing_attribute(sheet, attribute, amount)),
    ]
    name = f"give_{name_of(thing)}_for_{name_of(attribute)}"
    doc = f"Give {in_doc(count)} {thing}, if there are as many, for {in_doc(amount)} {attribute}."
    return Act((name, f"{name}_{in_name(amount)}"), doc, body)


def use_object(sheet: Sheet, action: Action) -> Act:
    """A_UseObject."""
    thing = str(action.argument("Objet").value)
    count = sheet.count(action.argument("Integer"))
    effects = sheet.effects_of(thing, "use")
    name = f"use_{name_of(thing)}"
    body = [f"used = {at_most(sheet, thing, count)}"]
    for effect in effects:
        body += taking_effect(sheet, effect, "used", 1)
    body += losing(sheet, thing, "used")
    doc = f"Use {in_doc(count)} {thing}, or as many as there are, up."
    return Act((name, f"use_{in_name(count)}_{name_of(thing)}"), doc, body)


def add_by_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_AddObjectXCogniton."""
    thing, cogniton = (str(action.argument(one).value) for one in ("Objet", "Cogniton"))
    factor, base = sheet.number(action.argument("Double")), sheet.count(action.argument("Integer"))
    value = f"human.mind.get_cogniton_value({as_text(cogniton)})"
    body = [f"many = {base} + int({factor} * {value})"]
    body += gaining(sheet, thing, "max(many, 0)")
    name = f"add_{name_of(thing)}_by_{name_of(cogniton)}"
    doc = f"Get {base} {thing}, and {factor} more for each 1 of {cogniton}."
    return Act((name,), doc, body)


def own_object(sheet: Sheet, action: Action) -> Ask:
    """L_OwnObject, L_OwnItem."""
    thing = str(action.argument("Objet").value)
    test = f"human.{sheet.thing(thing)} >= 1"
    return Ask((f"carries_{name_of(thing)}",), f"whether there is a {thing}", test)


def compare_object(sheet: Sheet, action: Action) -> Ask:
    """L_CompareNombreObjets, L_CompareNObject, L_CompareObject."""
    thing = str(action.argument("Objet").value)
    argument = next(one for one in action.arguments if one.type in ("Integer", "Double"))
    how = str(action.argument("Comparator").value)
    number = sheet.number(argument)
    name = name_of(thing)
    ask = comparing(name, thing, how, number, f"human.{sheet.thing(thing)}")
    ask.names += (f"carried_{name}{ask.names[0].removeprefix(name)}",)
    return ask


WRITERS: dict[str, Writer] = {
    "A_AddItem": add_item,
    "A_AddObjectXCogniton": add_by_cogniton,
    "A_CreateObject": create_object,
    "A_DropItem": drop,
    "A_DropObject": drop,
    "A_DropObjectAndChangeAttribute": drop_and_change,
    "A_GetObject": add_item,
    "A_RemoveItem": drop,
    "A_UseObject": use_object,
    "L_CompareNObject": compare_object,
    "L_CompareNombreObjets": compare_object,
    "L_CompareObject": compare_object,
    "L_OwnItem": own_object,
    "L_OwnObject": own_object,
}
