"""What a column of a design sets: a parameter, a word of a scheme, a whole scheme or a mind."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme, SchemeError
from coglogo_py.border.errors import nearest, shown
from coglogo_py.changing.words import Word, value_of, words_of
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.society.parameter import Parameter

PARAMETER, WORD, SCHEME, MIND = "parameter", "word", "scheme", "mind"


@dataclass(frozen=True)
class Varied:
    """What a column sets.

    Attributes:
        name: the column's, as the user wrote it.
        kind: `PARAMETER`, `WORD`, `SCHEME` or `MIND`.
        parameter: of the model, for a parameter.
        population: whose scheme or mind it is.
        word: of the scheme.
    """

    name: str
    kind: str
    parameter: Parameter | None = None
    population: str = ""
    word: Word | None = None

    def read(self, text: str) -> Any:
        """Return a value that is written as text, on the command line or in a CSV file.

        Raises:
            SocialmindError: it cannot be one.
        """
        if self.parameter is not None:
            return self.parameter.read(text)
        return self.checked(text)

    def checked(self, value: Any) -> Any:
        """Return a value as Python has it.

        Raises:
            SocialmindError: it cannot be one.
        """
        if self.parameter is not None:
            return self.parameter.checked(value)
        if self.word is not None:
            try:
                return value_of(self.word.text, value)
            except SchemeError as error:
                raise SocialmindError(str(error)) from None
        if not isinstance(value, str | Path):
            raise SocialmindError(f"{self.name}: found {shown(value)}; expected a file")
        if not Path(value).expanduser().exists():
            raise SocialmindError(f"{self.name}: {value}: no such file or folder")
        return str(value)

    @property
    def whole(self) -> bool:
        """Whether its values are whole numbers."""
        return self.parameter is not None and self.parameter.kind is int

    def bounds(self) -> tuple[float, float]:
        """Return the declared range of its values.

        Raises:
            SocialmindError: there is none.
        """
        one = self.parameter
        if one is None or one.kind not in (int, float):
            remedy = f"give --ranges {self.name}=LOW:HIGH"
            if one is not None or self.kind != WORD:
                remedy = f"give its values, --grid {self.name}=…"
            raise SocialmindError(f"{self.name} has no declared range to sample in; {remedy}")
        if one.low is None or one.high is None:
            raise SocialmindError(
                f"the parameter {one.name} is declared as {one.range}, which has no "
                f"{'lower' if one.low is None else 'upper'} border to sample up to; give --ranges "
                f"{self.name}=LOW:HIGH"
            )
        return one.low, one.high


@dataclass(frozen=True)
class Nameable:
    """What columns of a model's designs can name.

    Args:
        model_class: the model.
        schemes: the scheme of each population that has one.
        minded: the populations that have a hierarchy of skills.
    """

    model_class: type[Model]
    schemes: Mapping[str, CognitiveScheme]
    minded: tuple[str, ...]

    def called(self, name: str) -> Varied:
        """Return what a name stands for; a parameter wins over `scheme` and `mind`.

        Raises:
            SocialmindError: nothing is called so, or it is not clear whose scheme is meant.
        """
        parameters = self.model_class.parameters
        for spelled in (name, name.replace("-", "_")):
            if spelled in parameters:
                return Varied(spelled, PARAMETER, parameters[spelled])
        population, _, rest = name.partition(".")
        of_population = bool(rest) and population in (*self.schemes, *self.minded)
        said = rest if of_population else name
        if said == SCHEME:
            return Varied(name, SCHEME, population=self._owner(name, population, self.schemes))
        if said == MIND:
            return Varied(name, MIND, population=self._owner(name, population, self.minded))
        if of_population and population in self.schemes:
            word = words_of(self.schemes[population]).get(said)
            if word is not None:
                return Varied(name, WORD, population=population, word=word)
        if not of_population:
            owners = {
                owner: word
                for owner, scheme in self.schemes.items()
                if (word := words_of(scheme).get(said)) is not None
            }
            if len(owners) > 1 or (owners and len(self.schemes) > 1):
                raise SocialmindError(
                    f"{name}: {self.model_class.name} has schemes of {', '.join(self.schemes)}; "
                    f"say whose is meant: {next(iter(owners))}.{name}"
                )
            for owner, word in owners.items():
                return Varied(name, WORD, population=owner, word=word)
        raise self._unknown(name)

    def clashes(self, names: Iterable[str]) -> list[str]:
        """Return what is to be said of names that could have meant something else."""
        return [
            f"{name} is taken for the parameter of {self.model_class.name}, not for its "
            f"{name}; for that write POPULATION.{name}"
            for name, owners in ((SCHEME, self.schemes), (MIND, self.minded))
            if name in names and name in self.model_class.parameters and owners
        ]

    def _owner(self, name: str, population: str, owners: Iterable[str]) -> str:
        """Return the population whose scheme or mind is meant."""
        known, what = list(owners), name.rpartition(".")[2]
        if "." in name and population in known:
            return population
        if not known or "." in name:
            raise SocialmindError(
                f"{name}: there is no such {what} in {self.model_class.name}; populations that "
                f"have a {what}: {', '.join(known) or 'none'}"
            )
        if len(known) > 1:
            raise SocialmindError(
                f"{name}: {self.model_class.name} has a {what} of each of {', '.join(known)}; "
                f"say whose is meant: {known[0]}.{what}"
            )
        return known[0]

    def _unknown(self, name: str) -> SocialmindError:
        parameters = list(self.model_class.parameters)
        alone = len(self.schemes) == 1 and name.partition(".")[0] not in self.schemes
        words = [
            text if alone else f"{owner}.{text}"
            for owner, scheme in self.schemes.items()
            for text in words_of(scheme)
        ]
        wholes = [*([SCHEME] if self.schemes else []), *([MIND] if self.minded else [])]
        hint = nearest(name, [*parameters, *wholes, *words])
        there = f"there is {', '.join([*parameters, *wholes])}"
        if words:
            there += ", and words of a scheme such as influence.COGNITON.PLAN"
        what = f"{self.model_class.name} has nothing called {name!r} that could vary"
        return SocialmindError(f"{what}; {hint or there}")
