"""A model with luck that fits of the tests run, and searches without any society."""

import numpy as np
import pytest

from socialmind.experiments.calibration.plan import Plan
from socialmind.experiments.calibration.search import Search
from socialmind.experiments.calibration.space import Dimension, Space
from socialmind.experiments.calibration.target import target_of
from socialmind.experiments.calibration.trying import RunJob, Tried
from socialmind.experiments.sweeps.points.varied import PARAMETER, Varied
from socialmind.society.parameter import Parameter

HILL = '''"""A walker on a line, whose place has luck."""

from socialmind import Agent, Model, Population, once, parameter


class Nobody(Agent):
    pass


def walk(model, rng):
    model.place += model.pace + rng.uniform(-0.01, 0.01)


class Hill(Model):
    """Two numbers to be found: the first place, and the pace."""

    ticks = 4
    first: float = parameter(1.0, unit="m", low=0.0, high=2.0)
    pace: float = parameter(0.5, unit="m a tick", low=0.0, high=1.0)
    steps: int = parameter(3, low=1, high=9)
    mood: str = parameter("well", choices=("well", "broken", "nothing"))
    place: float = 0.0
    nobody = Population(Nobody, 1)
    schedule = (once(walk),)

    def series(self):
        if self.mood == "broken" and self.pace > 0.5:
            raise LookupError("lost the way")
        height = float("nan") if self.mood == "nothing" and self.pace > 0.5 else 1.0
        return {"place": self.first + self.place, "steps_made": self.steps, "height": height}
'''


@pytest.fixture(scope="session")
def hill(tmp_path_factory):
    """The folder of the model."""
    folder = tmp_path_factory.mktemp("hill") / "hill"
    folder.mkdir()
    (folder / "model.py").write_text(HILL)
    return folder


def space(**ranges):
    """A space of parameters that no model has."""
    made = []
    for name, (low, high) in ranges.items():
        parameter = Parameter(0.5, low=low, high=high, name=name)
        made.append(Dimension(Varied(name, PARAMETER, parameter), low, high))
    return Space(tuple(made))


@pytest.fixture(scope="session")
def searched():
    """Return what searches, with runs that are calls of a function."""
    return _searched


def _searched(simulate, method="cmaes", budget=200, seeds=2, seed=0, recover=0, **target):
    """Return the searches of a fit at their end, whose runs are calls of a function.

    Args:
        simulate: of values and a generator, the statistics of a run.
        target: value and error of each.
        method, budget, seeds, seed, recover: as of `fit`.
    """
    dimensions = space(a=(0.0, 1.0), b=(0.0, 1.0))
    plan = Plan(dimensions, target_of(target), method, budget, seeds, recover, 20, seed)
    truths = plan.truths()
    searches = [Search(plan, n, truths[n - 1] if n else None) for n in range(1 + recover)]
    for search in searches:
        groups = search.begin({})
        while groups:
            group = groups.pop(0)
            for replicate, one in enumerate(group.seeds):
                found = simulate(*group.values, np.random.default_rng(one))
                job = RunJob(0, replicate, one, group.values)
                group.tried[replicate] = Tried(job, None if found is None else np.array([found]))
            groups += search.take(group.record())
    return searches
