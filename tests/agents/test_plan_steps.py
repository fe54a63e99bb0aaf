"""Plans that are trees: random ones against a plain account by coroutines, at both speeds."""

import random

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton
from coglogo_py.decision import WeightedStochastic
from socialmind import (
    Agent,
    Model,
    ModelError,
    Population,
    SocialmindError,
    each,
    repeat,
    sequence,
    until,
    when,
)
from socialmind.language.plans import Branch, PlanTree, Repeated, Until

PLANS = 40
TICKS = 60


class Worker(Agent):
    trace: int = 1
    ended: int = 0


def one(worker):
    worker.trace = (worker.trace * 31 + 7) % 1000003


def other(worker):
    worker.trace = (worker.trace * 17 + 3) % 1000003


def stay(worker):
    worker.trace = (worker.trace * 13 + 5) % 1000003
    return worker.trace % 3 == 0


def odd(worker):
    return worker.trace % 2 == 1


def rare(worker):
    return worker.trace % 5 == 0


def few(worker):
    return worker.trace % 4 - 1


def grown(draw, depth):
    """Return a random action or tree."""
    kind = draw.choice(["sequence", "repeat", "times", "until", "when", "if"] + ["act"] * 4)
    if kind == "act" or depth == 0:
        return draw.choice([one, other, stay])
    parts = [grown(draw, depth - 1) for _ in range(draw.randint(1, 3))]
    condition = draw.choice([odd, rare])
    if kind == "repeat":
        return repeat(draw.randint(0, 3), *parts)
    if kind == "times":
        return repeat(few, *parts)
    if kind == "until":
        return until(condition, *parts)
    if kind == "when":
        return when(condition, parts[0], parts[-1])
    return when(condition, parts[0]) if kind == "if" else sequence(*parts)


def drawn_plans():
    draw = random.Random(5)
    return {f"plan {place}": grown(draw, 4) for place in range(PLANS)}


def live(worker, model, rng):
    if worker.plan_ended:
        worker.plan = worker.mind.choose_next_plan()
        worker.ended += 1
    worker.run_plan(model, rng)


def begin(worker):
    worker.trace = worker.id + 1


NAMES = [f"plan {place}" for place in range(PLANS)]
SCHEME = CognitiveScheme(
    "workers",
    (Cogniton("Work", start_value=1.0, influence=dict.fromkeys(NAMES, 1.0), conditional=NAMES),),
    decision_maker=WeightedStochastic(),
)


class Works(Model):
    workers = Population(Worker, 60, mind=SCHEME, plans=drawn_plans())
    setup = (each(workers, begin),)
    schedule = (each(workers, live),)


def asked(part, done):
    """Yield the functions of a plan as they are asked; `done` counts the actions."""
    if not isinstance(part, PlanTree):
        while True:
            answer = yield part
            done[0] += 1
            if answer is None or answer:
                return
    elif isinstance(part, Until):
        while not (yield part.condition):
            before = done[0]
            for inner in part.parts:
                yield from asked(inner, done)
            if done[0] == before:
                yield "a tick for nothing"
    elif isinstance(part, Branch):
        if (yield part.condition):
            yield from asked(part.parts[0], done)
        elif len(part.parts) > 1:
            yield from asked(part.parts[1], done)
    else:
        times = 1
        if isinstance(part, Repeated):
            times = (yield part.times) if callable(part.times) else part.times
        for _ in range(times):
            for inner in part.parts:
                yield from asked(inner, done)


class Account:
    """A worker's plan in plain Python."""

    def __init__(self, plan):
        self.done = [0]
        self.plan = asked(plan, self.done)
        self.waiting = next(self.plan, None)

    def go_on(self, worker):
        acted = False
        while self.waiting is not None and not acted:
            idle = self.waiting == "a tick for nothing"
            before = self.done[0]
            answer = None if idle else self.waiting(worker)
            try:
                self.waiting = self.plan.send(answer)
            except StopIteration:
                self.waiting = None
            # An action that stays is asked again without having gone on.
            acted = idle or self.done[0] > before
            if not idle and self.waiting == "a tick for nothing":
                return


@pytest.fixture(scope="module")
def both():
    return Works(seed=3), Works(seed=3, compiled=False)


