"""The trainings that the studio lets go on: each in a process, which the command line could be."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from socialmind.errors import SocialmindError
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.runs.folders import is_held

OPTIONS = ("attempts", "seed", "generations", "lesson")
"""What of `socialmind learn` a page may set."""


@dataclass
class _Process:
    """`socialmind learn`, as somebody at a terminal would have begun it."""

    popen: subprocess.Popen[bytes]
    said: IO[bytes]
    pausing: bool = False


class LearningProcesses:
    """Trainings that go on in processes of their own, and are paused as by Ctrl-C.

    Args:
        home: the folder in which they are begun.
    """

    def __init__(self, home: Path) -> None:
        self._home = home
        self._processes: dict[Path, _Process] = {}

    def begin(self, model: str, options: Mapping[str, Any]) -> Path:
        """Begin a training of a model.

        Args:
            model: its name.
            options: of `OPTIONS`, those that are not as by default.

        Returns:
            The folder, which appears a moment later.
        """
        number = 1
        while (folder := self._home / TrainingCapsule.HOME / f"{model}-{number:03d}").exists():
            number += 1
        words = ["--out", str(folder)]
        for name in OPTIONS:
            value = options.get(name)
            if value not in (None, ""):
                words += [f"--{name}={value}"]
        self._begin(folder, [model, *words])
        return folder

    def resume(self, folder: Path) -> None:
        """Let a training go on.

        Args:
            folder: the training's.

        Raises:
            SocialmindError: it goes on already, here or in another program.
        """
        if self._running(folder) is not None:
            raise SocialmindError(f"{folder.name} goes on already")
        if is_held(folder):
            raise SocialmindError(f"{folder.name} goes on in another program")
        self._begin(folder, ["--resume", str(folder)])

    def pause(self, folder: Path) -> None:
        """Stop a training as Ctrl-C does: all but the generation in hand is safe.

        Args:
            folder: the training's.

        Raises:
            SocialmindError: it does not go on here.
        """
        one = self._running(folder)
        if one is None:
            raise SocialmindError(
                f"{folder.name} was not begun here; press Ctrl-C in the terminal where it was"
            )
        if not one.pausing:
            one.pausing = True
            one.popen.send_signal(signal.SIGINT)

    def told(self, folder: Path) -> dict[str, Any]:
        """Return what is known here of a training.

        Args:
            folder: the training's.

        Returns:
            ``here``: whether its process is one of the studio's; ``pausing``; and ``failure``: why
            its last process here ended by itself before its time, or None.
        """
        one = self._processes.get(folder)
        if one is None:
            return {"here": False, "pausing": False, "failure": None}
        code = one.popen.poll()
        failed = code not in (None, 0) and not one.pausing
        return {
            "here": code is None,
            "pausing": one.pausing and code is None,
            "failure": _last_line(one.said) if failed else None,
        }

    def begun(self) -> list[Path]:
        """Return the folders of trainings that were begun or resumed here."""
        return list(self._processes)

    def end(self) -> None:
        """Pause all."""
        for one in self._processes.values():
            if one.popen.poll() is None and not one.pausing:
                with contextlib.suppress(ProcessLookupError):
                    one.popen.send_signal(signal.SIGINT)

    def _running(self, folder: Path) -> _Process | None:
        one = self._processes.get(folder)
        return one if one is not None and one.popen.poll() is None else None

    def _begin(self, folder: Path, words: Sequence[str]) -> None:
        # Closed with the process's record: a file without a name, read if the process fails.
        said = tempfile.TemporaryFile()  # noqa: SIM115
        popen = subprocess.Popen(
            [sys.executable, "-m", "socialmind", "learn", *words, "--quiet"],
            cwd=self._home,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=said,
            # Ctrl-C in the studio's terminal is for the studio, which pauses what it began.
            start_new_session=True,
        )
        self._processes[folder] = _Process(popen, said)


def _last_line(said: IO[bytes]) -> str:
    said.seek(0)
    lines = said.read().decode("utf-8", "replace").strip().splitlines()
    return lines[-1].removeprefix("socialmind: ") if lines else "it ended without a word"
