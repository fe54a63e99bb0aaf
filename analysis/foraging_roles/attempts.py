"""Every attempt at every way to come to roles, judged in bodies in worlds of its own.

python -m analysis.foraging_roles.attempts [--quick]

A row of `results/attempts.csv` is one attempt, condition and world; `results/attempts.md` has the
attempts side by side, the one that was picked for the model marked, and below them the means with
intervals over trainings and worlds. All are measured by what their robots bring home
(`by_deliveries`), in the worlds for reporting. What was judged already is not judged again; to
judge an attempt anew, take its rows out of the file.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from socialmind.catalogue import load_file
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription

from .minds import minds_of
from .role_trainings import PLANS
from .threshold_scan import CONTROLLERS, RULES
from .trainings import MODEL
from .worlds import REPORTED

MEASURES = load_file(MODEL / "measures.py")
RESULTS = Path(__file__).parent / "results"
WORLDS, FEW = 40, 2
TICKS, SHORT = 60_000, 4000
PICKED = "the model's mind"
CONDITIONS: Mapping[str, Mapping[str, int]] = {
    "undisturbed": {},
    "ratio turned round": {"reverse_at": TICKS // 2 - 1},
    "three away": {"remove_at": TICKS // 2 - 1, "removed_role": 0},
    "three added": {"add_at": TICKS // 2 - 1},
}
RECORD = (
    "last_beyond", "changed", "robot_ticks", "present", "settled_at", "changes_settled",
    "settled_changes", "settled_robot_ticks", "began_at", "robots.delivered_a",
    "robots.delivered_b",
)  # fmt: skip
KEYS = ["way", "attempt", "condition", "world"]
JUDGED = ["within_one", "changes", "settled_after", "delivered"]


@dataclass(frozen=True)
class Contestant:
    """Robots that are judged.

    Attributes:
        way: how they came to decide as they do.
        attempt: which of several; 0 where nothing was learned.
        mind: theirs; None for that of the model.
        parameters: of `ForagingByThresholds`; a learned mind decides by default.
    """

    way: str
    attempt: int
    mind: MindDescription | None = None
    parameters: Mapping[str, float] = field(default_factory=lambda: {"unlearned": 0})


def contestants() -> Iterator[Contestant]:
    """Yield all that are judged: the model's mind, all attempts kept, and what is programmed."""
    yield Contestant(PICKED, 1)
    for name in PLANS:
        for attempt, mind in minds_of(name).items():
            yield Contestant(name, attempt, mind)
    yield Contestant("programmed", 0, None, {"programmed": 1.0})
    for name, parameters in CONTROLLERS.items():
        yield Contestant(name, 0, None, parameters)
    for code, name in enumerate(("fixed roles", "random roles", "greedy"), 1):
        yield Contestant(name, 0, None, {"unlearned": code})


def judged(
    one: Contestant, condition: str, worlds: Sequence[int], ticks: int = TICKS
) -> pd.DataFrame:
    """Return what robots come to, a row for each world.

    Args:
        one: the robots.
        condition: what happens to them half-way.
        worlds: their seeds.
        ticks: of a run.
    """
    episodes = Episodes(
        RULES.ForagingByThresholds,
        {**one.parameters, **CONDITIONS[condition]},
        hierarchy=one.mind,
        ticks=ticks,
        record=RECORD,
    )
    fields = {name: values[0] for name, values in episodes.run(None, worlds).fields.items()}
    rows = []
    for place, world in enumerate(worlds):
        seen = {name: values[place] for name, values in fields.items()}
        objects = seen.pop("robots.delivered_a").sum() + seen.pop("robots.delivered_b").sum()
        late, began = seen.pop("last_beyond"), seen.pop("began_at")
        rows.append(
            {
                "way": one.way,
                "attempt": one.attempt,
                "condition": condition,
                "world": world,
                "within_one": int(late[0] < 0.75 * ticks),
                "changes": MEASURES.changes_after_settling(**seen, ticks=ticks),
                "settled_after": MEASURES.ticks_to_settle(seen["settled_at"], began, ticks),
                "delivered": int(objects),
            }
        )
    return pd.DataFrame(rows)


def judge_all(path: Path, worlds: Sequence[int], ticks: int = TICKS) -> pd.DataFrame:
    """Judge all that are not judged yet, and keep what comes of it after each.

    Args:
        path: of the table.
        worlds: their seeds.
        ticks: of a run.
    """
    table = pd.read_csv(path) if path.is_file() else pd.DataFrame(columns=[*KEYS, *JUDGED])
    for one in contestants():
        for condition in CONDITIONS:
            same = (table["way"] == one.way) & (table["attempt"] == one.attempt)
            known = set(table.loc[same & (table["condition"] == condition), "world"])
            missing = [world for world in worlds if world not in known]
            if missing:
                found = judged(one, condition, missing, ticks)
                table = pd.concat([table, found], ignore_index=True) if len(table) else found
                path.parent.mkdir(parents=True, exist_ok=True)
                table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
                print(one.way, one.attempt, condition, file=sys.stderr, flush=True)
    return table


def report(table: pd.DataFrame) -> str:
    """Return the attempts side by side, and the means of each way, as Markdown."""
    conditions = [one for one in CONDITIONS if one in set(table["condition"])]
    lines = [
        "| way | attempt | worlds | " + " | ".join(conditions) + " | changes | objects |",
        "|---" * (len(conditions) + 5) + "|",
    ]
    for (way, attempt), part in table.groupby(["way", "attempt"], sort=False):
        within = part.groupby("condition")["within_one"].mean()
        calm = part[part["condition"] == "undisturbed"]
        marked = " (picked)" if way == PICKED else ""
        cells = [f"{way}{marked}", str(attempt or "–"), str(part["world"].nunique())]
        cells += [f"{within[one]:.0%}" if one in within else "–" for one in conditions]
        cells += [f"{calm['changes'].mean():.2f}", f"{calm['delivered'].mean():.0f}"]
        lines.append("| " + " | ".join(cells) + " |")
    lines += [
        "",
        "| way | trainings | condition | within one | over trainings and worlds | worst, best |",
        "|---|---|---|---|---|---|",
    ]
    for (way, condition), part in table.groupby(["way", "condition"], sort=False):
        square = part.pivot_table(index="attempt", columns="world", values="within_one")
        square = square.dropna(axis="columns")  # the worlds in which all were judged
        if len(square) < 2 or square.empty:
            continue
        found = crossed_interval(square.to_numpy())
        each = square.mean(axis=1)
        lines.append(
            f"| {way} | {len(square)} | {condition} | {found.mean:.0%} | "
            f"{found.low:.0%} to {found.high:.0%} | {each.min():.0%}, {each.max():.0%} |"
        )
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str]) -> None:
    """Judge all, keep what comes of it, and print it."""
    if "--quick" in arguments:
        parts = [judged(one, "undisturbed", REPORTED[:FEW], SHORT) for one in contestants()]
        print(report(pd.concat(parts, ignore_index=True)))
        return
    table = judge_all(RESULTS / "attempts.csv", REPORTED[:WORLDS])
    text = report(table)
    (RESULTS / "attempts.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1:])
