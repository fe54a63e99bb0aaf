"""What decides how a model runs is found, hashed and kept: files, modules and data, wherever."""

import importlib
import json
import subprocess
import sys
import textwrap

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, replay, resume, run
from socialmind.sources import modules
from socialmind.sources.folders import source_hash
from socialmind.sources.provenance import difference, sources_of

MODEL = """
import csv
from pathlib import Path

from socialmind import Agent, Model, Population, each
from town.rules import LENGTH, grow
from .parts import half

HERE = Path(__file__).parent
with (HERE / "start.csv").open() as table:
    START = float(next(csv.reader(table))[0])

class Tree(Agent):
    height: float = START

def live(tree):
    tree.height += half(grow(LENGTH))

class Wood(Model):
    trees = Population(Tree, 3)
    schedule = (each(trees, live),)
    ticks = 10

    def series(self):
        rate = float((HERE / "rate.txt").read_text())
        return {"height": float(self.trees.height.mean()) * rate}
"""
FILES = {
    "wood/model.py": MODEL,
    "wood/parts.py": "def half(x):\n    return x / 2\n",
    "wood/start.csv": "1.5\n",
    "wood/rate.txt": "2.0",
    "wood/README.md": "A wood.",
    "wood/figures.py": "def draw(run):\n    return {}\n",
    "lib/town/__init__.py": "",
    "lib/town/rules.py": (
        "from town.numbers import TWO\nLENGTH = 4.0\ndef grow(x):\n    return x * TWO\n"
    ),
    "lib/town/numbers.py": "TWO = 2.0\n",
    "lib/town/unused.py": "THREE = 3.0\n",
}


@pytest.fixture
def wood(tmp_path, monkeypatch):
    """A model with a library beside it; called again, it loads what stands there now."""
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.syspath_prepend(tmp_path / "lib")
    monkeypatch.setattr(sys, "dont_write_bytecode", True)

    def forget():
        for name, module in list(sys.modules.items()):
            if str(getattr(module, "__file__", None)).startswith(str(tmp_path)):
                del sys.modules[name]
        importlib.invalidate_caches()

    def load():
        forget()  # as another process would find them
        return load_model(tmp_path / "wood")

    yield load
    forget()


def test_code_is_found_through_its_imports_and_data_as_it_is_read(wood):
    labels = set(sources_of(wood()).files)
    assert labels == {
        "model/model.py",
        "model/parts.py",
        "model/start.csv",
        "model/rate.txt",  # named in the code
        "modules/town/__init__.py",
        "modules/town/rules.py",
        "modules/town/numbers.py",
    }


def test_what_a_society_reads_when_asked_counts_and_what_others_read_does_not(wood, tmp_path):
    model = tmp_path / "wood" / "model.py"
    model.write_text(MODEL.replace('"rate.txt"', '"".join(("ra", "te.txt"))'))  # named nowhere
    kind = wood()
    (tmp_path / "mine.txt").write_text("1")
    (tmp_path / "mine.txt").read_text()
    assert "model/rate.txt" not in sources_of(kind).files
    run(kind, ticks=1, out=tmp_path / "run", compiled=False)
    found = sources_of(kind).files
    assert "model/rate.txt" in found
    assert not any(path.name == "mine.txt" for path in found.values())
    assert socialmind_files() == []


def socialmind_files():
    """Return the modules of the library that count as readers of files."""
    return [name for name in modules._read_by if name.startswith(("socialmind.", "coglogo_py."))]


EDITS = {
    "wood/model.py": ("half(grow", "2 * half(grow"),
    "wood/parts.py": ("/ 2", "/ 4"),
    "wood/start.csv": ("1.5", "2.5"),
    "wood/rate.txt": ("2.0", "3.0"),
    "lib/town/rules.py": ("x * TWO", "x + TWO"),
    "lib/town/numbers.py": ("2.0", "2.5"),
}


@pytest.mark.parametrize("file", EDITS)
def test_a_run_does_not_go_on_with_an_edited_file(wood, tmp_path, file):
    folder = run(wood(), ticks=4, out=tmp_path / "run", compiled=False)
    path, (old, new) = tmp_path / file, EDITS[file]
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(SocialmindError, match=rf"{path.name}: is not .*--source kept"):
        resume(folder, ticks=8, model_class=wood())
    with pytest.raises(SocialmindError, match=path.name):
        resume(folder, ticks=8)
    again = replay(folder, model_class=wood())
    assert not again.equal
    assert path.name in again.notes[0]
    path.write_text(FILES[file])
    assert replay(folder, model_class=wood()).equal
    resume(folder, ticks=8, model_class=wood())


@pytest.mark.parametrize("file", ["wood/README.md", "wood/figures.py", "lib/town/unused.py"])
def test_what_decides_nothing_may_be_edited(wood, tmp_path, file):
    folder = run(wood(), ticks=4, out=tmp_path / "run", compiled=False)
    (tmp_path / file).write_text("# another\ndef draw(run):\n    return {}\n")
    assert replay(folder, model_class=wood()).notes == ()
    resume(folder, ticks=8, model_class=wood())


