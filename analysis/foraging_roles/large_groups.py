"""Why thirty-six robots do not settle as sharply as nine: measured in the economy without bodies.

python -m analysis.foraging_roles.large_groups [--quick]

A row of `results/large_groups.csv` is a way to decide, an attempt, a number of robots, a length of
run, a gain, whether trips are even, and a world for reporting: whether it stays within one robot,
and within a ninth of the robots, of the wanted split all through the last quarter; the mean
distance then, in robots; how far the counts are from the wanted ratio then, as many robots as that
is the work of; and changes. With a gain of 4 robots are told payoffs four times as far from 0.5.
Trips for A and B are up to a tenth longer and shorter in a world, or the other way round, unless
they are even. What was judged already is not judged again.

`results/dead_zones.csv` says how many robots too many a mind puts up with: those for whose payoff,
told again and again, it does not change its role. `results/payoffs_at_rest.csv` says how far
payoffs spread where the split is the wanted one for good, beside what one robot too many takes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import spearmanr

from socialmind.catalogue import load_file
from socialmind.errors import SocialmindError
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import Interval, interval_of, share_interval
from socialmind.mind import MindDescription, Programmed
from socialmind.mind.minds import Minds

from . import scheme_evolution
from .contestants import PICKED, Contestant, contestants
from .results import NINE
from .scheme_economy import WRITTEN, SchemeWorlds
from .threshold_scan import CONTROLLERS, Responders
from .trainings import ECONOMY, MODEL
from .worlds import SCHEME_ECONOMY

DELIVERIES = load_file(MODEL / "deliveries.py")
AS_IT_SHOULD_BE, ROLE = 0.5, "ForageRole"
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
WANTED, DELIVERIES_OF_A_RUN = 2 / 3, 75
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


def worlds_of(
    one: Contestant, terms: Mapping[str, Any], worlds: Sequence[int], ticks: int
) -> tuple[Any, Any]:
    """Return worlds of the economy in which robots decide, and their minds if they have some.

    Args:
        one: the robots.
        terms: of the economy.
        worlds: seeds.
        ticks: of a run.
    """
    given = ECONOMY.Terms(**terms)
    drawn = [ECONOMY.World(seed, given, ticks) for seed in worlds]
    if "programmed" in one.parameters:
        numbers = np.array([list(numbers_of_scheme(one).values())])
        return SchemeWorlds(drawn, worlds, numbers, ticks), None
    if one.way in CONTROLLERS:
        return Responders(drawn, ticks, one.parameters), None
    mind = one.mind or MindDescription.load(MODEL / "mind")
    if not learned_choice(mind):
        minds = with_genome(ECONOMY.thinking(mind, ROLE), mind, len(worlds))
        return ECONOMY.Worlds(drawn, 1, ticks), minds
    drawn = [DELIVERIES.DeliveryWorld(seed, given, ticks) for seed in worlds]
    parts = DELIVERIES.thinking(mind, ROLE), DELIVERIES.choosing(mind, DELIVERIES.CHOICE)
    heads = DELIVERIES.Heads(*(with_genome(part, mind, len(worlds)) for part in parts))
    return DELIVERIES.Deliveries(drawn, 1, ticks, heads), heads


def learned_choice(mind: MindDescription) -> bool:
    """Say whether what ROLE means was learned."""
    return not isinstance(mind.skill(DELIVERIES.CHOICE).function, Programmed)


def with_genome(part: MindDescription, mind: MindDescription, agents: int) -> Minds:
    """Return a mind of one skill for many robots, with the weights that the whole mind has."""
    name = next(iter(part.skills))
    minds = Minds(part, agents=agents, own_genomes=True)
    minds.set_genome(name, np.tile(mind.skill(name).genome, (agents, 1)))
    return minds


def numbers_of_scheme(one: Contestant) -> Mapping[str, float]:
    """Return the numbers of a programmed contestant: those that evolved, or those written."""
    if one.way == scheme_evolution.NAME:
        evolved = scheme_evolution.kept()[one.attempt].tolist()
        return dict(zip(WRITTEN, evolved, strict=True))
    return {**WRITTEN, "tolerance": one.parameters.get("tolerance", WRITTEN["tolerance"])}


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


def judge_all(
    path: Path, some: Iterable[Contestant], settings: Sequence[Setting], worlds: int
) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it after each."""
    table = pd.read_csv(path) if path.is_file() else pd.DataFrame(columns=[*KEYS, "world"])
    table = table[table["world"].isin(SCHEME_ECONOMY[:worlds])]  # of others nothing is told
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
    return table


