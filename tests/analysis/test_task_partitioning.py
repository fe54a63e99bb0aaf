"""The study of task partitioning: groups and measures by hand, claims that tables bear or not."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.experiments.studies import studies_in
from socialmind.learning import Training
from socialmind.learning.training.course import TrainingCourse
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "task_partitioning"
GROUPS = load_file(FOLDER / "groups.py")
REPORT = load_file(FOLDER / "report.py")
TRAININGS = load_file(FOLDER / "trainings.py")


def test_its_study_is_found():
    (study,) = studies_in(FOLDER)
    assert study.name == "task-partitioning"
    assert study.quick is not None and study.kept is not None


def test_every_group_of_four_programmed_robots_is_judged_once():
    groups = list(GROUPS.mixes())
    assert len(groups) == len({one.name for one in groups}) == 15
    assert all(sum(one.parameters.values()) == 4 for one in groups)
    assert GROUPS.GENERALISTS in groups and GROUPS.HALVES in groups
    assert GROUPS.mix(2, 1, 1).name == "2 generalists, 1 dropper, 1 collector"


def test_worlds_for_choosing_are_not_reported_on():
    assert not set(GROUPS.CHOOSING) & set(GROUPS.REPORTED)


def test_measures_of_work_by_hand():
    arena = load_model("task_partitioning")(1, compiled=False)
    arena.delivered, arena.shared, arena.slid = 8, 4, 2
    # Two robots do one task alone, two do both alike: I / H(tasks) = 1/2.
    arena.robots.fetched = [4, 0, 2, 2]
    arena.robots.delivered = [0, 4, 2, 2]
    found = GROUPS.measured(arena)
    assert found["delivered"] == 8
    assert (found["shared"], found["slid"]) == (0.5, 0.25)
    assert found["division"] == pytest.approx(0.5)
    assert 0 < found["by_chance"] < 0.5
    assert found["specialised"] == 0.5


def test_who_brings_nothing_home_shares_nothing():
    arena = load_model("task_partitioning")(1, compiled=False)
    found = GROUPS.measured(arena)
    assert found["delivered"] == 0
    assert np.isnan(found["shared"]) and np.isnan(found["division"])


def test_a_group_has_a_row_for_each_world():
    table = GROUPS.judged(GROUPS.HALVES, "slope", [1, 2])
    assert list(table.columns) == [*GROUPS.KEYS, *GROUPS.JUDGED]
    assert table["world"].tolist() == [1, 2]
    assert (table["shared"] == 1).all()
    assert table["division"].tolist() == pytest.approx([1.0, 1.0])
    assert table["delivered"].min() > 50


def made_up(shares):
    """Return a table of ten worlds in which attempts share so much; halves do best on the slope."""
    best = {"slope": GROUPS.HALVES.name, "flat": GROUPS.GENERALISTS.name}
    rows = []
    for ground in GROUPS.GROUNDS:
        for world in range(10):
            key = {"ground": ground, "world": world, "slid": 0.0, "by_chance": 0.1}
            for start in (GROUPS.PRIMITIVES, GROUPS.BLOCKS):
                name = GROUPS.evolved_from(start, ground)
                for attempt, share in enumerate(shares[start, ground], 1):
                    own = {"group": name, "attempt": attempt, "delivered": 40 + world + 40 * share}
                    own |= {"shared": share, "division": share, "specialised": share}
                    rows.append(key | own)
            for one in GROUPS.mixes():
                home = 60.0 if one.name == best[ground] else 40.0
                own = {"group": one.name, "attempt": 0, "delivered": home + world}
                rows.append(key | own | {"shared": 0.0, "division": 0.0, "specialised": 0.0})
    return pd.DataFrame(rows)


def test_claims_hold_where_the_table_bears_them():
    shares = {
        ("primitives", "slope"): [0.6, 0.5, 0.4],
        ("primitives", "flat"): [0.1, 0.0, 0.0],
        ("building blocks", "slope"): [0.9, 0.95, 1.0],
        ("building blocks", "flat"): [0.0, 0.0, 0.1],
    }
    lines = list(REPORT.findings(made_up(shares)))
    claims = [line for line in lines if "difference" in line]
    assert len(claims) == 6
    assert all(": holds (" in line for line in claims)
    assert "half droppers and half collectors 64.5" in lines[0]
    assert "2 droppers, 2 collectors, 64.5" in lines[0] and "4 generalists, 64.5" in lines[1]
    assert "both at once 44.5" in lines[2]
    assert "3 of 3 attempts" in lines[3] and "0 of 3 attempts" in lines[4]


def test_and_are_said_not_to_where_it_does_not():
    shares = {
        ("primitives", "slope"): [0.0, 0.1, 0.0],
        ("primitives", "flat"): [0.9, 1.0, 0.9],
        ("building blocks", "slope"): [0.0, 0.9, 0.2],
        ("building blocks", "flat"): [0.1, 0.6, 0.2],
    }
    blocks, primitives, *others = (
        line for line in REPORT.findings(made_up(shares)) if "difference" in line
    )
    assert "cannot be told" in blocks
    assert "the reverse holds" in primitives
    assert len(others) == 4


def test_programs_and_blocks_are_the_same_strategies():
    blocks = load_file(FOLDER / "blocks.py")
    programmed = {
        "Generalist": "n_generalists",
        "Dropper": "n_droppers",
        "Collector": "n_collectors",
    }
    for gradient in (0.0, 1.0):
        mind = blocks.mind_of_blocks(gradient)
        for place, name in enumerate(programmed):
            weights = np.zeros((3, 9))
            weights[place, 8] = 1.0  # this one alone, at any time
            forage = mind.skill("Forage").changed(genome=weights.ravel())
            known = mind.with_modules(skills=[forage])
            rules = REPORT.rules_of(known)
            arena = load_model("task_partitioning")(
                1, compiled=False, n_robots=1, gradient=gradient, **{programmed[name]: 1}
            )
            for row in rules.to_dict("records"):
                robot = arena.robots[0]
                robot.place = REPORT.MODEL.PLACES.index(row["place"].upper())
                robot.item = arena.items[0].id if row["laden"] else None
                REPORT.MODEL.follow_strategy(robot, arena)
                assert row[f"to_{REPORT.MODEL.BEHAVIOURS[robot.behaviour]}"] == 1.0
                if row["laden"]:
                    assert robot.drops == row["Drop"]
                else:
                    assert robot.picks_up == row["PickUp"]


def test_a_mind_is_read_as_a_table_of_rules():
    mind = TRAININGS.LESSONS.MIND
    skill = mind.skill("Forage")
    weights = np.zeros((5, 9))
    weights[0, 8] = 0.25  # phototaxis and antiphototaxis at any time, one to three
    weights[1, 8] = 0.75
    weights[3, 3] = 1.0  # it picks up at the source
    weights[4, 4] = 0.5  # and with an item lets go at every other decision
    known = mind.with_modules(skills=[skill.changed(genome=weights.ravel())])
    rules = REPORT.rules_of(known)
    assert len(rules) == 4 * 2 * 3
    assert (rules["to_Phototaxis"] == 0.25).all() and (rules["to_RandomWalk"] == 0).all()
    assert (rules["PickUp"] == (rules["place"] == "source")).all()
    assert (rules["Drop"] == 0.5 * rules["laden"]).all()


@pytest.mark.parametrize("name", list(TRAININGS.PLANS))
def test_each_training_fits_its_mind_also_when_small(name):
    plan = TRAININGS.PLANS[name]
    assert plan.attempts >= 10
    for one in (plan, plan.small(**TRAININGS.PLANS.small)):
        TrainingCourse(one.curriculum(), one.mind(), one.seed, "compiled")


def test_the_model_has_the_mind_of_an_attempt_that_is_kept():
    name, attempt = TRAININGS.SHIPPED
    learned = Training(TRAININGS.PLANS.kept / name).mind(attempt).skill("Forage")
    shipped = MindDescription.load(model_folder("task_partitioning") / "mind").skill("Forage")
    assert np.array_equal(learned.genome, shipped.genome)


def test_small_trainings_end_in_a_figure_and_tables(tmp_path):
    plans = {
        name: TRAININGS.PLANS[name].small(2, 1, population=4, repetitions=1, ticks=200)
        for name in ("slope", "blocks_flat")
    }
    trainings = {
        name: (plan.train(tmp_path / name, workers=1), plan.about) for name, plan in plans.items()
    }
    written = REPORT.write_partitioning(trainings, REPORT.Way.QUICK, [1, 2], tmp_path / "out")
    assert {path.suffix for path in written} == {".pdf", ".png", ".csv", ".md"}
    table = pd.read_csv(tmp_path / "out" / "task-partitioning.csv")
    assert len(table) == (2 * 2 + 15) * 2 * 2
    page = (tmp_path / "out" / "task-partitioning.md").read_text("utf-8")
    assert "holds" not in page  # a small version shows that all works, and says nothing else
