"""Fields of patches from maps: which way up, which sizes, and what is refused."""

import json

import numpy as np
import pytest
from PIL import Image

from socialmind import Grid, Model, Patch, Torus, parameter
from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.runs.execution import run
from socialmind.runs.verification import replay


class Land(Patch):
    height_above: float = -1.0
    kind: int = 0
    wet: bool = False
    owner: int | None = None
    years: list[int] = [0] * 2


class Valley(Model):
    world = Grid(3, 2, wraps=False, patch=Land, low=(0, 0))


MODEL = """
from socialmind import Grid, Model, Patch, once, parameter


class Land(Patch):
    rock: float = 0.0
    kind: int = 0


def weather(model):
    for patch in model.world.patches:
        patch.rock *= 0.5


class Valley(Model):
    wanted: str = parameter("kinds.csv", choices=("kinds.csv", "other.csv"))
    world = Grid(3, 2, patch=Land, maps={"rock": ("rock.png", 0.0, 255.0), "kind": "wanted"})
    setup = (once(weather),)
    schedule = (once(weather),)
"""


@pytest.fixture
def valley():
    return Valley(compiled=False).world


def test_the_first_line_of_a_csv_is_the_north(valley, tmp_path):
    (tmp_path / "map.csv").write_text("1,2,3\n\n4, 5.5,6\n")
    valley.load("height_above", tmp_path / "map.csv")
    assert valley.patch(0, 1).height_above == 1.0  # north-west
    assert valley.patch(2, 1).height_above == 3.0
    assert valley.patch(0, 0).height_above == 4.0  # south-west
    assert valley.patch(1, 0).height_above == 5.5
    (tmp_path / "map.csv").write_text("1,,3\n4,5,\n")
    valley.load("owner", tmp_path / "map.csv")
    assert valley.owner.tolist() == [[4, 1], [5, None], [None, 3]]
    (tmp_path / "map.csv").write_text("true,0,1\nFalse,1,1\n")
    valley.load("wet", tmp_path / "map.csv")
    assert valley.wet.tolist() == [[False, True], [True, False], [True, True]]


def test_the_top_of_a_picture_is_the_north(valley, tmp_path):
    grey = np.array([[0, 51, 102], [153, 204, 255]], np.uint8)
    Image.fromarray(grey).save(tmp_path / "map.png")
    valley.load("height_above", tmp_path / "map.png")
    assert valley.height_above.tolist() == [[0.6, 0.0], [0.8, 0.2], [1.0, 0.4]]
    valley.load("height_above", str(tmp_path / "map.png"), low=100.0, high=0.0)
    assert valley.patch(0, 1).height_above == 100.0 and valley.patch(2, 0).height_above == 0.0
    valley.load("kind", tmp_path / "map.png", 0, 10)
    assert valley.kind.tolist() == [[6, 0], [8, 2], [10, 4]]
    valley.load("wet", tmp_path / "map.png")
    assert valley.wet.tolist() == [[True, False], [True, False], [True, False]]
    Image.fromarray(np.array([[0, 65535, 0], [0, 0, 13107]], np.uint16)).save(tmp_path / "deep.png")
    valley.load("height_above", tmp_path / "deep.png")
    assert valley.patch(1, 1).height_above == 1.0 and valley.patch(2, 0).height_above == 0.2
    Image.new("RGB", (3, 2), (255, 255, 255)).save(tmp_path / "white.png")
    valley.load("height_above", tmp_path / "white.png")
    assert (valley.height_above == 1.0).all()


def test_an_array_is_as_the_world_gives_it(valley):
    valley.load("height_above", np.arange(6.0).reshape(3, 2))
    assert valley.patch(0, 1).height_above == 1.0 and valley.patch(1, 0).height_above == 2.0
    valley.load("kind", valley.height_above)
    assert valley.kind.tolist() == [[0, 1], [2, 3], [4, 5]]


