"""Why thirty-six robots do not settle as sharply as nine: measured in the economy without bodies.

python -m analysis.foraging_roles.large_groups [--quick]

A row of `results/large_groups.csv` is a way to decide, an attempt, a number of robots, a length of
run, a gain, whether trips are even, and a world for reporting: whether it stays within one robot,
and within a ninth of the robots, of the wanted split all through the last quarter; the mean
distance then, in robots; how far the counts are from the wanted ratio then, as many robots as that
is the work of; and changes. With a gain of 4 robots are told payoffs four times as far from 0.5.
Trips for A and B are up to a tenth longer and shorter in a world, or the other way round, unless
they are even. What was judged already is not judged again.

`results/dead_zones.csv` and `results/payoffs_at_rest.csv` are written too (`dead_zones.py`).
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from . import scheme_evolution
from .contestants import PICKED, Contestant, contestants
from .dead_zones import by_dead_zone, dead_zones, spread_of_payoffs
from .economy_worlds import worlds_of
from .results import NINE
from .scheme_economy import WRITTEN
from .told_intervals import in_brackets, paired_interval, signed
from .worlds import SCHEME_ECONOMY

AS_IT_SHOULD_BE = 0.5
RESULTS = Path(__file__).parent / "results"
WORLDS, FEW = 32, 2
TICKS, LONG = 60_000, 240_000
SETTINGS = (
    (9, TICKS, 1.0, False), (18, TICKS, 1.0, False), (36, TICKS, 1.0, False),
    (36, LONG, 1.0, False), (36, TICKS, 2.0, False), (36, TICKS, 4.0, False),
    (9, TICKS, 1.0, True), (36, TICKS, 1.0, True),
)  # fmt: skip
"""Robots, ticks, gain, and whether trips are even. What nine robots do is what all are held to."""
USUAL = (36, TICKS, 1.0, False)
OTHERWISE = {
    "four times as long": (36, LONG, 1.0, False),
    "even trips": (36, TICKS, 1.0, True),
    "told 2 times as far": (36, TICKS, 2.0, False),
    "told 4 times as far": (36, TICKS, 4.0, False),
}
"""What thirty-six robots might want for, in place of `USUAL`."""
HALF = "programmed, half tolerated"
LEFT_OUT = ("fixed roles", "random roles", "greedy", "at_once", "thesis_role")
KEYS = ["way", "attempt", "robots", "ticks", "gain", "even"]

Floats = NDArray[np.float64]
Setting = tuple[int, int, float, bool]


class Seen(NamedTuple):
    """What worlds came to in their last quarter, (worlds,).

    Attributes:
        off: robots away from the wanted split, on the mean.
        within_ninth: whether never by more than a ninth of those who began.
        by_counts: how far the share of B among the counts is from the wanted one on the mean, as
            many robots as that is the work of.
    """

    off: Floats
    within_ninth: NDArray[np.bool_]
    by_counts: Floats


def run_out(worlds: Any, minds: Any) -> Seen:
    """Let all happen in worlds of the economy, and return what is seen beside their costs."""
    since = 0.75 * worlds.limit
    off, out, more = np.zeros((3, len(worlds.rows)))
    going_on = True
    while going_on:
        was_off, begun = worlds.off_now.copy(), np.maximum(worlds.now, since)
        above = worlds.count_b / (worlds.count_a + worlds.count_b) - worlds.wanted
        going_on = worlds.go_on(minds)
        took = np.maximum(worlds.now - begun, 0.0)
        off += took * was_off
        more += took * above
        out += took * (was_off > worlds.first / 9 + 1e-9)
    last = worlds.limit - since
    return Seen(off / last, out == 0, np.abs(more) / last * worlds.robots)


def sharpen(worlds: Any, gain: float) -> None:
    """Let robots of the economy be told payoffs so many times farther from 0.5."""
    decided = worlds.decided

    def sharply(rows: Any, who: Any, before: Floats, payoff: Floats, minds: Any) -> Floats:
        told = np.clip(AS_IT_SHOULD_BE + gain * (payoff - AS_IT_SHOULD_BE), 0.0, 1.0)
        roles: Floats = decided(rows, who, before, told, minds)
        return roles

    worlds.decided = sharply


def judged(
    one: Contestant,
    robots: int,
    ticks: int,
    gain: float,
    even: bool,
    worlds: Sequence[int],
) -> pd.DataFrame:
    """Return what robots come to in the economy, a row for each world.

    Args:
        one: the robots.
        robots: how many.
        ticks: of a run.
        gain: how many times farther from 0.5 payoffs are told.
        even: whether trips for A and for B are equally long.
        worlds: their seeds.
    """
    terms = {**NINE, "numbers": (robots,)}
    found, minds = worlds_of(one, terms, worlds, ticks)
    sharpen(found, gain)
    if even:
        found.uneven[:] = 1.0
    seen = run_out(found, minds)
    return pd.DataFrame(
        {
            "world": list(worlds),
            "within_one": (found.out_last == 0).astype(int),
            "within_ninth": seen.within_ninth.astype(int),
            "off": seen.off,
            "by_counts": seen.by_counts,
            "changes": found.changes / found.first / (ticks / 2 / 10_000),
        }
    )


def chosen() -> Iterator[Contestant]:
    """Yield who is judged: all that learned, were programmed or evolved, and thresholds."""
    for one in contestants():
        if one.way not in LEFT_OUT:
            yield one
    for attempt in scheme_evolution.kept():
        yield Contestant(scheme_evolution.NAME, attempt, None, {"programmed": 1.0})


def all_judged() -> Iterator[Contestant]:
    """Yield who is judged here: all that are chosen, and a scheme that tolerates half."""
    yield from chosen()
    half = WRITTEN["tolerance"] / 2
    yield Contestant(HALF, 0, None, {"programmed": 1.0, "tolerance": half})


def read(path: Path, worlds: int = WORLDS) -> pd.DataFrame:
    """Return what is kept of the first worlds; of others nothing is told."""
    table = pd.read_csv(path) if path.is_file() else pd.DataFrame(columns=[*KEYS, "world"])
    return table[table["world"].isin(SCHEME_ECONOMY[:worlds])]


def judge_all(
    path: Path, some: Iterable[Contestant], settings: Sequence[Setting], worlds: int
) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it after each."""
    table = read(path, worlds)
    done = set(table[KEYS].itertuples(index=False, name=None))
    for one in some:
        for setting in settings:
            key = (one.way, one.attempt, *setting)
            if key in done:
                continue
            rows = judged(one, *setting, SCHEME_ECONOMY[:worlds])
            rows = rows.assign(**dict(zip(KEYS, key, strict=True)))
            table = pd.concat([table, rows], ignore_index=True) if len(table) else rows
            table = table[[*KEYS, *(name for name in rows if name not in KEYS)]]
            path.parent.mkdir(parents=True, exist_ok=True)
            table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
            print(*key, file=sys.stderr, flush=True)
    return read(path, worlds)  # with the digits that are kept


