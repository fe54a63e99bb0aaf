"""Broken files: each gives one clear line with file, line, what is expected and what to do."""

import pytest
from small_mind import FILES, YAML_MIND

from socialmind.errors import ModelError
from socialmind.mind import MindDescription
from socialmind.mind.files.folder import load_tasks

BOT, VAR, TASK = "Robot.botdesc", "Robot.vardesc", "Tasks/Go.simbatch"
MASTER, TURN, SEE = (f"Skills/{name}/{name}.ades" for name in ("Master", "Turn", "See"))
THINK = "Skills/Think/Think.ades"
WEIGHTS, GRAPH_WEIGHTS = "Skills/See/See.genome", "Skills/Graph/Graph.genome"
PROGRAM, SCHEME = "Skills/Turn/TurnRound.py", "Skills/Think/think.yaml"

# What is wrong, the file, what is exchanged for what, the line at fault, words of the message.
BROKEN = [
    ("no SENSORS", BOT, "SENSORS\n", "", 1, ["'S1:proxSensor'", "expected SENSORS"]),
    ("no ACTUATORS", BOT, "ACTUATORS\nMotL:wheel\nMotR:wheel:0.25\n", "", 3, ["end of the file"]),
    ("SENSORS twice", BOT, "S2:proxSensor:2", "SENSORS", 3, ["SENSORS in the wrong place"]),
    ("ACTUATORS twice", BOT, "MotL:wheel\n", "ACTUATORS\n", 5, ["ACTUATORS again"]),
    ("a sensor without type", BOT, "S1:proxSensor", "S1", 2, ["'S1'", "name:type"]),
    ("a sensor without name", BOT, "S1:proxSensor", ":proxSensor", 2, ["'' as the name"]),
    ("a neutral beyond 1", BOT, "wheel:0.25", "wheel:2", 6, ["2.0", "'MotR'", "0 … 1"]),
    ("a neutral with a comma", BOT, "wheel:0.25", "wheel:0,25", 6, ["'0,25'", "with a point"]),
    ("a neutral that is no number", BOT, "wheel:0.25", "wheel:nan", 6, ["'nan'", "a number"]),
    ("a sensor twice", BOT, "S2:prox", "S1:prox", 3, ["second sensor called 'S1'", "line 2"]),
    ("a control character", BOT, "S1:prox", "S1:pr\x00ox", 2, ["control character"]),
    ("not UTF-8", BOT, "wheel\n", b"whe\xe9l\n", 5, ["0xe9", "UTF-8"]),
    ("UTF-16", BOT, None, "\n".join(FILES[BOT]).encode("utf-16"), 1, ["UTF-8"]),
    ("a variable without type", VAR, "MOOD:VariableModule:0.5", "MOOD", 2, ["name:type"]),
    ("an unknown type", VAR, "VariableModule:0.5", "VarModule:0.5", 2, ["'VarModule'", "mean"]),
    ("a default that is none", VAR, "Module:0.5\nN", "Module:half\nN", 2, ["'half'", "'MOOD'"]),
    ("a default beyond 1", VAR, "Module:0.5\nN", "Module:5\nN", 2, ["5.0", "0 … 1"]),
    ("too many fields", VAR, "VariableModule:0.5\nN", "VariableModule:0.5:1\nN", 2, ["2 fields"]),
    ("a maximum of 0", VAR, "::5:", "::0:", 3, ["up to 0", "1 or more"]),
    ("a maximum of 2.5", VAR, "::5:", "::2.5:", 3, ["'2.5'", "whole number"]),
    ("crossed thresholds", VAR, "0.8:0.2", "0.2:0.8", 3, ["resets below 0.8", "reset <="]),
    ("a default between counts", VAR, "::5:", ":0.3:5:", 3, ["0.3", "'N'", "0.2"]),
    ("no group", VAR, ":0.25:Herd", ":0.25", 4, ["1 fields", "Group"]),
    ("a group without name", VAR, ":Herd", ":", 4, ["'' as the name of a group"]),
    ("a regulation that is not there", VAR, ":leak", ":drip", 5, ["'drip'", "drip()"]),
    ("a regulation in no file", VAR, ":leak", ":x.py:leak", 5, ["'leak'", "x.py"]),
    ("a regulation of no name", VAR, ":leak", ":1+1", 5, ["'1+1'", "file.py:function"]),
    ("a variable twice", VAR, "MOOD:", "SIN:", 2, ["second variable called 'SIN'", "line 1"]),
    ("an empty skill", SEE, None, "", 1, ["end of the file", "name of a skill"]),
    ("another name than its folder", TURN, "Turn\n", "Spin\n", 1, ["'Spin'", "Turn"]),
    ("no name", TURN, "Turn\n", "", 1, ["'input:1'", "name of the skill"]),
    ("no count of inputs", TURN, "input:1\n", "", 2, ["'SH:S1:5'", "input:number", "'Turn'"]),
    ("a count that is none", TURN, "input:1", "input:one", 2, ["'one'", "whole number"]),
    ("a negative count", TURN, "input:1", "input:-1", 2, ["'-1'", "whole number"]),
    ("too few inputs", MASTER, "input:3", "input:4", 6, ["'output:3'", "input 4 of 4", "line 2"]),
    ("too many inputs", MASTER, "input:3", "input:2", 5, ["'VA:SIN'", "output:number"]),
    ("too few outputs", MASTER, "output:3", "output:4", 10, ["'neural'", "output 4 of 4"]),
    ("too many outputs", MASTER, "output:3", "output:2", 9, ["'VA:MOOD'", "neural"]),
    ("outputs before inputs", TURN, "input:1\nSH:S1:5\noutput:2\nMO:MotL\nMO:MotR\n",
     "output:2\nMO:MotL\nMO:MotR\ninput:1\nSH:S1:5\n", 2, ["'output:2'", "input:number"]),
    ("no output", TURN, "output:2\nMO:MotL\nMO:MotR\n", "output:0\n", 1, ["without outputs"]),
    ("an unknown kind of input", MASTER, "SE:S1", "SX:S1", 3, ["'SX'", "SE, SD", "'Master'"]),
    ("an input without kind", MASTER, "SE:S1", "S1", 3, ["'S1'", "KIND:NAME"]),
    ("an unknown sensor", MASTER, "SE:S1", "SE:S11", 3, ["SE:S11", "did you mean 'S1'"]),
    ("an unknown variable", MASTER, "VA:SIN", "VA:SUN", 5, ["VA:SUN", "did you mean 'SIN'"]),
    ("a history without ticks", TURN, "SH:S1:5", "SH:S1", 3, ["SH:S1", "how far back"]),
    ("a history of 0 ticks", TURN, "SH:S1:5", "SH:S1:0", 3, ["SH:S1", "1 or more"]),
    ("a history of no number", TURN, "SH:S1:5", "SH:S1:x", 3, ["'x'", "whole number"]),
    ("a history beyond reason", TURN, "S1:5", f"S1:{'9' * 6000}", 3, ["more than 100,000"]),
    ("a value with ticks", TURN, "SH:S1:5", "SE:S1:5", 3, ["5 ticks back", "SH"]),
    ("an unknown kind of output", TURN, "MO:MotL", "ME:MotL", 5, ["'ME'", "MO, SK"]),
    ("an unknown actuator", TURN, "MO:MotL", "MO:MotX", 5, ["MO:MotX", "did you mean"]),
    ("an unknown subskill", MASTER, "SK:Turn", "SK:Tern", 7, ["SK:Tern", "did you mean 'Turn'"]),
    ("an output twice", TURN, "MO:MotR", "MO:MotL", 6, ["MO:MotL twice", "'Turn'"]),
    ("no function", TURN, "hardCoded\nclass:TurnRound\n", "", 6, ["end of the file", "hardCoded"]),
    ("an unknown function", TURN, "hardCoded", "hardcoded", 7, ["'hardcoded'", "neural or hard"]),
    ("an unknown keyword", MASTER, "LAYERS:1", "LAYER:1", 12, ["'LAYER'", "did you mean 'LAYERS'"]),
    ("an unknown type of network", MASTER, "TYPE:BASIC", "TYPE:MLP", 11, ["'MLP'", "BASIC, CNN"]),
    ("layers of no number", MASTER, "LAYERS:1", "LAYERS:two", 12, ["'two'", "in digits"]),
    ("layers without number", MASTER, "LAYERS:1", "LAYERS", 12, ["'LAYERS'", "one whole number"]),
    ("layers beyond reason", MASTER, "LAYERS:1", "LAYERS:100000", 12, ["100000", "0 … 1000"]),
    ("layers twice", MASTER, "LAYERS:1", "LAYERS:1\nlayers:1", 13, ["second LAYERS", "line 12"]),
    ("an unknown transfer", MASTER, "SIGMOID", "TANH", 13, ["'TANH'", "RELU or SIGMOID"]),
    ("a kernel in a perceptron", MASTER, "LAYERS:1", "CONVO_LAYER:1:1", 12, ["CONVO_LAYER in"]),
    ("a network that needs a layer", MASTER, "BASIC\nLAYERS:1", "ELMAN\nLAYERS:0", 11, ["hidden"]),
    ("a graph in a perceptron", MASTER, "LAYERS:1", "graph minimal", 12, ["NEAT", "TYPE:BASIC"]),
    ("no kernel", SEE, "CONVO_LAYER:2:2\n", "", 11, ["without CONVO_LAYER"]),
    ("a kernel without neurons", SEE, "CONVO_LAYER:2:2", "CONVO_LAYER:2:0", 14, ["1 or more"]),
    ("a link of another size", SEE, "0:1:1:2", "0:1:1", 17, ["1 inputs for neuron 1", "line 14"]),
    ("a link to no kernel", SEE, "LINK:0:1:1", "LINK:1:1:1", 17, ["kernel 1", "0 … 0"]),
    ("a link from no neuron", SEE, "LINK:0:1:1", "LINK:0:2:1", 17, ["neuron 2", "0 … 1"]),
    ("a link to no input", SEE, "0:1:1:2", "0:1:1:4", 17, ["input 4", "0 … 3", "from 0"]),
    ("a neuron linked twice", SEE, "LINK:0:1:", "LINK:0:0:", 17, ["neuron 0 of kernel 0"]),
    ("a neuron not linked", SEE, "CONVO_LINK:0:1:1:2\n", "", 14, ["neuron 1", "CONVO_LINK:0:1"]),
    ("a link too short", SEE, "CONVO_LINK:0:1:1:2", "CONVO_LINK:0", 17, ["a kernel, a neuron"]),
    ("a bypass of no input", SEE, "BYPASS:3", "BYPASS:4", 15, ["input 4", "0 … 3"]),
    ("no class", TURN, "class:TurnRound\n", "", 7, ["without class", "class:Name"]),
    ("two classes", TURN, "class:TurnRound", "class:A\nclass:B", 9, ["'class:B'", "one line"]),
    ("a layer in a program", TURN, "class:TurnRound", "layers:2", 8, ["'layers:2'", "class:"]),
    ("a class that is no name", TURN, "TurnRound", "a/b", 8, ["'a/b'", "name of a function"]),
    ("a class that is not there", TURN, "TurnRound", "Spin", 8, ["'Spin'", "def Spin"]),
    ("a program of no Python", PROGRAM, "def ", "deff ", 1, ["not valid Python"]),
    ("a program that stops", PROGRAM, "def", "1 / 0\n\ndef", 1, ["ZeroDivisionError"]),
    ("a program of two functions", PROGRAM, "def turn_round(seen)",
     "def other():\n    return 0\n\n\ndef third(seen)", None, ["TurnRound", "other, third"]),
    ("a program of other inputs", PROGRAM, "(seen)", "(seen, heard)", None, ["takes 2", "1, one"]),
    ("no scheme", THINK, "scheme:think.yaml\n", "", 6, ["without scheme", "scheme:Name"]),
    ("a scheme that is not there", THINK, "think.yaml", "thought.yaml", 7, ["'thought.yaml'"]),
    ("a scheme that is none", SCHEME, "name:", "nome:", 1, ["'nome'", "did you mean 'name'"]),
    ("a scheme without the plan", SCHEME, "Graph", "Draw", None, ["plan 'Draw'", "'Think'"]),
    ("an input of no cogniton", THINK, "0:Worry", "0:Wory", 3, ["'Wory'", "did you mean"]),
    ("a cogniton for no input", THINK, "0:Worry", "1:Worry", 8, ["input 1", "0 … 0"]),
    ("a cogniton without number", THINK, "0:Worry", "Worry", 8, ["cogniton:number"]),
    ("weights of a later version", WEIGHTS, "genome 1", "genome 2", 1, ["genome 2", "that wrote"]),
    ("weights that are none", WEIGHTS, "socialmind genome 1\n", "", 2, ["skill:See", "begin with"]),
    ("weights of another skill", WEIGHTS, "skill:See", "skill:Hear", 3, ["skill:Hear", "'See'"]),
    ("weights of other inputs", WEIGHTS, "inputs:4", "inputs:5", 4, ["inputs:5", "inputs:4"]),
    ("weights of another function", WEIGHTS, "LAYERS:0", "LAYERS:1", 6, ["weights of a conv"]),
    ("weights without function", WEIGHTS, "neural\n", "", 6, ["TYPE:CNN", "expected neural"]),
    ("weights of another count", WEIGHTS, "weights:11", "weights:10", 15, ["weights:11"]),
    ("no count of weights", WEIGHTS, "weights:11\n", "", 15, ["'0.1'", "weights:number"]),
    ("NaN weights", WEIGHTS, "-0.2", "nan", 17, ["'nan'", "weight 2 of 11", "'See'"]),
    ("infinite weights", WEIGHTS, "-0.2", "-inf", 17, ["'-inf'", "a finite number"]),
    ("weights too large", WEIGHTS, "-0.2", "1e999", 17, ["'1e999'", "a finite number"]),
    ("weights of no number", WEIGHTS, "-0.2", "0,2", 17, ["'0,2'", "a finite number"]),
    ("a weight too few", WEIGHTS, "0.125\n", "", 26, ["'end'", "weight 11 of 11", "cut off"]),
    ("a weight too many", WEIGHTS, "0.125", "0.125\n7.0", 27, ["'7.0'", "more than 11 weights"]),
    ("no end", WEIGHTS, "end\n", "", 26, ["end of the file", "cut off"]),
    ("more after the end", WEIGHTS, "end", "end\nend", 28, ["nothing after end"]),
    ("a graph of other inputs", GRAPH_WEIGHTS, "forward 2 1", "forward 3 1", 7, ["3 inputs"]),
    ("a graph of no neuron", GRAPH_WEIGHTS, "neuron 1 tanh", "nerve 1 tanh", 8, ["'nerve"]),
    ("a neuron of no activation", GRAPH_WEIGHTS, "tanh", "tan", 8, ["'tan'", "sigmoid"]),
    ("a task without type", TASK, "TYPE:LEARNSIM\n", "", 3, ["without TYPE", "TYPE:LEARN2DSIM"]),
    ("an unknown type of task", TASK, "LEARNSIM", "LERNSIM", 1, ["'LERNSIM'", "did you mean"]),
    ("a key without colon", TASK, "NUMGEN:50", "NUMGEN 50", 3, ["'NUMGEN 50'", "colon"]),
    ("a key twice", TASK, "COLOUR:red", "NUMGEN:60", 4, ["second NUMGEN", "line 3"]),
    ("generations of no number", TASK, "NUMGEN:50", "NUMGEN:5e1", 3, ["'5e1'", "NUMGEN"]),
]  # fmt: skip


