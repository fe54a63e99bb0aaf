"""What the studio is begun with."""

import pytest

from socialmind.commands.watching import _first
from socialmind.errors import SocialmindError

MODEL = """
from socialmind import Agent, Model, Population


class Person(Agent):
    pass


class Crowd(Model):
    people = Population(Person, 3)
"""


def test_a_model_is_given_by_name_or_by_its_file(tmp_path):
    file = tmp_path / "crowd.py"
    file.write_text(MODEL, "utf-8")
    assert _first(str(file), 3, [], None)["model"] == str(file)
    named = _first("schelling", 3, ["minimum=2"], None)
    assert (named["seed"], named["parameters"]) == (3, {"minimum": 2})
    assert _first(None, 0, [], None) is None


def test_another_file_is_refused(tmp_path):
    (tmp_path / "notes.txt").write_text("", "utf-8")
    with pytest.raises(SocialmindError, match="is a file; expected a model"):
        _first(str(tmp_path / "notes.txt"), 0, [], None)
