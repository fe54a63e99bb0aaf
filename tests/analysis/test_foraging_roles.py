"""The study of roles: its plans, what it keeps, and its tables."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.mind import Perceptron
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging_roles"
trainings = load_file(FOLDER / "trainings.py")
results = load_file(FOLDER / "results.py")
scanning = load_file(FOLDER / "scheme_scan.py")
studies = load_file(FOLDER / "studies.py").studies
STAY = np.zeros(39)
STAY[21] = 1.0  # the influence on the role as it is


def test_each_plan_has_a_mind_and_terms_of_the_economy():
    for name, plan in trainings.PLANS.items():
        skill = trainings.mind_of(name).skill("ForageRole")
        assert skill.genome is None
        assert skill.function == plan.function
        trainings.ECONOMY.Terms(**plan.terms)
    assert trainings.PLANS["thesis"].function == Perceptron(layers=2)
    with pytest.raises(SocialmindError, match="expected one of learned"):
        trainings.plan_of("lerned")


def test_genomes_are_kept_to_the_last_bit(tmp_path):
    path = tmp_path / "results" / "genomes.csv"
    rng = np.random.default_rng(1)
    first, second, other = rng.normal(size=(3, 37))
    trainings.keep({"thesis": [first, second]}, path)
    trainings.keep({"learned": [other]}, path)
    found = trainings.kept(path)
    assert list(found) == ["thesis", "learned"]
    assert all((a == b).all() for a, b in zip(found["thesis"], [first, second], strict=True))
    trainings.keep({"thesis": [other]}, path)
    assert len(trainings.kept(path)["thesis"]) == 1


def test_what_is_not_kept_says_how_to_make_it(monkeypatch, tmp_path):
    monkeypatch.setattr(results, "kept", dict)
    with pytest.raises(SocialmindError, match="trainings thesis makes it"):
        results.genomes(["thesis"], tmp_path, quick=False, from_kept=True)


def test_a_mind_is_judged_under_each_condition():
    rows = results.judged("learned", [STAY, STAY], quick=True)
    assert [row["attempt"] for row in rows] == [1, 2] * len(results.IN_THE_ECONOMY)
    assert all(row["changes"] == 0 for row in rows)
    assert all(0 <= row["within_one"] < 1 for row in rows)


def test_tables_are_written_as_csv_and_markdown(tmp_path):
    table, text = results.write_table("made", [{"a": "x", "b": 0.12345}], tmp_path / "out")
    assert table.read_text() == "a,b\nx,0.12345\n"
    assert text.read_text() == "| a | b |\n|---|---|\n| x | 0.123 |\n"


def test_studies_that_train_can_be_made_of_what_is_kept():
    assert [one.name for one in studies] == ["figure-8.6", "roles-lessons", "roles-settling"]
    assert [one.kept is not None for one in studies] == [True, True, False]
    assert all(one.quick is not None for one in studies)


def test_the_scan_of_the_scheme_follows_the_models_rules():
    scheme = scanning.CognitiveScheme.load(scanning.MODEL / "scheme.yaml")
    assert scanning.scheme_with(4.0) == scheme
    assert scanning.scheme_with(8.0).cognitons[0].influence == {"CollectA": 8.0}
    nine = results.IN_THE_ECONOMY["nine robots"]
    found = scanning.tried(4.0, 5.0, nine, 8)
    assert found["within_one"] >= 0.75
    assert found["changes"] < 1.0
    nobody = scanning.tried(4.0, 50.0, {**nine, "starts": (0,)}, 2)
    assert nobody == {"within_one": 0.0, "changes": 0.0}


def test_the_scan_of_the_scheme_has_a_row_for_each_condition():
    table = scanning.scan((4.0,), (5.0,), worlds=1)
    assert table["condition"].tolist() == list(scanning.TRIED)
    assert set(table["condition"]) <= set(results.IN_THE_ECONOMY)
