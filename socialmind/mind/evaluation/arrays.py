"""A mind's description as the arrays that the compiled evaluator reads."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from socialmind.errors import ModelError
from socialmind.mind.description import MindDescription
from socialmind.mind.functions import network
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.kernel import layout
from socialmind.mind.kernel.layout import Structure
from socialmind.mind.links import Input
from socialmind.mind.modules import Skill, Variable
from socialmind.mind.regulation import PARAMETERS, Regulated


@dataclass(frozen=True)
class Assembly:
    """A hierarchy as arrays, and what its numbers mean.

    Attributes:
        description: the mind.
        master: the name of its master skill.
        skills: the names of the evaluated skills, from the top down, as they are numbered.
        structure: the arrays.
        signals: how many signals skills read.
        past: how many past values are kept.
        nodes: how many nodes the largest function needs.
        memory: how many numbers networks remember.
        genome_begin: where each skill's weights begin in the genome of the hierarchy, and its end.
        programs: the programmed functions, as they are numbered, each once.
        schemes: the skills whose functions are cogniton schemes, as they are numbered.
        regulations: the modeller's regulations, as they are numbered.
        shared: the names of the shared variables, as they are numbered.
        codes: its programs as code, by the drive beside them.
    """

    description: MindDescription
    master: str
    skills: tuple[str, ...]
    structure: Structure
    signals: int
    past: int
    nodes: int
    memory: int
    genome_begin: tuple[int, ...]
    programs: tuple[tuple[Programmed, int, int], ...]
    schemes: tuple[str, ...]
    regulations: tuple[Regulated, ...]
    shared: tuple[str, ...]
    codes: dict[Any, Any] = field(default_factory=dict, compare=False, repr=False)

    def genome_of(self, skill: str) -> slice:
        """Return where a skill's weights stand in the genome of the hierarchy."""
        number = self.skills.index(skill)
        return slice(self.genome_begin[number], self.genome_begin[number + 1])

    @property
    def required(self) -> tuple[str, ...]:
        """The sensors that the skills below the master read, in the order of the description."""
        below = self.description.below(self.master)
        read = {
            one.name
            for name in below
            for one in self.description.skills[name].inputs
            if one.module == "sensor"
        }
        return tuple(name for name in self.description.sensors if name in read)


def master_of(description: MindDescription, master: str | None) -> str:
    """Return the name of the master skill, which may be left out where only one can be meant.

    Raises:
        ModelError: there is no such skill, or it is unclear which.
    """
    if master is not None:
        return description.skill(master).name
    found = description.masters
    if len(found) != 1:
        known = ", ".join(found) if found else "it has no skills"
        raise ModelError(
            f"the mind {description.name!r} without a master skill",
            "its name, as in master='Collect'",
            f"no other skill influences: {known}",
        )
    return found[0]


def groups_of(description: MindDescription) -> list[str]:
    """Return the groups of a mind's shared variables, by name."""
    return sorted({one.group for one in description.variables.values() if one.group is not None})


def assemble(
    description: MindDescription, master: str, driven: bool = False, observed: bool = False
) -> Assembly:
    """Lay a mind out in arrays, of which all its societies share all but the sizes.

    Args:
        description: the mind.
        master: the name of its master skill.
        driven: whether a drive may influence skills outside the master's hierarchy.
        observed: whether the outputs of skills without influence are wanted too.
    """
    key, known = (master, driven, observed), description.laid_out
    if key not in known:
        skills = description.order if driven else description.below(master)
        known[key] = _Assembling(description, master, skills, observed).assembly()
    made: Assembly = known[key]
    sizes = made.structure.sizes.copy()  # its own: whoever looks at a society changes it
    sizes.setflags(write=False)
    return replace(made, structure=made.structure._replace(sizes=sizes))


