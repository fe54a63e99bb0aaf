"""A mind written as one YAML file, as `yaml_reader` reads it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from coglogo_py.files.yaml_text import name_text
from socialmind.errors import ModelError
from socialmind.mind.files.companion_files import Texts, add_function, file_name, write
from socialmind.mind.files.evoagents import genome_file
from socialmind.mind.files.evoagents.ades import CLASS, SCHEME, program_name, scheme_name
from socialmind.mind.files.evoagents.network_lines import network_lines
from socialmind.mind.files.evoagents.vardesc import SHARED, check_shared
from socialmind.mind.files.yaml_reader import GENOMES, GRAPH, KERNELS
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Actuator, Modules, Sensor, Skill, Variable
from socialmind.mind.regulation import Counter, Regulated

FUNCTIONS, SCHEMES = ".functions", ".schemes"
"""The ends of the names of the folders that hold programs and schemes."""
HEADER = "# A mind for socialmind. docs/minds_files.md describes the form.\n"
WIDTH = 100
PLAIN = re.compile(r"[A-Za-z_][\w.+-]*( [\w.+-]+)*(:[A-Za-z_][\w.+-]*)*(:[0-9]+)?", re.A)
"""Texts that need no quotes, but for the words that YAML takes for something else."""


def save(description: Modules, path: Path) -> None:
    """Write a mind's YAML file, with weights, programs and schemes beside it.

    Raises:
        ModelError: the mind does not go into such files, or they cannot be written.
    """
    texts: Texts = {}
    schemes: dict[Path, CognitonScheme] = {}
    genomes = path.with_name(path.stem + GENOMES)
    for skill in description.skills.values():
        if skill.genome is not None:
            file = genomes / file_name(skill.name, ".genome")
            texts[file] = genome_file.written(skill)
    for file in sorted(genomes.glob("*.genome")):
        if file not in texts:
            raise ModelError(
                f"{file.name}, weights that the mind {description.name!r} to be saved has not",
                "weights of its skills only",
                "take it out, or save under another name",
                file,
            )
    texts[path] = _Writer(description, path, texts, schemes).text()
    write(texts, schemes)


@dataclass(frozen=True)
class _Writer:
    """The text of a mind; notes the files that belong to it."""

    mind: Modules
    path: Path
    texts: Texts
    schemes: dict[Path, CognitonScheme]

    def text(self) -> str:
        lines = [f"name: {_text(self.mind.name)}"]
        lines += _section("sensors", {n: _sensor(one) for n, one in self.mind.sensors.items()})
        lines += _section(
            "actuators", {name: _actuator(one) for name, one in self.mind.actuators.items()}
        )
        lines += _section(
            "variables", {name: self._variable(one) for name, one in self.mind.variables.items()}
        )
        if self.mind.skills:
            lines.append("skills:")
        for skill in self.mind.skills.values():
            lines.append(f"  {_text(skill.name)}:")
            lines += _list("inputs", map(str, skill.inputs), "    ")
            lines += _list("outputs", map(str, skill.outputs), "    ")
            lines += self._function(skill)
        return HEADER + "\n".join(lines) + "\n"

    def _beside(self, ending: str) -> Path:
        return self.path.with_name(self.path.stem + ending)

    def _variable(self, variable: Variable) -> str:
        regulation = variable.regulation
        fields: dict[str, str] = {}
        if variable.default is not None:
            fields["default"] = _number(variable.default)
        kind = regulation.keyword
        if variable.group is not None:
            check_shared(variable)
            kind = SHARED
            fields["group"] = _text(variable.group)
        if isinstance(regulation, Counter):
            fields["maximum"] = str(regulation.maximum)
            fields["increment"] = _number(regulation.increment)
            fields["reset"] = _number(regulation.reset)
        if isinstance(regulation, Regulated):
            fields["function"] = _text(regulation.function.__name__)
            fields["file"] = self._python_file(regulation.function, ())
        return _module(kind, fields)

    def _python_file(self, function: Any, names: tuple[str, ...]) -> str:
        """Note a function's file; return its path from the YAML file."""
        folder = self._beside(FUNCTIONS)
        held: Texts = {}
        name = add_function(function, folder, held, names)
        for file, text in held.items():
            if self.texts.setdefault(file, text) != text:
                raise ModelError(
                    f"two functions for {file}", "functions with names of their own",
                    "rename one of them",
                )  # fmt: skip
        return _text(f"{folder.name}/{name}")

    def _function(self, skill: Skill) -> list[str]:
        function = skill.function
        if isinstance(function, Programmed):
            name = program_name(function)
            file = self._python_file(function.function, (name,))
            return [
                f"    function: {_module(function.keyword, {CLASS: _text(name), 'file': file})}"
            ]
        if isinstance(function, CognitonScheme):
            file_of = self._beside(SCHEMES) / scheme_name(skill, function)
            if self.schemes.setdefault(file_of, function).scheme != function.scheme:
                file_of = self._beside(SCHEMES) / file_name(skill.name, ".yaml")
                self.schemes[file_of] = function
            fields = {SCHEME: _text(f"{file_of.parent.name}/{file_of.name}")}
            pairs = [f"{_text(one)}: {_text(to)}" for one, to in function.cognitons.items()]
            if pairs:
                fields["cognitons"] = "{" + ", ".join(pairs) + "}"
            return [f"    function: {_module(function.keyword, fields)}"]
        if isinstance(function, NeatGraph) and skill.genome is not None:
            # The graph evolves together with its weights, and so it stands in their file.
            function = NeatGraph()
        return _network(function)


