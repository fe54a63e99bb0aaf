"""A run that goes on as somebody says, and back: from any tick to any other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from copy import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from socialmind.interventions.following import Intervention, begun_for, next_after
from socialmind.model import Model
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.capsule import Capsule
from socialmind.runs.execution import run
from socialmind.runs.sources import model_of
from socialmind.studio.running.turns import Turn, after_turns

STATES = 64
"""How many states are kept at most; each second one is dropped when there are more."""
ROOM = 256 * 2**20
"""Bytes that kept states may take."""


@dataclass(frozen=True)
class Kept:
    """A state to repeat from.

    Attributes:
        tick: of the state, before the interventions there.
        arrays: by name.
    """

    tick: int
    arrays: Mapping[str, NDArray[Any]]


class LiveRun:
    """A run of a model in memory, which can be gone back in.

    It is the run that the command line makes of the same model, seed, parameters and
    interventions, tick for tick: `save` makes it.

    Args:
        first: the society before its first tick.
        interventions: what is done to it on its way, in order.

    Attributes:
        society: as it is now.
        interventions: what was done to it, and what is to be done, in order.
    """

    def __init__(self, first: Model, interventions: Iterable[Intervention] = ()) -> None:
        self.society = self._first = first
        self.interventions: list[Intervention] = list(interventions)
        self.turns = 0
        """How many turns of the next tick are looked at."""
        self._met = 0
        """How many interventions the society has met."""
        self._kept: list[Kept] = []
        self._apart = 1
        self._furthest = 0
        self._keep()

    @classmethod
    def of_folder(cls, folder: str | Path) -> LiveRun:
        """Return the run that a folder holds, at tick 0.

        Raises:
            SocialmindError: no run's folder, or its model was changed since.
        """
        capsule = Capsule(folder)
        return cls(model_of(capsule), interventions_of(capsule))

    @property
    def tick(self) -> int:
        """Where the society stands."""
        return self.society.tick

    @property
    def furthest(self) -> int:
        """The last tick that it has been at, since something was last done to it."""
        return max(self.tick, self._furthest)

    @property
    def first(self) -> Model:
        """The society before its first tick, as it was given."""
        return self._first

    def turn(self) -> tuple[Model, Turn] | None:
        """Let one more agent have its turn, and return the society after it.

        After the last turn of a tick the society goes on to the next tick.

        Raises:
            SocialmindError: ticks of the model have no turns; a rule failed.
        """
        self._leave()
        found = after_turns(self.society, self.turns + 1)
        if found is None:
            self.advance(1)
        else:
            self.turns += 1
        return found

    def advance(self, ticks: int = 1) -> None:
        """Let it go on through the interventions that stand there.

        Args:
            ticks: at most; it may stop earlier.

        Raises:
            SocialmindError: a rule or an intervention failed.
        """
        self.turns = 0
        end = self.tick + ticks
        while self.tick < end and not self.society.stopped:
            self._leave()
            due = self.tick - self.tick % self._apart + self._apart
            stop = next_after(self.tick, self.interventions[self._met :], min(end, due))
            self.society.advance(stop - self.tick)
            if self.tick % self._apart == 0 and self.tick > self._kept[-1].tick:
                self._keep()

    def go_to(self, tick: int) -> None:
        """Go to a tick, before or ahead; the society is there as it was, or will be.

        Args:
            tick: 0 or more.
        """
        self._furthest = self.furthest
        self.turns = 0
        if tick < self.tick or any(self.tick < one.tick <= tick for one in self._kept):
            last = max((one for one in self._kept if one.tick <= tick), key=lambda one: one.tick)
            self.society = begun_for(copy(self._first), self.interventions, last.tick)
            self.society.restore(last.arrays)
            self._met = sum(one.tick < last.tick for one in self.interventions)
        self.advance(tick - self.tick)

    def before(self, tick: int) -> LiveRun:
        """Return the same run at an earlier tick, which goes on without this one.

        Args:
            tick: 0 or more, before this one.
        """
        other = copy(self)
        other._kept, other.interventions = list(self._kept), list(self.interventions)
        other.go_to(tick)
        return other

    def intervene(self, intervention: Intervention) -> None:
        """Do something to the society now; what lay ahead is forgotten.

        Args:
            intervention: at the tick where the society stands.

        Raises:
            SocialmindError: it failed; the society is as it was.
        """
        self.turns = 0
        before = self.society.state()
        try:
            self._leave()
            society = intervention.applied(self.society)
        except Exception:
            self.society.restore(before)
            raise
        self.society = society
        self.interventions[self._met :] = [intervention]
        self._met += 1
        self._furthest = self.tick
        self._kept = [one for one in self._kept if one.tick <= self.tick]

    def repeated(self) -> tuple[Model, list[Intervention]]:
        """Return the society anew, before its first tick, and what was done to it so far."""
        return self._first.fresh(), self.interventions[: self._met]

    def save(
        self,
        folder: str | Path | None = None,
        every: int | None = None,
        told: Callable[[int, int], None] | None = None,
    ) -> Path:
        """Make the run up to here as a folder of its own, by repeating it.

        Args:
            folder: to make; by default the next number under ``runs/``.
            every: ticks between two rows of the series.
            told: called with the ticks done and the length, about ten times a second.
        """
        scheme, hierarchy = self._first._given
        return run(
            type(self._first),
            self.tick,
            self._first.seed,
            self._first.parameter_values(),
            scheme,
            hierarchy,
            on_progress=told,
            every=every,
            out=folder,
            compiled=self._first.compiled,
            interventions=self.interventions[: self._met],
            progress=False,
        )

    def reset(self) -> None:
        """Go back to the start; whatever was done to the society is forgotten."""
        self.go_to(0)
        self.interventions.clear()
        self._met = self._furthest = 0
        self._kept = self._kept[:1]

    def death_of(self, population: str, agent: int, since: int) -> int | None:
        """Return the tick at which an agent was no more, by repeating the run.

        Args:
            population: of the agent.
            agent: its identity.
            since: a tick at which it lived, before this one.

        Returns:
            None if it lives now, or did not live then.
        """
        if since >= self.tick:
            return self.tick
        other = self.before(since)
        while other.tick < self.tick and other.society.tables[population].contains(agent):
            other.advance(1)
        lives = other.society.tables[population].contains(agent)
        return None if lives or other.tick == since else other.tick

    def _leave(self) -> None:
        """Meet the interventions that stand at this tick."""
        while self._met < len(self.interventions):
            one = self.interventions[self._met]
            if one.tick != self.tick:
                return
            self.society = one.applied(self.society)
            self._met += 1

    def _keep(self) -> None:
        self._kept.append(Kept(self.tick, self.society.state()))
        size = sum(array.nbytes for array in self._kept[-1].arrays.values())
        if len(self._kept) > max(2, min(STATES, ROOM // max(size, 1))):
            # The first stays: tick 0 is a multiple of all.
            self._apart *= 2
            self._kept = [one for one in self._kept if one.tick % self._apart == 0]
