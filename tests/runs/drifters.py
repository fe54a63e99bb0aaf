"""A stand-in for a model: all that a run asks of one, a pure function of seed and tick.

It has what makes tables hard: births and deaths, a column that is null for a long while, one that
is null for ever, whole numbers that become numbers, texts.
"""

import time
from dataclasses import dataclass
from typing import ClassVar

import numpy as np


@dataclass(frozen=True)
class Idle:
    count: int
    first_agent: int | None
    first_tick: int | None


class Drifters:
    name = "drifters"
    ticks = 1000
    schemes: ClassVar[dict] = {}
    assemblies: ClassVar[dict] = {}
    stopped = False

    def __init__(
        self, seed=0, compiled=True, scheme=None, hierarchy=None, n=5, pause=0.0, fail_at=-1
    ):
        self.seed = seed
        self._parameters = {"n": n, "pause": pause, "fail_at": fail_at}
        self.tick = 0
        self.x = np.zeros(n)
        self.advanced = []  # lengths of the chunks

    def parameter_values(self):
        return dict(self._parameters)

    def advance(self, ticks):
        self.advanced.append(ticks)
        for _ in range(ticks):
            key = np.array([self.seed, self.tick], np.uint64)
            draws = np.random.Generator(np.random.Philox(key=key))
            n = self._parameters["n"] + (self.tick // 7) % 4
            x = np.zeros(n)
            x[: min(n, len(self.x))] = self.x[:n]
            self.x = x + draws.normal(size=n)
            self.tick += 1
            if self.tick == self._parameters["fail_at"]:
                raise ZeroDivisionError("division by zero")
            if self._parameters["pause"]:
                time.sleep(self._parameters["pause"])

    def series(self):
        late = self.tick >= 60
        return {
            "population": len(self.x),
            "mean": float(self.x.mean()),
            "late": float(self.x[0]) if late else None,
            "whole_then_not": 1 if self.tick < 40 else 1.5,
            "never": None,
        }

    def agents(self):
        late = self.tick >= 60
        return {
            "agent": np.arange(len(self.x)),
            "x": self.x,
            "plan": [("left" if v < 0 else "right") if late else None for v in self.x],
            "near": [bool(abs(v) < 1) for v in self.x],
            "land": [float(v) if i % 2 and late else None for i, v in enumerate(self.x)],
        }

    def state(self):
        return {"x": self.x, "tick": np.array(self.tick)}

    def restore(self, state):
        self.x = state["x"].copy()
        self.tick = int(state["tick"])

    @property
    def idle(self):
        return Idle(3, 1, 2) if self.tick > 2 else Idle(0, None, None)
