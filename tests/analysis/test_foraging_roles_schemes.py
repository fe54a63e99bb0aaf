"""The scheme as numbers: by the engine's rules; evolved, and distilled from learned roles."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from coglogo_py import CognitiveScheme
from coglogo_py.decision import BiasedWeightedStochastic
from coglogo_py.society import Society
from socialmind.mind import Skill
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging_roles"
economy = load_file(FOLDER / "scheme_economy.py")
evolution = load_file(FOLDER / "scheme_evolution.py")
distillation = load_file(FOLDER / "scheme_distillation.py")
scanning = load_file(FOLDER / "scheme_scan.py")
judging = load_file(FOLDER / "economy_worlds.py")
WRITTEN = np.array(list(economy.WRITTEN.values()))


def test_the_numbers_that_somebody_wrote_are_the_models_scheme():
    scheme = CognitiveScheme.load(economy.MODEL / "scheme.yaml")
    made = economy.scheme_of(WRITTEN)
    assert made.cognitons == scheme.cognitons
    other = economy.scheme_of([1, 2, 3, 4, 5, 6, 7, 8])
    assert [one.influence for one in other.cognitons] == [
        {"CollectA": 1.0}, {"CollectB": 2.0}, {"CollectB": 3.0}, {"CollectA": 4.0}
    ]  # fmt: skip
    assert other.cognitons[1].reinforcement == {"CollectB": 6.0}
    assert other.decision_maker == BiasedWeightedStochastic(8.0)


def test_callings_are_reinforced_as_by_the_engine():
    trader = scanning.Trader(Society(economy.scheme_of(WRITTEN), 1).new_mind(), is_b=True)
    scanning.DECIDING.begin_plan(trader)
    calling = np.array([scanning.DECIDING.FIRST_CALLING])
    for payoff in (0.5, 0.46, 0.9, 0.2, 1.0):
        trader.payoff = payoff
        scanning.DECIDING.reinforce(trader, "CollectB", "CallingB")
        calling = economy.reinforced(calling, payoff, 0.2)
        assert calling[0] == pytest.approx(trader.mind.get_cogniton_value("CallingB"), abs=1e-12)


def test_a_change_is_as_probable_as_by_the_decision_maker():
    rng = np.random.default_rng(1)
    weights = rng.uniform(0, 3, (200, 2)) * rng.choice([1, 50], (200, 1))
    weights[:20, 1] = weights[:20, 0]
    for row, bias, is_b in zip(
        weights, np.exp(rng.normal(size=200)), rng.random(200) < 0.5, strict=True
    ):
        own, other = (row[1], row[0]) if is_b else (row[0], row[1])
        exact = BiasedWeightedStochastic.probabilities(row, bias)[int(not is_b)]
        found = economy.chance(*map(np.array, ([own], [other], [is_b], [bias])))
        assert found[0] == pytest.approx(exact, abs=1e-12)


def test_written_numbers_do_as_the_engine_does_in_the_same_worlds():
    nine = scanning.IN_THE_ECONOMY["nine robots"]
    by_engine = scanning.tried(4.0, 5.0, nine, 24)
    found = economy.SchemeEconomy(nine).run(np.zeros((2, 8)), scanning.CHOOSING_ECONOMY[:24])
    assert np.array_equal(found.score[0], found.score[1])  # all individuals meet the same luck
    assert found.fields["within"][0].mean() == pytest.approx(by_engine["within_one"], abs=0.1)
    assert found.fields["changes"][0].mean() == pytest.approx(by_engine["changes"], abs=0.05)
    never = np.zeros(8)
    never[6] = 5.0  # the tolerance
    begun = economy.SchemeEconomy({**nine, "starts": (0,)}).run(never, [1, 2])
    assert not begun.fields["within"].any() and not begun.fields["changes"].any()


def select(ROLE, DISTOBJA, DISTOBJB):
    if ROLE < 0.5:
        return 1.0, 0.0
    return 0.0, 1.0


def test_roles_are_counted_by_deliveries_as_a_choice_that_is_learned_is():
    mind = judging.MindDescription.load(judging.MODEL / "mind")
    terms = judging.ECONOMY.Terms(events=(2,))  # robots are taken away
    seeds, deliveries = [1, 2, 3], judging.DELIVERIES
    thinking = judging.with_genome(deliveries.thinking(mind, judging.ROLE), mind, 3)
    inputs, outputs = ["ROLE", "DISTOBJA", "DISTOBJB"], ["A", "B"]
    choice = Skill(
        "Choice", [f"SE:{one}" for one in inputs], ["MO:A", "MO:B"], judging.Programmed(select)
    )
    chooser = judging.MindDescription("Chooser", inputs, outputs, (), [choice])
    heads = deliveries.Heads(thinking, judging.Minds(chooser, agents=3))
    chosen = deliveries.Deliveries(
        [deliveries.DeliveryWorld(one, terms, 20_000) for one in seeds], 1, 20_000, heads
    )
    drawn = [judging.ECONOMY.World(one, terms, 20_000) for one in seeds]
    held = judging.counted_by_deliveries(judging.ECONOMY.Worlds(drawn, 1, 20_000))
    plain = judging.ECONOMY.Worlds(drawn, 1, 20_000)
    for worlds, minds in ((chosen, heads), (held, thinking), (plain, thinking)):
        while worlds.go_on(minds):
            pass
    for name in ("off", "off_late", "out_late", "out_last", "changes"):
        assert getattr(chosen, name).tolist() == getattr(held, name).tolist()
    assert held.off.tolist() != plain.off.tolist()


def test_an_attempt_that_was_stopped_goes_on_to_the_same_numbers(tmp_path):
    small = evolution.LESSONS.lesson.changed(
        generations=3, repetitions=2, finals=4, finalists=3, ticks=None,
        settings={"population": 5, "step": 0.5},
    )  # fmt: skip
    whole = evolution.evolved(1, small, tmp_path / "whole")
    search = evolution.Search(1, small)
    search.advance()
    search.save(tmp_path / "stopped" / "attempt-1.npz")
    assert evolution.evolved(1, small, tmp_path / "stopped") == whole
    assert evolution.evolved(2, small, tmp_path / "whole")["score"] != whole["score"]
    assert evolution.kept(tmp_path / "none.csv") == {}


def decided_by(numbers, robots=60, deliveries=60):
    """Decisions of robots that follow a scheme, their payoffs drawn."""
    rng = np.random.default_rng(3)
    given = dict(zip(economy.WRITTEN, numbers, strict=True))
    payoff = rng.uniform(0.3, 0.6, (robots, deliveries))
    is_b, changed = np.zeros((2, robots, deliveries), bool)
    now, calling = rng.random(robots) < 0.5, np.full(robots, 25.0)
    for number in range(deliveries):
        is_b[:, number] = now
        calling = economy.reinforced(calling, payoff[:, number], given["reinforcement_a"])
        lack = 50 - 100 * payoff[:, number]
        weights = given["calling_a"] * calling, given["plenty_of_a"] * np.maximum(lack, 0)
        chance = economy.chance(*weights, now, np.asarray(given["bias"]))
        changed[:, number] = (lack > given["tolerance"]) & (rng.random(robots) < chance)
        calling = np.where(changed[:, number], 25.0, calling)
        now = now ^ changed[:, number]
    return distillation.Decisions(is_b, payoff, changed, np.ones((robots, deliveries), bool))


def test_a_scheme_that_is_distilled_from_a_schemes_decisions_tells_them_as_well():
    numbers = WRITTEN.copy()
    numbers[[0, 1]] = 1.0  # callings are weak: many changes
    seen = decided_by(numbers)
    found = distillation.distilled(seen, generations=40)
    true = distillation.likelihood(distillation.chances(numbers, seen), seen)
    assert distillation.likelihood(distillation.chances(found, seen), seen) > true - 0.01
    assert distillation.likelihood(distillation.chances(WRITTEN, seen), seen) < true - 0.02
    assert found[6] == pytest.approx(5.0, abs=2.0)  # the tolerance is found again


def test_what_a_learned_mind_decides_is_seen_and_how_well_it_is_told_apart():
    one = next(distillation.learned())
    seen = distillation.watched(one, [1, 2], 20_000)
    assert seen.known.sum() > 2 * 6 * 15
    assert (seen.changed <= seen.known).all()
    assert 0 < seen.changed.sum() < seen.known.sum() / 2
    assert distillation.told_apart(seen.changed.astype(float), seen) == 1.0
    assert distillation.told_apart(np.zeros(seen.changed.shape), seen) == 0.5


def test_all_schemes_and_minds_meet_the_same_worlds_and_are_reported():
    some = [
        distillation.judged(one, "nine robots", [1, 2]).assign(
            way=way, attempt=attempt, condition="nine robots"
        )
        for way, attempt, one in list(
            distillation.entrants(pd.DataFrame({"way": [], "attempt": []}))
        )[:2]
    ]
    text = distillation.report(pd.concat(some, ignore_index=True))
    assert text.count("\n") >= 3 and "| written | 1 |" in text


def test_schemes_are_judged_in_worlds_in_which_nothing_was_chosen(tmp_path, monkeypatch):
    path = tmp_path / "schemes.csv"
    monkeypatch.setattr(distillation, "entrants", lambda table: [("written", 0, WRITTEN)])
    monkeypatch.setattr(distillation, "CONDITIONS", {"nine robots": scanning.IN_THE_ECONOMY[
        "nine robots"]})  # fmt: skip
    distillation.judge_all(path, pd.DataFrame(), [0, 1])
    found = distillation.judge_all(path, pd.DataFrame(), [20_000, 20_001])
    assert found["world"].tolist() == [20_000, 20_001]


def test_a_distilled_scheme_is_held_beside_its_mind():
    rows = [
        {"way": way, "attempt": attempt, "condition": distillation.LESSON, "world": world,
         "within_one": within}
        for way, attempt, several in (
            ("made", 1, (1, 1)), ("made", 2, (1, 0)),
            (f"{distillation.DISTILLED} made", 1, (0, 1)),
        )
        for world, within in enumerate(several)
    ]  # fmt: skip
    assert distillation.beside_minds(pd.DataFrame(rows))[2].startswith("| made | 1 | -0.50 (")
    assert distillation.beside_minds(pd.DataFrame(rows))[2].endswith("| 1 |")
