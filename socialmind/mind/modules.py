"""The modules of a mind: sensors, actuators, variables and skills, and what links them.

They are descriptions, without values; `description.MindDescription` holds all of one mind together
and `hierarchy.Hierarchy` runs it. Inputs and outputs are written as in the files of EvoAgents
(thesis, A.3): `"SE:S1"`, `"SH:S1:5"`, `"MO:MotL"`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.mind.regulation import Regulation, Simple

if TYPE_CHECKING:
    from socialmind.mind.functions.contract import InternalFunction

VALUE, DERIVATIVE, HISTORY = "value", "derivative", "history"

INPUT_CODES = {
    "SE": ("sensor", VALUE),
    "SD": ("sensor", DERIVATIVE),
    "SH": ("sensor", HISTORY),
    "VA": ("variable", VALUE),
    "VD": ("variable", DERIVATIVE),
    "VH": ("variable", HISTORY),
}
"""What a skill's input reads, by its code in a file (thesis, A.3.1)."""
OUTPUT_CODES = {"MO": "actuator", "SK": "skill", "VA": "variable"}
"""What a skill's output goes to, by its code in a file (thesis, A.3.1)."""

_NAME = re.compile(r"[^\s:#/\\]([^:#/\\\n\r]*[^\s:#/\\])?")
_UNWRITABLE = ("Cc", "Cs", "Zl", "Zp")
"""Unicode's control characters, halves of surrogate pairs, and separators of lines, which files
cannot hold inside a name."""
_BYTE_ORDER_MARK = "\ufeff"

MOST_TICKS = 100_000
"""The longest history that an input may ask for, in ticks: so many values are kept for each
agent."""


@dataclass(frozen=True)
class Sensor:
    """A sensor: gives skills its value, derivative and history, each in [0, 1].

    Attributes:
        name: its name.
        kind: what it is, as the `.botdesc` file says it (`proxSensor`).
        parameters: what else that line says.
        file, line: where it was read from.
    """

    name: str
    kind: str = ""
    parameters: tuple[str, ...] = ()
    file: str | None = field(default=None, compare=False, repr=False)
    line: int | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        check_name(self.name, "a sensor", self.file, self.line)


@dataclass(frozen=True)
class Actuator:
    """An actuator: receives a motor command in [0, 1] (thesis, equation 4.3).

    Attributes:
        name: its name.
        kind: what it is, as the `.botdesc` file says it (`propeller`).
        neutral: its command when no skill influences it, 0 … 1.
        parameters: what else its line says.
        file, line: where it was read from.
    """

    name: str
    kind: str = ""
    neutral: float = 0.5
    parameters: tuple[str, ...] = ()
    file: str | None = field(default=None, compare=False, repr=False)
    line: int | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        check_name(self.name, "an actuator", self.file, self.line)
        what = f"the neutral command of the actuator {self.name!r}"
        check_share(self.neutral, what, self.file, self.line)


@dataclass(frozen=True)
class Variable:
    """A variable: skills write it as they command actuators, and read it as a sensor.

    Attributes:
        name: its name.
        regulation: what it makes of the commands: `Simple`, `Wave`, `Counter` or `Regulated`.
        default: its value at the start, 0 … 1; None for the regulation's own.
        group: the group whose members share it, one value for each instance of the group
            (thesis, 9.2.2); None for a variable of the agent's own.
        file, line: where it was read from.
    """

    name: str
    regulation: Regulation = field(default_factory=Simple)
    default: float | None = None
    group: str | None = None
    file: str | None = field(default=None, compare=False, repr=False)
    line: int | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        check_name(self.name, "a variable", self.file, self.line)
        if self.group is not None:
            check_name(self.group, "a group", self.file, self.line)
        if self.default is not None:
            what = f"the default of the variable {self.name!r}"
            check_share(self.default, what, self.file, self.line)
            self.regulation.check_default(self)

    @property
    def start(self) -> float:
        """Its value at the start."""
        return self.regulation.start if self.default is None else float(self.default)


