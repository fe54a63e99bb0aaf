"""The economy that is like bodies, its lessons, and choosing in bodies among what they come to."""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning.lessons.keys import seeds_for
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging_roles"
minds = load_file(FOLDER / "minds.py")
PACKAGE = minds.__name__
choosing, again, like_bodies = (
    sys.modules[f"{PACKAGE}.{name}"]
    for name in ("choosing", "choosing_again", "economy_like_bodies")
)
later = load_file(FOLDER / "further_worlds.py")
trips_in_bodies = load_file(FOLDER / "trips_in_bodies.py")
worlds = load_file(FOLDER / "worlds.py")
TICKS = 12_000
NINE = {"numbers": (9,), "ratios": (2 / 3,), "events": (0,)}


@pytest.fixture(scope="module")
def mind():
    return minds.minds_of("delivered_anew")[1]


def economy(mind, ticks=TICKS, **terms):
    return like_bodies.DeliveryEconomy({**NINE, **terms}, mind, "Forage", "ForageRole", ticks=ticks)


# Worlds like bodies' ------------------------------------------------------------------------------


def test_a_seed_draws_the_same_society_as_in_the_models_economy():
    terms = like_bodies.Terms()
    for seed in (1, 2, 2**62):
        one = like_bodies.World(seed, terms, TICKS)
        other = like_bodies.DELIVERIES.DeliveryWorld(seed, terms, TICKS)
        for name in ("robots", "most", "wanted", "event", "removed"):
            assert getattr(one, name) == getattr(other, name)
        assert (one.begun == other.begun).all()
        assert one.trips.shape == other.trips.shape
        assert one.away.shape == other.away.shape


def test_trips_and_readings_are_near_what_bodies_do():
    table = pd.read_csv(trips_in_bodies.OUT).set_index("what")["value"]
    for share, took in list(zip(like_bodies.SHARES, like_bodies.TRIPS, strict=True))[1:-1]:
        assert took == pytest.approx(table[f"trip, share {share:g}"], rel=0.05)
    drawn = [like_bodies.World(seed, like_bodies.Terms(), 40_000) for seed in range(60)]
    readings = np.concatenate([one.away.ravel() for one in drawn])
    assert readings.mean() == pytest.approx(table["reading, mean"], abs=0.03)
    for share in (0.05, 0.5, 0.95):
        known = table[f"reading, share {share:g}"]
        assert np.quantile(readings, share) == pytest.approx(known, abs=0.04)


def test_robots_that_set_out_together_read_alike():
    together, apart = [], []
    for seed in range(40):
        one = like_bodies.World(seed, like_bodies.Terms(**NINE), TICKS)
        read = one.away[0] - one.away[0].mean()
        first = read[:9, 0]  # all set out at tick 0
        together += [(first[0], first[1]), (first[2], first[3])]
        apart += [(read[0, 0], read[1, 8]), (read[2, 0], read[3, 8])]
    alike, unlike = (np.corrcoef(np.array(pairs).T)[0, 1] for pairs in (together, apart))
    assert alike > 0.25
    assert alike > unlike + 0.15


def test_what_changes_and_does_not_settle_costs_what_the_terms_say(mind):
    genome, seeds = mind.skill("ForageRole").genome[None], [5, 6, 7]
    free = economy(mind).run(genome, seeds)
    turns = economy(mind, turns=1.0).run(genome, seeds)
    unsettled = economy(mind, unsettled=1.0).run(genome, seeds)
    assert (turns.fields["within"] == free.fields["within"]).all()
    changes = (free.score - turns.score) * 9
    assert changes == pytest.approx(changes.round())  # whole changes of nine robots
    assert changes.max() >= 1
    assert free.score - unsettled.score == pytest.approx(1.0 - free.fields["within"])


def test_an_individual_comes_to_the_same_alone_as_among_others(mind):
    genome = mind.skill("ForageRole").genome
    several = np.stack([genome, genome + 0.3, genome - 0.3])
    among = economy(mind).run(several, [3, 4])
    alone = economy(mind).run(genome[None], [3, 4])
    assert among.score[0].tolist() == alone.score[0].tolist()


def test_errands_are_a_pair_for_two_trips_at_best(mind):
    errands = like_bodies.Errands({}, mind, "Forage", "CollectSelect")
    learned = mind.skill("CollectSelect").genome
    found = errands.run(np.stack([learned, 0 * learned]), [1, 2])
    assert (found.score <= 1).all()
    assert found.score[0].mean() > found.score[1].mean()


