"""Folders of MetaCiv's, imported as a whole: refused or written, whatever they hold."""

import ast
import pickle
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.metaciv.importing import ImportRefusedError, import_model

from .reading.folders import FARMERS, written
from .reading.test_damaged import damaged

OURS = ("socialmind", "coglogo_py", "math", "matplotlib", "numpy", "pathlib")
HOSTILE = {
    "Work": "a\"\"\"b'''\\",
    "Brown bread": "x\\\"{0}%s # y",
    "Sack of corn": "\\N{DIGIT ONE}",
    "energy": "éner\"gy",
    "meal": "1+1",
    "Village": "__import__('os')",
    "chief": "None",
    "member": "{member}",
    "Hungry": "class",
    "Will": "self",
    "Farmers": "<b>&",
    "Farmer": "model.py",
    "Corn": "{{corn}}",
    "Grass": "|a|b|",
    "Mill": "def f() -> 1",
    "Valley": "*map*",
}  # fmt: skip


def hostile(text):
    """A file in which all names are such as programs are written of."""
    for old, new in HOSTILE.items():
        text = text.replace(f" {old}", f" {new}").replace(f",{old}", f",{new}")
    return text.replace("Village:", HOSTILE["Village"] + ":").replace(
        ":chief", ":" + HOSTILE["chief"]
    )


def imports_of(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module


def test_damaged_folders_are_refused_or_become_programs(tmp_path):
    imported = 0
    for number in range(100):
        folder, out = tmp_path / str(number), tmp_path / f"out {number}"
        try:
            written(folder, damaged(number))
        except OSError:  # a name that this system does not take
            continue
        try:
            import_model(folder, out)
        except ImportRefusedError as error:
            assert not out.exists() and error.findings
            continue
        for file in out.glob("*.py"):
            tree = ast.parse(file.read_text("utf-8"))
            assert {one.partition(".")[0] for one in imports_of(tree)} <= set(OURS)
        imported += 1
    assert imported > 10


def test_names_are_never_code(tmp_path):
    files = {file: hostile(text) for file, text in FARMERS.items()}
    files["parametres.metaciv"] = files["parametres.metaciv"].replace("*map*.metaciv", "*map*")
    import_model(written(tmp_path / "m", files), tmp_path / "ours")
    model = load_model(tmp_path / "ours")(seed=1, compiled=False)
    for _ in range(8):
        model.step()
    assert len(model.humans) == 2


def test_what_is_refused_says_all_and_crosses_processes(tmp_path):
    plan = "schemasCognitifs/Farmer/plans/Work.metaciv"
    bad = {**FARMERS, plan: "Nom : Work\nAction : A_Sleep\nAction : A_Eat\n"}
    with pytest.raises(ImportRefusedError, match="2 errors; nothing was written") as refused:
        import_model(written(tmp_path / "bad", bad), tmp_path / "ours")
    again = pickle.loads(pickle.dumps(refused.value))
    assert (str(again), again.findings) == (str(refused.value), refused.value.findings)
    assert len(again.findings) == 2


def test_the_current_folder_may_be_the_one_to_fill(tmp_path, monkeypatch):
    folder, here = written(tmp_path / "m", FARMERS), tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    import_model(folder, ".")
    assert {one.name for one in Path().iterdir()} >= {"model.py", "scheme.yaml", "README.md"}
    assert [one.name for one in tmp_path.iterdir() if one.name.endswith(".partial")] == []


def test_a_folder_that_holds_something_is_left_alone(tmp_path):
    folder = written(tmp_path / "m", FARMERS)
    (tmp_path / "file").write_text("mine")
    for out in (folder, tmp_path / "file"):
        with pytest.raises(SocialmindError, match=r"give a (fresh )?folder"):
            import_model(folder, out)
