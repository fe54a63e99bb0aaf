"""MIND: hierarchies of skills that steer an agent by influence (thesis, chapters 4 and 5)."""

from socialmind.mind.description import MindDescription
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.hierarchy import Hierarchy, load_mind
from socialmind.mind.minds import Minds
from socialmind.mind.modules import Actuator, Input, Output, Sensor, Skill, Variable
from socialmind.mind.regulation import Counter, Regulated, Regulation, Simple, Wave

__all__ = [
    "Actuator",
    "CognitonScheme",
    "Counter",
    "Hierarchy",
    "Input",
    "MindDescription",
    "Minds",
    "Output",
    "Programmed",
    "Regulated",
    "Regulation",
    "Sensor",
    "Simple",
    "Skill",
    "Variable",
    "Wave",
    "load_mind",
]
