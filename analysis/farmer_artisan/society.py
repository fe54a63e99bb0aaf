"""Figures 3.8 to 3.14: a run of the society at the thesis's moments, and another one."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from socialmind.catalogue import load_figures, load_model, model_folder
from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments import Run, run
from socialmind.experiments.studies import write_figure

FIGURES: Any = load_figures(model_folder("farmer_artisan"))
TICKS = 500_000
EVERY = 1000
"""Ticks between two records; all of the thesis's moments are among them."""
SEED = 0
OTHERS = range(1, 30)
"""Seeds that are tried, one after another, for a run with a deficit of artisans."""
FEW, LOOK = 4, 300_000
"""Artisans of the thesis's other run, and the tick at which it is shown (figure 3.14)."""
SPECIALISED = 200_000
"""From which tick on almost all have specialised in the thesis."""
WORKED = 0.8
"""|t − w| / (t + w) of a land from which on it is of one kind of work."""


def recorded(seed: int, ticks: int = TICKS) -> tuple[pd.DataFrame, pd.DataFrame, Any]:
    """Return the series of a run, its agents, and the scheme."""
    with TemporaryDirectory() as folder:
        made = Run(
            run(load_model("farmer_artisan"), ticks, seed, every=EVERY, agents_every=EVERY,
                out=Path(folder) / "run")
        )  # fmt: skip
        agents = made.agents
        worked = agents["land_tools"] + agents["land_wheat"]
        agents = agents.assign(lean=(agents["land_tools"] - agents["land_wheat"]) / worked)
        return made.series, agents, made.scheme


def moments(series: pd.DataFrame, agents: pd.DataFrame, seed: int) -> list[dict[str, Any]]:
    """Return a row for each of the thesis's moments.

    Args:
        series: of a run.
        agents: of the same run, with `lean`, the land's (t − w) / (t + w).
        seed: of the run.
    """
    rows = []
    for tick in FIGURES.THESIS_TICKS:
        (now,) = series[series["tick"] == tick].to_dict("records")
        people = agents[agents["tick"] == tick]
        rows.append(
            {
                "seed": seed,
                "tick": tick,
                "people": len(people),
                "artisans": int(now["artisans"]),
                "tool_lands": int((people["lean"] >= WORKED).sum()),
                "wheat_lands": int((people["lean"] <= -WORKED).sum()),
                "specialisation": round(float(now["specialisation"]), 4),
                "tools": round(float(now["tools"]), 2),
                "village_tools": round(float(now["village_tools"]), 2),
            }
        )
    return rows


def against_calling(agents: pd.DataFrame) -> pd.DataFrame:
    """Return the records in which an artisan, by mind and land, grows wheat once all specialised.

    Args:
        agents: one row an agent and recorded tick.
    """
    records = artisan_records(agents)
    return records[records["plan"] == "GrowWheat"]


def write_society(out: Path) -> list[Path]:
    """Draw figures 3.8 to 3.13 of one run."""
    series, agents, scheme = recorded(SEED)
    size, village = 33, [(0.0, 0.0)]
    odd = against_calling(agents)
    if odd.empty:
        raise SocialmindError(f"no artisan grows wheat from tick {SPECIALISED:,} on, seed {SEED}")
    one = odd.iloc[0]
    title = f"Artisan growing wheat: agent {one['agent']}, tick {one['tick']:,}"
    maps = agents[agents["tick"].isin(FIGURES.THESIS_TICKS)]
    with paper.style():
        lands = FIGURES.lands(maps, size, village)
        minds = FIGURES.mind(agents[agents["tick"] <= SPECIALISED], scheme)
        mind = FIGURES.mind(
            agents[agents["tick"] <= one["tick"]], scheme, [(title, one)], over_time=False
        )
        stocks = FIGURES.stocks(series)
    shares = [
        {
            "seed": SEED,
            "records_of_artisans": len(artisan_records(agents)),
            "growing_wheat": len(odd),
            "agent": int(one["agent"]),
            "tick": int(one["tick"]),
            "farmer": round(float(one["farmer"]), 3),
            "artisan": round(float(one["artisan"]), 3),
            "weight_GrowWheat": round(float(one["weight_GrowWheat"]), 3),
            "weight_ProduceTools": round(float(one["weight_ProduceTools"]), 3),
        }
    ]
    return [
        *write_figure("figure-3.8", lands, moments(series, agents, SEED), out),
        *write_figure("figure-3.10", minds, minds_of(agents), out),
        *write_figure("figure-3.12", mind, shares, out),
        *paper.save({"figure-3.13-stocks": stocks}, out),
    ]


def artisan_records(agents: pd.DataFrame) -> pd.DataFrame:
    """Return the records of artisans, by mind and land, once all have specialised."""
    settled = agents[agents["tick"] >= SPECIALISED]
    return settled[(settled["artisan"] > settled["farmer"]) & (settled["lean"] >= WORKED)]


def minds_of(agents: pd.DataFrame) -> list[dict[str, Any]]:
    """Return the callings and the weights of work of all people at tick `SPECIALISED`."""
    now = agents[agents["tick"] == SPECIALISED]
    names = ["agent", "farmer", "artisan", "weight_GrowWheat", "weight_ProduceTools", "lean"]
    rows: list[dict[str, Any]] = now[names].round(3).to_dict("records")
    return rows


def write_other_run(out: Path) -> list[Path]:
    """Draw figure 3.14: the lands of the first other run that has four artisans then."""
    for seed in OTHERS:
        series, agents, _ = recorded(seed)
        rows = moments(series, agents, seed)
        if any(row["tick"] == LOOK and row["artisans"] == FEW for row in rows):
            break
    else:
        raise SocialmindError(f"none of {len(OTHERS)} runs has {FEW} artisans at tick {LOOK:,}")
    maps = agents[agents["tick"].isin((LOOK, TICKS))]
    with paper.style():
        lands = FIGURES.lands(maps, 33, [(0.0, 0.0)])
    return write_figure("figure-3.14", lands, rows, out)
