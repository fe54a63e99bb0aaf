"""The farmer-artisan society over many seeds: who specialises, when, and what a shock does.

    python -m analysis.farmer_artisan.study
    python -m analysis.farmer_artisan.study --seeds 10 --ticks 200000 --out /tmp/study

Each seed is run through, and once more from its middle with half of the artisans turned into
farmers. Writes results.csv (one row a seed), summary.json, figures/study.pdf and .png, and the
table in README.md.
"""

import argparse
import json
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of
from socialmind.experiments.measures.recovery import first_reached

from .plots import draw
from .replicate import Replicate, replicate

HERE = Path(__file__).parent
BEGIN, END = "<!-- study: begin -->", "<!-- study: end -->"
COURSE = (  # of the measures that `socialmind.experiments.measures.specialisation` defines
    "last_distance", "settling_ticks", "role_changes", "specialised", "agents_to_tasks",
    "tasks_to_agents", "agents_to_tasks_by_chance",
)  # fmt: skip


def results(replicates: Sequence[Replicate], early: int) -> pd.DataFrame:
    """One row a seed.

    Args:
        replicates: one for each seed.
        early: the tick from which specialisation is judged.

    Returns:
        The table.
    """
    rows = []
    for one in replicates:
        course = one.course.measures()
        row = {
            "seed": one.seed,
            "artisans": one.artisans[-1],
            "specialisation_at_early": one.specialisation[one.ticks >= early][0],
            "specialisation_least_from_early": one.specialisation[one.ticks >= early].min(),
            "correlation_mind": one.correlation_mind,
            "correlation_land": one.correlation_land,
            "median_tick_mind": np.median(one.tick_mind),
            "median_tick_land": np.median(one.tick_land),
            "turned": one.turned,
            "before_shock": one.recovery.before,
            "after_shock": one.recovery.after,
            "at_end": one.recovery.at_end,
            "undisturbed_at_end": one.artisans[one.ticks >= one.ticks[-1] - 20_000].mean(),
            "share_recovered": one.recovery.share,
            "ticks_halfway": one.recovery.halfway,
            "ticks_full": one.recovery.full,
            **{name: course[name] for name in COURSE},
            "delivered": one.delivered,
            "recovery_ticks": one.course_shocked.measures()["recovery_ticks_1"],
        }
        rows.append(row)
    return pd.DataFrame(rows)


def gain_times(replicates: Sequence[Replicate], shock: int) -> dict[str, float | None]:
    """Ticks from the shock until the mean number of artisans made half, and 0.9, of its gain.

    Args:
        replicates: one for each seed.
        shock: its tick.

    Returns:
        The ticks by the part of the gain, None where nothing was gained.
    """
    ticks = replicates[0].ticks
    later = ticks > shock
    mean = np.mean([one.artisans_shocked for one in replicates], axis=0)[later]
    after = float(np.mean([one.recovery.after for one in replicates]))
    gain = float(np.mean([one.recovery.at_end for one in replicates])) - after
    times: dict[str, float | None] = {}
    for part in (0.5, 0.9):
        first = first_reached(ticks[later], mean[:, None], after + part * gain)[0]
        times[str(part)] = float(first) - shock if gain > 0 and np.isfinite(first) else None
    return times


