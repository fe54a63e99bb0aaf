"""Actions on minds: cognitons and attributes."""

from __future__ import annotations

from socialmind.metaciv.description import Action
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
from socialmind.metaciv.writing.sheet import Sheet

STRENGTHEN = '''
def strengthen(human, cogniton, amount):
    """Add to a cogniton's value: it comes with the amount, and goes when nearly nothing is left."""
    if human.mind.is_active(cogniton):
        human.mind.add_to_cogniton_value(cogniton, amount)
        if human.mind.get_cogniton_value(cogniton) < LEAST_VALUE:
            human.mind.deactivate_cogniton(cogniton)
    else:
        human.mind.activate_cogniton(cogniton)
        human.mind.set_cogniton_value(cogniton, amount)
'''
GAIN = '''
def come_to(human, cogniton):
    """Let a cogniton come, with the value 1, if it is not there."""
    if not human.mind.is_active(cogniton):
        human.mind.activate_cogniton(cogniton)
        human.mind.set_cogniton_value(cogniton, 1)
'''


def strengthening(sheet: Sheet, who: str, cogniton: str, amount: str) -> str:
    """Return the line that adds to a cogniton's value."""
    sheet.help("strengthen", STRENGTHEN)
    sheet.constants["LEAST_VALUE"] = "0.001  # below which a cogniton is lost"
    return f"strengthen({who}, {as_text(cogniton)}, {amount})"


def change_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_ChangeCognitonWeight, A_ChangeCognitonWeightInteger."""
    cogniton = str(action.argument("Cogniton").value)
    amount = sheet.number(action.argument("Double"))
    base = f"{'weaken' if amount.startswith('-') else 'strengthen'}_{name_of(cogniton)}"
    names = (base, f"{base}_by_{in_name(amount.lstrip('-'))}")
    body = [strengthening(sheet, "human", cogniton, amount)]
    return Act(names, f"Add {in_doc(amount)} to {cogniton}.", body)


def replace_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_ReplaceCognitonWeight."""
    cogniton = str(action.argument("Cogniton").value)
    amount = sheet.number(action.argument("Double"))
    name = f"set_{name_of(cogniton)}"
    body = [
        f"human.mind.activate_cogniton({as_text(cogniton)})",
        f"human.mind.set_cogniton_value({as_text(cogniton)}, {amount})",
    ]
    return Act((name, f"{name}_to_{in_name(amount)}"), f"Set {cogniton} to {amount}.", body)


def add_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_AddCogniton."""
    cogniton = str(action.argument("Cogniton").value)
    sheet.help("come_to", GAIN)
    name = name_of(cogniton)
    body = [f"come_to(human, {as_text(cogniton)})"]
    return Act((f"come_to_{name}",), f"Let {cogniton} come.", body)


def lend_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_ChangeCognitonWeightOneTick."""
    cogniton = str(action.argument("Cogniton").value)
    amount = sheet.number(action.argument("Double"))
    name = name_of(cogniton)
    lent = sheet.field(f"passing_{name}", f"float = 0.0  # of {cogniton}, in this tick alone")
    sheet.needs.add(f"lent {cogniton}")
    body = [
        f"if human.mind.is_active({as_text(cogniton)}):",
        f"    human.mind.add_to_cogniton_value({as_text(cogniton)}, {amount})",
        f"    human.{lent} += {amount}",
    ]
    names = (f"raise_{name}_for_a_tick", f"raise_{name}_by_{in_name(amount)}_for_a_tick")
    return Act(names, f"Add {amount} to {cogniton} until the end of the tick.", body)


def emit_cogniton(sheet: Sheet, action: Action) -> Act:
    """A_EmitCogniton."""
    cogniton = str(action.argument("Cogniton").value)
    amount = sheet.number(action.argument("Double"))
    name = f"spread_{name_of(cogniton)}"
    body = [
        "for other in model.humans.on(human):",
        f"    {strengthening(sheet, 'other', cogniton, amount)}",
    ]
    doc = f"Add {amount} to {cogniton} of all others here."
    return Act((name, f"{name}_by_{in_name(amount)}"), doc, body)


def own_cogniton(sheet: Sheet, action: Action) -> Ask:
    """L_OwnCogniton."""
    cogniton = str(action.argument("Cogniton").value)
    test = f"human.mind.is_active({as_text(cogniton)})"
    return Ask((f"owns_{name_of(cogniton)}",), f"whether {cogniton} is there", test)


