"""One clock for several societies: they go on side by side, and none is ahead of another."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Sequence

from socialmind.errors import SocialmindError
from socialmind.studio.server.stages import StageProcess

FRAME_SECONDS = 1 / 30
MOST_FASTER = 4
"""How much longer a stretch of ticks may be than the one before, as fast as possible."""


class Clock:
    """What lets several societies go on together.

    Args:
        stages: the processes of the societies, which stand at the same tick.
        pace: ticks between two frames; None, as fast as possible.
    """

    def __init__(self, stages: Sequence[StageProcess], pace: int | None) -> None:
        self.stages = tuple(stages)
        self.pace = pace
        self._running = True
        self._going = asyncio.create_task(self._go())

    def stop(self) -> None:
        """Let all stand, at the same tick."""
        self._running = False

    @property
    def running(self) -> bool:
        """Whether they go on."""
        return not self._going.done()

    async def _go(self) -> None:
        ticks = 1
        try:
            while self._running:
                begin = time.perf_counter()
                wanted = ticks if self.pace is None else self.pace
                command = {"do": "step", "ticks": wanted, "together": True}
                stood = await asyncio.gather(
                    *(stage.answer(command, "stood") for stage in self.stages)
                )
                took = time.perf_counter() - begin
                if self.pace is None:
                    fitting = int(ticks * FRAME_SECONDS / max(took, 1e-4))
                    ticks = max(1, min(fitting, MOST_FASTER * ticks))
                else:
                    await asyncio.sleep(max(0.0, FRAME_SECONDS - took))
                if any(one["over"] for one in stood):
                    return
        except SocialmindError:
            return  # its page has been told
        finally:
            for stage in self.stages:
                stage.command({"do": "pause"})
