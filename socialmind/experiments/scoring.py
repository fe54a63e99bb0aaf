"""How well the minds of a model do: its measures in many worlds that no training has seen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py.border.numbers import whole_number
from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError, nearest, written_at
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.lessons.keys import seeds_for
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of, mind_of
from socialmind.work.progress import progress_bar
from socialmind.work.workers import Alone, hired, workers_here
from socialmind.worlds.plane.devices.measures import Measure, survived, total

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.model import Model

SCORE = "score"
"""What these worlds' seeds are for. Learning draws its own for other words, so none is the same."""
COLLISION = "collision"
"""The interruption that `on_collision` is about."""
ENDS = ("end", "continue")
"""What a collision can do."""
PIECES = {"compiled": 128, "pymunk": 5}
"""How many episodes a worker takes at once at most: the compiled engine runs 64 side by side."""

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Score:
    """What minds came to in many worlds.

    Attributes:
        model: the model's name.
        ticks: how long all episodes lasted together.
        intervals: by measure, its mean over the episodes with its interval of 95 %; of a measure
            of several numbers, what is made of their means.
        frame: a row for each episode: `world`, the seed of `Model(seed=…)`; `ticks`; `over`, the
            interruption that ended it, or None; and the measures, NaN where an episode has none.
    """

    model: str
    ticks: int
    intervals: Mapping[str, Interval]
    frame: pd.DataFrame

    @property
    def episodes(self) -> int:
        """How many episodes there were."""
        return len(self.frame)

    def record(self) -> dict[str, Any]:
        """Return the score as JSON has it."""
        intervals = {name: one.record() for name, one in self.intervals.items()}
        return {"episodes": self.episodes, "ticks": self.ticks, **intervals}


def score(
    model_class: type[Model] | str | Path,
    mind: Any = None,
    episodes: int = 100,
    seed: int = 0,
    engine: str = "compiled",
    on_collision: str | None = None,
    ticks: int | None = None,
    parameters: Mapping[str, Any] | None = None,
    workers: int | None = None,
    on_progress: Progress | None = None,
    progress: bool | None = None,
) -> Score:
    """Measure minds in the worlds of a model.

    The worlds hang on the seed alone: other minds, models and engines meet the same ones. The score
    does not depend on how many work side by side.

    >>> found = score(Collect, "trainings/collect-001/mind-attempt-1")      # doctest: +SKIP
    >>> found.intervals["objects"]                                          # doctest: +SKIP
    Interval(mean=8.1, low=7.6, high=8.6)

    Args:
        model_class: a model on a plane: its class, name or folder.
        mind: the mind in place of the model's own: a folder, a YAML file or a `MindDescription`;
            for several populations a mapping.
        episodes: how many, each in a world of its own, 1 or more.
        seed: of the worlds, 0 or more.
        engine: "compiled", or "pymunk", the reference.
        on_collision: "end", or "continue": whether the interruption called "collision" is heeded;
            by default as the model has it.
        ticks: the limit of an episode; the model's own by default.
        parameters: values of the model's parameters that differ from the defaults.
        workers: how many work side by side; one for each processor by default.
        on_progress: called with the episodes done and their number, those of minds that measures
            are set against included.
        progress: whether a bar is drawn; by default in notebooks and on terminals, unless
            `on_progress` is given.

    Raises:
        SocialmindError: a model without a plane, or an argument out of range.
        ModelError: a mind that does not fit, or measures of what there is not.
    """
    model_class = load_model(model_class)
    if not model_class.shape.world.has_episodes:
        raise SocialmindError(
            f"the model {model_class.name} has no plane, so there are no episodes to score; "
            "expected one that declares world = Plane(…)"
        )
    engines = model_class.shape.world.engines
    if engine not in engines:
        raise SocialmindError(f"engine {engine!r}; {nearest(engine, engines)}")
    episodes = whole_number(episodes, "episodes", 1, None, SocialmindError)
    seed = whole_number(seed, "seed", 0, None, SocialmindError)
    count = workers_here(workers)
    measures = measures_of(model_class)
    options = {
        "parameters": dict(parameters or {}),
        "ticks": ticks,
        "physics": engine,
        "record": tuple(dict.fromkeys(name for one in measures.values() for name in one.records)),
        "without": _without(model_class, on_collision),
    }
    worlds = seeds_for(episodes, SCORE, seed)
    minds = _minds(measures, model_class.folder())
    runs: list[Columns] = []
    kind = f"score {model_class.name}"
    with progress_bar(progress, "episodes", kind, on_progress) as tell:
        for one in (mind, *minds):

            def report(done: int, _: int, before: int = len(runs) * episodes) -> None:
                if tell is not None:
                    tell(before + done, (1 + len(minds)) * episodes)

            runs.append(_run(_Task(model_class, one, options), worlds, count, report))
    return _score(model_class, measures, worlds, runs, minds, options)


