"""What of a scheme can be set by a word, in the names of its YAML form.

| word | value |
|---|---|
| ``influence.WheatNeed.GrowWheat``, ``reinforcement.Farmer.Trade`` | the weight of the link |
| ``conditional.Farmer.GrowWheat`` | whether there is such a link |
| ``start.Farmer`` | the value at birth, or of a culturon when its group is created |
| ``at_birth.Farmer``, ``chance.Farmer``, ``inherited.Farmer`` | of cognitons alone |
| ``group_attributes.herd.stores`` | the attribute when its group is created |
| ``decision_maker.bias``, ``decision_maker.name`` | how minds decide |

A culturon is named as cognitons are, with its group in front (``influence.herd.Alarm.flee``) where
the name alone could be another's. A scheme that is changed so keeps the order of its plans.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

from coglogo_py.border.errors import SchemeError, nearest
from coglogo_py.decision import DecisionMaker, decision_maker_called
from coglogo_py.files.yaml_nodes import TRUTH
from coglogo_py.parts import Cogniton, Culturon, Group, Role
from coglogo_py.scheme import CognitiveScheme

Holder = Cogniton | Culturon

WEIGHTS = ("influence", "reinforcement")
LINKS = (*WEIGHTS, "conditional")
OF_HOLDERS = {
    "start": "start_value",
    "at_birth": "starting",
    "chance": "chance",
    "inherited": "inherited",
}
"""Words of one holder of links, and the fields that they set."""
OF_COGNITONS = ("at_birth", "chance", "inherited")
MAKER = ("bias", "name")
FIRST = (*LINKS, *OF_HOLDERS, "group_attributes", "decision_maker")
"""What a word begins with."""


def is_word(name: str) -> bool:
    """Return whether a name is a word of a scheme, whether or not the scheme has such a part.

    >>> is_word("influence.Hunger.eat"), is_word("tool_price")
    (True, False)
    """
    first, dot, rest = name.partition(".")
    return bool(dot and rest) and first in FIRST


class Word(NamedTuple):
    """What a word names.

    Attributes:
        text: the word.
        first: what it begins with.
        group: that of a culturon or attribute; None for a cogniton or the decision maker.
        name: of the holder, the attribute, or the decision maker's field.
        plan: of a link; else empty.
    """

    text: str
    first: str
    group: str | None
    name: str
    plan: str = ""


def words_of(scheme: CognitiveScheme) -> dict[str, Word]:
    """Return all words of a scheme by their texts, but for names that may be of several.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0})
    >>> [word for word in words_of(CognitiveScheme("cows", (hunger,))) if "eat" in word]
    ['influence.Hunger.eat', 'reinforcement.Hunger.eat', 'conditional.Hunger.eat']
    """
    found = [Word(f"decision_maker.{field}", "decision_maker", None, field) for field in MAKER]
    for title, holders in _called(_holders(scheme)).items():
        if len(set(holders)) > 1:
            continue
        group, name = holders[0]
        found += [
            Word(f"{first}.{title}", first, group, name)
            for first in OF_HOLDERS
            if group is None or first not in OF_COGNITONS
        ]
        found += [
            Word(f"{first}.{title}.{plan}", first, group, name, plan)
            for first in LINKS
            for plan in scheme.plans
        ]
    for one in scheme.groups:
        for name, _ in one.attributes:
            text = f"group_attributes.{one.name}.{name}"
            found.append(Word(text, "group_attributes", one.name, name))
    return {word.text: word for word in found}


def value_of(word: str, value: Any) -> float | bool | str:
    """Return a value, or its text, as a word takes it.

    Raises:
        SchemeError: it is of another kind; what it may be is the scheme's to check.

    >>> value_of("start.Farmer", "3"), value_of("at_birth.Farmer", "no")
    (3.0, False)
    """
    if word == "decision_maker.name":
        return str(value)
    if word.partition(".")[0] in ("at_birth", "conditional"):
        return _truth(word, value)
    return _number(word, value)


def with_word(
    scheme: CognitiveScheme,
    word: str,
    value: float | bool | str,
    makers: Iterable[type[DecisionMaker]] = (),
) -> CognitiveScheme:
    """Return a scheme that differs from another in what a word names.

    Args:
        scheme: the other one.
        word: as this module's table has them.
        value: a number, a truth value or a name, or its text.
        makers: decision makers of the modeller's own that may be named.

    Raises:
        SchemeError: the scheme has no such part, or it cannot have that value.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> scheme = with_word(CognitiveScheme("cows", (hunger,)), "influence.Hunger.eat", "3")
    >>> scheme.cognitons[0].influence["eat"]
    3.0
    >>> with_word(scheme, "influence.Hunger.drink", 1)
    Traceback (most recent call last):
    coglogo_py.border.errors.SchemeError: found 'influence.Hunger.drink', with no plan 'drink' in \
