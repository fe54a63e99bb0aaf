"""The state of agents that share a hierarchy: fresh arrays, and the record of where they are."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from coglogo_py import Society
from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.border.numbers import whole_number
from socialmind.compiling.memory import address
from socialmind.errors import ModelError, SocialmindError
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.kernel import layout
from socialmind.mind.kernel.layout import SHARED_COLUMNS, State, array_types

STREAMS = 2**16
"""How many streams of draws a society may have."""
OWN_STREAMS = 256
"""The first ones are for the schemes of populations themselves."""


def new_state(
    assembly: Assembly,
    agents: int,
    lanes: int,
    own_genomes: bool | Collection[str],
    instances: int,
) -> State:
    """Return the state of agents before their first evaluation.

    Args:
        assembly: the hierarchy.
        agents: how many.
        lanes: how many are evaluated in lockstep.
        own_genomes: whether each has its own weights; or the skills of which each has.
        instances: how many instances of groups there are.
    """
    blocks = -(-agents // lanes)
    structure = assembly.structure
    sizes = structure.sizes
    sensors, variables = int(sizes[layout.SENSORS]), int(sizes[layout.VARIABLES])
    actuators, skills = int(sizes[layout.ACTUATORS]), int(sizes[layout.SKILLS])
    entries, shared = len(structure.entry_skill), len(assembly.shared)

    own = own_genomes if isinstance(own_genomes, Collection) else assembly.skills

    def zeros(rows: int) -> NDArray[np.float64]:
        return np.zeros((blocks, rows, lanes))

    starts = np.broadcast_to(structure.start[:, :, None], (variables, 2, lanes))
    instance = np.zeros((instances, shared, SHARED_COLUMNS))
    for number, name in enumerate(assembly.shared):
        place = list(assembly.description.variables).index(name)
        instance[:, number, layout.SHARED_VALUE] = structure.start[place, 0]
        instance[:, number, layout.SHARED_MEMORY] = structure.start[place, 1]
    instance[:, :, layout.SHARED_COMMAND] = np.nan
    instance[:, :, layout.SHARED_TICK] = -1
    return State(
        sensors=zeros(sensors),
        signals=zeros(assembly.signals),
        past=zeros(assembly.past),
        values=zeros(variables) + starts[:, 0],
        before=zeros(variables) + starts[:, 0],
        command=zeros(variables) + np.nan,
        memory=zeros(variables) + starts[:, 1],
        totals=zeros(skills),
        output=zeros(entries),
        sent=zeros(entries),
        drive_influence=zeros(skills),
        drive_command=zeros(variables + actuators),
        drive_weight=zeros(variables + actuators),
        actuators=zeros(actuators) + structure.neutral[:, None],
        remembered=zeros(assembly.memory),
        fresh=np.ones((blocks, lanes), np.int64),
        clock=np.zeros(blocks, np.int64),
        genome=np.zeros(
            (blocks if own_genomes else 1, assembly.genome_begin[-1], lanes if own_genomes else 1)
        ),
        first_genome=np.zeros((1, assembly.genome_begin[-1], 1)),
        common=np.array([int(name not in own) for name in assembly.skills], np.int64),
        individual=np.arange(blocks * lanes).reshape(blocks, lanes),
        nodes=np.zeros((1, assembly.nodes, lanes)),
        group=np.full((blocks, shared, lanes), -1, np.int64),
        participation=np.ones((blocks, shared, lanes)),
        instances=instance,
        now=np.zeros(1, np.int64),
    )


def societies_of(
    assembly: Assembly, seed: int, agents: int, population: str = ""
) -> tuple[Society, ...]:
    """Return the minds of a hierarchy's cogniton schemes; agent i is the mind in slot i.

    A scheme draws from a stream of its skill's name, so that it decides alike in every variant of
    the mind.

    Args:
        assembly: the hierarchy.
        seed: the key of their draws.
        agents: how many.
        population: the population's name, in a model.

    Raises:
        SocialmindError: the seed is none.
    """
    seed = whole_number(seed, "seed", 0, 2**64 - 1, SocialmindError)
    societies = []
    taken: list[int] = []
    for name in assembly.schemes:
        function: Any = assembly.description.skills[name].function
        stream = crc32(f"{population}/{name}".encode()) % (STREAMS - OWN_STREAMS) + OWN_STREAMS
        while stream in taken:
            stream = stream + 1 if stream + 1 < STREAMS else OWN_STREAMS
        taken.append(stream)
        society = Society(function.scheme, seed, stream)
        society.new_minds(agents)
        societies.append(society)
    return tuple(societies)


class Record:
    """The record that tells compiled code where the arrays of minds are.

    Args:
        assembly: the hierarchy.
        names: numbers of the modules that a drive or rules name, as they are looked up.

    Attributes:
        address: where the record itself is.
    """

    def __init__(self, assembly: Assembly, names: NDArray[np.int64]) -> None:
        from socialmind.mind.kernel.record import mind_dtype

        self.assembly = assembly
        self.names = names
        self.record = np.zeros(1, mind_dtype(len(assembly.schemes)))
        self.record["worlds"] = 1
        self.address = address(self.record)
        self.kept: list[NDArray[Any]] = []
        self.keys: NDArray[np.int64] | None = None
        self.scheme_lists = [_scheme_lists(assembly, name) for name in assembly.schemes]

    @property
    def failed_skill(self) -> int:
        """The number of the skill whose program failed, -1 for none."""
        return int(self.record["failed_skill"][0])

    @property
    def failed_agent(self) -> int:
        """The agent whose program failed."""
        return int(self.record["failed_agent"][0])

    def call(self, evaluate: int, renew: int) -> None:
        """Write where the compiled evaluation and the compiled births are."""
        self.record["evaluate"] = evaluate
        self.record["renew"] = renew

    def divide(self, worlds: int, keys: NDArray[np.int64]) -> None:
        """Let the agents be in several worlds, one after another.

        Args:
            worlds: how many, of as many agents and instances of groups each.
            keys: (agents, 2), the words of the key of the draws of each agent's world.
        """
        self.record["worlds"], self.record["keys"] = worlds, address(keys)
        self.keys = keys

    def connect(self, agents: int, state: State, societies: tuple[Society, ...]) -> None:
        """Write where the arrays are; they are kept alive until the next time."""
        arrays: dict[str, NDArray[Any]] = {"names": self.names}
        for prefix, some in (("structure", self.assembly.structure), ("state", state)):
            for name, array in zip(type(some)._fields, some, strict=True):
                arrays[f"{prefix}_{name}"] = array
        for number, society in enumerate(societies):
            for name, array in zip(SchemeArrays._fields, society.arrays, strict=True):
                arrays[f"nested_{number}_scheme_{name}"] = array
            for name, array in zip(MindArrays._fields, society.minds, strict=True):
                arrays[f"nested_{number}_minds_{name}"] = array
            for name, array in self.scheme_lists[number].items():
                arrays[f"nested_{number}_{name}"] = array
        self.record["itself"] = self.address
        self.record["agents"] = agents
        self.record["failed_skill"] = -1
        for name, array in arrays.items():
            self.record[name] = address(array)
            for axis, length in enumerate(array.shape):
                self.record[f"{name}_{axis}"] = length
        self.kept = list(arrays.values())


def _scheme_lists(assembly: Assembly, name: str) -> dict[str, NDArray[Any]]:
    skill = assembly.description.skills[name]
    function = skill.function
    if not isinstance(function, CognitonScheme):
        raise skill.refused("without a cogniton scheme")
    cognitons = [one.name for one in function.scheme.cognitons]
    outputs = [one.name for one in skill.outputs]
    plans = function.scheme.plans
    written = [cognitons.index(one) for one in function.cognitons_of(skill)]
    return {
        "cogniton": np.array(written, np.int64),
        "plan_output": np.array([outputs.index(plan) for plan in plans], np.int64),
        "weights": np.zeros(len(plans)),
        "plans": np.zeros(len(plans), np.int64),
    }


def restored(state: State, arrays: Mapping[str, NDArray[Any]]) -> State:
    """Return a state with the arrays of a copy.

    Raises:
        ModelError: the arrays are not those of this hierarchy.
    """
    found = {}
    for name, (kind, _) in array_types(State).items():
        own = getattr(state, name)
        if name in (*layout.NOT_KEPT, "common"):
            found[name] = own
            continue
        array = np.ascontiguousarray(arrays[name]) if name in arrays else np.zeros(0, kind)
        rows = len(arrays["fresh"]) if name in layout.LIVES and "fresh" in arrays else len(own)
        if name == "genome" and array.ndim:
            rows = len(array)  # one for all, or one for each, as the minds know
        if array.dtype != np.dtype(kind) or array.shape != (rows, *own.shape[1:]):
            raise ModelError(
                f"a state with {name!r} of the shape {array.shape}",
                f"{own.shape}, as the minds have it",
                "restore a state of the same hierarchy",
            )
        found[name] = array.copy()
    group, fresh = found["group"], found["fresh"]
    if group.size and not -1 <= group.min() <= group.max() < len(found["instances"]):
        raise ModelError("a state with members of a group's instance that there is not", "others")
    if len(found["genome"]) not in (1, len(fresh)):
        raise ModelError(f"a state with {len(found['genome'])} genomes", f"1 or {len(fresh)}")
    return State(**found)


def kept(state: State, societies: Iterable[Society]) -> dict[str, NDArray[Any]]:
    """Return copies of all arrays that change, those of cogniton schemes too, by name."""
    arrays = {
        name: one.copy() for name, one in state._asdict().items() if name not in layout.NOT_KEPT
    }
    for number, society in enumerate(societies):
        arrays |= {f"scheme_{number}.{name}": one for name, one in society.state().items()}
    return arrays


def restore_societies(societies: Iterable[Society], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Give the cogniton schemes of minds the arrays that `kept` returned."""
    for number, society in enumerate(societies):
        begin = f"scheme_{number}."
        own = {name: one for name, one in arrays.items() if name.startswith(begin)}
        society.restore({name.removeprefix(begin): one for name, one in own.items()})
