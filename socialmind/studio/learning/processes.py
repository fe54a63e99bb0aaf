"""Trainings begun, paused and resumed: by processes that somebody at a terminal could begin."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from socialmind.errors import SocialmindError
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.learning.training.pausing import pause
from socialmind.runs.folders import is_held
from socialmind.studio.learning.resuming import Command, resuming

OPTIONS = ("attempts", "seed", "generations", "lesson")
"""What of `socialmind learn` a page may set."""
ASKER = "the studio"
STOPPED = (128 + signal.SIGINT, 128 + signal.SIGTERM)
"""Exit codes of a training that was paused, or stopped by somebody."""


@dataclass
class _Process:
    """A training, as somebody at a terminal would have begun it."""

    popen: subprocess.Popen[bytes]
    said: IO[bytes]


class LearningProcesses:
    """Trainings that go on in processes of their own; any training can be paused, and resumed here.

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
        self._begin(folder, Command(["socialmind", "learn", model, *words, "--quiet"]))
        return folder

    def resume(self, folder: Path) -> None:
        """Let a training go on.

        Args:
            folder: the training's.

        Raises:
            SocialmindError: it goes on already, here or in another program; or nobody here knows
                its lessons.
        """
        if self._is_running(folder):
            raise SocialmindError(f"{folder.name} goes on already")
        if is_held(folder):
            raise SocialmindError(f"{folder.name} goes on in another program")
        command = resuming(folder, TrainingCapsule(folder).manifest)
        if command is None:
            raise SocialmindError(
                f"{folder.name}: its lessons were given in Python; go on with it where it was begun"
            )
        self._begin(folder, command)

    def pause(self, folder: Path) -> None:
        """Ask a training to pause at its next checkpoint, wherever it was begun on this machine.

        Args:
            folder: the training's.

        Raises:
            SocialmindError: it does not go on, or cannot be asked.
        """
        pause(folder, ASKER)

    def told(self, folder: Path) -> dict[str, Any]:
        """Return what is known here of a training.

        Args:
            folder: the training's.

        Returns:
            ``here``: whether its process is one of the studio's; and ``failure``: why its last
            process here ended by itself before its time, or None.
        """
        one = self._processes.get(folder)
        code = None if one is None else one.popen.poll()
        failed = one is not None and code not in (None, 0, *STOPPED)
        return {
            "here": one is not None and code is None,
            "failure": _last_line(one.said) if one is not None and failed else None,
        }

    def begun(self) -> list[Path]:
        """Return the folders of trainings that were begun or resumed here."""
        return list(self._processes)

    def end(self) -> None:
        """Stop all as Ctrl-C does: all but the generation in hand is safe."""
        for one in self._processes.values():
            if one.popen.poll() is None:
                with contextlib.suppress(ProcessLookupError):
                    one.popen.send_signal(signal.SIGINT)

    def _is_running(self, folder: Path) -> bool:
        one = self._processes.get(folder)
        return one is not None and one.popen.poll() is None

    def _begin(self, folder: Path, command: Command) -> None:
        # Closed with the process's record: a file without a name, read if the process fails.
        said = tempfile.TemporaryFile()  # noqa: SIM115
        popen = subprocess.Popen(
            [sys.executable, "-m", *command.words],
            cwd=command.folder or self._home,
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
    return (
        lines[-1].removeprefix("socialmind: ").removeprefix("error: ")
        if lines
        else "it ended without a word"
    )
