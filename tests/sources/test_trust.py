"""Programs run without asking where they ship or this user named or ran them, and else not."""

import os
import shutil
import stat

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import replay, resume, run
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.sources.folders import model_folder
from socialmind.sources.trust import DATA_VARIABLE, PROGRAMS_FILE, programs_in, remember, require

PROGRAM = {"evil.py": b"import os"}


@pytest.fixture(autouse=True)
def data(tmp_path, monkeypatch):
    """A user who has run nothing yet; gives the data folder."""
    monkeypatch.setenv(DATA_VARIABLE, str(tmp_path / "data"))
    return tmp_path / "data"


def test_what_is_unknown_is_listed_and_refused_until_it_is_trusted(data):
    with pytest.raises(SocialmindError, match=r"^a run holds programs .*: evil\.py; .*--trust"):
        require(PROGRAM, False, "a run")
    require(PROGRAM, True, "a run")
    require(PROGRAM, False, "a run")
    assert stat.S_IMODE(data.stat().st_mode) == 0o700
    assert stat.S_IMODE((data / PROGRAMS_FILE).stat().st_mode) == 0o600
    with pytest.raises(SocialmindError, match="evil"):
        require({"evil.py": b"import os  # more"}, False, "a run")


def test_what_ships_is_known():
    require(programs_in(model_folder("farmer_artisan")), False, "a run")


@pytest.mark.skipif(os.name == "nt", reason="Windows has other rights")
def test_a_list_that_others_may_write_counts_for_nothing(data):
    remember(PROGRAM)
    (data / PROGRAMS_FILE).chmod(0o666)
    with pytest.raises(SocialmindError):
        require(PROGRAM, False, "a run")


def test_where_nothing_can_be_kept_this_process_remembers(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv(DATA_VARIABLE, str(tmp_path / "file" / "below"))
    own = {"own.py": b"x = 'only of this test'"}
    remember(own)
    require(own, False, "a run")


def test_a_run_of_ones_own_goes_on_and_somebody_elses_asks(tmp_path, monkeypatch):
    import socialmind

    template = next(iter(socialmind.__path__)) + "/template"
    shutil.copytree(template, tmp_path / "mine")
    model = tmp_path / "mine" / "model.py"
    model.write_text(model.read_text() + "\n# of my own\n")
    folder = run(load_model(tmp_path / "mine"), ticks=2, out=tmp_path / "run", compiled=False)
    resume(folder, ticks=3)
    monkeypatch.setenv(DATA_VARIABLE, str(tmp_path / "another user's"))
    for doing in (lambda: resume(folder, ticks=4), lambda: replay(folder)):
        with pytest.raises(SocialmindError, match=r"mine/model\.py.*--trust"):
            doing()
    assert replay(folder, trust=True).equal


def test_a_mind_as_a_file_in_its_models_folder_needs_no_word_of_its_own(tmp_path):
    skill = Skill("Go", ["SE:S"], ["MO:M"], Perceptron(layers=0))
    mind = MindDescription("mover", ["S"], ["M"], skills=[skill])
    (tmp_path / "mine").mkdir()
    mind.save(tmp_path / "mine" / "mind.yaml")
    (tmp_path / "mine" / "model.py").write_text(
        "from socialmind import Agent, Model, Population\n\n\n"
        "class Movers(Model):\n"
        "    ticks = 2\n"
        '    movers = Population(Agent, 2, hierarchy="mind.yaml")\n'
    )
    taught = MindDescription("mover", ["S"], ["M"], skills=[skill.changed(genome=[0.5, 0.5])])
    movers = load_model(tmp_path / "mine")
    folder = run(movers, out=tmp_path / "run", hierarchy=taught, compiled=False)
    assert replay(folder).equal


@pytest.mark.parametrize(
    "written", ["/evil.py", "../evil.py", "..\\evil.py", "\\\\host\\evil.py", "a/../../evil.py"]
)
def test_a_mind_names_no_program_outside_of_its_folder(tmp_path, written):
    (tmp_path / "evil.py").write_text("raise SystemExit(7)\n")
    mind = tmp_path / "M"
    mind.mkdir()
    (mind / "M.botdesc").write_text("SENSORS\nACTUATORS\nA:motor\n")
    named = str(tmp_path) + written if written == "/evil.py" else written
    (mind / "M.vardesc").write_text(f"V:RegulatedVariableModule::{named}:f\n")
    with pytest.raises(ModelError, match="outside of"):
        MindDescription.load(mind)


def test_a_mind_follows_no_link_out_of_its_folder(tmp_path):
    (tmp_path / "evil.py").write_text("raise SystemExit(7)\n")
    mind = tmp_path / "M"
    mind.mkdir()
    (mind / "M.botdesc").write_text("SENSORS\nACTUATORS\nA:motor\n")
    (mind / "M.vardesc").write_text("V:RegulatedVariableModule::f.py:f\n")
    (mind / "f.py").symlink_to(tmp_path / "evil.py")
    with pytest.raises(ModelError, match="outside of"):
        MindDescription.load(mind)


@pytest.mark.parametrize(
    "program", ["raise SystemExit(3)", "raise KeyboardInterrupt", "raise BaseException('a\\nb')",
                "x = " + "(" * 5000 + ")" * 5000, "x = " + "-" * 100_000 + "1"],
)  # fmt: skip
def test_a_program_that_will_not_load_is_one_line(tmp_path, program):
    (tmp_path / "model.py").write_text(program + "\n")
    with pytest.raises(ModelError) as caught:
        load_model(tmp_path)
    assert "\n" not in str(caught.value)
