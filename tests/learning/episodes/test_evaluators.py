"""Evaluators: the same result for any number of them, anywhere, and when some are killed."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.learning.episodes.evaluation import Evaluation
from socialmind.learning.episodes.evaluators import Evaluators
from socialmind.learning.lessons.keys import seeds_for
from socialmind.work.workers import Cluster, Processes, Stopped, Threads

GENOMES = np.random.default_rng(1).normal(size=(11, 6))
SEEDS = seeds_for(3, "world")


@pytest.fixture
def evaluation(slopes, robot):
    def made(environment="Slope", **parameters):
        cls = getattr(slopes, environment)
        return Evaluation(cls, robot, "Go", ("Go",), parameters=parameters)

    return made


@pytest.fixture(scope="module")
def processes():
    with Processes(2) as workers:
        yield Evaluators(workers)


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
        ) as local,
        Cluster(local.scheduler_address) as workers,
    ):
        assert workers.count == 2
        yield Evaluators(workers)


def expected(evaluation):
    return evaluation.episodes().run(GENOMES, SEEDS)


def equal(found, outcome):
    return (found.score == outcome.score).all() and (found.ticks == outcome.ticks).all()


@pytest.mark.parametrize("count", [1, 2, 5])
def test_threads(evaluation, count):
    with Threads(count) as workers:
        for one in (evaluation(), evaluation(target=0.9), evaluation()):
            assert equal(Evaluators(workers).evaluate(one, GENOMES, SEEDS), expected(one))


def test_what_runs_in_python_is_not_cut_for_threads(evaluation):
    class Noting(Threads):
        def results(self, task, pieces, stop):
            self.pieces = len(pieces)
            return super().results(task, pieces, stop)

    with Noting(2) as workers:
        Evaluators(workers).evaluate(evaluation(), GENOMES, SEEDS)
    assert workers.pieces == 1


def test_processes(evaluation, processes):
    for one in (evaluation(), evaluation(target=0.9)):
        assert equal(processes.evaluate(one, GENOMES, SEEDS), expected(one))


def test_a_killed_process_s_work_is_done_again(evaluation, processes, tmp_path):
    sign = tmp_path / "die"
    sign.touch()
    one = evaluation(dies=str(sign))
    assert equal(processes.evaluate(one, GENOMES, SEEDS), expected(evaluation()))
    assert not sign.exists()
    assert equal(processes.evaluate(evaluation(), GENOMES, SEEDS), expected(evaluation()))


def test_a_cluster(evaluation, cluster):
    for one in (evaluation(), evaluation(target=0.9)):
        assert equal(cluster.evaluate(one, GENOMES, SEEDS), expected(one))


def test_a_killed_worker_of_a_cluster_loses_nothing(evaluation, cluster, tmp_path):
    sign = tmp_path / "die"
    sign.touch()
    assert equal(
        cluster.evaluate(evaluation(dies=str(sign)), GENOMES, SEEDS), expected(evaluation())
    )
    assert not sign.exists()


def test_skills_of_different_functions_are_evaluated_one_by_one(evaluation, robot, processes):
    skills = [robot.skill("Go").changed(genome=row) for row in GENOMES]
    with Threads(2) as threads:
        for evaluators in (Evaluators(threads), processes):
            assert equal(evaluators.evaluate(evaluation(), skills, SEEDS), expected(evaluation()))


@pytest.mark.parametrize("kind", [Threads, Processes])
def test_errors_of_the_environment_come_through(evaluation, kind):
    with (
        kind(2) as workers,
        pytest.raises(ModelError, match="no finite numbers from the environment Broken"),
    ):
        Evaluators(workers).evaluate(evaluation("Broken"), GENOMES, SEEDS)


def test_stopping_drops_what_is_in_hand(evaluation):
    asked = []

    def stop():
        asked.append(1)
        return len(asked) > 1

    with Threads(1) as workers, pytest.raises(Stopped):
        Evaluators(workers).evaluate(evaluation(seconds=0.3), GENOMES, SEEDS, stop)


def test_environments_that_other_processes_cannot_load_are_refused(robot, processes):
    class Here:
        pass

    with pytest.raises(ModelError, match=r"write them into a model's model.py or lessons\.py"):
        processes.evaluate(Evaluation(Here, robot, "Go", ("Go",)), GENOMES, SEEDS)
