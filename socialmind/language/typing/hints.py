"""What a rule has in place of a name it does not know; many are what NetLogo, Mesa or NumPy have.

Each function gives the advice of one refusal. `{agent}` stands for the agent of the rule, `{all}`
for a population of the model.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from types import FunctionType
from typing import TYPE_CHECKING, Any

from socialmind.errors import close, nearest
from socialmind.language.refusals import MODULES
from socialmind.language.types import RowType
from socialmind.language.typing.signatures import MATH, MATH_CONSTANTS

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

_LOOP = "write a for loop: `for other in model.{all}:`"
_LINKED = "write model.friends.{}; the model declares its network: friends = Network({{all}})"
_DRAW = "draw from the rule's stream: `rng.random()`, with the parameter `rng`"
_HERE = "write model.world.patch({agent}.x, {agent}.y)"
_AROUND = (
    "write `for patch in model.world.neighbours({agent}):`, and of agents "
    "`for other in model.{all}.neighbours({agent}):`"
)
_FOUR = _AROUND.replace("neighbours", "neighbours4")
_NEAR = "write `for other in model.{all}.near({agent}, radius):`"
_ON = "write `for other in model.{all}.on({agent}):`, which leaves the agent itself out"

_ADVANCE = "a society runs as long as `advance()` or the run says, or until `stop_when`"

NAMES = {
    **dict.fromkeys(("np", "numpy"), MODULES["numpy"]),
    **dict.fromkeys(("true", "TRUE"), "write True"),
    **dict.fromkeys(("false", "FALSE"), "write False"),
    **dict.fromkeys(("null", "none", "nobody", "NULL"), "write `is None` on a field"),
    **dict.fromkeys(("ask", "turtles", "agents", "other"), _LOOP),
    **dict.fromkeys(("ticks", "tick"), "write model.tick"),
    "patches": "write `for patch in model.world.patches:`",
    "patch": "write model.world.patch(x, y)",
    "patch_here": _HERE,
    **dict.fromkeys(("neighbors", "neighbours", "get_neighbors"), _AROUND),
    **dict.fromkeys(("neighbors4", "neighbours4"), _FOUR),
    **dict.fromkeys(("in_radius", "near"), _NEAR),
    **dict.fromkeys(("turtles_here", "turtles_on", "other_turtles_here"), _ON),
    **dict.fromkeys(("min_one_of", "nearest"), "write model.{all}.nearest({agent})"),
    "at_points": "write a for loop over the pairs, and `for other in "
    "model.{all}.on(model.world.patch({agent}.x + dx, {agent}.y + dy)):` in it",
    "one_of": "write model.{all}.one_of(rng)",
    "n_of": "count in a for loop, with model.{all}.one_of(rng)",
    "count": "write len(model.{all}), or count in a for loop",
    "mean": "write model.{all}.mean('energy'), with the name of a field",
    "fd": "write model.world.forward({agent}, length)",
    "rt": "write model.world.right({agent}, degrees)",
    "lt": "write model.world.left({agent}, degrees)",
    "setxy": "write model.world.move_to({agent}, x, y)",
    "die": "write {agent}.die()",
    "hatch": "write {agent}.hatch()",
    "create": "write model.{all}.create()",
    "random": _DRAW,
    "random_float": "write rng.uniform(0, x)",
    "randint": "write rng.integers(low, high + 1)",
    "stop": "write `return`",
}
"""Names and functions that stand by themselves elsewhere."""

AGENT = {
    "pos": "write {agent}.x and {agent}.y",
    "xcor": "write {agent}.x",
    "ycor": "write {agent}.y",
    **dict.fromkeys(("unique_id", "who"), "write {agent}.id"),
    "model": "the model is a parameter of the rule: write model.…",
    **dict.fromkeys(("random", "rng"), _DRAW),
    "world": "write model.world",
    **{name: f"write {{agent}}.{name}()" for name in ("die", "hatch")},
    "run_plan": "write {agent}.run_plan(model, rng)",
    **dict.fromkeys(
        ("send", "receive", "inbox", "mailbox", "messages"),
        "declare `offers = Messages(Offer, to={all})`; write model.offers.send({agent}, other) and "
        "`for offer in model.offers.to({agent}):`",
    ),
    "alive": "ask model.{all}.contains(identity); the dead act no more",
    "breed": "give each kind of agents a population of its own",
    "patch_here": _HERE,
    **dict.fromkeys(("remove", "kill"), "write {agent}.die()"),
    **dict.fromkeys(("step", "go", "live"), "write it as a function, and call it with the agent"),
    "fd": NAMES["fd"],
    "rt": NAMES["rt"],
    "lt": NAMES["lt"],
    "setxy": NAMES["setxy"],
    **dict.fromkeys(("neighbors", "neighbours", "get_neighbors"), _AROUND),
    **dict.fromkeys(("neighbors4", "neighbours4"), _FOUR),
    **dict.fromkeys(("near", "in_radius"), _NEAR),
    **dict.fromkeys(("turtles_here", "on"), _ON),
    "nearest": NAMES["nearest"],
    "choose_next_plan": "write {agent}.plan = {agent}.mind.choose_next_plan()",
    **dict.fromkeys(("link_neighbors", "network_neighbors"), _LINKED.format("neighbours({agent})")),
    **dict.fromkeys(("my_links", "links"), _LINKED.format("links_of({agent})")),
    **dict.fromkeys(
        ("create_link_with", "create_link_to", "link_with"), _LINKED.format("link({agent}, other)")
    ),
}
"""Fields and methods that agents have elsewhere."""

MODEL = {
    **dict.fromkeys(("agents", "turtles", "schedule"), _LOOP),
    **dict.fromkeys(("grid", "space"), "write model.world; declare it as `world = Torus(33)`"),
    **dict.fromkeys(("random", "rng"), _DRAW),
    **dict.fromkeys(("time", "steps", "ticks", "step"), "write model.tick"),
    **{name: f"write model.world.{name}" for name in ("width", "height")},
    "patches": "write model.world.patches",
    "seed": _DRAW,
    "world": "the model has none; declare it as `world = Torus(33)`",
    "next_id": "agents have an identity of their own: write {agent}.id",
    "running": _ADVANCE,
    **dict.fromkeys(("log", "history"), "report through `series()` and `agents()` of the model"),
    "datacollector": "report through `series()` and `agents()` of the model",
}
"""What models have elsewhere."""

POPULATION = {
    **dict.fromkeys(("add", "append", "new"), "write model.{all}.create()"),
    **dict.fromkeys(("remove", "discard", "pop"), "write agent.die()"),
    **dict.fromkeys(("count", "size"), "write len(model.{all}), or count in a for loop"),
    **dict.fromkeys(("choice", "random", "sample"), "write model.{all}.one_of(rng)"),
    **dict.fromkeys(("shuffle", "shuffle_do"), "agents come in a fresh random order by themselves"),
    "sort": "keep the best so far in a for loop",
    "get": "write model.{all}[identity]",
    **dict.fromkeys(("in_radius", "within"), _NEAR),
    **dict.fromkeys(("neighbors", "get_neighbors", "get_neighborhood"), _NEAR),
    "neighbors4": "write `for other in model.{all}.neighbours4({agent}):`",
    **dict.fromkeys(("here", "turtles_here", "at"), _ON),
    **dict.fromkeys(("closest", "min_one_of"), "write model.{all}.nearest({agent})"),
}
"""What sets of agents have elsewhere."""

SETS = {
    **dict.fromkeys(("count", "size"), "write len(…)"),
    **dict.fromkeys(("choice", "random", "sample"), "write ….one_of(rng)"),
    **dict.fromkeys(
        ("near", "nearest", "on"), "ask the population: `model.flock.near(who, radius)`"
    ),
    "sort": "keep the best so far in a for loop",
}
"""What sets of agents or patches have elsewhere."""

WORLD = {
    "size": "write model.world.width and model.world.height",
    **dict.fromkeys(("neighbors", "get_neighbors", "get_neighborhood"), _AROUND),
    "neighbors4": _FOUR,
    **dict.fromkeys(("near", "agents_near"), _NEAR),
    **dict.fromkeys(("patch_here", "patch_at", "get"), _HERE),
    **dict.fromkeys(("move_agent", "place_agent", "setxy"), NAMES["setxy"]),
}
"""What worlds and grids have elsewhere."""


def for_name(typer: Typer, name: str) -> str:
    """Return what to write in place of an unknown name."""
    parameters = typer.source.parameters
    agent = _agent(typer)
    if name in ("model", "rng"):
        return _parameter_to_add(typer, name)
    if name in ("self", "agent", "turtle", "me", "myself") and agent is not None:
        return f"the agent of this rule is called {agent!r}: write {agent}.…"
    if name in (*MATH, *MATH_CONSTANTS, "pow"):
        return f"import math at the top of the file, and write math.{name}"
    if name in typer.shape.world.commands:
        return f"write model.world.{name}({agent or 'agent'}, …)"
    for holder, kind in typer.variables.items():
        if isinstance(kind, RowType) and name in typer.shape.populations[kind.population].fields:
            return f"write {holder}.{name}"
    if name in {**typer.shape.parameters, **typer.shape.variables, **typer.shape.populations}:
        with_model = "" if "model" in parameters else f"; {_parameter_to_add(typer, 'model')}"
        return f"write model.{name}{with_model}"
    if any(name in population.plans for population in typer.shape.populations.values()):
        return f"write the plan's name as a text: {name!r}"
    return _filled(NAMES, name, typer) or nearest(name, _usable(typer))


def for_function(typer: Typer, name: str, built_in: Iterable[str]) -> str:
    """Return what to write in place of an unknown function."""
    functions = [one for one in typer.source.public_names if callable(typer.source.names.get(one))]
    misspelt = close(name, [*built_in, *functions]) if name not in NAMES else None
    if misspelt is not None:
        return misspelt
    advice = for_name(typer, name)
    if advice.startswith("there is "):
        return f"write it at the top of the file: `def {name}(…):`"
    return advice


def for_agent(typer: Typer, node: ast.Attribute, population: str) -> str:
    """Return what to write in place of a field that the agents of a population lack."""
    fields = typer.shape.populations[population].fields
    holder = ast.unparse(node.value)
    if holder in ("model", "rng"):
        return (
            f"the first parameter of a rule is the agent, here {holder!r}: write "
            f"`def {typer.source.name}(agent, {holder})`, or schedule it by once(…)"
        )
    if node.attr == "model" and "model" not in typer.source.parameters:
        return _parameter_to_add(typer, "model")
    known = _filled(AGENT, node.attr, typer, holder)
    if known is None and node.attr in typer.shape.world.commands:
        known = f"write model.world.{node.attr}({holder}, …)"
    return known or declaring(
        node.attr, fields, f"the class of the agents of {population!r}", typer
    )


def for_agents_method(typer: Typer, holder: str, name: str) -> str:
    """Return what to write in place of something that agents cannot be told to do."""
    if name in typer.shape.world.commands:
        return f"write model.world.{name}({holder}, …)"
    known = _filled(AGENT, name, typer, holder)
    methods = ("die", "hatch", "run_plan", "reconsider_plan")
    return known or f"{nearest(name, methods)}; or call a function"


def for_model(typer: Typer, name: str) -> str:
    """Return what to write in place of something that the model does not declare."""
    shape = typer.shape
    known = [*shape.parameters, *shape.variables, *shape.populations, "tick"]
    known += ["world"] if shape.world.commands else []
    return _filled(MODEL, name, typer) or declaring(name, known, "the class of the model", typer)


def for_population(typer: Typer, population: str, name: str) -> str:
    """Return what to write in place of something that a population does not have."""
    advice = POPULATION.get(name)
    if advice is None:
        return f"write a for loop: `for other in model.{population}:`"
    return advice.replace("{all}", population).replace("{agent}", _agent(typer) or "agent")


def for_world(typer: Typer, name: str, known: Iterable[str]) -> str:
    """Return what to write in place of something that the world does not have."""
    return _filled(WORLD, name, typer) or nearest(name, known)


def declaring(name: str, known: Iterable[str], where: str, typer: Typer) -> str:
    """Return the advice to declare a field, after the known one that it may be meant for."""
    given = _constant_given(typer, name)
    if isinstance(given, str):
        return "fields hold numbers and truth values; a choice among few is a whole number"
    misspelt = close(name, known)
    line = "bool = False" if isinstance(given, bool) else "float = 0.0"
    advice = f"declare it in {where}: `{name}: {line}`"
    return advice if misspelt is None else f"{misspelt} If not, {advice}"


def _constant_given(typer: Typer, name: str) -> object:
    """Return a constant that the function assigns to a field, or None."""
    for node in ast.walk(typer.source.tree):
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
            place = node.targets[0]
            if isinstance(place, ast.Attribute) and place.attr == name:
                return node.value.value
    return None


def _parameter_to_add(typer: Typer, name: str) -> str:
    """Return how a function asks for `model` or `rng`."""
    source = typer.source
    used = {node.id for node in ast.walk(source.tree) if isinstance(node, ast.Name)}
    written: list[str] = [one for one in source.parameters if one not in source.defaults]
    written += [
        one
        for one in ("model", "rng")
        if one not in written and (one == name or (one in used and one not in source.names))
    ]
    written += [f"{one}=…" for one in source.defaults]
    advice = f"add the parameter: `def {source.name}({', '.join(written)})`"
    if typer.program.within_a_call:
        advice += f", and give it {name} where it is called"
    return advice


def _usable(typer: Typer) -> list[str]:
    """Return the names that a rule can use: its variables, and what its file has for it."""
    names: dict[str, Any] = {one: typer.source.names.get(one) for one in typer.source.public_names}
    kinds = (bool, int, float, str, tuple, FunctionType)
    return [*typer.variables, *(one for one, value in names.items() if isinstance(value, kinds))]


def _agent(typer: Typer) -> str | None:
    """Return what the function calls its agent, or None without one."""
    for name in typer.source.parameters:
        if isinstance(typer.variables.get(name), RowType):
            return name
    return None


def _filled(
    table: dict[str, str], name: str, typer: Typer, holder: str | None = None
) -> str | None:
    advice = table.get(name)
    if advice is None:
        return None
    population = next(iter(typer.shape.populations), "agents")
    agent = holder or _agent(typer) or "agent"
    return advice.replace("{agent}", agent).replace("{all}", population)
