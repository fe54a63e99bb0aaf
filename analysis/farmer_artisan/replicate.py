"""One replicate of the study: a seed run through, and run on from the middle with a shock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.catalogue import load_model
from socialmind.experiments.measures.recovery import Recovery, first_reached, recovery
from socialmind.experiments.measures.specialisation import Course
from socialmind.worlds.grid.geometry import lattice

from .measures import Floats, nearest_distance, rank_correlation

if TYPE_CHECKING:
    from socialmind.model import Model

MIND_LEVEL = 30.0  # of |Farmer − Artisan|, which reaches 60
LAND_LEVEL = 0.8  # of |t − w| / (t + w), which reaches 1
WINDOW = 20_000  # ticks that levels before the shock and at the end are averaged over
WANTED = {"farmer": 4, "artisan": 1}  # what the thesis found, 20 and 5: nobody wants it here
WORK = {"GrowWheat": "wheat", "ProduceTools": "tools"}  # what an agent is seen doing, by its plan


@dataclass(frozen=True)
class Replicate:
    """What one seed gave.

    Args:
        seed: of the run.
        agents: how many there were at the start.
        ticks: (T,) recorded ticks.
        artisans: (T,) their number in the undisturbed run.
        specialisation: (T,) of the lands in the undisturbed run.
        distance: (n,) of land to village, in patches.
        tick_mind: (n,) at which |Farmer − Artisan| reached 30; infinite for never.
        tick_land: (n,) at which the land's |t − w| / (t + w) reached 0.8; infinite for never.
        correlation_mind: rank correlation of distance and tick_mind.
        correlation_land: rank correlation of distance and tick_land.
        artisans_shocked: (T,) their number in the run with the shock.
        turned: how many artisans the shock turned into farmers.
        recovery: of the number of artisans from the shock.
        course: roles and work seen at the records of the undisturbed run.
        course_shocked: those of the run with the shock.
        delivered: tools that came to the village and went to others in the undisturbed run: of
            each agent those that it sold, less those that it bought.
    """

    seed: int
    agents: int
    ticks: NDArray[np.int64]
    artisans: NDArray[np.int64]
    specialisation: Floats
    distance: Floats
    tick_mind: Floats
    tick_land: Floats
    correlation_mind: float
    correlation_land: float
    artisans_shocked: NDArray[np.int64]
    turned: int
    recovery: Recovery
    course: Course
    course_shocked: Course
    delivered: int


def replicate(seed: int, ticks: int, shock: int, every: int) -> Replicate:
    """Run one seed, and again from the shock on.

    Args:
        seed: of every draw.
        ticks: length of the run.
        shock: tick at which half of the artisans (rounded down) become farmers.
        every: ticks between two records; divides `shock`.

    Returns:
        The replicate.
    """
    model_class = load_model("farmer_artisan")
    model = model_class(seed=seed)
    recorded = _recorded_ticks(ticks, every)
    people: list[pd.DataFrame] = []
    series: list[dict[str, float]] = []
    state = None
    for tick in recorded:
        model.advance(int(tick) - model.tick)
        series.append(dict(model.series()))
        people.append(seen(model))
        if tick == shock:
            state = model.state()
    agents = people[0].index
    lead = np.array([(now["farmer"] - now["artisan"]).abs().reindex(agents) for now in people])
    land = np.array([_land_specialisation(now).reindex(agents) for now in people])
    # Land is never given back: the last record of an agent tells where it is.
    where = pd.concat(people).groupby(level=0)[["land_x", "land_y"]].last().reindex(agents)
    values = model.parameter_values()
    distance = nearest_distance(
        where["land_x"].to_numpy(float, na_value=np.nan),
        where["land_y"].to_numpy(float, na_value=np.nan),
        lattice(int(values["world_size"]), int(values["n_villages"])),
        int(values["world_size"]),
    )
    tick_mind = first_reached(recorded, lead, MIND_LEVEL)
    tick_land = first_reached(recorded, land, LAND_LEVEL)
    artisans = np.array([row["artisans"] for row in series], dtype=np.int64)

    shocked = model_class(seed=seed)
    if state is None:
        raise SystemExit(f"the shock at tick {shock} is not at one of the records, every {every}")
    shocked.restore(state)
    turned = turn_half_of_the_artisans(shocked, seed)
    after, after_it = int(shocked.series()["artisans"]), seen(shocked)
    later = []
    people_shocked = [now for now, tick in zip(people, recorded, strict=True) if tick < shock]
    people_shocked.append(after_it)
    for tick in recorded[recorded > shock]:
        shocked.advance(int(tick) - shocked.tick)
        later.append(int(shocked.series()["artisans"]))
        people_shocked.append(seen(shocked))
    artisans_shocked = np.concatenate([artisans[recorded <= shock], np.array(later, np.int64)])
    return Replicate(
        seed=seed,
        agents=len(agents),
        ticks=recorded,
        artisans=artisans,
        specialisation=np.array([row["specialisation"] for row in series], dtype=float),
        distance=distance,
        tick_mind=tick_mind,
        tick_land=tick_land,
        correlation_mind=rank_correlation(distance, tick_mind),
        correlation_land=rank_correlation(distance, tick_land),
        artisans_shocked=artisans_shocked,
        turned=turned,
        recovery=recovery(recorded, artisans_shocked, shock, after, WINDOW),
        course=course_of(people),
        course_shocked=course_of(people_shocked, shocks=(shock,)),
        delivered=int(np.maximum(model.humans.sold - model.humans.bought, 0).sum()),
    )


def seen(model: Model) -> pd.DataFrame:
    """What is seen of each agent of a model, by its identity."""
    return pd.DataFrame(dict(model.agents())).set_index("agent").assign(tick=model.tick)


def course_of(people: Sequence[pd.DataFrame], shocks: Sequence[int] = ()) -> Course:
    """Roles and work of a run.

    An agent is what the greater of its two callings says, and does what its plan is at a record,
    unless it trades.

    Args:
        people: what was seen at each record.
        shocks: their ticks.
    """
    table = pd.concat(people).reset_index()
    lead = np.sign(table["farmer"] - table["artisan"])
    role = lead.map({1.0: "farmer", -1.0: "artisan", 0.0: "undecided"})
    work = table["plan"].map(WORK)
    return Course(
        roles=table[["tick", "agent"]].assign(role=role),
        tasks=table[["tick", "agent"]].assign(task=work).dropna(),
        wanted=WANTED,
        shocks=shocks,
    )


def _recorded_ticks(ticks: int, every: int) -> NDArray[np.int64]:
    recorded = np.arange(0, ticks + 1, every, dtype=np.int64)
    return recorded if recorded[-1] == ticks else np.append(recorded, ticks)


def _land_specialisation(now: pd.DataFrame) -> pd.Series:
    """|t − w| / (t + w) of each agent's land; NaN without land."""
    tools = now["land_tools"].astype("Float64").astype(float)
    wheat = now["land_wheat"].astype("Float64").astype(float)
    return (tools - wheat).abs() / (tools + wheat)


def turn_half_of_the_artisans(model: Model, seed: int) -> int:
    """Swap the Farmer and Artisan cognitons of half of the artisans, drawn at random.

    Args:
        model: the model, changed in place.
        seed: of the draw.

    Returns:
        How many were turned.
    """
    society = model.humans.society
    names = [cogniton.name for cogniton in society.scheme.cognitons]
    farmer, artisan = names.index("Farmer"), names.index("Artisan")
    values = society.minds.values
    alive = society.minds.mind_id >= 0
    artisans = np.flatnonzero(alive & (values[:, artisan] > values[:, farmer]))
    turned = np.random.default_rng(seed).permutation(artisans)[: len(artisans) // 2]
    values[np.ix_(turned, [farmer, artisan])] = values[np.ix_(turned, [artisan, farmer])]
    return len(turned)
