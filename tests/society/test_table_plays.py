"""Who plays which role, as a column."""

import pytest

from coglogo_py import CognitiveScheme, Group, Role
from socialmind import Agent, Model, Population, each
from socialmind.errors import SocialmindError


class One(Agent):
    pass


def join(one, model):
    if one.id == 0:
        one.mind.create_and_join_group("club", "chair")
    elif one.id < 3:
        one.mind.join_group("club", "member", model.ones[0].mind.get_group_id("club"))
    if one.id == 2:
        one.mind.change_role("club", "chair")


class Club(Model):
    """A club."""

    ones = Population(
        One,
        4,
        mind=CognitiveScheme("ones", groups=(Group("club", (Role("chair"), Role("member"))),)),
    )
    schedule = (each(ones, join, shuffled=False),)


def test_a_column_says_who_plays_a_role():
    club = Club(seed=1, compiled=False)
    assert not club.ones.plays("club", "chair").any()
    club.advance(1)
    assert club.ones.plays("club", "chair").tolist() == [True, False, True, False]
    assert club.ones.plays("club", "member").tolist() == [False, True, False, False]
    assert club.ones[3].mind.change_role("club", "chair") is False
    with pytest.raises(SocialmindError, match=r"no role 'chef' of a group 'club'.*chair"):
        club.ones.plays("club", "chef")
    with pytest.raises(SocialmindError, match=r"of a group 'clubs'.*club"):
        club.ones.plays("clubs", "chair")
