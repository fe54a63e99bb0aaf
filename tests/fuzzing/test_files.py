"""Damaged and hostile files: each loads, or is refused in one line, and never anything else.

The seed changes from day to day; SOCIALMIND_FUZZ_SEED sets it, SOCIALMIND_FUZZ_COUNT how many
files of each format are tried.
"""

import os
import random
import warnings

import pytest

from coglogo_py import CogLogoError, CognitiveScheme
from coglogo_py.parts import Cogniton, Culturon, Group, Role
from socialmind.errors import SocialmindError
from socialmind.mind import MindDescription, Perceptron, Skill, Variable
from socialmind.mind.files.evoagents.simbatch import Task
from socialmind.mind.files.evoagents.text_file import text_of
from socialmind.mind.files.folder import load_tasks, save_tasks
from socialmind.mind.files.layout import layout_file, parse
from socialmind.mind.regulation import Counter
from tests.fuzzing.faults import SEED, mutated

COUNT = int(os.environ.get("SOCIALMIND_FUZZ_COUNT", "60"))
HOSTILE = [
    b"9" * 5000, b"-1", b"nan", b"1e999", b"\0", b"\xff\xfe", b"\xef\xbb\xbf", b"[" * 500,
    b"*a", b"&a [*a, *a]", b"\r", b"\r\n", b"..", b"/dev/zero", b"\x1b[31m", b"a" * 5000, b":",
    "\N{ARABIC-INDIC DIGIT THREE}".encode(), "\N{SUPERSCRIPT TWO}".encode(), b"\xe9", b"{", b"- ",
    b"#",
]  # fmt: skip
FORMATS = (
    ".cogscheme", ".yaml", ".botdesc", ".vardesc", ".ades", ".genome", ".simbatch", ".layout",
    "mind",
)  # fmt: skip


def sample(ending, folder):
    """A sound file of a format, and what loads it."""
    if ending in (".cogscheme", ".yaml"):
        links = {"influence": {"eat": 2.5}, "conditional": ("eat",), "reinforcement": {"eat": 1}}
        placed = (3, -40) if ending == ".yaml" else None
        role = Role("cow", (Culturon("Peace", 1, **links),), placed)
        group = Group("herd", (role,), position=placed)
        path = folder / f"cows{ending}"
        CognitiveScheme("cows", (Cogniton("Hunger", **links),), (group,)).save(path)
        return path, lambda: CognitiveScheme.load(path).check()
    weights = Skill("Go", ["SE:Eye", "VA:N"], ["MO:L"], Perceptron(layers=0), [0.5, -1.25, 3.0])
    mind = MindDescription("seeker", ["Eye"], ["L"], [Variable("N", Counter(5))], [weights])
    if ending == "mind":
        path = folder / "seeker.yaml"
        mind.save(path)
        return path, lambda: MindDescription.load(path)
    mind.save(folder / "m")
    if ending == ".layout":
        path = layout_file(folder / "m")
        path.write_text("SENSORS\nEye:-190:40\nSKILLS\nGo:230:0\n")
        return path, lambda: parse(text_of(path), path)
    save_tasks({"Go": Task("LEARN2DSIM", master_skill="Go", generations=5)}, folder / "m")
    (path,) = (folder / "m").rglob(f"*{ending}")
    return path, lambda: (MindDescription.load(folder / "m"), load_tasks(folder / "m"))


@pytest.mark.parametrize("ending", FORMATS)
def test_a_damaged_file_loads_or_is_refused_in_one_line(ending, tmp_path):
    path, load = sample(ending, tmp_path)
    sound = path.read_bytes()
    load()
    for number in range(COUNT):
        name = f"{SEED}/{ending}/{number}"
        path.write_bytes(mutated(sound, random.Random(name), HOSTILE))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                load()
        except (CogLogoError, SocialmindError) as error:
            assert "\n" not in str(error), (name, str(error))
            assert len(str(error)) <= 1000, (name, str(error))
        except BaseException as error:
            pytest.fail(f"seed {name}: {type(error).__name__}: {error}")


ALIASES = "name: b\na: &a [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{to}: &{to} [{', '.join([f'*{of}'] * 10)}]\n"
    for of, to in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ALIASES, "more than 200,000 names"),
        ("name: b\nbreeds: &a [" + "x, " * 1000 + "]\nplans: [" + "*a, " * 1000 + "]\n", "200,000"),
        ("name: b\nbreeds: " + "[" * 5000, "50 deep"),
        ("name: b\nbreeds: &a [*a]\n", "within what it stands for"),
        ("x" * 5_000_000, "more than 4 MB"),
    ],
)
@pytest.mark.parametrize("load", [CognitiveScheme.load, MindDescription.load])
def test_a_bomb_is_refused_by_a_limit(tmp_path, load, text, words):
    path = tmp_path / "bomb.yaml"
    path.write_text(text)
    with pytest.raises((CogLogoError, SocialmindError), match=words):
        load(path)


@pytest.mark.skipif(os.name == "nt", reason="POSIX files")
@pytest.mark.parametrize("load", [CognitiveScheme.load, MindDescription.load])
def test_what_is_no_file_is_refused(tmp_path, load):
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "loop.yaml").symlink_to(tmp_path / "loop.yaml")
    (tmp_path / "zero.yaml").symlink_to("/dev/zero")
    for name in ("pipe", "loop", "zero"):
        with pytest.raises((CogLogoError, SocialmindError)):
            load(tmp_path / f"{name}.yaml")
