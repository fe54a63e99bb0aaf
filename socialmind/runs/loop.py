"""The loop of a run: its society goes from recorded tick to recorded tick, and what is due is done.

The loop advances the model to the next tick that is recorded, in pieces of at most about a
quarter of a second; between two pieces it reports progress, writes a checkpoint when one is due,
and sees whether the user wants to stop. What is computed never depends on where the pieces end.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.places import place as place_called
from socialmind.agents.agent_columns import as_before
from socialmind.agents.group_columns import group_instances, has_groups
from socialmind.errors import SocialmindError, written_at
from socialmind.interventions.change import Change
from socialmind.interventions.following import Intervention, after_those_at, next_after
from socialmind.interventions.shock import Shock
from socialmind.runs import continuing, folders, sources
from socialmind.runs.checkpoint import Checkpoint
from socialmind.runs.tables.growing import EventTable, GrowingTable
from socialmind.runs.tables.names import AGENTS, EVENTS, GROUPS, LINKS, SERIES, TABLES
from socialmind.sources.folders import file_of_class
from socialmind.sources.loading import failure_in_model
from socialmind.work.signals import deferred_signals

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.capsule import Capsule

Progress = Callable[[int, int], None]

CHUNK_SECONDS = 0.2
"""Length aimed at for one piece of the loop: Ctrl-C and progress wait for it."""
PROGRESS_SECONDS = 0.1
NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
CHECKPOINT_COST = 20
"""Checkpoints lie at least this many times their own cost apart."""
LONGEST_REST = 3600.0
"""Seconds that they lie apart at most, whatever they cost."""


class Interrupted(KeyboardInterrupt):
    """The user stopped a run; its capsule stands and can be gone on with.

    Args:
        folder: the run's.
        tick: ticks that are safe.
        signal_number: what stopped it.
    """

    def __init__(self, folder: Path, tick: int, signal_number: int) -> None:
        super().__init__(f"stopped at tick {tick:,}; resume({str(folder)!r}) goes on")
        self.folder = folder
        self.tick = tick
        self.signal_number = signal_number


def no_room(error: OSError, folder: Path, when: str) -> SocialmindError:
    """Return what to say of a disk that is full, or of a file that may not grow further."""
    return SocialmindError(
        f"{folder}: {os.strerror(error.errno or 0)} at {when}; what the last checkpoint holds is "
        "safe: make room and go on with --resume"
    )


class Execution:
    """One process's work on a run, from a checkpoint or the start to the last tick.

    Args:
        capsule: the run, held.
        model: its society, at the tick of the checkpoint or at the start.
        checkpoint: what it goes on from, if anything.
        started: when the work on it began, by `time.perf_counter`.
        interventions: all of the run, in order.
    """

    def __init__(
        self,
        capsule: Capsule,
        model: Model,
        checkpoint: Checkpoint | None,
        started: float,
        interventions: Sequence[Intervention] = (),
    ) -> None:
        self._capsule = capsule
        self._model = model
        self._interventions = interventions
        # A run that began without a table goes on without.
        names = checkpoint.parts if checkpoint else capsule.manifest.recorded or tables_of(model)
        self._every = capsule.manifest.steps(name for name in names if name != EVENTS)
        parts = checkpoint.parts if checkpoint else {}
        sums = checkpoint.sums if checkpoint else None
        # Another scheme may have other plans and cognitons, of which columns tell.
        changing = any(isinstance(one, Change) and one.schemes for one in interventions)
        self._tables = {
            name: GrowingTable(
                name, capsule.parts, parts.get(name, ()), _source_of(model, name), sums, changing
            )
            for name in self._every
        }
        self._events = None
        if EVENTS in names:
            model.keep_events()
            noted = model.event_log.populations
            self._events = EventTable(noted, capsule.parts, parts.get(EVENTS, ()), sums)
            self._tables[EVENTS] = self._events
        self._begun_with = None if changing else self._tables[AGENTS].columns
        self._first = next(iter(getattr(model, "populations", {})), None)
        self._recorded = dict(checkpoint.recorded) if checkpoint else dict.fromkeys(self._every, -1)
        self._loop_seconds = checkpoint.loop_seconds if checkpoint else 0.0
        self._started = started - (checkpoint.seconds if checkpoint else 0.0)

    def go(self, length: int, on_progress: Progress | None, checkpoint_every: float) -> None:
        """Run to the last tick and leave a finished capsule."""
        with deferred_signals() as arrived:
            try:
                self._loop(length, on_progress, checkpoint_every, arrived)
                continuing.finish(self._capsule, self._checkpoint())
            except Interrupted:
                raise
            except Exception as error:
                # The state is in mid-tick: the last checkpoint stays the truth.
                known = isinstance(error, SocialmindError | OSError)
                failure = error if known else self._failure(error)
                with suppress(OSError):  # there may be no room to say so
                    self._capsule.update(status=folders.FAILED, error=str(failure))
                if isinstance(error, OSError) and error.errno in NO_ROOM:
                    raise no_room(
                        error, self._capsule.folder, f"tick {self._model.tick}"
                    ) from error
                if known:
                    raise
                raise failure from error

    def _failure(self, error: Exception) -> SocialmindError:
        """An error of the model's own Python, with its place there."""
        path = file_of_class(type(self._model))
        return failure_in_model(error, path, f"the run at tick {self._model.tick}")

    def _loop(
        self, length: int, on_progress: Progress | None, checkpoint_every: float, arrived: list[int]
    ) -> None:
        chunk = 1
        clock = time.perf_counter
        report, checkpoint = _Timer(clock(), 0.0), _Timer(clock(), checkpoint_every)
        while True:
            tick = self._model.tick
            if self._model.stopped:
                length = tick
            self._record(tick, length)
            now = clock()
            if on_progress and (report.over(now) or tick >= length):
                on_progress(tick, length)
                report = _Timer(now, PROGRESS_SECONDS)
            if tick >= length:
                return
            if arrived:
                self._checkpoint(status=folders.INTERRUPTED)
                raise Interrupted(self._capsule.folder, tick, arrived[0])
            if checkpoint.over(now):
                self._checkpoint()
                rest = min(CHECKPOINT_COST * (clock() - now), LONGEST_REST)
                checkpoint = _Timer(clock(), max(checkpoint_every, rest))
            self._model = after_those_at(self._model, self._interventions)
            stop = min(length, *(tick - tick % k + k for k in self._every.values()))
            stop = next_after(tick, self._interventions, stop)
            count = min(stop - tick, chunk)
            begin = clock()
            self._model.advance(count)
            if self._events is not None:
                self._events.note(self._model.event_log.taken())
            elapsed = max(0.0, clock() - begin)  # some virtual machines set even this clock back
            self._loop_seconds += elapsed
            # A first chunk of one tick holds the compilation; growth by four finds the pace soon.
            rate = count / max(elapsed, 1e-9)
            chunk = max(1, min(int(rate * CHUNK_SECONDS), 4 * chunk))

    def _record(self, tick: int, length: int) -> None:
        """Take down what is due at this tick and not in the tables yet."""
        for name, every in self._every.items():
            if tick > self._recorded[name] and (tick % every == 0 or tick == length):
                columns: Any = self._columns(name)
                if name == SERIES and hasattr(columns, "items"):
                    columns = {column: [value] for column, value in columns.items()}
                elif (
                    name == AGENTS and self._begun_with is not None and isinstance(columns, Mapping)
                ):
                    columns = as_before(columns, self._begun_with, self._first)
                self._tables[name].add(tick, columns)
                self._recorded[name] = tick

    def _columns(self, name: str) -> Any:
        """Return what is recorded in a table now."""
        if name == GROUPS:
            return group_instances(self._model)
        if name == LINKS:
            from socialmind.networks.exchange import links_of_all

            return links_of_all(self._model)
        return self._model.series() if name == SERIES else self._model.agents()

    def _checkpoint(self, status: str = folders.RUNNING) -> Checkpoint:
        """Make everything up to now safe."""
        for table in self._tables.values():
            table.flush()
        idle = self._model.idle
        tick = self._model.tick
        checkpoint = Checkpoint(
            tick=tick,
            recorded={**self._recorded, **({EVENTS: tick} if self._events else {})},
            parts={name: list(table.parts) for name, table in self._tables.items()},
            idle={
                "count": idle.count,
                "first_agent": idle.first_agent,
                "first_tick": idle.first_tick,
            },
            loop_seconds=self._loop_seconds,
            seconds=max(0.0, time.perf_counter() - self._started),
            state=self._model.state(),
            sums={part: one for table in self._tables.values() for part, one in table.sums.items()},
            run=self._capsule.manifest.identity(),
        )
        checkpoint.save(self._capsule.checkpoint)
        model = sources.with_late_reads(self._capsule.manifest.model, type(self._model))
        changes = continuing.progress_fields(self._capsule.manifest, checkpoint)
        self._capsule.update(status=status, model=model, **changes)
        return replace(checkpoint, state={})  # a large society's state is not kept in memory


