"""Processes that do a part of the work: Ctrl-C is not for them, and they end with this one."""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
import threading
import warnings
from concurrent.futures import Executor, ProcessPoolExecutor
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait

from coglogo_py.compiled.code_folder import CacheWarning


def pool(count: int, folder: str) -> ProcessPoolExecutor:
    """Return so many processes.

    Args:
        count: how many.
        folder: for what they write for a while; they remove it if this process is killed, and
            cannot itself.
    """
    return ProcessPoolExecutor(count, get_context("spawn"), _begin, (folder,))


def dismiss(executor: Executor) -> None:
    """Let processes go at once, whatever they are at."""
    running = list((getattr(executor, "_processes", None) or {}).values())
    executor.shutdown(wait=False, cancel_futures=True)
    for one in running:
        one.terminate()
    for one in running:
        one.join(1.0)


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
