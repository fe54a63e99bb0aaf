"""The variant of 6.1.3: the hierarchy on four constant base skills, which no lesson teaches.

`python -m analysis.collect.constant FOLDER` writes it, nothing learned. What was learned is in
`models/collect/mind_constant`:

    socialmind learn collect --mind FOLDER
"""

from __future__ import annotations

import sys
from dataclasses import replace

from socialmind.mind import MindDescription, Output, Programmed, Skill

from .controls import hierarchy

WHEELS = ("MO:MotL", "MO:MotR")


def move_forward():
    """Set both wheels to full forward."""
    return 1.0, 1.0


def move_backwards():
    """Set both wheels to full backwards."""
    return 0.0, 0.0


def turn_left():
    """Set the left wheel to full backwards, the right one to full forward."""
    return 0.0, 1.0


def turn_right():
    """Set the left wheel to full forward, the right one to full backwards."""
    return 1.0, 0.0


CONSTANTS = {
    "moveForward": move_forward,
    "moveBackwards": move_backwards,
    "turnLeft": turn_left,
    "turnRight": turn_right,
}


def constant() -> MindDescription:
    """The hierarchy of figure 6.6: what commanded the wheels influences four constant skills."""
    mind = hierarchy()
    steered = [Output.parse(f"SK:{name}") for name in CONSTANTS]
    skills = [
        replace(one, outputs=steered)
        for one in mind.skills.values()
        if tuple(str(output) for output in one.outputs) == WHEELS
    ]
    skills += [Skill(name, [], WHEELS, Programmed(does)) for name, does in CONSTANTS.items()]
    return mind.with_modules(skills=skills)


if __name__ == "__main__":
    constant().save(sys.argv[1])