def tables_of(
    model: Any,
    links: bool | None = None,
    events: bool | None = None,
    interventions: Sequence[Intervention] = (),
) -> list[str]:
    """Return the names of the tables that a run of a model has.

    Args:
        model: the model.
        links: whether links are recorded; None, as the model says.
        events: whether births and deaths are; likewise.
        interventions: what is done to it, which may let agents be born or die.

    Raises:
        SocialmindError: links of a model without networks are asked for.
    """
    networks = bool(getattr(model, "networks", None))
    program = getattr(model, "program", None)
    shocked = any(isinstance(one, Shock) for one in interventions)
    eventful = program is not None and bool(program.eventful or shocked)
    if links and not networks:
        raise SocialmindError(f"links of {model.name}, which has no networks; leave them out")
    if links is None:
        links = networks and model.record_links
    if events is None:
        events = eventful and model.record_events
    further = {GROUPS: has_groups(model), LINKS: links, EVENTS: events and eventful}
    return [*TABLES, *(name for name, wanted in further.items() if wanted)]


class _Timer:
    """A time to wait, by a clock that some virtual machines set forth and back.

    Args:
        now: what the clock says.
        wait: seconds.
    """

    def __init__(self, now: float, wait: float) -> None:
        self._begin, self._wait = now, wait

    def over(self, now: float) -> bool:
        """Say whether the time is over, or the clock was set back and tells nothing of it."""
        return not 0.0 <= now - self._begin < self._wait


def _source_of(model: Model, name: str) -> str:
    """The method that gives a table's rows, with the file and line where it is written."""
    file, line = written_at(getattr(type(model), name, None))
    return f"{name}()" if file is None else f"{place_called(file, line)}: {name}()"