def _minds(measures: Mapping[str, Measure], folder: Path) -> list[Any]:
    """Return the minds that measures are set against, each once; paths from the model's folder."""
    found: list[Any] = []
    for one in measures.values():
        mind = _standing_in(one, folder)
        if mind is not None and not any(mind is known or mind == known for known in found):
            found.append(mind)
    return found


def _standing_in(measure: Measure, folder: Path) -> Any:
    """Return the mind that a measure is set against."""
    mind = measure.mind
    if isinstance(mind, Mapping):
        return {k: folder / one if isinstance(one, str | Path) else one for k, one in mind.items()}
    return folder / mind if isinstance(mind, str | Path) else mind


def measures_of(model_class: type[Model]) -> dict[str, Measure]:
    """Return the measures that a model declares, or those that robots have anyway.

    Those are the objects `delivered`, where robots have such a field, the share of the run
    survived, and the collisions.
    """
    if model_class.measures:
        return dict(model_class.measures)
    there = model_class.shape.world.robots
    robots = next((name for name, one in there.items() if one.hierarchy), "")
    fields = model_class.shape.populations[robots].fields if robots else {}
    objects = {"objects": total("delivered")} if "delivered" in fields else {}
    return {**objects, "survived": survived(), "collisions": total("collisions")}


def _without(model_class: type[Model], on_collision: str | None) -> tuple[str, ...]:
    """Return the interruptions that are not heeded."""
    if on_collision is None:
        return ()
    if on_collision not in ENDS:
        raise SocialmindError(f"on a collision {on_collision!r}; {nearest(on_collision, ENDS)}")
    if COLLISION in model_class.interruptions:
        return (COLLISION,) if on_collision == "continue" else ()
    if on_collision == "end":
        raise SocialmindError(
            f"{model_class.name} has no interruption called {COLLISION!r} that could end a run; "
            f'give it interruptions = {{"{COLLISION}": collision()}}'
        )
    return ()


# Running ------------------------------------------------------------------------------------------

Columns = dict[str, np.ndarray[Any, Any]]


@dataclass(frozen=True, eq=False)
class _Task:
    """What episodes are run with."""

    model_class: type[Model]
    mind: Any
    options: Mapping[str, Any]

    def worker(self) -> _Worker:
        return _Worker(Episodes(self.model_class, hierarchy=self.mind, **self.options))

    def __reduce__(self) -> tuple[Any, ...]:
        # Minds travel as their files, which may stand elsewhere on another machine, or nowhere.
        given = self.mind if isinstance(self.mind, Mapping) else {"": self.mind}
        minds = {n: files_of(m) if isinstance(m, MindDescription) else m for n, m in given.items()}
        return _unpacked, (self.model_class, minds, dict(self.options))


def _unpacked(
    model_class: type[Model], minds: Mapping[str, Any], options: Mapping[str, Any]
) -> _Task:
    given = {name: mind_of(one) if isinstance(one, dict) else one for name, one in minds.items()}
    return _Task(model_class, given.get("", given), options)


