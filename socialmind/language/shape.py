"""The shape of a model: what its rules may read and write, without any values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from socialmind.fields import Field

if TYPE_CHECKING:
    from socialmind.worlds.plane.plane import PlaneShape


@dataclass(frozen=True)
class PopulationShape:
    """A population: its fields, its minds of either kind, and the functions of its plans.

    Attributes:
        name: its name.
        fields: the fields of an agent.
        minded: whether its agents have cogniton minds.
        plans: the function of each plan.
        hierarchy: whether its agents have hierarchies of skills.
        weighed: whether these weigh the plans of its cogniton minds.
        own: the fields that a hatched agent does not take from its parent: they are as at birth.
    """

    name: str
    fields: Mapping[str, Field]
    minded: bool = False
    plans: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    hierarchy: bool = False
    weighed: bool = False
    own: tuple[str, ...] = ()


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


@dataclass(frozen=True)
class ModelShape:
    """A model: parameters, globals, populations, the fields of its patches, its phases.

    Attributes:
        name: the model's name, as error messages give it.
        parameters: fields that rules only read.
        variables: fields that rules read and write (NetLogo's globals).
        populations: by name.
        patch: the fields of a patch, or None for a model without a world.
        setup: the phases that run once, before the first tick.
        schedule: the phases of a tick.
        plane: what the model's bodies sense and do on a plane, or None.
    """

    name: str
    parameters: Mapping[str, Field]
    variables: Mapping[str, Field]
    populations: Mapping[str, PopulationShape]
    patch: Mapping[str, Field] | None
    setup: tuple[PhaseShape, ...]
    schedule: tuple[PhaseShape, ...]
    plane: PlaneShape | None = None
