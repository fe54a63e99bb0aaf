"""Finding and loading models."""

import sys
from pathlib import Path

import pytest

from socialmind import Model
from socialmind.catalogue import load_figures, load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import run, score, sweep
from socialmind.sources.folders import catalogue, model_folder, source_hash

MODEL = """
from socialmind import Model

class Town(Model):
    ticks = 7
"""


def write(folder, **files):
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text)
    return folder


def test_every_model_that_ships_loads_under_its_name():
    assert list(catalogue()) == sorted(catalogue())
    assert {"farmer_artisan", "tutorial"} <= set(catalogue())
    for name, folder in catalogue().items():
        model = load_model(name)
        assert issubclass(model, Model)
        assert Path(sys.modules[model.__module__].__file__) == folder / "model.py"


def test_a_hyphen_stands_for_an_underscore():
    assert load_model("farmer-artisan") is load_model("farmer_artisan")
    assert model_folder("farmer-artisan") == catalogue()["farmer_artisan"]


def test_a_model_is_given_by_its_folder_or_its_file(tmp_path, monkeypatch):
    folder = write(tmp_path / "town", model=MODEL)
    monkeypatch.chdir(tmp_path)
    model = load_model(folder)
    assert model.ticks == 7
    for other in ("town", "./town", "town/", folder / "model.py", str(folder)):
        assert load_model(other) is model
    assert load_model(model) is model


@pytest.mark.parametrize("something", [None, 3, int, object()])
@pytest.mark.parametrize("takes", [load_model, run, sweep, score])
def test_what_is_no_model_is_refused(takes, something):
    with pytest.raises(SocialmindError, match=r"^model: found .*; expected a model's class, its n"):
        takes(something)


def test_a_society_is_not_its_class():
    with pytest.raises(SocialmindError, match="give its class"):
        load_model(load_model("tutorial")(seed=1))


def test_a_name_that_ships_comes_before_a_folder(tmp_path, monkeypatch):
    write(tmp_path / "tutorial", model=MODEL)
    monkeypatch.chdir(tmp_path)
    assert load_model("tutorial").__name__ == "Tutorial"
    assert load_model("./tutorial").__name__ == "Town"


def test_loading_leaves_no_trace(tmp_path):
    paths = list(sys.path)
    folder = write(tmp_path / "town", model="from .streets import N\n" + MODEL, streets="N = 1")
    load_model(folder)
    assert sys.path == paths
    assert "model" not in sys.modules
    assert sorted(p.name for p in folder.iterdir()) == ["model.py", "streets.py"]


def test_siblings_of_two_models_stay_apart(tmp_path):
    text = "from .rules import LENGTH\n" + MODEL.replace("7", "LENGTH")
    first = write(tmp_path / "first", model=text, rules="LENGTH = 1")
    second = write(tmp_path / "second", model=text, rules="LENGTH = 2")
    assert (load_model(first).ticks, load_model(second).ticks) == (1, 2)


def test_a_changed_model_is_loaded_afresh(tmp_path):
    folder = write(tmp_path / "town", model="from .rules import N\n" + MODEL, rules="N = 1")
    before = load_model(folder)
    (folder / "model.py").write_text(MODEL.replace("7", "8"))  # same length, same second
    assert load_model(folder).ticks == 8
    (folder / "rules.py").write_text("N = 2")
    assert load_model(folder) is not before


def test_the_model_can_be_named_among_several(tmp_path):
    two = MODEL + "\nclass City(Town):\n    ticks = 9\n"
    with pytest.raises(
        ModelError, match=r"found 2 models \(Town, City\); expected one; add a line"
    ):
        load_model(write(tmp_path / "two", model=two))
    assert load_model(write(tmp_path / "one", model=two + "\nmodel = Town\n")).ticks == 7
    assert load_model(write(tmp_path / "alias", model=MODEL + "\nVillage = Town\n")).ticks == 7


