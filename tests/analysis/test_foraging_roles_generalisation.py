"""Large groups, partners never met and three kinds: societies are made right, and nothing twice."""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from coglogo_py import CognitiveScheme
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging_roles"
groups = load_file(FOLDER / "large_groups.py")
zones = load_file(FOLDER / "dead_zones.py")
study = load_file(FOLDER / "generalisation.py")
drawing = load_file(FOLDER / "generalisation_figure.py")
kinds = load_file(FOLDER / "three_kinds.py")
schemes = load_file(FOLDER / "scheme_distillation.py")
in_bodies = load_file(FOLDER / "three_kinds_in_bodies.py")
bodies = sys.modules[f"{in_bodies.__name__}.foraging_three"]


# Large groups -------------------------------------------------------------------------------------


def test_a_payoff_told_four_times_as_sharply_is_a_quarter_of_a_tolerance():
    one = groups.Contestant("programmed", 0, None, {"programmed": 1.0})
    worlds, _ = groups.worlds_of(one, groups.NINE, [1, 2], 8000)
    groups.sharpen(worlds, 4.0)
    worlds.decided(np.array([0, 1]), np.array([0, 0]), np.zeros(2), np.array([0.48, 0.5]), None)
    assert worlds.calling[0, 0] == pytest.approx(0.8 * 25 + 0.2 * 42)
    assert worlds.calling[1, 0] == pytest.approx(0.8 * 25 + 0.2 * 50)


def test_what_is_seen_agrees_with_what_worlds_count_themselves():
    one = groups.Contestant("programmed", 0, None, {"programmed": 1.0})
    found = groups.judged(one, 9, 12_000, 1.0, False, range(6))
    assert (found["within_one"] == found["within_ninth"]).all()  # a ninth of nine is one
    assert ((found["off"] <= 1) | (found["within_one"] == 0)).all()
    many = groups.judged(one, 36, 12_000, 1.0, False, range(6))
    assert (many["within_one"] <= many["within_ninth"]).all()


def test_uneven_trips_move_payoffs_at_rest_as_far_in_groups_of_any_size():
    nine, many = (zones.payoffs_at_rest(n, False, range(8), 30_000) for n in (9, 36))
    even = zones.payoffs_at_rest(36, True, range(8), 30_000)
    assert nine[0] > 1.5 * many[0] > 0  # what chance does within a world becomes less
    assert many[1] > 0.75 * nine[1]  # what is between worlds does not
    assert even[1] < many[1] / 3


def test_a_mind_that_keeps_its_role_has_no_end_to_its_dead_zone():
    mind = zones.MindDescription.load(zones.MODEL / "mind")
    stay = np.zeros(39)
    stay[21] = 1.0
    still = mind.with_modules(skills=[mind.skill("ForageRole").changed(genome=stay)])
    assert np.isnan(zones.dead_zone(still, True, 10))
    assert 0 < zones.dead_zone(mind, True, 75) <= zones.dead_zone(mind, True, 5)


def test_what_was_judged_is_not_judged_again(tmp_path, monkeypatch):
    one = groups.Contestant("programmed", 0, None, {"programmed": 1.0})
    path = tmp_path / "table.csv"
    first = groups.judge_all(path, [one], [(6, 4000, 1.0, False)], 2)
    monkeypatch.setattr(groups, "judged", None)  # it would fail
    assert len(groups.judge_all(path, [one], [(6, 4000, 1.0, False)], 2)) == len(first) == 2
    assert "| programmed | 1 | 6 | 4000 | 1 | False |" in groups.report(first)


def test_what_was_judged_in_other_worlds_is_judged_anew(tmp_path):
    one = groups.Contestant("programmed", 0, None, {"programmed": 1.0})
    path, setting = tmp_path / "table.csv", (6, 4000, 1.0, False)
    first = groups.judge_all(path, [one], [setting], 2)
    first.assign(world=[0, 1]).to_csv(path, index=False)
    again = groups.judge_all(path, [one], [setting], 2)
    assert again["world"].tolist() == list(groups.SCHEME_ECONOMY[:2])


def test_differences_are_of_the_same_attempts_in_the_same_worlds():
    rows = [
        {"way": way, "attempt": 0, "robots": robots, "ticks": ticks, "gain": gain, "even": even,
         "world": world, "within_one": int(even or world > 0), "within_ninth": 1,
         "off": 0.5, "by_counts": 0.25, "changes": 0.1 if way == groups.HALF else 0.0}
        for way in ("programmed", groups.HALF)
        for robots, ticks, gain, even in groups.SETTINGS
        for world in range(4)
    ]  # fmt: skip
    text = groups.beside(pd.DataFrame(rows))
    assert "| programmed | four times as long | +0.00 | +0.00 |" in text
    assert "| programmed | even trips | +0.25 (" in text
    assert "| programmed | +0.25 |" in text  # heads beside counts
    assert "| 9 | +0.00 | +0.00 | +0.00 | +0.10 |" in text


# Partners and situations --------------------------------------------------------------------------


