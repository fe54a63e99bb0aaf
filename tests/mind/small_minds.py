"""Skills and minds of few words, whose numbers can be followed by hand."""

from collections.abc import Iterable, Mapping

from socialmind.mind import MindDescription, Output, Skill, Variable
from socialmind.mind.functions.perceptron import Perceptron


def constant(name: str, outputs: Mapping[str, float]) -> Skill:
    """A skill that always gives the same, such as `{"MO:MotL": 1.0, "SK:Avoid": 0.5}`."""
    return Skill(name, [], list(outputs), Perceptron(layers=0), list(outputs.values()))


def wired(name: str, outputs: Mapping[str, str]) -> Skill:
    """A skill whose outputs are inputs as they are, such as `{"MO:MotL": "SE:EyeR"}`."""
    inputs = list(dict.fromkeys(outputs.values()))
    genome = []
    for read in outputs.values():
        genome += [*(1.0 if one == read else 0.0 for one in inputs), 0.0]
    return Skill(name, inputs, list(outputs), Perceptron(layers=0), genome)


def mind(skills: Iterable[Skill], variables: Iterable[Variable | str] = ()) -> MindDescription:
    """A mind of skills, with the sensors and actuators that they name."""
    made = list(skills)
    sensors = sorted({one.name for skill in made for one in skill.inputs if one.code[0] == "S"})
    actuators = sorted({one.name for skill in made for one in skill.outputs if one.code == "MO"})
    return MindDescription("small", sensors, actuators, variables, made)


def written(variable: Variable) -> MindDescription:
    """A mind in which the skill "Write" sends the sensor "command" to a variable, with the sensor
    "influence" as its influence; "Read" shows what the variable presents to skills."""
    name = variable.name
    shown = {"MO:value": f"VA:{name}", "MO:change": f"VD:{name}", "MO:before": f"VH:{name}:2"}
    return mind(
        [
            wired("Master", {"SK:Write": "SE:influence", "SK:Read": "SE:one"}),
            wired("Write", {str(Output("VA", name)): "SE:command"}),
            wired("Read", shown),
        ],
        [variable],
    )