def one_line(error, path, line, words):
    """Check that an error is one line that says where, what and what to do."""
    message = str(error)
    assert "\n" not in message
    place = f"{path}:{line}: " if line is not None else str(path)
    assert message.startswith(place), message
    for word in words:
        assert word in message, message
    return message


@pytest.mark.parametrize(
    ("path", "old", "new", "line", "words"),
    [row[1:] for row in BROKEN],
    ids=[row[0].replace(" ", "-") for row in BROKEN],
)
def test_a_broken_file_gives_one_clear_line(write_files, path, old, new, line, words):
    whole = FILES[path]
    if old is None:
        text = new
    else:
        assert old in whole
        text = whole.encode() if isinstance(new, bytes) else whole
        text = text.replace(old.encode() if isinstance(new, bytes) else old, new, 1)
    folder = write_files(FILES | {path: text})
    with pytest.raises(ModelError) as caught:
        MindDescription.load(folder)
        load_tasks(folder)
    named = folder / path
    if line is None:  # the fault shows in the file of the skill that it belongs to
        named = next(named.parent.glob("*.ades"))
    one_line(caught.value, named, line, words)
    if path not in (PROGRAM, SCHEME):
        assert caught.value.remedy


def test_a_cycle_names_the_way_and_one_of_its_links(write_files):
    folder = write_files(FILES | {SEE: FILES[SEE].replace("MO:MotL", "SK:Master")})
    with pytest.raises(ModelError) as caught:
        MindDescription.load(folder)
    one_line(caught.value, folder / SEE, 8, ["itself: See > Master > See", "take one"])