def test_runs_within_the_models_folder_are_no_sources_of_it(wood, tmp_path):
    home = tmp_path / "wood"
    labels = set(sources_of(wood()).files)
    folder = run(wood(), ticks=4, out=home / "runs" / "first", compiled=False)
    assert (folder / "source" / "model" / "model.py").is_file()
    assert set(sources_of(wood()).files) == labels
    assert replay(folder, model_class=wood()).notes == ()
    resume(folder, ticks=8, model_class=wood())
    again = run(wood(), ticks=8, out=home / "runs" / "second", compiled=False)
    assert set(Run(again).manifest.model["sources"]["files"]) == labels
    assert Run(folder).manifest.model["source_sha256"] == source_hash(home)


def test_a_run_goes_on_with_its_own_copies(wood, tmp_path):
    whole = run(wood(), ticks=8, out=tmp_path / "whole", compiled=False)
    folder = run(wood(), ticks=4, out=tmp_path / "run", compiled=False)
    for file, (old, new) in EDITS.items():
        path = tmp_path / file
        path.write_text(path.read_text().replace(old, new))
    resume(folder, ticks=8, kept=True)
    assert Run(folder).series["height"].tolist() == Run(whole).series["height"].tolist()
    assert replay(folder, kept=True).equal
    assert wood().trees is not None  # today's files are loaded as they are again
    (folder / "source" / "model" / "parts.py").write_text("def half(x):\n    return x\n")
    with pytest.raises(SocialmindError, match=r"source/model/parts.py: is not the file"):
        resume(folder, ticks=12, kept=True)


def test_a_file_edited_after_it_was_loaded_is_not_recorded_as_what_ran(wood, tmp_path):
    loaded = wood()
    (tmp_path / "lib/town/numbers.py").write_text("TWO = 5.0\n")
    with pytest.raises(SocialmindError, match=r"numbers.py: was edited since it was loaded"):
        run(loaded, ticks=4, out=tmp_path / "run", compiled=False)


def test_records_of_equal_files_are_equal_in_any_folder(wood, tmp_path):
    one = sources_of(wood()).record()
    assert difference(json.loads(json.dumps(one)), sources_of(wood())) is None
    assert sources_of(wood()).record() == one


SCRIPT = """
    import sys
    from socialmind import Agent, Model, Population, each
    from socialmind.experiments import run
    from weights import HEAVY

    class Stone(Agent):
        mass: float = 1.0

    def gather(stone):
        stone.mass += HEAVY

    class Stones(Model):
        stones = Population(Stone, 2)
        schedule = (each(stones, gather),)

        def series(self):
            return {"mass": float(self.stones.mass.sum())}

    if __name__ == "__main__":
        run(Stones, ticks=5, out=sys.argv[1], compiled=False)
"""


def test_a_model_in_a_script_is_run_resumed_and_replayed(tmp_path):
    script = tmp_path / "stones.py"
    script.write_text(textwrap.dedent(SCRIPT))
    (tmp_path / "weights.py").write_text("HEAVY = 2.0\n")
    command = [sys.executable, str(script), str(tmp_path / "run")]
    subprocess.run(command, check=True, cwd=tmp_path)
    assert Run(tmp_path / "run").series["mass"].tolist() == [2.0, 6.0, 10.0, 14.0, 18.0, 22.0]
    assert replay(tmp_path / "run").equal
    resume(tmp_path / "run", ticks=6)
    script.write_text(script.read_text() + "\n# a comment\n")
    with pytest.raises(SocialmindError, match=r"stones\.py"):
        resume(tmp_path / "run", ticks=7)
    resume(tmp_path / "run", ticks=7, kept=True)
    assert Run(tmp_path / "run").series["mass"].tolist()[-1] == 30.0
    assert run(load_model(script), ticks=1, out=tmp_path / "named", compiled=False)


TYPED = """
from socialmind import Agent, Model, Population, once
from socialmind.experiments import run
{setting}
def fall(model):
    model.height -= STEP
class Stones(Model):
    height: float = 9.0
    stones = Population(Agent, 2)
    schedule = (once(fall),)
run(Stones, ticks=5, out={out!r}, compiled=False)
"""


def typed_run(folder, setting):
    """A run of a model that is given to Python with -c, and so stands in no file."""
    code = TYPED.format(out=str(folder), setting=setting)
    subprocess.run([sys.executable, "-c", code], check=True)
    return folder


def test_a_class_that_no_file_defines_is_kept_as_one(tmp_path):
    folder = typed_run(tmp_path / "run", "STEP = 0.5")
    assert list(Run(folder).manifest.model["sources"]["files"]) == ["model/cells.py"]
    assert replay(folder).exact and not replay(folder).differences
    resume(folder, ticks=6)
    assert Run(folder).series["height"].tolist() == [9.0, 8.5, 8.0, 7.5, 7.0, 6.5, 6.0]
    copy = folder / "source/model/cells.py"
    copy.write_text(copy.read_text().replace("0.5", "1.5"))
    with pytest.raises(SocialmindError, match=r"cells\.py: is not the file"):
        resume(folder, ticks=7)


def test_a_class_that_cannot_be_kept_as_a_file_is_asked_for(tmp_path):
    locked = "import threading\nSTEP, LOCK = 0.5, threading.Lock()"
    folder = typed_run(tmp_path / "run", locked)
    assert replay(folder).exact  # the lock is nothing to the model
    held = "\nclass Agent(Agent):\n    def held(self):\n        return LOCK"
    folder = typed_run(tmp_path / "other", locked + held)
    with pytest.raises(SocialmindError, match=r"typed into a notebook.* give the class"):
        resume(folder, ticks=6)
