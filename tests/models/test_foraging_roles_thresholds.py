"""Robots that decide by response thresholds."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.experiments.studies import topics
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
RULES = load_file(FOLDER / "thresholds.py")
scanning = load_file(topics()["foraging_roles"] / "threshold_scan.py")


def robot(**fields):
    told = {}
    given = {"is_b": True, "payoff": 0.4, "threshold_a": 0.3, "threshold_b": 0.2, **fields}
    made = SimpleNamespace(hierarchy=SimpleNamespace(set_variable=told.__setitem__), **given)
    return made, told


def model(**fields):
    given = {"lowest_threshold": 0.1, "highest_threshold": 0.5, "variety": 1.0}
    return SimpleNamespace(**{**given, "learning": 0.0, "forgetting": 0.0, **fields})


class Drawn:
    def __init__(self, value):
        self.value = value

    def random(self):
        return self.value


@pytest.mark.parametrize(("drawn", "takes_up"), [(0.09, True), (0.11, False)])
def test_the_other_task_is_taken_up_by_its_call_and_its_threshold(drawn, takes_up):
    # A B is worth 0.1 less than it should be, so an A calls with 0.1: 0.01 / (0.01 + 0.09).
    one, told = robot()
    RULES.respond(one, model(), Drawn(drawn))
    assert told == ({"ROLE": 0.0} if takes_up else {})


def test_who_is_paid_well_goes_on():
    one, told = robot(payoff=0.6)
    RULES.respond(one, model(), Drawn(0.0))
    assert told == {}


def test_thresholds_fall_by_doing_and_rise_by_not_doing_within_their_bounds():
    one, _ = robot(is_b=False, threshold_a=0.15, threshold_b=0.48, payoff=0.5)
    RULES.respond(one, model(learning=0.04, forgetting=0.03), Drawn(0.5))
    assert (one.threshold_a, one.threshold_b) == pytest.approx((0.11, 0.5))
    RULES.respond(one, model(learning=0.04, forgetting=0.03), Drawn(0.5))
    assert (one.threshold_a, one.threshold_b) == (0.1, 0.5)


def test_thresholds_begin_alike_or_apart():
    assert RULES.begun(0.0, model(variety=0.0)) == pytest.approx(0.3)
    assert RULES.begun(0.0, model()) == pytest.approx(0.1)
    assert RULES.begun(0.75, model(variety=0.5)) == pytest.approx(0.35)


@pytest.mark.parametrize("controller", list(scanning.CONTROLLERS))
def test_the_controllers_run_in_bodies(controller):
    given = scanning.CONTROLLERS[controller]
    one = load_model(FOLDER / f"{controller}.py")(seed=2, start=0, foragers=3, add_at=10, shift=1)
    one.advance(3000)
    robots = one.robots
    assert len(robots) == 4
    assert (robots.threshold_a >= given["lowest_threshold"]).all()
    delivered = robots.delivered_a + robots.delivered_b
    assert delivered.sum() > 0
    if controller == "fixed_thresholds":
        assert len(set(robots.threshold_a.tolist())) == 4
    else:
        middle = (given["lowest_threshold"] + given["highest_threshold"]) / 2
        never = robots.delivered_b == 0
        by_doing = middle - given["learning"] * delivered[never]
        assert robots.threshold_a[never] == pytest.approx(by_doing)


def test_the_scan_follows_the_models_rules_and_its_best_are_the_controllers():
    nine = scanning.IN_THE_ECONOMY["nine robots"]
    for given in scanning.CONTROLLERS.values():
        found = scanning.tried(given, nine, range(500, 516))
        assert found["within_one"] >= 0.75
    nobody = {**scanning.CONTROLLERS["fixed_thresholds"], "lowest_threshold": 1e6}
    nobody["highest_threshold"] = 1e6
    assert scanning.tried(nobody, {**nine, "starts": (0,)}, [1, 2]) == {
        "within_one": 0.0, "changes": 0.0
    }  # fmt: skip
    kept = pd.read_csv(scanning.OUT)
    best = scanning.best(kept).set_index("controller")
    fixed = scanning.CONTROLLERS["fixed_thresholds"]
    assert best.loc["fixed_thresholds", list(fixed)].to_dict() == fixed
    for name, given in scanning.CONTROLLERS.items():
        own = kept[(kept[list(given)] == pd.Series(given)).all(axis=1)]
        own = own[own["controller"] == name]
        assert own["within_one"].mean() > best.loc[name, "within_one"] - 0.015


def test_what_a_world_comes_to_hangs_on_no_other_world():
    terms = scanning.ECONOMY.Terms(**scanning.IN_THE_ECONOMY["nine robots"])
    for given in scanning.CONTROLLERS.values():
        changes = []
        for seeds in ([3, 4], [4]):
            drawn = [scanning.ECONOMY.World(seed, terms, 8000) for seed in seeds]
            worlds = scanning.Responders(drawn, seeds, 8000, given)
            while worlds.go_on(None):
                pass
            changes.append((worlds.changes[-1], worlds.off[-1], *worlds.role[-1]))
        assert changes[0] == changes[1]
    assert not set(scanning.CHOOSING_ECONOMY) & set(range(256))
    assert np.unique([len(row) for row in scanning.candidates()]).tolist() == [6]