class _Assembling:
    """Collects the arrays of one hierarchy, skill by skill."""

    def __init__(
        self, description: MindDescription, master: str, skills: tuple[str, ...], observed: bool
    ) -> None:
        self.description = description
        self.master = master
        self.skills = skills
        self.observed = observed
        self.sensors = list(description.sensors)
        self.variables = list(description.variables)
        self.plain = len(self.sensors) + len(self.variables)
        self.shared = [name for name, one in description.variables.items() if one.group is not None]
        self.taps: dict[tuple[int, int], int] = {}
        self.programs: list[tuple[Programmed, int, int]] = []
        self.schemes: list[str] = []
        self.regulations: list[Regulated] = []
        self.steps: list[list[int]] = []
        self.node_list: list[int] = []
        self.neurons: list[list[int]] = []
        self.responses: list[float] = []
        self.neuron_sources: list[int] = []
        self.neuron_weights: list[int] = []
        self.genome = 0
        self.memory = 0
        self.nodes = 2  # rows that equation 4.3 adds up in

    def assembly(self) -> Assembly:
        kinds, numbers, keeps, first_outputs = [], [], [], []
        step_begin, input_begin, inputs, genome_begin = [0], [0], [], [0]
        for name in self.skills:
            skill = self.description.skills[name]
            kind, number, keep, first_output = self.function(skill)
            kinds.append(kind)
            numbers.append(number)
            keeps.append(keep)
            first_outputs.append(first_output)
            step_begin.append(len(self.steps))
            inputs += [self.signal(one) for one in skill.inputs]
            input_begin.append(len(inputs))
            genome_begin.append(self.genome)
        entries = [
            (place, output)
            for place, name in enumerate(self.skills)
            for output in self.description.skills[name].outputs
        ]
        counts = [len(self.description.skills[name].outputs) for name in self.skills]
        variables = [self.description.variables[name] for name in self.variables]
        commanded = [("variable", name) for name in self.variables]
        commanded += [("actuator", name) for name in self.description.actuators]
        sources = [self.entries_to(entries, "skill", name) for name in self.skills]
        commands = [self.entries_to(entries, module, name) for module, name in commanded]
        groups = groups_of(self.description)
        rings, lengths = self.rings()
        begins = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64)
        ring_of = {module: place for place, module in enumerate(rings)}
        structure = Structure(
            sizes=_ints(
                [
                    len(self.sensors), len(variables), len(self.description.actuators),
                    len(self.skills), self.skills.index(self.master), int(self.observed),
                ]
            ),
            tap_module=_ints([module for module, _ in self.taps]),
            tap_lag=_ints([lag for _, lag in self.taps]),
            tap_ring=_ints([begins[ring_of[m]] if lag else 0 for m, lag in self.taps]),
            tap_length=_ints([lengths[ring_of[m]] if lag else 1 for m, lag in self.taps]),
            ring_module=_ints(rings),
            ring_begin=_ints(begins[:-1]),
            ring_length=_ints(lengths),
            regulation=_ints([one.regulation.code for one in variables]),
            regulation_number=_ints([self.regulation(one) for one in variables]),
            regulation_parameters=_floats(
                [_padded(one.regulation.parameters) for one in variables], PARAMETERS
            ),
            start=_floats([[one.start, one.regulation.memory(one.start)] for one in variables], 2),
            shared=_ints(
                [
                    self.shared.index(one.name) if one.name in self.shared else -1
                    for one in variables
                ]
            ),
            shared_group=_ints(
                [groups.index(str(self.description.variables[name].group)) for name in self.shared]
            ),
            command_begin=_begins(commands),
            command_entry=_ints([entry for some in commands for entry in some]),
            entry_skill=_ints([place for place, _ in entries]),
            entry_begin=_ints(np.concatenate([[0], np.cumsum(counts)])),
            neutral=np.array([one.neutral for one in self.description.actuators.values()], float),
            skill_kind=_ints(kinds),
            skill_number=_ints(numbers),
            skill_keeps=_ints(keeps),
            source_begin=_begins(sources),
            source_entry=_ints([entry for some in sources for entry in some]),
            input_begin=_ints(input_begin),
            input_signal=_ints(inputs),
            output_node=_ints(first_outputs),
            step_begin=_ints(step_begin),
            steps=_rows(self.steps, layout.STEP_COLUMNS),
            node_list=_ints(self.node_list),
            neurons=_rows(self.neurons, layout.NEURON_COLUMNS),
            neuron_response=np.array(self.responses, float),
            neuron_source=_ints(self.neuron_sources),
            neuron_weight=_ints(self.neuron_weights),
        )  # fmt: skip
        for array in structure:
            array.setflags(write=False)
        return Assembly(
            self.description,
            self.master,
            self.skills,
            structure,
            signals=self.plain + len(self.taps),
            past=int(begins[-1]),
            nodes=self.nodes,
            memory=self.memory,
            genome_begin=tuple(genome_begin),
            programs=tuple(self.programs),
            schemes=tuple(self.schemes),
            regulations=tuple(self.regulations),
            shared=tuple(self.shared),
        )

    # Signals and links ------------------------------------------------------------------------

    def signal(self, one: Input) -> int:
        """Return the number of the signal that an input reads."""
        if one.module == "sensor":
            module = self.sensors.index(one.name)
        else:
            module = len(self.sensors) + self.variables.index(one.name)
        if one.reading == "value":
            return module
        tap = (module, one.ticks)
        return self.plain + self.taps.setdefault(tap, len(self.taps))

    def rings(self) -> tuple[list[int], list[int]]:
        """Return the modules whose past is kept, and how many values of each."""
        longest: dict[int, int] = {}
        for module, lag in self.taps:
            if lag:
                longest[module] = max(longest.get(module, 0), lag)
        return list(longest), [lag + 1 for lag in longest.values()]

    def entries_to(self, entries: Sequence[tuple[int, Any]], module: str, name: str) -> list[int]:
        """Return the entries that go to a module, by the names of the skills they come from."""
        found = [
            (self.skills[place], entry)
            for entry, (place, output) in enumerate(entries)
            if (output.module, output.name) == (module, name)
        ]
        return [entry for _, entry in sorted(found)]

    def regulation(self, variable: Variable) -> int:
        """Return the number of a variable's regulation, if it is the modeller's own."""
        if not isinstance(variable.regulation, Regulated):
            return -1
        if variable.regulation not in self.regulations:
            self.regulations.append(variable.regulation)
        return self.regulations.index(variable.regulation)

    # Functions --------------------------------------------------------------------------------

    def function(self, skill: Skill) -> tuple[int, int, int, int]:
        """Lay out a skill's function: its kind, number, whether it remembers, its output node."""
        inputs, outputs = len(skill.inputs), len(skill.outputs)
        self.nodes = max(self.nodes, inputs + outputs)
        if isinstance(skill.function, Programmed):
            one = (skill.function, inputs, outputs)
            if one not in self.programs:
                self.programs.append(one)
            return layout.PROGRAM, self.programs.index(one), 0, inputs
        if isinstance(skill.function, CognitonScheme):
            self.schemes.append(skill.name)
            return layout.SCHEME, len(self.schemes) - 1, 1, inputs
        drawn = skill.function.network(inputs, outputs)
        if drawn is None:
            raise skill.refused(f"with {skill.function}, which is no network", "a network")
        self.nodes = max(self.nodes, drawn.nodes)
        self.steps += [self.step(step) for step in drawn.steps]
        self.genome += drawn.genome_size
        self.memory += drawn.memory
        return layout.NETWORK, 0, int(drawn.memory > 0), drawn.output

    def step(self, step: Any) -> list[int]:
        """Return a network's step as a row of numbers."""
        row = _STEPS[type(step)](self, step)
        return row + [0] * (layout.STEP_COLUMNS - len(row))

    def dense(self, step: network.Dense) -> list[int]:
        return [
            layout.DENSE, step.source, step.sources, step.target, step.neurons,
            self.genome + step.weights, step.activation,
        ]  # fmt: skip

    def own_inputs(self, step: network.Neurons) -> list[int]:
        first = len(self.neurons)
        for one in step.neurons:
            bias = self.genome + one.bias if one.bias >= 0 else -1
            begin = len(self.neuron_sources)
            self.neurons.append([begin, len(one.sources), bias, one.activation, one.aggregation])
            self.responses.append(one.response)
            self.neuron_sources += one.sources
            self.neuron_weights += [self.genome + weight for weight in one.weights]
        return [layout.NEURONS, first, len(step.neurons), step.target]

    def gather(self, step: network.Gather) -> list[int]:
        first = len(self.node_list)
        self.node_list += step.sources
        return [layout.GATHER, first, len(step.sources), step.target]

    def mix(self, step: network.Mix) -> list[int]:
        first = len(self.node_list)
        for pairs in step.pairs:
            self.node_list.append(len(pairs))
            for pair in pairs:
                self.node_list += pair
        return [layout.MIX, first, len(step.pairs), step.target]

    def recall(self, step: network.Recall) -> list[int]:
        return [layout.RECALL, self.memory + step.memory, step.count, step.target]

    def remember(self, step: network.Remember) -> list[int]:
        return [layout.REMEMBER, step.source, step.count, self.memory + step.memory]


_STEPS: dict[type, Callable[[_Assembling, Any], list[int]]] = {
    network.Dense: _Assembling.dense,
    network.Neurons: _Assembling.own_inputs,
    network.Gather: _Assembling.gather,
    network.Mix: _Assembling.mix,
    network.Recall: _Assembling.recall,
    network.Remember: _Assembling.remember,
}


def _ints(values: Iterable[Any]) -> Any:
    return np.array(list(values), dtype=np.int64)


def _begins(lists: Sequence[Sequence[int]]) -> Any:
    return _ints(np.concatenate([[0], np.cumsum([len(some) for some in lists])]))


def _rows(rows: list[list[int]], columns: int) -> Any:
    return np.array(rows, dtype=np.int64).reshape(len(rows), columns)


def _floats(rows: list[Any], columns: int) -> Any:
    return np.array(rows, dtype=float).reshape(len(rows), columns)


def _padded(numbers: tuple[float, ...]) -> list[float]:
    return [*numbers, *[0.0] * (PARAMETERS - len(numbers))]
