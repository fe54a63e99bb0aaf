"""What bulls do for cows: cows over time and wolves' attacks by the number of bulls.

    python -m analysis.wolf_cow.study
    python -m analysis.wolf_cow.study --seeds 5 --out /tmp/wolf_cow

Writes pastures.csv (a row for each), tables.md, and the figure as study.pdf and .png.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.work.side_by_side import side_by_side

from .pastures import BULLS, EARLY, EVERY, SETTINGS, lived
from .plots import draw

HERE = Path(__file__).parent / "results"
SHOWN = {
    "survived": ("share of runs with cows left", 2),
    "cows": ("cows, second half", 1),
    "early_killed": (f"eaten in the first {EARLY} ticks", 1),
    "early_attacking": (f"share of wolves that attack, first {EARLY} ticks", 2),
    "killed": ("eaten in all", 0),
    "starved": ("starved in all", 0),
    "born": ("born in all", 0),
}


def shown(one: Interval, digits: int = 2) -> str:
    """Return a mean with its interval."""
    form = f",.{digits}f"
    if not math.isfinite(one.low) or one.low == one.high:
        return f"{one.mean:{form}}"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def of(pastures: pd.DataFrame, setting: str, bulls: int, name: str) -> pd.Series:
    """Return a measure of the seeds of a setting and a number of bulls, in order of the seeds."""
    some = pastures[(pastures["setting"] == setting) & (pastures["bulls"] == bulls)]
    return some.sort_values("seed")[name]


def as_markdown(pastures: pd.DataFrame, ticks: int) -> str:
    """Return what was found as tables."""
    seeds = pastures["seed"].nunique()
    lines = [
        f"{seeds} seeds, {ticks:,} ticks. Means, in brackets intervals of 95 % over seeds.", ""
    ]  # fmt: skip
    for setting in SETTINGS:
        lines += [
            f"**{setting.capitalize()}**",
            "",
            f"| bulls | {' | '.join(str(number) for number in BULLS)} |",
            "|---|" + "---|" * len(BULLS),
        ]
        for name, (title, digits) in SHOWN.items():
            cells = [
                shown(interval_of(of(pastures, setting, bulls, name).to_numpy()), digits)
                for bulls in BULLS
            ]
            lines.append(f"| {title} | {' | '.join(cells)} |")
        lines.append("")
    lines += ["Wolves less fearless wolves, seed by seed:", ""]
    lines += [f"| bulls | {' | '.join(str(number) for number in BULLS)} |"]
    lines += ["|---|" + "---|" * len(BULLS)]
    for name in ("early_killed", "cows"):
        cells = [
            shown(compared(*(of(pastures, setting, bulls, name).to_numpy()
                             for setting in ("wolves", "fearless wolves"))).difference, 1)
            for bulls in BULLS
        ]  # fmt: skip
        lines.append(f"| {SHOWN[name][0]} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--ticks", type=int, default=1_000)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2 or arguments.ticks < 2 * EARLY or arguments.ticks % EVERY:
        parser.error(f"at least two seeds and {2 * EARLY} ticks, a multiple of {EVERY}")
    calls = [
        (setting, bulls, seed, arguments.ticks)
        for setting in SETTINGS
        for bulls in BULLS
        for seed in range(arguments.seeds)
    ]
    answers = list(side_by_side(lived, calls, arguments.workers, together=30))
    pastures = pd.DataFrame([row for row, _ in answers])
    looks = pd.DataFrame([one for _, several in answers for one in several])
    arguments.out.mkdir(parents=True, exist_ok=True)
    pastures.to_csv(arguments.out / "pastures.csv", index=False, float_format="%.5g")
    text = as_markdown(pastures, arguments.ticks)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(pastures, looks)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