def compare_cogniton(sheet: Sheet, action: Action) -> Ask:
    """L_CompareCogniton."""
    cogniton = str(action.argument("Cogniton").value)
    number, how = sheet.number(action.argument("Double")), str(action.argument("Comparator").value)
    mind = f"human.mind.get_cogniton_value({as_text(cogniton)})"
    ask = comparing(name_of(cogniton), cogniton, how, number, mind)
    ask.test = f"human.mind.is_active({as_text(cogniton)}) and {ask.test}"
    return ask


def changing_attribute(sheet: Sheet, attribute: str, amount: str, who: str = "human") -> list[str]:
    """Return the lines that add to an attribute."""
    field = sheet.attribute(attribute)
    if amount.startswith("-"):
        return [f"{who}.{field} -= {amount[1:]}"]
    return [f"{who}.{field} += {amount}"]


def change_attribute(sheet: Sheet, action: Action) -> Act:
    """A_ChangeAttribute, A_ChangeAttributeDouble."""
    attribute = str(action.argument("Attribute").value)
    argument = next(one for one in action.arguments if one.type in ("Integer", "Double"))
    amount = sheet.number(argument)
    lower = amount.startswith("-")
    base = f"{'lower' if lower else 'raise'}_{name_of(attribute)}"
    names = (base, f"{base}_by_{in_name(amount.lstrip('-'))}")
    return Act(
        names,
        f"{'Take' if lower else 'Add'} {in_doc(amount.lstrip('-'))} "
        f"{'from' if lower else 'to'} {attribute}.",
        changing_attribute(sheet, attribute, amount),
    )


def set_poisson_law(sheet: Sheet, action: Action) -> Act:
    """A_SetPoissonLaw."""
    attribute = str(action.argument("Attribute").value)
    body = [f"human.{sheet.attribute(attribute)} = rng.integers(96)"]
    return Act((f"draw_{name_of(attribute)}",), f"Draw {attribute}, a number of 0 … 95.", body)


def compare_attribute(sheet: Sheet, action: Action) -> Ask:
    """L_CompareAttribute."""
    attribute = str(action.argument("Attribute").value)
    number, how = sheet.number(action.argument("Double")), str(action.argument("Comparator").value)
    field = sheet.attribute(attribute)
    return comparing(name_of(attribute), attribute, how, number, f"human.{field}")


def random_percent(sheet: Sheet, action: Action) -> Ask:
    """L_RandomPercent."""
    percent = sheet.number(action.argument("Double"))
    name = f"with_chance_{in_name(percent)}"
    return Ask((name,), f"whether luck has it, {in_doc(percent)} times in a hundred",
               f"100 * rng.random() < {percent}")  # fmt: skip


def set_strike_value(sheet: Sheet, action: Action) -> Act:
    """A_SetStrikeValue."""
    value = sheet.count(action.argument("Integer"))
    sheet.field("strike", "int = 1  # how much it does to what it works on")
    return Act((f"strike_with_{in_name(value)}",), f"Strike with {value}.",
               [f"human.strike = {value}"])  # fmt: skip


def check_strike_value(sheet: Sheet, action: Action) -> Ask:
    """L_CheckStrikeValue."""
    value = sheet.count(action.argument("Integer"))
    sheet.field("strike", "int = 1  # how much it does to what it works on")
    how = str(action.argument("Comparator").value)
    return comparing("strike", "strike", how, value, "human.strike")


def do_nothing(sheet: Sheet, action: Action | None = None) -> Act:
    """A_DoNothing."""
    return Act(("do_nothing",), "Let a tick pass.", ["pass"])


WRITERS: dict[str, Writer] = {
    "A_AddCogniton": add_cogniton,
    "A_ChangeAttribute": change_attribute,
    "A_ChangeAttributeDouble": change_attribute,
    "A_ChangeCognitonWeight": change_cogniton,
    "A_ChangeCognitonWeightInteger": change_cogniton,
    "A_ChangeCognitonWeightOneTick": lend_cogniton,
    "A_DoNothing": do_nothing,
    "A_EmitCogniton": emit_cogniton,
    "A_ReplaceCognitonWeight": replace_cogniton,
    "A_SetPoissonLaw": set_poisson_law,
    "A_SetStrikeValue": set_strike_value,
    "L_CheckStrikeValue": check_strike_value,
    "L_CompareAttribute": compare_attribute,
    "L_CompareCogniton": compare_cogniton,
    "L_OwnCogniton": own_cogniton,
    "L_RandomPercent": random_percent,
}
