"""A shock: a function of the user's that changes a society between two ticks."""

from __future__ import annotations

import inspect
import sys
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from coglogo_py.border.numbers import whole_number
from coglogo_py.border.places import place as place_called
from socialmind.agents.events import TICK
from socialmind.catalogue import load_file, load_model
from socialmind.errors import ModelError, SocialmindError, nearest, written_at
from socialmind.model import Model
from socialmind.society.copying import own_of
from socialmind.sources.folders import MODEL_FILE
from socialmind.sources.loading import failure_in_model
from socialmind.sources.modules import note_module
from socialmind.streams import SHOCK_TAG, SHOCK_TAGS, Stream

Society = TypeVar("Society", bound=Model)
STREAM = "rng"
"""The parameter by which a function asks for draws of its own."""


@dataclass(frozen=True)
class Shock:
    """A function that changes a society at a tick.

    It is called when the society leaves the tick: what is recorded of the tick shows the society
    before. Everything may be changed that can be set from outside (docs/data.md). A second
    parameter called `rng` gets a random stream, keyed by the seed, the tick and the function's
    name, so that the draws of all others stay as they are.

    Args:
        tick: 0 or more.
        function: takes the society, and `rng` if it likes.

    Raises:
        SocialmindError: no tick, or not such a function.

    >>> def drought(society):
    ...     society.world.soil = 0.0
    >>> Shock(100, drought).name
    'drought'
    """

    tick: int
    function: Callable[..., None]

    def __post_init__(self) -> None:
        tick = whole_number(self.tick, "the tick of a shock", 0, error=SocialmindError)
        object.__setattr__(self, "tick", tick)
        self._draws  # noqa: B018  # refuses what takes no society
        note_module(getattr(self.function, "__module__", ""))

    @classmethod
    def parsed(cls, text: str) -> Shock:
        """Return a shock from a text such as ``5000:plague.py:strike``.

        Raises:
            SocialmindError: it is none, or there is no such file or function.
        """
        tick, colon, place = text.partition(":")
        if not colon or not tick.strip().isdecimal():
            raise SocialmindError(f"shock {text!r}; expected TICK:FILE.py:FUNCTION")
        return cls(int(tick), function_in(place))

    @property
    def name(self) -> str:
        """The function's name."""
        return str(getattr(self.function, "__name__", type(self.function).__name__))

    @property
    def file(self) -> Path | None:
        """The file at whose top level the function stands; None for one that no file can give."""
        module = sys.modules.get(getattr(self.function, "__module__", None) or "")
        file = getattr(module, "__file__", None)
        if file is None or vars(module).get(self.name) is not self.function:
            return None
        return Path(file).resolve() if Path(file).is_file() else None

    @property
    def _draws(self) -> bool:
        """Whether the function asks for a stream."""
        file, line = written_at(self.function)
        try:
            takes = list(inspect.signature(self.function).parameters.values())
        except (TypeError, ValueError):
            takes = []
        needed = [one for one in takes if one.default is one.empty and one.name != STREAM]
        if len(needed) != 1 or needed[0].kind not in (
            inspect.Parameter.POSITIONAL_ONLY,
            inspect.Parameter.POSITIONAL_OR_KEYWORD,
        ):
            names = ", ".join(one.name for one in takes) or "nothing"
            raise ModelError(
                f"the shock {self.name}, which takes {names}",
                "a function of the society, and of rng if it likes",
                f"write def {self.name}(society): or def {self.name}(society, rng):",
                file,
                line,
            )
        return any(one.name == STREAM for one in takes)

    def applied(self, society: Society) -> Society:
        """Change a society; returns it.

        Raises:
            SocialmindError: the function failed, with its file and line; the society is as before.
        """
        before, own, events = society.state(), own_of(society, Model), society.event_log.count
        try:
            try:
                self._call(society)
            except SocialmindError as error:
                raise SocialmindError(f"{self._place(error)}: {error}") from error
            except Exception as error:
                raise self._failure(error) from error
            self._refuse_ticks_and_attributes(society, own)
        except BaseException:
            for name in set(own_of(society, Model)) - set(own):
                del vars(society)[name]
            vars(society).update(own)
            society.restore(before)
            society.event_log.forget_behind(events)
            raise
        # What the tables of this tick show is the society before.
        noted = society.event_log.rows[events + 1 : society.event_log.count + 1]
        noted[:, TICK] += 1
        # What follows from the state is found anew, as when a run goes on from a checkpoint.
        society.restore(society.state())
        return society

    def _call(self, society: Model) -> None:
        if not self._draws:
            self.function(society)
            return
        stream = Stream(society.seed)
        place = zlib.crc32(self.name.encode()) % SHOCK_TAGS
        stream.begin(SHOCK_TAG + place, 0, society.tick)
        self.function(society, rng=stream)

    def _refuse_ticks_and_attributes(self, society: Model, own: dict[str, Any]) -> None:
        file, line = written_at(self.function)
        if society.tick != self.tick:
            raise ModelError(
                f"the shock {self.name}, which moved the society from tick {self.tick} to "
                f"{society.tick}",
                "a change between two ticks",
                "let it change things, and no time pass",
                file,
                line,
            )
        now = own_of(society, Model)
        other = next((n for n in now if n not in own or now[n] is not own[n]), None)
        if other is not None:
            raise ModelError(
                f"the shock {self.name}, which sets {other!r}",
                "what a checkpoint holds",
                f"declare a variable of the model ({other.lstrip('_')}: float = 0.0)",
                file,
                line,
            )

    def _failure(self, error: Exception) -> ModelError:
        file, _ = written_at(self.function)
        return failure_in_model(error, Path(file or "shock"), self._what)

    @property
    def _what(self) -> str:
        return f"the shock {self.name} at tick {self.tick}"

    def _place(self, error: Exception) -> str:
        """Return where in the function's file what was refused stands."""
        failure = self._failure(error)
        return f"{place_called(failure.file, failure.line)}: {self._what}"


def function_in(text: str) -> Callable[..., None]:
    """Return the function that a text such as ``plague.py:strike`` names.

    The file is remembered as run by this user (`socialmind.sources.trust`).

    Raises:
        SocialmindError: there is no such file or function.
    """
    place, colon, name = text.rpartition(":")
    path = Path(place).expanduser()
    if not colon or path.suffix != ".py" or not name.isidentifier():
        raise SocialmindError(f"{text!r}; expected FILE.py:FUNCTION")
    if not path.is_file():
        raise SocialmindError(f"{path}: no such file; expected FILE.py:FUNCTION")
    return loaded(path, name)


def loaded(path: Path, name: str, modules: Path | None = None) -> Callable[..., None]:
    """Return a function that stands at the top level of a file.

    Args:
        path: the file.
        name: the function's.
        modules: a folder of modules that it may import; by default its own, as when Python runs it.

    Raises:
        ModelError: the file cannot be run, or has no such function.
    """
    path = path.resolve()
    if path.name == MODEL_FILE:
        load_model(path)
        module = load_file(path)
    else:
        module = load_file(path, alone=True, modules=modules or path.parent)
    found = getattr(module, name, None)
    if not callable(found):
        known = [one for one, value in vars(module).items() if inspect.isfunction(value)]
        raise ModelError(f"no function called {name!r}", None, nearest(name, known), path)
    return found