def _network(function: InternalFunction) -> list[str]:
    """Return the lines of a network."""
    kind, *lines = (line.partition(":")[2] for line in network_lines(function))
    if isinstance(function, NeatGraph):
        graph = [] if function.inputs is None else function.to_lines()
        shown = ["    function:", f"      type: {kind}", f"      {GRAPH}:"]
        shown += [f"        - {_text(line)}" for line in graph]
        return shown if graph else [f"    function: {kind}"]
    layers, hidden, added = lines[:3]
    fields = {"layers": layers, "hidden_transfer": hidden, "hidden_neuron_added": added}
    if isinstance(function, InfluenceNetwork):
        fields |= {"branches": str(function.branches), "gates": function.gates.upper()}
        if function.passes:
            fields["passes"] = _numbers(function.passes)
    if not isinstance(function, Convolution):
        return [f"    function: {_module(kind, fields)}"]
    shown = ["    function:", f"      type: {kind}"]
    shown += [f"      {name}: {value}" for name, value in fields.items()]
    shown += [f"      bypass: {_numbers(function.bypass)}"] if function.bypass else []
    shown.append(f"      {KERNELS}:")
    for kernel in function.kernels:
        shown += [f"        - inputs: {kernel.size}", "          links:"]
        shown += [f"            - {_numbers(read)}" for read in kernel.links]
    return shown


def _section(name: str, modules: Mapping[str, str]) -> list[str]:
    if not modules:
        return []
    return [f"{name}:", *(f"  {_text(one)}: {what}".rstrip() for one, what in modules.items())]


def _sensor(sensor: Sensor) -> str:
    fields = {}
    if sensor.parameters:
        fields["parameters"] = f"[{', '.join(map(_text, sensor.parameters))}]"
    return _module(_text(sensor.kind) if sensor.kind else "", fields)


def _actuator(actuator: Actuator) -> str:
    fields = {}
    if actuator.neutral != 0.5:
        fields["neutral"] = _number(actuator.neutral)
    if actuator.parameters:
        fields["parameters"] = f"[{', '.join(map(_text, actuator.parameters))}]"
    return _module(_text(actuator.kind) if actuator.kind else "", fields)


def _module(kind: str, fields: Mapping[str, str]) -> str:
    """Return what a module is: its type alone, or a mapping with its fields."""
    if not fields:
        return kind
    given = ([f"type: {kind}"] if kind else []) + [f"{name}: {v}" for name, v in fields.items()]
    return "{" + ", ".join(given) + "}"


def _list(field: str, texts: Iterable[str], indent: str) -> list[str]:
    """Return a field of several texts, on one line if they fit."""
    shown = [_text(text) for text in texts]
    line = f"{indent}{field}: [{', '.join(shown)}]"
    if len(line) <= WIDTH:
        return [line]
    return [f"{indent}{field}:", *(f"{indent}  - {text}" for text in shown)]


def _numbers(numbers: Iterable[int]) -> str:
    return f"[{', '.join(map(str, numbers))}]"


def _number(value: float) -> str:
    return repr(float(value)).removesuffix(".0")


def _text(text: str) -> str:
    return name_text(text, PLAIN)