# Choosing -----------------------------------------------------------------------------------------


def test_each_attempts_mind_is_the_one_that_the_table_chooses():
    table = choosing.read()
    found, choice = minds.minds_of("chosen_in_bodies"), choosing.chosen(table)
    assert sorted(found) == list(range(1, choosing.ATTEMPTS + 1))
    assert len(set(choice.values())) == len(found)
    trainings = choosing.Training(choosing.PLANS.kept / choosing.TRAINED)
    for attempt, one in choice.items():
        assert choosing.candidates(trainings, one[0])[one] == found[attempt]
    judged = set(table[choosing.KEYS].itertuples(index=False, name=None))
    known = {one for number in trainings.finished for one in choosing.candidates(trainings, number)}
    assert judged <= known
    assert set(table["training"]) == set(trainings.finished)


def judged(**shares):
    rows = [
        {"training": int(name[1:]), "lesson": 3, "what": "winner", "undisturbed": 1.0,
         "turned": share, "removed": 1.0}
        for name, share in shares.items()
    ]  # fmt: skip
    return pd.DataFrame(rows)


def test_who_falls_shortest_begins_anew():
    table = judged(t1=0.5, t2=1.0, t3=0.7, t4=0.6, t5=0.8, t6=0.9, t7=1.0)
    found = choosing.chosen(table, attempts=3, enough=0.9)
    # 4 and 5 go to attempt 1, then 6 to 3, then 7 to 1.
    assert {attempt: one[0] for attempt, one in found.items()} == {1: 7, 2: 2, 3: 6}
    found = choosing.chosen(table, attempts=3, enough=0.5)
    assert {attempt: one[0] for attempt, one in found.items()} == {1: 1, 2: 2, 3: 3}


def test_it_is_chosen_in_worlds_for_choosing_and_each_choice_is_reported_in_worlds_of_its_own():
    first, second = set(choosing.CHOOSING[: choosing.WORLDS]), set(again.SECOND)
    assert len(second) == len(first) == choosing.WORLDS
    assert not first & second
    assert first | second <= set(worlds.CHOOSING)
    page = range(6001, 6051)  # those of analysis/specialisation, and of what is judged elsewhere
    sets = (worlds.CHOOSING, page, choosing.FURTHER, again.FURTHER)
    assert len(set().union(*sets)) == sum(map(len, sets))
    assert set(page) | set(choosing.FURTHER) | set(again.FURTHER) <= set(worlds.REPORTED)
    # Worlds of trainings are hashes of 63 bits.
    key = ("world", worlds.TRAINING, 1)
    assert min(seeds_for(1000, *key)) > max(worlds.REPORTED)


@pytest.mark.parametrize("choice", [choosing, again])
def test_what_is_reported_is_of_all_attempts(choice):
    table = pd.read_csv(choice.REPORT)
    assert table["attempt"].tolist() == list(range(1, choosing.ATTEMPTS + 1))
    shares = table[list(choosing.CONDITIONS)].to_numpy() * len(choice.FURTHER)
    assert shares == pytest.approx(shares.round())


def test_the_second_choice_is_among_the_best_of_the_first():
    table = again.read().set_index(choosing.KEYS)
    chosen, asked = again.chosen().set_index("attempt"), set()
    for attempt, own in choosing.trainings_of(choosing.read()).items():
        first = again.first_of(own)
        best = again.finalists(first)
        assert best[0] == choosing.chosen(choosing.read())[attempt]
        asked |= set(best)
        if len(best) == 1:
            continue  # nothing is to be chosen
        # Whoever was judged no further had fallen behind the one that was chosen.
        least = (chosen.loc[attempt, again.NAMES] * chosen.loc[attempt, "worlds"]).min()
        for one in best:
            total = first.loc[one] + table.loc[one, again.NAMES]
            assert total.notna().all() or total.min() < least - 1e-6
    assert set(table.index) <= asked
    assert sorted(minds.minds_of("chosen_again")) == list(range(1, choosing.ATTEMPTS + 1))


def test_a_mind_is_judged_no_further_once_it_has_fallen_behind(monkeypatch):
    asked = []

    def settles(_, parameters, seeds):
        asked.append(parameters)
        return 30 / len(seeds)

    monkeypatch.setattr(again.choosing, "settles", settles)
    unknown = dict.fromkeys(choosing.CONDITIONS, np.nan)
    assert list(again.settled(None, unknown).values()) == [30, 30, 30]
    found = again.settled(None, {"removed": 30, "turned": 31, "undisturbed": 0})
    assert list(found.values()) == pytest.approx([30, 30, np.nan], nan_ok=True)
    assert len(asked) == 3 + 2


