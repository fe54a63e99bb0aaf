"""The learned ForageRole as a scheme again, and what is lost; beside the written and the evolved.

python -m analysis.foraging_roles.scheme_distillation [--quick]

A learned mind is watched while it decides, delivery after delivery, in the worlds for choosing. Of
all schemes with the cognitons of `scheme.yaml` the one is sought that would most probably have
decided so: what a robot was paid is known, so its callings are too, and a scheme gives each
decision a probability. (`socialmind.learning.distilling` fits links to what plans weigh in states
that are known; a learned mind has no callings that one could read.) `results/distilled_schemes.csv`
has the numbers, and how well they tell the decisions in worlds for reporting.

Then learned, distilled, evolved and written decide in the same worlds for reporting, a row of
`results/schemes.csv` for each way, attempt, condition and measure, a column for each world;
`results/schemes.md` has the means. What was judged already is not judged again.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.learning.optimisers.registry import optimiser_named

from . import scheme_evolution
from .contestants import Contestant
from .economy_worlds import counted_by_deliveries, worlds_of
from .large_groups import chosen
from .results import IN_THE_ECONOMY
from .scheme_economy import DECIDING, WRITTEN, SchemeWorlds, chance, numbers_of, reinforced
from .threshold_scan import CONTROLLERS
from .told_intervals import in_brackets, paired_interval, signed
from .trainings import ECONOMY
from .worlds import CHOOSING_ECONOMY, SCHEME_ECONOMY

RESULTS = Path(__file__).parent / "results"
LEAST = 1e-4
"""Of a probability: what a scheme excludes may be done by a learned mind all the same."""
GENERATIONS, SETTINGS = 60, {"population": 20, "step": 0.3}
WATCHED, FEW = 24, 4
DISTILLED, LEARNED = "distilled from", "learned"
KEYS = ["way", "attempt", "condition"]
MEASURES = ["within_one", "changes", "cost"]
LESSON = "worlds of the lesson"
CONDITIONS: Mapping[str, Mapping[str, Any]] = {LESSON: {}, **IN_THE_ECONOMY}

Floats = NDArray[np.float64]


class Decisions(NamedTuple):
    """What robots of the economy did, one delivery after the other; arrays (robots, deliveries).

    Attributes:
        is_b: whether they brought a B.
        payoff: what it was worth, 0 … 1.
        changed: whether they brought the other kind next.
        known: whether there was such a delivery, and another one after it.
    """

    is_b: NDArray[np.bool_]
    payoff: Floats
    changed: NDArray[np.bool_]
    known: NDArray[np.bool_]


def watched(one: Contestant, worlds: Sequence[int], ticks: int = ECONOMY.TICKS) -> Decisions:
    """Return what a learned mind decides in worlds of its lesson.

    Args:
        one: the robots.
        worlds: their seeds.
        ticks: of each.
    """
    found, minds = worlds_of(one, {}, worlds, ticks)
    decided, log = found.decided, []

    def noted(rows: Any, who: Any, before: Floats, payoff: Floats, minds: Any) -> Floats:
        robot = who[rows]
        fetched = getattr(found, "fetches_b", None)
        is_b = before[rows] >= 0.5 if fetched is None else fetched[rows, robot].copy()
        log.append(np.stack([rows * found.most + robot, is_b, payoff[rows]], axis=1))
        roles: Floats = decided(rows, who, before, payoff, minds)
        return roles

    found.decided = noted
    while found.go_on(minds):
        pass
    return in_rows(np.concatenate(log))


def in_rows(log: Floats) -> Decisions:
    """Return deliveries by robot: (deliveries, 3), robot, whether a B, payoff, in their order.

    >>> found = in_rows(np.array([[4, 0, 0.5], [7, 1, 0.5], [4, 1, 0.6], [4, 1, 0.7]]))
    >>> found.changed.tolist(), found.known.tolist()
    ([[True, False], [False, False]], [[True, True], [False, False]])
    """
    robots, place = np.unique(log[:, 0], return_inverse=True)
    order = np.argsort(place, kind="stable")
    place, log = place[order], log[order]
    number = np.arange(len(place)) - np.searchsorted(place, place)
    most = int(number.max()) + 1
    is_b, known = np.zeros((2, len(robots), most), bool)
    payoff = np.full((len(robots), most), DECIDING.AS_IT_SHOULD_BE)
    is_b[place, number], payoff[place, number] = log[:, 1] > 0, log[:, 2]
    known[place, number] = True
    both = known[:, 1:] & known[:, :-1]
    changed = both & (is_b[:, 1:] != is_b[:, :-1])
    return Decisions(is_b[:, :-1], payoff[:, :-1], changed, both)


def chances(numbers: Floats, seen: Decisions) -> Floats:
    """Return how probable a scheme holds a change after each delivery, (robots, deliveries).

    Args:
        numbers: (8,), in the order of `WRITTEN`.
        seen: what the robots were paid, and did.
    """
    given = dict(zip(WRITTEN, numbers, strict=True))
    links = {
        name: np.array([given[f"{name}_a"], given[f"{name}_b"]])
        for name in ("calling", "plenty_of", "reinforcement")
    }
    calling = np.full(len(seen.is_b), DECIDING.FIRST_CALLING)
    found = np.zeros(seen.payoff.shape)
    for number in range(seen.payoff.shape[1]):
        is_b, payoff = seen.is_b[:, number], seen.payoff[:, number]
        kind = is_b.astype(int)
        calling = reinforced(calling, payoff, links["reinforcement"][kind])
        lack = DECIDING.PERCENT * (DECIDING.AS_IT_SHOULD_BE - payoff)
        own = links["calling"][kind] * calling
        other = links["plenty_of"][kind] * np.maximum(lack, 0.0)
        changes = chance(own, other, is_b, np.asarray(given["bias"]))
        found[:, number] = np.where(lack > given["tolerance"], changes, 0.0)
        calling = np.where(seen.changed[:, number], DECIDING.FIRST_CALLING, calling)
    return found


def likelihood(found: Floats, seen: Decisions) -> float:
    """Return the mean logarithm of the probability of what was decided, in nats a delivery."""
    right = np.where(seen.changed, found, 1.0 - found)
    return float(np.log(np.clip(right[seen.known], LEAST, 1.0)).mean())


def told_apart(found: Floats, seen: Decisions) -> float:
    """Return how often a decision to change has the higher chance of it than one to stay.

    It is the area under the ROC curve: 0.5 by luck, 1 at best; NaN where nobody changed.
    """
    values, changed = found[seen.known], seen.changed[seen.known]
    if not changed.any() or changed.all():
        return float("nan")
    ranks = pd.Series(values).rank().to_numpy()
    ones = int(changed.sum())
    return float((ranks[changed].sum() - ones * (ones + 1) / 2) / (ones * (len(values) - ones)))


def paid_well(seen: Decisions) -> float:
    """Return the share of changes after a payoff of 0.5 or more, which a scheme never makes."""
    well = seen.changed & (seen.payoff >= DECIDING.AS_IT_SHOULD_BE)
    return float(well.sum() / seen.changed.sum()) if seen.changed.any() else float("nan")


def distilled(seen: Decisions, generations: int = GENERATIONS, seed: int = 0) -> Floats:
    """Return the numbers of the scheme that would most probably have decided so, (8,)."""
    search = optimiser_named("CMAES")(len(WRITTEN), seed, SETTINGS, np.zeros((1, len(WRITTEN))))
    for _ in range(generations):
        genomes = search.ask()
        search.tell([likelihood(chances(numbers_of(one), seen), seen) for one in genomes])
    return numbers_of(search.best)


def distil_all(path: Path) -> pd.DataFrame:
    """Distil all learned minds that are not distilled yet, and keep each."""
    table = pd.read_csv(path) if path.is_file() else pd.DataFrame(columns=["way", "attempt"])
    done = set(table[["way", "attempt"]].itertuples(index=False, name=None))
    for one in learned():
        if (one.way, one.attempt) in done:
            continue
        numbers = distilled(watched(one, CHOOSING_ECONOMY[:WATCHED]))
        seen = watched(one, SCHEME_ECONOMY)
        share = seen.changed.sum() / seen.known.sum()
        best_constant = share * np.log(share) + (1 - share) * np.log1p(-share) if share else 0.0
        row = {
            "way": one.way,
            "attempt": one.attempt,
            "changed": share,
            "paid_well": paid_well(seen),
            "told_apart": told_apart(chances(numbers, seen), seen),
            "likelihood": likelihood(chances(numbers, seen), seen),
            "by_share": best_constant,
            **dict(zip(WRITTEN, numbers.tolist(), strict=True)),
        }
        more = pd.DataFrame([row])
        table = pd.concat([table, more], ignore_index=True) if len(table) else more
        path.parent.mkdir(parents=True, exist_ok=True)
        table.to_csv(path, index=False, float_format="%.8g", lineterminator="\n")
        print(one.way, one.attempt, file=sys.stderr, flush=True)
    return table


def learned() -> Iterator[Contestant]:
    """Yield the learned minds."""
    for one in chosen():
        if "programmed" not in one.parameters and one.way not in CONTROLLERS:
            yield one


# In the same worlds -------------------------------------------------------------------------------


def entrants(table: pd.DataFrame) -> Iterator[tuple[str, int, Contestant | Floats]]:
    """Yield who decides: its way, its attempt, and a learned mind or the numbers of a scheme.

    Args:
        table: the distilled schemes.
    """
    yield "written", 0, np.array(list(WRITTEN.values()))
    for attempt, numbers in scheme_evolution.kept().items():
        yield scheme_evolution.NAME, attempt, numbers
    for one in learned():
        yield one.way, one.attempt, one
        row = table[(table["way"] == one.way) & (table["attempt"] == one.attempt)]
        if len(row):
            yield f"{DISTILLED} {one.way}", one.attempt, row[list(WRITTEN)].to_numpy(float)[0]


def judged(one: Contestant | Floats, condition: str, worlds: Sequence[int]) -> pd.DataFrame:
    """Return what robots come to in the economy, a row for each world."""
    terms = ECONOMY.Terms(**CONDITIONS[condition])
    if isinstance(one, Contestant):
        found, minds = worlds_of(one, CONDITIONS[condition], worlds, ECONOMY.TICKS)
    else:
        drawn = [ECONOMY.World(seed, terms, ECONOMY.TICKS) for seed in worlds]
        schemes = SchemeWorlds(drawn, worlds, np.atleast_2d(one), ECONOMY.TICKS)
        found, minds = counted_by_deliveries(schemes), None
    while found.go_on(minds):
        pass
    return pd.DataFrame(
        {
            "world": list(worlds),
            "within_one": (found.out_last == 0).astype(int),
            "changes": found.late_changes(),
            "cost": ECONOMY.Worlds.costs(found, terms),
        }
    )


def write(found: pd.DataFrame, path: Path) -> None:
    """Write what was judged, a row for each measure and a column for each world."""
    rows = [
        {**dict(zip(KEYS, key, strict=True)), "measure": name,
         **dict(zip(part["world"], part[name].map("{:.6g}".format), strict=True))}
        for key, part in found.groupby(KEYS, sort=False)
        for name in MEASURES
    ]  # fmt: skip
    path.parent.mkdir(parents=True, exist_ok=True)
    pd.DataFrame(rows).to_csv(path, index=False, lineterminator="\n")


def read(path: Path) -> pd.DataFrame:
    """Return what was judged, a row for each way, attempt, condition and world."""
    parts = []
    for key, part in pd.read_csv(path).groupby(KEYS, sort=False):
        own = part.set_index("measure").drop(columns=KEYS).T[MEASURES].rename_axis(columns=None)
        worlds = own.index.astype(int)
        parts.append(
            own.reset_index(drop=True).assign(world=worlds, **dict(zip(KEYS, key, strict=True)))
        )
    return pd.concat(parts, ignore_index=True)[[*KEYS, "world", *MEASURES]]


def judge_all(path: Path, table: pd.DataFrame, worlds: Sequence[int]) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it."""
    found = read(path) if path.is_file() else pd.DataFrame(columns=[*KEYS, "world"])
    found = found[found["world"].isin(worlds)]  # of others nothing is told
    done = set(found[KEYS].itertuples(index=False, name=None))
    for way, attempt, one in entrants(table):
        rows = [
            judged(one, condition, worlds).assign(way=way, attempt=attempt, condition=condition)
            for condition in CONDITIONS
            if (way, attempt, condition) not in done
        ]
        if rows:
            found = pd.concat([found, *rows] if len(found) else rows, ignore_index=True)
            found = found[[*KEYS, "world", *MEASURES]]
            write(found, path)
            print(way, attempt, file=sys.stderr, flush=True)
    return found


