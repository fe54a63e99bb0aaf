"""Societies that stop before their time, and parameters that are a choice among texts."""

import json

import numpy as np
import pandas as pd
import pytest

from coglogo_py import CogLogoError, CognitiveScheme, Cogniton, Society
from socialmind import Agent, Model, ModelError, Plane, Population, SocialmindError, each, parameter
from socialmind.catalogue import load_model
from socialmind.commands.listing import description
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.mind.minds import Minds
from socialmind.runs.execution import run


class Trader(Agent):
    goods: float = 1.0


def deal(trader, model):
    if model.trade == "market":
        trader.goods += 1.0
    elif model.trade != "gift" and model.trade in ("barter", "theft"):
        trader.goods += paid(model.trade)


def paid(kind):
    if kind == "theft":
        return -1.0
    return 0.5


class Bazaar(Model):
    """A bazaar."""

    trade: str = parameter("market", choices=("market", "barter", "gift", "theft"), doc="how")
    enough: float = parameter(3.0)
    traders = Population(Trader, 2)
    schedule = (each(traders, deal),)

    def stop_when(self):
        return "rich" if self.traders.goods.max() >= self.enough else None


@pytest.mark.parametrize("compiled", [True, False])
def test_a_society_stops_where_it_says_so(compiled):
    society = Bazaar(compiled=compiled)
    society.advance(10)
    assert society.tick == 2 and society.over == "rich" and society.stopped
    society.advance(5)
    assert society.tick == 2
    assert society.series() == {"traders": 2, "over": "rich"}
    assert Bazaar(compiled=compiled, trade="barter").series()["over"] is None


@pytest.mark.parametrize("compiled", [True, False])
def test_a_choice_is_a_text_in_rules_and_outside(compiled):
    found = {}
    for choice in Bazaar.parameters["trade"].choices:
        society = Bazaar(compiled=compiled, trade=choice, enough=100)
        society.advance(2)
        assert society.trade == choice == society.parameter_values()["trade"]
        assert society.fresh().trade == choice
        found[choice] = society.traders.goods.tolist()[0]
    assert found == {"market": 3.0, "barter": 2.0, "gift": 1.0, "theft": -1.0}


def test_a_choice_is_checked_and_listed():
    with pytest.raises(
        SocialmindError, match=r"trade: found 'bater'; expected one of market.*'barter'"
    ):
        Bazaar(trade="bater")
    with pytest.raises(SocialmindError, match="trade: found 1"):
        Bazaar(trade=1)
    assert Bazaar.parameters["trade"].read("gift") == "gift"
    assert "market or barter or gift or theft" in description("bazaar", Bazaar)


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"default": "a"}, "a text with choices"),
        ({"default": "a", "choices": ("b",)}, "expected one of b"),
        ({"default": "a", "choices": ("a", "a")}, "each text once"),
        ({"default": "a", "choices": ("a", 1)}, "expected texts"),
        ({"default": "a", "choices": ("a",), "low": 1}, "choices alone"),
    ],
)
def test_wrong_choices_are_refused_where_they_stand(given, line):
    with pytest.raises(ModelError, match=line):
        type("Wrong", (Model,), {"kind": parameter(**given)})


def test_a_text_that_is_no_choice_is_refused_in_a_rule():
    def misspelt(trader, model):
        if model.trade == "bater":
            trader.goods = 0.0

    kind = type("Bazaars", (Bazaar,), {"schedule": (each(Bazaar.traders, misspelt),)})
    with pytest.raises(ModelError, match=r"'bater'.*did you mean 'barter'"):
        kind(compiled=False)


def test_a_run_ends_where_the_society_stops(tmp_path):
    folder = run(Bazaar, out=tmp_path / "run", ticks=9, every=5, parameters={"trade": "market"})
    kept = json.loads((folder / "manifest.json").read_text())
    assert kept["ticks_done"] == 2 and kept["status"] == "finished"
    assert kept["parameters"]["trade"] == "market"
    series = pd.read_parquet(folder / "series.parquet")
    assert series["tick"].tolist() == [0, 2] and series["over"].dropna().tolist() == ["rich"]


def test_short_advances_do_not_make_the_next_stretch_long():
    society = type("Bazaars", (Bazaar,), {})(enough=1e9)
    for _ in range(100):
        society.advance(1)
    assert society.engine._ticks_per_chunk <= 16  # Ctrl-C is heard between two stretches


def test_a_plane_has_interruptions():
    with pytest.raises(ModelError, match="interruptions"):
        type("Flat", (Model,), {"world": Plane(), "stop_when": lambda self: True})


# Numbers -----------------------------------------------------------------------------------------


class Crowd(Model):
    n: int = parameter(3)
    wide: float = parameter(1.0)
    loud: bool = parameter(False)
    people = Population(Agent, "n")


