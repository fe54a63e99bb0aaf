"""Which mind of each attempt at `like_bodies` counts: chosen in bodies, in worlds for choosing.

python -m analysis.foraging_roles.choosing           # judges what is not judged yet
python -m analysis.foraging_roles.choosing report    # then the attempts' minds in further worlds

A row of `results/chosen_in_bodies.csv` is a mind that a training has come to: in which lesson, and
as what, the winner of its finals or the best of a generation. It says the share of worlds that stay
within one robot of the wanted split, by what robots bring home, all through the last quarter:
undisturbed, after the ratio turns round, and after three robots in A are taken away.

The winner of the last lesson is judged first; the others as long as none of the training's minds
has shares of `ENOUGH` or more. A mind is judged no further once a share is below `TOO_FEW`. The
mind with the greatest least share is the attempt's; of equals that with the greater sum, then the
later one. An attempt has one training, the one with its number. As long as some fall short of
`ENOUGH` and trainings are left, the one with the least share of all begins anew: it has the next
training too.

A row of `results/chosen_reported.csv` is an attempt's mind in worlds for reporting other than those
of `analysis/specialisation`, which tells of more, in ten worlds an attempt.

`results/chosen_in_bodies.csv` is kept as the program of commit 631ba9b0 made it, which took
fewer than three robots away where fewer were in A. By today's, shares with robots taken away are
others (of the winner of training 2 0.92, not 0.86), and so may be who is chosen. To make it again
check that commit out and delete the table; rows that today's program adds are of another rule.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.catalogue import load_file
from socialmind.learning import Training
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import load_result
from socialmind.learning.training.finalists import individual_of
from socialmind.mind import MindDescription

from .role_trainings import PLANS
from .trainings import MODEL
from .worlds import CHOOSING, REPORTED

RULES = load_file(MODEL / "by_deliveries.py")
OUT = Path(__file__).parent / "results" / "chosen_in_bodies.csv"
REPORT = OUT.with_name("chosen_reported.csv")
NAME, TRAINED = "chosen_in_bodies", "like_bodies"
KEYS = ["training", "lesson", "what"]
TICKS, WORLDS = 60_000, 36
FURTHER = REPORTED[50:90]
"""Worlds of the report, behind those of `analysis/specialisation`."""
LANES = 8
"""Worlds side by side: the minds of their nine robots each fit into a core's own cache."""
HALF = TICKS // 2 - 1
CONDITIONS: Mapping[str, Mapping[str, int]] = {
    "removed": {"remove_at": HALF},
    "turned": {"reverse_at": HALF},
    "undisturbed": {},
}
"""What is asked for, the hardest first."""
CANDIDATES = ((2, "best"), (2, "winner"), (3, "best"), (3, "winner"))
"""Lessons of the curriculum, and what is a mind of a training in each."""
ATTEMPTS, ENOUGH, TOO_FEW = 10, 0.85, 0.75
"""How many there are; the least share of worlds from which one has no further training, and the
share below which a mind has no hope of that."""

Candidate = tuple[int, int, str]
"""Training, lesson, and what it is there."""


def candidates(trainings: Training, number: int) -> dict[Candidate, MindDescription]:
    """Return the minds that a training has come to, each once."""
    mind, found = trainings.mind(number), {}
    genomes: list[np.ndarray] = []
    for lesson, what in reversed(CANDIDATES):
        record, arrays = load_result(trainings.folder / "attempts" / str(number), lesson)
        one = individual_of(archive.part(arrays, f"{what}/"))
        if not any(np.array_equal(one.genome, other) for other in genomes):
            genomes.append(one.genome)
            learned = one.given_to([mind.skill(name) for name in record["skills"]])
            found[number, lesson, what] = mind.with_modules(skills=learned)
    return found


def settles(
    mind: MindDescription,
    parameters: Mapping[str, int],
    worlds: range = CHOOSING[:WORLDS],
    ticks: int = TICKS,
) -> float:
    """Return the share of worlds within one robot of the wanted split all through the last quarter.

    The arguments are those of `each_settles`.
    """
    return float(each_settles(mind, parameters, worlds, ticks).mean())


def each_settles(
    mind: MindDescription | None,
    parameters: Mapping[str, float],
    worlds: range,
    ticks: int = TICKS,
    rules: Any = RULES.ForagingByDeliveries,
) -> NDArray[np.bool_]:
    """Return, world by world, whether it stays within one robot all through the last quarter.

    Args:
        mind: the robots'; None for that of the model.
        parameters: of the model.
        worlds: their seeds.
        ticks: of a run.
        rules: the model, one that sees robots by what they bring home.
    """
    episodes = Episodes(
        rules, parameters, hierarchy=mind, ticks=ticks, lanes=LANES, record=("last_beyond",)
    )
    beyond = np.asarray(episodes.run(None, worlds).fields["last_beyond"])[0, :, 0]
    return beyond < 0.75 * ticks


