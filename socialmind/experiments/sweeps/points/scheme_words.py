"""The words of a cognitive scheme that a sweep can vary, as the YAML form writes them.

- `influence.HOLDER.PLAN`, `reinforcement.HOLDER.PLAN`: the weight of a link;
- `start.HOLDER`: the value at the start;
- `at_birth.COGNITON`, `chance.COGNITON`, `inherited.COGNITON`;
- `decision_maker.bias`, `decision_maker.name`.

A holder is a cogniton, or a culturon: `GROUP.CULTURON`, or its name alone where that is clear.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import nearest, shown
from coglogo_py.border.numbers import is_number, is_truth
from coglogo_py.decision import BUILT_IN, DecisionMaker, decision_maker_called
from coglogo_py.parts import Culturon, Group
from socialmind.errors import SocialmindError

LINKS = ("influence", "reinforcement")
OF_COGNITONS = {"at_birth": "starting", "chance": "chance", "inherited": "inherited"}
"""Words of cognitons alone, and the fields that hold them."""
MAKER = "decision_maker"


@dataclass(frozen=True)
class Word:
    """One word of a scheme.

    Attributes:
        text: as it is written.
        kind: its first part.
        group: that of the culturon; empty for a cogniton, or the decision maker.
        holder: the cogniton or culturon; for the decision maker `bias` or `name`.
        plan: of a link; else empty.
    """

    text: str
    kind: str
    group: str
    holder: str
    plan: str = ""

    @property
    def of_links(self) -> bool:
        """Whether it is the weight of a link."""
        return self.kind in LINKS

    def read(self, text: str) -> Any:
        """Return a value that is written as text."""
        if (self.kind, self.holder) == (MAKER, "name"):
            return text
        if self.kind == "at_birth":
            truths = {"true": True, "yes": True, "false": False, "no": False}
            return truths.get(text.lower(), text)
        try:
            return float(text)
        except ValueError:
            return text

    def checked(self, value: Any) -> Any:
        """Return a value that the word can have, as Python has it.

        Raises:
            SocialmindError: it is of another kind; its range is the scheme's to check.
        """
        if (self.kind, self.holder) == (MAKER, "name"):
            good, expected = isinstance(value, str), "the name of a decision maker"
        elif self.kind == "at_birth":
            good, expected = is_truth(value), "true or false"
        else:
            good, expected = is_number(value), "a number"
        if not good:
            raise SocialmindError(f"{self.text}: found {shown(value)}; expected {expected}")
        if isinstance(value, str):
            return str(value)
        return bool(value) if self.kind == "at_birth" else float(value)


class Words:
    """The words of one scheme.

    Args:
        scheme: the scheme.
    """

    def __init__(self, scheme: CognitiveScheme) -> None:
        self._scheme = scheme

    @cached_property
    def known(self) -> dict[str, Word]:
        """The words by their texts."""
        return {one.text: one for one in self._all()}

    def hint(self, text: str) -> str | None:
        """Return the word that a text resembles, in words, or None."""
        return nearest(text, self.known)

    def _all(self) -> Iterator[Word]:
        yield Word(f"{MAKER}.bias", MAKER, "", "bias")
        yield Word(f"{MAKER}.name", MAKER, "", "name")
        names = [one.name for one in self._scheme.cognitons]
        for name in names:
            yield from self._of_holder("", name, name)
            for kind in OF_COGNITONS:
                yield Word(f"{kind}.{name}", kind, "", name)
        culturons = [
            (group.name, name)
            for group in self._scheme.groups
            for name in dict.fromkeys(c.name for role in group.roles for c in role.culturons)
        ]
        for group, name in culturons:
            yield from self._of_holder(group, name, f"{group}.{name}")
            if name not in names and [other for _, other in culturons].count(name) == 1:
                yield from self._of_holder(group, name, name)

    def _of_holder(self, group: str, name: str, said: str) -> Iterator[Word]:
        yield Word(f"start.{said}", "start", group, name)
        for kind in LINKS:
            for plan in self._scheme.plans:
                yield Word(f"{kind}.{said}.{plan}", kind, group, name, plan)


def with_words(
    scheme: CognitiveScheme,
    values: Mapping[Word, Any],
    makers: Iterable[type[DecisionMaker]] = (),
) -> CognitiveScheme:
    """Return a scheme with some words changed; it equals the one of a file edited so by hand.

    Args:
        scheme: as it was.
        values: those of the words.
        makers: decision makers of the modeller's own that may be named.

    Raises:
        SchemeError: a value that the scheme cannot have.

    >>> from coglogo_py import Cogniton
    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> cows = CognitiveScheme("cows", (hunger,))
    >>> word = Words(cows).known["influence.Hunger.eat"]
    >>> dict(with_words(cows, {word: 3.0}).cognitons[0].influence)
    {'eat': 3.0}
    """
    cognitons = {one.name: one for one in scheme.cognitons}
    groups = {one.name: one for one in scheme.groups}
    chosen: dict[str, Any] = {}
    for word, value in values.items():
        if word.kind == MAKER:
            chosen[word.holder] = value
        elif word.group:
            groups[word.group] = _in_group(groups[word.group], word, value)
        else:
            cognitons[word.holder] = _changed(cognitons[word.holder], word, value)
    maker = scheme.decision_maker
    if chosen:
        known = (type(maker), *makers) if type(maker) not in BUILT_IN else tuple(makers)
        maker = decision_maker_called(
            chosen.get("name", maker.name), chosen.get("bias", maker.bias), known
        )
    return replace(
        scheme,
        cognitons=tuple(cognitons.values()),
        groups=tuple(groups.values()),
        decision_maker=maker,
        plan_order=scheme.plans,
    )


def _changed(one: Any, word: Word, value: Any) -> Any:
    """Return a cogniton or culturon with a word changed."""
    if word.of_links:
        return replace(one, **{word.kind: {**getattr(one, word.kind), word.plan: value}})
    return replace(one, **{OF_COGNITONS.get(word.kind, "start_value"): value})


def _in_group(group: Group, word: Word, value: Any) -> Group:
    """Return a group with a culturon changed, in all roles that name it."""

    def changed(one: Culturon) -> Culturon:
        return _changed(one, word, value) if one.name == word.holder else one

    roles = tuple(
        replace(role, culturons=tuple(changed(one) for one in role.culturons))
        for role in group.roles
    )
    return replace(group, roles=roles)