def test_a_file_beside_the_model_that_builds_on_it_is_a_model_too(tmp_path):
    variant = "from .model import Town\n\nclass Hamlet(Town):\n    ticks = 3\n"
    folder = write(tmp_path / "town", model=MODEL, hamlet=variant)
    assert load_model(folder / "hamlet.py").ticks == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = 1", r"model.py: found no model; expected one subclass of socialmind.Model"),
        ("from socialmind import Model", r"model.py: found no model"),
        (
            MODEL + "\nmodel = Town()",
            r"model.py: found `model` set to .*; write `model = YourModel`",
        ),
        ("x = 1\ny = (", r"model.py:2: not valid Python \('\(' was never closed\)"),
        ("x = 1\nx.y", r"model.py:2: loading stopped with AttributeError"),
        ("\nimport streets", r"model.py:2: .*; write `from . import streets` for a file"),
        ("import strets", r"model.py:1: .*No module named 'strets'; install strets, or correct"),
        ("from .houses import x", r"houses.py:3: loading stopped with ZeroDivisionError"),
        ("from .broken import x", r"broken.py:1: not valid Python"),
        ("\0", r"model.py"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_line(tmp_path, text, message):
    folder = write(
        tmp_path / "town", model=text, streets="", houses="x = 1\n\n1 / 0", broken="x = = 2"
    )
    for _ in range(2):  # no half-loaded module is left to be found
        with pytest.raises(ModelError, match=message):
            load_model(folder)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("tutorail", "no model called tutorail; did you mean 'tutorial'?"),
        ("tutorial/x", "tutorial/x: no such folder; a model is a folder with a model.py"),
        ("empty", "empty: not a model, it holds no model.py; `socialmind new"),
    ],
)
def test_a_model_that_is_not_there(tmp_path, monkeypatch, name, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    with pytest.raises(SocialmindError) as found:
        load_model(name)
    assert message in str(found.value)


def test_the_source_hash_sees_what_decides_a_run_and_nothing_else(tmp_path):
    folder = write(tmp_path / "town", model=MODEL, rules="x = 1")
    before = source_hash(folder)
    (folder / "README.md").write_text("words")
    (folder / "figures.py").write_text("x = 1")
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "x.py").write_text("")
    assert source_hash(folder) == before
    (folder / "rules.py").write_text("x = 2")
    changed = source_hash(folder)
    assert changed != before
    (folder / "rules.py").rename(folder / "norms.py")
    assert source_hash(folder) not in (before, changed)


def test_figures_are_loaded_apart_from_the_model(tmp_path):
    folder = write(tmp_path / "town", model=MODEL)
    assert load_figures(folder) is None
    write(folder, figures="from .colours import RED\ndef draw(run): return RED", colours="RED = 5")
    assert load_figures(folder).draw(None) == 5
    write(folder, figures="draw = 3")
    with pytest.raises(ModelError, match=r"figures.py: no function draw\(run\)"):
        load_figures(folder)


def test_the_source_hash_leaves_out_other_minds(tmp_path):
    folder = write(tmp_path / "town", model=MODEL)
    before = source_hash(folder)
    (folder / "mind_of_others").mkdir()
    write(folder / "mind_of_others", go="def go(): return 1.0")
    assert source_hash(folder) == before
    (folder / "mind").mkdir()
    write(folder / "mind", go="def go(): return 1.0")
    assert source_hash(folder) != before


FROM_ANOTHER = """
from socialmind.sources.loading import load_file
from socialmind.sources.folders import model_folder
TOWN = load_file(model_folder("{name}") / "model.py")
"""


def test_the_source_hash_sees_the_other_models_that_it_loads(tmp_path, monkeypatch):
    town = write(tmp_path / "town", model=MODEL)
    port = write(tmp_path / "port", model=FROM_ANOTHER.format(name="town") + MODEL, rules="x = 1")
    city = write(tmp_path / "city", model=FROM_ANOTHER.format(name="port") + MODEL)
    apart = write(tmp_path / "apart", model=FROM_ANOTHER.format(name="nowhere") + MODEL)
    known = {one.name: one for one in (town, port, city, apart)}
    monkeypatch.setattr("socialmind.sources.folders.catalogue", lambda: known)
    before = {name: source_hash(one) for name, one in known.items()}
    file = source_hash(port / "model.py")
    loaded = load_model(city)
    (town / "model.py").write_text(MODEL.replace("7", "8"))
    assert {name for name, one in known.items() if source_hash(one) != before[name]} == {
        "town", "port", "city"
    }  # fmt: skip
    assert source_hash(port / "model.py") != file
    assert load_model(city) is not loaded


def test_the_source_hash_of_models_that_load_each_other_ends(tmp_path, monkeypatch):
    one = write(tmp_path / "one", model=FROM_ANOTHER.format(name="two") + MODEL)
    two = write(tmp_path / "two", model=FROM_ANOTHER.format(name="one") + MODEL)
    monkeypatch.setattr("socialmind.sources.folders.catalogue", lambda: {"one": one, "two": two})
    before = source_hash(one)
    (two / "model.py").write_text(FROM_ANOTHER.format(name="one") + MODEL.replace("7", "8"))
    assert source_hash(one) != before