def test_pairs_are_of_the_minds_that_are_kept_and_each_society_is_there_once():
    keys = [one.key for one in study.societies()]
    assert len(set(keys)) == len(keys)
    pairs = [one for one in study.societies() if one.partner is not None]
    drawn = list(study.drawn_pairs())
    assert len(drawn) == study.DRAWN * len(study.BY_LOT)
    for way, other in study.BY_LOT:
        own = [pair[1] for pair in drawn if (pair[0], pair[2]) == (way, other)]
        assert len(set(own)) == study.DRAWN  # nobody is drawn twice for a kind of pair
    assert len(pairs) == (len(study.PAIRS) + len(drawn)) * len(study.SHARES) * len(study.MET)


def test_focal_robots_are_as_many_as_asked_for():
    by = {one.key[:5]: one for one in study.societies() if one.partner is not None}
    programmed = by["the model's mind", 1, "programmed", 0, 3]
    parameters, mind = study.parameters_of(programmed)
    assert parameters["programmed"] == pytest.approx(6 / 9) and mind is None
    seen = {"robots.programmed": [1] * 6 + [0] * 3, "robots.stranger": [0] * 9}
    assert study.focal_robots(programmed, seen).tolist() == [False] * 6 + [True] * 3
    learned = by["supervised_role", 1, "supervised_role", 3, 6]
    parameters, mind = study.parameters_of(learned)
    assert parameters["strangers"] == pytest.approx(6 / 9)
    focal, other = learned.focal.mind, learned.partner.mind
    assert mind.skill("ForageRole2").genome.tolist() == focal.skill("ForageRole").genome.tolist()
    assert mind.skill("ForageRole").genome.tolist() == other.skill("ForageRole").genome.tolist()
    thresholds = by["programmed", 0, "fixed_thresholds", 0, 3]
    parameters, _ = study.parameters_of(thresholds)
    assert parameters["programmed"] == pytest.approx(3 / 9) and "lowest_threshold" in parameters


def test_told_more_sharply_schemes_and_thresholds_are_scaled():
    ways = {one.way: one for one in study.chosen()}
    assert study.deciding(ways["programmed"], 4.0)[0]["tolerance"] == 1.25
    given = zones.CONTROLLERS["fixed_thresholds"]["lowest_threshold"]
    assert study.deciding(ways["fixed_thresholds"], 4.0)[0]["lowest_threshold"] == given / 4


def test_words_of_the_command_choose():
    one = next(study.societies())
    alone = next(one for one in study.societies() if one.partner is None)
    ways = {one.focal.way for one in study.societies()}
    assert study.asked_for(one, set(), ways) and study.asked_for(alone, set(), ways)
    assert study.asked_for(one, {"pairs"}, ways) and not study.asked_for(alone, {"pairs"}, ways)
    assert not study.asked_for(alone, {"wanted 1:3"}, ways)
    assert not study.asked_for(one, {alone.situation}, ways)
    with pytest.raises(SystemExit, match="no way or situation 'wnted 1:3'"):
        study.main(["wnted 1:3"])


def test_a_situation_is_compared_with_the_usual_one_world_by_world():
    within = {study.USUAL: [1, 1, 0, 1], "wanted 1:3": [1, 0, 0, 0]}
    rows = [
        {"way": way, "attempt": attempt, "situation": situation, "world": world, "within_one": one}
        for way, attempts in (("several", (1, 2)), ("single", (0,)))
        for attempt in attempts
        for situation, several in within.items()
        for world, one in enumerate(several)
        if way == "several" or world < 3
    ]
    found = study.differences(pd.DataFrame(rows))
    more, interval = found["wanted 1:3", "several"]
    assert more.to_numpy().tolist() == [[0, -1, 0, -1]] * 2
    assert interval.mean == -0.5 and interval.low < -0.5 < interval.high
    assert found["wanted 1:3", "single"][0].shape == (1, 3)
    assert ("wanted 1:1", "several") not in found


def test_ways_are_held_against_each_other_where_all_attempts_were_judged():
    came_to = {
        (study.AGAIN, 1): [1, 0, 0, 0, 1],
        (study.AGAIN, 2): [1, 1, 0, 0],  # not judged in the last world
        (study.EVOLVED, 1): [1, 1, 1, 1, 0],
        (study.EVOLVED, 2): [1, 1, 0, 1, 0],
        ("reinforced_thresholds", 0): [1, 1, 0, 0, 1],
        ("delivered_anew", 1): [1],
        ("delivered_anew", 2): [],
    }
    rows = [
        {
            "way": way,
            "attempt": attempt,
            "situation": "wanted 1:3",
            "world": world,
            "within_one": one,
        }
        for (way, attempt), several in came_to.items()
        for world, one in enumerate(several)
    ]
    found = study.between_ways(pd.DataFrame(rows))
    assert found["wanted 1:3", study.AGAIN, study.EVOLVED].mean == 3 / 8 - 7 / 8
    assert found["wanted 1:3", study.AGAIN, "reinforced_thresholds"].mean == 3 / 8 - 2 / 4
    assert {situation for situation, *_ in found} == {"wanted 1:3"}