def report(found: pd.DataFrame) -> str:
    """Return the share of worlds within one by way and condition, as Markdown.

    Changes, and costs with the terms of `supervised_role`, are those of the first condition. All
    are counted by what robots bring home, also where a lesson counts roles.
    """
    conditions = [one for one in CONDITIONS if one in set(found["condition"])]
    lines = [
        "| way | attempts | " + " | ".join(conditions) + " | changes | cost |",
        "|---" * (len(conditions) + 4) + "|",
    ]
    for way, part in found.groupby("way", sort=False):
        by = dict(list(part.groupby("condition")))
        cells = [in_brackets(by[one], "within_one", ".0%") for one in conditions]
        cells += [in_brackets(by[conditions[0]], name, ".2f") for name in ("changes", "cost")]
        lines.append(f"| {way} | {part['attempt'].nunique()} | " + " | ".join(cells) + " |")
    tables = [lines, beside_written(found), beside_minds(found)]
    return "\n\n".join("\n".join(one) for one in tables) + "\n"


def beside_written(found: pd.DataFrame) -> list[str]:
    """Return how much more each way costs than the written scheme, in pairs of worlds."""
    part = found[found["condition"] == found["condition"].iloc[0]]
    written = part[part["way"] == "written"].set_index("world")["cost"]
    more = part.assign(more=part["cost"] - part["world"].map(written))
    lines = ["| way | attempts | costs more than the written scheme |", "|---|---|---|"]
    for way, rows in more[more["way"] != "written"].groupby("way", sort=False):
        lines.append(
            f"| {way} | {rows['attempt'].nunique()} | {in_brackets(rows, 'more', '.3f')} |"
        )
    return lines


