"""What words of schemes are called in figures."""

import pytest

from socialmind.experiments.figures.labels import word_name


@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("influence.WheatNeed.GrowWheat", "influence of WheatNeed on GrowWheat"),
        ("reinforcement.Farmer.Sell", "reinforcement of Sell by Farmer"),
        ("bulls.influence.a.b.Go", "influence of a.b on Go (bulls)"),
        ("at_birth.ToolStock", "ToolStock at birth"),
        ("decision_maker.bias", "decision maker: bias"),
        ("humans.scheme", "humans scheme"),
    ],
)
def test_words_of_schemes_read_as_words(word, name):
    assert word_name(word) == name