def judge(path: Path = OUT) -> pd.DataFrame:
    """Judge all minds that are not judged yet, and keep what comes of it after each."""
    trainings = Training(PLANS.kept / TRAINED)
    rows = read(path).to_dict("records")
    known = {tuple(row[name] for name in KEYS) for row in rows}
    for number in trainings.finished:
        for one, mind in candidates(trainings, number).items():
            own = [row for row in rows if row["training"] == number]
            if one in known or any(least(row) >= ENOUGH for row in own):
                continue
            shares = dict.fromkeys(CONDITIONS, np.nan)
            for name, given in CONDITIONS.items():
                shares[name] = settles(mind, given)
                if shares[name] < TOO_FEW:
                    break
            rows.append({**dict(zip(KEYS, one, strict=True)), **shares})
            table = pd.DataFrame(rows).sort_values(KEYS)
            table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
            print(*rows[-1].values(), file=sys.stderr, flush=True)
    return read(path)


def report(path: Path = REPORT) -> pd.DataFrame:
    """Judge the attempts' minds in worlds for reporting, and keep what comes of it after each."""
    rows: list[dict[str, Any]] = []
    for attempt, mind in minds().items():
        shares = {name: settles(mind, given, FURTHER) for name, given in CONDITIONS.items()}
        rows.append({"attempt": attempt, **shares})
        pd.DataFrame(rows).to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
        print(*rows[-1].values(), file=sys.stderr, flush=True)
    return pd.DataFrame(rows)


def least(row: Mapping[Any, Any]) -> float:
    """Return the least share of worlds of a mind, of those judged."""
    return float(np.nanmin([row[name] for name in CONDITIONS]))


def read(path: Path = OUT) -> pd.DataFrame:
    """Return what is kept, or an empty table."""
    if not path.is_file():
        return pd.DataFrame(columns=[*KEYS, *CONDITIONS])
    return pd.read_csv(path)


def chosen(
    table: pd.DataFrame, attempts: int = ATTEMPTS, enough: float = ENOUGH
) -> dict[int, Candidate]:
    """Return which mind is each attempt's, by its number.

    Args:
        table: of minds that were judged.
        attempts: how many.
        enough: the least share of worlds from which an attempt has no further training.

    >>> table = pd.DataFrame({"training": [1, 1, 2, 3], "lesson": [2, 3, 3, 3], "what": "winner",
    ...                       "undisturbed": 1.0, "turned": [0.7, 0.5, 0.9, 0.8],
    ...                       "removed": [0.7, 1.0, 1.0, 0.9]})
    >>> chosen(table, 2, 0.9)
    {1: (3, 3, 'winner'), 2: (2, 3, 'winner')}
    """
    own = trainings_of(table, attempts, enough)
    picked = {attempt: ranked(minds_among(table, of)).iloc[-1] for attempt, of in own.items()}
    return {attempt: named(one) for attempt, one in picked.items()}


def trainings_of(
    table: pd.DataFrame, attempts: int = ATTEMPTS, enough: float = ENOUGH
) -> dict[int, list[int]]:
    """Return the trainings of each attempt, by its number; the arguments are those of `chosen`."""
    trained = set(table["training"])
    own = {attempt: [attempt] for attempt in range(1, attempts + 1) if attempt in trained}

    def least_of(attempt: int) -> float:
        return float(ranked(minds_among(table, own[attempt])).iloc[-1]["least"])

    for number in sorted(trained - set(range(1, attempts + 1))):
        short = min(own, key=least_of)
        if least_of(short) >= enough:
            break
        own[short].append(number)
    return own


def minds_among(table: pd.DataFrame, trainings: Sequence[int]) -> pd.DataFrame:
    """Return the rows of trainings."""
    return table[table["training"].isin(trainings)]


def ranked(table: pd.DataFrame) -> pd.DataFrame:
    """Return minds from the worst to the best: by the least share, the sum, then the later one."""
    shares = table[list(CONDITIONS)]
    order = table.assign(least=shares.min(axis=1), sum=shares.sum(axis=1))
    return order.sort_values(["least", "sum", *KEYS])


def named(row: Any) -> Candidate:
    """Return which mind a row tells of."""
    return int(row["training"]), int(row["lesson"]), str(row["what"])


def minds(path: Path = OUT) -> dict[int, MindDescription]:
    """Return the attempts' minds by number; none where none is chosen."""
    choice = chosen(read(path))
    if not choice:
        return {}
    trainings = Training(PLANS.kept / TRAINED)
    return {attempt: candidates(trainings, one[0])[one] for attempt, one in choice.items()}


if __name__ == "__main__":
    print((report() if sys.argv[1:] == ["report"] else judge()).to_string(index=False))
