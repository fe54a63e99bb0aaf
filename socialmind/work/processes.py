"""Processes that do a part of the work: Ctrl-C is not for them, and they end with this one."""

from __future__ import annotations

import os
import shutil
import signal
import threading
import warnings
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from typing import Any

from coglogo_py.compiled.code_folder import CacheWarning


def pool(
    count: int,
    begin: Callable[..., None] | None = None,
    arguments: tuple[Any, ...] = (),
    folder: str | None = None,
) -> ProcessPoolExecutor:
    """Return so many processes.

    Args:
        count: how many.
        begin: called in each of them at first.
        arguments: what it is called with.
        folder: a temporary folder that they remove if this process is killed, and cannot itself.
    """
    given = begin, arguments, folder
    return ProcessPoolExecutor(count, get_context("spawn"), _begin, given)


def dismiss(executor: Executor) -> None:
    """Let processes go at once, whatever they are at."""
    running = list((getattr(executor, "_processes", None) or {}).values())
    executor.shutdown(wait=False, cancel_futures=True)
    for one in running:
        one.terminate()
    for one in running:
        one.join(1.0)


def _begin(
    begin: Callable[..., None] | None, arguments: tuple[Any, ...], folder: str | None
) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("ignore", CacheWarning)  # the process that gives out the work says so
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel, folder), daemon=True).start()
    if begin is not None:
        begin(*arguments)


def _end_with(sentinel: int, folder: str | None) -> None:
    """End when the process that gives out the work has ended, however it did."""
    wait([sentinel])
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)
