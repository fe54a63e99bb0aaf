"""Running societies: their schemes, idle agents, rules that fail, receipts of decisions."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, SchemeError
from socialmind import (
    Agent,
    IdleWarning,
    Model,
    ModelError,
    Population,
    RuleError,
    SocialmindError,
    each,
    once,
)
from socialmind.catalogue import load_model

# Minds -------------------------------------------------------------------------------------------

SCHEME = """\
name: {name}
plans: [eat, rest]
cognitons:
  Hunger:
    start: 1
    influence: {{eat: 1}}
    conditional: [eat]
  Sloth:
    influence: {{rest: 1}}
    conditional: [rest]
"""
MODEL = """\
from socialmind import Agent, Model, Population, each


def live(cow, model, rng):
    cow.plan = cow.mind.choose_next_plan()
    cow.run_plan(model, rng)


def eat(cow):
    cow.mind.add_to_cogniton_value("Hunger", -1)


def rest(cow):
    cow.mind.add_to_cogniton_value("Hunger", 1)


class Herd(Model):
    cows = Population(Agent, 3, mind="scheme.yaml", plans={"eat": eat, "rest": rest})
    schedule = (each(cows, live),)
"""


@pytest.fixture
def herd(tmp_path):
    """Write a model with minds, a part of it replaced, and load its class."""

    def write(old="", new=""):
        assert old in MODEL
        (tmp_path / "scheme.yaml").write_text(SCHEME.format(name="cattle"))
        (tmp_path / "model.py").write_text(MODEL.replace(old, new) if old else MODEL)
        return load_model(tmp_path)

    return write


def test_a_model_with_minds_runs_alike_at_both_speeds(herd):
    model = herd()
    for compiled in (True, False):
        society = model(compiled=compiled)
        society.advance(1)
        assert society.plans(society.cows) == ["eat"] * 3
        assert society.cows.cogniton("Hunger").tolist() == [0.0] * 3


def test_a_plan_without_a_function_is_refused(herd):
    model = herd('"eat": eat, ', "")
    with pytest.raises(ModelError, match=r"the plan 'eat' of the scheme 'cattle'.*has rest"):
        model(compiled=False)


@pytest.mark.parametrize("compiled", [True, False])
def test_a_misspelt_cogniton_is_refused_with_file_line_and_what_there_is(herd, tmp_path, compiled):
    model = herd('add_to_cogniton_value("Hunger", 1)', 'add_to_cogniton_value("Hungre", 1)')
    with pytest.raises(ModelError) as error:
        model(compiled=compiled)
    assert error.value.file == str(tmp_path / "model.py")
    assert error.value.line == 14
    said = f"the cogniton 'Hungre', which the scheme 'cattle' ({tmp_path / 'scheme.yaml'}) does not"
    assert said in str(error.value)
    assert "did you mean 'Hunger'?" in str(error.value)


def test_a_missing_scheme_is_said(herd, tmp_path):
    model = herd()
    (tmp_path / "scheme.yaml").unlink()
    with pytest.raises(SchemeError, match=r"scheme\.yaml: the file cannot be read"):
        model(compiled=False)


def test_another_scheme_is_taken_for_the_only_population_with_minds(herd, tmp_path):
    model = herd()
    other = tmp_path / "other.yaml"
    other.write_text(SCHEME.format(name="other").replace("start: 1", "start: 7"))
    by_file = model(compiled=False, scheme=other)
    by_name = model(compiled=False, scheme={"cows": CognitiveScheme.load(other)})
    for society in (by_file, by_name):
        assert society.cows.cogniton("Hunger").tolist() == [7.0] * 3
        assert society.fresh().cows.cogniton("Hunger").tolist() == [7.0] * 3


def test_an_unknown_cogniton_of_a_table_is_refused(herd):
    society = herd()(compiled=False)
    with pytest.raises(SocialmindError, match=r"'cows' has no cogniton 'Hungre'; .*Hunger"):
        society.cows.cogniton("Hungre")


# Idle agents -------------------------------------------------------------------------------------

ASLEEP = CognitiveScheme(
    "sleepers",
    (Cogniton("Awake", starting=False, influence={"work": 1.0}, conditional=("work",)),),
)


class Sleeper(Agent):
    worked: int = 0
    wakes: int = 0


def live(sleeper, model, rng):
    if model.tick >= sleeper.wakes:
        sleeper.mind.activate_cogniton("Awake")
    sleeper.plan = sleeper.mind.choose_next_plan()
    sleeper.run_plan(model, rng)


def work(sleeper):
    sleeper.worked += 1


def set_clock(sleeper):
    sleeper.wakes = 4 - sleeper.id


class Dormitory(Model):
    sleepers = Population(Sleeper, 4, mind=ASLEEP, plans={"work": work})
    setup = (each(sleepers, set_clock),)
    schedule = (each(sleepers, live, shuffled=False),)


@pytest.mark.parametrize("compiled", [True, False])
def test_agents_without_a_plan_idle_and_are_counted(compiled):
    dormitory = Dormitory(compiled=compiled)
    assert dormitory.idle.count == 0
    assert dormitory.idle.first_agent is None
    dormitory.sleepers[0].wakes = 0
    with pytest.warns(IdleWarning, match=r"agent 1 of dormitory .* in tick 0 .*explain\(1, 1\)"):
        dormitory.advance(1)
    # Agents 1 … 3 sleep in tick 0: the first to be counted is agent 1.
    idle = dormitory.idle
    assert (idle.count, idle.first_agent, idle.first_tick) == (3, 1, 0)
    assert dormitory.plans(dormitory.sleepers) == ["work", None, None, None]
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # one warning is enough
        dormitory.advance(9)
    # They wake at ticks 3, 2 and 1.
    idle = dormitory.idle
    assert (idle.count, idle.first_agent, idle.first_tick) == (6, 1, 0)
    assert dormitory.sleepers.worked.tolist() == [10, 7, 8, 9]
    other = dormitory.fresh()
    other.restore(dormitory.state())
    assert other.idle == idle


def test_the_first_idle_decision_may_come_late():
    class Insomnia(Dormitory):
        """A dormitory whose sleepers begin awake."""

    society = Insomnia(compiled=False)
    for sleeper in society.sleepers:
        sleeper.wakes = 0
    society.advance(5)
    assert society.idle.count == 0
    society.sleepers[2].wakes = 99
    society.sleepers[2].mind.deactivate_cogniton("Awake")
    with pytest.warns(IdleWarning, match="agent 2"):
        society.advance(2)
    idle = society.idle
    assert (idle.count, idle.first_agent, idle.first_tick) == (2, 2, 5)


# Failing rules -----------------------------------------------------------------------------------


class Cow(Agent):
    energy: float = 5.0


def line_of(text):
    """Return the first line of this file that contains a text, counted from 1."""
    lines = Path(__file__).read_text("utf-8").splitlines()
    return next(n for n, line in enumerate(lines, 1) if line.strip().startswith(text))


def divide(cow, model):
    if model.tick == 37 and cow.id == 2:
        cow.energy = 1 / (cow.energy - cow.energy)


class Failing(Model):
    cows = Population(Cow, 4)
    schedule = (each(cows, divide),)


def overflow(model):
    if model.tick == 3:
        model.count = 40_000


class Counting(Model):
    count: np.int16 = 0
    schedule = (once(overflow),)


@pytest.mark.parametrize(
    ("model", "line", "tick", "who", "what"),
    [
        (Failing, "cow.energy = 1 / (", 37, "agent 2 of 'cows'", "ZeroDivisionError: "),
        (Counting, "model.count = 40_000", 3, "the model's rule 'overflow'", "OverflowError: "),
    ],
)
def test_a_failing_rule_is_said_alike_at_both_speeds(model, line, tick, who, what):
    errors = []
    for compiled in (True, False):
        society = model(5, compiled)
        with pytest.raises(RuleError) as error:
            society.advance(100)
        assert society.tick == tick
        errors.append(error.value)
    one, other = errors
    assert str(one) == str(other)
    assert one.place == f"{__file__}:{line_of(line)}"
    assert (one.tick, one.agent) == (tick, who)
    assert one.error.startswith(what)
    assert str(one) == f"{one.place}: {one.error}; in tick {tick}, {who}"


# explain -----------------------------------------------------------------------------------------


def test_explain_wants_a_mind_an_agent_and_a_decision():
    with pytest.raises(SocialmindError, match="the agents of failing have no minds"):
        Failing(compiled=False).explain(0, 1)
    dormitory = Dormitory(compiled=False)
    with pytest.raises(SocialmindError, match="no agent 9 lives at tick 2; the living are 0 … 3"):
        dormitory.explain(9, 2)
    with pytest.raises(SocialmindError, match="agent 1 has taken no decision up to tick 0"):
        dormitory.explain(1, 0)
    receipt = dormitory.explain(1, 2)
    assert receipt.choice is None
    assert dormitory.explain(1, 5).choice == "work"
    assert dormitory.tick == 0