def summary(replicates: Sequence[Replicate], table: pd.DataFrame, early: int, shock: int) -> dict:
    """The numbers that the README tells."""
    recorded = replicates[0].ticks
    seeds = len(table)

    def mean(column: str) -> dict[str, float | None] | None:
        known = table[column][np.isfinite(table[column])]
        return {**interval_of(known).record(), "seeds": len(known)} if len(known) else None

    def spread(column: str) -> dict[str, float | None]:
        values = table[column].dropna()  # infinite where something never came about
        finite = values[np.isfinite(values)]
        middle = float(np.median(values)) if len(values) else np.inf
        return {
            "median": middle if np.isfinite(middle) else None,
            "least": float(finite.min()) if len(finite) else None,
            "greatest": float(finite.max()) if len(finite) else None,
            "never": int(np.isinf(values).sum()),
        }

    return {
        "seeds": seeds,
        "ticks": int(recorded[-1]),
        "early": early,
        "shock": shock,
        "every": int(recorded[1] - recorded[0]),
        "artisans": {
            str(n): int(count) for n, count in table["artisans"].value_counts().sort_index().items()
        },
        "seeds_with_3_to_9_artisans": int(table["artisans"].between(3, 9).sum()),
        "specialisation_at_early": mean("specialisation_at_early"),
        "least_specialisation_from_early": float(table["specialisation_least_from_early"].min()),
        "correlation_mind": spread("correlation_mind"),
        "correlation_land": spread("correlation_land"),
        "seeds_with_positive_correlation_mind": int((table["correlation_mind"] > 0).sum()),
        "seeds_with_positive_correlation_land": int((table["correlation_land"] > 0).sum()),
        "before_shock": mean("before_shock"),
        "after_shock": mean("after_shock"),
        "at_end": mean("at_end"),
        "undisturbed_at_end": mean("undisturbed_at_end"),
        "share_recovered": mean("share_recovered"),
        "ticks_of_mean_gain": gain_times(replicates, shock),
        "ticks_halfway": spread("ticks_halfway"),
        "ticks_full": spread("ticks_full"),
        "settling_ticks": spread("settling_ticks"),
        "recovery_ticks": spread("recovery_ticks"),
        **{name: mean(name) for name in (*COURSE, "delivered") if name != "settling_ticks"},
    }


def as_markdown(found: dict) -> str:
    """The summary as a table."""
    seeds = found["seeds"]

    def mean(name: str, form: str = ".2f") -> str:
        part = found[name]
        if part is None:
            return "none"
        if part["low"] is None:
            return f"{part['mean']:{form}}"
        return f"{part['mean']:{form}} ({part['low']:{form}} – {part['high']:{form}})"

    def spread(name: str, form: str = ".2f") -> str:
        middle, least, greatest = (
            "none" if found[name][key] is None else f"{found[name][key]:{form}}"
            for key in ("median", "least", "greatest")
        )
        return f"{middle} ({least} – {greatest})"

    def speed(name: str) -> str:
        part = found[name]
        if part["least"] is None:
            return f"in none of {seeds} seeds by the end"
        span = f"{part['least']:,.0f} – {part['greatest']:,.0f}"
        return f"{span} in {seeds - part['never']} of {seeds} seeds, in the others not by the end"

    finals = ", ".join(f"{n} in {count}" for n, count in found["artisans"].items())
    rows = [
        ("artisans at the end: seeds", finals),
        ("seeds with 3 to 9 artisans", f"{found['seeds_with_3_to_9_artisans']} of {seeds}"),
        (f"specialisation at tick {found['early']:,}", mean("specialisation_at_early")),
        (
            f"least specialisation of a seed from tick {found['early']:,} on",
            f"{found['least_specialisation_from_early']:.2f}",
        ),
        (
            "rank correlation, distance and tick specialised, by mind",
            f"{spread('correlation_mind')}; positive in "
            f"{found['seeds_with_positive_correlation_mind']} of {seeds}",
        ),
        (
            "the same, by land",
            f"{spread('correlation_land')}; positive in "
            f"{found['seeds_with_positive_correlation_land']} of {seeds}",
        ),
        ("artisans before the shock", mean("before_shock")),
        ("artisans just after it", mean("after_shock")),
        ("artisans at the end, shocked", mean("at_end")),
        ("artisans at the end, undisturbed", mean("undisturbed_at_end")),
        ("share of the loss made good", mean("share_recovered")),
        (
            "ticks until the mean had made half, and 0.9, of what it gained",
            ", ".join(
                "none" if ticks is None else f"{ticks:,.0f}"
                for ticks in found["ticks_of_mean_gain"].values()
            ),
        ),
        ("ticks until half of the loss was made good", speed("ticks_halfway")),
        ("ticks until all of it was", speed("ticks_full")),
        ("agents away from 20 farmers and 5 artisans, last quarter", mean("last_distance")),
        ("ticks until within one agent of that for 5,000 ticks", speed("settling_ticks")),
        ("the same after the shock", speed("recovery_ticks")),
        ("role changes per agent and 10,000 ticks while settled", mean("role_changes", ".3f")),
        ("share of agents specialised, last quarter", mean("specialised")),
        ("division of labour, agents to work", mean("agents_to_tasks")),
        ("the same by luck alone", mean("agents_to_tasks_by_chance", ".3f")),
        ("division of labour, work to agents", mean("tasks_to_agents")),
        ("tools delivered to others", mean("delivered", ",.0f")),
    ]
    return "\n".join(
        [
            f"{seeds} seeds, {found['ticks']:,} ticks, shock at tick {found['shock']:,}, recorded "
            f"every {found['every']:,} ticks. In brackets: of means the 95 % interval, of medians "
            "the range.",
            "",
            "| | |",
            "|---|---|",
            *(f"| {name} | {value} |" for name, value in rows),
        ]
    )


