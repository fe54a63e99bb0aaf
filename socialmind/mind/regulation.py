"""Regulations: what a variable makes of the commands it receives (thesis, section 4.3).

Each tick a variable first takes the normalised command of the last cycle (equation 4.3); where no
skill influenced it, its last command stays. Then the regulation gives its value.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError, written_at

if TYPE_CHECKING:  # a circle for types alone: a variable has a regulation, which checks it
    from socialmind.mind.modules import Variable

SIMPLE, WAVE, COUNTER, REGULATED = range(4)
"""The regulations' numbers in compiled code."""
PARAMETERS = 3
"""How many numbers a regulation may hand to compiled code."""

TAKEN = ("command", "value", "memory", "commanded")
"""What a modeller's regulation may ask for, by the names of its parameters."""


@dataclass(frozen=True)
class Regulation:
    """The base of all regulations.

    Attributes:
        code: its number in compiled code.
        keyword: its name in a `.vardesc` file (thesis, A.2).
        start: the variable's value at the start unless a default is given.
    """

    code: ClassVar[int]
    keyword: ClassVar[str]
    start: ClassVar[float] = 0.0

    @property
    def parameters(self) -> tuple[float, ...]:
        """The numbers that compiled code needs, up to `PARAMETERS`."""
        return ()

    def memory(self, start: float) -> float:
        """Return what the regulation remembers at the start beside the variable's value."""
        return 0.0

    def check_default(self, variable: Variable) -> None:
        """Refuse a default that the regulation cannot start from.

        Raises:
            ModelError: so it is.
        """


@dataclass(frozen=True)
class Simple(Regulation):
    """The simple variable: its value is the last command (thesis, figure 4.6)."""

    code: ClassVar[int] = SIMPLE
    keyword: ClassVar[str] = "VariableModule"


@dataclass(frozen=True)
class Wave(Regulation):
    """The wave generator: 0.5 + sin(φ) / 2, φ growing with every tick (thesis, figure 4.8).

    A command c lets φ grow by 0.001 + 2.999 c a tick; while it was never commanded, φ grows by 1,
    so that its value at the n-th tick is that of sin(n). φ begins at 0; a default is what the
    variable shows before its first evaluation.
    """

    code: ClassVar[int] = WAVE
    keyword: ClassVar[str] = "TickWaveSinVariableModule"
    start: ClassVar[float] = 0.5


@dataclass(frozen=True)
class Counter(Regulation):
    """The counter: counts the rising edges of its command (thesis, figure 4.7).

    A command that rises above `increment` adds one to the count, one that falls below `reset` sets
    it to zero, and so does the count after `maximum`. The value is the count over `maximum`.

    Attributes:
        maximum: the largest count, 1 or more.
        increment: the threshold of counting, 0 … 1.
        reset: the threshold of resetting, 0 … `increment`.
    """

    maximum: int = 10
    increment: float = 0.8
    reset: float = 0.2
    code: ClassVar[int] = COUNTER
    keyword: ClassVar[str] = "CounterVariableModule"

    def __post_init__(self) -> None:
        if not is_whole(self.maximum) or self.maximum < 1:
            raise ModelError(f"a counter up to {shown(self.maximum)}", "a whole number, 1 or more")
        if not 0 <= self.reset <= self.increment <= 1:
            raise ModelError(
                f"a counter that counts above {self.increment} and resets below {self.reset}",
                "0 <= reset <= increment <= 1",
            )

    @property
    def parameters(self) -> tuple[float, ...]:
        """Its maximum and its thresholds."""
        return float(self.maximum), float(self.increment), float(self.reset)

    def memory(self, start: float) -> float:
        """Return the count at the start."""
        return float(round(start * self.maximum))

    def check_default(self, variable: Variable) -> None:
        """Refuse a default between two counts."""
        count = float(variable.default or 0.0) * self.maximum
        if abs(count - round(count)) > 1e-9:
            raise ModelError(
                f"{variable.default} as the default of the counter {variable.name!r}",
                f"a count over its maximum: 0, {1 / self.maximum:g} … 1",
                file=variable.file,
                line=variable.line,
            )


@dataclass(frozen=True)
class Regulated(Regulation):
    """A regulation of the modeller's own: a plain function that returns the variable's value.

    Attributes:
        function: takes any of `command` (the last command it received, 0 … 1), `value` (the
            variable's value), `commanded` (whether a command came in the last cycle) and
            `memory` (a number of its own, 0 at the start); returns the value, or the value and
            the memory. Values are held to [0, 1]. It is called every tick.

    >>> def leak(command, value):
    ...     return value + 0.1 * (command - value)
    >>> Regulated(leak).takes
    ('command', 'value')
    """

    function: Callable[..., Any]
    code: ClassVar[int] = REGULATED
    keyword: ClassVar[str] = "RegulatedVariableModule"

    def __post_init__(self) -> None:
        try:
            wrong = [name for name in self.takes if name not in TAKEN]
        except (TypeError, ValueError):
            raise ModelError(f"{self.function!r} as a regulation", "a plain function") from None
        if wrong:
            raise ModelError(
                f"the parameter {wrong[0]!r} of the regulation {self.function.__name__!r}",
                f"any of {', '.join(TAKEN)}",
                None,
                *written_at(self.function),
            )

    @property
    def takes(self) -> tuple[str, ...]:
        """The names of its function's parameters."""
        return tuple(inspect.signature(self.function).parameters)


REGULATIONS: dict[str, type[Regulation]] = {
    one.keyword: one for one in (Simple, Wave, Counter, Regulated)
}
"""The regulations by their keyword in a `.vardesc` file."""
