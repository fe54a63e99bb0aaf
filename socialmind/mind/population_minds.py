"""The hierarchies of a population of a model, whose agents act one after another."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.mind.code.drive import AgentHierarchy
from socialmind.mind.code.mind_code import code_of
from socialmind.mind.evaluation import state as states
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.evaluation.steps import Steps
from socialmind.mind.kernel.layout import LIVES


class PopulationMinds:
    """The hierarchies of a population; the agent in slot i is block i, of one lane.

    Args:
        assembly: the hierarchy.
        capacity: how many slots there are.
        seed: the key of the draws of cogniton schemes.
        population: the population's name.
        own_genomes: whether each agent has its own weights.
        instances: how many instances of groups there are.
        drive: the drive module, or None.
        tick: gives the model's tick.

    Raises:
        ModelError: a network's genome is not set.
    """

    def __init__(
        self,
        assembly: Assembly,
        capacity: int,
        seed: int,
        population: str,
        own_genomes: bool,
        instances: int,
        drive: Callable[..., None] | None,
        tick: Callable[[], int],
    ) -> None:
        self.assembly = assembly
        self.own_genomes = own_genomes
        self.seed = seed
        self.instances = instances
        self.code = code_of(assembly, drive)
        self.record = states.Record(assembly, self.code.names)
        self.state = states.new_state(assembly, capacity, 1, own_genomes, instances)
        self.societies = states.societies_of(assembly, seed, capacity, population)
        self.steps: Steps | None = None
        self.tick = tick
        for name in assembly.skills:
            skill = assembly.description.skills[name]
            if skill.genome is not None:
                place_of = assembly.genome_of(name)
                self.state.genome[:, place_of] = skill.genome[:, None]
                self.state.first_genome[0, place_of, 0] = skill.genome
            elif skill.genome_size:
                raise skill.refused("without a genome", f"{skill.genome_size} weights")
        self._connect()

    def _connect(self) -> None:
        self.record.connect(len(self.state.fresh), self.state, self.societies)
        if self.steps is not None:
            self.steps.connect(self.state, self.societies)

    def compile(self) -> None:
        """Make ready for compiled runs."""
        module = self.code.module
        self.record.call(module.evaluate.address, module.renew.address)

    @property
    def bytes(self) -> int:
        """How much memory the state of all agents takes."""
        return sum(array.nbytes for array in self.state)

    def of(self, slot: int) -> AgentHierarchy:
        """Return the hierarchy of the agent in a slot."""
        return AgentHierarchy(self.stepping, slot)

    @property
    def stepping(self) -> Steps:
        """The evaluation of one agent after another."""
        if self.steps is None:
            code = self.code
            self.steps = Steps(
                self.assembly, self.record, code.functions, code.regulations, code.drive, self.tick
            )
            self._connect()
        return self.steps

    # Births -----------------------------------------------------------------------------------

    def begin(self, slot: int) -> None:
        """Begin the life of the agent in a slot."""
        state = self.state
        state.group[slot] = -1
        state.participation[slot] = 1.0
        if self.own_genomes:
            state.genome[slot] = state.first_genome[0]
        self.stepping.restart(slot)
        self._draw_anew(slot)

    def copy(self, parent: int, child: int) -> None:
        """Make the agent in a slot its parent's copy; it is in no group."""
        for name in LIVES:
            array = getattr(self.state, name)
            array[child] = array[parent]
        self.state.group[child] = -1
        self.state.participation[child] = 1.0
        if self.own_genomes:
            self.state.genome[child] = self.state.genome[parent]
        for society in self.societies:
            society.mind_in(child).leave_all_groups()
            society.minds.values[child] = society.minds.values[parent]
        self._draw_anew(child)

    def _draw_anew(self, slot: int) -> None:
        """Let who is born in a slot have draws of its own, whoever was there before."""
        for society in self.societies:
            draws = society.minds.draws
            draws[slot] = ((draws[slot] >> 32) + 1) << 32

    def grow(self, capacity: int) -> None:
        """Make room for more agents."""
        old, own = self.state, self.own_genomes
        fresh = states.new_state(self.assembly, capacity, 1, own, self.instances)
        for name in (*LIVES, *(("genome",) if own else ())):
            getattr(fresh, name)[: len(old.fresh)] = getattr(old, name)
        self.state = fresh._replace(
            genome=fresh.genome if own else old.genome,
            first_genome=old.first_genome,
            instances=old.instances,
            now=old.now,
        )
        added = capacity - len(old.fresh)
        for society in self.societies:
            society.new_minds(added)
        self._connect()

    # Genomes ----------------------------------------------------------------------------------

    def set_genome(self, skill: str, genome: Any, slots: NDArray[np.int64] | None = None) -> None:
        """Set a skill's weights, for all or, with own genomes, for some slots.

        Args:
            skill: its name.
            genome: (genome size,), or (slots, genome size).
            slots: which; all unless given.

        Raises:
            ModelError: no such skill, a wrong size, or a weight that is not a finite number.
        """
        one = self.assembly.description.skill(skill)
        if skill not in self.assembly.skills:
            raise one.refused(f"which the master {self.assembly.master!r} does not reach")
        place = self.assembly.genome_of(skill)
        if slots is not None and not self.own_genomes:
            raise ModelError(
                f"own weights of {skill!r} for some agents", "one genome for all",
                "declare the population with own_genomes=True",
            )  # fmt: skip
        if slots is None:
            weights = one.fitting(genome)
            self.state.genome[:, place, 0] = weights
            self.state.first_genome[0, place, 0] = weights
            return
        several = np.ndim(genome) == 2
        rows = np.array([one.fitting(row) for row in (genome if several else [genome])])
        if several and len(rows) != len(slots):
            raise one.refused(f"with {len(rows)} genomes for {len(slots)} slots", "one for each")
        self.state.genome[slots, place, 0] = rows

    # State ------------------------------------------------------------------------------------

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that a checkpoint keeps."""
        return states.kept(self.state, self.societies)

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Take the arrays of a checkpoint."""
        state = states.restored(self.state, arrays)
        wanted = len(state.fresh) if self.own_genomes else 1
        if len(state.genome) != wanted:
            raise ModelError(f"a state with {len(state.genome)} genomes", str(wanted))
        for number in range(len(self.societies)):
            minds = arrays.get(f"scheme_{number}.mind_id", ())
            if len(minds) < len(state.fresh):
                raise ModelError(f"a state with {len(minds)} minds", f"{len(state.fresh)} or more")
        self.state = state
        states.restore_societies(self.societies, arrays)
        self._connect()
