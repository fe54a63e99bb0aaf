"""Processes that do a part of the work: Ctrl-C is not for them, and they end with this one.

A process that is lost takes with it the call that it had in hand, and no other.
"""

from __future__ import annotations

import os
import pickle
import shutil
import signal
import sys
import tempfile
import threading
import traceback
import warnings
from collections import deque
from collections.abc import Callable
from concurrent import futures
from contextlib import suppress
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from multiprocessing.util import Finalize
from typing import Any

from coglogo_py.compiled.code_folder import CacheWarning
from socialmind.errors import SocialmindError

AHEAD_BYTES = 1 << 14
"""Up to so many bytes a call is sent to a process that is at another; they fit into a pipe."""
READY = b"ready"
"""What a process says first: Python has run the script's file in it, and it waits for calls."""


class LostProcessError(RuntimeError):
    """The process that had a call in hand has ended.

    Args:
        code: its exit code; below 0 the signal that ended it; None where nobody knows.
    """

    def __init__(self, code: int | None = None) -> None:
        super().__init__(f"exit code {code}")
        self.code = code


class ProcessExecutor(futures.Executor):
    """Processes that do one call after another; a lost one is replaced.

    Args:
        count: how many, at most; they are begun as there are calls.
        folder: for what they write for a while; they remove it if this process is killed, and
            cannot itself.
    """

    def __init__(self, count: int, folder: str) -> None:
        self._folder = folder
        self._context = get_context("spawn")
        self._waiting: deque[_Call] = deque()
        self._hands = [_Hand() for _ in range(count)]
        self._lock = threading.Lock()
        self._over = False
        self._news, self._tell = self._context.Pipe(duplex=False)
        self._dismiss: Any = Finalize(self, _end_all, (self._hands,), exitpriority=10)
        self._leader = threading.Thread(target=self._lead, daemon=True)
        self._leader.start()

    def submit(
        self, function: Callable[..., Any], /, *arguments: Any, **named: Any
    ) -> futures.Future[Any]:
        """Have a function called, and return what will come of it."""
        call = _Call(futures.Future(), pickle.dumps((function, arguments, named)))
        with self._lock:
            if self._over:
                raise RuntimeError("the processes were let go")
            self._waiting.append(call)
            self._tell.send_bytes(b"")
        return call.future

    def in_hand(self) -> list[futures.Future[Any]]:
        """Return the calls that processes are at: those sent ahead wait."""
        return [call.future for hand in self._hands for call in tuple(hand.calls)[:1]]

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Let the processes go at once, whatever they are at."""
        with self._lock:
            if self._over:
                return
            self._over = True
            self._tell.send_bytes(b"")
        self._leader.join()
        self._dismiss()

    def _lead(self) -> None:
        """Hand out calls and take what comes of them, until the processes are let go."""
        while True:
            with self._lock:
                if self._over:
                    return
                for ahead in (False, True):
                    for hand in self._hands:
                        # The last few wait for whoever has time first.
                        if not ahead or len(self._waiting) > len(self._hands):
                            self._give(hand, ahead)
            busy = [hand for hand in self._hands if hand.calls]
            heard = [one for hand in busy for one in (hand.pipe, hand.process.sentinel)]
            ready = wait([self._news, *heard])
            while self._news.poll():
                self._news.recv_bytes()
            for hand in busy:
                if hand.pipe in ready or hand.process.sentinel in ready:
                    self._take(hand)

    def _give(self, hand: _Hand, ahead: bool) -> None:
        """Send a call to a process that has none, or a short one ahead."""
        while self._waiting and len(hand.calls) == ahead:
            if ahead and len(self._waiting[0].content) > AHEAD_BYTES:
                return
            call = self._waiting.popleft()
            if not call.begun and not call.future.set_running_or_notify_cancel():
                continue
            call.begun = True
            if not hand.alive():
                try:
                    hand.begin(self._context, self._folder)
                except Exception as error:  # such as: no process may be started from here
                    call.future.set_exception(error)
                    continue
            hand.calls.append(call)
            try:
                hand.pipe.send_bytes(call.content)
            except OSError:
                return  # it has just ended, which is heard next

    def _take(self, hand: _Hand) -> None:
        """Take what came of a call, or find that its process is lost."""
        try:
            found = hand.pipe.recv_bytes() if hand.pipe.poll() else None
        except (EOFError, OSError):
            found = None
        if found == READY:
            hand.ready = True
            return
        if found is None:
            if hand.process.is_alive() and not hand.pipe.poll():
                hand.process.join(0.05)  # the pipe is closed a moment before the end
            hand.end()
            lost, *others = hand.calls
            hand.calls.clear()
            for call in reversed(others):  # sent ahead, and not begun
                self._waiting.appendleft(call)
            lost.future.set_exception(hand.loss())
            return
        call = hand.calls.popleft()
        try:
            well, result = pickle.loads(found)
        except Exception as error:  # of a class that cannot be read back
            well, result = False, error
        (call.future.set_result if well else call.future.set_exception)(result)


class _Call:
    """A call, and what will come of it.

    Args:
        future: what will.
        content: function and arguments as bytes.

    Attributes:
        begun: whether it was sent to a process, and can no longer be cancelled.
    """

    def __init__(self, future: futures.Future[Any], content: bytes) -> None:
        self.future, self.content, self.begun = future, content, False


class _Hand:
    """One process and the calls that it was sent: that in hand, and perhaps the next.

    Attributes:
        ready: whether it has come so far as to wait for calls.
    """

    process: Any = None
    pipe: Connection
    ready = False

    def __init__(self) -> None:
        self.calls: deque[_Call] = deque()

    def alive(self) -> bool:
        return self.process is not None and self.process.is_alive()

    def begin(self, context: Any, folder: str) -> None:
        self.end()
        self.pipe, theirs = context.Pipe()
        # What IPython's `%reset` leaves of the module lacks what Python looks at here.
        vars(sys.modules["__main__"]).setdefault("__spec__", None)
        process = context.Process(target=_serve, args=(theirs, folder))
        process.start()
        self.process, self.ready = process, False
        theirs.close()

    def loss(self) -> Exception:
        """Return what the loss of its process says: in one that ends at once all others would."""
        code = self.process.exitcode
        if self.ready or code is None or code < 0:
            return LostProcessError(code)
        return SocialmindError(
            "a worker's process ended before it could begin (its error stands above). Each worker "
            "runs the script's file from its top; put what begins the work under "
            '`if __name__ == "__main__":`, or use workers=1'
        )

    def end(self) -> None:
        if self.process is not None:
            self.process.terminate()
            self.process.join(1.0)
            self.pipe.close()


def _end_all(hands: list[_Hand]) -> None:
    for hand in hands:
        if hand.process is not None:
            hand.process.terminate()
    for hand in hands:
        hand.end()
        hand.process = None


def _serve(pipe: Connection, folder: str) -> None:
    """Do one call after another, until there are no more."""
    _begin(folder)
    pipe.send_bytes(READY)
    while True:
        try:
            function, arguments, named = pickle.loads(pipe.recv_bytes())
        except (EOFError, OSError):
            return  # the process that gives out the work has ended
        try:
            answer = pickle.dumps((True, function(*arguments, **named)))
        except BaseException as error:
            error.add_note(traceback.format_exc())
            try:
                answer = pickle.dumps((False, error))
                pickle.loads(answer)
            except Exception:
                answer = pickle.dumps((False, RuntimeError(f"{type(error).__name__}: {error}")))
        with suppress(OSError):  # likewise
            pipe.send_bytes(answer)


def _begin(folder: str) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("ignore", CacheWarning)  # the process that gives out the work says so
    tempfile.tempdir = folder
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel, folder), daemon=True).start()


def _end_with(sentinel: int, folder: str) -> None:
    """End when the process that gives out the work has ended, however it did."""
    wait([sentinel])
    shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)
