"""Partners never met, other numbers of robots, arenas and ratios: in bodies, by what is brought.

python -m analysis.foraging_roles.generalisation                       # all, or gone on with
python -m analysis.foraging_roles.generalisation --worlds 40           # in more worlds
python -m analysis.foraging_roles.generalisation "thirty-six robots" programmed   # these alone
python -m analysis.foraging_roles.generalisation --quick

A row of `results/generalisation.csv` is a way to decide, an attempt, its partner if it has one, a
situation and a world; `results/generalisation.md` has the means, what each situation takes from or
gives to the same minds in the same worlds, and one way against another.
Focal robots are those that are asked about, the background their partners (Leibo et al. 2021,
Melting Pot). Worlds are those for reporting. What was judged already is not judged again.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.experiments.measures.intervals import Interval
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription

from . import choosing_again, scheme_evolution
from .contestants import PICKED, TICKS, Contestant
from .large_groups import chosen
from .minds import attempts_at, minds_of
from .scheme_economy import WRITTEN, scheme_of
from .told_intervals import held_against, in_brackets, paired_interval, signed
from .trainings import MODEL
from .worlds import REPORTED

ELSEWHERE = load_file(MODEL / "elsewhere.py")
RESULTS = Path(__file__).parent / "results"
WORLDS, FEW, SHORT = 10, 1, 3000
NINE, GAIN = 9, 4.0
ALONE, TURNED, SHARPLY = "", "ratio turned round", "thirty-six, told four times as sharply"
USUAL = "nine robots"
"""Nine robots of which 1:2 is wanted, among obstacles; other ratios and arenas are beside it."""
SITUATIONS: Mapping[str, Mapping[str, float]] = {
    USUAL: {},
    TURNED: {"reverse_at": TICKS // 2 - 1},
    "thirty-six robots": {"foragers": 36},
    SHARPLY: {"foragers": 36, "gain": GAIN},
    "eighteen robots": {"foragers": 18},
    "wanted 1:3": {"wanted_b": 3 / 4},
    "wanted 1:1": {"wanted_b": 1 / 2},
    "A twice as far": {"reach_a": 2.0, "half_width": 130.0},
    "both twice as far": {"reach_a": 2.0, "reach_b": 2.0, "half_width": 130.0},
    "no obstacles": {"cleared": 1},
}
"""Parameters of `ForagingElsewhere`. Told more sharply, a scheme tolerates a fourth, and thresholds
are a fourth, of what they are: the payoff that robots are told counts four times as much."""
COMPARED = ("wanted 1:1", "wanted 1:3", "A twice as far", "both twice as far", "no obstacles")
"""Other ratios and arenas, with as many robots."""
PAIRS = (
    (PICKED, 1, "programmed", 0),
    ("delivered_narrow", 1, "programmed", 0),
    ("supervised_role", 1, "programmed", 0),
    ("supervised_role", 1, "supervised_role", 3),
    ("delivered_narrow", 1, "supervised_role", 1),
    (PICKED, 1, "delivered_narrow", 1),
    ("delivered_narrow", 1, "delivered_role", 2),
    ("programmed", 0, "fixed_thresholds", 0),
    ("supervised_role", 3, "programmed", 0),
    ("delivered_narrow", 2, "supervised_role", 2),
)
"""Way and attempt of one and of the other, picked by what they come to alone: of deliveries those
that succeed. These, and those drawn by lot, are focal with three and with six of nine robots."""
AGAIN = choosing_again.NAME
LESSONS = ("delivered_anew", AGAIN)
EVOLVED = scheme_evolution.NAME
AGAINST = (
    *((way, EVOLVED) for way in (AGAIN, "delivered_anew", "supervised_role")),
    (AGAIN, "delivered_anew"),
    (AGAIN, "reinforced_thresholds"),
)
"""Ways, and those that they are held against."""
BY_LOT = (
    *((lesson, "programmed") for lesson in LESSONS),
    ("delivered_anew", "supervised_role"),
    (AGAIN, "delivered_anew"),
)
"""Ways of which `DRAWN` pairs each are made whose attempts are drawn."""
DRAWN, LOT = 3, 62
"""How many, and the seed of the draw."""
MET = (TURNED, USUAL)
"""The situations of pairs."""
SHARES = (3, 6)
KEYS = ["way", "attempt", "partner", "partner_attempt", "focal", "situation"]
RECORD = (
    "off_late", "last_beyond", "last_beyond_a_ninth", "began_at", "settled_at",
    "robots.changes_brought", "robots.delivered_a", "robots.delivered_b", "robots.stranger",
    "robots.programmed",
)  # fmt: skip


@dataclass(frozen=True)
class Society:
    """Robots in a situation.

    Attributes:
        focal: those that are asked about.
        partner: the background; None where all are focal.
        robots: how many are focal, of nine; counts for nothing without a partner.
        situation: one of `SITUATIONS`.
    """

    focal: Contestant
    partner: Contestant | None
    robots: int
    situation: str

    @property
    def key(self) -> tuple[str, int, str, int, int, str]:
        """What tells it from others, in the order of `KEYS`."""
        other = self.partner or Contestant(ALONE, 0)
        given = self.focal.way, self.focal.attempt, other.way, other.attempt
        return (*given, self.robots, self.situation)


def drawn_pairs() -> Iterator[tuple[str, int, str, int]]:
    """Yield pairs as those of `PAIRS` whose attempts are drawn by lot, none of a lesson twice.

    >>> [pair for pair in drawn_pairs() if pair[2] == "programmed"][0][0]
    'delivered_anew'
    """
    rng = np.random.default_rng(LOT)
    for way, other in BY_LOT:
        own = rng.permutation(attempts_at(way))[:DRAWN].tolist()
        others = [0] * DRAWN
        if other != "programmed":
            others = rng.permutation(attempts_at(other))[:DRAWN].tolist()
        for one, two in zip(own, others, strict=True):
            yield way, one, other, two


def societies() -> Iterator[Society]:
    """Yield all societies that are judged: pairs first, then each way alone in each situation."""
    known = {(one.way, one.attempt): one for one in chosen()}
    again = minds_of(AGAIN).items()
    known |= {(AGAIN, number): Contestant(AGAIN, number, mind) for number, mind in again}
    for met in MET:
        for way, attempt, other, other_attempt in (*PAIRS, *drawn_pairs()):
            for share in SHARES:
                pair = known[way, attempt], known[other, other_attempt]
                yield Society(*pair, share, met)
    for situation in SITUATIONS:
        for one in known.values():
            yield Society(one, None, NINE, situation)


def parameters_of(society: Society) -> tuple[dict[str, Any], MindDescription | None]:
    """Return the parameters of `ForagingElsewhere` that make a society, and its mind."""
    focal, partner = society.focal, society.partner
    given = dict(SITUATIONS[society.situation])
    share = society.robots / NINE
    if partner is None:
        own, mind = deciding(focal, given.get("gain", 1.0))
    elif is_programmed(focal):
        own, mind = deciding(partner, 1.0)
        own["programmed"] = share
    elif is_programmed(partner):
        own, mind = deciding(focal, 1.0)
        own["programmed"] = 1.0 - share
    else:
        own, mind = {"unlearned": 0, "strangers": share}, two_headed(partner, focal)
    return {**given, **own}, mind


def is_programmed(one: Contestant) -> bool:
    """Say whether a scheme decides in all robots."""
    return "programmed" in one.parameters


def deciding(one: Contestant, gain: float) -> tuple[dict[str, Any], MindDescription | None]:
    """Return the parameters, and the mind, by which robots decide that are all of one way.

    Args:
        one: the way.
        gain: how many times farther from 0.5 payoffs are told.
    """
    own = dict(one.parameters)
    if is_programmed(one):
        numbers = dict(WRITTEN)
        if one.way == scheme_evolution.NAME:
            evolved = scheme_evolution.kept()[one.attempt]
            numbers = dict(zip(WRITTEN, evolved.tolist(), strict=True))
            own["scheme"] = scheme_of(evolved)
        own["tolerance"] = numbers["tolerance"] / gain
    for name in ("lowest_threshold", "highest_threshold", "learning", "forgetting"):
        if name in own:
            own[name] /= gain
    return own, one.mind


def two_headed(first: Contestant, second: Contestant) -> MindDescription:
    """Return one mind for robots of two learned ways, the strangers of the second."""
    own = MindDescription.load(MODEL / "mind")
    mind: MindDescription = ELSEWHERE.two_headed(first.mind or own, second.mind or own)
    return mind


def judged(society: Society, worlds: Sequence[int], ticks: int = TICKS) -> pd.DataFrame:
    """Return what a society comes to, a row for each world.

    Args:
        society: the robots.
        worlds: their seeds.
        ticks: of a run.
    """
    parameters, mind = parameters_of(society)
    parameters["late"] = int(0.75 * ticks)
    episodes = Episodes(
        ELSEWHERE.ForagingElsewhere, parameters, hierarchy=mind, ticks=ticks, record=RECORD
    )
    fields = {name: values[0] for name, values in episodes.run(None, worlds).fields.items()}
    robots = int(parameters.get("foragers", NINE))
    rows = []
    for place, world in enumerate(worlds):
        seen = {name: values[place] for name, values in fields.items()}
        mine = focal_robots(society, seen)
        brought = seen["robots.delivered_a"] + seen["robots.delivered_b"]
        settled = seen["settled_at"] if seen["settled_at"] >= 0 else ticks
        row: dict[str, Any] = {
            "world": world,
            "robots": robots,
            "within_one": int(seen["last_beyond"][0] < 0.75 * ticks),
            "within_ninth": int(seen["last_beyond_a_ninth"] < 0.75 * ticks),
            "off": NINE * seen["off_late"] / (0.25 * ticks) / robots,
            "settled_after": int(settled - seen["began_at"]),
        }
        for name, those in (("focal", mine), ("background", ~mine)):
            changes = seen["robots.changes_brought"][those]
            row[f"{name}_changes"] = changes.mean() / ticks * 10_000 if those.any() else np.nan
            row[f"{name}_brought"] = brought[those].mean() if those.any() else np.nan
        rows.append(row)
    keys = dict(zip(KEYS, society.key, strict=True))
    return pd.DataFrame(rows).assign(**keys)[[*KEYS, *rows[0]]]


def focal_robots(society: Society, seen: Mapping[str, Any]) -> np.ndarray:
    """Return which robots of a world are focal."""
    programmed = np.asarray(seen["robots.programmed"], bool)
    if society.partner is None:
        return np.ones(len(programmed), bool)
    if is_programmed(society.focal):
        return programmed
    if is_programmed(society.partner):
        return ~programmed
    return np.asarray(seen["robots.stranger"], bool)


def judge_all(path: Path, some: Sequence[Society], worlds: Sequence[int]) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it after each."""
    table = read(path)
    for society in some:
        known = set(table.loc[same(table, society), "world"])
        missing = [world for world in worlds if world not in known]
        if missing:
            found = judged(society, missing)
            table = pd.concat([table, found], ignore_index=True) if len(table) else found
            path.parent.mkdir(parents=True, exist_ok=True)
            table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
            print(*society.key, file=sys.stderr, flush=True)
    return table