def write(replicates: Sequence[Replicate], found: dict, table: pd.DataFrame, out: Path) -> None:
    """Write tables, figure and the README's table."""
    out.mkdir(parents=True, exist_ok=True)
    table.to_csv(out / "results.csv", index=False, float_format="%.6g")
    (out / "summary.json").write_text(json.dumps(found, indent=1) + "\n")
    paper.save({"study": draw(replicates, found["shock"])}, out / "figures")
    write_between(out / "README.md", as_markdown(found), BEGIN, END)


def write_between(readme: Path, content: str, begin: str, end: str) -> None:
    """Put text between two lines of a file, which is made where there is none.

    Args:
        readme: the file.
        content: what is put there.
        begin: the line above.
        end: the line below.
    """
    text = readme.read_text(encoding="utf-8") if readme.exists() else f"{begin}\n{end}\n"
    if begin not in text or end not in text:
        raise SystemExit(f"{readme}: found no lines {begin} and {end} to write between")
    head, _, rest = text.partition(begin)
    tail = rest.partition(end)[2]
    readme.write_text(f"{head}{begin}\n\n{content.strip()}\n\n{end}{tail}", encoding="utf-8")


def run(seeds: int, ticks: int, shock: int, every: int, workers: int) -> list[Replicate]:
    """Run all seeds, some at a time.

    Args:
        seeds: how many, from 0 on.
        ticks: length of each run.
        shock: its tick.
        every: ticks between two records.
        workers: processes at a time.

    Returns:
        The replicates, by seed.
    """
    replicates = {}
    with ProcessPoolExecutor(workers) as pool:
        pending = [pool.submit(replicate, seed, ticks, shock, every) for seed in range(seeds)]
        for done in as_completed(pending):
            one = done.result()
            replicates[one.seed] = one
            print(f"seed {one.seed}: {one.artisans[-1]} artisans ({len(replicates)} of {seeds})")
    return [replicates[seed] for seed in sorted(replicates)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--ticks", type=int, default=500_000)
    parser.add_argument("--every", type=int, default=1000, help="ticks between two records")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.ticks < 2 * arguments.every or arguments.seeds < 1:
        parser.error("at least one seed and two records (--ticks of at least twice --every)")
    # The middle, and 200,000 of 500,000, at records.
    shock = arguments.ticks // 2 // arguments.every * arguments.every
    early = arguments.ticks * 2 // 5 // arguments.every * arguments.every
    replicates = run(arguments.seeds, arguments.ticks, shock, arguments.every, arguments.workers)
    table = results(replicates, early)
    found = summary(replicates, table, early, shock)
    write(replicates, found, table, arguments.out)
    print(as_markdown(found))


if __name__ == "__main__":
    main()