scheme 'cows'; expected one of eat
    """
    first, _, rest = word.partition(".")
    if not is_word(word):
        raise SchemeError(f"{word!r} as a word of a scheme", f"{', '.join(FIRST)}, and a name")
    if first == "decision_maker":
        return replace(scheme, decision_maker=_maker(scheme, word, rest, value, tuple(makers)))
    if first == "group_attributes":
        return _with_attribute(scheme, word, rest, _number(word, value))
    found, plan = _found(scheme, word, first, rest)
    if first in LINKS:
        change = _link(first, plan, word, value)
    else:
        given = value_of(word, value)

        def change(holder: Any) -> Any:
            return replace(holder, **{OF_HOLDERS[first]: given})

    # The order decides between plans of equal weight, and a new link must not change it.
    return replace(_with_holder(scheme, found, change), plan_order=scheme.plans)


def _holders(scheme: CognitiveScheme) -> Iterator[tuple[str | None, str]]:
    """Yield what has links: the group, None for cognitons, and the name."""
    for cogniton in scheme.cognitons:
        yield None, cogniton.name
    for group in scheme.groups:
        named = (culturon.name for role in group.roles for culturon in role.culturons)
        yield from ((group.name, name) for name in dict.fromkeys(named))


def _called(holders: Iterable[tuple[str | None, str]]) -> dict[str, list[tuple[str | None, str]]]:
    """Return holders by what they may be called."""
    called: dict[str, list[tuple[str | None, str]]] = {}
    for group, name in holders:
        for title in (name,) if group is None else (name, f"{group}.{name}"):
            called.setdefault(title, []).append((group, name))
    return called


def _found(
    scheme: CognitiveScheme, word: str, first: str, rest: str
) -> tuple[tuple[str | None, str], str]:
    """Return the holder that a word names, and the plan behind it; names may hold full stops."""
    holders = [one for one in _holders(scheme) if first not in OF_COGNITONS or one[0] is None]
    called = _called(holders)
    links = first in LINKS
    fits = [(title, rest[len(title) + 1 :]) for title in called if rest.startswith(f"{title}.")]
    named = [(t, p) for t, p in fits if p in scheme.plans] if links else []
    if not links and rest in called:
        named = [(rest, "")]
    if not named and links and fits:
        _, plan = max(fits, key=lambda one: len(one[0]))
        raise SchemeError(
            f"{word!r}, with no plan {plan!r} in scheme {scheme.name!r}",
            f"one of {', '.join(scheme.plans)}",
            nearest(plan, scheme.plans),
        )
    if not named:
        what = rest.rpartition(".")[0] or rest if links else rest
        kind = "cogniton" if first in OF_COGNITONS else "cogniton or culturon"
        raise SchemeError(
            f"{word!r}, with no {kind} {what!r} in scheme {scheme.name!r}",
            f"one of {', '.join(called) or 'none, for there are none'}",
            nearest(what, called),
        )
    several = [(title, one, plan) for title, plan in named for one in called[title]]
    if len({one for _, one, _ in several}) > 1:
        ways = [f"{g}.{n}" if g is not None else n for _, (g, n), _ in several]
        raise SchemeError(
            f"{word!r}, which may be of {' or '.join(ways)} in scheme {scheme.name!r}",
            "one alone",
            "put the group in front, or give the cogniton or culturon another name",
        )
    _, holder, plan = several[0]
    return holder, plan


def _with_holder(
    scheme: CognitiveScheme, holder: tuple[str | None, str], change: Callable[[Any], Any]
) -> CognitiveScheme:
    of, name = holder
    if of is None:
        changed = tuple(change(one) if one.name == name else one for one in scheme.cognitons)
        return replace(scheme, cognitons=changed)

    def role(one: Role) -> Role:
        return replace(
            one, culturons=tuple(change(c) if c.name == name else c for c in one.culturons)
        )

    def group(one: Group) -> Group:
        return replace(one, roles=tuple(map(role, one.roles))) if one.name == of else one

    return replace(scheme, groups=tuple(map(group, scheme.groups)))


def _link(first: str, plan: str, word: str, value: Any) -> Callable[[Any], Any]:
    """Return what gives a holder a link of a weight, or opens and closes a plan."""
    if first in WEIGHTS:
        weight = _number(word, value)
        return lambda one: replace(one, **{first: {**getattr(one, first), plan: weight}})
    opens = _truth(word, value)

    def change(holder: Any) -> Any:
        others = tuple(one for one in holder.conditional if one != plan)
        if not opens:
            return replace(holder, conditional=others)
        return (
            holder if plan in holder.conditional else replace(holder, conditional=(*others, plan))
        )

    return change


def _with_attribute(scheme: CognitiveScheme, word: str, rest: str, value: float) -> CognitiveScheme:
    known = {f"{g.name}.{name}": (g.name, name) for g in scheme.groups for name, _ in g.attributes}
    if rest not in known:
        raise SchemeError(
            f"{word!r}, with no attribute {rest!r} of a group in scheme {scheme.name!r}",
            f"one of {', '.join(known) or 'none, for there are none'}",
            nearest(rest, known),
        )
    group, attribute = known[rest]
    groups = (
        replace(g, attributes=tuple((n, value if n == attribute else v) for n, v in g.attributes))
        if g.name == group
        else g
        for g in scheme.groups
    )
    return replace(scheme, groups=tuple(groups))


def _maker(
    scheme: CognitiveScheme,
    word: str,
    field: str,
    value: Any,
    makers: tuple[type[DecisionMaker], ...],
) -> DecisionMaker:
    maker = scheme.decision_maker
    if field == "bias":
        return replace(maker, bias=_number(word, value))
    if field == "name":
        return decision_maker_called(str(value), maker.bias, (*makers, type(maker)))
    raise SchemeError(
        f"{word!r}", "decision_maker.bias or decision_maker.name", nearest(field, MAKER)
    )


def _number(word: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise SchemeError(f"{word}={value}", "a number") from None


def _truth(word: str, value: Any) -> bool:
    if isinstance(value, bool):
        return value
    text = str(value).strip().lower()
    if text not in TRUTH:
        raise SchemeError(f"{word}={value}", "true or false")
    return bool(TRUTH[text])
