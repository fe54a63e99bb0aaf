"""Stands for a check of programs that come with a file; see the branch that brings it."""

from collections.abc import Mapping


def remember(programs: Mapping[str, bytes]) -> None:
    """Note programs that the user has named or run."""


def require(programs: Mapping[str, bytes], trusted: bool, what: str) -> None:
    """Refuse programs that the user has neither named nor run, unless they are trusted."""
