"""What ``name=value`` sets in a society: a parameter, or a word of a scheme.

A parameter of the model wins over a word. A word of a scheme (`coglogo_py.changing.words`) has the
name of its population in front where several have schemes:
``humans.influence.WheatNeed.GrowWheat=2``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from coglogo_py import CognitiveScheme
from coglogo_py.changing.words import FIRST, is_word, with_word
from socialmind.errors import SocialmindError, nearest

Word = tuple[str, Any]


@dataclass(frozen=True)
class Settings:
    """Settings of a model, sorted out.

    Args:
        parameters: values by name.
        words: of each population's scheme that is to change, words with their values.
    """

    parameters: dict[str, Any] = field(default_factory=dict)
    words: dict[str, tuple[Word, ...]] = field(default_factory=dict)

    def changed(
        self, schemes: Mapping[str, CognitiveScheme], populations: Mapping[str, Any]
    ) -> dict[str, CognitiveScheme]:
        """Return the schemes that words change, changed.

        Args:
            schemes: of populations, as they are.
            populations: of the model.

        Raises:
            SchemeError: a scheme has no such part, or it cannot have that value.
        """
        found = {}
        for name, words in self.words.items():
            scheme = schemes[name]
            for word, value in words:
                scheme = with_word(scheme, word, value, populations[name].decision_makers)
            found[name] = scheme
        return found


def pair(text: str) -> tuple[str, str]:
    """Return name and value of a text such as ``tool_price=200``.

    Raises:
        SocialmindError: there is no ``=``.
    """
    name, equals, value = (part.strip() for part in text.partition("="))
    if not equals:
        raise SocialmindError(f"{text}: expected NAME=VALUE")
    return name, value


def sorted_out(kind: Any, settings: Mapping[str, Any] | Iterable[tuple[str, Any]]) -> Settings:
    """Return settings of a model, sorted out; a text is read as what it sets.

    Args:
        kind: the model's class.
        settings: values by name; of two for one name the later counts.

    Raises:
        SocialmindError: a name is neither a parameter nor a word of a scheme, or a parameter
            cannot take that value.
    """
    pairs = settings.items() if isinstance(settings, Mapping) else settings
    minded = [name for name, one in kind.populations.items() if one.mind is not None]
    parameters: dict[str, Any] = {}
    words: dict[str, tuple[Word, ...]] = {}
    for name, value in pairs:
        plain = name.replace("-", "_")
        if plain in kind.parameters:
            one = kind.parameters[plain]
            parameters[plain] = one.read(value) if isinstance(value, str) else one.checked(value)
            continue
        population, word = _word(kind, name, minded)
        words[population] = (*words.get(population, ()), (word, value))
    return Settings(parameters, words)


def _word(kind: Any, name: str, minded: list[str]) -> tuple[str, str]:
    """Return the population and the word of its scheme that a name stands for."""
    if is_word(name):
        if len(minded) == 1:
            return minded[0], name
        if minded:
            raise SocialmindError(
                f"{name}: of whose scheme? write {minded[0]}.{name}; {kind.name} has schemes of "
                f"{', '.join(minded)}"
            )
    population, dot, word = name.partition(".")
    if dot and is_word(word):
        if population in minded:
            return population, word
        raise SocialmindError(
            f"{name}: no population {population!r} with a scheme in {kind.name}; "
            f"{nearest(population, minded)}"
        )
    if dot:
        raise SocialmindError(
            f"{name}: neither a parameter of {kind.name} nor a word of a scheme; such words begin "
            f"with {', '.join(FIRST)}"
        )
    raise SocialmindError(f"no parameter called {name}; {nearest(name, kind.parameters)}")