def read(path: Path) -> pd.DataFrame:
    """Return a table that is kept, or an empty one."""
    if not path.is_file():
        return pd.DataFrame(columns=[*KEYS, "world"])
    return pd.read_csv(path, keep_default_na=True).fillna({"partner": ALONE})


def same(table: pd.DataFrame, society: Society) -> pd.Series:
    """Return which rows are a society's."""
    found = pd.Series(True, index=table.index)
    for name, value in zip(KEYS, society.key, strict=True):
        found &= table[name] == value
    return found


# Reports ------------------------------------------------------------------------------------------


def report(table: pd.DataFrame) -> str:
    """Return the means of each way in each situation, and of pairs, as Markdown."""
    alone, pairs = table[table["partner"] == ALONE], table[table["partner"] != ALONE]
    lines = [
        "| situation | way | attempts | worlds | within one | within a ninth | off, of nine | "
        "changes | brought |",
        "|---" * 9 + "|",
    ]
    for (situation, way), part in alone.groupby(["situation", "way"], sort=False):
        lines.append(
            row_of(part, [situation, way, part["attempt"].nunique(), part["world"].nunique()])
        )
    lines += [
        "",
        "| situation | focal | attempt | among | attempt | focal robots | worlds | within one | "
        "within a ninth | off, of nine | changes | brought | changes of others | brought by them |",
        "|---" * 14 + "|",
    ]
    order = ["situation", *KEYS[:-1]]
    for key, part in pairs.groupby(order, sort=False):
        cells = [one or "–" for one in key]
        line = row_of(part, [*cells, part["world"].nunique()])
        rest = [f"{part[f'background_{name}'].mean():.2f}" for name in ("changes", "brought")]
        lines.append(line + " " + " | ".join(rest) + " |")
    lines += [
        "",
        f"| situation | way | attempts | worlds | more within one than with {USUAL}, 1:2 |",
        "|---" * 5 + "|",
    ]
    for (situation, way), (more, found) in differences(alone).items():
        attempts, worlds = more.shape
        lines.append(f"| {situation} | {way} | {attempts} | {worlds} | {signed(found)} |")
    lines += ["", "| situation | way | more within one, in the same worlds, than | difference |"]
    lines.append("|---" * 4 + "|")
    for (situation, way, other), found in between_ways(alone).items():
        lines.append(f"| {situation} | {way} | {other} | {signed(found)} |")
    return "\n".join(lines) + "\n"


