"""A program: every function that a model's phases reach, typed, as the tree both speeds run."""

from __future__ import annotations

import ast
import types as python_types
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from socialmind.errors import ModelError, close, nearest
from socialmind.fields import Field
from socialmind.language.effects import Effects
from socialmind.language.interpreting import code_of, functions_of
from socialmind.language.plan_calls import TypedPlans, typed_plans
from socialmind.language.shape import ModelShape, PhaseShape
from socialmind.language.source import Names, RuleSource, rule_source
from socialmind.language.types import MODEL, NONE, RNG, AnyType, RowType, TableType, TextType
from socialmind.language.typing.statements import FunctionTyper
from socialmind.streams import (
    BIRTH_TAG,
    BIRTH_TAGS,
    SCHEDULE_TAG,
    SETUP_TAG,
    TAGS,
    phase_tags,
)


@dataclass(frozen=True)
class WrittenName:
    """A name of a scheme's part, as written in a rule.

    Attributes:
        part: "plan", "cogniton", "group", "role" or "culturon".
        keys: the name; for roles and culturons the group's name before it.
        file, line: where it was first met.
    """

    part: str
    keys: tuple[str, ...]
    file: str
    line: int


@dataclass(frozen=True)
class TypedFunction:
    """A function for given types of its parameters.

    Attributes:
        symbol: its name in the program.
        source: what its author wrote.
        kinds: the types of its parameters.
        tree: the function as both speeds run it; nodes carry marks for the lowering.
        result: the type of what it returns.
    """

    symbol: str
    source: RuleSource
    kinds: tuple[AnyType, ...]
    tree: ast.FunctionDef
    result: AnyType


@dataclass(frozen=True)
class Phase:
    """A phase with its typed rule, what of agent, model and stream that takes, and its tag."""

    shape: PhaseShape
    symbol: str
    takes: tuple[str, ...]
    tag: int


_SETTING = ("set_cogniton_value", "add_to_cogniton_value", "activate_cogniton")
"""What a rule does with a mind to set a cogniton."""


