"""Three kinds of object in bodies: the scheme, thresholds, chance and greed.

python -m analysis.foraging_roles.three_kinds_in_bodies          # all, or gone on with
python -m analysis.foraging_roles.three_kinds_in_bodies 1:1:1    # this ratio alone
python -m analysis.foraging_roles.three_kinds_in_bodies --quick

A row of `results/three_kinds_in_bodies.csv` is a way, a ratio, what happens half-way, and a world
for reporting; `results/three_kinds_in_bodies.md` has the means. Robots are known by what they
bring home. What is measured is that of `three_kinds`, and the objects that a robot brings.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.learning.episodes.plane_episodes import Episodes

from .foraging_three import CHANCE, GREED, SCHEME, THRESHOLDS, ForagingThree
from .threshold_scan import CONTROLLERS
from .told_intervals import in_brackets
from .worlds import REPORTED

RESULTS = Path(__file__).parent / "results"
NAME = "three_kinds_in_bodies"
TICKS, SHORT, WORLDS, FEW, ROBOTS = 60_000, 3000, 10, 1, 9
NOTHING, TURNED = "nothing", "ratio turned round"
KEYS = ["ratio", "event", "way"]
SETTINGS = (("1:1:1", NOTHING), ("2:3:4", NOTHING), ("2:3:4", TURNED))
WAYS: Mapping[str, Mapping[str, float]] = {
    "programmed": {"decides": SCHEME},
    **{way: {"decides": THRESHOLDS, **given} for way, given in CONTROLLERS.items()},
    "random roles": {"decides": CHANCE},
    "greedy": {"decides": GREED},
}
"""Parameters of `ForagingThree`; the numbers are those chosen for two kinds."""
RECORD = ("off_late", "last_beyond", "robots.changes_brought", "robots.delivered", "robots.rescues")


def judged(
    way: str, ratio: str, event: str, worlds: Sequence[int], ticks: int = TICKS
) -> pd.DataFrame:
    """Return what robots come to, a row for each world.

    Args:
        way: how they decide.
        ratio: the parts that are wanted of A, B and C.
        event: what happens half-way.
        worlds: their seeds.
        ticks: of a run.
    """
    parts = dict(zip(("part_a", "part_b", "part_c"), map(float, ratio.split(":")), strict=True))
    late, half = int(0.75 * ticks), ticks // 2 - 1
    happens = {"reverse_at": half} if event == TURNED else {}
    given = {**WAYS[way], **parts, **happens, "late": late}
    episodes = Episodes(ForagingThree, given, ticks=ticks, record=RECORD)
    seen = {name: np.asarray(one)[0] for name, one in episodes.run(None, worlds).fields.items()}
    return pd.DataFrame(
        {
            "ratio": ratio,
            "event": event,
            "way": way,
            "attempt": 0,
            "world": list(worlds),
            "within_one": (seen["last_beyond"] < 0.75 * ticks).astype(int).ravel(),
            "off": seen["off_late"].ravel() / (ticks - late),
            "changes": seen["robots.changes_brought"].mean(axis=1) / ticks * 10_000,
            "brought": seen["robots.delivered"].mean(axis=1),
            "rescues": seen["robots.rescues"].sum(axis=1),
        }
    )


def report(table: pd.DataFrame) -> str:
    """Return the means with intervals as Markdown."""
    lines = [
        "| ratio | half-way | way | worlds | within one | off, of nine | changes | brought |",
        "|---" * 8 + "|",
    ]
    for key, part in table.groupby(KEYS, sort=False):
        cells = [
            in_brackets(part, name, form)
            for name, form in (("within_one", ".0%"), ("off", ".2f"), ("changes", ".2f"))
        ]
        found = [*key, len(part), *cells, f"{part['brought'].mean():.1f}"]
        lines.append("| " + " | ".join(map(str, found)) + " |")
    return "\n".join(lines) + "\n"


def read(path: Path) -> pd.DataFrame:
    """Return what is kept."""
    return pd.read_csv(path) if path.is_file() else pd.DataFrame(columns=KEYS)


def judge_all(path: Path, ratios: Sequence[str], worlds: Sequence[int]) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it after each.

    Args:
        path: of the table that is kept.
        ratios: those that are judged.
        worlds: their seeds.
    """
    table = read(path)
    done = set(table[KEYS].itertuples(index=False, name=None))
    for ratio, event in SETTINGS:
        for way in WAYS:
            if ratio in ratios and (ratio, event, way) not in done:
                found = judged(way, ratio, event, worlds)
                table = pd.concat([table, found], ignore_index=True) if len(table) else found
                table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
                print(ratio, event, way, file=sys.stderr, flush=True)
    return read(path)  # with the digits that are kept


def main(arguments: Sequence[str]) -> None:
    """Judge all, or ratios that are named, keep what comes of it and print it."""
    if "--quick" in arguments:
        first = [judged(way, *SETTINGS[0], REPORTED[:FEW], SHORT) for way in WAYS]
        print(report(pd.concat(first, ignore_index=True)))
        return
    known = dict.fromkeys(ratio for ratio, _ in SETTINGS)
    for word in arguments:
        if word not in known:
            raise SystemExit(f"no ratio {word!r}; there are {', '.join(known)}")
    table = judge_all(RESULTS / f"{NAME}.csv", list(arguments) or list(known), REPORTED[:WORLDS])
    (RESULTS / f"{NAME}.md").write_text(report(table), encoding="utf-8")
    print(report(table))


if __name__ == "__main__":
    main(sys.argv[1:])
