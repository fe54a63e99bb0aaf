"""Asking for entry, granting, refusing and expelling, by hand."""

import numpy as np
import pytest

from coglogo_py import CogLogoError, CognitiveScheme, Culture, Group, MindError, Role, Society

LORDS = CognitiveScheme("lords", groups=(Group("village", (Role("chief"),)), Group("court")))
FOLK = CognitiveScheme("folk", groups=(Group("village", (Role("member"), Role("elder"))),))


@pytest.fixture
def people():
    """A lord with a village, another with another, a stranger and a cousin."""
    culture = Culture((LORDS, FOLK), seed=1)
    lord, other = culture.breeds[0].new_mind(), culture.breeds[0].new_mind()
    for one in (lord, other):
        one.create_and_join_group("village", "chief")
    return lord, other, culture.breeds[1].new_mind(), culture.breeds[1].new_mind()


def test_who_asks_is_granted_the_role_asked_for(people):
    lord, other, stranger, _ = people
    assert stranger.get_asked_group_id("village") == -1
    assert not lord.grant_entry("village", stranger)
    assert stranger.ask_to_join("village", "elder", 0)
    assert stranger.get_asked_group_id("village") == 0
    assert not other.grant_entry("village", stranger)
    assert stranger.get_group_id("village") == -1
    assert lord.grant_entry("village", stranger)
    assert stranger.get_group_role_id("village", "elder") == 0
    assert stranger.get_participation("village") == 1.0
    assert stranger.get_asked_group_id("village") == -1
    assert not stranger.ask_to_join("village", "elder", 1)  # it is in one
    assert not lord.grant_entry("village", stranger)


def test_who_is_refused_may_ask_again_and_a_new_request_takes_the_place_of_the_last(people):
    lord, other, stranger, _ = people
    stranger.ask_to_join("village", "elder", 0)
    assert not other.refuse_entry("village", stranger)
    assert lord.refuse_entry("village", stranger)
    assert not lord.refuse_entry("village", stranger)
    assert stranger.ask_to_join("village", "member", 0)
    assert stranger.ask_to_join("village", "member", 1)
    assert not lord.grant_entry("village", stranger)
    assert other.grant_entry("village", stranger)


def test_requests_end_with_the_group_with_the_asker_and_when_it_joins_another(people):
    lord, other, stranger, cousin = people
    stranger.ask_to_join("village", "elder", 0)
    cousin.ask_to_join("village", "member", 1)
    lord.leave_group("village")
    assert stranger.get_asked_group_id("village") == -1
    # Whoever founds a village in the same row has another.
    lord.create_and_join_group("village", "chief")
    assert lord.get_group_id("village") == 2
    assert not lord.grant_entry("village", stranger)
    assert not stranger.ask_to_join("village", "elder", 0)
    assert not stranger.ask_to_join("village", "elder", -1)
    cousin.join_group("village", "elder", 2)
    assert cousin.get_asked_group_id("village") == -1
    cousin.leave_group("village")
    assert not other.grant_entry("village", cousin)
    cousin.ask_to_join("village", "member", 1)
    slot = cousin.slot
    child = cousin.hatch()
    assert child.get_asked_group_id("village") == -1
    cousin.die()
    heir = stranger.society.new_mind()
    assert heir.slot == slot
    assert heir.get_asked_group_id("village") == -1


def test_who_is_in_the_same_group_can_be_expelled(people):
    lord, other, stranger, cousin = people
    stranger.join_group("village", "member", 0)
    assert not other.expel("village", stranger)
    assert not lord.expel("village", cousin)
    assert lord.expel("village", stranger)
    assert stranger.get_group_id("village") == -1
    assert lord.expel("village", lord)  # oneself: the village ends
    assert not (lord.society.minds.instance_id == 0).any()
    assert not cousin.expel("village", cousin)


def test_requests_are_state_where_there_are_some(people):
    lord, _, stranger, _ = people
    society = stranger.society
    before = society.state()
    assert "asked_id" not in before
    stranger.ask_to_join("village", "elder", 0)
    asking = society.state()
    lord.refuse_entry("village", stranger)
    society.restore(asking)
    assert stranger.get_asked_group_id("village") == 0
    society.reserve(100)
    assert stranger.get_asked_group_id("village") == 0
    society.restore(before)
    assert stranger.get_asked_group_id("village") == -1
    with pytest.raises(CogLogoError, match="asked_id in the state"):
        society.restore({**asking, "asked_id": np.full_like(asking["asked_id"], 9)})
    with pytest.raises(CogLogoError, match="asked_role in the state"):
        society.restore({**asking, "asked_role": np.full_like(asking["asked_role"], 9)})
    assert lord.get_group_id("village") == 0


def test_wrong_commands_are_refused(people):
    lord, _, stranger, _ = people
    apart = Society(FOLK, seed=1).new_mind()
    for command in (lord.grant_entry, lord.refuse_entry, lord.expel):
        with pytest.raises(MindError, match="shares no groups with"):
            command("village", apart)
        with pytest.raises(MindError, match="found 3; expected a mind"):
            command("village", 3)
        with pytest.raises(MindError, match="no group 'vilage'"):
            command("vilage", stranger)
    with pytest.raises(MindError, match="no role 'king'"):
        stranger.ask_to_join("village", "king", 0)
    with pytest.raises(MindError, match="ask_to_join 'village', id: found"):
        stranger.ask_to_join("village", "elder", 0.5)
    stranger.die()
    with pytest.raises(MindError, match="is dead"):
        lord.expel("village", stranger)
