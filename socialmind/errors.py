"""What socialmind raises when something the user gave it is wrong."""

from __future__ import annotations

import dataclasses
import inspect
import traceback
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from coglogo_py.border.errors import PlacedError, one_line
from coglogo_py.border.errors import nearest as close
from coglogo_py.border.places import place as place_called


class SocialmindError(Exception):
    """Anything the user can put right: a file, a name, a value, a folder.

    The command line prints its message on one line and ends with exit code 2.
    """

    def __init__(self, message: str = "") -> None:
        super().__init__(one_line(message))


def is_ours(file: str) -> bool:
    """Return whether code stands in the library: not in a model, the shipped ones included."""
    path, library = Path(file), Path(__file__).parent
    if file in ("<string>", dataclasses.__file__):
        return True  # what Python writes for a dataclass
    inside = library in path.parents and library / "_models" not in path.parents
    return inside or "coglogo_py" in path.parts


def called_at() -> tuple[str | None, int | None]:
    """Return the file and line of the modeller's that called the library, if any."""
    frame = inspect.currentframe()
    while frame is not None and is_ours(frame.f_code.co_filename):
        frame = frame.f_back
    return (None, None) if frame is None else (frame.f_code.co_filename, frame.f_lineno)


def written_at(function: object) -> tuple[str | None, int | None]:
    """Return the file and line of a function, as far as it is a plain one."""
    code = getattr(function, "__code__", None)
    return (None, None) if code is None else (code.co_filename, code.co_firstlineno)


def place_of(error: Exception, place: str = "in a rule") -> str:
    """Return the last line of the author's that an error went through, or else `place`."""
    for frame in traceback.extract_tb(error.__traceback__):
        if frame.filename == "<string>" or not is_ours(frame.filename):
            place = place_called(frame.filename, frame.lineno)
    return place


def nearest(name: str, known: Iterable[str]) -> str:
    """Return a hint at the known name that a misspelt one resembles, or what there is.

    >>> nearest("tool_prise", ["tool_price", "food_decay"])
    "did you mean 'tool_price'?"
    >>> nearest("zzz", ["tool_price", "food_decay"])
    'there is tool_price, food_decay'
    """
    names = list(known)
    return close(name, names) or ("there is " + ", ".join(names) if names else "there is none")


class IdleWarning(UserWarning):
    """An agent's decision found no plan available; the agent does nothing until the next."""


class UnknownNameError(SocialmindError, AttributeError):
    """A name that an agent, a population, a patch or a model does not have, or keeps to itself."""


class ValueRefusedError(SocialmindError, ValueError):
    """A value that a field cannot hold; nothing was written."""


class ModelError(PlacedError, SocialmindError):
    """Something in a model's own files is wrong; arguments as of `border.errors.PlacedError`.

    >>> print(ModelError("a dictionary", "a number", "use an array field", "model.py", 12))
    model.py:12: found a dictionary; expected a number; use an array field
    """


@contextmanager
def of_model_file(
    file: str | Path | None = None, line: int | None = None, remedy: str | None = None
) -> Iterator[None]:
    """Read a file of a model: what is wrong in it is a `ModelError` that says where and what to do.

    Args:
        file: of errors that name none.
        line: of these, unless they name it.
        remedy: what to do about errors that do not say it.

    Raises:
        ModelError: in place of the error of a scheme, or of a part of the file.
    """
    try:
        yield
    except PlacedError as error:
        place = (file, error.line or line) if error.file is None else (error.file, error.line)
        raise ModelError(error.found, error.expected, error.remedy or remedy, *place) from None


class RuleError(SocialmindError):
    """A rule failed while the model ran: says where, in which tick and for which agent.

    The error that the rule raised is its `__cause__`.

    Args:
        error: what the rule raised.
        place: file and line, as far as they are known.
        tick: the tick in which it failed.
        agent: the agent that acted, in words.
    """

    def __init__(self, error: str, place: str, tick: int, agent: str) -> None:
        self.error, self.place, self.tick, self.agent = error, place, tick, agent
        super().__init__(f"{place}: {error}; in tick {tick}, {agent}")

    def __reduce__(self) -> tuple[type[RuleError], tuple[object, ...]]:
        """Keep the fields when the error crosses a process boundary."""
        return type(self), (self.error, self.place, self.tick, self.agent)
