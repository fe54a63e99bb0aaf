"""What is measured of roles: in a model that runs, and the same in records of every tick."""

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.experiments.measures.specialisation import Course
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
MEASURES = load_file(FOLDER / "measures.py")
ForagingRoles = load_model("foraging_roles")
STAY = np.zeros(39)
STAY[21] = 1.0  # the bias of the influence on the role as it is
FIXED, CHANCE = 1, 2


def staying():
    """The mind that ships, but its robots never change roles."""
    mind = MindDescription.load(FOLDER / "mind")
    return mind.with_modules(skills=[mind.skill("ForageRole").changed(genome=STAY)])


def test_the_last_quarter_counts_as_within_one_or_not():
    for beyond, one, two in (
        ([44_999, 44_999, 0], 1.0, 1.0), ([45_000, 44_999, 0], 0.0, 1.0), ([-1, -1, -1], 1.0, 1.0)
    ):  # fmt: skip
        values = {"last_beyond": np.array(beyond), "ticks": 60_000}
        assert MEASURES.stays_within(1).of(values) == one
        assert MEASURES.stays_within(2).of(values) == two


def changes(**values):
    """Changes after settling of three robots that ran 20,000 ticks."""
    nothing = {"settled_changes": 0, "settled_robot_ticks": 0, "changes_settled": 0}
    given = {"robot_ticks": 60_000, "present": 3, "settled_at": -1, "ticks": 20_000}
    return MEASURES.changes_after_settling(**nothing | given | values)


def test_changes_are_those_while_the_roles_were_settled():
    assert changes(changed=5, settled_at=10_000, changes_settled=2) == pytest.approx(1.0)
    before = {"settled_changes": 3, "settled_robot_ticks": 30_000}
    assert changes(changed=9, **before) == pytest.approx(1.0)
    both = changes(changed=9, settled_at=10_000, changes_settled=6, **before)
    assert both == pytest.approx(1.0)


def test_all_changes_count_where_the_roles_never_settled():
    assert changes(changed=5) == pytest.approx(5 / 6)


def test_ticks_to_settle_count_from_the_last_shock():
    assert MEASURES.ticks_to_settle(settled_at=700, began_at=0, ticks=60_000) == 700
    assert MEASURES.ticks_to_settle(settled_at=31_000, began_at=30_000, ticks=60_000) == 1_000
    assert MEASURES.ticks_to_settle(settled_at=-1, began_at=30_000, ticks=60_000) == 30_000


@pytest.mark.parametrize(("start", "off", "settled"), [(0, 2.0, -1), (1, 1.0, 0)])
def test_a_split_settles_when_it_stays_within_one_of_the_wanted_one(start, off, settled):
    model = ForagingRoles(seed=1, start=start, foragers=3, hierarchy=staying())
    assert model.off == pytest.approx(off)
    model.advance(4999)
    assert model.settled_at == -1
    model.advance(1)
    assert model.settled_at == settled


# The measures of experiments --------------------------------------------------------------------


def recorded(model, ticks):
    """Run a model; return each robot's role and what is wanted, at every tick."""
    agents, in_b, wanted = [], [], []
    for tick in range(ticks + 1):
        if tick:
            model.advance(1)
        agents.append(model.robots.id)
        in_b.append(model.robots.is_b)
        wanted.append(model.wanted)
    roles = {
        "tick": np.repeat(np.arange(ticks + 1), [len(one) for one in agents]),
        "agent": np.concatenate(agents),
        "role": np.where(np.concatenate(in_b), "B", "A"),
    }
    shares = {"tick": np.arange(ticks + 1), "A": 1 - np.array(wanted), "B": wanted}
    return pd.DataFrame(roles), pd.DataFrame(shares)


def scored(model):
    """What `socialmind score` takes from a model that has run."""
    found = {}
    for name in ("within_one", "settling_ticks", "role_changes"):
        measure = model.measures[name]
        values = {one: getattr(model, one) for one in measure.records}
        found[name] = measure.of(values | {"ticks": model.tick})
    return found


@pytest.mark.parametrize(
    ("seed", "parameters", "shocks", "settles"),
    [
        (5, {"start": 2}, [], [True]),
        (2, {"programmed": 1.0, "start": 3, "reverse_at": 7000}, [7000], [True, True]),
        (5, {"unlearned": FIXED, "remove_at": 6000}, [6000], [True, False]),
        (5, {"unlearned": CHANCE, "add_at": 3000}, [3000], [False, False]),
    ],
)
def test_scores_are_the_measures_of_experiments_over_every_tick(seed, parameters, shocks, settles):
    model = ForagingRoles(seed, **parameters)
    roles, wanted = recorded(model, 16_000)
    nothing = pd.DataFrame({"tick": [], "agent": [], "task": []})
    course = Course(roles, nothing, wanted, shocks=[tick + 1 for tick in shocks])
    assert np.isfinite(course.settlings["settled"]).tolist() == settles
    assert scored(model) == course.scored()
