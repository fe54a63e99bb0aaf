"""A live run is the run of the command line, forwards and back."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Change, Edit, Run, Shock, replay
from socialmind.studio.running.live_run import STATES, LiveRun


@pytest.fixture(scope="module")
def village():
    return load_model("farmer_artisan")


def same(one, other):
    states = one.state(), other.state()
    return all(np.array_equal(states[0][n], states[1][n], equal_nan=True) for n in states[0]
               if states[0][n].dtype.names is None)  # fmt: skip


@settings(max_examples=15)
@given(st.lists(st.integers(0, 400), min_size=1, max_size=6))
def test_wherever_one_goes_the_society_is_as_it_was_there(ticks):
    village = load_model("farmer_artisan")
    live = LiveRun(village(seed=3))
    live.advance(150)
    for tick in ticks:
        live.go_to(tick)
        straight = village(seed=3)
        straight.advance(tick)
        assert live.tick == tick
        assert same(live.society, straight)


def test_few_states_are_kept_of_a_long_run(village):
    live = LiveRun(village(seed=1))
    live.advance(5000)
    assert len(live._kept) <= STATES
    assert live._kept[0].tick == 0


def test_what_was_done_happens_again_when_one_goes_back_and_in_the_saved_run(village, tmp_path):
    live = LiveRun(village(seed=2))
    live.advance(100)
    live.intervene(Change(100, {"tool_price": 50.0}))
    live.intervene(Edit(100, "humans", 4, "cogniton Farmer", 20.0))
    live.advance(50)
    live.intervene(Edit(150, "humans", 4, "field wheat", 5.0))
    live.advance(50)
    before, series = live.society.state(), live.society.series()
    live.go_to(20)
    assert (live.tick, live.furthest) == (20, 200)
    live.go_to(200)
    assert all(np.array_equal(before[n], live.society.state()[n], equal_nan=True)
               for n in before if before[n].dtype.names is None)  # fmt: skip
    folder = live.save(tmp_path / "run", every=10)
    run = Run(folder)
    assert run.series.iloc[-1].to_dict() == {"tick": 200, **series}
    assert replay(folder).equal
    again = LiveRun.of_folder(folder)
    again.go_to(200)
    assert again.society.series() == series


def test_who_goes_back_and_changes_something_has_another_future(village):
    live = LiveRun(village(seed=2))
    live.advance(300)
    there = live.society.series()
    live.go_to(100)
    live.intervene(Change(100, {"tool_price": 20.0}))
    assert live.furthest == 100
    live.advance(200)
    assert live.society.series() != there
    assert len(live.interventions) == 1


def test_what_fails_changes_nothing(village):
    live = LiveRun(village(seed=2))
    live.advance(10)
    before = live.society.series()
    for wrong in (
        Edit(10, "humans", 999, "field wheat", 1.0),
        Edit(10, "humans", 1, "field whaet", 1.0),
        Edit(10, "humans", 1, "field wheat", "much"),
        Edit(10, "humans", 1, "cogniton Famer", 1.0),
        Edit(10, "people", 1, "field wheat", 1.0),
        Edit(10, "humans", 1, "mood", 1.0),
        Change(10, {"tool_price": -1.0}),
    ):
        with pytest.raises(SocialmindError):
            live.intervene(wrong)
        assert live.society.series() == before
        assert live.interventions == []


def test_a_button_of_the_model_is_pressed_kept_and_replayed(tmp_path):
    kind = load_model("wolves_sheep")
    live = LiveRun(kind(seed=2, compiled=False))
    live.advance(10)
    before = live.society.series()["sheep"]
    live.intervene(Shock(10, kind.buttons["Plague among sheep"]))
    assert 0.3 * before < live.society.series()["sheep"] < 0.7 * before
    live.advance(5)
    after = live.society.series()
    live.go_to(0)
    live.go_to(15)
    assert live.society.series() == after
    folder = live.save(tmp_path / "run")
    assert Run(folder).manifest.interventions[0]["function"] == "plague"
    assert Run(folder).series.iloc[-1].to_dict() == {"tick": 15, **after}
    assert replay(folder).equal


def test_who_died_is_told_with_the_tick():
    live = LiveRun(load_model("wolves_sheep")(seed=2, compiled=False))
    live.advance(3)
    living = set(live.society.sheep.id.tolist())
    live.advance(7)
    gone = min(living - set(live.society.sheep.id.tolist()))
    died = live.death_of("sheep", gone, 3)
    assert live.tick == 10
    live.go_to(died - 1)
    assert live.society.sheep.contains(gone)
    live.go_to(died)
    assert not live.society.sheep.contains(gone)
    live.go_to(10)
    there = live.society.sheep.id.tolist()[0]
    assert live.death_of("sheep", there, 9) is None


def test_a_reset_run_has_nothing_of_what_was_done(village):
    live = LiveRun(village(seed=2))
    live.advance(50)
    undisturbed = live.society.series()
    live.go_to(20)
    live.intervene(Change(20, {"tool_price": 50.0}))
    live.advance(30)
    live.reset()
    assert (live.tick, live.furthest, live.interventions) == (0, 0, [])
    live.advance(50)
    assert live.society.series() == undisturbed
