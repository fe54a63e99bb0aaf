"""`socialmind import`, `run` of a folder of MetaCiv's, and `export-scheme`."""

import pytest

from coglogo_py import CognitiveScheme
from tests.metaciv.reading.folders import FARMERS, written

PLAN = "schemasCognitifs/Farmer/plans/Work.metaciv"


@pytest.fixture(scope="module")
def farmers(tmp_path_factory):
    """A model of MetaCiv's."""
    return written(tmp_path_factory.mktemp("metaciv") / "farmers (v2.0)", FARMERS)


def test_import_writes_a_model_that_can_be_listed(socialmind, farmers, tmp_path):
    result = socialmind("import", farmers, "--out", "ours")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "ours\n", "")
    assert (tmp_path / "ours" / "model.py").is_file()
    assert "humans" in socialmind("list", "./ours").stdout


def test_import_lists_all_that_is_wrong_and_writes_nothing(socialmind, tmp_path):
    bad = FARMERS[PLAN].replace("A_Move,NORTH", "A_Move,UP") + "Action : A_Sleep\n"
    terrain = "simulation/terrains/Grass.metaciv"
    folder = written(tmp_path / "bad", {**FARMERS, PLAN: bad, terrain: "Nom : Grass\n"})
    result = socialmind("import", folder, "--out", "ours")
    assert (result.exit_code, result.stdout) == (2, "")
    *lines, last = result.stderr.splitlines()
    assert [line.partition(": ")[0] for line in lines] == ["error"] * 3
    assert f"{PLAN}:11: found 'UP'" in lines[0]
    assert last == f"socialmind: {folder}: 3 errors; nothing was written"
    assert [one.name for one in tmp_path.iterdir()] == ["bad"]


def test_strict_refuses_what_is_not_supported(socialmind, tmp_path):
    plan = FARMERS[PLAN] + "Action : A_Pray\n"
    files = {**FARMERS, PLAN: plan, "simulation/actions/A_Pray.class": ""}
    folder = written(tmp_path / "praying", files)
    strict = socialmind("import", folder, "--out", "strict", "--strict")
    assert strict.exit_code == 2 and not (tmp_path / "strict").exists()
    assert strict.stderr.splitlines()[-1].endswith("1 thing not supported; nothing was written")
    lenient = socialmind("import", folder, "--out", "lenient")
    assert lenient.exit_code == 0
    assert lenient.stderr.startswith(f"not supported: {PLAN}:12: A_Pray")
    assert f"- `{PLAN}:12`: A_Pray" in (tmp_path / "lenient" / "README.md").read_text("utf-8")


def test_import_overwrites_nothing(refused, farmers, tmp_path):
    (tmp_path / "ours").mkdir()
    (tmp_path / "ours" / "notes.txt").write_text("mine")
    assert "is not empty" in refused("import", farmers, "--out", "ours")
    assert refused("import", tmp_path, "--out", "new").endswith(
        "expected the folder of a model of MetaCiv's"
    )
    assert "no such folder" in refused("import", "nowhere", "--out", "new")


@pytest.fixture(scope="module")
def ran(socialmind, farmers, tmp_path_factory):
    """A run of the folder itself, interpreted."""
    out = tmp_path_factory.mktemp("ran") / "run"
    result = socialmind("run", farmers, "--ticks", 6, "--interpreted", "--quiet", "--out", out)
    assert (result.exit_code, result.stderr) == (0, "")
    return out


def test_run_keeps_the_model_that_it_wrote(socialmind, ran):
    assert (ran / "model" / "model.py").is_file()
    assert socialmind("replay", ran).stdout == "equal\n"
    explained = socialmind("explain", ran, "--agent", 1, "--tick", 3)
    assert explained.exit_code == 0, explained.output
    assert "Work" in explained.stdout


def test_a_run_of_an_imported_model_may_be_moved_and_goes_on(socialmind, farmers, tmp_path):
    words = ("--ticks", 3, "--interpreted", "--quiet", "--out", "here")
    assert socialmind("run", farmers, *words).exit_code == 0
    (tmp_path / "here").rename(tmp_path / "there")
    assert socialmind("run", "--resume", "there", "--ticks", 5, "--quiet").exit_code == 0
    assert socialmind("replay", "there").stdout == "equal\n"


def test_a_run_that_cannot_begin_leaves_nothing(socialmind, farmers, tmp_path):
    result = socialmind("run", farmers, "--set", "luck=3", "--out", "run", "--quiet")
    assert result.exit_code == 2 and "no parameter called luck" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("words", [["list"], ["odd"], ["sweep"], ["check"], ["studio"], ["draw"]])
def test_other_commands_say_what_to_do(refused, farmers, words):
    line = refused(*words, farmers)
    assert words == ["draw"] or f"`socialmind import '{farmers}' --out DIR`" in line


def test_schemes_are_exported_with_what_is_lost(socialmind, refused, tmp_path):
    result = socialmind("export-scheme", "farmer_artisan", "--format", "metaciv", "--out", "s")
    assert (result.exit_code, result.stdout) == (0, "s/humans\n")
    assert all(line.startswith("lost: ") for line in result.stderr.splitlines())
    assert (tmp_path / "s/humans/humans.metaciv").read_text().startswith("Nom : humans\n")
    again = refused("export-scheme", "farmer_artisan", "--format", "metaciv", "--out", "s")
    assert "is there already" in again


def test_schemes_are_exported_for_coglogo(socialmind, refused, tmp_path):
    words = ("export-scheme", "farmer_artisan", "--format", "cogscheme", "--out")
    result = socialmind(*words, "a.cogscheme")
    assert (result.exit_code, result.stdout) == (0, "a.cogscheme\n")
    names = [one.name for one in CognitiveScheme.load("a.cogscheme").cognitons]
    assert "Farmer" in names
    assert "expected .cogscheme" in refused(*words, "a.txt")
    assert refused("export-scheme", "boids", "--format", "metaciv", "--out", "x").endswith(
        "none of its populations has a cognitive scheme"
    )