# Reports ------------------------------------------------------------------------------------------


def report(table: pd.DataFrame) -> str:
    """Return the means of each way and setting as Markdown, over trainings and worlds."""
    lines = [
        "| way | attempts | robots | ticks | gain | even | within one | within a ninth | off | "
        "off by counts | changes |",
        "|---" * 11 + "|",
    ]
    for key, part in table.groupby(["way", *KEYS[2:]], sort=False):
        way, robots, ticks, gain, even = key
        cells = []
        for name, form in (
            ("within_one", ".0%"), ("within_ninth", ".0%"), ("off", ".2f"),
            ("by_counts", ".2f"), ("changes", ".2f"),
        ):  # fmt: skip
            cells.append(in_brackets(part, name, form))
        attempts = part["attempt"].nunique()
        lines.append(
            f"| {way} | {attempts} | {robots} | {ticks} | {gain:g} | {even} | "
            + " | ".join(cells)
            + " |"
        )
    return "\n".join(lines) + "\n"


def squares_of(table: pd.DataFrame, setting: Setting, name: str) -> dict[str, pd.DataFrame]:
    """Return by way what each attempt comes to in each world of a setting."""
    part = table
    for key, value in zip(KEYS[2:], setting, strict=True):
        part = part[part[key] == value]
    return {
        str(way): own.pivot(index="attempt", columns="world", values=name)
        for way, own in part.groupby("way", sort=False)
    }


def beside(table: pd.DataFrame) -> str:
    """Return what changes for thirty-six robots, and by half the tolerance, in pairs, as Markdown.

    Pairs are of the same attempts in the same worlds. Those of longer runs begin alike, and have
    other trips.
    """
    lines = [
        "| way | thirty-six robots | more within one | more within a ninth |",
        "|---" * 4 + "|",
    ]
    names = ("within_one", "within_ninth")
    usual = {name: squares_of(table, USUAL, name) for name in names}
    for what, setting in OTHERWISE.items():
        other = {name: squares_of(table, setting, name) for name in names}
        for way in other[names[0]]:
            found = [other[name][way] - usual[name][way] for name in names]
            cells = [signed(paired_interval(one.to_numpy(float))) for one in found]
            lines.append(f"| {way} | {what} | " + " | ".join(cells) + " |")
    lines += ["", "| way | thirty-six robots: off, more by heads than by counts |", "|---|---|"]
    heads, counts = (squares_of(table, USUAL, name) for name in ("off", "by_counts"))
    for way, square in heads.items():
        more = (square - counts[way]).to_numpy(float)
        lines.append(f"| {way} | {signed(paired_interval(more))} |")
    lines += [
        "",
        "| robots | half tolerated: more within one | off | off by counts | changes |",
        "|---" * 5 + "|",
    ]
    for setting in (one for one in SETTINGS if one[1:] == USUAL[1:]):
        cells = []
        for name in ("within_one", "off", "by_counts", "changes"):
            found_by = squares_of(table, setting, name)
            more = found_by[HALF].to_numpy(float) - found_by["programmed"].to_numpy(float)
            cells.append(signed(paired_interval(more)))
        lines.append(f"| {setting[0]} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str]) -> None:
    """Judge, keep and print."""
    if "--quick" in arguments:
        few = [one for one in chosen() if one.way in (PICKED, "programmed", "supervised_role")][:3]
        parts = [
            judged(one, 9, 8000, 1.0, False, SCHEME_ECONOMY[:FEW]).assign(
                way=one.way, attempt=one.attempt, robots=9, ticks=8000, gain=1.0, even=False
            )
            for one in few
        ]
        print(report(pd.concat(parts, ignore_index=True)))
        return
    zones = dead_zones(all_judged()).round(4)
    zones.to_csv(RESULTS / "dead_zones.csv", index=False, lineterminator="\n")
    spread = spread_of_payoffs(SCHEME_ECONOMY[:WORLDS], TICKS)
    spread.round(5).to_csv(RESULTS / "payoffs_at_rest.csv", index=False, lineterminator="\n")
    table = judge_all(RESULTS / "large_groups.csv", all_judged(), SETTINGS, WORLDS)
    text = f"{report(table)}\n{beside(table)}\n{by_dead_zone(table, zones)}"
    (RESULTS / "large_groups.md").write_text(text, encoding="utf-8")
    print(zones.round(3).to_string(), spread.round(4).to_string(), text, sep="\n\n")


if __name__ == "__main__":
    main(sys.argv[1:])
