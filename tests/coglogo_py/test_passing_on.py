"""What a mind has at birth by chance, what it inherits, and what it imitates."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, Culture, MindError, Society, WeightedStochastic

PLAIN = Cogniton("Plain", start_value=1, influence={"a": 1, "b": 2}, conditional=("a", "b"))
TALL = Cogniton("Tall", start_value=5, type="trait", chance=0.3)
FASHION = Cogniton("Fashion", start_value=2, type="meme", chance=0.6, inherited=0.25)
SONG = Cogniton("Song", starting=False, start_value=4, type="meme", inherited=0)


def scheme(*cognitons):
    return CognitiveScheme("folk", cognitons, decision_maker=WeightedStochastic())


SCHEME = scheme(PLAIN, TALL, FASHION, SONG)


def has(society, name):
    return np.array([mind.is_active(name) for mind in society])


def test_a_chance_at_birth_is_met_as_often_as_it_says():
    society = Society(SCHEME, seed=5)
    society.new_minds(20_000)
    tall, fashion = has(society, "Tall"), has(society, "Fashion")
    assert abs(tall.mean() - 0.3) < 4 * (0.3 * 0.7 / 20_000) ** 0.5
    assert abs(fashion.mean() - 0.6) < 4 * (0.6 * 0.4 / 20_000) ** 0.5
    assert abs(np.corrcoef(tall, fashion)[0, 1]) < 4 / 20_000**0.5
    assert {mind.get_cogniton_value("Tall") for mind in society} == {0.0, 5.0}


def test_minds_made_at_once_are_as_those_made_one_by_one():
    one, several = Society(SCHEME, seed=5), Society(SCHEME, seed=5)
    several.new_minds(100)
    for _ in range(100):
        one.new_mind()
    assert [mind.cognitons() for mind in one] == [mind.cognitons() for mind in several]
    other = Society(SCHEME, seed=6)
    other.new_minds(100)
    assert (has(other, "Tall") != has(one, "Tall")).any()


def test_chance_disturbs_no_other_draw_and_no_other_cogniton():
    with_chance, without = Society(SCHEME, seed=5), Society(scheme(PLAIN), seed=5)
    fewer = Society(scheme(TALL), seed=5)
    for society in (with_chance, without, fewer):
        society.new_minds(200)
    chosen = [[mind.choose_next_plan() for mind in one] for one in (with_chance, without)]
    assert chosen[0] == chosen[1]
    np.testing.assert_array_equal(has(with_chance, "Tall"), has(fewer, "Tall"))


def test_a_culture_draws_as_well():
    lords, folk = Culture((scheme(PLAIN), scheme(TALL)), seed=5).breeds
    for _ in range(50):
        lords.new_mind()
        folk.new_mind()
    assert 0 < has(folk, "Tall").sum() < 50


def test_a_child_has_what_its_parent_has_or_what_a_new_mind_has():
    society = Society(SCHEME, seed=5)
    parent = society.new_mind()
    for name, value in {"Plain": 9, "Tall": 8, "Fashion": 7, "Song": 6}.items():
        parent.activate_cogniton(name)
        parent.set_cogniton_value(name, value)
    children = [parent.hatch() for _ in range(8000)]
    values = np.array([list(child.cognitons().values()) for child in children], float)
    assert (values[:, 0] == 9).all() and (values[:, 1] == 8).all()
    assert np.isnan(values[:, 3]).all()  # inherited by none, and at birth inactive
    shares = {
        7.0: 0.25,  # as the parent's
        2.0: 0.75 * 0.6,  # as a new mind's
    }
    for value, share in shares.items():
        found = (values[:, 2] == value).mean()
        assert abs(found - share) < 4 * (share * (1 - share) / 8000) ** 0.5
    parent.deactivate_cogniton("Fashion")
    inactive = np.mean([not parent.hatch().is_active("Fashion") for _ in range(8000)])
    assert abs(inactive - (0.25 + 0.75 * 0.4)) < 0.03


def test_imitating_takes_over_an_active_cogniton_with_its_value():
    other = Cogniton("Song", start_value=3)
    bird = Society(CognitiveScheme("birds", (other,)), seed=1).new_mind()
    learner = Society(SCHEME, seed=5).new_mind()
    assert not learner.is_active("Song")
    assert learner.imitate("Song", bird) and learner.get_cogniton_value("Song") == 3
    bird.deactivate_cogniton("Song")
    assert not learner.imitate("Song", bird) and learner.get_cogniton_value("Song") == 3
    with pytest.raises(MindError, match="no cogniton 'Tall' in scheme 'birds'"):
        learner.imitate("Tall", bird)
    with pytest.raises(MindError, match="no cogniton 'Dance' in scheme 'folk'"):
        learner.imitate("Dance", bird)
    with pytest.raises(MindError, match="imitate 'Song': found 3; expected a mind"):
        learner.imitate("Song", 3)
    bird.die()
    with pytest.raises(MindError, match="dead"):
        learner.imitate("Song", bird)


def test_memes_are_taken_over_together():
    society = Society(SCHEME, seed=5)
    model, learner = society.new_mind(), society.new_mind()
    for name, value in {"Tall": 8, "Fashion": 7, "Song": 6}.items():
        model.activate_cogniton(name)
        model.set_cogniton_value(name, value)
    before = learner.cognitons()
    assert learner.imitate_memes(model) == 2
    assert learner.cognitons() == before | {"Fashion": 7, "Song": 6}
    model.deactivate_cogniton("Song")
    assert learner.imitate_memes(model) == 1 and learner.is_active("Song")
    stranger = Society(scheme(SONG), seed=1).new_mind()
    assert stranger.imitate_memes(model) == 0  # of its memes the model has none now
