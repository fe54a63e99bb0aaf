"""The societies that run for pages, each in a process, and the pages that look at each."""

from __future__ import annotations

import asyncio
import json
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.studio.running.performing import perform
from socialmind.studio.running.stage import FRAME

SILENT = ("stood", "copied", "table")
"""What answers the program, and is no page's business."""
WAITING = 256
"""Messages that may wait for a page; one that falls further behind is told all anew."""


class Viewer:
    """A page that looks at a stage: what is said waits in order, of frames the last alone."""

    def __init__(self) -> None:
        self.said: asyncio.Queue[str] = asyncio.Queue(WAITING)
        self.frame: bytes | None = None
        self.ready = True
        self.news = asyncio.Event()

    def tell(self, message: str) -> None:
        """Let something be said to it."""
        with suppress(asyncio.QueueFull):
            self.said.put_nowait(message)
        self.news.set()

    def show(self, frame: bytes) -> None:
        """Let it see a frame, in place of one that it has not asked for yet."""
        self.frame = frame
        self.news.set()


class StageProcess:
    """A society in a process of its own, and who looks at it.

    The process is begun at once, so that its libraries are there when the first command comes.
    """

    def __init__(self) -> None:
        context = get_context("spawn")
        self._connection, other = context.Pipe()
        self._process: BaseProcess = context.Process(target=_begin, args=(other,), daemon=True)
        self._process.start()
        other.close()
        self.viewers: list[Viewer] = []
        self.said: dict[str, Any] = {}
        """What was last said of the model and the society, for who asks what runs."""
        self._answers: list[tuple[str, asyncio.Future[dict[str, Any]]]] = []
        self._asked = False
        self._reader = asyncio.get_running_loop().create_task(self._read())

    @property
    def alive(self) -> bool:
        """Whether the process still runs."""
        return self._process.is_alive()

    def command(self, command: dict[str, Any]) -> None:
        """Send a command."""
        try:
            self._connection.send_bytes(json.dumps(command).encode())
        except (BrokenPipeError, OSError):
            self._hear(_gone())

    async def answer(self, command: dict[str, Any], what: str) -> dict[str, Any]:
        """Send a command, and return what is said to it.

        Args:
            command: as of `command`.
            what: the kind of message that answers it.

        Raises:
            SocialmindError: it failed, or the process has ended.
        """
        if not self.alive:
            raise SocialmindError("the process of this society has ended")
        waiting: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        self._answers.append((what, waiting))
        self.command(command)
        return await waiting

    def tell(self, message: str) -> None:
        """Let something be said to all pages that look at it."""
        for viewer in self.viewers:
            viewer.tell(message)

    def want_frame(self) -> None:
        """Ask for a frame, unless one has been asked for."""
        if not self._asked:
            self._asked = True
            self.command({"do": "seen"})

    def join(self, viewer: Viewer) -> None:
        """Let a page look."""
        self.viewers.append(viewer)
        self.command({"do": "join"})
        self.want_frame()

    def end(self) -> None:
        """End the process."""
        self._reader.cancel()
        self._process.terminate()
        self._connection.close()

    async def _read(self) -> None:
        """Hear what the process sends, and pass it on."""
        loop = asyncio.get_running_loop()
        while True:
            try:
                message = await loop.run_in_executor(None, self._connection.recv_bytes)
            except (EOFError, OSError):
                self._hear(_gone())
                return
            if message[:1] == FRAME:
                self._asked = False
                for viewer in self.viewers:
                    viewer.show(message[1:])
                if any(viewer.ready for viewer in self.viewers):
                    self.want_frame()
            else:
                self._hear(message[1:].decode())

    def _hear(self, message: str) -> None:
        """Note what is said, give it to who waits for it, and pass it on."""
        content = json.loads(message)
        what = content["said"]
        if what in ("model", "society"):
            self.said[what] = content
        answers, self._answers = self._answers, []
        for wanted, waiting in answers:
            if waiting.done():
                continue
            if what == "error":
                waiting.set_exception(SocialmindError(content["text"]))
            elif what == wanted:
                waiting.set_result(content)
            else:
                self._answers.append((wanted, waiting))
        if what not in SILENT:
            self.tell(message)


def _begin(connection: Connection) -> None:
    """Load what every model needs, then hear commands."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    perform(connection)


def _gone() -> str:
    text = "the process of this society has ended (for want of memory, perhaps); set it up again"
    return json.dumps({"said": "error", "of": "stage", "text": text})
