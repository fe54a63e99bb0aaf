"""Hierarchies that command a variable, and what it shows evaluation by evaluation.

The skills are programmed; a master gives them influence by what its sensors say. A row holds what
was so in one evaluation: the variable takes the commands of the evaluation before.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from socialmind.mind import Counter, Hierarchy, MindDescription, Programmed, Skill, Variable, Wave
from socialmind.mind.views.explanation import explanation_of

Row = dict[str, float]

COUNTER = Counter()
"""Up to 10; counts above 0.8, resets below 0.2."""


def give_both(first: float, second: float) -> tuple[float, float]:
    return first, second


def give(command: float) -> float:
    return command


def share_out(level: float) -> tuple[float, float]:
    return level, 1.0 - level


def give_all() -> float:
    return 1.0


def give_none() -> float:
    return 0.0


def two_skills() -> Hierarchy:
    """Two skills command a variable; the master's sensors say how much influence each has."""
    skills = [
        Skill(
            "Master", ["SE:InfluenceA", "SE:InfluenceB"], ["SK:A", "SK:B"], Programmed(give_both)
        ),
        Skill("A", ["SE:CommandA"], ["VA:Variable"], Programmed(give)),
        Skill("B", ["SE:CommandB"], ["VA:Variable"], Programmed(give)),
    ]
    sensors = ["CommandA", "CommandB", "InfluenceA", "InfluenceB"]
    return Hierarchy(MindDescription("two skills", sensors, (), ["Variable"], skills))


def with_input(variable: Variable) -> Hierarchy:
    """A skill gives 1.0 and another 0.0; by the master's influence the mean is the sensor Level."""
    skills = [
        Skill("Master", ["SE:Level"], ["SK:All", "SK:None"], Programmed(share_out)),
        Skill("All", (), ["VA:Variable"], Programmed(give_all)),
        Skill("None", (), ["VA:Variable"], Programmed(give_none)),
    ]
    return Hierarchy(MindDescription("with an input", ["Level"], (), [variable], skills))


def recorded(hierarchy: Hierarchy, signals: Mapping[str, Sequence[float]]) -> list[Row]:
    """Evaluate a hierarchy once for each value of its sensors' signals.

    Args:
        hierarchy: with one variable.
        signals: by sensor, as many values each.

    Returns:
        A row an evaluation: the command and influence of each skill that commands the variable,
        their normalised sum (equation 4.3; missing without influence), the variable's value.
    """
    rows = []
    for values in zip(*signals.values(), strict=True):
        hierarchy.evaluate(dict(zip(signals, map(float, values), strict=True)))
        (command,) = explanation_of(hierarchy).variables
        row: Row = {"evaluation": hierarchy.tick}
        row |= {f"command_{part.skill}": part.output for part in command.parts}
        row |= {f"influence_{part.skill}": part.weight for part in command.parts}
        row["input"] = np.nan if command.command is None else command.command
        row["value"] = hierarchy.variables()[command.name]
        rows.append(row)
    return rows


def held(*pieces: tuple[int, float, float]) -> np.ndarray:
    """Return a signal of straight pieces: of so many values each, from one level to another."""
    return np.concatenate([np.linspace(begin, end, count) for count, begin, end in pieces])


def simple_variable() -> list[Row]:
    """Figure 4.6: one skill alone, the influence passing to the other, both, and none."""
    signals = {
        "CommandA": held(
            (20, 0.8, 0.8), (20, 0.8, 0.3), (20, 0.3, 0.3), (20, 0.1, 0.5), (20, 0.5, 0.0)
        ),
        "CommandB": held((40, 0.1, 0.1), (40, 0.9, 0.9), (20, 0.9, 0.2)),
        "InfluenceA": held((40, 1, 1), (20, 1, 0), (20, 0.5, 0.5), (20, 0, 0)),
        "InfluenceB": held((40, 0, 0), (20, 0, 1), (20, 0.5, 0.5), (20, 0, 0)),
    }  # fmt: skip
    return recorded(two_skills(), signals)


def counter() -> list[Row]:
    """Figure 4.7: two rising edges and a falling one, then a slope that counts but once."""
    level = held(
        (8, 0.5, 0.5), (10, 0.95, 0.95), (10, 0.5, 0.5), (10, 0.9, 0.9), (10, 0.4, 0.4),
        (10, 0.1, 0.1), (16, 0.1, 1.0), (10, 0.6, 0.6), (8, 0.9, 0.9), (8, 0.6, 0.6),
        (8, 0.9, 0.9), (12, 0.9, 0.0),
    )  # fmt: skip
    return recorded(with_input(Variable("Variable", COUNTER)), {"Level": level})


def wave_generator() -> list[Row]:
    """Figure 4.8: a long wave, one that shortens, a short one, and 0, which nearly stops it."""
    level = held((70, 0.04, 0.04), (70, 0.04, 0.2), (40, 0.2, 0.2), (20, 0.0, 0.0))
    return recorded(with_input(Variable("Variable", Wave())), {"Level": level})