def test_numpys_numbers_are_numbers():
    society = Crowd(np.uint64(2**63), False, n=np.int16(2), wide=np.float32(0.5), loud=np.True_)
    assert (society.seed, society.n, society.wide, society.loud) == (2**63, 2, 0.5, True)
    society.advance(np.int64(3))
    assert society.tick == 3 and type(society.seed) is int


@pytest.mark.parametrize("ticks", [2.5, -1, "3", True, None, float("nan")])
def test_ticks_that_are_none_are_refused(ticks):
    with pytest.raises(SocialmindError, match="ticks: found"):
        Crowd(compiled=False).advance(ticks)


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        ({"n": 10**12}, r"1000000000000 agents of 'people' in crowd need about .* TB of memory"),
        ({"n": 10**400}, "64 bits"),
        ({"n": int("9" * 401)}, "64 bits"),
        ({"wide": 10**400}, "a float can hold|finite"),
        ({"n": True}, "found True"),
        ({"n": np.True_}, "expected a whole number"),
        ({"seed": 2**64}, "seed: found"),
        ({"seed": 1.0}, "seed: found 1.0"),
        ({"seed": np.False_}, "seed: found"),
    ],
)
def test_numbers_out_of_bounds_are_refused_in_a_line(settings, line):
    with pytest.raises(SocialmindError, match=line) as refused:
        Crowd(compiled=False, **settings)
    assert len(str(refused.value)) < 300 and "\n" not in str(refused.value)


def test_more_minds_than_memory_are_refused():
    society = Society(CognitiveScheme("herd", (Cogniton("Hunger", influence={"eat": 1}),)), seed=1)
    with pytest.raises(CogLogoError, match=r"minds of scheme 'herd' need about .* of memory"):
        society.new_minds(10**13)
    seek = Skill("Seek", ["SE:L"], ["MO:L"], Perceptron(layers=0))
    with pytest.raises(SocialmindError, match="minds 'v' need about"):
        Minds(MindDescription("v", ["L"], ["L"], [], [seek]), agents=10**12)


def test_explain_proposes_nothing_beyond_the_bounds_that_rules_keep():
    def idle(cow):
        cow.x = 0.0

    def decide(cow):
        cow.plan = cow.mind.choose_next_plan()

    cognitons = (
        Cogniton("Fear", start_value=1, influence={"flee": 1}, conditional=("flee",)),
        Cogniton("Hunger", start_value=5, influence={"eat": 1}, conditional=("eat",)),
    )
    scheme = CognitiveScheme("herd", cognitons)

    def change_of(bounds):
        plans = {"eat": idle, "flee": idle}
        cows = Population(Agent, 1, mind=scheme, plans=plans, bounds=bounds)
        herd = type("Herd", (Model,), {"cows": cows, "schedule": (each(cows, decide),)})
        return herd(compiled=False).explain(0, 1).smallest_change

    assert change_of({}).cogniton == "Fear" and change_of({}).new_value == 5.0
    found = change_of({"Fear": (0, 4)})
    assert (found.cogniton, found.plan) == ("Hunger", "flee") and found.new_value == 1.0
    assert change_of({"Fear": (0, 4), "Hunger": (2, 9)}) is None
    with pytest.raises(ModelError, match="did you mean 'Fear'"):
        change_of({"Fair": (0, 4)})
    with pytest.raises(ModelError, match="bounds"):
        change_of({"Fear": (4, 0)})


def test_robots_are_explained_by_their_hierarchies():
    society = load_model("foraging")(compiled=False)
    society.advance(1)
    with pytest.raises(SocialmindError, match=r"society\.robots\[0\]\.hierarchy"):
        society.explain(0, 1)


def test_the_mind_of_the_dead_is_refused_in_a_line():
    scheme = CognitiveScheme("herd", (Cogniton("Hunger", influence={"eat": 1}),))
    cows = Population(Agent, 2, mind=scheme)
    society = type("Herd", (Model,), {"cows": cows})(compiled=False)
    cow = society.cows[1]
    cow.die()
    with pytest.raises(SocialmindError, match="agent 1 of 'cows' is dead and has no mind"):
        print(cow.mind)


def test_a_scheme_without_a_plan_that_the_model_carries_out():
    def eat(cow):
        cow.x = 0.0

    scheme = CognitiveScheme("herd", (Cogniton("Hunger", influence={"eat": 1}),))
    cows = Population(Agent, 1, mind=scheme, plans={"eat": eat, "eet": eat})
    with pytest.raises(ModelError, match=r"the plan 'eet' of 'cows'.*did you mean 'eat'"):
        type("Herd", (Model,), {"cows": cows})(compiled=False)
