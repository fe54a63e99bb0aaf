"""Whether each village finds a mix of farmers and artisans of its own, over many seeds.

    python -m analysis.farmers_artisans_traders.study
    python -m analysis.farmers_artisans_traders.study --seeds 5 --out /tmp/villages

Writes societies.csv and villages.csv (a row for each), tables.md, and the figure as study.pdf and
.png.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import FEW, Interval, interval_of
from socialmind.work.side_by_side import side_by_side

from .plots import draw
from .villages import CULTURES, lived

HERE = Path(__file__).parent / "results"
SHOWN = {
    "artisans": "artisans, share of people",
    "spread": "spread of the villages' mixes",
    "spread_by_chance": "the same by luck alone",
    "without_tools": "share of time that a village is out of tools",
    "without_wheat": "share of time that it cannot pay",
    "role_changes": "role changes of a person in 10,000 ticks",
    "specialised": "share of people specialised",
    "agents_to_tasks": "division of labour, people to tasks",
    "agents_to_tasks_by_chance": "the same by luck alone",
    "wheat": "wheat of a person, at the end",
    "tools": "tools of a person, at the end",
}


def persistence(villages: pd.DataFrame) -> Interval:
    """Return the correlation of villages' mixes, third and last quarter, each less its society's.

    Args:
        villages: a row for each, of one culture.

    Returns:
        The correlation over all villages with its interval over seeds; 1 when villages keep what
        sets them apart, 0 when it passes.
    """
    before = villages["artisans_third"] - villages["others_third"]
    after = villages["artisans_last"] - villages["others_last"]
    products = pd.DataFrame({"xy": before * after, "xx": before**2, "yy": after**2})
    seeds = products.groupby(villages["seed"]).sum().to_numpy()

    def correlation(xy: float, xx: float, yy: float) -> float:
        return xy / math.sqrt(xx * yy) if xx * yy > 0 else math.nan

    return interval_of(seeds, combine=correlation)


def shown(one: Interval, digits: int = 2) -> str:
    """Return a mean with its interval."""
    form = f",.{digits}f"
    if not math.isfinite(one.low):
        return f"{one.mean:{form}}"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def over_villages(values: pd.Series, digits: int) -> str:
    """Return a mean with its interval, or a few villages one by one."""
    if len(values) < FEW:
        return "; ".join(f"{one:,.{digits}f}" for one in sorted(values))
    return shown(interval_of(values.to_numpy()), digits)


def as_markdown(societies: pd.DataFrame, villages: pd.DataFrame, ticks: int) -> str:
    """Return what was found as tables."""
    seeds = societies["seed"].nunique()
    lines = [
        f"{seeds} seeds, {ticks:,} ticks; the last quarter, unless said otherwise. Means, in "
        "brackets intervals of 95 % over seeds.",
        "",
        f"| | {' | '.join(CULTURES)} |",
        "|---|" + "---|" * len(CULTURES),
    ]
    of = {culture: societies[societies["culture"] == culture] for culture in CULTURES}
    homes = {culture: villages[villages["culture"] == culture] for culture in CULTURES}
    for name, title in SHOWN.items():
        digits = 0 if name in ("wheat", "tools") else 3
        cells = [shown(interval_of(rows[name].to_numpy()), digits) for rows in of.values()]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    cells = [
        shown(compared(rows["spread"], rows["spread_by_chance"]).difference, 3)
        for rows in of.values()
    ]
    lines.append(f"| spread less that by luck | {' | '.join(cells)} |")
    cells = [shown(persistence(rows)) for rows in homes.values()]
    lines.append(f"| what sets a village apart lasts: correlation | {' | '.join(cells)} |")
    lines += [
        "",
        "Villages of each size; the share of artisans among their people, and the stock of wheat "
        "less that of tools, the mean and its deviation over time; intervals over villages, of "
        f"which fewer than {FEW} stand one by one:",
        "",
        "| culture | people | villages | artisans | wheat − tools | deviation |",
        "|---|---|---|---|---|---|",
    ]
    for culture, rows in homes.items():
        groups = pd.cut(rows["people"], [0, 3, 6, 9, 99], labels=["1–3", "4–6", "7–9", "10 …"])
        for size, some in rows.groupby(groups, observed=True):
            cells = [
                over_villages(some[name], digits)
                for name, digits in (
                    ("artisans_last", 2), ("balance", 0), ("balance_deviation", 0),
                )
            ]  # fmt: skip
            lines.append(f"| {culture} | {size} | {len(some)} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--ticks", type=int, default=200_000)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2 or arguments.ticks < 20_000:
        parser.error("at least two seeds and 20,000 ticks")
    calls = [
        (culture, seed, arguments.ticks) for culture in CULTURES for seed in range(arguments.seeds)
    ]
    answers = list(side_by_side(lived, calls, arguments.workers, together=5))
    societies = pd.DataFrame([row for row, _ in answers])
    villages = pd.DataFrame([one for _, several in answers for one in several])
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, table in (("societies", societies), ("villages", villages)):
        table.to_csv(arguments.out / f"{name}.csv", index=False, float_format="%.5g")
    text = as_markdown(societies, villages, arguments.ticks)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(societies, villages)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
