"""One run of a sweep, in memory: begun at a point with a seed, ticked, recorded and measured."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.measures.of_runs import AMeasure, Recorded, of_series
from socialmind.experiments.sweeps.points.settings import Settings
from socialmind.interventions.following import after_those_at, next_after
from socialmind.runs.folders import FAILED, FINISHED
from socialmind.sources.folders import file_of_class
from socialmind.sources.loading import failure_in_model
from socialmind.work.workers import Stopped, never

if TYPE_CHECKING:
    from socialmind.interventions.shock import Shock
    from socialmind.model import Model

TIMED_OUT = "timed_out"
PIECE_SECONDS = 0.1
"""After about so long of ticks a run looks whether it is to stop, or has had its time."""
BRIEF_SECONDS = 0.001
"""Pieces shorter than this are done without a copy of the state, which would take as long."""

Columns = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Common:
    """What all runs of a sweep have in common.

    Attributes:
        model_class: the model.
        settings: what a point sets.
        ticks: length of a run.
        every: ticks between two rows of the series.
        keeps_series: whether the series goes into a table.
        agents_every: ticks between two records of the agents; 0 for the end alone, None for none.
        measures: by name.
        timeout: seconds that a run may take; None for any.
        compiled: whether rules run compiled.
        shocks: of every run, in order.
    """

    model_class: type[Model]
    settings: Settings
    ticks: int
    every: int
    keeps_series: bool
    agents_every: int | None
    measures: Mapping[str, AMeasure]
    timeout: float | None = None
    compiled: bool = True
    shocks: Sequence[Shock] = ()

    @property
    def samples(self) -> bool:
        """Whether the series is asked for before the end."""
        return self.keeps_series or any(of_series(one) for one in self.measures.values())

    def begin(self, seed: int, values: Sequence[Any]) -> Model:
        """Return the society of a run before its first tick.

        Args:
            seed: of the run.
            values: of the design's columns.
        """
        return self.model_class(
            seed=seed, compiled=self.compiled, **self.settings.arguments(values)
        )


@dataclass
class Outcome:
    """What a run came to.

    Attributes:
        run: its number.
        status: `FINISHED`, `FAILED` or `TIMED_OUT`.
        error: what went wrong, with the stage, in one line.
        ticks: how many were done.
        final: the last row of the series.
        measured: the measures, those that there are.
        series: the rows of the series, an array or list for each column, with `tick`.
        agents: the records of the agents, one for each recorded tick, with `tick`.
    """

    run: int
    status: str = FINISHED
    error: str | None = None
    ticks: int = 0
    final: Mapping[str, Any] = field(default_factory=dict)
    measured: dict[str, Any] = field(default_factory=dict)
    series: Columns | None = None
    agents: list[Columns] = field(default_factory=list)


class _TimeoutError(Exception):
    pass


class OneRun:
    """Does runs, one after another.

    Args:
        common: what they have in common.
        stop: asked now and then whether to drop the run in hand.
    """

    def __init__(self, common: Common, stop: Callable[[], bool] = never) -> None:
        self._common = common
        self._stop = stop
        self._piece = 1
        self._until = 0.0
        self._careful = False

    def done(self, run: int, seed: int, values: Sequence[Any]) -> Outcome:
        """Do a run, and return what it came to, whatever went wrong.

        Raises:
            Stopped: it is to be dropped.
        """
        self._until = time.perf_counter() + (self._common.timeout or 0.0)
        return self._done(run, seed, values, careful=False)

    def _done(self, run: int, seed: int, values: Sequence[Any], careful: bool) -> Outcome:
        """Do a run; one that fails where no copies were kept is repeated, to find the line."""
        common, outcome, stage, model = self._common, Outcome(run), "setup", None
        self._careful = careful
        try:
            model = common.begin(seed, values)
            stage = "run"
            seen = self._ticked(model, outcome)
            outcome.ticks = model.tick
            stage = "measure"
            for name, one in common.measures.items():
                outcome.measured[name] = one.value(seen)
            stage = "record"
            outcome.final = {name: plain(value) for name, value in seen.rows[-1].items()}
            if common.keeps_series:
                outcome.series = {"tick": np.array(seen.ticks, np.int64), **_columns(seen.rows)}
        except Stopped:
            raise
        except _TimeoutError:
            outcome = Outcome(run, TIMED_OUT, f"took longer than {common.timeout:g} s")
        except MemoryError:
            outcome = Outcome(run, FAILED, f"{stage}: not enough memory")
        except (Exception, SystemExit, KeyboardInterrupt) as error:
            if isinstance(error, KeyboardInterrupt) and self._stop():
                raise  # the user's, who presses Ctrl-C once more
            if stage == "run" and model is not None and not model.engine.careful:
                return self._done(run, seed, values, careful=True)
            outcome = Outcome(
                run, FAILED, f"{stage}: {in_one_line(error, common.model_class, model)}"
            )
            outcome.ticks = 0 if model is None else model.tick
        return outcome

    def _ticked(self, model: Model, outcome: Outcome) -> Recorded:
        """Let a society run to its end, and return what was seen of it."""
        common, seen = self._common, Recorded(model, [], [])
        steps = [common.every] if common.samples else []
        steps += [common.agents_every] if common.agents_every else []
        shocked = {one.tick for one in common.shocks}
        length, series_at, agents_at = common.ticks, -1, -1
        while True:
            tick = model.tick
            if model.stopped:
                length = tick
            over = tick >= length
            # A shock may end the society: what was recorded of its tick stays, as in a run.
            sampled = common.samples or tick in shocked
            if series_at != tick and (over or (sampled and tick % common.every == 0)):
                seen.ticks.append(tick)
                seen.rows.append(_row(model, common.model_class))
                series_at = tick
            if (
                common.agents_every is not None
                and agents_at != tick
                and (over or (common.agents_every and tick % common.agents_every == 0))
            ):
                columns = {name: _kept(one) for name, one in model.agents().items()}
                outcome.agents.append({"tick": tick, **columns})
                agents_at = tick
            if over:
                return seen
            after_those_at(model, common.shocks)
            stop = min(length, *(tick - tick % k + k for k in steps), length)
            self._advance(model, next_after(tick, common.shocks, stop))

    def _advance(self, model: Model, end: int) -> None:
        """Advance to a tick, in pieces: between two the run can be dropped."""
        while model.tick < end and not model.stopped:
            count = min(self._piece, end - model.tick)
            begin = time.perf_counter()
            model.advance(count)
            now = time.perf_counter()
            model.engine.careful = self._careful or now - begin > BRIEF_SECONDS
            if self._stop():
                raise Stopped
            if self._common.timeout is not None and now > self._until:
                raise _TimeoutError
            if count == self._piece and now - begin < PIECE_SECONDS / 4:
                self._piece *= 4
            elif now - begin > PIECE_SECONDS and count > 1:
                self._piece = max(1, count // 2)


def in_one_line(error: BaseException, model_class: type[Model], model: Model | None) -> str:
    """Return what went wrong in one line, with the place in the model's files.

    Args:
        error: what was raised.
        model_class: the model.
        model: the society; None where it was still being made.
    """
    doing = "its beginning" if model is None else f"the run at tick {model.tick}"
    if isinstance(error, SocialmindError) or type(error).__module__.startswith("coglogo_py"):
        said = str(error)
    else:
        said = str(failure_in_model(error, file_of_class(model_class), doing))
    return " ".join(said.split())


def _row(model: Model, model_class: type[Model]) -> Mapping[str, Any]:
    row = model.series()
    if not isinstance(row, Mapping):
        raise SocialmindError(
            f"{model_class.__name__}.series() gave {type(row).__name__}; expected a dictionary"
        )
    return row


def _columns(rows: Sequence[Mapping[str, Any]]) -> Columns:
    names = tuple(rows[0])
    for row in rows:
        if tuple(row) != names:
            raise SocialmindError(
                f"series() gave the columns {', '.join(row)} after {', '.join(names)}; "
                "give the same at every tick"
            )
    return {name: [row[name] for row in rows] for name in names if name != "tick"}


def _kept(column: Any) -> Any:
    return column.copy() if isinstance(column, np.ndarray) else list(column)


def plain(value: Any) -> Any:
    """Return a value of NumPy as Python's."""
    return value.item() if isinstance(value, np.generic) else value
