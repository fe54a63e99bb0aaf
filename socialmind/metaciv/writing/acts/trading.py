"""Trade: with a target, or with whoever waits with a tag that fits."""

from __future__ import annotations

from socialmind.metaciv.description import Action, Argument
from socialmind.metaciv.writing.acts.form import Act, Ask, Writer, in_doc, name_of
from socialmind.metaciv.writing.acts.ground import going
from socialmind.metaciv.writing.acts.others import at_target, with_target_field
from socialmind.metaciv.writing.acts.things import gaining, losing
from socialmind.metaciv.writing.sheet import Sheet


def _labelled(action: Action, label: str, type_: str, number: int) -> Argument:
    of_type = [one for one in action.arguments if one.type == type_]
    return next((one for one in of_type if one.label == label), of_type[number])


def trade(sheet: Sheet, action: Action) -> Act:
    """I_Commercer_Repondu."""
    with_target_field(sheet)
    given, taken = (
        str(_labelled(action, label, "Objet", number).value)
        for number, label in enumerate(("objectToGive", "objectToTake"))
    )
    many, price = (
        sheet.count(_labelled(action, label, "Integer", number))
        for number, label in enumerate(("nObjectToGive", "nObjectToTake"))
    )
    here = [
        f"if human.{sheet.thing(given)} > {many} and other.{sheet.thing(taken)} > {price}:",
        *(f"    {line}" for line in _swap(sheet, given, many, taken, price)),
        "    human.target = -1",
    ]
    doc = f"Trade {in_doc(many)} {given} for {in_doc(price)} {taken} with the target, or go to it."
    name = f"trade_{name_of(given)}_for_{name_of(taken)}"
    return Act((name,), doc, at_target(sheet, here))


def _swap(sheet: Sheet, given: str, many: str, taken: str, price: str) -> list[str]:
    return [
        *losing(sheet, given, many),
        *gaining(sheet, given, many, "other"),
        *losing(sheet, taken, price, "other"),
        *gaining(sheet, taken, price),
    ]


def trade_by_tag(sheet: Sheet, action: Action) -> Act:
    """A_Trade, A_TravelTrade."""
    turns = sheet.count(_labelled(action, "turns", "Integer", 0))
    given, taken = (
        str(_labelled(action, label, "Objet", number).value)
        for number, label in enumerate(("itemToGive", "itemToTake"))
    )
    many, price = (
        sheet.count(_labelled(action, label, "Integer", number))
        for number, label in enumerate(("nItemToGive", "nItemToTake"), 1)
    )
    own_tag, other_tag = (
        _tag(sheet, str(_labelled(action, label, "String", number).value))
        for number, label in enumerate(("myTag", "compatibleTag"))
    )
    sheet.field("tag", "int = 0  # what it offers while it waits for a trade; 0 for nothing")
    sheet.field("waited", "int = 0  # ticks")
    sheet.field("bargain", "int = 0  # of its last trade: whether it, or another, made it")
    sheet.constants["MADE"] = "1  # bargains: made by oneself, or by another"
    sheet.constants["MET"] = "2"
    sheet.constants["SERVED"] = "-1  # the tag of an agent with which another has traded"
    able = f"human.{sheet.thing(given)} >= {many} and other.{sheet.thing(taken)} >= {price}"
    body = [
        "if human.tag == SERVED:",
        "    human.tag = 0",
        "    human.bargain = MET",
        "    return True",
        f"if human.tag != {own_tag}:",
        f"    human.tag = {own_tag}",
        "    human.waited = 0",
        "    human.bargain = 0",
        "for other in model.humans.on(human):",
        f"    fits = other.tag == {other_tag} and human.bargain == 0",
        f"    if fits and {able}:",
        *(f"        {line}" for line in _swap(sheet, given, many, taken, price)),
        "        human.bargain = MADE",
        "        human.tag = 0",
        "        other.tag = SERVED",
        "if human.bargain == MADE:",
        "    return True",
        "human.waited += 1",
        f"if human.waited >= {turns}:",
        "    human.tag = 0",
        "    return True",
    ]
    if action.name == "A_TravelTrade":
        body += [
            "partner = min(",
            f"    (one for one in model.humans if one.tag == {other_tag} and one.id != human.id),",
            "    key=lambda one: model.world.distance(human, one.x, one.y),",
            "    default=None,",
            ")",
            "if partner is not None:",
            f"    {going(sheet, 'partner.x', 'partner.y')}",
        ]
    body.append("return False")
    travel = "travel" if action.name == "A_TravelTrade" else "wait"
    name = f"{travel}_to_trade_{name_of(given)}_for_{name_of(taken)}"
    doc = f"Offer {in_doc(many)} {given} for {in_doc(price)} {taken}, {in_doc(turns)} ticks long."
    return Act((name, f"{name}_as_{own_tag.lower()}"), doc, body, True)


_OFFER = "  # what an agent offers in a trade: "


def _tag(sheet: Sheet, tag: str) -> str:
    name = sheet.constant_named("tag", tag, f"TAG_{name_of(tag).upper()}")
    if name not in sheet.constants:
        number = 1 + sum(1 for one in sheet.constants.values() if _OFFER in one)
        sheet.constants[name] = f"{number}{_OFFER}{tag}"
    return name


def made_bargain(sheet: Sheet, action: Action) -> Ask:
    """Whether an agent made a trade itself, for A_Trade."""
    return Ask(("made_a_bargain",), "whether it has traded", "human.bargain == MADE")


def met_nobody(sheet: Sheet, action: Action) -> Ask:
    """Whether nobody traded, for A_Trade."""
    return Ask(("made_no_bargain",), "whether nobody has traded with it", "human.bargain == 0")


WRITERS: dict[str, Writer] = {
    "A_Trade": trade_by_tag,
    "A_TravelTrade": trade_by_tag,
    "I_Commercer_Repondu": trade,
}
