"""Cogniton schemes as internal functions: a programmed mind decides which skill has influence.

The scheme's plans are the skill's outputs and its cognitons read the skill's inputs, so the two
kinds of mind nest: a society's scheme can be the master of learned skills.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from coglogo_py import CognitiveScheme
from coglogo_py.decision import BUILT_IN
from socialmind.errors import ModelError, nearest
from socialmind.mind.functions.contract import InternalFunction

if TYPE_CHECKING:
    from socialmind.mind.modules import Skill


@dataclass(frozen=True)
class CognitonScheme(InternalFunction):
    """A cognitive scheme of CogLogo: each tick it takes one decision; that plan's output is 1.0.

    Every tick the cognitons take the values of the skill's inputs, then the decision maker chooses
    among the plans (equations 3.1 and 3.2). The chosen plan's output is 1, all others 0; all are 0
    when no plan is available. Inactive cognitons stay inactive. Between ticks the mind keeps its
    cognitons, and may be fed back to through `Hierarchy.skill(...).mind`.

    Attributes:
        scheme: the scheme; each of its plans is called as one of the skill's outputs.
        cognitons: the cogniton that each input writes, by the input's text (`"SE:S1"`); an input
            that is left out writes the cogniton of its sensor's or variable's name.
        source: the scheme's file, as the skill's file names it.
    """

    scheme: CognitiveScheme
    cognitons: Mapping[str, str] = field(default_factory=dict)
    source: str = ""
    keyword: ClassVar[str] = "cognitonScheme"

    def cognitons_of(self, skill: Skill) -> tuple[str, ...]:
        """Return the name of the cogniton that each input of a skill writes."""
        return tuple(self.cognitons.get(str(one), one.name) for one in skill.inputs)

    def check(self, skill: Skill) -> None:
        """Refuse a skill whose inputs are no cognitons, or whose outputs are not the plans.

        Raises:
            ModelError: so it is.
        """
        known = [one.name for one in self.scheme.cognitons]
        read = [str(one) for one in skill.inputs]
        for text in self.cognitons:
            if text not in read:
                raise skill.refused(f"with a cogniton for {text}", "one of its inputs")
        seen: set[str] = set()
        for one, cogniton in zip(skill.inputs, self.cognitons_of(skill), strict=True):
            if cogniton not in known:
                raise skill.refused(
                    f"whose input {one} has no cogniton {cogniton!r} in the scheme "
                    f"{self.scheme.name!r}",
                    f"one of {', '.join(known)}" if known else "a cogniton",
                    nearest(cogniton, known) if known else None,
                    one.line,
                )
            if cogniton in seen:
                raise skill.refused(
                    f"with two inputs for the cogniton {cogniton!r}", "one", line=one.line
                )
            seen.add(cogniton)
        plans, outputs = set(self.scheme.plans), {one.name for one in skill.outputs}
        for plan in self.scheme.plans:
            if plan not in outputs:
                raise skill.refused(
                    f"without an output for the plan {plan!r} of {self.scheme.name!r}",
                    "an output called as each plan",
                    nearest(plan, sorted(outputs)),
                )
        for output in skill.outputs:
            if output.name not in plans:
                raise skill.refused(
                    f"with the output {output}, which is no plan of {self.scheme.name!r}",
                    "outputs called as the scheme's plans",
                    nearest(output.name, self.scheme.plans),
                    output.line,
                )
        for held in self.scheme.cognitons:
            if held.conditions or held.chance < 1.0 or held.inherited < 1.0:
                raise ModelError(
                    f"the cogniton {held.name!r} of {self.scheme.name!r} in the skill "
                    f"{skill.name!r}, with {'conditions' if held.conditions else 'chances'}",
                    "none: a skill's scheme reads inputs, and has no fields and no births",
                    "write an input for the cogniton",
                    skill.file,
                    skill.line,
                )
        if type(self.scheme.decision_maker) not in BUILT_IN:
            raise ModelError(
                f"the decision maker {type(self.scheme.decision_maker).__name__} of "
                f"{self.scheme.name!r} in the skill {skill.name!r}",
                f"one of {', '.join(one.__name__ for one in BUILT_IN)}",
                file=skill.file,
                line=skill.line,
            )

    def __repr__(self) -> str:
        return f"the cogniton scheme {self.scheme.name!r}"
