"""Turns within a tick lead to the tick that compiled rules make."""

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.turns import after_turns, turnless


def test_each_agent_has_its_turn_and_the_society_stays_as_it_is():
    society = load_model("schelling")(seed=2, n_agents=30, world_size=10, compiled=False)
    before = society.state()
    who = []
    while (found := after_turns(society, len(who) + 1)) is not None:
        made, turn = found
        assert (turn.number, turn.rule, turn.population) == (len(who) + 1, "settle", "people")
        who.append(turn.id)
    assert sorted(who) == list(range(30))
    assert who != sorted(who)  # in a random order
    assert all(np.array_equal(before[name], one) for name, one in society.state().items())
    society.advance(1)
    assert made.people.x.tolist() == society.people.x.tolist()


def test_only_who_had_a_turn_has_moved():
    society = load_model("wolves_sheep")(seed=2, compiled=False)
    made, turn = after_turns(society, 1)
    one = made.tables[turn.population][turn.id]
    assert one.energy != society.tables[turn.population][turn.id].energy
    others = [n for n in society.sheep.id.tolist() if n != turn.id]
    assert all(made.sheep[n].energy == society.sheep[n].energy for n in others)


def test_after_the_last_turn_comes_the_next_tick():
    live = LiveRun(load_model("wolf_cow")(seed=1, compiled=False))
    straight = load_model("wolf_cow")(seed=1, compiled=False)
    straight.advance(1)
    turns = 0
    while live.turn() is not None:
        turns += 1
    assert turns > 10
    assert (live.tick, live.turns) == (1, 0)
    assert live.society.series() == straight.series()


def test_where_there_are_no_turns_it_is_said():
    assert "at once" in turnless(load_model("collect"))
    assert turnless(load_model("schelling")) == ""
    with pytest.raises(SocialmindError, match="at once"):
        after_turns(load_model("collect")(seed=1, compiled=False), 1)
