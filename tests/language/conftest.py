"""What the tests of the rule language share: models made of rules, run at both speeds."""

import importlib.util
import inspect
import itertools
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from socialmind import each
from socialmind.agents.bookkeeping import NEXT_ID
from socialmind.engine.ticks import run_tick

HERE = Path(__file__).parent
_numbers = itertools.count()


def load(file, name=None):
    """Import a file as a module of a name of its own."""
    name = name or f"rules_of_tests_{next(_numbers)}_{Path(file).stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def _bits(column):
    """Return a column as whole numbers that are equal where the bits are; all NaN are alike."""
    column = np.ascontiguousarray(column)
    if column.dtype.kind == "f":
        column = np.where(np.isnan(column), np.nan, column)
        return column.view("i8")
    return column


def differences(one, other):
    """Return the names of all that differs between two models, to the last bit.

    How much room there is for agents to come may differ, and what stands in that room.
    """
    mine, theirs = _content(one), _content(other)
    return [name for name in mine if not np.array_equal(_bits(mine[name]), _bits(theirs[name]))]


def _content(model):
    found = {name: model.contexts[name] for name in ("_tick", "_idle", "_idle_agent", "_idle_tick")}
    for variable in model.variables.values():
        found |= {name: model.contexts[name] for name, *_ in variable.dtype}
    if model.ground.layered:
        found |= {
            f"world.{name}": model.ground.world.rows[name]
            for name in model.ground.world.rows.dtype.names
        }
    for name, table in model.tables.items():
        rows = table.rows[table.slots]
        found |= {f"{name}.{column}": rows[column] for column in rows.dtype.names}
        found[f"{name}.next"] = table.counters[NEXT_ID : NEXT_ID + 1]
        if table.society is not None:
            minds = [mind for _, mind in sorted((mind.id, mind) for mind in table.society)]
            slots = [mind.slot for mind in minds]
            for part in ("mind_id", "values", "draws", "group_slot", "role", "participation"):
                found[f"{name}.minds.{part}"] = getattr(table.society.minds, part)[slots]
            living = table.society.minds.instance_id >= 0
            for part in ("instance_id", "instance_group", "members", "culturons"):
                found[f"{name}.minds.{part}"] = getattr(table.society.minds, part)[living]
    return found


def watched(society):
    """Note in `society._met` the errors of compiled code, which the interpreted speed then asks."""
    society._met = []
    guarded = society.engine._guarded

    def noting(run, again):
        def noted():
            try:
                return run()
            except Exception as error:
                society._met.append(type(error).__name__)
                raise

        return guarded(noted, again)

    society.engine._guarded = noting
    return society


def plain(society):
    """Let an interpreted model run its rules as Python does, without the front end's tree."""
    functions = society.program.functions
    society._functions = {name: one.source.function for name, one in functions.items()}
    return society


def fits(rule):
    """Return the arguments that a rule takes, as text."""
    return ", ".join(inspect.signature(rule).parameters)


@pytest.fixture(scope="session")
def society():
    """The module of the society in which constructs are tried."""
    return load(HERE / "rules" / "society.py", "society")


@pytest.fixture(scope="session")
def walk(society, tmp_path_factory):
    """Make a model in which tick k tries the k-th rule of a file."""

    def make(stem):
        module = load(HERE / "rules" / f"{stem}.py")
        module._prices = load(HERE / "rules" / "prices.py", "prices")
        rules = [
            rule
            for name, rule in vars(module).items()
            if inspect.isfunction(rule)
            and rule.__module__ == module.__name__
            and name[0] != "_"
            and next(iter(inspect.signature(rule).parameters), "") == "person"
        ]
        lines = ["import rules_under_test as rules", "", "", "def at(person, model, rng):"]
        for place, rule in enumerate(rules):
            call = f"rules.{rule.__name__}({fits(rule)})"
            lines += [f"    if model.tick == {place}:", f"        {call}"]
        file = tmp_path_factory.mktemp(stem) / f"{stem}_walk.py"
        file.write_text("\n".join(lines))
        sys.modules["rules_under_test"] = module
        made = load(file)
        persons = society.Society.persons
        schedule = (each(persons, society.begin), each(persons, made.at))
        cls = type("Walk", (society.Society,), {"schedule": schedule, "__module__": made.__name__})
        return cls, rules

    return make


@pytest.fixture(scope="session")
def speeds():
    """What compares the two speeds."""
    return SimpleNamespace(
        differences=differences, watched=watched, plain=plain, load=load, run_tick=run_tick
    )
