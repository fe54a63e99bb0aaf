"""Workers: the same result for any number of them, anywhere, and when some are killed."""

import numpy as np
import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning.episodes.evaluation import Ground
from socialmind.learning.episodes.evaluators import Cluster, Processes, Stopped, Threads, hired
from socialmind.learning.lessons.keys import seeds_for

GENOMES = np.random.default_rng(1).normal(size=(11, 6))
SEEDS = seeds_for(3, "world")


@pytest.fixture
def ground(slopes, robot):
    def made(environment="Slope", **parameters):
        cls = getattr(slopes, environment)
        return Ground(cls, robot, "Go", ("Go",), parameters=parameters)

    return made


@pytest.fixture(scope="module")
def processes():
    workers = Processes(2)
    yield workers
    workers.close()


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as local:
        workers = Cluster(local.scheduler_address)
        yield workers
        workers.close()


def expected(ground):
    return ground.episodes().run(GENOMES, SEEDS)


def equal(found, outcome):
    return (found.score == outcome.score).all() and (found.ticks == outcome.ticks).all()


@pytest.mark.parametrize("count", [1, 2, 5])
def test_threads(ground, count):
    workers = Threads(count)
    for one in (ground(), ground(target=0.9), ground()):
        assert equal(workers.judge(one, GENOMES, SEEDS), expected(one))
    workers.close()


def test_processes(ground, processes):
    for one in (ground(), ground(target=0.9)):
        assert equal(processes.judge(one, GENOMES, SEEDS), expected(one))


def test_a_killed_process_s_work_is_done_again(ground, processes, tmp_path):
    sign = tmp_path / "die"
    sign.touch()
    one = ground(dies=str(sign))
    assert equal(processes.judge(one, GENOMES, SEEDS), expected(ground()))
    assert not sign.exists()
    assert equal(processes.judge(ground(), GENOMES, SEEDS), expected(ground()))


def test_a_cluster(ground, cluster):
    assert cluster.count == 2
    for one in (ground(), ground(target=0.9)):
        assert equal(cluster.judge(one, GENOMES, SEEDS), expected(one))


def test_a_killed_worker_of_a_cluster_loses_nothing(ground, cluster, tmp_path):
    sign = tmp_path / "die"
    sign.touch()
    assert equal(cluster.judge(ground(dies=str(sign)), GENOMES, SEEDS), expected(ground()))
    assert not sign.exists()


def test_skills_of_different_functions_are_judged_one_by_one(ground, robot, processes):
    skills = [robot.skill("Go").changed(genome=row) for row in GENOMES]
    threads = Threads(2)
    for workers in (threads, processes):
        assert equal(workers.judge(ground(), skills, SEEDS), expected(ground()))
    threads.close()


@pytest.mark.parametrize("kind", [Threads, Processes])
def test_errors_of_the_environment_come_through(ground, kind):
    with hired("compiled" if kind is Threads else "pymunk", 2) as workers:
        assert type(workers) is kind
        with pytest.raises(ModelError, match="no finite numbers from the environment Broken"):
            workers.judge(ground("Broken"), GENOMES, SEEDS)


def test_stopping_drops_what_is_in_hand(ground):
    workers = Threads(1)
    asked = []

    def stop():
        asked.append(1)
        return len(asked) > 1

    with pytest.raises(Stopped):
        workers.judge(ground(seconds=0.3), GENOMES, SEEDS, stop)
    workers.close()


def test_environments_that_other_processes_cannot_load_are_refused(robot, processes):
    class Here:
        pass

    with pytest.raises(ModelError, match=r"write them into the model's lessons\.py"):
        processes.judge(Ground(Here, robot, "Go", ("Go",)), GENOMES, SEEDS)


def test_wrong_numbers_and_addresses_are_refused():
    with pytest.raises(SocialmindError, match="0 workers; expected 1 or more"), hired("pymunk", 0):
        pass
    with pytest.raises(SocialmindError, match="give one of both"), hired("pymunk", 2, "tcp://x:1"):
        pass