def same(fast, slow, name):
    """Say whether the living of a population are the same to the last bit at both speeds."""
    one_of, other_of = (getattr(model, name) for model in (fast, slow))
    return all(
        np.array_equal(
            one_of.columns[column][one_of.slots],
            other_of.columns[column][other_of.slots],
            equal_nan=one_of.dtype[column].kind == "f",
        )
        for column in one_of.dtype.names
    )


def test_random_plans_are_carried_out_as_a_plain_account_says(both):
    fast, slow = both
    accounts = {}
    plain = {worker.id: Worker() for worker in slow.workers}
    for identity, worker in plain.items():
        worker.trace = identity + 1
    for _ in range(TICKS):
        begun = slow.workers.ended.copy()
        slow.advance(1)
        fast.advance(1)
        for worker in slow.workers:
            if worker.ended > begun[worker.id]:
                accounts[worker.id] = Account(Works.workers.plans[worker.plan])
            accounts[worker.id].go_on(plain[worker.id])
            assert worker.trace == plain[worker.id].trace, worker.plan
            assert worker.plan_ended == (accounts[worker.id].waiting is None), worker.plan
    assert same(fast, slow, "workers")
    assert len({worker.plan for worker in slow.workers}) > 10
    assert min(slow.workers.ended) < max(slow.workers.ended)


def test_a_run_goes_on_in_the_middle_of_plans(both):
    fast, _ = both
    again = Works(seed=3)
    again.restore(fast.state())
    for model in (fast, again):
        model.advance(20)
    assert same(fast, again, "workers")


def test_a_step_that_the_plans_lack_is_no_state(both):
    state = both[0].state()
    state["workers.rows"]["_step"][0] = 10_000
    with pytest.raises(SocialmindError, match="steps that its plans lack"):
        both[0].restore(state)


# A farmer, by hand ------------------------------------------------------------------------------


class Farmer(Agent):
    way: int = 0
    log: int = 0
    begins: bool = False


def walk(farmer):
    farmer.way += 1
    farmer.log = farmer.log * 10 + 1


def is_there(farmer):
    return farmer.way >= 2


def sow(farmer):
    farmer.log = farmer.log * 10 + 2


def reap(farmer):
    farmer.log = farmer.log * 10 + 3
    return farmer.log % 100 == 33  # it takes two ticks


def flee(farmer):
    farmer.log = farmer.log * 10 + 9


def give_up(farmer):
    farmer.log = farmer.log * 10 + 8
    farmer.plan = None


def frighten(farmer, model):
    if model.tick == model.frightened and farmer.id == 0:
        farmer.mind.set_cogniton_value("Fear", model.fear)


def decide(farmer, model, rng):
    farmer.begins = farmer.reconsider_plan(model.factor)
    farmer.run_plan(model, rng)
    if farmer.plan == "flee":
        farmer.mind.set_cogniton_value("Fear", 0.0)
    if model.tick == model.hatched and farmer.id == 0:
        farmer.hatch()


FARM = sequence(until(is_there, walk), sow, reap)
MINDS = CognitiveScheme(
    "farmers",
    (
        Cogniton("Diligence", start_value=2.0, influence={"farm": 1.0}, conditional=("farm",)),
        Cogniton("Fear", influence={"flee": 1.0}, conditional=("flee",)),
        Cogniton("Gloom", influence={"quit": 1.0}, conditional=("quit",)),
    ),
)


class Farm(Model):
    frightened: int = 99
    hatched: int = 99
    fear: float = 4.5
    factor: float = 2.0
    farmers = Population(
        Farmer, 1, mind=MINDS, plans={"farm": FARM, "flee": flee, "quit": sequence(give_up, sow)}
    )
    schedule = (each(farmers, frighten), each(farmers, decide))


def logs(ticks, compiled=False, **variables):
    farm = Farm(compiled=compiled)
    for name, value in variables.items():
        setattr(farm, name, value)
    farm.advance(ticks)
    return farm


def test_a_plan_takes_a_tick_for_each_action():
    # Two steps of the way, sowing, two ticks of reaping; then it begins anew, already there.
    assert logs(5).farmers[0].log == 11233
    assert logs(5).farmers[0].plan_ended
    assert logs(7).farmers[0].log == 1123323
    assert not logs(7).farmers[0].plan_ended


def test_the_record_says_where_plans_go_on():
    assert logs(0).agents()["plan_step"] == [None]
    assert logs(1).agents()["plan_step"] == ["is_there"]
    assert logs(3).agents()["plan_step"] == ["reap"]
    assert logs(5).agents()["plan_step"] == [None]
    assert logs(5).agents()["plan"] == ["farm"]


