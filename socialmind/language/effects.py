"""What functions do to populations, by themselves or through those they call."""

from __future__ import annotations

import ast
from collections.abc import Iterable


class Effects:
    """The populations that functions change, whose agents they let die, whose plans they carry out.

    They are noted while functions are typed, one within another: what the inner one does, the outer
    one does too.
    """

    def __init__(self) -> None:
        self._open: list[set[str]] = []
        self._of: dict[str, set[str]] = {}
        self._in_ticks: set[str] | None = None
        """What is reached, but for the setup's rules."""

    def begin(self) -> None:
        """Begin with a function."""
        self._open.append(set())

    def end(self, symbol: str) -> None:
        """End with it, under its symbol."""
        self._of[symbol] = self._open.pop()

    def begin_ticks(self) -> None:
        """Note from now on what is done in ticks: the setup is typed."""
        self._in_ticks = set()

    def in_ticks(self, symbol: str) -> None:
        """Note that ticks reach a function, unless the setup is being typed."""
        if self._in_ticks is not None:
            self._in_ticks |= self._of[symbol]

    def calls(self, symbol: str) -> None:
        """Note that a function that was typed is called: all it does is done."""
        for one in self._open:
            one |= self._of[symbol]

    def carries_out(self, population: str) -> None:
        """Note that plans of a population are carried out."""
        self._note(f"plans {population}")

    def bears(self, population: str) -> None:
        """Note that agents of a population are born."""
        self._note(f"bears {population}")

    def kills(self, population: str) -> None:
        """Note that agents of a population die."""
        self._note(f"kills {population}")

    def changes(self, population: str) -> None:
        """Note that fields of a population are written, or agents come or go."""
        self._note(f"changes {population}")

    def _note(self, effect: str) -> None:
        for one in self._open:
            one.add(effect)

    def come_and_go(self, population: str) -> bool:
        """Return whether agents of a population are born or die in ticks."""
        return bool((self._in_ticks or set()) & {f"bears {population}", f"kills {population}"})

    def may_kill(self, nodes: Iterable[ast.AST], population: str) -> bool:
        """Return whether agents of a population may die in what has been typed."""
        for node in (part for one in nodes for part in ast.walk(one)):
            mark = getattr(node, "mark", ("",))
            if mark[0] == "run_plan" or mark[:2] == ("die", population):
                return True
            called = getattr(getattr(node, "func", None), "id", None)
            if f"kills {population}" in self._of.get(str(called), ()):
                return True
        return False

    def carried_out_by(self, symbol: str, population: str) -> bool:
        """Return whether a function carries out plans of a population, or calls one that does."""
        return f"plans {population}" in self._of[symbol]

    def changed_by(self, symbol: str, population: str) -> bool:
        """Return whether a function changes agents of a population, or calls one that does."""
        return f"changes {population}" in self._of[symbol]
