"""A small mind with a file of each kind, for breaking and cutting."""

from socialmind.mind import MindDescription, Skill
from socialmind.mind.functions.neat.graph import GraphNeuron, NeatGraph
from socialmind.mind.functions.perceptron import Perceptron

FILES = {
    "Robot.botdesc": """\
SENSORS
S1:proxSensor
S2:proxSensor:2
ACTUATORS
MotL:wheel
MotR:wheel:0.25
""",
    "Robot.vardesc": """\
SIN:TickWaveSinVariableModule
MOOD:VariableModule:0.5
N:CounterVariableModule::5:0.8:0.2
ALARM:SharedVariableModule:0.25:Herd
LEAK:RegulatedVariableModule:0.5:leak
""",
    "Robot.py": """\
def leak(command, value):
    return value + 0.1 * (command - value)
""",
    "Skills/Master/Master.ades": """\
Master
input:3
SE:S1
SD:S2
VA:SIN
output:3
SK:Turn
SK:See
VA:MOOD
neural
TYPE:BASIC
LAYERS:1
HIDDEN_TRANSFER:SIGMOID
HIDDEN_NEURON_ADDED:0
""",
    "Skills/Turn/Turn.ades": """\
Turn
input:1
SH:S1:5
output:2
MO:MotL
MO:MotR
hardCoded
class:TurnRound
""",
    "Skills/Turn/TurnRound.py": """\
def turn_round(seen):
    return seen, 1.0 - seen
""",
    "Skills/See/See.ades": """\
See
input:4
SE:S1
SE:S2
VA:ALARM
VA:LEAK
output:2
MO:MotL
SK:Think
neural
TYPE:CNN
LAYERS:0
HIDDEN_NEURON_ADDED:0
CONVO_LAYER:2:2
CONVO_BYPASS:3
CONVO_LINK:0:0:0:1
CONVO_LINK:0:1:1:2
""",
    "Skills/See/See.genome": """\
socialmind genome 1
# a convolutional network of 1 kernel and no hidden layer
skill:See
inputs:4
outputs:2
neural
TYPE:CNN
LAYERS:0
HIDDEN_TRANSFER:RELU
HIDDEN_NEURON_ADDED:0
CONVO_LAYER:2:2
CONVO_BYPASS:3
CONVO_LINK:0:0:0:1
CONVO_LINK:0:1:1:2
weights:11
0.1
-0.2
0.3
1e-05
-2.5
0.0
1.0
2.0
3.0
-0.75
0.125
end
""",
    "Skills/Think/Think.ades": """\
Think
input:1
VA:N
output:1
SK:Graph
cognitonScheme
scheme:think.yaml
cogniton:0:Worry
""",
    "Skills/Think/think.yaml": """\
name: thinker
cognitons:
  Worry: {influence: {Graph: 1}, conditional: [Graph]}
""",
    "Skills/Graph/Graph.ades": """\
Graph
input:2
SE:S1
SE:S2
output:1
MO:MotR
neural
TYPE:NEAT
""",
    "Skills/Graph/Graph.genome": """\
socialmind genome 1
skill:Graph
inputs:2
outputs:1
neural
TYPE:NEAT
graph feed-forward 2 1
neuron 1 tanh sum 1.0 -1 -2
neuron 0 sigmoid sum 1.0 1
weights:5
0.5
-0.5
0.25
1.5
-1.5
end
""",
    "Tasks/Go.simbatch": """\
TYPE:LEARNSIM
MASTERSKILL:Master
NUMGEN:50
COLOUR:red
""",
}

YAML_MIND = """\
name: robot
sensors:
  S1: proxSensor
  S2: {type: proxSensor, parameters: [2]}
actuators:
  MotL: wheel
  MotR: {type: wheel, neutral: 0.25}
variables:
  SIN: TickWaveSinVariableModule
  N: {type: CounterVariableModule, maximum: 5, increment: 0.9, reset: 0.1}
  ALARM: {type: SharedVariableModule, default: 0.25, group: Herd}
skills:
  Master:
    inputs: [SE:S1, SH:S2:5, VA:SIN]
    outputs: [SK:See, VA:N]
    function: {type: BASIC, layers: 1, hidden_transfer: SIGMOID}
  See:
    inputs: [SE:S1, SE:S2, VA:ALARM, VA:N]
    outputs: [MO:MotL, MO:MotR]
    function:
      type: CNN
      layers: 0
      bypass: [3]
      kernels:
        - inputs: 2
          links: [[0, 1], [1, 2]]
"""


def small_description():
    """A mind of two networks with weights, built in code."""
    graph = NeatGraph(2, 1, (GraphNeuron(1, (-1, -2), "tanh"), GraphNeuron(0, (1,))))
    go = Skill("Go", ["SE:S1", "VA:X"], ["MO:M"], graph, [0.5, -0.5, 0.25, 1.5, -1.5])
    master = Skill("Top", ["SE:S1"], ["SK:Go", "VA:X"], Perceptron(layers=0), [1, 2, 3, 4])
    return MindDescription("small", ["S1"], ["M"], ["X"], [master, go])
