"""The robot of section 6.1.3, which collects objects by four constant base skills.

The thesis's complex skills are trained networks. Here they are programs that give what the text
says of each step, where it gives a number or a direction: 1.0 and 0.11 in step 1, 1.0 throughout
in step 2, 0.16 and 1.0 in step 3, less for moveForward and turnRight in step 4, and in step 5
avoiding at a distance that is none to GoToObject+Avoid.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from socialmind.mind import Hierarchy, MindDescription, Programmed, Skill

SENSORS = ("CARRY", "OBJECT", "ZONE", "FRONT", "RIGHT")
"""Whether it carries an object; the directions of object and zone, 0 left, 0.5 ahead, 1 right;
how close an obstacle is in front and at the right, 0 far, 1 touching."""
PRIMITIVES = ("SK:moveForward", "SK:moveBackwards", "SK:turnLeft", "SK:turnRight")


@dataclass(frozen=True)
class Step:
    """A moment of figure 6.6: what happens, and what the sensors say."""

    title: str
    sensors: Mapping[str, float]


def _sensed(*values: float) -> dict[str, float]:
    return dict(zip(SENSORS, values, strict=True))


STEPS = (
    Step("Approaching the object", _sensed(0.0, 0.5, 0.25, 0.3, 0.1)),
    Step("Too close to the obstacle", _sensed(0.0, 0.8, 0.25, 0.8, 0.5)),
    Step("Some distance recovered", _sensed(0.0, 1.0, 0.25, 0.4, 0.72)),
    Step("The front is clear", _sensed(0.0, 0.95, 0.25, 0.0, 0.72)),
    Step("The object is picked up", _sensed(1.0, 0.5, 0.25, 0.0, 0.2)),
)


def collect(carry: float) -> tuple[float, float]:
    return 1.0 - carry, carry


def object_and_avoid(front: float, right: float) -> tuple[float, float]:
    risk = min(1.0, max(0.0, 2.0 * (max(front, right) - 0.3)))
    return 1.0 - risk, risk


def zone_and_avoid(front: float, right: float) -> tuple[float, float]:
    # An object that sticks out in front is a risk from further away.
    risk = min(1.0, 2.0 * max(front, right))
    return 1.0 - risk, risk


def go_to_object(direction: float) -> tuple[float, float, float, float]:
    turn = 2.0 * (direction - 0.5)
    return max(0.0, 0.11 - abs(turn)), 0.0, max(0.0, -turn), max(0.0, turn)


def go_to_zone(direction: float) -> tuple[float, float, float, float]:
    turn = 2.0 * (direction - 0.5)
    return 1.0 - abs(turn), 0.0, max(0.0, -turn), max(0.0, turn)


def avoid(front: float) -> tuple[float, float, float, float]:
    return min(1.0, 0.2 + 2.0 * front), 0.0, min(1.0, max(0.0, 4.0 * (front - 0.5))), 0.0


def move_forward() -> tuple[float, float]:
    return 1.0, 1.0


def move_backwards() -> tuple[float, float]:
    return 0.0, 0.0


def turn_left() -> tuple[float, float]:
    return 0.0, 1.0


def turn_right() -> tuple[float, float]:
    return 1.0, 0.0


def robot() -> Hierarchy:
    """The hierarchy of figure 6.6, before its first evaluation."""
    distances = ["SE:FRONT", "SE:RIGHT"]
    motors = ["MO:MotL", "MO:MotR"]
    skills = [
        Skill(
            "Collect",
            ["SE:CARRY"],
            ["SK:GoToObject+Avoid", "SK:GoToDropZone+Avoid"],
            Programmed(collect),
        ),
        Skill(
            "GoToObject+Avoid",
            distances,
            ["SK:GoToObject", "SK:Avoid"],
            Programmed(object_and_avoid),
        ),
        Skill(
            "GoToDropZone+Avoid",
            distances,
            ["SK:GoToDropZone", "SK:Avoid"],
            Programmed(zone_and_avoid),
        ),
        Skill("GoToObject", ["SE:OBJECT"], PRIMITIVES, Programmed(go_to_object)),
        Skill("GoToDropZone", ["SE:ZONE"], PRIMITIVES, Programmed(go_to_zone)),
        Skill("Avoid", ["SE:FRONT"], PRIMITIVES, Programmed(avoid)),
        Skill("moveForward", (), motors, Programmed(move_forward)),
        Skill("moveBackwards", (), motors, Programmed(move_backwards)),
        Skill("turnLeft", (), motors, Programmed(turn_left)),
        Skill("turnRight", (), motors, Programmed(turn_right)),
    ]
    return Hierarchy(MindDescription("robot", SENSORS, ("MotL", "MotR"), skills=skills))


def evaluated(step: Step) -> Hierarchy:
    """The hierarchy as it is in a step."""
    hierarchy = robot()
    hierarchy.evaluate(step.sensors)
    return hierarchy


def row_of(number: int, hierarchy: Hierarchy) -> dict[str, float]:
    """The numbers of a step: sensors, the influence of each skill, each link, the wheels."""
    row: dict[str, float] = {"step": number, **hierarchy.sensors()}
    row |= {f"influence {name}": value for name, value in hierarchy.influences().items()}
    links = hierarchy.links()
    for (skill, target), output in hierarchy.outputs().items():
        row[f"{skill} > {target} given"] = output
        row[f"{skill} > {target} transmitted"] = links[skill, target]
    return row | hierarchy.actuators()