@pytest.mark.parametrize(("fear", "log"), [(4.0, 1123), (4.1, 1192)])
def test_another_plan_takes_over_when_it_weighs_more_than_twice_as_much(fear, log):
    farm = logs(4, frightened=2, fear=fear)
    assert farm.farmers[0].log == log


def test_a_factor_below_1_is_refused():
    for compiled in (False, True):
        with pytest.raises(SocialmindError, match=r"test_plan_steps.py:\d+: .*a factor of 1 or"):
            logs(2, compiled, factor=0.5)


def test_an_action_may_give_up_its_plan():
    farm = logs(0)
    farm.farmers[0].mind.set_cogniton_value("Gloom", 9.0)
    farm.advance(1)
    assert farm.farmers[0].log == 8
    assert farm.farmers[0].plan is None
    assert farm.farmers[0].plan_ended


def test_a_child_has_no_plan_yet_and_begins_its_own():
    farm = logs(3, hatched=2)
    assert [farmer.plan for farmer in farm.farmers] == ["farm", None]
    farm.advance(1)
    assert [farmer.log for farmer in farm.farmers] == [1123, 1122]


def test_setting_a_plan_begins_it_anew_at_both_speeds():
    for compiled in (False, True):
        farm = logs(3, compiled, hatched=1)
        farm.farmers[0].plan = "farm"
        assert farm.farmers[0].plan_step == "is_there"
        farm.advance(2)
        assert farm.farmers[0].log == 11223


def test_farms_are_the_same_at_both_speeds():
    fast, slow = (logs(9, compiled, frightened=3, hatched=4) for compiled in (True, False))
    assert same(fast, slow, "farmers")
    assert len(fast.farmers) == 2


# What is refused --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "found"),
    [
        (lambda: sequence(), r"sequence\(…\) without parts"),
        (lambda: sequence(sow, None), r"None in sequence\(…\); expected an action"),
        (lambda: repeat(-1, sow), r"repeat\(-1, …\); expected a whole number, 0 or more"),
        (lambda: repeat(True, sow), r"repeat\(True, …\)"),
        (lambda: until(3, sow), r"3 as the condition of until\(…\)"),
        (lambda: when(is_there, 3), r"3 in when\(…\)"),
    ],
)
def test_a_wrong_tree_is_refused_where_it_is_written(make, found):
    with pytest.raises(ModelError, match=rf"test_plan_steps.py:\d+: found {found}"):
        make()


def test_a_plan_that_is_none_is_refused_with_its_line():
    farmers = Population(Farmer, 1, mind=MINDS, plans={"farm": [sow, reap]})
    with pytest.raises(ModelError, match=r"as the plan 'farm' of 'farmers'; expected a rule, or a"):
        type("Wrong", (Model,), {"farmers": farmers})


def counted(farmer):
    return 3


def wait_and_run(farmer, model, rng):
    farmer.run_plan(model, rng)


def ask(farmer):
    if farmer.plan_ended:
        farmer.plan = "farm"


@pytest.mark.parametrize(
    ("plans", "rule", "found"),
    [
        ({"farm": sequence(counted)}, decide, "the action 'counted', which returns a whole number"),
        ({"farm": until(counted, sow)}, decide, "the condition 'counted', which returns a whole"),
        ({"farm": when(sow, sow)}, decide, "the condition 'sow', which returns None"),
        ({"farm": repeat(is_there, sow)}, decide, "the number of rounds 'is_there', which returns"),
        ({"farm": sequence(sow, wait_and_run)}, decide, "the plan 'farm', in which an agent"),
        ({"farm": reap}, decide, "the rule 'reap', which returns a truth value"),
        ({"farm": sow}, ask, "plan_ended of an agent of 'farmers', whose plans are rules of one"),
    ],
)
def test_rules_that_do_not_fit_their_place_are_refused(plans, rule, found):
    farmers = Population(Farmer, 1, mind=MINDS, plans=plans)
    body = {"farmers": farmers, "factor": 2.0, "hatched": 99, "schedule": (each(farmers, rule),)}
    kind = type("Wrong", (Model,), body | {"__annotations__": {"factor": float, "hatched": int}})
    with pytest.raises(ModelError, match=rf"test_plan_steps.py:\d+: (found )?{found}"):
        kind(compiled=False)
