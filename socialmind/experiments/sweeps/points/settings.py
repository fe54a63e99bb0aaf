"""What a point of a design sets in a society: its parameters, its schemes, its minds."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from coglogo_py import CognitiveScheme
from coglogo_py.changing.words import Word, with_word
from coglogo_py.decision import DecisionMaker
from socialmind.experiments.sweeps.points.varied import MIND, PARAMETER, SCHEME, WORD, Varied
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of, mind_of

KEPT = 64
"""So many schemes a worker keeps, those that came last: replicates of a point share one."""

Key = tuple[str, str]
"""A population, and the text that names a whole scheme or mind; empty for what it has anyway."""


@dataclass(frozen=True, eq=False)
class Settings:
    """What points set.

    Args:
        columns: of the design.
        fixed: what is set in all runs alike: pairs of what and its value.
        schemes: all schemes by population and name.
        minds: all minds likewise.
        makers: the decision makers of the modeller's own, by population.
    """

    columns: tuple[Varied, ...]
    fixed: tuple[tuple[Varied, Any], ...]
    schemes: Mapping[Key, CognitiveScheme]
    minds: Mapping[Key, MindDescription]
    makers: Mapping[str, tuple[type[DecisionMaker], ...]]
    _made: OrderedDict[Any, CognitiveScheme] = field(default_factory=OrderedDict)

    def arguments(self, values: Sequence[Any]) -> dict[str, Any]:
        """Return what a model is made with at a point, but for its seed.

        Args:
            values: of the columns.

        Raises:
            SocialmindError: a scheme that cannot be.
        """
        parameters: dict[str, Any] = {}
        chosen: dict[tuple[str, str], str] = {}
        words: dict[str, dict[Word, Any]] = {}
        for one, value in (*self.fixed, *zip(self.columns, values, strict=True)):
            if one.kind == PARAMETER:
                parameters[one.name] = value
            elif one.kind == WORD and one.word is not None:
                words.setdefault(one.population, {})[one.word] = value
            else:
                chosen[one.kind, one.population] = value
        schemes = {
            owner: self._scheme(owner, chosen.get((SCHEME, owner), ""), words.get(owner, {}))
            for owner, name in self.schemes
            if not name
        }
        minds = {
            owner: self.minds[owner, chosen.get((MIND, owner), "")]
            for owner, name in self.minds
            if not name
        }
        return {"scheme": schemes or None, "hierarchy": minds or None, **parameters}

    def _scheme(self, owner: str, name: str, words: Mapping[Word, Any]) -> CognitiveScheme:
        whole = self.schemes[owner, name]
        if not words:
            return whole
        key = owner, name, tuple(words.items())
        if key not in self._made:
            while len(self._made) >= KEPT:
                self._made.popitem(last=False)
            changed = whole
            for word, value in words.items():
                changed = with_word(changed, word.text, value, self.makers.get(owner, ()))
            self._made[key] = changed
        return self._made[key]

    def __reduce__(self) -> tuple[Any, ...]:
        # Minds travel as their files, which may stand elsewhere on another machine, or nowhere.
        minds = {key: files_of(mind) for key, mind in self.minds.items()}
        return _unpacked, (self.columns, self.fixed, dict(self.schemes), minds, dict(self.makers))


def _unpacked(
    columns: tuple[Varied, ...],
    fixed: tuple[tuple[Varied, Any], ...],
    schemes: Mapping[Key, CognitiveScheme],
    minds: Mapping[Key, Mapping[str, bytes]],
    makers: Mapping[str, tuple[type[DecisionMaker], ...]],
) -> Settings:
    read = {key: mind_of(files) for key, files in minds.items()}
    return Settings(columns, fixed, schemes, read, makers)
