"""Names that mean something to Python, YAML or Markdown mean nothing in a written model."""

from dataclasses import fields, is_dataclass, replace

import pytest

from socialmind.catalogue import load_model
from socialmind.metaciv.description import Place
from socialmind.metaciv.reading import read_folder
from socialmind.metaciv.writing import write_model

from ..reading.folders import FARMERS, written

NAMES = (
    "Brown bread", "Corn", "Will", "Hungry", "Work", "Village", "chief", "member", "energy",
    "meal", "Farmers", "Farmer", "Mill", "Grass", "Rock", "Fed",
)  # fmt: skip
HOSTILE = (
    '"""\nraise SystemExit\n',
    "x\rraise SystemExit",
    "\u2028\x85raise SystemExit",
    "\\",
    "class",
    "human",
    "  ",
    "#",
    "yes: [no]",
    "%(x)s {x}",
    "ключ",
    "join village",
    "|a|<b>`c`",
)


def renamed(part, names):
    """A part of a description in which names are others."""
    if isinstance(part, str):
        return names.get(part, part)
    if isinstance(part, Place):
        return part
    if is_dataclass(part):
        return replace(
            part, **{f.name: renamed(getattr(part, f.name), names) for f in fields(part)}
        )
    if type(part) is tuple:
        return tuple(renamed(one, names) for one in part)
    return part


@pytest.mark.parametrize("hostile", HOSTILE)
def test_all_names_alike_but_for_their_ends(tmp_path, hostile):
    model = read_folder(written(tmp_path / "there", FARMERS)).model
    names = {old: f"{hostile}{number}" for number, old in enumerate(NAMES)}
    write_model(renamed(model, names), tmp_path / "here")
    society = load_model(tmp_path / "here")(seed=1, compiled=False)
    society.advance(6)
    assert len(society.humans) == 2


@pytest.mark.parametrize("hostile", HOSTILE[3:9])
@pytest.mark.parametrize("old", ["Work", "energy", "Brown bread", "Village"])
def test_one_name_as_it_is(tmp_path, old, hostile):
    model = read_folder(written(tmp_path / "there", FARMERS)).model
    write_model(renamed(model, {old: hostile}), tmp_path / "here")
    society = load_model(tmp_path / "here")(seed=1, compiled=False)
    society.advance(4)
    assert len(society.humans) == 2
