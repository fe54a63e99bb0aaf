"""The tables of a fit, made of its searches alone."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from socialmind.experiments.calibration.finding import Found, surface_of
from socialmind.experiments.calibration.plan import DATA, FINAL, NEW, TRIAL, Plan
from socialmind.experiments.calibration.search import Search
from socialmind.experiments.calibration.target import SERIES, TICK

if TYPE_CHECKING:
    import pandas as pd

CELLS = 10
"""Equal pieces of a parameter's range, of which a profile tells the best trial."""
TRIALS, RECOVERY, PROFILES, BEST_RUNS = "trials", "recovery", "profiles", "best_runs"


def trials_table(plan: Plan, searches: Sequence[Search]) -> pd.DataFrame:
    """Return a row a trial.

    Columns: `search` (0 for the fit, else the recovery), `trial`, what varies, and `distance`,
    infinite where a run failed; `failed` runs, the first `error`; the distance of finalists once
    more, `final`; with `abc` the `weight` in the posterior's sample, 0 for who is not in it.
    """
    import pandas as pd

    rows = []
    for search in searches:
        sample = search.method.sample()
        weights = {}
        if sample is not None:
            weights = dict(zip(map(tuple, sample[0].tolist()), sample[1].tolist(), strict=True))
        finals = {one["number"]: one["distance"] for one in search.finals}
        for one in search.trials:
            values = dict(zip(plan.space.names, plan.space.values(one["place"]), strict=True))
            row = {"search": search.number, "trial": one["number"], **values}
            row |= {key: one[key] for key in ("distance", "failed", "error")}
            row["final"] = finals.get(one["number"], math.nan)
            if sample is not None:
                row["weight"] = weights.get(tuple(one["place"]), 0.0)
            rows.append(row)
    frame = pd.DataFrame(rows)
    return frame.astype({"error": "string"})


def recovery_table(plan: Plan, found: Sequence[Found]) -> pd.DataFrame:
    """Return a row for each recovery and parameter.

    Columns: `recovery`, `parameter`, the values `true` and `found`, their places in the range
    (`true_place`, `found_place`, 0 … 1), the interval `low`, `high` and whether it `covers` the
    truth, the `distance` of the best trial and the `luck` beyond which values are not plausible,
    and the `problem` of a recovery without result.
    """
    import pandas as pd

    rows = []
    for one in found:
        if one.truth is None:
            continue
        for n, dimension in enumerate(plan.space.dimensions):
            true = one.truth[n]
            value = math.nan if one.values is None else one.values[n]
            low, high = one.intervals[n] or (math.nan, math.nan)
            rows.append(
                {
                    "recovery": one.search,
                    "parameter": dimension.name,
                    "true": float(true),
                    "found": float(value),
                    "true_place": dimension.place(true),
                    "found_place": math.nan if one.values is None else dimension.place(value),
                    "low": float(low),
                    "high": float(high),
                    "covers": bool(low <= true <= high),
                    "distance": one.distance,
                    "luck": one.luck,
                    "problem": one.problem,
                }
            )
    columns = (
        "recovery parameter true found true_place found_place low high covers distance luck problem"
    )
    frame = pd.DataFrame(rows, columns=columns.split())
    return frame.astype({"problem": "string", "parameter": "string"})


def profiles_table(plan: Plan, search: Search, luck: float) -> pd.DataFrame:
    """Return a row for each parameter and piece of its range.

    Columns: the piece, `from` and `to`; the `trials` of the fit there, the `distance` of the best
    of them and its `value`, NaN where there was none; and the `smooth` distance in its middle, of
    the surface through all trials, the other parameters being as good as they can be.
    """
    import pandas as pd

    places = np.array([one["place"] for one in search.trials])
    distances = np.array([one["distance"] for one in search.trials])
    surface = surface_of(search, luck)
    rows = []
    for n, dimension in enumerate(plan.space.dimensions):
        middles = (np.arange(CELLS) + 0.5) / CELLS
        smooth = np.full(CELLS, math.nan)
        if surface is not None:
            smooth = np.sqrt(np.maximum(np.interp(middles, *surface.profile(n)), 0.0))
        cells = np.minimum((places[:, n] * CELLS).astype(int), CELLS - 1)
        for cell in range(CELLS):
            inside = np.flatnonzero(cells == cell)
            best = inside[distances[inside].argmin()] if len(inside) else None
            rows.append(
                {
                    "parameter": dimension.name,
                    "from": float(dimension.value(cell / CELLS)),
                    "to": float(dimension.value((cell + 1) / CELLS)),
                    "trials": len(inside),
                    "value": math.nan if best is None else float(dimension.value(places[best, n])),
                    "distance": math.nan if best is None else distances[best],
                    "smooth": smooth[cell],
                }
            )
    return pd.DataFrame(rows)


def best_runs_table(plan: Plan, search: Search) -> pd.DataFrame:
    """Return what the data speak of, as it is in the runs at the best trial on new seeds.

    Columns: `run`, `seed`, of a series `tick`, and the data's; runs that failed are not in it.
    """
    import pandas as pd

    frames = []
    records = [] if search.new is None else search.new["runs"]
    for run, found in enumerate(records):
        if found is None:
            continue
        frame = pd.DataFrame(found, columns=list(plan.target.columns), dtype=float)
        if plan.target.kind == SERIES:
            frame.insert(0, TICK, plan.target.ticks)
        frame.insert(0, "seed", plan.seeds_of(0, NEW)[run])
        frame.insert(0, "run", run)
        frames.append(frame)
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame({"run": []})


def seeds_in_use(plan: Plan) -> dict[str, set[int]]:
    """Return the seeds of the fit, of the recoveries, and of what is reported of the best."""
    trials = [(kind, number) for kind in (TRIAL, FINAL) for number in range(plan.trials)]

    def used(search: int, *purposes: tuple[str, int]) -> set[int]:
        return {seed for kind, n in purposes for seed in plan.seeds_of(search, kind, n)}

    others = [used(n, (DATA, 0), (NEW, 0), *trials) for n in range(1, plan.recover + 1)]
    reported = used(0, (NEW, 0))
    return {"fit": used(0, *trials), "recovery": set().union(*others), "reported": reported}


def parquet(frame: pd.DataFrame) -> bytes:
    """Return the bytes of a table's file, the same for the same table."""
    stream = io.BytesIO()
    frame.to_parquet(stream, index=False, compression="zstd")
    return stream.getvalue()
