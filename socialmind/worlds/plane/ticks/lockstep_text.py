"""Many worlds of one model, run in lockstep by compiled code, as text.

Each lane runs one episode after another: it begins from the world before its setup, under the
episode's seed, and ends at an interruption or the limit of ticks. Between the sensors and the
schedule the minds of all lanes are evaluated together.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from socialmind.compiling.layout import dtype_text
from socialmind.worlds.plane.ticks.stages import PlaneProgram
from socialmind.worlds.plane.ticks.text import BUILD

LOCKSTEP = np.dtype(
    [
        (name, "i8")
        for name in (
            "lanes", "contexts", "jobs", "next", "job", "individual", "seed_0", "seed_1", "limit",
            "copies", "copy_begin", "score", "ticks", "ended", "genomes", "genome_size", "weights",
            "learner", "out", "failed",
        )
    ]
)  # fmt: skip
"""What compiled code knows of a batch of episodes. Addresses of int64: `contexts` (lanes) of the
models' records, `job` (lanes) the episode that each lane runs or -1, `individual`, `seed_0` and
`seed_1` (jobs), `copies` (…, 3) from, to and how many bytes, `copy_begin` (lanes + 1), `ticks` and
`ended` (jobs), `weights` (genome_size) places in the genome of a mind, `out` (tables, 2) where the
rows of each population of robots go and the bytes of an episode's. Of float64: `score` (jobs),
`genomes` (individuals, genome_size). `next` is the next job to begin, `learner` the number of the
population that learns, `failed` the job that failed or -1. In `out` the rows of a population are
those of all robots that have lived, by identity. Behind the tables stands where the models' records
go."""

_TEXT = """LOCKSTEP = DTYPE


@_inner
def _words(address, count):
    return carray(_as_pointer(address), (count,), np.int64)


@_inner
def _numbers(address, count):
    return carray(_as_pointer(address), (count,), np.float64)


@_inner
def _copy_bytes(source, target, count):
    read = carray(_as_pointer(source), (count,), np.uint8)
    write = carray(_as_pointer(target), (count,), np.uint8)
    for place in range(count):
        write[place] = read[place]


@_inner
def _world(work, lane):
    return carray(_as_pointer(_words(work.contexts, work.lanes)[lane]), (1,), MODEL)[0]


@_inner
def _begin_episode(work, lane, job):
    begin = _words(work.copy_begin, work.lanes + 1)
    copies = carray(_as_pointer(work.copies), (begin[work.lanes], 3), np.int64)
    for one in range(begin[lane], begin[lane + 1]):
        _copy_bytes(copies[one, 0], copies[one, 1], copies[one, 2])
    _model = _world(work, lane)
    rng = _stream(_model)
    rng.key_0 = _words(work.seed_0, work.jobs)[job]
    rng.key_1 = _words(work.seed_1, work.jobs)[job]
    individual = _words(work.individual, work.jobs)[job]
SEEDS
RENEW
SETUP
    _end_tick(_model)
BUILD

