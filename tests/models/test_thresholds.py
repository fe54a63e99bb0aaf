"""Response thresholds: taking up, giving up, learning, calling; specialists away and back."""

import numpy as np
import pytest

from socialmind.catalogue import load_model


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a colony at either speed."""

    def made(seed=1, **parameters):
        return load_model("thresholds")(seed, compiled=request.param, **parameters)

    return made


FIXED = {"learning": 0.0, "forgetting": 0.0}


def test_a_task_calls_louder_by_the_demand_and_lower_by_the_share_at_work(make):
    colony = make(n_workers=4, giving_up=0.0, threshold=1000.0, **FIXED)
    colony.workers[0].task = 0
    colony.workers[1].task = 0
    colony.workers[2].task = 1
    colony.tasks.stimulus = [10.0, 0.1]
    colony.advance(1)
    # 1 − 3 · 2/4 = −0.5 and 1 − 3 · 1/4 = 0.25
    assert colony.tasks.stimulus.tolist() == pytest.approx([9.5, 0.35])
    colony.tasks.stimulus = [0.2, 0.2]
    colony.advance(1)
    assert colony.tasks[0].stimulus == 0.0  # not below


def test_a_worker_learns_what_it_does_and_forgets_the_rest_within_bounds(make):
    colony = make(n_workers=1, giving_up=0.0)
    worker = colony.workers[0]
    worker.task = 1
    colony.advance(3)
    assert worker.thresholds[:2] == [503.0, 470.0]
    assert worker.done[:2] == [0, 3]
    colony.advance(97)
    assert worker.thresholds[:2] == [600.0, 1.0]
    colony.advance(900)
    assert worker.thresholds[:2] == [1000.0, 1.0]


def test_a_task_is_taken_up_as_often_as_the_response_says(make):
    # With s = 2 and θ = 4, one of five takes it up: 4 / (4 + 16).
    colony = make(n_workers=4000, n_tasks=1, demand=0.0, threshold=4.0, efficiency=0.0, **FIXED)
    colony.tasks.stimulus = 2.0
    colony.advance(1)
    assert colony.series()["working"] / 4000 == pytest.approx(0.2, abs=0.02)


def test_a_task_is_given_up_as_often_as_is_told(make):
    colony = make(n_workers=4000, n_tasks=1, demand=0.0, efficiency=0.0, giving_up=0.3, **FIXED)
    colony.workers.task = 0
    colony.advance(1)  # who gives up rests until the next tick; nothing calls
    assert colony.series()["working"] / 4000 == pytest.approx(0.7, abs=0.02)


def test_the_first_workers_are_the_majors(make):
    colony = make(n_workers=3, n_majors=2, threshold=1.0, majors_threshold=8.0, **FIXED)
    assert colony.workers.thresholds[:, :2].tolist() == [[8.0, 8.0], [8.0, 8.0], [1.0, 1.0]]
    assert colony.workers.major.tolist() == [True, True, False]


def test_roles_are_the_lowest_threshold_in_the_lower_half(make):
    colony = make(n_workers=4)
    rows = np.zeros((4, 8))
    rows[:, :2] = [[400, 700], [700, 400], [600, 900], [400, 400]]
    colony.workers.thresholds = rows
    assert colony.agents()["role"] == [0, 1, None, None]
    assert colony.series()["specialists_0"] == 1


@pytest.mark.parametrize("forgetting", [True, False])
def test_specialists_go_and_come_back(make, forgetting):
    colony = make(
        n_workers=3, remove_at=2, return_at=7, forgetting_away=forgetting, giving_up=0.0, demand=0.0
    )
    rows = np.full((3, 8), 900.0)
    rows[0, 0] = rows[1, 1] = rows[2, 0] = 300.0
    colony.workers.thresholds = rows
    colony.workers.task = [0, None, 1]
    colony.advance(2)
    assert not colony.workers.away.any()
    # The third has worked at task 1 for two ticks: 880 and 302, so it is one of task 0 still.
    assert colony.workers.thresholds[2, :2].tolist() == [302.0, 880.0]
    colony.advance(1)
    assert colony.workers.away.tolist() == [True, False, True]
    assert list(colony.workers.task) == [None, None, None]
    assert colony.series()["present"] == 1
    colony.advance(4)
    kept = [280.0, 902.0]
    assert colony.workers[0].thresholds[:2] == [value + 5 * forgetting for value in kept]
    colony.advance(1)
    assert not colony.workers.away.any()


@pytest.mark.parametrize("task", [0, 2, 3])
def test_those_who_are_taken_away_are_the_specialists_of_the_task(make, task):
    colony = make(n_workers=60, n_tasks=3, demand=0.0, remove_at=0, removed_task=task)
    rng = np.random.default_rng(task)
    rows = np.zeros((60, 8))
    rows[:, :3] = rng.integers(1, 11, (60, 3)) * 100  # often alike
    colony.workers.thresholds = rows
    specialists = colony.roles() == task
    colony.advance(1)
    assert colony.workers.away.tolist() == specialists.tolist()
    assert specialists.any() == (task < 3)


def test_who_is_away_counts_for_no_demand(make):
    colony = make(n_workers=2, giving_up=0.0, remove_at=0)
    rows = np.full((2, 8), 900.0)
    rows[0, 0] = 1.0
    colony.workers.thresholds = rows
    colony.workers.task = [None, 1]
    colony.tasks.stimulus = [0.0, 10.0]
    colony.advance(1)
    assert colony.tasks[1].stimulus == 10.0 + 1.0 - 3.0  # one of one at work


def test_specialists_of_both_tasks_come_out_of_equals():
    for seed in range(5):
        colony = load_model("thresholds")(seed)
        colony.advance(5000)
        series = colony.series()
        assert series["specialists_0"] >= 1
        assert series["specialists_1"] >= 1


def test_majors_step_in_where_minors_are_scarce():
    work = []
    for majors in (20, 90):
        colony = load_model("thresholds")(
            3,
            n_workers=100,
            n_tasks=1,
            threshold=1.0,
            majors_threshold=8.0,
            n_majors=majors,
            **FIXED,
        )
        colony.advance(1000)
        work.append(colony.workers.done[:majors, 0].mean() / 1000)
    assert work[0] < 0.05
    assert work[1] > 0.2
