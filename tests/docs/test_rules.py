"""The page of the rule language: its model runs, and its tables hold what the language holds."""

import re
import sys
from pathlib import Path

import pytest

from coglogo_py import Mind
from socialmind import ModelError, each
from socialmind.catalogue import load_model
from socialmind.language import refusals
from socialmind.language.typing.built_in import BUILT_IN
from socialmind.language.typing.signatures import MATH, MATH_CONSTANTS, MIND, OF_SEVERAL, RNG
from socialmind.worlds.grid.geometry import COMMANDS

PAGE = (Path(__file__).parents[2] / "docs" / "rules.md").read_text("utf-8")
BLOCK = re.compile(r"```(\w+)\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def pasture(tmp_path_factory):
    """The model of the page, and its file."""
    folder = tmp_path_factory.mktemp("pasture")
    text = "\n".join(text for kind, text in BLOCK.findall(PAGE) if kind == "python")
    (folder / "model.py").write_text(text, "utf-8")
    return load_model(str(folder))


def test_its_model_runs_alike_at_both_speeds(pasture):
    fast, slow = pasture(seed=1), pasture(seed=1, compiled=False)
    for model in (fast, slow):
        model.advance(200)
    assert fast.flock.id.tolist() == slow.flock.id.tolist()
    assert fast.flock.energy.tolist() == slow.flock.energy.tolist()
    assert (fast.world.grass == slow.world.grass).all()
    assert max(fast.flock.id) > 100  # many were born,
    assert len(fast.flock) < max(fast.flock.id)  # many died
    assert fast.season == 2


def test_its_last_function_looks_inside(pasture):
    inside = sys.modules[pasture.__module__].seen_from_inside()
    model = pasture(seed=1)
    model.advance(3)
    assert inside == list(zip(model.flock.id, model.flock.energy, strict=True))


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("def live(sheep):\n    n = [s for s in range(3)]\n", "a list comprehension in the rule"),
        (
            "def live(sheep):\n    sheep.enrgy = 3\n",
            "the unknown field 'enrgy' of an agent of 'flock'",
        ),
        (
            "def live(sheep):\n    sheep.energy = None\n",
            "None for the field 'energy', which is a num",
        ),
    ],
)
def test_its_refusals_are_those_of_the_language(rule, expected, pasture, tmp_path):
    file = tmp_path / "model.py"
    file.write_text(rule)
    names = {"__name__": "written"}
    exec(compile(rule, file, "exec"), names)
    schedule = (each(pasture.flock, names["live"]),)
    with pytest.raises(ModelError) as caught:
        type("Refusing", (pasture,), {"schedule": schedule})()
    message = str(caught.value).partition(": ")[2]
    assert message.startswith(expected)
    assert message in PAGE


def cell(text):
    return text.replace("|", "\\|")


def test_its_tables_hold_every_refusal():
    lines = set(PAGE.splitlines())
    assert all(
        f"| {cell(what)} | {cell(advice)} |" in lines for what, advice in refusals.REFUSED.values()
    )
    for table, written in (
        (refusals.NAMES, "`{}()`"),
        (refusals.MATH_REMEDIES, "`math.{}()`"),
        (refusals.MODULES, "`{}`"),
        (refusals.METHODS, "`.{}()`"),
    ):
        for name, advice in table.items():
            assert f"| {written.format(name)} | {cell(advice)} |" in lines, name
    assert all(
        f"`{operator}`" in PAGE.replace("\\|", "|") for operator in refusals.OPERATORS.values()
    )


def test_it_names_all_that_can_be_called():
    named = set(re.findall(r"`(\w+)`", PAGE))
    assert {*MATH, *MATH_CONSTANTS, *BUILT_IN} - {"range", "print", "breakpoint"} <= named
    assert all(f"model.world.{name}(" in PAGE or f"`{name}`" in PAGE for name in COMMANDS)
    assert all(f"rng.{name}(" in PAGE for name in (*RNG, *OF_SEVERAL))
    assert all(callable(getattr(Mind, name)) for name in MIND)
