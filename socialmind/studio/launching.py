"""Starting the studio: a port of this machine, and the browser."""

from __future__ import annotations

import socket
import threading
import webbrowser
from pathlib import Path
from typing import Any

import uvicorn

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.studio.server.access import LOOPBACK, new_token
from socialmind.studio.server.app import Studio
from socialmind.studio.server.folders import Folders

PORT = 8765


def launch(
    first: dict[str, Any] | None = None,
    host: str = "127.0.0.1",
    port: int | None = None,
    browser: bool = True,
) -> None:
    """Serve the studio until Ctrl-C.

    Args:
        first: the command by which the first page has something to show.
        host: where it listens; anything but this machine's own address asks for the token, which
            there only saving programs needs.
        port: to listen at; by default 8765, or a free one if that is taken.
        browser: whether to open the page.

    Raises:
        SocialmindError: it cannot listen there.
    """
    listening = _listening(host, port)
    found = listening.getsockname()[1]
    local = host in LOOPBACK
    token = new_token()
    hosts = LOOPBACK if local else (*LOOPBACK, host, socket.gethostname())
    shown = f"http://{'127.0.0.1' if local else host}:{found}/?token={token}"
    print(f"socialmind studio: {shown}   (Ctrl-C ends it)", flush=True)
    if browser:
        threading.Timer(0.5, webbrowser.open, (shown,)).start()
    studio = Studio(first, Folders(Path.cwd(), readable=tuple(catalogue().values())))
    config = uvicorn.Config(
        studio.application(hosts, token, local),
        log_level="error",
        ws="websockets-sansio",
        ws_per_message_deflate=False,  # packing a large frame takes longer than drawing it
    )
    uvicorn.Server(config).run(sockets=[listening])


def _listening(host: str, port: int | None) -> socket.socket:
    for one in (PORT, 0) if port is None else (port,):
        listening = socket.socket()
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, one))
        except OSError as error:
            listening.close()
            failure = error
        else:
            listening.listen(128)
            return listening
    raise SocialmindError(f"cannot listen at {host}:{port or PORT}: {failure.strerror}; try --port")