class Program:
    """The typed functions of a model.

    Args:
        shape: the model's shape.
        compiled: whether it will be compiled; `print` and `breakpoint` are for interpreted runs.

    Attributes:
        effects: what its functions do to populations.
        made: what the rooms above made of it, by whose it is: as long as the program is in force.
        between_minds: what minds do to those of others: whose minds, the command, and to whose;
            with file and line.

    Raises:
        ModelError: a rule outside the language, with file, line and what to write instead.
    """

    def __init__(self, shape: ModelShape, compiled: bool) -> None:
        self.shape = shape
        self.compiled = compiled
        self.functions: dict[str, TypedFunction] = {}
        self.names: dict[str, list[WrittenName]] = {name: [] for name in shape.populations}
        self.births: list[str] = []
        self._sought: dict[str, set[str]] = {}
        self._gathered: list[tuple[str, str]] = []
        self.between_minds: dict[tuple[str, str, str], tuple[str, int]] = {}
        self.patches_sought = False
        self.world_calls: list[tuple[str, ...]] = []
        self.aggregates: list[tuple[str, str, Field]] = []
        self.plans: dict[str, TypedPlans] = {}
        self.reconsidered = set[str]()
        self.imitations: list[tuple[str, str, str]] = []
        self.made: dict[Any, Any] = {}
        self.effects = Effects()
        self._codes: dict[str, python_types.CodeType] | None = None
        self._sources: dict[Callable[..., Any], RuleSource] = {}
        self._modules: dict[python_types.ModuleType, Names] = {}
        self._symbols: dict[tuple[Callable[..., Any], tuple[AnyType, ...]], str] = {}
        self._open: list[Callable[..., Any]] = []
        self.setup = self._phases(shape.setup, SETUP_TAG)
        self.effects.begin_ticks()
        self.schedule = self._phases(shape.schedule, SCHEDULE_TAG)
        born = tuple(
            PhaseShape(one.at_birth, one.name, shuffled=False)
            for one in shape.populations.values()
            if one.at_birth is not None
        )
        self.at_birth = self._phases(born, BIRTH_TAG, BIRTH_TAGS)
        self.world: Any = shape.world.typed(self)

    def source(self, function: Callable[..., Any]) -> RuleSource:
        """Return the source of a function, read once."""
        if function not in self._sources:
            self._sources[function] = rule_source(function)
        return self._sources[function]

    @property
    def sources(self) -> tuple[RuleSource, ...]:
        """The functions that it reaches, as their authors wrote them, in the order of meeting."""
        return tuple(self._sources.values())

    def module_names(self, module: python_types.ModuleType) -> Names:
        """Return the names of a module that a rule names."""
        return self._modules.setdefault(module, Names(vars(module)))

    @property
    def outdated(self) -> bool:
        """Whether typing the same rules again would read other constants or call other helpers."""
        return any(source.outdated for source in self._sources.values()) or any(
            names.outdated for names in self._modules.values()
        )

    def _phases(
        self, shapes: tuple[PhaseShape, ...], first_tag: int, tags_there: int = TAGS
    ) -> tuple[Phase, ...]:
        names = [self.source(shape.rule).name for shape in shapes]
        tags = phase_tags(first_tag, names, tags_there)
        return tuple(
            Phase(shape, *self.entry(shape.rule, shape.population), tag)
            for shape, tag in zip(shapes, tags, strict=True)
        )

    def entry(
        self, rule: Callable[..., Any], population: str | None
    ) -> tuple[str, tuple[str, ...]]:
        """Type a rule of the schedule or of a plan; return its symbol and what it takes."""
        symbol, takes, result = self.called(rule, population)
        if result != NONE:
            source = self.source(rule)
            raise ModelError(
                f"the rule {source.name!r}, which returns {result}",
                "a rule that returns nothing",
                "write what it found into a field",
                source.file,
                source.line,
            )
        return symbol, takes

    def called(
        self, rule: Callable[..., Any], population: str | None
    ) -> tuple[str, tuple[str, ...], AnyType]:
        """Type a function that is no other's; return symbol, what it takes and what it returns."""
        source = self.source(rule)
        names = source.parameters
        known: dict[str, AnyType] = {"model": MODEL, "rng": RNG}
        kinds: list[AnyType] = []
        takes: list[str] = []
        for place, name in enumerate(names):
            if place == 0 and population is not None:
                kinds.append(RowType(population))
                takes.append("agent")
            elif name in known:
                kinds.append(known[name])
                takes.append(name)
            else:
                first = "" if population is None else "an agent, then "
                misspelt = close(name, known)
                if place == 1 and names[0] in known and population is not None:
                    misspelt = f"write def {source.name}({name}, {names[0]})"
                raise source.error(
                    f"the parameter {name!r} of the rule {source.name!r}",
                    f"{first}`model` and `rng`, as far as it needs them",
                    misspelt
                    or _INSTEAD.get(name)
                    or "values reach a rule through the fields of the agent and the model",
                )
        if population is not None and not names:
            raise source.error(
                f"the rule {source.name!r} without parameters",
                f"an agent of {population!r} first",
                f"write def {source.name}({population.rstrip('s')}, model, rng)",
            )
        symbol, result = self.specialised(source, tuple(kinds), None, source.tree)
        return symbol, tuple(takes), result

    def runs_plans(self, population: str, typer: Any, node: ast.AST) -> None:
        """Type the functions of a population's plans, once a rule runs them."""
        self.effects.carries_out(population)
        if population not in self.plans:
            # A plan may carry out plans, which is refused once it is typed.
            self.plans[population] = TypedPlans((), (), None)
            self.plans[population] = typed_plans(self, population, typer, node)
        for call in self.plans[population].calls:
            self.effects.calls(call.symbol)

    @property
    def within_a_call(self) -> bool:
        """Whether the function that is typed is one that another function calls."""
        return len(self._open) > 1

    def bears(self, population: str) -> None:
        """Note that rules bring new agents into a population."""
        if population not in self.births:
            self.births.append(population)
        self.effects.bears(population)

    @cached_property
    def eventful(self) -> tuple[str, ...]:
        """The populations whose agents are born or die in ticks."""
        return tuple(filter(self.effects.come_and_go, self.agents))

    @cached_property
    def agents(self) -> tuple[str, ...]:
        """The populations of agents; links and messages are none."""
        return tuple(
            name
            for name, one in self.shape.populations.items()
            if one.links is None and one.messages_to is None
        )

    def sums_up(self, population: str, what: str, field: Field) -> None:
        """Note that rules sum up a field of a population."""
        if (population, what, field) not in self.aggregates:
            self.aggregates.append((population, what, field))

    def imitates(self, command: str, learner: str, other: str) -> None:
        """Note that minds of a population take something over from those of one."""
        if (command, learner, other) not in self.imitations:
            self.imitations.append((command, learner, other))

    def calls_world(self, *call: str) -> None:
        """Note that rules call something of the world: its name, then populations and fields."""
        if call not in self.world_calls:
            self.world_calls.append(call)

    def seeks(self, population: str, how: str) -> None:
        """Note that rules look for the agents of a population, by such a question."""
        self._sought.setdefault(population, set()).add(how)

    @property
    def sought(self) -> tuple[str, ...]:
        """The populations whose agents rules look for."""
        return tuple(self._sought)

    def gathers(self, population: str, lists: str) -> None:
        """Note that rules ask who of a population is in a group ("members"), or asks to be."""
        if (population, lists) not in self._gathered:
            self._gathered.append((population, lists))

    def acts_on_others(self, call: tuple[str, str, str], typer: Any, node: ast.AST) -> None:
        """Note that minds of a population do something to those of another, and where first."""
        self.between_minds.setdefault(call, (typer.source.file, getattr(node, "lineno", 0)))

    @property
    def gathered(self) -> tuple[tuple[str, str], ...]:
        """The populations, and of which of their lists rules ask."""
        return tuple(self._gathered)

    def sought_on_patches(self, population: str) -> bool:
        """Say whether rules look for the agents of a population by patches alone."""
        return not self._sought[population] & {"near", "nearest"}

    def looked_through(self, population: str) -> bool:
        """Say whether all agents of a population that rules look for are looked at while few."""
        nearest = "nearest" in self._sought[population]
        return not nearest and not self.shape.world.taken_by(population)

    @cached_property
    def indexed(self) -> tuple[str, ...]:
        """The populations looked for of which an index is kept.

        Where a patch has room for one, and it does not show in which order agents were found, the
        patches themselves say enough.
        """
        shown = [
            mark[1]
            for mark in self._marks()
            if mark[-1] == "near"
            and (mark[0] in ("one_found", "count_found") or (mark[0] == "found_loop" and mark[2]))
        ]
        taken_by = self.shape.world.taken_by
        return tuple(
            name
            for name in self.sought
            if name in shown or not self.sought_on_patches(name) or not taken_by(name)
        )

    @cached_property
    def loops_over_found(self) -> int:
        """How many loops of the rules go over agents that were found."""
        return sum(mark[0] == "found_loop" for mark in self._marks())

    @cached_property
    def seeks_somebody(self) -> bool:
        """Whether rules hold agents that may be None."""
        return any(mark[0] in ("perhaps", "agent_there") for mark in self._marks())

    @cached_property
    def perhaps_nobody(self) -> tuple[str, ...]:
        """The populations of which a rule uses an agent that may be None."""
        used = (mark[1] for mark in self._marks() if mark[0] == "agent_there")
        return tuple(dict.fromkeys(used))

    def cognitons_set(self, population: str) -> set[str]:
        """Return the cognitons of a population's minds that its rules set or make active."""
        written = self.names[population]
        found = set()
        for mark in self._marks():
            sets = mark[:2] == ("mind", population) and len(mark) > 2 and mark[2] in _SETTING
            if sets or (mark[:2] == ("imitation", "imitate") and mark[2][0] == population):
                found.add(written[mark[3][0]].keys[0])
        return found

    def _marks(self) -> Iterator[tuple[Any, ...]]:
        for function in self.functions.values():
            for node in ast.walk(function.tree):
                yield getattr(node, "mark", ("",))

    @property
    def world_columns(self) -> tuple[str, ...]:
        """The columns of the model's record that what its rules call of the world needs."""
        calls = self.shape.world.calls
        return tuple(
            dict.fromkeys(one for call in self.world_calls for one in calls[call[0]].columns)
        )

    def name(self, population: str, part: str, keys: tuple[str, ...], file: str, line: int) -> int:
        """Return the place of a written name in the population's table of names."""
        written = self.names[population]
        for place, one in enumerate(written):
            if (one.part, one.keys) == (part, keys):
                return place
        written.append(WrittenName(part, keys, file, line))
        return len(written) - 1

    def specialised(
        self, source: RuleSource, kinds: tuple[AnyType, ...], typer: Any, node: ast.AST
    ) -> tuple[str, AnyType]:
        """Return the symbol and the result of a function for given types of its parameters."""
        key = (source.function, kinds)
        if key in self._symbols:
            symbol = self._symbols[key]
            self.effects.calls(symbol)
            self._note_reached(symbol)
            return symbol, self.functions[symbol].result
        if source.function in self._open:
            raise ModelError(
                f"{source.name}(), which calls itself",
                None,
                "write a loop: rules do not call themselves",
                source.file if typer is None else typer.source.file,
                getattr(node, "lineno", source.line),
            )
        _check_definition(source)
        self._open.append(source.function)
        self.effects.begin()
        body, result = FunctionTyper(self, source, kinds).typed()
        self._open.pop()
        symbol = self._symbol(source.name)
        self.effects.end(symbol)
        names = [
            name
            for name, kind in zip(source.parameters, kinds, strict=True)
            if not isinstance(kind, TextType | TableType)
        ]
        arguments = ast.arguments([], [ast.arg(name) for name in names], None, [], [], None, [])
        tree = ast.FunctionDef(symbol, arguments, body, [], None, None)
        if hasattr(tree, "type_params"):
            tree.type_params = []
        ast.fix_missing_locations(ast.copy_location(tree, source.tree))
        self.functions[symbol] = TypedFunction(symbol, source, kinds, tree, result)
        self._symbols[key] = symbol
        self._note_reached(symbol)
        return symbol, result

    def _note_reached(self, symbol: str) -> None:
        """Note what a function that no other calls does."""
        if not self._open:
            self.effects.in_ticks(symbol)

    def _symbol(self, name: str) -> str:
        # No variable of the author's begins with an underscore.
        symbol, count = f"_do_{name}", 1
        while symbol in self.functions:
            count += 1
            symbol = f"_do_{name}_{count}"
        return symbol

    def interpreted(self, namespace: Mapping[str, Any]) -> dict[str, Callable[..., Any]]:
        """Return the functions as ordinary Python, with the author's files and lines.

        Args:
            namespace: further names that the tree calls (the world's, the rows').
        """
        if self._codes is None:
            self._codes = {
                one.symbol: code_of(one.tree, one.source) for one in self.functions.values()
            }
        return functions_of(self._codes, namespace)

    def placed(
        self, population: str, tables: Mapping[str, Mapping[Any, int]], owners: Mapping[str, str]
    ) -> list[int]:
        """Return the index in a scheme or a hierarchy of every written name of a population.

        Args:
            population: whose names.
            tables: the parts: part -> key -> index; keys are names, and for roles and culturons
                pairs of group and name.
            owners: what to call the owner of each part in an error.

        Raises:
            ModelError: a rule names a part that the scheme does not have.
        """
        indices = []
        for written in self.names[population]:
            table = tables[written.part]
            key = written.keys[0] if len(written.keys) == 1 else written.keys
            if key not in table:
                known = [
                    one if isinstance(one, str) else one[1]
                    for one in table
                    if isinstance(one, str) or one[0] == written.keys[0]
                ]
                raise ModelError(
                    f"the {written.part} {written.keys[-1]!r}, "
                    f"which {owners[written.part]} does not have",
                    None,
                    nearest(written.keys[-1], known),
                    written.file,
                    written.line,
                )
            indices.append(table[key])
        return indices


_INSTEAD = {
    "world": "write model.world",
    "self": "the agent comes first, under any name, and needs no `self`",
    **dict.fromkeys(("random", "seed"), "the agent's random stream is called `rng`"),
    **dict.fromkeys(("tick", "time", "step"), "write model.tick"),
}
"""What rules have in place of a parameter."""


def _check_definition(source: RuleSource) -> None:
    arguments = source.tree.args
    for name in source.parameters:
        if name.startswith("_"):
            raise source.error(
                f"the parameter {name!r} of the rule {source.name!r}",
                None,
                "leave the leading underscore out",
            )
    odd = [
        (arguments.vararg, "*arguments"),
        (arguments.kwarg, "**arguments"),
        (arguments.kwonlyargs, "keyword-only parameters"),
        (arguments.posonlyargs, "positional-only parameters"),
        (source.tree.decorator_list, "a decorator"),
    ]
    for found, what in odd:
        if found:
            raise source.error(
                f"{what} on the rule {source.name!r}",
                "plain parameters",
                "write def rule(agent, model, rng)",
            )
