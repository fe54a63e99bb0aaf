"""Minds: any number of agents that share a hierarchy, evaluated together by compiled code."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.closed import Closed
from coglogo_py.border.memory import check_memory
from coglogo_py.border.numbers import is_whole, whole_number
from socialmind.errors import ModelError, SocialmindError
from socialmind.mind.code.mind_code import code_of
from socialmind.mind.description import MindDescription
from socialmind.mind.evaluation import state as states
from socialmind.mind.evaluation.arrays import Assembly, assemble, groups_of, master_of
from socialmind.mind.evaluation.failures import failure_of, failure_of_drive, failure_of_regulation
from socialmind.mind.kernel.layout import LIVES, NOT_KEPT, State
from socialmind.mind.kernel.record import A_REGULATION, RESTARTED
from socialmind.mind.names import unknown
from socialmind.mind.regulation import Counter
from socialmind.names import several
from socialmind.work.packing import packed, unpacked

LANES = 256
"""How many agents are evaluated in lockstep: the more, the longer the vectors; all nodes of a
network for so many agents still fit into a core's own cache."""


class Minds(Closed):
    """Many agents with one hierarchy: all share a genome, or each has its own.

    Every agent has its own sensors, variables and memory.

    Args:
        description: the mind.
        master: the name of its master skill; may be left out where no other skill influences
            exactly one.
        agents: how many, 1 or more.
        own_genomes: whether each agent has weights of its own; or the names of the skills whose
            weights these are, while all agents share those of the others.
        seed: the key of the draws of cogniton schemes, 0 … 2⁶⁴ − 1.
        drive: the drive module (thesis, 5.1.3): a plain function `drive(mind)`; see
            `socialmind.mind.code.drive`.
        instances: how many instances of groups there are, for shared variables.
        lanes: how many agents are evaluated in lockstep.

    Raises:
        ModelError: no such master, or a programmed function outside the language of rules.

    >>> from socialmind.mind import MindDescription, Perceptron, Skill
    >>> seek = Skill("Seek", ["SE:EyeL", "SE:EyeR"], ["MO:MotL", "MO:MotR"], Perceptron(layers=0))
    >>> vehicle = MindDescription("vehicle", ["EyeL", "EyeR"], ["MotL", "MotR"], [], [seek])
    >>> minds = Minds(vehicle, agents=3)
    >>> minds.set_genome("Seek", [0, 1, 0, 1, 0, 0])  # each motor follows the eye across
    >>> minds.evaluate({"EyeL": [0.1, 0.2, 0.3], "EyeR": 0.5})["MotR"]
    array([0.1, 0.2, 0.3])
    """

    def __init__(
        self,
        description: MindDescription,
        master: str | None = None,
        agents: int = 1,
        own_genomes: bool | Iterable[str] = False,
        seed: int = 0,
        drive: Callable[..., None] | None = None,
        instances: int = 0,
        lanes: int = LANES,
    ) -> None:
        for what, number, least in (
            ("agents", agents, 1), ("instances", instances, 0), ("lanes", lanes, 1),
        ):  # fmt: skip
            whole_number(number, what, least, error=SocialmindError)
        self.description = description
        self.master = master_of(description, master)
        agents, instances, lanes = int(agents), int(instances), int(lanes)
        self.assembly: Assembly = assemble(description, self.master, drive is not None)
        self.agents = int(agents)
        self.lanes = int(min(lanes, agents))
        if not isinstance(own_genomes, bool):
            names = several(own_genomes, "own_genomes")
            for name in names:
                _place(self.assembly.skills, str(name), "skill")
            own_genomes = names or False
        self.own_genomes: bool | tuple[str, ...] = own_genomes
        self.seed = seed
        self.drive = drive
        skills = description.skills
        self.unset = {name for name in self.assembly.skills if skills[name].genome_size}
        self._evaluate: Any = None
        self._code = code_of(self.assembly, drive)
        self._record = states.Record(self.assembly, self._code.names)
        one = states.new_state(self.assembly, 1, 1, own_genomes, 0)
        needed = agents * sum(array.nbytes for array in one)
        check_memory(needed, f"{agents} minds {description.name!r}", SocialmindError)
        self.state_arrays = states.new_state(
            self.assembly, agents, self.lanes, own_genomes, instances
        )
        self.societies = states.societies_of(self.assembly, seed, agents)
        self._record.connect(agents, self.state_arrays, self.societies)
        for name in self.assembly.skills:
            genome = description.skills[name].genome
            if genome is not None:
                self.set_genome(name, genome)
        self._closed = True

    @property
    def address(self) -> int:
        """Where compiled code finds these minds; it may call them from now on."""
        module = self._code.module
        self._record.call(module.evaluate.address, module.renew.address)
        return self._record.address

    # Evaluating -------------------------------------------------------------------------------

    def evaluate(self, sensors: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
        """Evaluate all agents once (thesis, figure 5.4).

        Args:
            sensors: for each sensor that the skills read, a number, 0 … 1, or an array (agents,).

        Returns:
            For each actuator its commands, (agents,).

        Raises:
            ModelError: a sensor is missing, unknown or outside [0, 1], or a genome is not set.
        """
        missing = [name for name in self.assembly.required if name not in sensors]
        if missing:
            raise ModelError(f"no value for the sensor {missing[0]!r}", "one for each agent")
        for name, values in sensors.items():
            self.set_sensor(name, values)
        self.step()
        return {name: self.actuator(name) for name in self.description.actuators}

    def step(self) -> None:
        """Evaluate all agents once on the sensors as they are set; nothing is allocated.

        Raises:
            ModelError: a sensor is outside [0, 1], or a genome is not set; or a program failed,
                which leaves the step half done: go back by `restore` or `reset`.
        """
        if self.unset:
            raise self.description.skills[next(iter(self.unset))].without_genome()
        blocks = len(self.state_arrays.fresh)
        if self._evaluate is None:
            self._evaluate = self._code.module.evaluate.ctypes
        if self._evaluate(self._record.address, 0, blocks) != 0:
            raise self.failure()
        self.state_arrays.now[0] += 1

    @property
    def failed_agent(self) -> int:
        """The agent whose program failed in the last evaluation, -1 for none."""
        return self._record.failed_agent

    def failure(self) -> ModelError:
        """Return the error that names what failed in the last evaluation, and the agent."""
        for name in self.description.sensors:
            values = self.sensor(name)
            bad = np.flatnonzero(~((values >= 0) & (values <= 1)))
            if len(bad):
                return ModelError(
                    f"{values[bad[0]]} for the sensor {name!r} of agent {bad[0]}",
                    "a number, 0 … 1",
                )
        number, agent = self._record.failed_skill, self._record.failed_agent
        if number <= A_REGULATION:
            variable = list(self.description.variables.values())[A_REGULATION - number]
            return failure_of_regulation(variable, agent)
        if number < 0:
            return failure_of_drive(self.drive, agent)
        skill = self.description.skills[self.assembly.skills[number]]
        return failure_of(skill, agent, self.state_arrays.nodes[0, :, agent % self.lanes])

    # Modules ----------------------------------------------------------------------------------

    def set_sensor(self, name: str, values: Any) -> None:
        """Set a sensor of all agents, by a number in [0, 1] or an array (agents,)."""
        place = _place(self.description.sensors, name, "sensor")
        self._write(self.state_arrays.sensors[:, place], values, f"the sensor {name!r}")

    def sensor(self, name: str) -> NDArray[np.float64]:
        """Return the values of a sensor, (agents,), as they are set."""
        place = _place(self.description.sensors, name, "sensor")
        return self._read(self.state_arrays.sensors[:, place])

    def actuator(self, name: str) -> NDArray[np.float64]:
        """Return an actuator's commands of the last evaluation, (agents,)."""
        place = _place(self.description.actuators, name, "actuator")
        return self._read(self.state_arrays.actuators[:, place])

    def variable(self, name: str) -> NDArray[np.float64]:
        """Return the values of a variable, (agents,)."""
        place = _place(self.description.variables, name, "variable")
        return self._read(self.state_arrays.values[:, place])

    def set_variable(self, name: str, values: Any) -> None:
        """Set a variable of all agents; one that is not shared in a group.

        Raises:
            ModelError: a value outside [0, 1].
        """
        place = _place(self.description.variables, name, "variable")
        found = _numbers(values, f"the variable {name!r}")
        if not ((found >= 0) & (found <= 1)).all():
            raise ModelError(f"{values} for the variable {name!r}", "numbers, 0 … 1")
        self._write(self.state_arrays.values[:, place], found, f"the variable {name!r}")
        regulation = self.description.variables[name].regulation
        if isinstance(regulation, Counter):
            counts = np.floor(found * regulation.maximum + 0.5)
            self._write(self.state_arrays.memory[:, place], counts, f"the variable {name!r}")

    def influence(self, skill: str) -> NDArray[np.float64]:
        """Return the sum of the influence that a skill received, (agents,)."""
        place = _place(self.assembly.skills, skill, "skill")
        return self._read(self.state_arrays.totals[:, place])

    def _read(self, lanes: NDArray[Any]) -> NDArray[Any]:
        return lanes.reshape(-1)[: self.agents].copy()

    def _write(self, lanes: NDArray[Any], values: Any, what: str) -> None:
        found = _numbers(values, what)
        if found.ndim == 0:
            lanes[...] = found
            return
        if found.shape != (self.agents,):
            raise ModelError(
                f"values of the shape {found.shape} for {what}",
                f"({self.agents},), one for each agent",
            )
        full, rest = divmod(self.agents, self.lanes)
        lanes[:full] = found[: full * self.lanes].reshape(full, self.lanes)
        if rest:
            lanes[full, :rest] = found[full * self.lanes :]

    # Genomes ----------------------------------------------------------------------------------

    def genome(self, skill: str) -> NDArray[np.float64]:
        """Return a skill's weights: (genome size,), or (agents, genome size) of each its own."""
        weights = self._weights(skill)
        if not self._each_has_own(skill):
            return weights[0, :, 0].copy()
        return np.moveaxis(weights, 2, 1).reshape(-1, weights.shape[1])[: self.agents].copy()

    def set_genome(self, skill: str, genome: Any) -> None:
        """Set a skill's weights.

        Args:
            skill: its name.
            genome: (genome size,) for all agents, or (agents, genome size) where each has its own.

        Raises:
            ModelError: a wrong size, or a weight that is not a finite number.
        """
        weights = self._weights(skill)
        one = self.description.skills[skill]
        found = _numbers(genome, f"the genome of the skill {skill!r}")
        if found.ndim == 2 and self._each_has_own(skill):
            if found.shape != (self.agents, one.genome_size):
                raise one.refused(
                    f"with genomes of the shape {found.shape}",
                    f"{(self.agents, one.genome_size)}: agents, weights",
                )
            if not np.isfinite(found).all():
                raise one.refused("with a weight that is not finite", "finite numbers")
            self._part_individuals()
            for agent in range(0, self.agents, self.lanes):
                some = found[agent : agent + self.lanes]
                weights[agent // self.lanes, :, : len(some)] = some.T
        else:
            weights[...] = one.fitting(found)[:, None]
        self.unset.discard(skill)

    def _part_individuals(self) -> None:
        """Let no two agents count as one individual any more: their weights may differ."""
        numbers = self.state_arrays.individual
        numbers[...] = np.arange(numbers.size).reshape(numbers.shape)

    def _each_has_own(self, skill: str) -> bool:
        own = self.own_genomes
        return own if isinstance(own, bool) else skill in own

    def _weights(self, skill: str) -> NDArray[np.float64]:
        """Return where a skill's weights are: (blocks, weights, lanes), or (1, weights, 1)."""
        number, state = _place(self.assembly.skills, skill, "skill"), self.state_arrays
        common = state.common[number] != 0
        return (state.first_genome if common else state.genome)[:, self.assembly.genome_of(skill)]

    # Worlds -----------------------------------------------------------------------------------

    def divide(self, worlds: int, population: str) -> None:
        """Let the agents be a population's of several worlds, those of one after another's.

        Cogniton schemes then draw as in each world alone, by its own key, which compiled code
        writes; and each world has its own instances of groups.

        Args:
            worlds: how many; agents and instances are shared out among them evenly.
            population: the population's name, as in a model.
        """
        self.societies = states.societies_of(self.assembly, self.seed, self.agents, population)
        for society in self.societies:
            society.minds.mind_id[: self.agents] = np.arange(self.agents) % (self.agents // worlds)
        self._record.divide(worlds, np.zeros((self.agents, 2), np.int64))
        self._record.connect(self.agents, self.state_arrays, self.societies)

    # Groups -----------------------------------------------------------------------------------

    def join(
        self, group: str, agents: Any, instance: int | None, participation: float = 1.0
    ) -> None:
        """Make agents members of an instance of a group, whose shared variables they then see.

        Args:
            group: the group of one or more variables.
            agents: the numbers of the agents.
            instance: 0 … instances − 1; None to leave the group.
            participation: how much their commands count, 0 or more.

        Raises:
            ModelError: no variable is shared in such a group, or there is no such instance.
        """
        variables = self.description.variables
        groups = groups_of(self.description)
        if group not in groups:
            raise unknown("group of variables", group, groups)
        count = len(self.state_arrays.instances)
        if instance is not None and not (is_whole(instance) and 0 <= instance < count):
            raise ModelError(
                f"the instance {instance!r} of the group {group!r}",
                f"0 … {count - 1}" if count else "Minds(…, instances=N)",
            )
        part = _numbers(participation, "a participation")
        if part.ndim or not 0 <= part < np.inf:
            raise ModelError(f"a participation of {participation}", "a number, 0 or more")
        numbers = self._numbers_of(agents)
        blocks, lanes = numbers // self.lanes, numbers % self.lanes
        for number, name in enumerate(self.assembly.shared):
            if variables[name].group == group:
                joined = -1 if instance is None else instance
                self.state_arrays.group[blocks, number, lanes] = joined
                self.state_arrays.participation[blocks, number, lanes] = part

    # State ------------------------------------------------------------------------------------

    def reset(self, agents: Any = None) -> None:
        """Put agents back to before their first evaluation; genomes and groups stay.

        Args:
            agents: their numbers; None for all, and then the groups' shared variables too.

        Raises:
            ModelError: there is no such agent.
        """
        if agents is None:
            fresh = states.new_state(
                self.assembly, self.agents, self.lanes, False, len(self.state_arrays.instances)
            )
            for name in (*LIVES, "instances", "now"):
                if name not in ("group", "participation"):
                    getattr(self.state_arrays, name)[...] = getattr(fresh, name)
            self.societies = states.societies_of(self.assembly, self.seed, self.agents)
            self._record.connect(self.agents, self.state_arrays, self.societies)
            return
        renew = self._code.module.renew.ctypes
        for agent in self._numbers_of(agents).tolist():
            renew(self._record.address, agent, RESTARTED)

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays that change, by name; `restore` takes them back."""
        return states.kept(self.state_arrays, self.societies)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take back what `state` returned.

        Raises:
            ModelError: it is the state of other minds.
        """
        for name, own in zip(State._fields, self.state_arrays, strict=True):
            found = own if name in (*NOT_KEPT, "common") else state.get(name)
            if found is None or found.shape != own.shape:
                raise ModelError(
                    f"a state without {name!r}" if found is None
                    else f"a state with {name!r} of the shape {found.shape}",
                    f"{own.shape}, that of {self!r}",
                    "restore a state of as many agents and lanes with the same hierarchy",
                )  # fmt: skip
        own = self.state_arrays.common
        if not np.array_equal(state.get("common", np.zeros_like(own)), own):
            raise ModelError(
                "a state of minds with own genomes of other skills",
                f"own_genomes={self.own_genomes!r}",
            )
        self.state_arrays = states.restored(self.state_arrays, state)
        self._part_individuals()
        states.restore_societies(self.societies, state)
        self._record.connect(self.agents, self.state_arrays, self.societies)

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked_minds, (packed(self._parts()),)

    def __copy__(self) -> Minds:
        return _remade(*self._parts())

    def __deepcopy__(self, memo: dict[int, Any]) -> Minds:
        return _remade(*self._parts())

    def _parts(self) -> tuple[tuple[Any, ...], set[str], dict[str, NDArray[Any]]]:
        """Return what the minds are made of anew: settings, genomes not set yet, and state."""
        settings = (
            self.description, self.master, self.agents, self.own_genomes, self.seed, self.drive,
            len(self.state_arrays.instances), self.lanes,
        )  # fmt: skip
        return settings, set(self.unset), self.state()

    def _numbers_of(self, agents: Any) -> NDArray[np.int64]:
        """Return the numbers of agents, one or several, as an array."""
        found = np.atleast_1d(np.asarray(agents))
        if found.size == 0:
            return np.zeros(0, np.int64)
        if found.ndim != 1 or found.dtype.kind not in "iu":
            raise ModelError(f"{agents!r} as agents", "their numbers", "for a mask, flatnonzero")
        bad = found[(found < 0) | (found >= self.agents)]
        if len(bad):
            raise ModelError(f"the agent {bad[0]}", f"0 … {self.agents - 1}")
        return found.astype(np.int64)

    def __len__(self) -> int:
        return self.agents

    def __repr__(self) -> str:
        return f"<{self.agents} minds {self.description.name!r} with the master {self.master!r}>"


def _unpacked_minds(content: bytes) -> Minds:
    return _remade(*unpacked(content))


def _remade(settings: tuple[Any, ...], unset: set[str], state: Mapping[str, NDArray[Any]]) -> Minds:
    """Return minds in a state."""
    made = Minds(*settings)
    made.restore(state)
    made.unset = set(unset)
    return made


def _numbers(values: Any, what: str) -> NDArray[np.float64]:
    """Return values as an array of numbers.

    Raises:
        ModelError: they are none.
    """
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        raise ModelError(f"{values!r} for {what}", "numbers") from None


def _place(modules: Collection[str], name: str, what: str) -> int:
    """Return the number of a module.

    Raises:
        ModelError: there is none of this name.
    """
    if name not in modules:
        raise unknown(what, name, modules)
    return list(modules).index(name)
