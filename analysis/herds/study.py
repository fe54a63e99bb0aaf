"""Whether herds form and dissolve, how long they live, and what their culturons do for that.

    python -m analysis.herds.study
    python -m analysis.herds.study --seeds 5 --out /tmp/herds

Writes pastures.csv and herds.csv (a row for each), tables.md, and the figure as study.pdf and .png.
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

from .pastures import BEGIN, EVERY, SETTINGS, lived
from .plots import draw
from .survival import surviving

HERE = Path(__file__).parent / "results"
SHOWN = {
    "herds": ("herds at a time", 2),
    "two_or_more": ("share of time with two herds or more", 3),
    "in_herds": ("share of cows in a herd", 3),
    "largest": ("cows of the largest herd", 1),
    "founded": ("herds founded in 1,000 ticks", 2),
    "ended": ("herds ended in 1,000 ticks", 2),
    "to_leader": ("patches from a follower to its leader", 2),
    "apart": ("patches between two cows", 2),
    "energy": ("energy of a cow, at the end", 0),
    "cows": ("cows left at the end", 1),
}


def shown(one: Interval, digits: int = 2) -> str:
    """Return a mean with its interval."""
    form = f",.{digits}f"
    if not math.isfinite(one.low):
        return f"{one.mean:{form}}"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def life(herds: pd.DataFrame) -> Interval | None:
    """Return the mean life of a herd: the ticks of all herds over the herds that ended.

    Args:
        herds: a row for each, of one setting; those that still live count with their ticks.

    Returns:
        The mean with its interval over seeds; None where none ended.
    """
    seeds = herds.groupby("seed")[["life", "ended"]].sum().to_numpy(float)
    if not seeds[:, 1].any():
        return None
    return interval_of(seeds, combine=lambda ticks, ended: ticks / ended if ended else math.nan)


def longer(herds: pd.DataFrame, others: pd.DataFrame) -> Interval | None:
    """Return by how many ticks herds live longer than those of another setting, on the same seeds.

    Args:
        herds: a row for each, of one setting.
        others: the same of the other.

    Returns:
        The difference of their mean lives; None where in one of them no herd ended.
    """
    sums = [part.groupby("seed")[["life", "ended"]].sum() for part in (herds, others)]
    pairs = pd.concat(sums, axis=1, join="inner").to_numpy(float)
    if not len(pairs) or not pairs[:, 1].any() or not pairs[:, 3].any():
        return None
    return interval_of(pairs, combine=lambda a, b, c, d: a / b - c / d if b and d else math.nan)


def half_life(herds: pd.DataFrame) -> float:
    """Return the age that half of the herds outlive; infinite where more than half do."""
    ages, shares = surviving(herds["life"], herds["ended"])
    return next((age for age, share in zip(ages, shares, strict=True) if share <= 0.5), math.inf)


def as_markdown(pastures: pd.DataFrame, herds: pd.DataFrame, ticks: int) -> str:
    """Return what was found as tables."""
    seeds = pastures["seed"].nunique()
    lines = [
        f"{seeds} seeds, {ticks:,} ticks; levels from tick {BEGIN} on. Means, in brackets "
        "intervals of 95 % over seeds.",
        "",
        f"| | {' | '.join(SETTINGS)} |",
        "|---|" + "---|" * len(SETTINGS),
    ]
    of = {setting: pastures[pastures["setting"] == setting] for setting in SETTINGS}
    own = {setting: herds[herds["setting"] == setting] for setting in SETTINGS}
    for name, (title, digits) in SHOWN.items():
        columns = [rows[name].dropna().to_numpy() for rows in of.values()]
        cells = [shown(interval_of(one), digits) if len(one) else "–" for one in columns]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    lives = [life(rows) for rows in own.values()]
    cells = [shown(one, 0) if one else "none ended" for one in lives]
    lines.append(f"| ticks that a herd lives, mean | {' | '.join(cells)} |")
    halves = [half_life(rows) for rows in own.values()]
    cells = [f"{one:,.0f}" if math.isfinite(one) else "–" for one in halves]
    lines.append(f"| ticks that half of the herds outlive | {' | '.join(cells)} |")
    cells = [f"{(rows['largest'] > 1).mean():.2f}" for rows in own.values()]
    lines.append(f"| share of herds that ever had a follower | {' | '.join(cells)} |")
    lines += ["", "Differences to participation 0, seed by seed:", ""]
    for setting in ("participation 4", "participation 40"):
        for name in ("herds", "largest", "founded", "to_leader", "apart"):
            title = SHOWN[name][0]
            one = compared(of[setting][name], of["participation 0"][name]).difference
            lines.append(f"- {setting}, {title}: {shown(one)}")
        more = longer(own[setting], own["participation 0"])
        if more is not None:
            lines.append(f"- {setting}, ticks that a herd lives, mean: {shown(more, 0)}")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--ticks", type=int, default=1_500)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2 or arguments.ticks <= 2 * BEGIN or arguments.ticks % EVERY:
        parser.error(f"at least two seeds, more than {2 * BEGIN:,} ticks, a multiple of {EVERY}")
    calls = [
        (setting, seed, arguments.ticks) for setting in SETTINGS for seed in range(arguments.seeds)
    ]
    answers = list(side_by_side(lived, calls, arguments.workers, together=5))
    pastures = pd.DataFrame([row for row, _, _ in answers])
    herds = pd.DataFrame([one for _, several, _ in answers for one in several])
    looks = pd.DataFrame([one for _, _, several in answers for one in several])
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, table in (("pastures", pastures), ("herds", herds)):
        table.to_csv(arguments.out / f"{name}.csv", index=False, float_format="%.5g")
    text = as_markdown(pastures, herds, arguments.ticks)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(looks, herds)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
