"""Shocks: a function of the user's between two ticks, the same at both speeds."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from socialmind import Agent, Model, Population, each, parameter
from socialmind.errors import ModelError, SocialmindError
from socialmind.interventions.change import Change
from socialmind.interventions.following import advanced
from socialmind.interventions.shock import Shock, loaded
from socialmind.sources.provenance import sources_of_module
from socialmind.work.packing import packed

CHECKOUT = Path(__file__).parents[2]


class Goat(Agent):
    milk: float = 0.0


def graze(goat, model, rng):
    goat.milk += model.growth * rng.random()


class Goats(Model):
    n: int = parameter(4, low=0)
    growth: float = parameter(1.0, low=0.0, high=5.0)
    years: int = 0
    goats = Population(Goat, "n")
    schedule = (each(goats, graze),)


def milked(society):
    society.goats.milk = 0.0
    society.years += 1


def halved(society, rng):
    society.goats.milk *= [rng.random() for _ in society.goats]


def lost(society):
    society.goats[0].die()


def broken(society):
    society.goats.milk = 5.0
    society.years = 1 // 0


def state(society):
    return {name: one.tobytes() for name, one in society.state().items()}


def after(ticks, *interventions, compiled=False, **settings):
    society = Goats(seed=7, compiled=compiled, **settings)
    return advanced(society, ticks, interventions)


def test_a_shock_comes_between_two_ticks():
    by_hand = Goats(seed=7, compiled=False)
    by_hand.advance(5)
    milked(by_hand)
    by_hand.advance(3)
    assert state(after(8, Shock(5, milked))) == state(by_hand)


def test_a_shock_at_the_last_tick_is_yet_to_come():
    assert after(5, Shock(5, milked)).years == 0
    assert after(6, Shock(5, milked)).years == 1
    assert after(6, Shock(0, milked), Shock(0, milked)).years == 2


def test_going_on_later_changes_nothing():
    shocks = Shock(2, halved), Change(4, {"growth": 3.0}), Shock(4, milked), Shock(6, lost)
    begun = after(4, *shocks)
    assert begun.growth == 1.0
    assert state(advanced(begun, 5, shocks)) == state(after(9, *shocks))


def test_both_speeds_give_the_same():
    shocks = Shock(2, halved), Change(4, {"growth": 3.0}), Shock(6, lost), Shock(7, halved)
    assert state(after(9, *shocks)) == state(after(9, *shocks, compiled=True))


def test_draws_of_a_shock_are_its_own():
    drawn = []

    def draw(society, rng):
        drawn.append(rng.random())

    assert state(after(9, Shock(3, draw), Shock(4, draw))) == state(after(9))
    assert len(set(drawn)) == 2
    first = list(drawn)
    after(9, Shock(3, draw))
    assert drawn[2] == first[0]


def test_births_and_deaths_of_a_shock_are_seen_a_tick_later():
    society = Goats(seed=7, compiled=False)
    society.keep_events()
    society = advanced(society, 6, (Shock(3, lost), Change(3, {"growth": 2.0})))
    assert society.kept_events()["tick"].tolist() == [4]


def test_a_failing_shock_leaves_the_society_and_names_its_line():
    society = Goats(seed=7, compiled=False)
    society.advance(3)
    before = state(society)
    line = broken.__code__.co_firstlineno + 2
    with pytest.raises(ModelError, match=r"the shock broken at tick 3 stopped with ZeroDiv") as e:
        Shock(3, broken).applied(society)
    assert str(e.value).startswith(f"{__file__}:{line}: ")
    assert state(society) == before


def test_what_a_shock_may_not_do_is_refused():
    def moves(society):
        society.advance(2)

    def keeps(society):
        society._count = 3

    def misspells(society):
        society.gaots = 3

    society = Goats(seed=7, compiled=False)
    before = state(society)
    for function, message in (
        (moves, "moved the society from tick 0 to 2"),
        (keeps, r"which sets '_count'; expected what a checkpoint holds; declare a variable"),
        (misspells, r"test_shock.py:\d+: the shock misspells at tick 0: .* did you mean 'goats'"),
    ):
        with pytest.raises(SocialmindError, match=message):
            Shock(0, function).applied(society)
        assert state(society) == before
    assert not hasattr(society, "_count")


@pytest.mark.parametrize("function", [lambda: 0, lambda a, b: 0, lambda *, a: 0, 3])
def test_a_function_takes_the_society_and_perhaps_draws(function):
    with pytest.raises(ModelError, match="a function of the society, and of rng if it likes"):
        Shock(3, function)


@pytest.mark.parametrize("tick", [-1, 0.5, "3", None])
def test_a_tick_is_a_whole_number(tick):
    with pytest.raises(SocialmindError, match="the tick of a shock"):
        Shock(tick, milked)


def test_a_shock_is_read_from_text(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("parts.py").write_text("AMOUNT = 3.0\n")
    Path("plague.py").write_text(
        "from parts import AMOUNT\ndef strike(society):\n    society.goats.milk = AMOUNT\n"
    )
    shock = Shock.parsed("12:plague.py:strike")
    assert (shock.tick, shock.name, shock.file) == (12, "strike", tmp_path / "plague.py")
    for text, message in (
        ("plague.py:strike", "expected TICK:FILE.py:FUNCTION"),
        ("-1:plague.py:strike", "expected TICK:FILE.py:FUNCTION"),
        ("1:plague.py", "expected FILE.py:FUNCTION"),
        ("1:plagues.py:strike", "plagues.py: no such file"),
        ("1:plague.py:striek", "no function called 'striek'; did you mean 'strike'"),
    ):
        with pytest.raises(SocialmindError, match=message):
            Shock.parsed(text)


def test_what_is_not_at_the_top_of_a_file_has_none(tmp_path):
    (tmp_path / "waves.py").write_text(
        "from functools import wraps\n"
        "def twice(function):\n"
        "    @wraps(function)\n"
        "    def both(society):\n"
        "        function(society)\n"
        "        function(society)\n"
        "    return both\n"
        "@twice\n"
        "def wave(society):\n"
        "    society.years += 1\n"
    )
    shock = Shock.parsed(f"1:{tmp_path}/waves.py:wave")
    assert shock.file == tmp_path / "waves.py"
    assert after(2, shock).years == 2
    assert Shock(1, lambda society: None).file is None


@pytest.mark.parametrize("modules", [".", "modules"])
def test_a_shock_of_a_file_goes_to_another_process(tmp_path, modules):
    (tmp_path / modules).mkdir(exist_ok=True)
    (tmp_path / modules / "parts.py").write_text("AMOUNT = 3.0\n")
    plague = tmp_path / "plague.py"
    plague.write_text("from parts import AMOUNT\ndef strike(society):\n    return AMOUNT\n")
    shock = Shock(12, loaded(plague, "strike", (tmp_path / modules).resolve()))
    (tmp_path / "shock").write_bytes(packed(shock))
    script = (
        "import sys; from pathlib import Path; from socialmind.work.packing import unpacked\n"
        "one = unpacked(Path(sys.argv[1]).read_bytes()); print(one.tick, one.function(None))"
    )
    words = [sys.executable, "-c", script, str(tmp_path / "shock")]
    ended = subprocess.run(words, capture_output=True, text=True, cwd=CHECKOUT, timeout=120)
    assert ended.stdout == "12 3.0\n", ended.stderr


def test_what_a_shock_imports_is_its_own_whatever_else_has_its_name(tmp_path):
    shocks = []
    for folder, amount in (("one", 1.0), ("two", 2.0)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "helpers_of_shocks.py").write_text(f"AMOUNT = {amount}\n")
        plague = tmp_path / folder / "plague.py"
        plague.write_text(
            "from helpers_of_shocks import AMOUNT\n"
            "def strike(society):\n    society.goats.milk = AMOUNT\n"
        )
        shocks.append(Shock.parsed(f"1:{plague}:strike"))
    assert [after(2, one).goats.milk[0] > 1.9 for one in shocks] == [False, True]
    for shock, amount in zip(shocks, (b"1.0", b"2.0"), strict=True):
        copies = sources_of_module(shock.function.__module__).copies()
        (kept,) = (one for place, one in copies.items() if "helpers_of_shocks" in place)
        assert kept == b"AMOUNT = " + amount + b"\n"


# Changes of parameters and schemes


def test_a_parameter_changes_for_the_rules():
    society = after(3)
    changed = Change(3, {"growth": 0.0}).applied(society)
    assert (society.growth, changed.growth) == (1.0, 0.0)
    changed.advance(4)
    assert np.array_equal(changed.goats.milk, society.goats.milk)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"growth": 9.0}, "parameter growth: found 9.0; expected 0 … 5"),
        ({"grwoth": 1.0}, "no parameter 'grwoth'; did you mean 'growth'"),
        ({"n": 9}, "parameter n: says how large 'goats' is at the start, which is over at tick 3"),
    ],
)
def test_a_change_that_does_not_fit_is_refused(parameters, message):
    society = after(3)
    before = state(society)
    with pytest.raises(SocialmindError, match=message):
        Change(3, parameters).applied(society)
    assert state(society) == before
