"""Societies with one clock are never apart for longer than a stretch."""

import asyncio

import pytest

from socialmind.errors import SocialmindError
from socialmind.studio.server.clock import Clock


class Standing:
    """A stage that takes its time, and notes where the others were when it set out."""

    def __init__(self, seconds, ends=10**40, fails=None):
        self.seconds, self.ends, self.fails = seconds, ends, fails
        self.tick, self.told, self.others, self.apart = 0, [], [], set()

    async def answer(self, command, what):
        assert (command["do"], command["together"], what) == ("step", True, "stood")
        self.apart |= {abs(self.tick - one.tick) for one in self.others if not one.busy}
        self.busy = True
        await asyncio.sleep(self.seconds)
        if self.fails is not None and self.tick >= self.fails:
            raise SocialmindError("a rule failed")
        self.tick = min(self.tick + command["ticks"], self.ends)
        self.busy = False
        return {"tick": self.tick, "over": self.tick >= self.ends}

    busy = False

    def command(self, command):
        self.told.append(command["do"])


def gone_on(stages, pace, seconds):
    """Let them go on for a while."""
    for one in stages:
        one.others = [other for other in stages if other is not one]

    async def going():
        clock = Clock(stages, pace)
        await asyncio.sleep(seconds)
        still = clock.running
        clock.stop()
        await clock._going
        return still

    return asyncio.run(going())


@pytest.mark.parametrize("pace", [7, None])
def test_the_fast_one_waits_for_the_slow_one(pace):
    fast, slow = Standing(0.0), Standing(0.01)
    assert gone_on([fast, slow], pace, 0.25)
    assert fast.tick == slow.tick > 0
    assert fast.apart <= {0}
    assert fast.told == slow.told == ["pause"]
    if pace is not None:
        assert fast.tick % pace == 0


@pytest.mark.parametrize("other", [Standing(0.0, ends=14), Standing(0.0, fails=14)])
def test_all_stand_where_one_ends_or_fails(other):
    one = Standing(0.0)
    assert not gone_on([one, other], 7, 0.4)
    assert one.told == other.told == ["pause"]
