"""coglogo_py stands alone: the page about it, its plain Mesa model, and what it imports."""

import doctest
import re
import subprocess
import sys
from pathlib import Path

import pytest

from coglogo_py import Mind, Society

CHECKOUT = Path(__file__).parents[2]
PAGE = (CHECKOUT / "docs" / "coglogo_py.md").read_text(encoding="utf-8")

BLOCKING = "import sys; sys.modules['socialmind'] = None\n"
"""From then on `import socialmind` fails."""


def run(program):
    return subprocess.run(
        [sys.executable, "-c", program],
        cwd=CHECKOUT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def mesa_program():
    (program,) = re.findall(r"```python\n(import mesa\n.*?)```", PAGE, re.DOTALL)
    return program


def test_the_plain_mesa_model_of_the_page_runs_without_socialmind():
    one, other = run(BLOCKING + mesa_program()), run(mesa_program())
    assert one.returncode == 0, one.stderr
    lines = one.stdout.splitlines()
    assert len(lines) == 100
    counts = [list(map(int, re.findall(r"\d+", line)[1:])) for line in lines]
    assert all(len(row) == 3 and sum(row) == 20 for row in counts)
    assert all(sum(row[plan] for row in counts) > 0 for plan in range(3))
    assert one.stdout == other.stdout


def test_blocking_socialmind_does_block_it():
    assert "ModuleNotFoundError" in run(BLOCKING + "import socialmind").stderr


def test_the_plain_mesa_model_is_short_and_uses_nothing_that_mesa_drops():
    program = mesa_program()
    assert len(program.splitlines()) <= 40
    assert "rng=rng" in program
    assert not re.search(r"super\(\).__init__\([^)]*seed|\.steps|batch_run|mesa\.space", program)


def test_importing_coglogo_py_imports_none_of_the_heavy_packages():
    result = run(
        "import sys, coglogo_py\n"
        "coglogo_py.Society(coglogo_py.CognitiveScheme('empty'), seed=1).new_mind()\n"
        "print(sorted({'mesa', 'pandas', 'pyarrow', 'socialmind'} & set(sys.modules)))"
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.strip() == "[]"


def test_the_examples_of_the_page_give_what_it_says():
    blocks = re.findall(r"```pycon\n(.*?)```", PAGE, re.DOTALL)
    assert len(blocks) >= 3
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "coglogo_py.md", None, None)
    messages = []
    doctest.DocTestRunner(verbose=False).run(test, out=messages.append)
    assert not messages, "".join(messages)


@pytest.mark.parametrize("kind", [Society, Mind])
def test_the_page_names_every_command(kind):
    commands = {
        name for name, value in vars(kind).items() if callable(value) and not name.startswith("_")
    }
    assert {name for name in commands if f".{name}(" not in PAGE} == set()