@_inner
def _learn_weights(work, state, first, count, individual):
    size = work.genome_size
    genome = _numbers(work.genomes + 8 * size * individual, size)
    weights = _words(work.weights, size)
    lanes = state.fresh.shape[1]
    for number in range(first, first + count):
        state.individual[number // lanes, number % lanes] = individual
        for place in range(size):
            state.genome[number // lanes, weights[place], number % lanes] = genome[place]


KEPT@_inner
def _end_episode(work, lane, job):
    _model = _world(work, lane)
    total = 0.0
    robots = 0
    out = carray(_as_pointer(work.out), (TABLES + 1, 2), np.int64)
SCORES
    size = out[TABLES, 1]
    _copy_bytes(_words(work.contexts, work.lanes)[lane], out[TABLES, 0] + job * size, size)
    _numbers(work.score, work.jobs)[job] = total / max(robots, 1)
    _words(work.ticks, work.jobs)[job] = _model._tick
    _words(work.ended, work.jobs)[job] = _model._over


@_inner
def _run_lanes(work, rounds):
    lane_job = _words(work.job, work.lanes)
    for _ in range(rounds):
        running = False
        for lane in range(work.lanes):
            if lane_job[lane] < 0 and work.next < work.jobs:
                work.failed = work.next
                lane_job[lane] = work.next
                work.next += 1
                _begin_episode(work, lane, lane_job[lane])
            if lane_job[lane] >= 0:
                running = True
                work.failed = lane_job[lane]
                _model = _world(work, lane)
                _before_minds(_model, _stream(_model))
        if not running:
            work.failed = -1
            return 0
        work.failed = -1
        _think_together(work)
        for lane in range(work.lanes):
            job = lane_job[lane]
            if job >= 0:
                work.failed = job
                _model = _world(work, lane)
                if _model._over == 0:
                    _after_minds(_model, _stream(_model))
                ended = _model._over != 0 or _model._tick + 1 >= work.limit
                _settle_rewards(_model, _stream(_model), ended)
KEEP
                _end_tick(_model)
                _model._tick += 1
                if ended:
                    _end_episode(work, lane, job)
                    lane_job[lane] = -1
    work.failed = -1
    return 1


@_inner
def _think_together(work):
    _model = _world(work, 0)
THINK
    return


@_kept_callback(__name__, "int64(int64, int64, int64)")
def run_lanes(address, rounds, nothing):
    \"\"\"Run all lanes for so many ticks; return 1 while there is more to do, 0, -1: failed.\"\"\"
    # One call alone: numba for Python 3.12 loses errors out of loops inside a `try`.
    try:
        result = _run_lanes(carray(_as_pointer(address), (1,), LOCKSTEP)[0], rounds)
    except Exception:
        return -1
    return result"""

_SEED = """    _minds_NAME(_model).counters[_kernel.SEED_LOW] = rng.key_0
    _minds_NAME(_model).counters[_kernel.SEED_HIGH] = rng.key_1
    if _scheme_NAME(_model).chances.shape[0] > 0:  # founders have what this seed gives them
        for place in range(_entries_NAME(_model)):
            mind = _entry_NAME(_model, place)._mind
            _kernel.draw_at_birth(_scheme_NAME(_model), _minds_NAME(_model), mind, -1)"""

_RENEW = """    mind = _record_NAME(_model)
    first = _model._NAME_first
    count = len(_rows_NAME(_model))
    for number in range(first, first + count):
        _keys(mind)[number, 0] = rng.key_0
        _keys(mind)[number, 1] = rng.key_1
        _call(mind.renew, _model._NAME_hierarchy, number, NEW_WORLD)
    _flow.start_instances(_structure_NAME(mind), _state_NAME(mind), first // count, mind.worlds)
    if work.learner == NUMBER and work.genome_size > 0:
        _learn_weights(
            work, _state_NAME(mind), first, count, individual
        )"""

_SCORE = """    _keep_NAME(work, _model, job)
    kept = _kept_NAME(work, _model, job)
    for identity in range(len(kept)):
        if kept[identity]._id >= 0:
            total += kept[identity].score
            robots += 1"""

_KEPT = """@_inner
def _kept_NAME(work, _model, job):
    out = carray(_as_pointer(work.out), (TABLES + 1, 2), np.int64)
    place = out[NUMBER, 0] + job * out[NUMBER, 1]
    return carray(_as_pointer(place), (len(_slot_of_NAME(_model)),), NAME_ROW)


@_inner
def _keep_NAME(work, _model, job):
    kept = _kept_NAME(work, _model, job)
    rows = _rows_NAME(_model)
    order = _order_NAME(_model)
    for place in range(_counters_NAME(_model)[_bookkeeping.ENTRIES]):
        agent = rows[order[place]]
        kept[agent._id] = agent


"""
"""The rows of all robots that have lived in an episode, by identity: of the dead as they were at
last, as others take their slots."""

_KEEP = """                counters = _counters_NAME(_model)
                if counters[_bookkeeping.ALIVE] != counters[_bookkeeping.ENTRIES]:
                    _keep_NAME(work, _model, job)"""

_THINK = """    mind = _record_NAME(_model)
    state = _state_NAME(mind)
    state.now[0] += 1
    if _call(mind.evaluate, _model._NAME_hierarchy, 0, len(state.fresh)) != 0:
        raise ValueError("a hierarchy could not be evaluated")"""


def lockstep_text(plane: PlaneProgram, deciding: Sequence[str]) -> str:
    """Return the functions that run many worlds.

    Args:
        plane: the typed devices.
        deciding: the populations with cogniton minds.

    Returns:
        The text; SETUP stands for the calls of the phases of the setup.
    """
    robots = dict(enumerate(plane.shape.robots))
    minded = {n: name for n, name in robots.items() if plane.shape.robots[name].hierarchy}

    def each(text: str, names: Mapping[int, str], nothing: str = "    pass") -> str:
        parts = [
            text.replace("NAME", name).replace("NUMBER", str(number))
            for number, name in names.items()
        ]
        return "\n".join(parts) or nothing

    fills = {
        "DTYPE": dtype_text(LOCKSTEP),
        "BUILD": BUILD,
        "SEEDS": each(_SEED, dict(enumerate(deciding))),
        "RENEW": each(_RENEW, minded),
        "KEPT": "".join(each(_KEPT, {n: name}) for n, name in robots.items()),
        "TABLES": str(len(robots)),
        "SCORES": each(_SCORE, robots),
        "KEEP": each(_KEEP, robots, "                pass"),
        "THINK": each(_THINK, minded),
    }
    text = _TEXT
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text