def differences(
    alone: pd.DataFrame,
) -> dict[tuple[str, str], tuple[pd.DataFrame, Interval]]:
    """Return in how much larger a share of worlds ways stay within one than in the usual situation.

    The same minds meet the same worlds in both, so attempts and worlds are paired.

    Args:
        alone: robots that are all of one way, a row for each attempt, situation and world.

    Returns:
        By situation and way the differences, (attempts, worlds), and their mean.
    """
    found = {}
    for way, part in alone.groupby("way", sort=False):
        square = part.pivot(index=["attempt", "world"], columns="situation", values="within_one")
        for situation in COMPARED:
            if {situation, USUAL} <= set(square):
                more = (square[situation] - square[USUAL]).unstack().dropna(axis="columns")
                if not more.empty:
                    interval = paired_interval(more.to_numpy(float))
                    found[situation, str(way)] = more, interval
    return found


def between_ways(alone: pd.DataFrame) -> dict[tuple[str, str, str], Interval]:
    """Return in how much larger a share of worlds a way stays within one than another.

    Args:
        alone: robots that are all of one way, a row for each attempt, situation and world.

    Returns:
        By situation, way and the other, over the worlds in which all attempts at both were judged.
    """
    found = {}
    for situation in SITUATIONS:
        own = alone[alone["situation"] == situation]
        each = {
            str(way): part.pivot_table(index="attempt", columns="world", values="within_one")
            for way, part in own.groupby("way")
        }
        for one, other in (pair for pair in AGAINST if {*pair} <= {*each}):
            both = pd.concat([each[one], each[other]], keys=[one, other]).dropna(axis="columns")
            if not both.empty:
                ours, theirs = (both.loc[name].to_numpy(float) for name in (one, other))
                found[situation, one, other] = held_against(ours, theirs)
    return found