# Dead zones ---------------------------------------------------------------------------------------


def dead_zone(mind: MindDescription, in_b: bool, deliveries: int) -> float:
    """Return the least lack of payoff, told at every delivery, at which a learned mind changes.

    Args:
        mind: the robot's, with a CollectSelect that changes at 0.5.
        in_b: its role at first.
        deliveries: in which it changes.

    Returns:
        0.001 … 0.5; NaN where it never does.
    """
    lacks = np.arange(1, 501) / 1000
    minds = with_genome(ECONOMY.thinking(mind, ROLE), mind, len(lacks))
    role = np.full(len(lacks), float(in_b))
    changed = np.zeros(len(lacks), bool)
    for _ in range(deliveries):
        minds.set_sensor("PAYOFF", AS_IT_SHOULD_BE - lacks)
        minds.set_sensor("ROLE", role)
        minds.step()
        role = minds.actuator("ROLE").copy()
        changed |= (role >= 0.5) != in_b
    return float(lacks[changed.argmax()]) if changed.any() else float("nan")


def robots_off(lack: float, robots: int, wanted: float = WANTED) -> float:
    """Return by how many robots a split is off where its payoff lacks so much, on the mean.

    The payoff lacks 0.15 · (share − wanted) / (wanted · (1 − wanted)); see `payoff.py`.

    >>> round(robots_off(0.075, 9), 6), round(robots_off(0.075, 36), 6)
    (1.0, 4.0)
    """
    return lack / 0.15 * wanted * (1 - wanted) * robots


def dead_zones(some: Iterable[Contestant]) -> pd.DataFrame:
    """Return how many robots too many ways put up with: a row for each attempt and role."""
    rows = []
    for one in some:
        mind = one.mind or MindDescription.load(MODEL / "mind")
        if "programmed" in one.parameters:
            tolerance = numbers_of_scheme(one)["tolerance"] / 100
            lacks = {"A": tolerance, "B": tolerance}
        elif one.way in CONTROLLERS or learned_choice(mind):
            continue  # thresholds have no dead zone; of learned choices the middle is elsewhere
        else:
            lacks = {kind: dead_zone(mind, kind == "B", DELIVERIES_OF_A_RUN) for kind in ("A", "B")}
        for kind, lack in lacks.items():
            off = {f"of_{number}": robots_off(lack, number) for number in (9, 18, 36)}
            rows.append({"way": one.way, "attempt": one.attempt, "role": kind, "lack": lack, **off})
    return pd.DataFrame(rows)


# What a payoff can tell ---------------------------------------------------------------------------


def payoffs_at_rest(
    robots: int, even: bool, worlds: Sequence[int], ticks: int = TICKS
) -> tuple[float, float]:
    """Return how far payoffs of objects B spread in groups whose split is the wanted one for good.

    Args:
        robots: how many, a multiple of three.
        even: whether trips for A and for B are equally long.
        worlds: seeds.
        ticks: of a run, of which the second half counts.

    Returns:
        The mean standard deviation within a world, which time averages out; and the standard
        deviation between the worlds' means, which it does not.
    """
    terms = ECONOMY.Terms(**{**NINE, "numbers": (robots,)})
    drawn = [ECONOMY.World(seed, terms, ticks) for seed in worlds]
    found: Any = ECONOMY.Worlds(drawn, 1, ticks)
    found.role[:] = np.arange(found.most) < round(WANTED * robots)
    told = []
    if even:
        found.uneven[:] = 1.0

    def stays(rows: Any, who: Any, before: Floats, payoff: Floats, minds: Any) -> Floats:
        late = rows[(found.now[rows] > ticks / 2) & (before[rows] > 0.5)]
        told.append(np.stack([late, payoff[late]], axis=1))
        return before

    found.decided = stays
    while found.go_on(None):
        pass
    by_world = pd.DataFrame(np.concatenate(told), columns=["world", "payoff"]).groupby("world")
    return float(by_world["payoff"].std().mean()), float(by_world["payoff"].mean().std())