def test_the_figure_names_lessons_as_the_page_does(tmp_path):
    page = drawing.SOCIETIES
    assert drawing.BY_WAY["delivered_anew"].label == page["delivered"].title
    labels = {one: drawing.BY_WAY[one].label for one in ("delivered_role", "delivered_narrow")}
    assert page["delivered"].title not in labels.values()
    assert drawing.BY_WAY["fixed_thresholds"].colour == page["fixed_thresholds"].colour
    assert set(drawing.PARTNERED.values()) < set(study.PAIRS)
    drawn = drawing.draw(tmp_path)
    assert [one.suffix for one in drawn] == [".pdf", ".png", ".csv"]


# Three kinds --------------------------------------------------------------------------------------


def test_two_kinds_are_the_economy_of_two_kinds():
    found = kinds.judged("programmed", "1:2", 9, kinds.NOTHING, range(16))
    assert found["within_one"].mean() >= 0.75
    nothing = kinds.PAYOFF.worth(kinds.PAYOFF.scarcity_of_a(30.0, 10.0, 2 / 3))
    share, wanted = 10 / 40, 1 / 3
    assert kinds.PAYOFF.worth((wanted - share) / (wanted * (1 - wanted))) == pytest.approx(nothing)


@pytest.mark.parametrize("way", list(kinds.WAYS))
def test_three_kinds_are_fetched_by_all_ways(way):
    found = kinds.judged(way, "2:3:4", 9, kinds.TURNED, [1, 2], ticks=8000)
    assert len(found) == 2 and (found["off"] >= 0).all()
    assert set(found["within_one"]) <= {0, 1}


def test_the_distance_of_three_kinds_is_who_would_have_to_change():
    terms = kinds.ECONOMY.Terms(**{**kinds.NINE, "numbers": (9,)})
    drawn = [kinds.ECONOMY.World(1, terms, 4000)]
    worlds = kinds.Kinds(drawn, [1], 4000, kinds.shares_of("1:1:1"), kinds.WAYS["greedy"])
    worlds.fetches[0, :9] = [0] * 5 + [1] * 3 + [2]
    assert worlds._off().tolist() == [2.0]


def test_reports_tell_worlds_that_are_all_alike_with_an_interval():
    table = pd.DataFrame({"attempt": 0, "world": range(10), "within_one": 1, "way": "x"})
    assert groups.in_brackets(table, "within_one", ".0%") == "100% (72% to 100%)"
    assert groups.in_brackets(table[:1].assign(off=0.25), "off", ".2f") == "0.25"


def test_three_kinds_are_collected_by_the_skills_of_two():
    two = zones.MindDescription.load(zones.MODEL / "mind")
    three = bodies.mind()
    for name in ("CollectA", "GoToB+Avoid", "Avoid"):
        assert three.skill(name).genome.tolist() == two.skill(name).genome.tolist()
    assert three.skill("CollectC").genome.tolist() == two.skill("CollectA").genome.tolist()
    assert [one.name for one in three.skill("GoToC").inputs] == ["RADOBJC"]
    assert [bodies.collect_select(0.5 * kind).index(1.0) for kind in range(3)] == [0, 1, 2]


def test_the_scheme_of_three_kinds_has_the_numbers_of_two():
    two, three = (
        {one.name: one for one in CognitiveScheme.load(file).cognitons}
        for file in (zones.MODEL / "scheme.yaml", FOLDER / "three_kinds.yaml")
    )
    for name in ("CallingA", "CallingB", "PlentyOfA", "PlentyOfB"):
        one, other = two[name], three[name]
        assert one.influence.items() <= other.influence.items()
        assert one.reinforcement == other.reinforcement
    plenty = {f"Collect{one}": 1.0 for one in "AB"}
    assert dict(three["PlentyOfC"].influence) == plenty


@pytest.mark.study
def test_three_kinds_are_fetched_in_bodies():
    found = in_bodies.judged("programmed", "2:3:4", in_bodies.TURNED, [6001], ticks=3000)
    assert found["brought"].item() > 2
    assert found["rescues"].item() == 0
    assert 0 <= found["off"].item() <= 6


# What is kept -------------------------------------------------------------------------------------


def large_groups_report():
    table = groups.read(groups.RESULTS / "large_groups.csv")
    kept_zones = pd.read_csv(groups.RESULTS / "dead_zones.csv")
    return (
        f"{groups.report(table)}\n{groups.beside(table)}\n{zones.by_dead_zone(table, kept_zones)}"
    )


REPORTS = {
    "large_groups": large_groups_report,
    "generalisation": lambda: study.report(study.read(study.RESULTS / "generalisation.csv")),
    "schemes": lambda: schemes.report(schemes.read(schemes.RESULTS / "schemes.csv")),
    "three_kinds": lambda: kinds.report(pd.read_csv(kinds.RESULTS / "three_kinds.csv")),
    "three_kinds_in_bodies": lambda: in_bodies.report(
        in_bodies.read(in_bodies.RESULTS / "three_kinds_in_bodies.csv")
    ),
}


@pytest.mark.parametrize("name", REPORTS)
def test_a_kept_report_is_that_of_its_kept_table(name):
    assert (groups.RESULTS / f"{name}.md").read_text(encoding="utf-8") == REPORTS[name]()
