"""The farmer-artisan society with a learned mind: it can be the scheme, and it does better."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme
from socialmind import Population
from socialmind.catalogue import load_model
from socialmind.experiments import Run, run
from socialmind.learning.distilling import (
    distilled,
    states_of,
    weights_by_hierarchy,
    weights_by_links,
)
from socialmind.learning.episodes.society_episodes import SocietyEpisodes
from socialmind.mind import MindDescription, Perceptron
from socialmind.mind.weighing import Weighing, linear_skill
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

Written, Learned = load_model("farmer_artisan"), load_model("farmer_artisan_learned")
LESSONS = load_file(model_folder("farmer_artisan_learned") / "lessons.py")
SCHEME = CognitiveScheme.load(model_folder("farmer_artisan") / "scheme.yaml")
WEIGHING = Learned.populations["humans"].weighing
MIND = MindDescription.load(model_folder("farmer_artisan_learned") / "mind")


@pytest.fixture(scope="module")
def scheme_as_a_mind():
    """A mind that is the written scheme, within the reaches of the model."""
    skill = linear_skill(SCHEME, WEIGHING, "Decide")
    return MindDescription("farmer", list(WEIGHING.cognitons), SCHEME.plans, skills=[skill])


def test_a_mind_that_is_the_scheme_weighs_as_it_does(scheme_as_a_mind):
    states = states_of(Written(seed=1), "humans", [100, 1000])
    by_links = weights_by_links(states, SCHEME)
    by_mind = weights_by_hierarchy(states, SCHEME, scheme_as_a_mind, WEIGHING)
    inside = (np.abs(by_links) < 1000).all(axis=1)
    assert inside.mean() > 0.5
    np.testing.assert_allclose(by_mind[inside], by_links[inside], atol=1e-9)


WIDE = Weighing({**dict.fromkeys(WEIGHING.cognitons, 4000.0)}, reach=40_000.0)


class Wide(Learned):
    """The same with a mind that is the written scheme, and reaches that hold all that comes up."""

    humans = Population(
        Learned.populations["humans"].agent,
        "n_agents",
        mind=SCHEME,
        plans=Written.populations["humans"].plans,
        hierarchy=MindDescription(
            "farmer",
            list(WIDE.cognitons),
            SCHEME.plans,
            skills=[linear_skill(SCHEME, WIDE, "Decide")],
        ),
        weighing=WIDE,
    )


def test_a_society_of_such_minds_lives_as_the_written_one_does():
    written, minds = Written(seed=2), Wide(seed=2)
    for ticks in (1000, 9000):
        written.advance(ticks)
        minds.advance(ticks)
        assert minds.series() == written.series()
        for name in ("x", "y", "wheat", "tools", "sold"):
            np.testing.assert_array_equal(
                getattr(minds.humans, name), getattr(written.humans, name)
            )
        assert minds.plans(minds.humans) == written.plans(written.humans)


def test_its_mind_is_of_the_form_that_the_lesson_teaches():
    assert MIND.skill("Decide").function == Perceptron(layers=1)
    assert MIND.skill("Decide").genome_size == LESSONS.MIND.skill("Decide").genome_size == 112


def test_it_does_better_than_the_scheme_in_worlds_that_it_has_not_seen():
    episodes = SocietyEpisodes(LESSONS.Prosperity, skill="Decide")
    learned = episodes.run(None, range(900, 904)).score
    written = []
    for seed in range(900, 904):
        society = Written(seed=seed)
        society.advance(episodes.ticks)
        written.append(society.humans.wheat.mean() / 800)
    assert learned.min() > max(written)


def test_a_scheme_that_is_distilled_from_it_does_as_well(tmp_path):
    states = states_of(Learned(seed=5), "humans", range(200, 3001, 200))
    weights = weights_by_hierarchy(states, SCHEME, MIND, WEIGHING)
    found = distilled(states, weights, SCHEME)
    assert found.agreement.overlap > 0.8
    assert found.links <= 16  # of 32
    found.scheme.save(tmp_path / "distilled.yaml")
    by_scheme, by_mind = Written(seed=6, scheme=tmp_path / "distilled.yaml"), Learned(seed=6)
    for society in (by_scheme, by_mind):
        society.advance(5000)
    assert by_scheme.humans.wheat.mean() > 0.9 * by_mind.humans.wheat.mean()


def test_a_run_keeps_scheme_and_mind(tmp_path):
    folder = run(Learned, seed=3, ticks=50, out=tmp_path / "run")
    kept = Run(folder)
    assert kept.series["tick"].iloc[-1] == 50
    assert {"weight_GrowWheat", "cogniton_Farmer"} <= set(kept.agents.columns)
