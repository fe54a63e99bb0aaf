"""A model whose sweeps are drawn: a level that rises and leaks, in units that its author says."""

import pandas as pd
import pytest

from socialmind.experiments import Sweep, sweep

TANK = '''"""A tank."""

from socialmind import Agent, Model, Population, once, parameter


class Drop(Agent):
    weight: float = 1.0


def rise(model, rng):
    model.level += model.inflow * rng.uniform(0.5, 1.5)
    if model.rule == "share":
        model.level *= 0.9
    if model.broken and model.level > 4.0:
        model.level = 1 // (0 * model.tick)


class Tank(Model):
    """A level rises."""

    inflow: float = parameter(1.0, unit="litres a tick", low=0.0, high=9.0, doc="what comes in")
    leak: float = parameter(0.0, unit="share a tick", low=0.0, high=1.0)
    size: float = parameter(1.0, low=0.1, high=9.0, doc="a meaning that is too long for an axis")
    rule: str = parameter("keep", choices=("keep", "share"))
    broken: bool = parameter(False)
    level: float = 0.0
    drops = Population(Drop, 2)
    schedule = (once(rise),)

    def series(self):
        return {"level": float(self.level) * self.size - self.leak, "state": str(self.rule)}
'''
WORDS = """# Tank

## Design concepts

### Observation

| column | unit | meaning |
|---|---|---|
| `tick` | ticks | |
| `level` | litres | how full |

| column | unit | meaning |
|---|---|---|
| `level` | buckets | of agents |
"""


@pytest.fixture(scope="session")
def tank(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tanks") / "tank"
    folder.mkdir()
    (folder / "model.py").write_text(TANK)
    (folder / "odd_words.md").write_text(WORDS)
    return folder


@pytest.fixture(scope="session")
def swept(tank, tmp_path_factory):
    """Sweep the tank over a design, once for each."""
    known = {}

    def call(design, **options):
        listed = design.to_dict("list") if isinstance(design, pd.DataFrame) else design
        key = repr((listed, sorted(options.items())))
        if key not in known:
            usual = {
                "ticks": 8, "seeds": range(3), "every": 2, "compiled": False, "workers": 1,
                "measures": {"late": "mean(level[-2:])"},
            }  # fmt: skip
            out = tmp_path_factory.mktemp("swept") / "sweep"
            known[key] = sweep(tank, design, out=out, **{**usual, **options})
        return Sweep(known[key])

    return call
