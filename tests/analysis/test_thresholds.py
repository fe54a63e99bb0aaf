"""The study of response thresholds: what an endless colony does, and hand-made colonies."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.sources.loading import load_file

COLONIES = load_file(Path(__file__).parents[2] / "analysis" / "thresholds" / "colonies.py")


@pytest.mark.parametrize(("share", "threshold"), [(0.0, 1.0), (1.0, 8.0)])
def test_a_colony_of_one_caste_works_as_much_as_is_wanted(share, threshold):
    assert COLONIES.expected(share)[int(share == 0)] == pytest.approx(1 / 3, abs=1e-3)
    # T / (T + 0.2) = 1/3 where T = 0.1, so s = θ / 3; the other caste by that stimulus.
    other = 9.0 - threshold
    response = (threshold / 3) ** 2 / ((threshold / 3) ** 2 + other**2)
    works = COLONIES.expected(share)[int(share == 1)]
    assert works == pytest.approx(response / (response + 0.2), abs=1e-3)


@pytest.mark.parametrize(("threshold", "stimulus"), [(1.0, 0.3), (8.0, 3.0), (8.0, 100.0)])
def test_workers_answer_a_stimulus_as_told(threshold, stimulus):
    row = COLONIES.answering(threshold, stimulus, seed=1, ticks=2000)
    assert row["work"] == pytest.approx(COLONIES.works(stimulus, threshold), abs=0.01)


def test_castes_work_as_in_an_endless_colony():
    row = COLONIES.caste(80, seed=1, ticks=2000)
    major, minor = COLONIES.expected(0.8)
    assert row["major_work"] == pytest.approx(major, abs=0.02)
    assert row["minor_work"] == pytest.approx(minor, abs=0.02)


def test_nobody_away_and_nothing_changes():
    row = COLONIES.absence(5, forgets=True, away=0, seed=2)
    assert row["removed"] == 2
    assert row["other_role"] == 0
    assert row["change"] < 0.05
    assert row["settled_again"] <= 200


def test_others_stand_in_for_those_who_are_away():
    row = COLONIES.absence(5, forgets=True, away=1000, seed=2)
    assert row["stayed_before"] > 0.9
    assert row["stayed_return"] < 0.7
    assert row["stand_ins"] >= 1
    told = COLONIES.absence_told(away=1000, seed=2, before=100, after=100, every=50)
    assert told["since"].unique().tolist() == list(range(-100, 1101, 50))
    removed = told[told["removed"]]
    assert removed["agent"].nunique() == row["removed"] == 2
    # Away they forget by 1 a tick.
    mean = removed.groupby("since")["threshold"].mean()
    assert mean[900] - mean[100] == pytest.approx(800)
    stayed = told[~told["removed"] & (told["since"] == 1000)]["threshold"].mean()
    assert (stayed - 1) / 999 == pytest.approx(row["stayed_return"], abs=0.01)


def test_work_and_roles_are_recorded():
    row = COLONIES.specialists(5, learns=True, seed=2, ticks=10_000)
    assert (row["task_0"], row["task_1"], row["none"]) == (2, 2, 1)
    assert row["agents_to_tasks"] > 0.9
    # Both tasks want the work of N · δ / α workers; the stimuli at the end are what is left undone.
    assert row["delivered"] == pytest.approx(2 * 5 / 3 * 10_000, rel=0.02)
    fixed = COLONIES.specialists(5, learns=False, seed=2, ticks=10_000)
    assert fixed["none"] == 5
    assert fixed["agents_to_tasks"] < 0.01
    assert np.isinf(fixed["settling_ticks"])
