"""The farmer-artisan society with a learned mind, and with the scheme distilled from that mind.

    python -m analysis.farmer_artisan.learned
    python -m analysis.farmer_artisan.learned --seeds 3 --ticks 5000 --out /tmp/learned
    python -m analysis.farmer_artisan.learned --mind TRAINING/mind-attempt-1

Three societies on the same seeds: the scheme that was written, the mind that was learned, and what
was distilled from it. Writes learned.csv (one row a society and seed), comparison.csv (each against
the learned one), distilled.yaml, learned.json, and the table in README.md.
"""

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model, model_folder
from socialmind.experiments.measures.effects import comparisons
from socialmind.experiments.measures.intervals import interval_of
from socialmind.experiments.measures.specialisation import Course
from socialmind.learning.distilling import (
    Distillation,
    available,
    choices,
    distilled,
    states_of,
    weights_by_hierarchy,
)
from socialmind.mind import MindDescription

from .replicate import course_of, seen
from .study import write_between

HERE = Path(__file__).parent
BEGIN, END = "<!-- learned: begin -->", "<!-- learned: end -->"
COMFORT = 800.0  # wheat that leaves no need
STATE_SEEDS = range(10_000, 10_004)  # of the societies whose states the mind is asked in
STATE_TICKS = range(100, 3_001, 100)
SHOWN = {
    "prosperity": "wheat of a person, in comfortable stocks",
    "specialised": "share of agents specialised",
    "agents_to_tasks": "division of labour, agents to work",
    "agents_to_tasks_by_chance": "the same by luck alone",
    "delivered": "tools delivered to others",
    "role_changes": "role changes per agent and 10,000 ticks while settled",
}


def distil(mind: Path) -> tuple[Distillation, dict[str, float]]:
    """Distil a scheme from a learned mind, in states of its own society.

    Args:
        mind: its folder.

    Returns:
        The distillation, and what the mind does most: the mean probability of each plan.
    """
    learned = load_model("farmer_artisan_learned")
    population = learned.populations["humans"]
    scheme = CognitiveScheme.load(learned.folder() / population.mind)
    states = np.concatenate(
        [
            states_of(learned(seed=seed, hierarchy=mind), "humans", STATE_TICKS)
            for seed in STATE_SEEDS
        ]
    )
    weights = weights_by_hierarchy(states, scheme, MindDescription.load(mind), population.weighing)
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
    humans = model.humans
    return {
        **course.measures(),
        "prosperity": float(humans.wheat.mean()) / COMFORT,
        "delivered": float(np.maximum(humans.sold - humans.bought, 0).sum()),
        "land_specialisation": float(model.series()["specialisation"]),
    }


def as_markdown(table: pd.DataFrame, found: dict[str, Any]) -> str:
    """The results as a table."""
    societies = list(dict.fromkeys(table["society"]))
    lines = [
        f"{found['seeds']} seeds, {found['ticks']:,} ticks; means, in brackets intervals of 95 %.",
        "",
        f"| | {' | '.join(societies)} |",
        f"|---|{'---|' * len(societies)}",
    ]
    for name, title in SHOWN.items():
        cells = []
        for society in societies:
            values = table.loc[table["society"] == society, name].dropna()
            one = interval_of(values) if len(values) else None
            cells.append("–" if one is None else f"{one.mean:.3g} ({one.low:.3g} … {one.high:.3g})")
        lines.append(f"| {title} | {' | '.join(cells)} |")
    lines += [
        "",
        f"The distilled scheme has {found['links']} influence links; its choices overlap with "
        f"those of the mind by {found['overlap']:.3f}, and the most probable plan is the same in "
        f"{found['same']:.1%} of the states.",
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--ticks", type=int, default=50_000)
    parser.add_argument("--every", type=int, default=500, help="ticks between two records")
    parser.add_argument(
        "--mind", type=Path, default=model_folder("farmer_artisan_learned") / "mind"
    )
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    out, mind = arguments.out, arguments.mind.expanduser()
    out.mkdir(parents=True, exist_ok=True)
    found, plans = distil(mind)
    found.scheme.save(out / "distilled.yaml")
    farmers, learned = load_model("farmer_artisan"), load_model("farmer_artisan_learned")
    societies: dict[str, Callable[[int], Any]] = {
        "written": lambda seed: farmers(seed=seed),
        "learned": lambda seed: learned(seed=seed, hierarchy=mind),
        "distilled": lambda seed: farmers(seed=seed, scheme=found.scheme),
    }
    rows = []
    for seed in range(arguments.seeds):
        for society, make in societies.items():
            model = make(seed)
            course = lived(model, arguments.ticks, arguments.every)
            rows.append({"society": society, "seed": seed, **measures(model, course)})
        print(f"seed {seed} ({seed + 1} of {arguments.seeds})", flush=True)
    table = pd.DataFrame(rows)
    table.to_csv(out / "learned.csv", index=False, float_format="%.6g")
    compared = comparisons(table, reference="learned")
    compared.to_csv(out / "comparison.csv", index=False, float_format="%.6g")
    summary = {
        "seeds": arguments.seeds,
        "ticks": arguments.ticks,
        "every": arguments.every,
        "links": found.links,
        "overlap": found.agreement.overlap,
        "same": found.agreement.same,
        "overlap_of_all_links": found.unpruned.overlap,
        "plans": plans,
    }
    (out / "learned.json").write_text(json.dumps(summary, indent=1) + "\n")
    text = as_markdown(table, summary)
    write_between(out / "README.md", text, BEGIN, END)
    print(text)


if __name__ == "__main__":
    main()
