"""Which mind of each attempt at `like_bodies` counts: chosen in bodies, in worlds for choosing.

python -m analysis.foraging_roles.choosing      # judges what is not judged yet

A row of `results/chosen_in_bodies.csv` is a mind that an attempt has come to: in which lesson, and
as what, the winner of its finals or the best of a generation. It says the share of worlds that stay
within one robot of the wanted split, by what robots bring home, all through the last quarter:
undisturbed, after the ratio turns round, and after three robots in A are taken away. The mind with
the greatest least share is the attempt's; of equals that with the greater sum, then the later one.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.learning import Training
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import load_result
from socialmind.learning.training.finalists import individual_of
from socialmind.mind import MindDescription

from .role_trainings import PLANS
from .trainings import MODEL
from .worlds import CHOOSING

RULES = load_file(MODEL / "by_deliveries.py")
OUT = Path(__file__).parent / "results" / "chosen_in_bodies.csv"
NAME, TRAINED = "chosen_in_bodies", "like_bodies"
KEYS = ["attempt", "lesson", "what"]
TICKS, WORLDS = 60_000, 12
HALF = TICKS // 2 - 1
CONDITIONS: Mapping[str, Mapping[str, int]] = {
    "undisturbed": {},
    "turned": {"reverse_at": HALF},
    "removed": {"remove_at": HALF},
}
CANDIDATES = ((2, "best"), (2, "winner"), (3, "best"), (3, "winner"))
"""Lessons of the curriculum, and what is a mind of an attempt in each."""

Candidate = tuple[int, str]


def candidates(training: Training, attempt: int) -> dict[Candidate, MindDescription]:
    """Return the minds that an attempt has come to, each once."""
    mind, found = training.mind(attempt), {}
    genomes: list[np.ndarray] = []
    for lesson, what in reversed(CANDIDATES):
        record, arrays = load_result(training.folder / "attempts" / str(attempt), lesson)
        one = individual_of(archive.part(arrays, f"{what}/"))
        if not any(np.array_equal(one.genome, other) for other in genomes):
            genomes.append(one.genome)
            learned = one.given_to([mind.skill(name) for name in record["skills"]])
            found[lesson, what] = mind.with_modules(skills=learned)
    return found


def settles(
    mind: MindDescription,
    parameters: Mapping[str, int],
    worlds: range = CHOOSING[:WORLDS],
    ticks: int = TICKS,
) -> float:
    """Return the share of worlds within one robot of the wanted split all through the last quarter.

    Args:
        mind: the robots'.
        parameters: of the model.
        worlds: their seeds.
        ticks: of a run.
    """
    episodes = Episodes(
        RULES.ForagingByDeliveries, parameters, hierarchy=mind, ticks=ticks, record=("last_beyond",)
    )
    beyond = np.asarray(episodes.run(None, worlds).fields["last_beyond"])[0, :, 0]
    return float((beyond < 0.75 * ticks).mean())


def judge(path: Path = OUT) -> pd.DataFrame:
    """Judge all minds that are not judged yet, and keep what comes of it after each."""
    training = Training(PLANS.kept / TRAINED)
    rows = read(path).to_dict("records")
    known = {(row["attempt"], row["lesson"], row["what"]) for row in rows}
    for attempt in training.finished:
        for (lesson, what), mind in candidates(training, attempt).items():
            if (attempt, lesson, what) in known:
                continue
            shares = {name: settles(mind, given) for name, given in CONDITIONS.items()}
            rows.append({"attempt": attempt, "lesson": lesson, "what": what, **shares})
            table = pd.DataFrame(rows).sort_values(KEYS)
            table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
            print(*rows[-1].values(), file=sys.stderr, flush=True)
    return read(path)


def read(path: Path = OUT) -> pd.DataFrame:
    """Return what is kept, or an empty table."""
    if not path.is_file():
        return pd.DataFrame(columns=[*KEYS, *CONDITIONS])
    return pd.read_csv(path)


def chosen(table: pd.DataFrame) -> dict[int, Candidate]:
    """Return which mind is each attempt's.

    >>> chosen(pd.DataFrame({"attempt": [1, 1], "lesson": [2, 3], "what": "winner",
    ...                      "undisturbed": 1.0, "turned": [0.75, 0.5], "removed": [0.75, 1.0]}))
    {1: (2, 'winner')}
    """
    found: dict[int, Candidate] = {}
    for attempt, part in table.groupby("attempt"):
        shares = part[list(CONDITIONS)]
        order = part.assign(least=shares.min(axis=1), sum=shares.sum(axis=1))
        best = order.sort_values(["least", "sum", *KEYS]).iloc[-1]
        found[int(str(attempt))] = int(best["lesson"]), str(best["what"])
    return found


def minds(path: Path = OUT) -> dict[int, MindDescription]:
    """Return the attempts' minds by number; none where none is chosen."""
    choice = chosen(read(path))
    if not choice:
        return {}
    training = Training(PLANS.kept / TRAINED)
    return {attempt: candidates(training, attempt)[one] for attempt, one in choice.items()}


if __name__ == "__main__":
    print(judge().to_string(index=False))
