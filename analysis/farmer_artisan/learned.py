"""The farmer-artisan society with learned minds, and with the schemes distilled from them.

    python -m analysis.farmer_artisan.learned
    python -m analysis.farmer_artisan.learned --seeds 3 --ticks 5000 --attempts 2 --out /tmp/learned

Societies on the same seeds: the scheme that was written; the minds of all kept attempts
(`trainings.py`); what is distilled from each of them; and the mind of the model, one more attempt
at the same lesson. Writes learned.csv (one row a society, attempt and seed), learned-attempts.csv
(one row an attempt), distilled.yaml (from the mind of the model), learned.json, and the tables in
README.md.
"""

import argparse
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pandas as pd

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model, model_folder
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import interval_of
from socialmind.experiments.measures.specialisation import Course
from socialmind.learning import Training
from socialmind.learning.distilling import (
    Distillation,
    available,
    choices,
    distilled,
    states_of,
    weights_by_hierarchy,
)
from socialmind.mind import MindDescription
from socialmind.work.side_by_side import side_by_side

from .replicate import course_of, seen
from .study import write_between
from .trainings import PLANS

HERE = Path(__file__).parent
BEGIN, END = "<!-- learned: begin -->", "<!-- learned: end -->"
MODEL = "farmer_artisan_learned"
SHIPPED = 0
"""The number, among attempts, of the mind of the model."""
COMFORT = 800.0  # wheat that leaves no need
STATE_SEEDS = range(10_000, 10_004)  # of the societies whose states the mind is asked in
STATE_TICKS = range(100, 3_001, 100)
EVERY = 500
"""Ticks between two records."""
SHOWN = {
    "prosperity": "wheat of a person, in comfortable stocks",
    "specialised": "share of agents specialised",
    "agents_to_tasks": "division of labour, agents to work",
    "agents_to_tasks_by_chance": "the same by luck alone",
    "beyond_chance": "beyond luck",
    "delivered": "tools delivered to others",
    "role_changes": "role changes per agent and 10,000 ticks while settled",
}
OF_ATTEMPTS = ("prosperity", "beyond_chance", "delivered")


def kept() -> Training:
    """Return the attempts that are kept."""
    return Training(PLANS.kept / "taught")


def mind_of(attempt: int) -> MindDescription:
    """Return the mind of a kept attempt; of number `SHIPPED`, that of the model."""
    if attempt == SHIPPED:
        return MindDescription.load(model_folder(MODEL) / "mind")
    return kept().mind(attempt)


def distil(mind: MindDescription) -> tuple[Distillation, dict[str, float]]:
    """Distil a scheme from a learned mind, in states of its own society.

    Returns:
        The distillation, and what the mind does most: the mean probability of each plan.
    """
    learned = load_model(MODEL)
    population = learned.populations["humans"]
    scheme = CognitiveScheme.load(learned.folder() / population.mind)
    states = np.concatenate(
        [
            states_of(learned(seed=seed, hierarchy=mind), "humans", STATE_TICKS)
            for seed in STATE_SEEDS
        ]
    )
    weights = weights_by_hierarchy(states, scheme, mind, population.weighing)
    chosen = choices(weights, available(states, scheme), scheme).mean(axis=0)
    plans = dict(zip(scheme.plans, chosen.round(4).tolist(), strict=True))
    return distilled(states, weights, scheme, "distilled"), plans


def lived(model: Any, ticks: int, every: int) -> Course:
    """Run a society, and return what its agents were seen to be and to do.

    Args:
        model: before its first tick.
        ticks: how long.
        every: ticks between two records.
    """
    people = [seen(model)]
    for _ in range(every, ticks + 1, every):
        model.advance(every)
        people.append(seen(model))
    return course_of(people)


