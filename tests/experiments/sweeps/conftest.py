"""Models that sweeps of the tests run."""

import pytest

GIFTS = '''"""Walkers who give."""

import time

from socialmind import Agent, Model, Population, Torus, each, once, parameter


class Walker(Agent):
    money: float = 10.0


def live(walker, model, rng):
    other = model.walkers.one_of(rng)
    gift = min(walker.money, rng.uniform(0, model.largest_gift))
    walker.money -= gift
    other.money += gift


def break_down(model):
    if model.broken:
        model.ticks_lived = 1 // (model.ticks_lived * 0)
    model.ticks_lived += 1


class Gifts(Model):
    """Walkers give money away."""

    largest_gift: float = parameter(1.0, unit="coins", low=0.0, high=5.0)
    n: int = parameter(6, low=1, high=40)
    broken: bool = parameter(False)
    ticks_lived: int = 0
    world = Torus(9)
    walkers = Population(Walker, "n")
    schedule = (each(walkers, live), once(break_down))

    def series(self):
        money = self.walkers.money
        return {"richest": float(money.max()), "poor": int((money < 5).sum())}
'''

SLOW = '''"""A model that may take its time, or end its process."""

import os
import time

from socialmind import Agent, Model, Population, parameter


class Nobody(Agent):
    pass


class Slow(Model):
    """Nothing happens."""

    how: str = parameter("well", choices=("well", "sleeps", "killed", "odd", "at once"))
    note: int = parameter(0)
    nobody = Population(Nobody, 1)

    def series(self):
        if self.how == "at once":
            raise LookupError("nothing there")
        if self.how == "sleeps" and self.tick > 0:
            time.sleep(600)
        if self.how == "killed" and self.tick > 0:
            os.kill(os.getpid(), 9)
        return {"tick_now": [1] if self.how == "odd" and self.tick > 0 else self.tick}
'''


def written(folder, text):
    folder.mkdir()
    (folder / "model.py").write_text(text)
    return folder


@pytest.fixture(scope="session")
def gifts(tmp_path_factory):
    """The folder of a small model without minds."""
    return written(tmp_path_factory.mktemp("gifts") / "gifts", GIFTS)


@pytest.fixture(scope="session")
def slow(tmp_path_factory):
    """The folder of a model that goes wrong in the ways that processes do."""
    return written(tmp_path_factory.mktemp("slow") / "slow", SLOW)


@pytest.fixture(scope="session")
def contents():
    """Return the bytes of all tables of a sweep."""

    def read(folder):
        return {path.name: path.read_bytes() for path in sorted(folder.glob("*.parquet"))}

    return read
