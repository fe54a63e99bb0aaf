"""Programmed functions: a plain Python function as a skill's internal function."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from socialmind.errors import ModelError
from socialmind.mind.functions.contract import InternalFunction

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill

INPUTS = "inputs"
"""The name of a parameter that takes all inputs as one array."""


@dataclass(frozen=True)
class Programmed(InternalFunction):
    """A plain Python function (EvoAgents' `hardCoded`).

    Attributes:
        function: takes one number for each input of the skill, in order, or a single parameter
            called `inputs`, an array of them; returns a number for each output, which are held to
            [0, 1]. For thousands of agents it is compiled like the rules of a model, so it keeps to
            the same subset of Python (docs/rules.md).
        written: the value of `class:` in the `.ades` file, empty for the function's name.

    >>> def turn_left():
    ...     return 0.0, 1.0
    >>> Programmed(turn_left)
    the function turn_left
    """

    function: Callable[..., Any]
    written: str = ""
    keyword: ClassVar[str] = "hardCoded"

    def __post_init__(self) -> None:
        try:
            kinds = [one.kind for one in inspect.signature(self.function).parameters.values()]
        except (TypeError, ValueError):
            raise ModelError(
                f"{self.function!r} as a programmed function", "a plain function"
            ) from None
        if inspect.Parameter.KEYWORD_ONLY in kinds:
            raise ModelError(
                f"the function {self.name}(), whose inputs must be named",
                "plain parameters, in the order of the skill's inputs",
            )

    @property
    def takes_array(self) -> bool:
        """Whether the function takes its inputs as one array."""
        return self.parameters == (INPUTS,)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the function's parameters."""
        return tuple(inspect.signature(self.function).parameters)

    def check(self, skill: Skill) -> None:
        """Refuse a function with another number of parameters than the skill has inputs.

        Raises:
            ModelError: so it is.
        """
        names = self.parameters
        if not self.takes_array and len(names) != len(skill.inputs):
            raise skill.refused(
                f"whose function {self.name}() takes {len(names)} values",
                f"{len(skill.inputs)}, one for each input, or one parameter called {INPUTS!r}",
            )

    @property
    def name(self) -> str:
        """The function's name."""
        return str(getattr(self.function, "__name__", self.function))

    def __repr__(self) -> str:
        return f"the function {self.name}"
