"""The process of a stage: commands come in, and what is said and frames go out.

Commands are JSON objects with a key ``do``; what is sent is JSON with a key ``said``, or a frame
behind one byte.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.studio.running.commands import changing, going, looking, making
from socialmind.studio.running.stage import Stage

COMMANDS: Mapping[str, Callable[..., None]] = {
    "setup": making.setup,
    "open": making.open_run,
    "reset": making.reset,
    "act": making.act,
    "save": making.save,
    "copy": making.copy,
    "go": going.go,
    "pause": going.pause,
    "step": going.step,
    "turn": going.turn,
    "pace": going.pace,
    "go_to": going.go_to,
    "join": looking.join,
    "seen": looking.seen,
    "show": looking.show,
    "watch": looking.watch,
    "trace": looking.trace,
    "plots": looking.plots,
    "table": looking.table,
    "suppose": looking.suppose,
    "press": changing.press,
    "set": changing.set_parts,
    "edit": changing.edit,
    "steer": changing.steer,
    "imprint": changing.imprint,
    "rescheme": changing.rescheme,
}


def obey(stage: Stage, command: Mapping[str, Any]) -> None:
    """Carry out a command; what is wrong with it is said."""
    name = str(command.get("do"))
    try:
        if name not in COMMANDS:
            raise SocialmindError(f"no command {name!r}")
        COMMANDS[name](stage, **{key: value for key, value in command.items() if key != "do"})
    except (SocialmindError, TypeError, ValueError) as error:
        stage.stand()
        stage.say("error", of=name, text=str(error))


def perform(connection: Connection) -> None:
    """Be a stage until the other end of a connection closes.

    Args:
        connection: for commands in, and what is sent out.
    """
    stage = Stage(connection.send_bytes)
    wait: float | None = None
    try:
        while True:
            while connection.poll(wait):
                obey(stage, json.loads(connection.recv_bytes()))
                wait = 0.0
            wait = stage.go_on()
    except (EOFError, BrokenPipeError, ConnectionResetError, KeyboardInterrupt):
        return
