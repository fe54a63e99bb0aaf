"""How individuals are evaluated: cut into pieces, and sent to another process."""

import numpy as np

from socialmind.learning.episodes.evaluation import Evaluation, pieces_of
from socialmind.work.packing import packed, unpacked

GENOMES = np.random.default_rng(1).normal(size=(11, 6))
SEEDS = [5, 6, 7]


def test_every_individual_meets_every_world_once():
    for count in (1, 3, 11, 20, 100):
        met = np.zeros((11, 3), int)
        for piece in pieces_of(GENOMES, SEEDS, count):
            met[piece.individuals, piece.worlds] += 1
            assert (piece.genomes == GENOMES[piece.individuals]).all()
            assert list(piece.seeds) == SEEDS[piece.worlds]
        assert (met == 1).all()


def test_a_packed_evaluation_gives_the_scores_of_the_one_it_was(slopes, robot):
    taught = robot.with_modules(skills=[robot.skill("Turn").changed(genome=np.ones(4))])
    evaluation = Evaluation(slopes.Slope, taught, "Turn", ("Turn",), 9, {"target": 0.3})
    again = unpacked(packed(evaluation))
    (piece,) = pieces_of(GENOMES[:, :4], SEEDS, 1)
    one, other = (each.worker().do(piece) for each in (evaluation, again))
    assert (one.score == other.score).all()
    assert (one.ticks == other.ticks).all()
    assert (again.mind.skill("Turn").genome == 1.0).all()