def spread_of_payoffs(worlds: Sequence[int], ticks: int = TICKS) -> pd.DataFrame:
    """Return the spread of payoffs beside what one robot too many in B takes of one."""
    rows = []
    for even in (False, True):
        for robots in (9, 18, 36):
            within, between = payoffs_at_rest(robots, even, worlds, ticks)
            one = 0.15 / (WANTED * (1 - WANTED)) / robots
            rows.append(
                {"robots": robots, "even": even, "within": within, "between": between, "one": one}
            )
    return pd.DataFrame(rows)


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


def in_brackets(part: pd.DataFrame, name: str, form: str) -> str:
    """Return a mean with its interval of 95 %: over trainings and worlds, or worlds alone.

    A single number has none.
    """
    square = part.pivot_table(index="attempt", columns="world", values=name).dropna(axis="columns")
    if square.empty:
        raise SocialmindError(
            f"no world in which all attempts at {part['way'].iloc[0]} were judged"
        )
    values = square.to_numpy(float)
    if len(values) > 1:
        found = crossed_interval(values)
    elif np.isin(values, (0, 1)).all():  # where all are alike a bootstrap has no width
        found = share_interval(values[0])
    else:
        found = interval_of(values[0])
    if not np.isfinite(found.low):
        return f"{found.mean:{form}}"
    return f"{found.mean:{form}} ({found.low:{form}} to {found.high:{form}})"


def paired_interval(more: Floats) -> Interval:
    """Return a mean difference of the same minds in the same worlds, (attempts, worlds), paired.

    Its bounds are over attempts and worlds, or worlds alone where there is one attempt; NaN where
    all worlds of a single attempt are alike, which has no width.
    """
    if len(more) > 1:
        return crossed_interval(more)
    if (more == more[0, 0]).all():
        return Interval(float(more[0, 0]), float("nan"), float("nan"))
    return interval_of(more[0])


def signed(found: Interval, form: str = "+.2f") -> str:
    """Return a difference with its interval, if it has one.

    >>> signed(Interval(-0.2, -0.6, 0.0)), signed(Interval(0.0, float("nan"), float("nan")))
    ('-0.20 (-0.60 to +0.00)', '+0.00')
    """
    bounds = f" ({found.low:{form}} to {found.high:{form}})" if np.isfinite(found.low) else ""
    return f"{found.mean:{form}}{bounds}"


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

    Pairs are of the same attempts in the same worlds.
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


def by_dead_zone(table: pd.DataFrame, zones: pd.DataFrame) -> str:
    """Return whether learned minds with wider dead zones are farther off, as a line of Markdown.

    Compared are thirty-six robots on even trips, by rank.

    Args:
        table: what was judged.
        zones: the dead zones, a row for each attempt and role.
    """
    many = table[(table["robots"] == 36) & (table["gain"] == 1.0) & table["even"]]
    off = many.groupby(["way", "attempt"])["off"].mean()
    learned = zones[zones["way"].isin([PICKED, "supervised_role"])]
    wide = learned.groupby(["way", "attempt"])["of_36"].sum()
    both = pd.concat([off, wide], axis=1, join="inner")
    found = spearmanr(both["off"], both["of_36"])
    return (
        f"Dead zones of both roles together and robots off, of {len(both)} learned minds: "
        f"Spearman's ρ = {found.statistic:.2f}, p = {found.pvalue:.2f}.\n"
    )


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
    zones = dead_zones(all_judged())
    zones.round(4).to_csv(RESULTS / "dead_zones.csv", index=False, lineterminator="\n")
    spread = spread_of_payoffs(SCHEME_ECONOMY[:WORLDS])
    spread.round(5).to_csv(RESULTS / "payoffs_at_rest.csv", index=False, lineterminator="\n")
    table = judge_all(RESULTS / "large_groups.csv", all_judged(), SETTINGS, WORLDS)
    text = f"{report(table)}\n{beside(table)}\n{by_dead_zone(table, zones)}"
    (RESULTS / "large_groups.md").write_text(text, encoding="utf-8")
    print(zones.round(3).to_string(), spread.round(4).to_string(), text, sep="\n\n")


if __name__ == "__main__":
    main(sys.argv[1:])
