"""What the tests of devices share: rows to stand in for those of a model."""

import math
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

sys.path.insert(0, str(Path(__file__).parent))


class Members(list):
    """A population of rows, as rules see it."""

    def __getitem__(self, identity):
        return next(one for one in self if one.id == identity)

    def contains(self, identity):
        return any(one.id == identity for one in self)


def body(x=0.0, y=0.0, id=0, **fields):
    """A body, or a robot."""
    row = {"x": x, "y": y, "id": id, "angle": 0.0, "vx": 0.0, "vy": 0.0, "spin": 0.0}
    row |= {"push_x": 0.0, "push_y": 0.0, "torque": 0.0, "contact": 0}
    row |= {"carrier_kind": -1, "carrier": -1, "carrying": -1, "closed": False, "battery": 1.0}
    row |= {"reward": 0.0, "earned": 0.0, "signal": [0.0, 0.0], "half_width": 5.0}
    return SimpleNamespace(**(row | fields))


def called(device, **given):
    """Call a device's function with what a tick would give it."""
    values = {
        "kind": 0,
        "slot": 0,
        "own": False,
        "found": True,
        "restarted": False,
        "before": 0.5,
        **device.settings,
    }
    if "target" in given and "robot" in given:
        robot, target = given["robot"], given["target"]
        dx, dy = target.x - robot.x, target.y - robot.y
        values["distance"] = math.hypot(dx, dy)
        values["bearing"] = math.remainder(math.atan2(dy, dx) - robot.angle, math.tau)
    values |= given
    return device.function(*(values[name] for name in device.takes))


@pytest.fixture
def stand_in():
    """Rows, and the call of a device with them."""
    return SimpleNamespace(body=body, members=lambda *rows: Members(rows), call=called)