def row_of(part: pd.DataFrame, cells: Sequence[Any]) -> str:
    """Return a row: cells, then means with intervals over attempts and worlds, or worlds alone."""
    found = [in_brackets(part, name, ".0%") for name in ("within_one", "within_ninth")]
    found.append(in_brackets(part, "off", ".2f"))
    found += [f"{part[f'focal_{name}'].mean():.2f}" for name in ("changes", "brought")]
    return "| " + " | ".join(map(str, [*cells, *found])) + " |"


def main(arguments: Sequence[str]) -> None:
    """Judge what is asked for, keep what comes of it, and print it."""
    words = list(arguments)
    if "--quick" in words:
        firsts = [next(one for one in societies() if one.situation == met) for met in SITUATIONS]
        parts = [judged(one, REPORTED[:FEW], SHORT) for one in firsts]
        print(report(pd.concat(parts, ignore_index=True)))
        return
    worlds = WORLDS
    if "--worlds" in words:
        at = words.index("--worlds")
        worlds = int(words[at + 1])
        del words[at : at + 2]
    ways = {one.focal.way for one in societies()}
    for word in words:
        if word not in ways and word not in SITUATIONS and word != "pairs":
            raise SystemExit(f"no way or situation {word!r}; there are {sorted(ways)}, "
                             f"{list(SITUATIONS)} and pairs")  # fmt: skip
    some = [one for one in societies() if asked_for(one, set(words), ways)]
    judge_all(RESULTS / "generalisation.csv", some, REPORTED[:worlds])
    text = report(read(RESULTS / "generalisation.csv"))
    (RESULTS / "generalisation.md").write_text(text, encoding="utf-8")
    print(text)


def asked_for(society: Society, words: set[str], ways: set[str]) -> bool:
    """Say whether words of the command name a society; without words they name all."""
    whose, where = words & ways, words & set(SITUATIONS)
    if "pairs" in words and society.partner is None:
        return False
    if society.partner is not None and words and "pairs" not in words:
        return False
    return (not whose or society.focal.way in whose) and (not where or society.situation in where)


if __name__ == "__main__":
    main(sys.argv[1:])