def test_both_choices_stand_beside_each_other():
    table = again.both()
    assert table.groupby("choice")["attempt"].apply(list).to_dict() == {
        "first": list(range(1, 11)),
        "again": list(range(1, 11)),
    }
    assert table[again.NAMES].min().min() >= choosing.TOO_FEW


def test_who_cannot_be_chosen_any_more_is_judged_no_further():
    table = choosing.read()
    asked = table[list(choosing.CONDITIONS)].to_numpy()
    judged_on = ~np.isnan(asked)
    assert judged_on[:, 0].all()
    # What comes after a share that is too low is not there, and nothing else is missing.
    low = np.cumsum(asked < choosing.TOO_FEW, axis=1) > 0
    assert (judged_on[:, 1:] == ~low[:, :-1]).all()


@pytest.mark.study
def test_a_kept_mind_settles_in_as_many_worlds_as_when_it_was_chosen():
    trainings = choosing.Training(choosing.PLANS.kept / choosing.TRAINED)
    mind = choosing.candidates(trainings, 2)[2, 3, "winner"]
    kept = choosing.read().set_index(choosing.KEYS).loc[(2, 3, "winner")]
    for name in ("turned", "undisturbed"):
        share = choosing.settles(mind, choosing.CONDITIONS[name])
        assert share == pytest.approx(kept[name], abs=1e-6)


def test_without_a_choice_there_is_no_mind(tmp_path):
    assert choosing.minds(tmp_path / "none.csv") == {}
    assert again.minds(tmp_path / "none.csv") == {}
    assert minds.command_for("chosen_in_bodies").endswith("foraging_roles.choosing")
    assert minds.command_for("chosen_again").endswith("foraging_roles.choosing_again")
    assert minds.command_for("counts").endswith("trainings counts")


def test_trips_are_measured_from_delivery_to_delivery():
    found = trips_in_bodies.trips(3001, 3000)
    later = found[~found["first"]]
    assert len(later) > 0
    for _, own in found.groupby("robot"):
        assert (own["took"].cumsum() == own["tick"]).all()
    assert found[["a", "b"]].to_numpy().min() > 0.25
    assert set(found["kind"]) <= {"A", "B"}


# Further worlds -----------------------------------------------------------------------------------


def test_what_was_chosen_comes_to_in_further_worlds_what_was_reported_of_it():
    own = later.read().xs("chosen_again", level="way")
    reported = pd.read_csv(again.REPORT).set_index("attempt")
    assert list(own) == [str(seed) for seed in again.FURTHER]
    for condition in later.CONDITIONS:
        shares = own.xs(condition, level="condition").mean(axis=1)
        assert shares.tolist() == pytest.approx(reported[condition].tolist())


def test_ways_are_compared_in_the_same_worlds_and_only_whole_ones(tmp_path, monkeypatch):
    attempts = {"delivered_anew": (1, 2), "chosen_again": (1, 2)}
    monkeypatch.setattr(later, "attempts_at", lambda way: list(attempts.get(way, ())))
    rows = [
        [way, attempt, condition, *([0, 1] if way == "delivered_anew" else [1, 1])]
        for way, several in attempts.items()
        for attempt in several
        for condition in later.CONDITIONS
    ]
    path = tmp_path / "worlds.csv"
    table = pd.DataFrame(rows, columns=[*later.KEYS, "1", "2"])
    table.to_csv(path, index=False)
    known = later.read(path)
    assert later.complete(known) == ["delivered_anew", "chosen_again"]
    means = later.means(known).set_index(["way", "condition"])
    assert means.loc[("delivered_anew", "turned"), "mean"] == 0.5
    assert means.loc[("chosen_again", "turned"), "least"] == 1.0
    (away,) = {round(one, 9) for one in later.differences(known)["mean"]}
    assert away == 0.5
    table.iloc[:-1].to_csv(path, index=False)
    assert later.complete(later.read(path)) == ["delivered_anew"]
    assert later.differences(later.read(path)).empty


def test_a_way_that_there_is_not_is_refused(tmp_path):
    with pytest.raises(SocialmindError, match="no way called 'delivered'; did you mean 'delivered"):
        later.run(["delivered"], tmp_path / "worlds.csv")
