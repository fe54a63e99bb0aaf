"""The message of a model's error."""

import pickle

import pytest

from socialmind.errors import ModelError, SocialmindError


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"found": "nothing there"}, "nothing there"),
        ({"found": "a", "expected": "b"}, "found a; expected b"),
        ({"found": "a", "remedy": "write b"}, "a; write b"),
        ({"found": "a", "file": "m.py"}, "m.py: a"),
        ({"found": "a", "line": 3}, "line 3: a"),
        (
            {"found": "a", "expected": "b", "remedy": "c", "file": "m.py", "line": 3},
            "m.py:3: found a; expected b; c",
        ),
    ],
)
def test_the_fields_make_one_line_and_survive_pickling(fields, message):
    error = pickle.loads(pickle.dumps(ModelError(**fields)))
    assert isinstance(error, SocialmindError)
    assert str(error) == message
    assert {name: getattr(error, name) for name in fields} == fields
