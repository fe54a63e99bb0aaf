"""What a rule may call: on a mind, on a random stream, in `math` and among the built-ins."""

from __future__ import annotations

from dataclasses import dataclass

from socialmind.language.types import BOOL, FLOAT, INT, NONE, Type


@dataclass(frozen=True)
class Named:
    """An argument that names a part of the cognitive scheme, written out as a text."""

    part: str


@dataclass(frozen=True)
class Signature:
    """The arguments of a call, how many of them may be left out at the front, and its result."""

    arguments: tuple[Type | Named, ...]
    result: Type


COGNITON, GROUP, ROLE, CULTURON = (
    Named("cogniton"),
    Named("group"),
    Named("role"),
    Named("culturon"),
)
ATTRIBUTE = Named("attribute")
PLAN = Named("plan")
OTHER = Type("the mind of another")
CHOSEN = Type("the plan that was chosen")

MIND: dict[str, Signature] = {
    "choose_next_plan": Signature((), CHOSEN),
    "feed_back_from_plan": Signature((PLAN, FLOAT), NONE),
    "set_cogniton_value": Signature((COGNITON, FLOAT), NONE),
    "add_to_cogniton_value": Signature((COGNITON, FLOAT), NONE),
    "get_cogniton_value": Signature((COGNITON,), FLOAT),
    "activate_cogniton": Signature((COGNITON,), NONE),
    "deactivate_cogniton": Signature((COGNITON,), NONE),
    "is_active": Signature((COGNITON,), BOOL),
    "create_and_join_group": Signature((GROUP, ROLE), BOOL),
    "join_group": Signature((GROUP, ROLE, INT), BOOL),
    "change_role": Signature((GROUP, ROLE), BOOL),
    "set_participation": Signature((GROUP, FLOAT), NONE),
    "add_to_participation": Signature((GROUP, FLOAT), NONE),
    "get_participation": Signature((GROUP,), FLOAT),
    "get_group_id": Signature((GROUP,), INT),
    "get_group_role_id": Signature((GROUP, ROLE), INT),
    "leave_group": Signature((GROUP,), NONE),
    "leave_all_groups": Signature((), NONE),
    "ask_to_join": Signature((GROUP, ROLE, INT), BOOL),
    "get_asked_group_id": Signature((GROUP,), INT),
    "grant_entry": Signature((GROUP, OTHER), BOOL),
    "refuse_entry": Signature((GROUP, OTHER), BOOL),
    "expel": Signature((GROUP, OTHER), BOOL),
    "enclose_group": Signature((GROUP, INT), BOOL),
    "release_group": Signature((GROUP,), NONE),
    "get_enclosing_group_id": Signature((GROUP,), INT),
    "set_culturon_value": Signature((GROUP, CULTURON, FLOAT), NONE),
    "add_to_culturon_value": Signature((GROUP, CULTURON, FLOAT), NONE),
    "get_culturon_value": Signature((GROUP, CULTURON), FLOAT),
    "set_group_attribute": Signature((GROUP, ATTRIBUTE, FLOAT), NONE),
    "add_to_group_attribute": Signature((GROUP, ATTRIBUTE, FLOAT), NONE),
    "get_group_attribute": Signature((GROUP, ATTRIBUTE), FLOAT),
}
"""The commands of a mind, as `coglogo_py.Mind` spells them."""

IMITATION: dict[str, Signature] = {
    "imitate": Signature((COGNITON,), BOOL),
    "imitate_memes": Signature((), INT),
}
"""Those that take another mind last; its scheme has to have what they name, too."""

SENSOR, ACTUATOR, VARIABLE, SKILL, SHARED = (
    Named("sensor"),
    Named("actuator"),
    Named("variable"),
    Named("skill"),
    Named("group of variables"),
)

HIERARCHY: dict[str, Signature] = {
    "sensor": Signature((SENSOR,), FLOAT),
    "set_sensor": Signature((SENSOR, FLOAT), NONE),
    "evaluate": Signature((), NONE),
    "actuator": Signature((ACTUATOR,), FLOAT),
    "variable": Signature((VARIABLE,), FLOAT),
    "set_variable": Signature((VARIABLE, FLOAT), NONE),
    "influence": Signature((SKILL,), FLOAT),
    "add_influence": Signature((SKILL, FLOAT), NONE),
    "command": Signature((ACTUATOR, FLOAT, FLOAT), NONE),
    "command_variable": Signature((VARIABLE, FLOAT, FLOAT), NONE),
    "join_group": Signature((SHARED, INT, FLOAT), NONE),
    "leave_group": Signature((SHARED,), NONE),
    "restart": Signature((), NONE),
}
"""What rules and drives may do with a hierarchy, as `AgentHierarchy` spells it."""
LEFT_OUT = {"command": 1.0, "command_variable": 1.0, "join_group": 1.0}
"""The last argument of these, a weight or a participation, when it is left out."""
BETWEEN_EVALUATIONS = ("set_sensor", "evaluate", "join_group", "leave_group", "restart")
"""What a drive may not do, as it runs in the middle of an evaluation."""

RNG: dict[str, tuple[Signature, ...]] = {
    "random": (Signature((), FLOAT),),
    "uniform": (Signature((FLOAT, FLOAT), FLOAT),),
    "integers": (Signature((INT,), INT), Signature((INT, INT), INT)),
    "normal": (Signature((FLOAT, FLOAT), FLOAT),),
    "exponential": (Signature((FLOAT,), FLOAT),),
    "gamma": (Signature((FLOAT, FLOAT), FLOAT),),
    "poisson": (Signature((FLOAT,), INT),),
}
"""The draws of a random stream, spelled as NumPy's Generator spells them."""
OF_SEVERAL = ("choice", "permutation", "shuffle")
"""Draws among several values, which `draws` types."""

WRITTEN = {
    "agent.reconsider_plan": "factor",
    "rng.random": "",
    "rng.uniform": "low, high",
    "rng.integers": "low, high",
    "rng.normal": "mean, deviation",
    "rng.exponential": "mean",
    "rng.gamma": "shape, scale",
    "rng.poisson": "mean",
    "math.atan2": "y, x",
    "math.hypot": "x, y",
}
"""How the arguments of a call are called, where errors show them."""

MATH: dict[str, Signature] = {
    **{
        name: Signature((FLOAT,), FLOAT)
        for name in (
            *("sin", "cos", "tan", "asin", "acos", "atan", "tanh", "radians", "degrees"),
            *("exp", "log", "log2", "log10", "sqrt", "fabs"),
        )
    },
    **{name: Signature((FLOAT,), BOOL) for name in ("isnan", "isinf", "isfinite")},
    "atan2": Signature((FLOAT, FLOAT), FLOAT),
    "hypot": Signature((FLOAT, FLOAT), FLOAT),
    "floor": Signature((FLOAT,), INT),
    "ceil": Signature((FLOAT,), INT),
    "trunc": Signature((FLOAT,), INT),
}
"""The functions of `math` that rules may call; `arithmetic` defines them for both speeds."""

MATH_CONSTANTS = ("pi", "e", "tau", "inf", "nan")
"""The constants of `math` that rules may use."""
