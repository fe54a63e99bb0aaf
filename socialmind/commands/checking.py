"""`socialmind check` and `socialmind explain`: at schemes, minds, rules and single decisions."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from coglogo_py import CognitiveScheme, SchemeError
from coglogo_py.border.errors import shown
from socialmind.agents.heeding import check_conditions
from socialmind.catalogue import load_model
from socialmind.commands.checking_minds import is_mind, print_mind, tell, tell_programs
from socialmind.errors import SocialmindError
from socialmind.fields import place_of_field
from socialmind.mind.code.mind_code import check_program
from socialmind.mind.files.evoagents.text_file import inside
from socialmind.mind.lint import findings
from socialmind.runs.branching.repeating import explain
from socialmind.runs.capsule import Capsule
from socialmind.sources.folders import MODEL_FILE, model_folder
from socialmind.sources.loading import tree_of
from socialmind.sources.trust import programs_in

if TYPE_CHECKING:
    from coglogo_py import DecisionMaker, Finding
    from socialmind.mind.description import MindDescription
    from socialmind.model import Model

SCHEME_SUFFIXES = (".cogscheme", ".yaml", ".yml")


def print_findings(file: str, trust: bool = False) -> bool:
    """Check a scheme, a mind or a model and print what is odd; True when something is.

    Args:
        file: a scheme's file, a mind's folder or YAML file, a model's folder, or a model's name.
        trust: run programs, to check the rules as well; else nothing is run.

    Raises:
        SocialmindError: there is no such file.
        SchemeError: the scheme cannot be read.
        ModelError: the mind or model cannot be loaded, or a rule is outside the language.
    """
    path = Path(file)
    if is_mind(path):
        return print_mind(path, trust)
    # CogLogo knows its files by their first line, whatever they are called.
    if path.suffix in SCHEME_SUFFIXES or (path.is_file() and path.suffix != ".py"):
        if not path.is_file():
            raise SocialmindError(f"{path}: no such file")
        scheme, odd = _read(path)
        odd += [f"{path}: {found}" for found in scheme.check()]
    else:
        odd = findings_of_model(load_model(file)) if trust else findings_of_folder(file)
    tell(odd, file)
    return bool(odd)


def findings_of_folder(file: str) -> list[str]:
    """Check what can be known of a model without running it: its Python, schemes and plans.

    Raises:
        SocialmindError: there is no such model.
        ModelError: a file of it is no Python.
    """
    folder = model_folder(file)
    declared: dict[Path, list[str] | None] = {}
    unseen: list[str] = []
    for name, content in programs_in(folder).items():
        if name.endswith(".py"):
            declared |= _declared_schemes(Path(name), content, unseen)
    tell_programs(folder)
    odd = []
    for path, plans in declared.items():
        if not path.is_file():
            raise SocialmindError(f"{path}: no such file; a population takes its minds from it")
        inside(folder, path.relative_to(folder).as_posix(), "the scheme", folder / MODEL_FILE)
        try:
            scheme, cut = _read(path)
            odd += [*cut, *(f"{path}: {one}" for one in scheme.check(plans=plans))]
        except SchemeError as error:
            if "decision maker" not in error.found:  # it may be one of the model's own
                raise
            unseen.append(f"{path}: the scheme, whose decision maker may be the model's own")
    for one in unseen:
        typer.echo(f"{one} was not looked at; --trust does, and runs the programs", err=True)
    return odd


def _read(
    path: Path, decision_makers: Iterable[type[DecisionMaker]] = ()
) -> tuple[CognitiveScheme, list[str]]:
    """Return a scheme, and what is odd about its file: what reading warns of, an end cut off."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        scheme = CognitiveScheme.load(path, decision_makers)
    odd = [str(one.message) for one in said]
    # A file of this form has no end mark, but whoever writes one ends its last line.
    if path.suffix.lower() in (".yaml", ".yml") and not path.read_bytes().endswith((b"\n", b"\r")):
        odd.append(
            f"{path}: its last line has no end: was the file cut off? If it is whole, end the line"
        )
    return scheme, odd


