"""A mind as one YAML file, to be read, commented and edited by hand. Reader.

It says the same as the folder of EvoAgents; docs/minds_files.md describes it. Weights stand in
`<file>.genomes/<Skill>.genome` beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import yaml

from coglogo_py.files.yaml_nodes import NOTHING, Nodes, composed
from socialmind.errors import ModelError, nearest, of_model_file
from socialmind.mind.files.evoagents import ades, genome_file, network_lines, text_file
from socialmind.mind.files.evoagents.folder_reader import whole
from socialmind.mind.files.evoagents.vardesc import SHARED
from socialmind.mind.files.python_file import load_beside
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.links import Input, Output
from socialmind.mind.modules import Actuator, AMind, Sensor, Skill, Variable
from socialmind.mind.regulation import REGULATIONS, Counter, Regulated, Regulation, Simple, Wave

SENSORS, ACTUATORS, VARIABLES, SKILLS = "sensors", "actuators", "variables", "skills"
TOP_FIELDS = ("name", SENSORS, ACTUATORS, VARIABLES, SKILLS)
SKILL_FIELDS = ("inputs", "outputs", "function")
VARIABLE_FIELDS = {
    Simple.keyword: ("default",),
    Wave.keyword: (),
    Counter.keyword: ("default", "maximum", "increment", "reset"),
    SHARED: ("default", "group"),
    Regulated.keyword: ("default", "function", "file"),
}
KERNELS, GRAPH, KERNEL_FIELDS = "kernels", "graph", ("inputs", "links")
FUNCTION_FIELDS: dict[str, tuple[str, ...]] = {
    **{
        kind: tuple(one.lower() for one in network_lines.KEYWORDS[Perceptron.keyword])
        for kind in network_lines.KEYWORDS
    },
    Convolution.keyword: (*(one.lower() for one in network_lines.HIDDEN), KERNELS, "bypass"),
    NeatGraph.keyword: (GRAPH,),
    InfluenceNetwork.keyword: tuple(
        one.lower() for one in (*network_lines.HIDDEN, *network_lines.BRANCHES)
    ),
    Programmed.keyword: (ades.CLASS, "file"),
    CognitonScheme.keyword: (ades.SCHEME, "cognitons"),
}
GENOMES = ".genomes"
"""The end of the name of the folder that holds the weights."""

Module = TypeVar("Module", Sensor, Actuator, Variable)
Link = TypeVar("Link", Input, Output)


def load(path: Path, kind: Callable[..., AMind]) -> AMind:
    """Read a mind's YAML file, with the weights beside it.

    Raises:
        ModelError: one of the files is wrong; says at which line and why.
    """
    description = parse(text_file.text_of(path), path, kind)
    folder = path.with_name(path.stem + GENOMES)
    if not folder.is_dir():
        return description
    skills = []
    for file in sorted(folder.glob("*.genome")):
        if file.stem not in description.skills:
            raise ModelError(
                f"weights of {file.stem!r}, which is no skill of {path}",
                "the name of a skill",
                nearest(file.stem, description.skills),
                file,
            )
        skills.append(
            genome_file.parse(_weights_in(file, path), file, description.skills[file.stem])
        )
    own = {**description.skills, **{skill.name: skill for skill in skills}}
    return kind(
        description.name,
        description.sensors.values(),
        description.actuators.values(),
        description.variables.values(),
        own.values(),
    )


def _weights_in(file: Path, mind: Path) -> str:
    place = file.relative_to(mind.parent).as_posix()
    return text_file.text_of(
        text_file.inside(mind.parent, place, "the file", mind), text_file.MOST_GENOME
    )


def parse(text: str, file: str | Path, kind: Callable[..., AMind]) -> AMind:
    r"""Return the mind that a YAML file describes, without its weights.

    Args:
        text: the file's content.
        file: its path, for messages and for the files of programs and schemes beside it.
        kind: the class of the mind.

    Raises:
        ModelError: the text is no mind; says at which line and why.

    >>> from socialmind.mind import MindDescription
    >>> text = "name: seeker\nsensors: [Eye]\nactuators: [Mot]\nskills:\n"
    >>> text += "  Seek: {inputs: [SE:Eye], outputs: [MO:Mot], function: BASIC}\n"
    >>> parse(text, "seeker.yaml", MindDescription).skills["Seek"].function
    a perceptron of 2 hidden layers
    """
    with of_model_file(remedy=ades.GENERAL_REMEDY):
        return _Mind(text, file).description(kind)


class _Mind:
    """The nodes of a mind's YAML file."""

    def __init__(self, text: str, file: str | Path) -> None:
        self.file = str(file)
        self.nodes = Nodes(file)
        # For the errors of what is read as lines of an `.ades` file.
        self.lines = text_file.Lines("", file)
        self.root = composed(text, file, "a mind")

    def description(self, kind: Callable[..., AMind]) -> AMind:
        given = self.nodes.fields(self.root, "the mind", TOP_FIELDS)
        if "name" not in given:
            raise self.nodes.error(self.root, "a mind without a name", "name:", "begin with name:")
        name = self.nodes.name(given["name"], "name of the mind")
        skills = self.nodes.entries(given.get(SKILLS, NOTHING), SKILLS)
        return whole(
            kind,
            name,
            self._modules(given, SENSORS, self._sensor),
            self._modules(given, ACTUATORS, self._actuator),
            self._modules(given, VARIABLES, self._variable),
            [self._skill(name, key, node) for name, key, node in skills],
        )

    def _modules(
        self,
        given: dict[str, yaml.Node],
        where: str,
        read: Callable[[str, yaml.Node, int], Module],
    ) -> list[Module]:
        """Return the modules of a list of names, or of a mapping from names to what they are."""
        node = given.get(where, NOTHING)
        if isinstance(node, yaml.SequenceNode):
            self.nodes.names(node, where)
            pairs: list[tuple[str, yaml.Node, yaml.Node]]
            pairs = [(str(item.value), item, NOTHING) for item in node.value]
        else:
            pairs = list(self.nodes.entries(node, where))
        modules = []
        for name, key, value in pairs:
            with self.lines.placing(_line(key), ades.GENERAL_REMEDY):
                modules.append(read(name, value, _line(key)))
        return modules

    def _typed(
        self, node: yaml.Node, where: str, fields: tuple[str, ...]
    ) -> tuple[str, dict[str, yaml.Node]]:
        """Return what kind of module a node writes, alone or as its field `type`."""
        if self.nodes.is_nothing(node):
            return "", {}
        if isinstance(node, yaml.ScalarNode):
            return node.value, {}
        given = self.nodes.fields(node, where, ("type", *fields))
        kind = given.pop("type", NOTHING)
        return "" if kind is NOTHING else self._word(kind, f"type of {where}"), given

    def _word(self, node: yaml.Node, where: str) -> str:
        return self.nodes.name(node, where)

    def _parameters(self, given: dict[str, yaml.Node], where: str) -> tuple[str, ...]:
        node = given.get("parameters", NOTHING)
        items = self.nodes.items(node, f"parameters of {where}")
        return tuple(self._word(item, f"a parameter of {where}") for item in items)

    def _sensor(self, name: str, node: yaml.Node, line: int) -> Sensor:
        where = f"the sensor {name!r}"
        kind, given = self._typed(node, where, ("parameters",))
        return Sensor(name, kind, self._parameters(given, where), self.file, line)

    def _actuator(self, name: str, node: yaml.Node, line: int) -> Actuator:
        where = f"the actuator {name!r}"
        kind, given = self._typed(node, where, ("neutral", "parameters"))
        neutral = 0.5
        if "neutral" in given:
            neutral = self.nodes.number(given["neutral"], f"neutral of {where}")
        parameters = self._parameters(given, where)
        return Actuator(name, kind, neutral, parameters, self.file, line)

    def _variable(self, name: str, node: yaml.Node, line: int) -> Variable:
        where = f"the variable {name!r}"
        every = tuple(dict.fromkeys(one for held in VARIABLE_FIELDS.values() for one in held))
        kind, given = self._typed(node, where, every)
        kind = kind or Simple.keyword
        self._check_fields(kind, given, VARIABLE_FIELDS, where, node)
        default = None
        if "default" in given:
            default = self.nodes.number(given["default"], f"default of {where}")
        group = None
        if kind == SHARED:
            group = self._needed(given, "group", where, node)
        regulation = self._regulation(kind, given, where, node)
        return Variable(name, regulation, default, group, self.file, line)

    def _regulation(
        self, kind: str, given: dict[str, yaml.Node], where: str, node: yaml.Node
    ) -> Regulation:
        if kind == Regulated.keyword:
            name = self._needed(given, "function", where, node)
            return Regulated(self._function(given, name, given["function"]))
        if kind != Counter.keyword:
            return Simple() if kind == SHARED else REGULATIONS[kind]()
        usual = Counter()
        maximum = usual.maximum
        if "maximum" in given:
            maximum = self._whole(given["maximum"], f"maximum of {where}")
        thresholds = {
            one: self.nodes.number(given[one], f"{one} of {where}")
            for one in ("increment", "reset")
            if one in given
        }
        return Counter(maximum, **thresholds)

    def _check_fields(
        self,
        kind: str,
        given: dict[str, yaml.Node],
        known: dict[str, tuple[str, ...]],
        where: str,
        node: yaml.Node,
    ) -> None:
        """Refuse an unknown type, and a field that it has not."""
        if kind not in known:
            raise self.nodes.error(
                node, f"{kind!r} as type of {where}", f"one of {', '.join(known)}",
                nearest(kind, known),
            )  # fmt: skip
        for name, value in given.items():
            if name not in known[kind]:
                raise self.nodes.error(
                    value,
                    f"field {name!r} in {where}, of the type {kind}",
                    f"one of {', '.join(known[kind])}" if known[kind] else "none but type",
                    "take it out, or change the type",
                )

    def _needed(self, given: dict[str, yaml.Node], name: str, where: str, node: yaml.Node) -> str:
        if name not in given:
            raise self.nodes.error(node, f"{where} without {name}", f"{name}:", f"add {name}:")
        return self._word(given[name], f"{name} of {where}")

    def _whole(self, node: yaml.Node, where: str) -> int:
        if not self.nodes.is_plain(node) or not text_file.WHOLE_NUMBER.fullmatch(node.value):
            raise self.nodes.wrong(node, where, "a whole number, 0 or more", "write it in digits")
        return int(node.value)

    def _function(
        self, given: dict[str, yaml.Node], name: str, node: yaml.Node, only: bool = False
    ) -> Callable[..., object]:
        """Return a Python function of the file that is named, or of that called as this one."""
        named = self._word(given["file"], "file") if "file" in given else ""
        path = Path(self.file).with_suffix(".py")
        return load_beside(path, named, name, self.file, _line(node), only)

    def _skill(self, name: str, key: yaml.Node, node: yaml.Node) -> Skill:
        where = f"the skill {name!r}"
        given = self.nodes.fields(node, where, SKILL_FIELDS)
        if "function" not in given:
            raise self.nodes.error(key, f"{where} without function", "function:", "add function:")
        with self.lines.placing(_line(key), ades.GENERAL_REMEDY, f"in {where}"):
            inputs = self._links(given, "inputs", Input.parse, where)
            outputs = self._links(given, "outputs", Output.parse, where)
            function = self._internal(given["function"], len(inputs), len(outputs), where)
            return Skill(name, inputs, outputs, function, None, self.file, _line(key))

    def _links(
        self,
        given: dict[str, yaml.Node],
        field: str,
        parse_link: Callable[[str, int], Link],
        where: str,
    ) -> list[Link]:
        items = self.nodes.items(given.get(field, NOTHING), f"{field} of {where}")
        return [
            parse_link(self._word(item, f"one of the {field} of {where}"), _line(item))
            for item in items
        ]

    def _internal(self, node: yaml.Node, inputs: int, outputs: int, where: str) -> InternalFunction:
        where = f"the function of {where}"
        every = tuple(dict.fromkeys(one for held in FUNCTION_FIELDS.values() for one in held))
        kind, given = self._typed(node, where, every)
        self._check_fields(kind, given, FUNCTION_FIELDS, where, node)
        if kind == Programmed.keyword:
            written = self._needed(given, ades.CLASS, where, node)
            return Programmed(self._function(given, written, given[ades.CLASS], True), written)
        if kind == CognitonScheme.keyword:
            source = self._needed(given, ades.SCHEME, where, node)
            entries = self.nodes.entries(given.get("cognitons", NOTHING), f"cognitons of {where}")
            cognitons = {
                str(Input.parse(text, _line(key))): self._word(value, f"the cogniton of {text}")
                for text, key, value in entries
            }
            folder = Path(self.file).parent
            return ades.scheme_function(
                folder, source, cognitons, self.file, _line(given[ades.SCHEME])
            )
        lines = [text_file.Line(f"{network_lines.TYPE}:{kind}", _line(node))]
        for name, value in given.items():
            lines += self._network_lines(name, value, where)
        return network_lines.network_of(self.lines, lines, inputs, outputs, _line(node))

    def _network_lines(self, name: str, node: yaml.Node, where: str) -> list[text_file.Line]:
        """Return a field of a network as lines of an `.ades` file."""
        if name == KERNELS:
            return self._kernels(node, where)
        if name == GRAPH:
            items = self.nodes.items(node, f"{GRAPH} of {where}")
            return [text_file.Line(self._word(item, GRAPH), _line(item)) for item in items]
        keyword = "CONVO_BYPASS" if name == "bypass" else name.upper()
        if name in ("bypass", "passes"):
            return [self._numbers(keyword, node, f"{name} of {where}")]
        return [text_file.Line(f"{keyword}:{self._word(node, f'{name} of {where}')}", _line(node))]

    def _numbers(self, keyword: str, node: yaml.Node, where: str) -> text_file.Line:
        items = self.nodes.items(node, where)
        numbers = [str(self._whole(item, f"a number of {where}")) for item in items]
        return text_file.Line(":".join([keyword, *numbers]), _line(node))

    def _kernels(self, node: yaml.Node, where: str) -> list[text_file.Line]:
        lines = []
        for kernel, item in enumerate(self.nodes.items(node, f"{KERNELS} of {where}")):
            here = f"kernel {kernel} of {where}"
            given = self.nodes.fields(item, here, KERNEL_FIELDS)
            for name in KERNEL_FIELDS:
                if name not in given:
                    raise self.nodes.error(item, f"{here} without {name}", f"{name}:")
            size = self._whole(given["inputs"], f"inputs of {here}")
            links = self.nodes.items(given["links"], f"links of {here}")
            lines.append(text_file.Line(f"CONVO_LAYER:{size}:{len(links)}", _line(item)))
            for neuron, link in enumerate(links):
                keyword = f"CONVO_LINK:{kernel}:{neuron}"
                lines.append(self._numbers(keyword, link, f"neuron {neuron} of {here}"))
        return lines


def _line(node: yaml.Node) -> int:
    """Return the line of a node, from 1."""
    return int(node.start_mark.line) + 1