@dataclass(frozen=True)
class Input:
    """What a skill reads: `Input("SH", "S1", 5)` is the sensor S1 five ticks ago.

    Attributes:
        code: SE, SD, SH, VA, VD or VH: value, derivative or history of a sensor or variable.
        name: the name of the sensor or variable.
        ticks: for a history, how many ticks back, 1 or more; else 0.
        line: where it was read from.
    """

    code: str
    name: str
    ticks: int = 0
    line: int | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if self.code not in INPUT_CODES:
            expected = f"one of {', '.join(INPUT_CODES)}"
            raise ModelError(f"an input of the kind {self.code!r}", expected, line=self.line)
        check_name(self.name, f"a {INPUT_CODES[self.code][0]}", None, self.line)
        history = self.reading == HISTORY
        if isinstance(self.ticks, bool) or not isinstance(self.ticks, int):
            raise ModelError(f"{self.ticks!r} ticks back", "a whole number", line=self.line)
        if self.ticks > MOST_TICKS:
            raise ModelError(
                f"a history of more than {MOST_TICKS:,} ticks of {self.name!r}",
                f"1 … {MOST_TICKS:,}",
                "keep what is long past in a variable",
                line=self.line,
            )
        if history and self.ticks < 1:
            raise ModelError(
                f"the history {self.code}:{self.name} without a number of ticks",
                f"how far back, 1 or more, as in {self.code}:{self.name}:5",
                line=self.line,
            )
        if not history and self.ticks != 0:
            raise ModelError(
                f"{self.ticks} ticks back for {self.code}:{self.name}",
                "a history, SH or VH",
                line=self.line,
            )

    @classmethod
    def parse(cls, text: str, line: int | None = None) -> Input:
        """Return the input that a text writes.

        >>> Input.parse("SH: S1:5")
        Input(code='SH', name='S1', ticks=5)
        """
        parts = [part.strip() for part in text.split(":")]
        if len(parts) < 2 or len(parts) > 3:
            raise ModelError(
                f"the input {text.strip()!r}", "KIND:NAME, or KIND:NAME:TICKS", line=line
            )
        ticks = 0
        if len(parts) == 3:
            if not parts[2].isdecimal():
                raise ModelError(
                    f"{parts[2]!r} in the input {text.strip()!r}",
                    "a whole number of ticks",
                    line=line,
                )
            # Python turns no more than some thousand digits into a number.
            digits = parts[2].lstrip("0")
            ticks = int(digits or 0) if len(digits) < 10 else MOST_TICKS + 1
        return cls(parts[0], parts[1], ticks, line)

    @property
    def module(self) -> str:
        """What it reads: "sensor" or "variable"."""
        return INPUT_CODES[self.code][0]

    @property
    def reading(self) -> str:
        """How: "value", "derivative" or "history"."""
        return INPUT_CODES[self.code][1]

    def __str__(self) -> str:
        ticks = f":{self.ticks}" if self.ticks else ""
        return f"{self.code}:{self.name}{ticks}"


@dataclass(frozen=True)
class Output:
    """Where an output of a skill goes: `Output("SK", "Avoid")` influences the skill Avoid.

    Attributes:
        code: MO (an actuator), SK (a subskill) or VA (a variable).
        name: the name of that module.
        line: where it was read from.
    """

    code: str
    name: str
    line: int | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if self.code not in OUTPUT_CODES:
            expected = f"one of {', '.join(OUTPUT_CODES)}"
            raise ModelError(f"an output of the kind {self.code!r}", expected, line=self.line)
        check_name(self.name, f"a {self.module}", None, self.line)

    @classmethod
    def parse(cls, text: str, line: int | None = None) -> Output:
        """Return the output that a text writes.

        >>> Output.parse("SK: ClawControl")
        Output(code='SK', name='ClawControl')
        """
        parts = [part.strip() for part in text.split(":")]
        if len(parts) != 2:
            raise ModelError(f"the output {text.strip()!r}", "KIND:NAME", line=line)
        return cls(parts[0], parts[1], line)

    @property
    def module(self) -> str:
        """What it goes to: "actuator", "skill" or "variable"."""
        return OUTPUT_CODES[self.code]

    def __str__(self) -> str:
        return f"{self.code}:{self.name}"


