"""MIND evaluated in plain Python, for comparison: written from the thesis, slow and plain.

One `Society` holds agents of one mind; `Alone` is a society of one. Equations and figures are those
of thesis chapter 4 and section 5.1.1. Of `socialmind.mind` only descriptions are read.
"""

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from independent_networks import clamped, perceptron, relu, run_network, sigmoid

from socialmind.mind import (
    Counter,
    Input,
    MindDescription,
    Programmed,
    Regulated,
    Simple,
    Skill,
    Variable,
    Wave,
)

Link = tuple[str, str]
"""A skill, and where an output of it goes: ("Collect", "SK:Avoid")."""
Drive = Callable[["Agent"], None]


@dataclass
class Signal:
    """What a sensor or a variable presents to skills: its values at all ticks so far."""

    past: list[float] = field(default_factory=list)

    def value(self) -> float:
        return self.past[-1]

    def derivative(self) -> float:
        """Return 0.5 + (v(t) - v(t-1)) / 2, which is 0.5 at the first tick."""
        before = self.past[-2] if len(self.past) > 1 else self.past[-1]
        return 0.5 + (self.past[-1] - before) / 2.0

    def history(self, ticks: int) -> float:
        """Return the value some ticks ago; before the start, the first value."""
        return self.past[max(0, len(self.past) - 1 - ticks)]


@dataclass
class Sums:
    """What an actuator or a variable receives: Σ commands and Σ influence (equation 4.3)."""

    commands: float = 0.0
    influence: float = 0.0

    def add(self, command: float, influence: float) -> None:
        self.commands += command
        self.influence += influence

    def normalised(self) -> float | None:
        """Return the weighted mean of the commands; None where nothing influences."""
        return self.commands / self.influence if self.influence > 0.0 else None


class VariableModule:
    """A variable of one agent, or of one instance of a group (thesis, 4.3 and 9.2.2).

    `received` holds what each member sent in the last cycle, with its participation.
    """

    def __init__(self, variable: Variable) -> None:
        self.variable = variable
        self.signal = Signal()
        self.value = variable.start
        self.command = 0.0
        self.ever_commanded = False
        self.phase = 0.0
        self.count = 0
        if isinstance(variable.regulation, Counter):
            self.count = round(self.value * variable.regulation.maximum)
        self.memory = 0.0
        self.received: list[tuple[float, Sums]] = []

    def evaluate(self) -> None:
        """Take the commands of the last cycle, regulate, and record the value."""
        sums = Sums()
        for participation, sent in self.received:
            sums.add(participation * sent.commands, participation * sent.influence)
        self.received = []
        before, arrived = self.command, sums.normalised()
        if arrived is not None:
            self.command = arrived
            self.ever_commanded = True
        self.value = self.regulated(before, arrived is not None)
        self.signal.past.append(self.value)

    def regulated(self, before: float, commanded: bool) -> float:
        """Return the variable's value by its regulation process.

        Args:
            before: the command of the cycle before this.
            commanded: whether a command came in the last cycle.
        """
        regulation, command = self.variable.regulation, self.command
        if isinstance(regulation, Simple):
            return command if commanded else self.value
        if isinstance(regulation, Wave):
            self.phase += 0.001 + command * 2.999 if self.ever_commanded else 1.0
            return 0.5 + math.sin(self.phase) / 2.0
        if isinstance(regulation, Counter):
            if before <= regulation.increment < command:
                self.count = self.count + 1 if self.count < regulation.maximum else 0
            if before >= regulation.reset > command:
                self.count = 0
            return self.count / regulation.maximum
        if isinstance(regulation, Regulated):
            asked = {
                "command": command,
                "value": self.value,
                "commanded": commanded,
                "memory": self.memory,
            }
            takes = inspect.signature(regulation.function).parameters
            result = regulation.function(**{name: asked[name] for name in takes})
            if isinstance(result, tuple):
                result, self.memory = result
            return clamped(float(result))
        raise TypeError(f"no regulation that is known here: {regulation}")