def beside_minds(found: pd.DataFrame) -> list[str]:
    """Return how much more often distilled schemes stay within one than their minds, in pairs."""
    part = found[found["condition"] == found["condition"].iloc[0]]
    squares = {
        str(way): own.pivot(index="attempt", columns="world", values="within_one")
        for way, own in part.groupby("way", sort=False)
    }
    lines = ["| minds | attempts | distilled: more within one | less in |", "|---" * 4 + "|"]
    for way, square in squares.items():
        if (own := squares.get(f"{DISTILLED} {way}")) is not None:
            more = (own - square.loc[own.index]).to_numpy(float)
            less = int((more.mean(axis=1) < 0).sum())
            lines.append(f"| {way} | {len(own)} | {signed(paired_interval(more))} | {less} |")
    return lines


def main(arguments: Sequence[str]) -> None:
    """Distil, judge, keep and print."""
    if "--quick" in arguments:
        one = next(learned())
        seen = watched(one, CHOOSING_ECONOMY[:FEW], 8000)
        print(dict(zip(WRITTEN, distilled(seen, 3).round(3).tolist(), strict=True)))
        return
    table = distil_all(RESULTS / "distilled_schemes.csv")
    found = judge_all(RESULTS / "schemes.csv", table, SCHEME_ECONOMY)
    text = report(found)
    (RESULTS / "schemes.md").write_text(text, encoding="utf-8")
    print(table.round(3).to_string(), text, sep="\n\n")


if __name__ == "__main__":
    main(sys.argv[1:])