@dataclass(frozen=True, eq=False)
class Skill:
    """A skill: an internal function from inputs to outputs (thesis, equation 4.1).

    A skill whose outputs go to actuators is a base skill; one that influences others is complex.

    Args:
        name: its name.
        inputs: what its function reads, in order; texts such as `"SE:S1"` or `Input`s.
        outputs: where the function's results go, in order; texts such as `"MO:MotL"` or `Output`s.
        function: its internal function.
        genome: the weights of the function, shape (genome size,); None where they are not set yet
            or the function has none.
        file, line: where it was read from.

    Raises:
        ModelError: a wrong name, input or output, or a genome of a wrong size.
    """

    name: str
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    function: InternalFunction
    genome: NDArray[np.float64] | None = None
    file: str | None = field(default=None, repr=False)
    line: int | None = field(default=None, repr=False)

    def __init__(
        self,
        name: str,
        inputs: Iterable[Input | str],
        outputs: Iterable[Output | str],
        function: InternalFunction,
        genome: Any = None,
        file: str | None = None,
        line: int | None = None,
    ) -> None:
        check_name(name, "a skill", file, line)
        read = tuple(one if isinstance(one, Input) else Input.parse(one) for one in inputs)
        written = tuple(one if isinstance(one, Output) else Output.parse(one) for one in outputs)
        fields = {
            "name": name, "inputs": read, "outputs": written, "function": function,
            "file": file, "line": line,
        }  # fmt: skip
        for key, value in fields.items():
            object.__setattr__(self, key, value)
        self._check_outputs()
        function.check(self)
        object.__setattr__(self, "genome", None if genome is None else self.fitting(genome))

    def _check_outputs(self) -> None:
        if not self.outputs:
            raise self.refused("without outputs", "one or more", "name what it commands")
        seen: set[tuple[str, str]] = set()
        for output in self.outputs:
            if (output.code, output.name) in seen:
                raise self.refused(
                    f"with the output {output} twice", "each output once", line=output.line
                )
            seen.add((output.code, output.name))

    @property
    def genome_size(self) -> int:
        """How many weights its function has; 0 for none."""
        return self.function.genome_size(len(self.inputs), len(self.outputs))

    def fitting(self, genome: Any) -> NDArray[np.float64]:
        """Return a genome as a read-only array, or refuse it.

        Raises:
            ModelError: its size is not the skill's, or a weight is not a finite number.
        """
        try:
            weights = np.array(genome, dtype=np.float64).reshape(-1)
        except (TypeError, ValueError):
            raise self.refused("with a genome that is no list of numbers", "numbers") from None
        if len(weights) != self.genome_size:
            raise self.refused(
                f"with a genome of {len(weights)} weights",
                f"{self.genome_size}, for {len(self.inputs)} inputs, {len(self.outputs)} outputs "
                f"and {self.function}",
            )
        bad = np.flatnonzero(~np.isfinite(weights))
        if len(bad):
            raise self.refused(
                f"with the weight {weights[bad[0]]} at place {bad[0]} of its genome",
                "finite numbers",
            )
        weights.setflags(write=False)
        return weights

    def refused(
        self, what: str, expected: str | None = None, remedy: str | None = None,
        line: int | None = None,
    ) -> ModelError:  # fmt: skip
        """Return the error that says what is wrong with the skill, and where it stands."""
        place = self.line if line is None else line
        return ModelError(f"the skill {self.name!r} {what}", expected, remedy, self.file, place)

    def changed(self, **fields: Any) -> Skill:
        """Return the skill with other fields; a genome that no longer fits must be given anew."""
        own: dict[str, Any] = {
            "name": self.name, "inputs": self.inputs, "outputs": self.outputs,
            "function": self.function, "genome": self.genome, "file": self.file,
            "line": self.line,
        }  # fmt: skip
        return Skill(**(own | fields))

    @property
    def subskills(self) -> tuple[str, ...]:
        """The names of the skills that it influences, in the order of its outputs."""
        return tuple(output.name for output in self.outputs if output.module == "skill")

    @property
    def is_complex(self) -> bool:
        """Whether it influences other skills."""
        return bool(self.subskills)

    def redirected(self, old: str, new: str) -> Skill:
        """Return the skill with the subskill `old` exchanged for `new`."""
        outputs = tuple(
            replace(one, name=new) if (one.module, one.name) == ("skill", old) else one
            for one in self.outputs
        )
        return self.changed(outputs=outputs)


def check_name(name: Any, what: str, file: str | None, line: int | None) -> None:
    """Refuse a name that files cannot hold.

    Raises:
        ModelError: it is empty, has a colon, a hash, a slash or blanks around it, or a control
            character.
    """
    if isinstance(name, str):
        for character in name:
            if unicodedata.category(character) in _UNWRITABLE or character == _BYTE_ORDER_MARK:
                raise ModelError(
                    f"the character U+{ord(character):04X} in {name!r}, the name of {what}",
                    "a name without control characters",
                    None,
                    file,
                    line,
                )
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ModelError(
            f"{name!r} as the name of {what}",
            "a name without ':', '#', '/' and without blanks around it",
            file=file,
            line=line,
        )


def check_share(value: Any, what: str, file: str | None, line: int | None) -> None:
    """Refuse what is no number in [0, 1].

    Raises:
        ModelError: so it is.
    """
    number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
    if not number or not 0 <= value <= 1:
        raise ModelError(f"{value!r} as {what}", "a number, 0 … 1", file=file, line=line)
