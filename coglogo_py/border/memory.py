"""How much memory the machine has, asked before arrays are made that it could not hold."""

from __future__ import annotations

import contextlib
import os
from functools import cache
from pathlib import Path

from coglogo_py.border.errors import CogLogoError

_CONTAINER = Path("/sys/fs/cgroup/memory.max")


@cache
def memory() -> int | None:
    """Return the bytes that this process may take in all; None where nobody says."""
    limits = []
    with contextlib.suppress(AttributeError, ValueError, OSError):
        limits.append(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    try:
        import resource

        soft, _ = resource.getrlimit(resource.RLIMIT_AS)
        if soft != resource.RLIM_INFINITY:
            limits.append(soft)
    except ImportError:
        pass
    with contextlib.suppress(OSError, ValueError):
        limits.append(int(_CONTAINER.read_text()))
    return min((one for one in limits if one > 0), default=None)


def check_memory(needed: int, what: str, error: type[Exception] = CogLogoError) -> None:
    """Refuse what needs more memory than there is.

    Args:
        needed: bytes.
        what: what needs them, as "1000 minds".
        error: what to raise.

    Raises:
        error: there is less.
    """
    there = memory()
    if there is not None and needed > there:
        raise error(
            f"{what} need about {_size(needed)} of memory; there is {_size(there)}; make fewer"
        )


def _size(count: int) -> str:
    """Return a number of bytes in words.

    >>> _size(3 * 10**9), _size(10**30)
    ('3 GB', '1e+18 TB')
    """
    for unit, size in (("TB", 10**12), ("GB", 10**9)):
        if count >= size:
            return f"{count / size:.3g} {unit}" if count < 10**300 else f"over 10**288 {unit}"
    return f"{count / 10**6:.3g} MB"
