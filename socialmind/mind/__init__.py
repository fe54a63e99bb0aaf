"""MIND: hierarchies of skills that steer an agent by influence (thesis, chapters 4 and 5)."""

from socialmind.mind.description import MindDescription
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution, Kernel
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.neat.neuron import GraphNeuron
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.functions.recurrent import Recurrent
from socialmind.mind.hierarchy import Hierarchy, load_mind
from socialmind.mind.links import Input, Output
from socialmind.mind.minds import Minds
from socialmind.mind.modules import Actuator, Sensor, Skill, Variable
from socialmind.mind.regulation import Counter, Regulated, Regulation, Simple, Wave

__all__ = [
    "Actuator", "CognitonScheme", "Convolution", "Counter", "Elman", "GraphNeuron", "Hierarchy",
    "InfluenceNetwork", "Input", "InternalFunction", "Kernel", "MindDescription", "Minds",
    "NeatGraph", "Output", "Perceptron", "Programmed", "Recurrent", "Regulated", "Regulation",
    "Sensor", "Simple", "Skill", "Variable", "Wave", "load_mind",
]  # fmt: skip