def measures(model: Any, course: Course) -> dict[str, float]:
    """Measure a society that was run.

    Args:
        model: at the end.
        course: what was seen.
    """
    humans, found = model.humans, course.measures()
    return {
        **found,
        "beyond_chance": found["agents_to_tasks"] - found["agents_to_tasks_by_chance"],
        "prosperity": float(humans.wheat.mean()) / COMFORT,
        "delivered": float(np.maximum(humans.sold - humans.bought, 0).sum()),
        "land_specialisation": float(model.series()["specialisation"]),
    }


# All societies ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Societies:
    """What was found of all societies.

    Attributes:
        worlds: a row for each `society`, `attempt` and `seed`, with measures.
        course: `society`, `attempt`, `seed`, `tick`, `artisans` and `specialised`.
        distilled: of each attempt, the scheme that was distilled from its mind and how well it
            agrees, and the mean probability of each plan.
    """

    worlds: pd.DataFrame
    course: pd.DataFrame
    distilled: Mapping[int, tuple[Distillation, dict[str, float]]]


def live(
    society: str, attempt: int, seed: int, ticks: int, schemes: str
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Run a society, and return its measures and its course.

    Args:
        society: `written`, `learned`, `distilled` or `shipped`.
        attempt: whose mind it has, or what is distilled from it.
        seed: of every draw.
        ticks: how long.
        schemes: the folder of distilled schemes.
    """
    if society in ("learned", "shipped"):
        model = load_model(MODEL)(seed=seed, hierarchy=mind_of(attempt))
    else:
        own = {"scheme": _scheme(schemes, attempt)} if society == "distilled" else {}
        model = load_model("farmer_artisan")(seed=seed, **own)
    course = lived(model, ticks, EVERY)
    key = {"society": society, "attempt": attempt, "seed": seed}
    split = course.split
    artisans = split["artisan"] if "artisan" in split else pd.Series(0, split.index)
    over_time = pd.DataFrame({"artisans": artisans, "specialised": course.specialised})
    return {**key, **measures(model, course)}, [
        {**key, **one} for one in over_time.reset_index().to_dict("records")
    ]


def all_societies(
    seeds: int, ticks: int, attempts: int | None = None, workers: int | None = None
) -> Societies:
    """Distil a scheme from each mind, and run all societies on the same seeds.

    Args:
        seeds: how many, from 0.
        ticks: of each.
        attempts: the first ones, so many at most; all that are kept by default.
        workers: processes; one for each processor by default.
    """
    numbers = kept().finished[:attempts]
    with _distilled([SHIPPED, *numbers], workers) as (schemes, found):
        calls = [
            (society, attempt, seed, ticks, schemes)
            for society, several in {
                "written": [0], "learned": numbers, "distilled": numbers, "shipped": [SHIPPED],
            }.items()
            for attempt in several
            for seed in range(seeds)
        ]  # fmt: skip
        answers = list(side_by_side(live, calls, workers))
    return Societies(
        pd.DataFrame([row for row, _ in answers]),
        pd.DataFrame([one for _, several in answers for one in several]),
        found,
    )


@contextmanager
def _distilled(
    attempts: list[int], workers: int | None
) -> Iterator[tuple[str, Mapping[int, tuple[Distillation, dict[str, float]]]]]:
    """Yield a folder of schemes, one distilled from the mind of each attempt, and what they are."""
    with TemporaryDirectory() as folder:
        calls = [(one,) for one in attempts]
        found = dict(zip(attempts, side_by_side(_distil, calls, workers), strict=True))
        for attempt, (one, _) in found.items():
            one.scheme.save(_scheme(folder, attempt))
        yield folder, found


def _distil(attempt: int) -> tuple[Distillation, dict[str, float]]:
    return distil(mind_of(attempt))


def _scheme(folder: str, attempt: int) -> Path:
    return Path(folder) / f"attempt-{attempt}.yaml"


# What is written ----------------------------------------------------------------------------------


def by_attempt(found: Societies) -> pd.DataFrame:
    """Return a row for each attempt: its score in finals, its society's means, its distillation."""
    scores = kept().lessons.set_index("attempt")["score"]
    worlds = found.worlds
    learned = worlds[worlds["society"].isin(["learned", "shipped"])]
    means = learned.groupby("attempt", sort=False)[list(OF_ATTEMPTS)].mean()
    of_schemes = worlds[worlds["society"] == "distilled"].groupby("attempt")[list(OF_ATTEMPTS)]
    distilled_means = of_schemes.mean().add_prefix("distilled_")
    rows = []
    for attempt, (one, plans) in found.distilled.items():
        rows.append(
            {
                "attempt": "the model's" if attempt == SHIPPED else attempt,
                "finals": scores.get(attempt, np.nan),
                **means.loc[attempt].to_dict(),
                **{f"chosen_{plan}": share for plan, share in plans.items()},
                "links": one.links,
                "overlap": one.agreement.overlap,
                **(distilled_means.loc[attempt].to_dict() if attempt != SHIPPED else {}),
            }
        )
    return pd.DataFrame(rows)


def as_markdown(found: Societies, attempts: pd.DataFrame, seeds: int, ticks: int) -> str:
    """The results as two tables."""
    societies = list(dict.fromkeys(found.worlds["society"]))
    lines = [
        f"{seeds} seeds, {ticks:,} ticks; means, in brackets intervals of 95 %: over attempts and "
        "seeds where there are attempts, over seeds of the others.",
        "",
        f"| | {' | '.join(societies)} |",
        f"|---|{'---|' * len(societies)}",
    ]
    for name, title in SHOWN.items():
        cells = [_cell(found.worlds[found.worlds["society"] == one], name) for one in societies]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    lines += [
        "",
        "| attempt | score of its finals | wheat of a person | division of labour beyond luck | "
        "tools delivered | links of the distilled scheme | overlap of its choices | wheat by it | "
        "division of labour beyond luck by it |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in attempts.to_dict("records"):
        lines.append(
            f"| {row['attempt']} | {_known(row['finals'], 2)} | {row['prosperity']:.2f} | "
            f"{row['beyond_chance']:.3f} | {row['delivered']:,.0f} | {row['links']} | "
            f"{row['overlap']:.3f} | {_known(row['distilled_prosperity'], 2)} | "
            f"{_known(row['distilled_beyond_chance'], 3)} |"
        )
    return "\n".join(lines) + "\n"


def _known(value: float, digits: int) -> str:
    return "–" if np.isnan(value) else f"{value:.{digits}f}"


def _cell(own: pd.DataFrame, name: str) -> str:
    """A mean with its interval; of what is unknown of some seeds, over those that are known."""
    table = own.pivot_table(index="attempt", columns="seed", values=name, dropna=False)
    known = table.dropna(axis="columns").to_numpy(float)
    if not known.size:
        return "–"
    one = crossed_interval(known) if len(known) > 1 else interval_of(known[0])
    return f"{one.mean:.3g} ({one.low:.3g} … {one.high:.3g})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--ticks", type=int, default=50_000)
    parser.add_argument("--attempts", type=int, help="the first ones; all that are kept by default")
    parser.add_argument("--workers", type=int, help="processes; one for each processor by default")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    found = all_societies(arguments.seeds, arguments.ticks, arguments.attempts, arguments.workers)
    found.worlds.to_csv(out / "learned.csv", index=False, float_format="%.6g")
    attempts = by_attempt(found)
    attempts.to_csv(out / "learned-attempts.csv", index=False, float_format="%.6g")
    own, plans = found.distilled[SHIPPED]
    own.scheme.save(out / "distilled.yaml")
    summary = {
        "seeds": arguments.seeds,
        "ticks": arguments.ticks,
        "every": EVERY,
        "links": own.links,
        "overlap": own.agreement.overlap,
        "same": own.agreement.same,
        "overlap_of_all_links": own.unpruned.overlap,
        "plans": plans,
    }
    (out / "learned.json").write_text(json.dumps(summary, indent=1) + "\n")
    text = as_markdown(found, attempts, arguments.seeds, arguments.ticks)
    write_between(out / "README.md", text, BEGIN, END)
    print(text)


if __name__ == "__main__":
    main()