class Agent:
    """One agent: its modules' values, and what flowed in the last evaluation.

    Args:
        description: its mind.
        roots: the skills that are evaluated without influence of a parent: the master first.
        genomes: the weights of skills by their names, in place of the description's.
        shared: variables of groups, which other agents hold as well.
    """

    def __init__(
        self,
        description: MindDescription,
        roots: Sequence[str],
        genomes: Mapping[str, Sequence[float]] | None = None,
        shared: Mapping[str, VariableModule] | None = None,
    ) -> None:
        self.description = description
        self.roots = tuple(roots)
        self.skills = top_down(description, roots)
        self.genomes = {
            name: [float(weight) for weight in _genome(description.skills[name], genomes)]
            for name in self.skills
        }
        self.sensors: dict[str, Signal] = {}
        own = shared or {}
        self.variables = {
            name: own.get(name) or VariableModule(variable)
            for name, variable in description.variables.items()
        }
        self.participation = dict.fromkeys(own, 1.0)
        self.memories: dict[str, list[float]] = {name: [] for name in self.skills}
        self.begin()

    def begin(self) -> None:
        """Forget what flowed in the last cycle."""
        self.influences: dict[str, float] = {}
        self.outputs: dict[Link, float] = {}
        self.links: dict[Link, float] = {}
        self.motors = {name: Sums() for name in self.description.actuators}
        self.written: dict[str, Sums] = {}
        self.driven: dict[str, float] = {}

    def sense(self, values: Mapping[str, float]) -> None:
        """Take the sensors' values (figure 5.4, step 1)."""
        for name, value in values.items():
            self.sensors.setdefault(name, Signal()).past.append(float(value))

    # What a drive may do (thesis, 5.1.3), by the names that drives use.

    def sensor(self, name: str) -> float:
        return self.sensors[name].value()

    def variable(self, name: str) -> float:
        return self.variables[name].value

    def set_variable(self, name: str, value: float) -> None:
        module = self.variables[name]
        module.value = value
        module.signal.past[-1] = value

    def add_influence(self, skill: str, value: float) -> None:
        self.driven[skill] = self.driven.get(skill, 0.0) + value

    def command(self, actuator: str, value: float, weight: float = 1.0) -> None:
        self.motors[actuator].add(value * weight, weight)

    def command_variable(self, variable: str, value: float, weight: float = 1.0) -> None:
        self.written.setdefault(variable, Sums()).add(value * weight, weight)

    def evaluate_skills(self) -> None:
        """Let influence flow from the master down to the base skills (equations 4.1 and 4.2)."""
        sent: dict[str, dict[str, float]] = {name: {} for name in self.skills}
        written: dict[str, dict[str, tuple[float, float]]] = {}
        moved: dict[str, dict[str, tuple[float, float]]] = {}
        for name in self.skills:
            skill = self.description.skills[name]
            total = 1.0 if name == self.roots[0] else 0.0
            total += self.driven.get(name, 0.0)
            for parent in sorted(sent[name]):
                total += sent[name][parent]
            self.influences[name] = total
            results = self.function(skill, [self.read(one) for one in skill.inputs])
            for output, result in zip(skill.outputs, results, strict=True):
                transmitted = result * total
                self.outputs[name, str(output)] = result
                self.links[name, str(output)] = transmitted
                if output.module == "skill":
                    sent[output.name][name] = transmitted
                else:
                    into = moved if output.module == "actuator" else written
                    into.setdefault(output.name, {})[name] = (transmitted, total)
        for actuator, sources in moved.items():
            for name in sorted(sources):
                self.motors[actuator].add(*sources[name])
        for variable, sources in written.items():
            for name in sorted(sources):
                self.written.setdefault(variable, Sums()).add(*sources[name])
        for variable, sums in self.written.items():
            share = self.participation.get(variable, 1.0)
            self.variables[variable].received.append((share, sums))

    def read(self, one: Input) -> float:
        """Return what an input of a skill presents."""
        signal = (
            self.sensors[one.name] if one.module == "sensor" else self.variables[one.name].signal
        )
        if one.reading == "history":
            return signal.history(one.ticks)
        return signal.derivative() if one.reading == "derivative" else signal.value()

    def function(self, skill: Skill, values: list[float]) -> list[float]:
        """Return V_O = f(V_I) (equation 4.1), each in [0, 1]."""
        function, genome = skill.function, self.genomes[skill.name]
        if isinstance(function, Programmed):
            return _called(function, values)
        if type(function).__name__ == "Perceptron":
            known: Any = function
            hidden = sigmoid if str(known.hidden).lower() == "sigmoid" else relu
            return perceptron(values, genome, len(skill.outputs), known.layers, known.added, hidden)
        network = function.network(len(skill.inputs), len(skill.outputs))
        if network is None:
            raise TypeError(f"no internal function that is known here: {function}")
        memory = self.memories[skill.name]
        memory.extend([0.0] * (network.memory - len(memory)))
        return run_network(network, values, genome, memory)

    def act(self) -> dict[str, float]:
        """Return the actuators' commands (equation 4.3), neutral without influence."""
        commands = {}
        for name, actuator in self.description.actuators.items():
            command = self.motors[name].normalised()
            commands[name] = actuator.neutral if command is None else command
        return commands

    def values(self) -> dict[str, float]:
        """Return the values of the variables."""
        return {name: module.signal.value() for name, module in self.variables.items()}


