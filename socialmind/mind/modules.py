"""The modules of a mind: sensors, actuators, variables and skills, and what links them.

They are descriptions, without values; `description.MindDescription` holds all of one mind together
and `hierarchy.Hierarchy` runs it. Inputs and outputs are written as in the files of EvoAgents
(thesis, A.3): `"SE:S1"`, `"SH:S1:5"`, `"MO:MotL"`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.mind.links import Input, Output
from socialmind.mind.names import check_name, check_share
from socialmind.mind.regulation import Regulated, Regulation, Simple
from socialmind.names import several

if TYPE_CHECKING:
    from socialmind.mind.functions.contract import InternalFunction


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
            if isinstance(self.regulation, Regulated):
                raise ModelError(
                    f"the variable {self.name!r}, shared in {self.group!r} and with a regulation "
                    "of your own",
                    "a simple variable, a wave or a counter, or a variable of the agent's own",
                    None,
                    self.file,
                    self.line,
                )
        if self.default is not None:
            what = f"the default of the variable {self.name!r}"
            check_share(self.default, what, self.file, self.line)
            self.regulation.check_default(self)

    @property
    def start(self) -> float:
        """Its value at the start."""
        return self.regulation.start if self.default is None else float(self.default)


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
        file: the file that it was read from.
        line: the line there.

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
        read = tuple(
            one if isinstance(one, Input) else Input.parse(one) for one in several(inputs, "inputs")
        )
        written = tuple(
            one if isinstance(one, Output) else Output.parse(one)
            for one in several(outputs, "outputs")
        )
        fields = {
            "name": name, "inputs": read, "outputs": written, "function": function,
            "file": file, "line": line,
        }  # fmt: skip
        for key, value in fields.items():
            object.__setattr__(self, key, value)
        self._check_outputs()
        function.check(self)
        object.__setattr__(self, "genome", None if genome is None else self.fitting(genome))

    def __reduce__(self) -> tuple[Any, ...]:
        # Made anew, so that its genome is read-only again.
        fields = (self.name, self.inputs, self.outputs, self.function, self.genome)
        return Skill, (*fields, self.file, self.line)

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

    def without_genome(self) -> ModelError:
        """Return the error that its weights must be set before it is evaluated."""
        remedy = "set it, or call randomise(seed)"
        return self.refused("without a genome", f"{self.genome_size} weights", remedy)

    def refused(
        self, what: str, expected: str | None = None, remedy: str | None = None,
        line: int | None = None,
    ) -> ModelError:  # fmt: skip
        """Return the error that says what is wrong with the skill, and where it stands."""
        place = self.line if line is None else line
        return ModelError(f"the skill {self.name!r} {what}", expected, remedy, self.file, place)

    def changed(self, **fields: Any) -> Skill:
        """Return the skill with other fields; a genome that no longer fits must be given anew."""
        return replace(self, **fields)

    @property
    def subskills(self) -> tuple[str, ...]:
        """The names of the skills that it influences, in the order of its outputs."""
        return tuple(output.name for output in self.outputs if output.module == "skill")

    @property
    def links(self) -> tuple[Input | Output, ...]:
        """What it reads, then where its outputs go."""
        return (*self.inputs, *self.outputs)

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


class Modules(Protocol):
    """What a file takes of a mind; `MindDescription` has it."""

    name: str
    sensors: Mapping[str, Sensor]
    actuators: Mapping[str, Actuator]
    variables: Mapping[str, Variable]
    skills: Mapping[str, Skill]


AMind = TypeVar("AMind", bound=Modules)
