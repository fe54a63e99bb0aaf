"""The economy in which roles are learned, and the mind that was."""

from types import SimpleNamespace

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
ECONOMY = load_file(FOLDER / "economy.py")
LESSONS = load_file(FOLDER / "lessons.py")
SKILL = "ForageRole"
STAY, FLIP = np.zeros(39), np.zeros(39)
STAY[21] = 1.0  # the influence on the role as it is
FLIP[[16, 38]] = 1.0  # the influence on what the perceptron says, which is always B


@pytest.fixture(scope="module")
def mind():
    return MindDescription.load(FOLDER / "mind")


def economy(mind, **terms):
    return ECONOMY.Economy(terms, mind, master=SKILL, skill=SKILL)


CALM = {"numbers": (9,), "ratios": (2 / 3,), "events": (0,)}


def test_a_group_that_stays_as_it_is_costs_what_its_split_is_away(mind):
    outcome = economy(mind, **CALM, starts=(0,)).run([STAY], [1, 2])
    # All of nine in A, six wanted in B, all the time; late costs beyond half a robot, and for out.
    assert outcome.score == pytest.approx(-(6 / 9 + 3 * 5.5 / 9 + 0.3))
    assert not outcome.fields["within"].any()
    assert (outcome.fields["changes"] == 0).all()
    assert (outcome.ticks == 60_000).all()


def test_a_group_that_goes_to_b_at_once_is_three_away(mind):
    outcome = economy(mind, **CALM, starts=(0,), off=0.0, change=0.0).run([FLIP], [1])
    assert outcome.score == pytest.approx(-(3 * 2.5 / 9 + 0.3))


def test_the_ratio_turned_round_is_nobodys_when_all_stay(mind):
    terms = {**CALM, "events": (1,), "starts": (1,), "off_late": 0.0, "out_late": 0.0}
    outcome = economy(mind, **terms).run([STAY], [1])
    assert outcome.score == pytest.approx(-(3 / 9 + 6 / 9) / 2)


def test_robots_taken_away_and_added_change_what_is_wanted(mind):
    terms = {**CALM, "starts": (1,), "off_late": 0.0, "out_late": 0.0}
    # Three of nine are away from six; of six in B that are left two, of twelve four.
    for event, off in ((2, 2 / 6), (3, 4 / 12)):
        outcome = economy(mind, **terms | {"events": (event,)}).run([STAY], [3, 4, 5, 6])
        gone = outcome.score[0] == pytest.approx(-(3 / 9 + off) / 2)
        assert gone


@pytest.mark.parametrize("start", [0, 1])
def test_a_delivery_is_paid_as_in_the_model(start):
    told = {}
    staying = SimpleNamespace(
        set_sensor=told.__setitem__, step=lambda: None, actuator=lambda name: told[name]
    )
    terms = ECONOMY.Terms(numbers=(9,), ratios=(1 / 2,), starts=(start,), events=(0,))
    worlds = ECONOMY.Worlds([ECONOMY.World(1, terms, 60_000)], 1, 60_000)
    worlds.go_on(staying)
    # Of 27 objects half are B. They fade until one robot delivers, whose kind is then not scarce.
    left = 13.5 * (1 - 0.0005) ** worlds.now[0]
    counts = (left, left + 1) if start else (left + 1, left)
    assert (worlds.count_a[0], worlds.count_b[0]) == pytest.approx(counts)
    scarcity = (left / (2 * left + 1) - 1 / 2) / (1 / 4)
    assert told["PAYOFF"] == pytest.approx([0.5 + 0.15 * scarcity])
    assert told["ROLE"].tolist() == [start]


def test_a_score_hangs_on_genome_and_world_alone(mind):
    rng = np.random.default_rng(3)
    genomes = rng.normal(0, 0.5, (3, 39))
    whole = economy(mind).run(genomes, [1, 2, 3, 4]).score
    assert (economy(mind).run(genomes[1:2], [3]).score == whole[1:2, 2:3]).all()
    assert len(set(whole.ravel().tolist())) > 6


def test_other_skills_are_refused(mind):
    with pytest.raises(ModelError, match="SE:PAYOFF"):
        ECONOMY.Economy({}, mind, master=SKILL, skill="CollectA")


# The mind -----------------------------------------------------------------------------------------


def test_the_mind_is_that_of_the_lessons_with_a_role_learned(mind):
    begun = LESSONS.curriculum.mind
    assert mind.skills.keys() == begun.skills.keys()
    for name, skill in mind.skills.items():
        other = begun.skills[name]
        assert (skill.inputs, skill.outputs) == (other.inputs, other.outputs), name
        if other.genome is not None:
            assert (skill.genome == other.genome).all(), name
    assert mind.skills[SKILL].genome.size == 39


def test_collect_a_and_b_are_duplicates_that_share_the_way_home(mind):
    known = MindDescription.load(model_folder("collect_retrained") / "mind")
    for kind in "AB":
        collect = mind.skills[f"Collect{kind}"]
        assert (collect.genome == known.skills["Collect"].genome).all()
        assert collect.subskills == (
            f"GoTo{kind}+Avoid", "GoToDropZone+Avoid", f"ClawControl{kind}"
        )  # fmt: skip
        assert [str(one) for one in mind.skills[f"GoTo{kind}"].inputs] == [f"SE:RADOBJ{kind}"]
    assert mind.parents["Avoid"] == ("GoToA+Avoid", "GoToB+Avoid", "GoToDropZone+Avoid")


@pytest.mark.parametrize("robots", [6, 9, 18])
def test_the_learned_mind_settles_in_the_economy(mind, robots):
    genome = mind.skills[SKILL].genome
    outcome = economy(mind, numbers=(robots,), events=(0,)).run([genome], range(64))
    assert outcome.fields["changes"].mean() < 1.0
    if robots <= 9:
        assert outcome.fields["within"].mean() >= 0.85


@pytest.mark.parametrize("event", [1, 2, 3])
def test_the_learned_mind_settles_again_after_a_shock(mind, event):
    genome = mind.skills[SKILL].genome
    outcome = economy(mind, numbers=(9,), events=(event,)).run([genome], range(64))
    assert outcome.fields["within"].mean() >= 0.75
    assert outcome.fields["changes"].mean() < 1.0