class Society:
    """Agents of one mind, and the variables that the members of groups share.

    Args:
        description: the mind of all.
        roots: the master; further skills that a drive may influence.
        agents: how many.
        genomes: for each agent, the weights of skills by name; None for the description's.
        groups: for each group, for each agent: the instance it is in and its participation, or
            None for a variable of its own.
        drive: is called for each agent between steps 2 and 3 of figure 5.4.
    """

    def __init__(
        self,
        description: MindDescription,
        roots: Sequence[str],
        agents: int = 1,
        genomes: Sequence[Mapping[str, Sequence[float]]] | None = None,
        groups: Mapping[str, Sequence[tuple[int, float] | None]] | None = None,
        drive: Drive | None = None,
    ) -> None:
        groups = groups or {}
        instances: dict[tuple[str, int], VariableModule] = {}
        self.agents = []
        for number in range(agents):
            shared, shares = {}, {}
            for name, variable in description.variables.items():
                membership = groups.get(variable.group or "", [None] * agents)[number]
                if membership is not None:
                    instance, shares[name] = membership
                    new = VariableModule(variable)
                    shared[name] = instances.setdefault((name, instance), new)
            own = None if genomes is None else genomes[number]
            agent = Agent(description, roots, own, shared)
            agent.participation = shares
            self.agents.append(agent)
        self.drive = drive

    def evaluate(self, sensors: Sequence[Mapping[str, float]]) -> list[dict[str, float]]:
        """Evaluate all agents once, in the order of figure 5.4; return their motor commands."""
        for agent, values in zip(self.agents, sensors, strict=True):
            agent.begin()
            agent.sense(values)
        modules = [module for agent in self.agents for module in agent.variables.values()]
        for module in {id(module): module for module in modules}.values():
            module.evaluate()
        if self.drive is not None:
            for agent in self.agents:
                self.drive(agent)
        for agent in self.agents:
            agent.evaluate_skills()
        return [agent.act() for agent in self.agents]


class Alone(Society):
    """One agent by itself."""

    def __init__(
        self,
        description: MindDescription,
        *roots: str,
        genomes: Mapping[str, Sequence[float]] | None = None,
        drive: Drive | None = None,
    ) -> None:
        own = None if genomes is None else [genomes]
        super().__init__(description, roots or description.masters, 1, own, None, drive)

    @property
    def agent(self) -> Agent:
        return self.agents[0]

    def step(self, sensors: Mapping[str, float]) -> dict[str, float]:
        """Evaluate it once; return its motor commands."""
        return self.evaluate([sensors])[0]


def top_down(description: MindDescription, roots: Sequence[str]) -> list[str]:
    """Return the skills below roots, each after all that influence it; by name otherwise."""
    found: set[str] = set()
    waiting = list(roots)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting.extend(description.skills[name].subskills)
    order: list[str] = []
    while len(order) < len(found):
        placed = set(order)
        order.extend(
            name
            for name in sorted(found - placed)
            if all(
                parent in placed for parent in found if name in description.skills[parent].subskills
            )
        )
    return order


def _called(function: Programmed, values: list[float]) -> list[float]:
    """Return what a programmed function gives for its inputs."""
    takes = tuple(inspect.signature(function.function).parameters)
    result = function.function(values) if takes == ("inputs",) else function.function(*values)
    several = result if isinstance(result, tuple | list) else (result,)
    return [clamped(float(one)) for one in several]


def _genome(skill: Skill, genomes: Mapping[str, Sequence[float]] | None) -> Sequence[float]:
    if genomes is not None and skill.name in genomes:
        return genomes[skill.name]
    return () if skill.genome is None else list(skill.genome)
