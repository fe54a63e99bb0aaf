"""Links: what a skill reads, and where its outputs go."""

from __future__ import annotations

from dataclasses import dataclass, field

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError
from socialmind.mind.names import check_name

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

MOST_TICKS = 100_000
"""The longest history that an input may ask for, in ticks: so many values are kept for each
agent."""


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
        if not is_whole(self.ticks):
            raise ModelError(f"{shown(self.ticks)} ticks back", "a whole number", line=self.line)
        object.__setattr__(self, "ticks", int(self.ticks))
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
