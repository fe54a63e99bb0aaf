"""What compiled code depends on beside its own text: files imported, constants and helpers read."""

import importlib
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import socialmind
from coglogo_py import arrays
from coglogo_py.compiled.reached import reached_files
from socialmind.compiling import modules
from socialmind.compiling.reached import fingerprint
from socialmind.engine import module_text as loop
from socialmind.worlds.plane.kernel import code

HOME = Path(socialmind.__file__).parent.parent


def test_files_are_followed_through_files():
    found = {one.relative_to(HOME).as_posix() for one in reached_files(code._TEXT)}
    kernel = {
        f"socialmind/worlds/plane/kernel/{name}.py"
        for name in ("motion", "rays", "stones", "contacts")
    }
    assert kernel | {"socialmind/compiling/memory.py", "socialmind/worlds/plane/layout.py"} <= found


def test_what_a_decision_maker_may_call_is_among_them():
    text = f"{loop.HEAD}\n{loop.AGENTS}\n{modules._MAKERS}"
    names = {one.name for one in reached_files(text)}
    assert {"kernel.py", "streams.py", "borrow.py", "decision.py"} <= names
    assert reached_files("import numpy as np\nfrom math import sqrt") == ()
    several = "from coglogo_py.arrays import (\n    MindArrays,\n    SchemeArrays as _S,\n)\n"
    assert Path(arrays.__file__) in reached_files(several)


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Write a text as a module of its own, loaded anew each time, and give the function `f`."""
    monkeypatch.syspath_prepend(tmp_path)

    def write(text, **others):
        for name, content in {"first": text, **others}.items():
            (tmp_path / f"{name}.py").write_text(content)
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        sys.dont_write_bytecode = True
        return importlib.import_module("first").f

    yield write
    for name in ("first", "second"):
        sys.modules.pop(name, None)


BEFORE = """
import math
import numpy as np
import second
from second import SPEED
TABLE = np.array([1.0, 2.0])
STEPS = (1, 2)

def g(x):
    return x + 1

def f(x, k=3):
    return g(x) * SPEED + TABLE[0] + STEPS[1] + second.h(x) + second.FAR + math.pi
"""
SECOND = "SPEED = 2\nFAR = 5\nUNREAD = 1\ndef h(x):\n    return i(x)\ndef i(x):\n    return x\n"


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (("x + 1", "x + 2"), None),
        (("2.0]", "2.5]"), None),
        (("(1, 2)", "(1, 3)"), None),
        (("k=3", "k=4"), None),
        (("* SPEED", "* -SPEED"), None),
        (None, ("SPEED = 2", "SPEED = 2.0")),
        (None, ("FAR = 5", "FAR = 6")),
        (None, ("return x\n", "return -x\n")),
    ],
)
def test_a_fingerprint_is_another_when_anything_that_is_read_is_another(written, first, second):
    before = fingerprint(written(BEFORE, second=SECOND))
    assert fingerprint(written(BEFORE, second=SECOND)) == before
    changed = BEFORE.replace(*first) if first else BEFORE
    changed_second = SECOND.replace(*second) if second else SECOND
    assert fingerprint(written(changed, second=changed_second)) != before


def test_a_fingerprint_stays_when_something_else_is_edited(written):
    before = fingerprint(written(BEFORE, second=SECOND))
    commented = re.sub(r"^def", "# a comment\ndef", BEFORE, flags=re.MULTILINE)
    assert fingerprint(written(commented, second=SECOND.replace("= 1", "= 9"))) == before


def test_a_fingerprint_ends_where_functions_call_each_other(written):
    text = "def g(x):\n    return f(x)\ndef f(x):\n    return g(x) if x else 0\n"
    assert len(fingerprint(written(text, second=""))) == 64
    closed = (lambda y: lambda x: x + y)(np.float64(2.0))
    assert fingerprint(closed) != fingerprint((lambda y: lambda x: x + y)(np.float64(3.0)))
