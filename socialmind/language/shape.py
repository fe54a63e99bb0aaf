"""The shape of a model: what its rules may read and write, without any values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

from socialmind.fields import Field
from socialmind.language.plans import PlanSteps, PlanTree, goes_on, steps_of
from socialmind.language.types import AnyType


@dataclass(frozen=True)
class PopulationShape:
    """A population: its fields, its minds of either kind, and the functions of its plans.

    Attributes:
        name: its name.
        fields: the fields of an agent.
        minded: whether its agents have cogniton minds.
        plans: the rule or the tree of each plan.
        hierarchy: whether its agents have hierarchies of skills.
        weighed: whether these weigh the plans of its cogniton minds.
        own: the fields that a hatched agent does not take from its parent: they are as at birth.
        evaluated_by_world: whether a tick of the world evaluates its hierarchies.
        at_birth: the rule that each agent follows once, or None.
        messages_to: of messages, the population of their recipients.
        mailboxes: the messages that its agents get.
    """

    name: str
    fields: Mapping[str, Field]
    minded: bool = False
    plans: Mapping[str, Callable[..., Any] | PlanTree] = field(default_factory=dict)
    hierarchy: bool = False
    weighed: bool = False
    own: tuple[str, ...] = ()
    evaluated_by_world: bool = False
    at_birth: Callable[..., Any] | None = None
    messages_to: str | None = None
    mailboxes: tuple[str, ...] = ()

    @cached_property
    def steps(self) -> PlanSteps | None:
        """The steps of its plans, where some are trees: then an agent stands at one of them."""
        return steps_of(self.plans) if goes_on(self.plans) else None


@dataclass(frozen=True)
class PhaseShape:
    """One phase of a tick: a rule, once or for each agent of a population.

    Attributes:
        rule: the rule.
        population: whose agents it is for, or None for once a tick.
        shuffled: whether the agents come in a fresh random order.
    """

    rule: Callable[..., Any]
    population: str | None = None
    shuffled: bool = True


AGENT = "an agent"
FIELD = "the name of a field of the patches"


@dataclass(frozen=True)
class WorldCall:
    """A call of a world that is no rule, as `model.world.diffuse("pheromone", 0.5)`.

    Interpreted it is the method of the running world. Compiled it is a function of the module,
    `_world_NAME(_model, …)`, for each population of an agent and each field that are named:
    `_world_NAME_KEY`; the world writes those that rules call (`Program.world_calls`).

    Attributes:
        arguments: what it takes: types, AGENT for an agent of any population, FIELD for a written
            name of a field of numbers.
        result: the type of what it returns; FIELD for that of the field.
        written: how to write it, for errors.
        kinds: the Python types that a field may have.
        columns: whole numbers in the model's record that models which call it need.
    """

    arguments: tuple[AnyType | str, ...]
    result: AnyType | str
    written: str
    kinds: tuple[type, ...] = (float, int)
    columns: tuple[str, ...] = ()


class WorldText(NamedTuple):
    """What a world writes into the compiled module of a model.

    Attributes:
        before: what rules call.
        stages: what its tick calls, after the rules and phases.
        tick: the body of a tick; PHASES stands for the calls of the schedule's phases.
        after: what calls ticks, at the end.
    """

    before: str = ""
    stages: str = ""
    tick: str = "PHASES"
    after: str = ""


class WorldShape:
    """What is known of a world before anything runs: nothing, unless a world says otherwise.

    `socialmind.worlds.contract` says how a world is declared, and what it gives a running society.

    Attributes:
        patch: the fields of a patch, or None for a world without patches.
        numbers: whole numbers of the world that rules read, as `model.world.size`: by name, how
            compiled code finds each, an expression of the model's record `_model` or a constant.
        commands: what rules call as `model.world.NAME(agent, …)`: rules of the world and an agent.
        calls: what they call so and is no rule: its text stands in the compiled module.
        extent: how compiled code finds the rectangle that agents are in, in numbers as `Extent` of
            `worlds.contract` has them; empty where nobody is anywhere.
        columns: whole numbers in the model's record that its compiled code needs.
        kept_columns: those of them that are state, not addresses and sizes.
        robots: the populations that sense and act, by name, as the world has them.
        engines: what may move bodies there, the default first.
        dt: seconds a tick.
        has_episodes: whether runs are episodes, which interruptions end, worlds run in lockstep.
    """

    patch: Mapping[str, Field] | None = None
    numbers: Mapping[str, str] = MappingProxyType({})
    commands: Mapping[str, Callable[..., Any]] = MappingProxyType({})
    calls: Mapping[str, WorldCall] = MappingProxyType({})
    extent: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    kept_columns: tuple[str, ...] = ()
    robots: Mapping[str, Any] = MappingProxyType({})
    engines: ClassVar[tuple[str, ...]] = ("compiled",)
    dt: float = 1.0
    has_episodes: ClassVar[bool] = False

    def inhabited(self, population: PopulationShape) -> PopulationShape:
        """Return a population as it is in this world, with what it has there."""
        return population

    def kept_within(self, population: str, field: str) -> tuple[str, ...]:
        """Return the function that brings a place back into the world, and its further arguments.

        They are written into compiled code; the ground's `keeper` says the same interpreted. Empty
        where agents may be anywhere.
        """
        return ()

    def instead_of_setting(self, population: str, field: str) -> str | None:
        """Return what to write where rules set a field that they may not; None where they may."""
        return None

    def leaving(self, population: str) -> str:
        """Return the line of compiled code by which an `agent` that dies leaves the world."""
        return ""

    def typed(self, program: Any) -> Any:
        """Return what the world adds to a program: the functions of its own, typed, or None."""
        return None

    def text(self, program: Any) -> WorldText:
        """Return what the world writes into the compiled module of a program."""
        return WorldText()


@dataclass(frozen=True)
class ModelShape:
    """A model: parameters, globals, populations, its world, its phases.

    Attributes:
        name: the model's name, as error messages give it.
        parameters: fields that rules only read.
        variables: fields that rules read and write (NetLogo's globals).
        populations: by name.
        world: what its rules know of its world.
        setup: the phases that run once, before the first tick.
        schedule: the phases of a tick.
        interactions: by name, what two agents may come to (`agents.interaction.Interaction`).
    """

    name: str
    parameters: Mapping[str, Field]
    variables: Mapping[str, Field]
    populations: Mapping[str, PopulationShape]
    world: WorldShape
    setup: tuple[PhaseShape, ...]
    schedule: tuple[PhaseShape, ...]
    interactions: Mapping[str, Any] = field(default_factory=dict)
