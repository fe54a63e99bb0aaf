"""Genomes judged in societies without a plane, and a lesson that learns there."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning import Curriculum, Lesson, Training, learn
from socialmind.learning.episodes.society_episodes import SocietyEpisodes
from socialmind.sources.loading import load_file

GRAZING = load_file(Path(__file__).parents[1] / "grazing.py")
KNOWN = np.array(GRAZING.linear(GRAZING.SCHEME, GRAZING.WEIGHING))
RESTING = np.array([0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0.0])


@pytest.fixture(scope="module")
def episodes():
    return SocietyEpisodes(GRAZING.Weighed, skill="Weigh", ticks=60, record=("meals", "naps"))


def test_a_score_is_that_of_the_model_made_afresh(episodes):
    found = episodes.run([KNOWN, RESTING], [7, 8])
    for individual, genome in enumerate((KNOWN, RESTING)):
        for world, seed in enumerate((7, 8)):
            model = episodes.model(seed, genome)
            model.advance(60)
            assert found.score[individual, world] == model.score()
            assert found.fields["naps"][individual, world] == model.cows.naps.sum()
    assert (found.ticks == 60).all()
    assert found.score[0].mean() > found.score[1].mean()


class Watched(GRAZING.Weighed):
    """The same, looked at now and then."""

    score_every = 25


def test_a_score_may_be_the_mean_of_several_looks():
    episodes = SocietyEpisodes(Watched, skill="Weigh", ticks=60)
    model = episodes.model(9, RESTING)
    said = []
    for ticks in (25, 25, 10):
        model.advance(ticks)
        said.append(model.score())
    assert episodes.run([RESTING], [9]).score.item() == pytest.approx(np.mean(said))


class Ended(GRAZING.Weighed):
    """The same, which stops of itself."""

    def stop_when(self):
        return self.tick >= 20


def test_an_episode_ends_where_the_society_stops():
    found = SocietyEpisodes(Ended, skill="Weigh", ticks=60).run([RESTING], [9])
    model = SocietyEpisodes(GRAZING.Weighed, skill="Weigh", ticks=60).model(9, RESTING)
    model.advance(20)
    assert found.ticks.tolist() == [[20]]
    assert found.score.item() == model.score()


def test_neither_order_nor_company_change_what_comes_out(episodes):
    together = episodes.run([RESTING, KNOWN], [3, 4, 3]).score
    assert (together[:, 0] == together[:, 2]).all()
    assert (episodes.run([KNOWN], [4]).score == together[1, 1]).all()
    assert (episodes.run([RESTING, KNOWN], [4, 3]).score == together[:, 1::-1]).all()


def test_a_mind_as_it_is_needs_no_genome(episodes):
    assert (episodes.run(None, [5]).score == episodes.run([KNOWN], [5]).score).all()


def test_nothing_is_compiled_anew_for_a_genome(episodes):
    episodes.run([KNOWN], [1])
    model, _ = episodes._worlds[1]
    module = model.engine.module
    episodes.run([RESTING, KNOWN], [1])
    assert episodes._worlds[1][0].engine.module is module


def test_a_lesson_learns_there(tmp_path):
    lesson = Lesson(
        "Weigh", GRAZING.Weighed, generations=6, repetitions=2, ticks=60, optimiser="CMAES",
        settings={"population": 8}, finalists=2, finals=4,
    )  # fmt: skip
    folder = learn(
        None, Curriculum([lesson], mind=GRAZING.MIND), attempts=1, out=tmp_path / "t", workers=1
    )
    training = Training(folder)
    assert len(training.curve) == 6
    genome = training.mind(1).skill("Weigh").genome
    judged = SocietyEpisodes(GRAZING.Weighed, skill="Weigh", ticks=60).run([genome], range(50, 54))
    assert judged.score.mean() > -0.2


class Unscored(GRAZING.Grazing):
    """Cows that no score judges."""

    cows = GRAZING.Weighed.cows


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: SocietyEpisodes(Unscored), "says no score"),
        (lambda: SocietyEpisodes(GRAZING.Weighed, skill="Weight"), "Weigh"),
        (lambda: SocietyEpisodes(GRAZING.Weighed, skill="Weigh").run([[1.0]], [1]), "12"),
        (lambda: SocietyEpisodes(GRAZING.Weighed, physics="pymunk"), "has no plane"),
        (lambda: SocietyEpisodes(GRAZING.Weighed, ticks=0), "1 or more"),
        (
            lambda: SocietyEpisodes(GRAZING.Weighed, ticks=1, record=("meal",)).run(None, [1]),
            "'meal' to record.*meals",
        ),
    ],
)
def test_what_cannot_be_judged_is_refused(call, message):
    with pytest.raises((ModelError, SocialmindError), match=message):
        call()
