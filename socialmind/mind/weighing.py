"""A hierarchy of skills that weighs the plans of a cogniton mind, in place of its influence links.

Such an agent has cognitons, which its rules set, groups, feed-back and a decision maker as ever,
and plans are available by the same conditional links. But how much each plan weighs is what its
hierarchy commands: its sensors read cognitons, its actuators are called as the plans. So a learned
mind decides where a scheme did, and a scheme can be read off it again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import ModelError, nearest
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.modules import Skill

if TYPE_CHECKING:
    from socialmind.mind.description import MindDescription


@dataclass(frozen=True)
class Weighing:
    """How a hierarchy reads cognitons, and what its commands weigh.

    At each decision a sensor that is called as a cogniton reads 0.5 + value / (2 · reach), held to
    0 … 1, and 0.5 for an inactive one; the hierarchy is evaluated once; and an available plan
    weighs (2c − 1) · `reach`, c being the command of the actuator of its name. The scheme's
    decision maker chooses by these weights.

    Attributes:
        cognitons: the reach of each cogniton that a sensor may read: the value for which it reads
            1; its negative reads 0. Sensors of other names are left to rules.
        reach: the weight of a plan whose command is 1.

    Raises:
        ModelError: a reach that is no number above 0.

    >>> Weighing({"WheatNeed": 800.0}, reach=1000.0).reach
    1000.0
    """

    cognitons: Mapping[str, float] = field(default_factory=dict)
    reach: float = 1.0

    def __post_init__(self) -> None:
        for name, reach in {**self.cognitons, "the plans": self.reach}.items():
            if not is_number(reach) or not reach > 0:
                raise ModelError(f"the reach {shown(reach)} of {name}", "a number above 0")

    def places(self, scheme: CognitiveScheme, mind: MindDescription) -> WeighingPlaces:
        """Return where cognitons are read and plans weighed in a hierarchy.

        Raises:
            ModelError: a reach for what is no cogniton, or a plan without an actuator.
        """
        known = [one.name for one in scheme.cognitons]
        for name in self.cognitons:
            if name not in known:
                raise ModelError(
                    f"a reach for {name!r}, which is no cogniton of the scheme {scheme.name!r}",
                    f"one of {', '.join(known)}",
                    nearest(name, known),
                )
        sensors, actuators = list(mind.sensors), list(mind.actuators)
        for plan in scheme.plans:
            if plan not in actuators:
                raise ModelError(
                    f"the mind {mind.name!r} without an actuator for the plan {plan!r}",
                    "an actuator called as each plan, which it weighs",
                    nearest(plan, actuators) if actuators else None,
                )
        read = [name if name in self.cognitons and name in sensors else None for name in known]
        return WeighingPlaces(
            np.array([-1 if name is None else sensors.index(name) for name in read], np.int64),
            np.array([1.0 if name is None else self.cognitons[name] for name in read]),
            np.array([actuators.index(plan) for plan in scheme.plans], np.int64),
            np.array([self.reach]),
        )


@dataclass(frozen=True, eq=False)
class WeighingPlaces:
    """Where a hierarchy reads cognitons and weighs plans, by position in the scheme.

    Attributes:
        weighing_sensor: the sensor of each cogniton, -1 for none.
        weighing_reach: the reach of each cogniton.
        weighing_actuator: the actuator of each plan.
        weighing_plans: (1,) the reach of the plans.
    """

    weighing_sensor: NDArray[np.int64]
    weighing_reach: NDArray[np.float64]
    weighing_actuator: NDArray[np.int64]
    weighing_plans: NDArray[np.float64]


def linear_skill(scheme: CognitiveScheme, weighing: Weighing, name: str = "Weigh") -> Skill:
    """Return a skill that weighs plans as a scheme's influence links do, as far as they reach.

    It is a perceptron without hidden layers. Within the reaches of cognitons and plans it is the
    same function, which a lesson may begin from.

    Args:
        scheme: whose links it has; those of groups do not count.
        weighing: how it reads cognitons and weighs plans.
        name: of the skill.

    Raises:
        ModelError: a cogniton with links, but without a reach.

    >>> from coglogo_py import Cogniton
    >>> scheme = CognitiveScheme("cows", (Cogniton("Hunger", influence={"eat": 2.0}),))
    >>> linear_skill(scheme, Weighing({"Hunger": 10.0}, reach=40.0)).genome.tolist()
    [0.5, 0.25]
    """
    read = [one for one in scheme.cognitons if one.name in weighing.cognitons]
    for one in scheme.cognitons:
        if one.influence and one.name not in weighing.cognitons:
            raise ModelError(f"the cogniton {one.name!r}, which influences plans", "a reach for it")
    genome: list[float] = []
    for plan in scheme.plans:
        parts = [
            weighing.cognitons[one.name] * one.influence.get(plan, 0.0) / weighing.reach
            for one in read
        ]
        genome += [*parts, 0.5 - sum(parts) / 2]
    return Skill(
        name,
        [f"SE:{one.name}" for one in read],
        [f"MO:{plan}" for plan in scheme.plans],
        Perceptron(layers=0),
        genome,
    )
