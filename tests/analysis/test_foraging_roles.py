"""The study of roles: its plans, what it keeps, and its tables."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning.lessons.keys import seeds_for
from socialmind.learning.training.course import TrainingCourse
from socialmind.mind import Perceptron
from socialmind.mind.files.packing import files_of
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging_roles"
trainings = load_file(FOLDER / "trainings.py")
results = load_file(FOLDER / "results.py")
scanning = load_file(FOLDER / "scheme_scan.py")
studies = load_file(FOLDER / "studies.py").studies
role_trainings = load_file(FOLDER / "role_trainings.py")
contestants = load_file(FOLDER / "contestants.py")
by_deliveries = load_file(FOLDER / "lessons_by_deliveries.py")
worlds = load_file(FOLDER / "worlds.py")
STAY = np.zeros(39)
STAY[21] = 1.0  # the influence on the role as it is


def test_each_plan_has_a_mind_and_terms_of_the_economy():
    for name, plan in trainings.PLANS.items():
        skill = trainings.mind_of(name).skill("ForageRole")
        assert skill.genome is None
        assert skill.function == plan.function
        trainings.ECONOMY.Terms(**plan.terms)
    assert trainings.PLANS["counts"].function == Perceptron(layers=2)
    with pytest.raises(SocialmindError, match="expected one of learned"):
        trainings.plan_of("lerned")


def test_genomes_are_kept_to_the_last_bit(tmp_path):
    path = tmp_path / "results" / "genomes.csv"
    rng = np.random.default_rng(1)
    first, second, other = rng.normal(size=(3, 37))
    trainings.keep({"counts": [first, second]}, path)
    trainings.keep({"learned": [other]}, path)
    found = trainings.kept(path)
    assert list(found) == ["counts", "learned"]
    assert all((a == b).all() for a, b in zip(found["counts"], [first, second], strict=True))
    trainings.keep({"counts": [other]}, path)
    assert len(trainings.kept(path)["counts"]) == 1


def test_what_is_not_kept_says_how_to_make_it(monkeypatch, tmp_path):
    monkeypatch.setattr(results, "kept", dict)
    with pytest.raises(SocialmindError, match="trainings counts makes it"):
        results.genomes(["counts"], tmp_path, quick=False, from_kept=True)


def test_a_mind_is_judged_under_each_condition():
    rows = results.judged("learned", trainings.mind_of("learned"), [STAY, STAY], range(16))
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


# Trainings of the role lessons --------------------------------------------------------------------


@pytest.mark.parametrize("name", role_trainings.PLANS)
def test_each_role_lesson_fits_its_mind_also_when_small(name):
    plan = role_trainings.PLANS[name]
    for one in (plan, plan.small()):
        TrainingCourse(one.curriculum(), one.mind(), one.seed, "compiled")


@pytest.mark.parametrize("name", ["supervised_role", "delivered_anew", "thesis_role"])
def test_lessons_that_claims_rest_on_have_ten_attempts(name):
    assert role_trainings.PLANS[name].attempts == 10


def test_the_supervised_lesson_is_the_models_own():
    (lesson,) = role_trainings.PLANS["supervised_role"].curriculum().lessons
    assert lesson.record() == trainings.LESSONS.lesson.record()
    assert role_trainings.PLANS["supervised_role"].seed == trainings.SEED
    assert files_of(role_trainings.PLANS["supervised_role"].mind()) == files_of(
        trainings.mind_of("learned")
    )


def test_what_role_means_is_learned_from_what_is_brought(tmp_path):
    small = role_trainings.PLANS["delivered_role"].small(1, 2, population=6, repetitions=2)
    training = small.train(tmp_path / "small", workers=1)
    assert training.finished == [1]
    mind = training.mind(1)
    assert mind.skill("CollectSelect").genome is not None
    assert mind.skill("ForageRole").genome is not None


def test_worlds_for_choosing_and_reporting_are_apart():
    assert not set(worlds.CHOOSING) & set(worlds.REPORTED)
    assert not set(worlds.CHOOSING_ECONOMY) & set(worlds.REPORTED_ECONOMY)
    assert not set(worlds.SCHEME_ECONOMY) & {*worlds.CHOOSING_ECONOMY, *worlds.REPORTED_ECONOMY}
    societies = load_file(FOLDER.parent / "specialisation" / "societies.py")
    page = range(societies.SEED, societies.SEED + societies.FULL.worlds)
    assert set(page) <= set(worlds.REPORTED)
    # Those of trainings are hashes of 64 bits.
    assert min(seeds_for(100, "world", worlds.TRAINING)) > 10_000


# Contestants --------------------------------------------------------------------------------------


def test_all_kept_attempts_are_judged_and_the_picked_one_among_them():
    ways = [(one.way, one.attempt) for one in contestants.contestants()]
    assert len(set(ways)) == len(ways)
    assert {(contestants.PICKED, 1), ("supervised_role", 3), ("fixed_thresholds", 0)} <= set(ways)


def test_attempts_by_deliveries_come_to_what_is_kept_in_the_worlds_that_are_told():
    table = pd.read_csv(by_deliveries.OUT)
    assert len(table) == 11 * 7
    kept = table.set_index(["lesson", "attempt", "condition"])["within_one"]
    one = contestants.Contestant("delivered_role", 1, contestants.minds_of("delivered_role")[1])
    found = by_deliveries.within_one(one, "nine robots", worlds.REPORTED_ECONOMY)
    assert found == pytest.approx(kept["delivered_role", 1, "nine robots"], abs=1e-6)