def test_the_small_mind_is_whole(write_files):
    folder = write_files(FILES)
    mind = MindDescription.load(folder)
    assert mind.order == ("Master", "See", "Think", "Graph", "Turn")
    assert mind.skill("See").genome.tolist()[3] == 1e-05
    assert load_tasks(folder)["Go"].others == {"COLOUR": "red"}


YAML_BROKEN = [
    ("an empty file", None, "", 1, ["an empty file", "a mind"]),
    ("no YAML", "[SE:S1,", "[[SE:S1,", 15, ["not YAML"]),
    ("no name", "name: robot\n", "", 1, ["without a name", "name:"]),
    ("an unknown section", "sensors:", "sensor:", 2, ["'sensor'", "did you mean 'sensors'"]),
    ("a sensor twice", "S2:", "S1:", 4, ["'S1' stands twice"]),
    ("an unknown field of a sensor", "parameters", "params", 4, ["'params'", "parameters"]),
    ("a neutral beyond 1", "0.25}\nv", "7}\nv", 7, ["7", "0 … 1"]),
    ("a neutral in quotes", "0.25}\nv", "'0.25'}\nv", 7, ["a number", "remove the quotes"]),
    ("an unknown variable type", "TickWaveSin", "Sine", 9, ["'SineVariableModule'"]),
    ("a field of another type", "N: {type: CounterV", "N: {type: V", 10, ["'maximum'"]),
    ("a maximum of 2.5", "maximum: 5", "maximum: 2.5", 10, ["'2.5'", "whole number"]),
    ("no group", ", group: Herd", "", 11, ["'ALARM' without group", "group:"]),
    ("an unknown sensor", "SE:S1, SH", "SE:S9, SH", 14, ["SE:S9", "there is S1, S2"]),
    ("an unknown kind of input", "SE:S1, SH", "XX:S1, SH", 14, ["'XX'", "in the skill 'Master'"]),
    ("inputs of no list", "[SE:S1, SH:S2:5, VA:SIN]", "SE:S1", 14, ["a list", "[SE:S1]"]),
    ("no function", "    function: {type: BASIC, layers: 1, hidden_transfer: SIGMOID}\n", "", 13,
     ["'Master' without function", "add function:"]),
    ("an unknown function", "type: BASIC", "type: BASICS", 16, ["'BASICS'", "mean 'BASIC'"]),
    ("an unknown field of a function", "layers: 1", "layer: 1", 16, ["'layer'", "layers"]),
    ("layers of no number", "layers: 1", "layers: one", 16, ["'one'", "LAYERS"]),
    ("an unknown transfer", "SIGMOID", "TANH", 16, ["'TANH'", "RELU or SIGMOID"]),
    ("a bypass of no input", "bypass: [3]", "bypass: [4]", 23, ["input 4"]),
    ("a link of another size", "[1, 2]]", "[1]]", 26, ["1 inputs for neuron 1"]),
    ("a kernel without links", "          links: [[0, 1], [1, 2]]\n", "", 25, ["without links"]),
    ("a cycle", "MO:MotL, MO:MotR", "MO:MotL, SK:Master", 15, ["Master > See > Master"]),
    ("a program that is not there", "{type: BASIC, layers: 1, hidden_transfer: SIGMOID}",
     "{type: hardCoded, class: go}", 16, ["'go'", "def go"]),
    ("a scheme that is not there", "{type: BASIC, layers: 1, hidden_transfer: SIGMOID}",
     "{type: cognitonScheme, scheme: go.yaml}", 16, ["'go.yaml'"]),
    ("a tab", "  S1: prox", "\tS1: prox", 3, ["no tabs"]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [row[1:] for row in YAML_BROKEN],
    ids=[row[0].replace(" ", "-") for row in YAML_BROKEN],
)
def test_broken_yaml_gives_one_clear_line(write_files, old, new, line, words):
    assert old is None or old in YAML_MIND
    text = new if old is None else YAML_MIND.replace(old, new, 1)
    path = write_files({"robot.yaml": text}) / "robot.yaml"
    with pytest.raises(ModelError) as caught:
        MindDescription.load(path)
    one_line(caught.value, path, line, words)
    assert caught.value.remedy


MISPLACED = [
    ("two minds", {"Other.botdesc": "SENSORS\nACTUATORS\n"}, "", ["2 files", "one <Agent>"]),
    ("variables of another mind", {VAR: None, "Rob.vardesc": ""}, "Rob.vardesc", ["rename it"]),
    ("a skill without file", {TURN: None}, "Skills/Turn", ["no skill", "Turn.ades"]),
    ("a second skill", {"Skills/Turn/X.ades": "X"}, "Skills/Turn/X.ades", ["take it out"]),
    ("a second genome", {"Skills/See/X.genome": ""}, "Skills/See/X.genome", ["rename it"]),
    ("no mind", {BOT: None}, "", ["no .botdesc file"]),
    ("weights of a program", {"Skills/Turn/Turn.genome": FILES[WEIGHTS]},
     "Skills/Turn/Turn.genome:3", ["skill:See", "skill:Turn"]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("files", "place", "words"),
    [row[1:] for row in MISPLACED],
    ids=[row[0].replace(" ", "-") for row in MISPLACED],
)
def test_a_misplaced_file_gives_one_clear_line(write_files, files, place, words):
    changed = {path: text for path, text in (FILES | files).items() if text is not None}
    folder = write_files(changed)
    (folder / "Skills" / "Turn").mkdir(exist_ok=True)
    with pytest.raises(ModelError) as caught:
        MindDescription.load(folder)
    message = one_line(caught.value, folder / place, None, words)
    assert caught.value.remedy, message


def test_a_folder_or_file_that_is_not_there(tmp_path):
    for name in ("none", "none.yaml"):
        with pytest.raises(ModelError) as caught:
            MindDescription.load(tmp_path / name)
        one_line(caught.value, tmp_path / name, None, [])