@pytest.mark.parametrize(
    ("text", "field", "expected"),
    [
        ("1,2,3\n4,5\n", "kind", r"map\.csv, line 2: found 2 values; expected 3"),
        ("1,2,3\n", "kind", r"map\.csv: found a map of 3 × 1; expected 3 × 2, a value for each"),
        ("1,2,3\n4,five,6\n", "kind", r"map\.csv, line 2, column 2: found 'five'; expected a num"),
        ("1,2,3\n4,5.5,6\n", "kind", r"'kind' of the world of <patch 1 0>: found 5\.5; expected a"),
        ("1,2,3\n4,,6\n", "kind", r"line 2, column 2: found ''"),
        ("1,2,3\n4,5,6\n", "years", "a map for 'years'; expected a field of one number"),
        ("1,2,3\n4,5,6\n", "kin", "no field 'kin'; did you mean 'kind'"),
    ],
)
def test_what_does_not_fit_is_named(text, field, expected, valley, tmp_path):
    (tmp_path / "map.csv").write_text(text)
    with pytest.raises(SocialmindError, match=expected):
        valley.load(field, tmp_path / "map.csv")
    assert (valley.kind == 0).all()


def test_what_is_no_map_is_refused(valley, tmp_path):
    Image.new("L", (2, 2)).save(tmp_path / "small.png")
    (tmp_path / "no.png").write_text("no picture")
    (tmp_path / "map.csv").write_text("1,2,3\n4,5,6\n")
    Image.new("F", (3, 2)).save(tmp_path / "floats.tif")
    for source, expected in [
        ("small.png", "found a map of 2 × 2; expected 3 × 2"),
        ("no.png", "expected a picture"),
        ("gone.png", "No such file.*; expected a picture"),
        ("gone.csv", "No such file.*; expected a CSV"),
        ("map.txt", "the kind '.txt'; expected .csv, or a picture"),
        ("floats.tif", "of which none is white"),
    ]:
        with pytest.raises(SocialmindError, match=expected):
            valley.load("height_above", tmp_path / source)
    with pytest.raises(SocialmindError, match=r"map\.csv: low= and high= for a CSV"):
        valley.load("height_above", tmp_path / "map.csv", 0.0, 1.0)
    with pytest.raises(SocialmindError, match="for an array; expected them for a picture"):
        valley.load("height_above", np.zeros((3, 2)), high=1.0)
    with pytest.raises(SocialmindError, match=r"found the shape \(2, 3\); expected \(3, 2\)"):
        valley.load("height_above", np.zeros((2, 3)))
    assert (valley.height_above == -1.0).all()


def test_a_model_begins_with_its_maps_and_its_run_is_replayed(tmp_path):
    folder = tmp_path / "valley"
    folder.mkdir()
    (folder / "model.py").write_text(MODEL)
    (folder / "kinds.csv").write_text("1,2,3\n4,5,6\n")
    (folder / "other.csv").write_text("7,8,9\n7,8,9\n")
    Image.fromarray(np.array([[0, 2, 4], [6, 8, 10]], np.uint8)).save(folder / "rock.png")
    model = load_model(str(folder))
    for compiled in (True, False):
        society = model(compiled=compiled)
        assert society.world.rock.tolist() == [[3.0, 0.0], [4.0, 1.0], [5.0, 2.0]]
        assert society.world.kind.tolist() == [[4, 1], [5, 2], [6, 3]]
    assert (model(wanted="other.csv").world.kind[0] == 7).all()
    kept = run(model, ticks=2, out=tmp_path / "run")
    files = json.loads((kept / "manifest.json").read_text())["model"]["sources"]["files"]
    assert {"model/kinds.csv", "model/rock.png"} <= set(files)
    assert replay(kept).equal and not replay(kept).notes
    (folder / "kinds.csv").write_text("0,0,0\n0,0,0\n")
    assert any("kinds.csv" in note for note in replay(kept).notes)
    assert replay(kept, kept=True, trust=True).equal


@pytest.mark.parametrize(
    ("maps", "expected"),
    [
        ({"kin": "a.csv"}, "a map of 'kin', which is no field of the patches; did you mean 'kind'"),
        ({"kind": ("a.png", 1)}, r"the map \('a.png', 1\) of 'kind'; expected a file, and what bl"),
    ],
)
def test_wrong_declarations_are_refused(maps, expected):
    with pytest.raises(ModelError, match=expected):
        type("Wrong", (Model,), {"world": Torus(3, Land, maps=maps)})


def test_an_array_may_be_declared():
    class Hill(Model):
        side: int = parameter(3, low=1)
        world = Torus("side", Land, maps={"kind": np.arange(9).reshape(3, 3)})

    assert Hill().world.kind[2, 1] == 7
    with pytest.raises(SocialmindError, match="found the shape"):
        Hill(side=4)
