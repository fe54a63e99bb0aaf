"""`socialmind check` on minds of skills: findings, genome sizes, exit codes."""

import pytest

from socialmind.mind import MindDescription, Skill, Variable
from socialmind.mind.files.evoagents.simbatch import Task
from socialmind.mind.files.folder import save_tasks
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.regulation import Wave


def seeker(weights=True):
    """A master over one base skill: 2 · 1 + 1 = 3 and 2 · 2 = 4 weights."""
    function = Perceptron(layers=0)
    top = Skill("Top", ["SE:Eye", "VA:Clock"], ["SK:Go"], function, [0.5] * 3)
    go = Skill("Go", ["SE:Eye"], ["MO:L", "MO:R"], function, [0.5] * 4 if weights else None)
    return MindDescription("seeker", ["Eye"], ["L", "R"], [Variable("Clock", Wave())], [top, go])


TABLE = """\
skill  function                         inputs  outputs  weights
Top    a perceptron of no hidden layer       2        1        3
Go     a perceptron of no hidden layer       1        2        4
total                                                          7
"""


@pytest.mark.parametrize("form", ["seeker", "seeker.yaml"])
def test_a_sound_mind(socialmind, tmp_path, form):
    path = tmp_path / form
    seeker().save(path)
    result = socialmind("check", path)
    assert (result.exit_code, result.stdout) == (0, f"{path}: nothing odd found\n{TABLE}")


@pytest.mark.parametrize("form", ["seeker", "seeker.yaml"])
def test_an_odd_mind(socialmind, tmp_path, form):
    path = tmp_path / form
    seeker(weights=False).save(path)
    result = socialmind("check", path)
    assert result.exit_code == 1
    finding, _, table = result.stdout.partition("\n")
    assert finding.startswith(f"{path}: no weights: skill 'Go': its 4 weights are not set")
    assert table == TABLE


def test_tasks_name_the_masters(socialmind, tmp_path):
    seeker().save(tmp_path / "m")
    save_tasks({"Learn": Task("LEARN2DSIM", master_skill="Go")}, tmp_path / "m")
    result = socialmind("check", tmp_path / "m")
    assert result.exit_code == 1
    assert "skill out of reach: skill 'Top'" in result.stdout
    save_tasks({"Learn": Task("LEARN2DSIM", learning_skill="Tip")}, tmp_path / "m")
    result = socialmind("check", tmp_path / "m")
    assert result.exit_code == 1
    assert "unknown skill: task 'Learn': its learning skill is 'Tip'; did you mean 'Top'?" in (
        result.stdout
    )


def test_a_broken_mind_is_one_line(refused, tmp_path):
    seeker().save(tmp_path / "m")
    genome = tmp_path / "m" / "Skills" / "Go" / "Go.genome"
    genome.write_text(genome.read_text().replace("0.5\nend\n", ""))
    assert refused("check", tmp_path / "m").startswith(f"socialmind: {genome}:")
    (tmp_path / "m" / "Tasks").mkdir()
    (tmp_path / "m" / "Tasks" / "Go.simbatch").write_text("TYPE:RUN\n")
    genome.unlink()
    assert "Go.simbatch:1: found 'RUN'" in refused("check", tmp_path / "m")


@pytest.mark.parametrize("suffix", [".botdesc", ".vardesc", ".ades", ".genome", ".simbatch"])
def test_one_file_of_a_mind_is_referred_to_its_folder(refused, tmp_path, suffix):
    assert "give the folder that holds its .botdesc" in refused("check", tmp_path / f"Go{suffix}")


def test_the_yaml_of_a_mind_and_that_of_a_scheme_are_told_apart(refused, socialmind, tmp_path):
    path = tmp_path / "it.yaml"
    path.write_text("name: it\ncognitons:\n  skills: {influence: {sensors: 1}}\n")
    assert "plan never available: plan 'sensors'" in socialmind("check", path).stdout
    path.write_text("name: it\nskills:\n  Go: {inputs: []\n")
    assert "expected YAML" in refused("check", path)
    path.write_text("name: it\nskils: {}\nsensors: []\n")
    assert "did you mean 'skills'" in refused("check", path)
    path.write_text("name: it\n")
    assert socialmind("check", path).exit_code == 0