def _declared_schemes(
    file: Path, content: bytes, unseen: list[str]
) -> dict[Path, list[str] | None]:
    """Return the schemes and plans that a file's `Population(…, mind="…", plans={…})` write out.

    What is computed instead goes to `unseen`, with its line.
    """
    found: dict[Path, list[str] | None] = {}
    for call in ast.walk(tree_of(content, file)):
        called = getattr(call, "func", None)
        if getattr(called, "id", getattr(called, "attr", "")) != "Population":
            continue
        assert isinstance(call, ast.Call)  # nothing else has a function
        given = {one.arg: one.value for one in call.keywords}
        mind, plans = given.get("mind"), given.get("plans")
        place = f"{file}:{call.lineno}: Population(…"
        for name in ("mind", "hierarchy", None):
            one = given.get(name)
            written = isinstance(one, ast.Constant) and (name == "mind" or one.value is None)
            if one is not None and not written:
                what = "**" if name is None else f"{name}="
                unseen.append(f"{place}, {what}{shown(ast.unparse(one))[1:-1]})")
        if isinstance(mind, ast.Constant) and isinstance(mind.value, str):
            keys = plans.keys if isinstance(plans, ast.Dict) else []
            names = [one.value for one in keys if isinstance(one, ast.Constant)]
            whole = isinstance(plans, ast.Dict) and len(names) == len(keys)
            if plans is not None and not whole:
                unseen.append(f"{place}, plans=…): whether the scheme has these plans")
            path = file.parent / mind.value
            if path.resolve().is_relative_to(file.parent.resolve()):
                found[path] = [str(one) for one in names] if whole else None
    return found


def findings_of_model(model_class: type[Model]) -> list[str]:
    """Type a model's rules and check its schemes against the plans it declares."""
    program = model_class.typed(compiled=True)
    odd = []
    for name, population in model_class.populations.items():
        if population.mind is None:
            continue
        scheme = population.mind
        place = name
        at: tuple[str | Path | None, int | None] = place_of_field(model_class, name)
        if not isinstance(scheme, CognitiveScheme):
            path = model_class.folder() / scheme
            place, at = str(path), (path, None)
            if not path.is_file():
                raise SocialmindError(f"{path}: no such file; {name} take their minds from it")
            scheme, cut = _read(path, population.decision_makers)
            odd += cut
        shape = model_class.shape
        fields = shape.populations[name].fields
        check_conditions(scheme, name, fields, shape.parameters, at)
        found: list[Finding] = scheme.check(population.plans, program.cognitons_set(name))
        odd += [f"{place}: {one}" for one in found]
    return odd + _findings_of_hierarchies(model_class)


def _findings_of_hierarchies(model_class: type[Model]) -> list[str]:
    """Lint the hierarchies of skills of a model's populations, each mind once."""
    program = model_class.typed(compiled=True)
    minds: dict[str, tuple[MindDescription, list[str], set[str]]] = {}
    for name, steering in model_class.steerings().items():
        assembly = steering.assembly
        source = model_class.populations[name].hierarchy
        place = str(model_class.folder() / source) if isinstance(source, str | Path) else name
        _, masters, named = minds.setdefault(place, (assembly.description, [], set()))
        masters.append(assembly.master)
        named |= {f"{one.part} {one.keys[0]!r}" for one in program.names[name]}
    return [
        f"{place}: {one}"
        for place, (description, masters, named) in minds.items()
        for one in findings(description, tuple(masters), check_program)
        # What rules read and write themselves is neither unwritten nor unread.
        if not (one.kind in ("never written", "never read") and one.where in named)
    ]


def print_decision(
    folder: Path, agent: int, tick: int, trust: bool = False, kept: bool = False
) -> None:
    """Print how an agent of a run came to its decision.

    Args:
        folder: the run's.
        agent: the agent's identity.
        tick: 1 … the ticks done; the decision explained is the one in force then.
        trust: run programs that this user has neither named nor run before.
        kept: take the copies of the model's source that the run keeps.

    Raises:
        SocialmindError: no such run, tick, agent or decision.
    """
    capsule = Capsule(folder)
    done = capsule.manifest.ticks_done
    if not 1 <= tick <= done:
        there = f"expected 1 … {done}, the ticks that the run has done"
        if not done:
            there = "the run has done no tick yet, so there is no decision to explain"
        raise SocialmindError(f"tick {tick}: {there}")
    typer.echo(str(explain(capsule, agent, tick, trust, kept)))
