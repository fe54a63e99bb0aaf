"""MIND: hierarchies of skills that steer an agent by influence (thesis, chapters 4 and 5)."""

from socialmind.mind.description import MindDescription
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Actuator, Input, Output, Sensor, Skill, Variable
from socialmind.mind.regulation import Counter, Regulated, Regulation, Simple, Wave

__all__ = [
    "Actuator",
    "Counter",
    "Input",
    "MindDescription",
    "Output",
    "Programmed",
    "Regulated",
    "Regulation",
    "Sensor",
    "Simple",
    "Skill",
    "Variable",
    "Wave",
]