@dataclass(frozen=True, eq=False)
class _Worker:
    """Runs the episodes of some worlds after another."""

    episodes: Episodes

    def stop(self) -> None:
        self.episodes.stopped = True

    def do(self, worlds: Sequence[int]) -> Columns:
        outcome = self.episodes.run(None, worlds)
        columns = {"ticks": outcome.ticks[0], "ended": outcome.ended[0]}
        for name, values in outcome.fields.items():
            column = np.empty(len(worlds), object)
            for place, value in enumerate(values[0]):
                # Of robots there are as many as have lived, in one episode more than in another.
                lived = outcome.lived.get(name)
                column[place] = value if lived is None else value[: lived[0, place]]
            columns[f"field {name}"] = column
        return columns


def _run(task: _Task, worlds: Sequence[int], workers: int, on_progress: Progress) -> Columns:
    """Run the episodes of all worlds, some side by side."""
    physics = task.worker().episodes.physics  # also says here what is wrong with the mind
    step = max(1, min(PIECES[physics], -(-len(worlds) // workers)))
    pieces = [worlds[begin : begin + step] for begin in range(0, len(worlds), step)]
    count = min(workers, len(pieces))
    done: list[Columns] = []
    with Alone() if count == 1 else hired(count, threads=physics == "compiled") as some:
        for columns in some.results(task, pieces):
            done.append(columns)
            on_progress(sum(len(one["ticks"]) for one in done), len(worlds))
    return {name: np.concatenate([one[name] for one in done]) for name in done[0]}


# Measuring ----------------------------------------------------------------------------------------


def _score(
    model_class: type[Model],
    measures: Mapping[str, Measure],
    worlds: Sequence[int],
    runs: Sequence[Columns],
    minds: Sequence[Any],
    options: Mapping[str, Any],
) -> Score:
    """Measure what minds came to.

    Args:
        model_class: the model.
        measures: by name.
        worlds: the seeds.
        runs: the episodes of the mind, then those of the minds that measures are set against.
        minds: these.
        options: what the episodes were run with.
    """
    import pandas as pd

    values = [_values(model_class, one, options) for one in runs]
    ended = pd.Series([one["over"] for one in values[0]], dtype=object)  # None stays None
    frame = pd.DataFrame({"world": worlds, "ticks": runs[0]["ticks"], "over": ended})
    intervals = {}
    for name, one in measures.items():
        numbers = np.array([_measured(name, one, row) for row in values[0]])
        own = numbers.shape[1]
        if one.mind is not None:
            mind = _standing_in(one, model_class.folder())
            place = next(n for n, known in enumerate(minds) if known is mind or known == mind)
            others = [_measured(name, one, row) for row in values[1 + place]]
            numbers = np.concatenate([numbers, np.array(others)], axis=1)

        def combined(*means: float, one: Measure = one, own: int = own) -> float:
            return one.combined(means[:own], means[own:])

        frame[name] = [combined(*row) for row in numbers.tolist()]
        alone = one.combine is None and one.mind is None
        intervals[name] = interval_of(numbers, combine=None if alone else combined)
    return Score(model_class.name, int(runs[0]["ticks"].sum()), intervals, frame)


def _values(
    model_class: type[Model], columns: Columns, options: Mapping[str, Any]
) -> list[dict[str, Any]]:
    """Return what measures may take, a dictionary for each episode."""
    names = [None, *model_class.interruptions]
    limit = options["ticks"] or model_class.ticks
    return [
        {
            "ticks": ticks,
            "limit": limit,
            "over": names[ended],
            **{name: columns[f"field {name}"][place] for name in options["record"]},
        }
        for place, (ticks, ended) in enumerate(
            zip(columns["ticks"].tolist(), columns["ended"].tolist(), strict=True)
        )
    ]


def _measured(name: str, measure: Measure, values: Mapping[str, Any]) -> tuple[float, ...]:
    try:
        return measure.parts(values)
    except (TypeError, ValueError, ArithmeticError) as error:
        raise ModelError(
            f"the measure {name!r}, which stopped with {type(error).__name__}: {error}",
            "a number",
            None,
            *written_at(measure.function),
        ) from error
