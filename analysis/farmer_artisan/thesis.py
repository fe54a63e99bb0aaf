"""What the thesis reports of cognitons and of farmers and artisans (3.2, 3.3), beside ours."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from socialmind.experiments.judging import (
    MOST,
    Finding,
    above,
    below,
    counted,
    in_brackets,
    looked_through,
    not_so,
    share_of,
)
from socialmind.experiments.measures.intervals import interval_of
from socialmind.experiments.overview import Result, row_of, rows_of

TOPIC = Path(__file__).parent
KEPT = TOPIC / "results"
SEEDS = TOPIC / "results.csv"
"""A row for each of thirty runs of 500,000 ticks."""
ALMOST_ALL = 0.9
"""Share of lands, and their mean specialisation, above which almost all have specialised."""
SETTLED, END = 200_000, 500_000
"""From which tick on almost all have specialised in the thesis, and its last one."""
MANY_SEEDS = "`python -m analysis.farmer_artisan.study`"


def numbers(column: str) -> list[float]:
    """Return what is known of a column of the thirty runs."""
    return [float(row[column]) for row in rows_of(SEEDS) if row[column]]


def moment(figure: str, tick: int) -> dict[str, str]:
    """Return a row of a run at one of the thesis's moments."""
    return row_of(KEPT / f"{figure}.csv", tick=str(tick))


def influence() -> list[Finding]:
    made = {row["plan"]: float(row["weight"]) for row in rows_of(KEPT / "figure-3.1.csv")}
    return [
        Finding(f"weight of {plan}", f"{value:g}", f"{made[plan]:g}", made[plan] == value)
        for plan, value in (("Plan 1", 12.0), ("Plan 2", 9.0))
    ]


def early() -> list[Finding]:
    now = moment("figure-3.8", 27_000)
    nearer = numbers("correlation_mind")
    one_kind = int(now["tool_lands"]) + int(now["wheat_lands"])
    return [
        Finding(
            "specialisation is visible at tick 27,000",
            "seen in the lands' colours",
            f"|t − w| / (t + w) of the lands is {float(now['specialisation']):.2f} on the mean; "
            f"{one_kind} of {now['people']} lands are of one kind of work",
            apart="no number is told of what is seen, and the mean comes to as much where all "
            "lands divide their work alike",
        ),
        Finding(
            "whose land is nearer the village specialises sooner",
            "said of the right panel",
            f"rank correlation of distance and tick {in_brackets(interval_of(nearer))} over "
            f"{len(nearer)} runs ({MANY_SEEDS})",
            above(interval_of(nearer)),
            why=not_so(interval_of(nearer)),
        ),
    ]


def specialised() -> list[Finding]:
    special, now = interval_of(numbers("specialisation_at_early")), moment("figure-3.8", SETTLED)
    one_kind, people = int(now["tool_lands"]) + int(now["wheat_lands"]), int(now["people"])
    tools = [float(moment("figure-3.8", tick)["village_tools"]) for tick in (100_000, SETTLED)]
    start = float(moment("figure-3.8", 0)["village_tools"])
    return [
        Finding(
            "from tick 100,000 to 200,000 almost all specialise (more than nine in ten, and their "
            "lands on the mean by as much)",
            "almost all of 25",
            f"{one_kind} of {people} lands are of one kind of work at tick {SETTLED:,}; over "
            f"{len(numbers('specialisation_at_early'))} runs |t − w| / (t + w) of the lands is "
            f"{in_brackets(special)} then ({MANY_SEEDS})",
            one_kind > ALMOST_ALL * people and above(special, ALMOST_ALL),
        ),
        Finding(
            "a surplus of tools",
            "slight surplus production",
            f"the village's stock rises from {start:.0f} to {tools[0]:.0f} and {tools[1]:.0f}",
            min(tools) > start,
        ),
    ]


def minds() -> list[Finding]:
    rows = rows_of(KEPT / "figure-3.10.csv")
    found = []
    for kind, other, plan, rival in (
        ("farmer", "artisan", "GrowWheat", "ProduceTools"),
        ("artisan", "farmer", "ProduceTools", "GrowWheat"),
    ):
        own = [row for row in rows if float(row[kind]) > float(row[other])]
        sure = [row for row in own if weight(row, plan) > weight(row, rival)]
        shown = typical(own, kind)
        found.append(
            Finding(
                f"a specialised {kind}, whose {kind.capitalize()} is above its "
                f"{other.capitalize()}: {plan} weighs more than {rival} (in most)",
                "one is shown; that the other work weighs more is told as an exception (figure "
                "3.12)",
                f"in {counted(len(sure), len(own))} at tick {SETTLED:,}; in the typical {kind} of "
                f"our figure, agent {shown['agent']}, {plan} weighs {weight(shown, plan):.0f} and "
                f"{rival} {weight(shown, rival):.0f}",
                above(share_of(len(sure), len(own)), MOST),
                why=f"unknown; of {len(own)} it cannot be told whether most do",
            )
        )
    return found


def typical(rows: list[dict[str, str]], kind: str) -> dict[str, str]:
    """Return the row that the figure shows of some people: the one of median calling."""
    ranked = sorted(rows, key=lambda row: float(row[kind]))
    return ranked[(len(ranked) - 1) // 2]


def weight(row: dict[str, str], plan: str) -> float:
    """Return the weight of a plan in a row of minds; −∞ where it is closed."""
    value = row[f"weight_{plan}"]
    return float(value) if value not in ("", "nan") else float("-inf")


def against_calling() -> list[Finding]:
    (row,) = rows_of(KEPT / "figure-3.12.csv")
    return [
        Finding(
            "an artisan grows wheat although its land is one of tools",
            "agent 6 at tick 350,000",
            f"agent {row['agent']} at tick {int(row['tick']):,}; {row['growing_wheat']} of "
            f"{int(row['records_of_artisans']):,} records of artisans from tick {SETTLED:,} on",
            apart="all records of the run were searched for one; how often it comes the thesis "
            "does not tell",
        ),
    ]


def mind_of_it() -> list[Finding]:
    (row,) = rows_of(KEPT / "figure-3.12.csv")
    grown, made = float(row["weight_GrowWheat"]), float(row["weight_ProduceTools"])
    return [
        Finding(
            "by the market's demands and its own needs, growing wheat weighs more for such an "
            "artisan than producing tools",
            "said of agent 6's mind at tick 350,000",
            f"GrowWheat weighs {grown:.0f}, ProduceTools {made:.0f}; Artisan is "
            f"{float(row['artisan']):.0f}, Farmer {float(row['farmer']):.0f}; agent {row['agent']} "
            f"at tick {int(row['tick']):,}, the first of {row['growing_wheat']} records in which "
            "an artisan grows wheat, whatever weighs more",
            grown > made,
        ),
    ]


def lasting() -> list[Finding]:
    last, changes = moment("figure-3.8", END), numbers("role_changes")
    stretch = (END - SETTLED) / 10_000  # changes are told for 10,000 ticks
    each = interval_of([stretch * one for one in changes])
    artisans, runs = numbers("artisans"), len(rows_of(SEEDS))
    least, most = np.quantile(artisans, [0.025, 0.975]).tolist()
    return [
        Finding(
            "who is specialised stays so, but for some (more than none, and less than one change "
            f"for two agents in {END - SETTLED:,} ticks)",
            "lands keep their colours; some individuals change",
            f"{in_brackets(each)} changes of calling for each agent, over the {len(changes)} of "
            f"{runs} runs that settled ({MANY_SEEDS})",
            above(each) and below(each, 0.5),
        ),
        Finding(
            "six of 25 make tools full-time",
            "6, in this run",
            f"{in_brackets(interval_of(artisans), '.1f')} artisans over {len(artisans)} runs, "
            f"{least:.1f} to {most:.1f} in the middle 95 % of them, 6 in "
            f"{artisans.count(6)}; {last['tool_lands']} lands of tools at tick {END:,} in "
            "the run of the figure",
            least <= 6 <= most,
            why="it is not among the middle 95 % of our runs",
        ),
        Finding(
            "artisans who grow wheat make a dent in the stock of tools",
            "a dent in the curve",
            "`figure-3.13-stocks`",
            apart="an event of one run; no number is told",
        ),
    ]


def few() -> list[Finding]:
    from .society import OTHERS

    artisans, then = numbers("artisans"), moment("figure-3.14", 300_000)
    later = moment("figure-3.14", END)
    at_end = sum(one <= 4 for one in artisans)
    return [
        Finding(
            "some runs have fewer artisans: four lands of tools at tick 300,000",
            "4 in one of two runs",
            f"{then['tool_lands']} lands of tools, {then['artisans']} artisans; 4 or fewer at the "
            f"end in {counted(at_end, len(artisans), 'runs')}",
            apart="the run was searched for one with four artisans then, "
            f"{looked_through(OTHERS, int(then['seed']))}; how the thesis chose its two it does "
            "not tell",
        ),
        Finding(
            "the deficit is about to correct itself: a farmer is turning artisan",
            "agent 12, in transition",
            f"{later['artisans']} artisans at tick {END:,}, {then['artisans']} at 300,000",
            int(later["artisans"]) > int(then["artisans"]),
            why="as many artisans stay to the end in this run: its village has "
            f"{float(then['village_tools']):.0f} tools and lacks none",
        ),
    ]


results = (
    Result("figure 3.1", "an example of the influence mechanism", "figure-3.1", influence),
    Result("figure 3.8", "the society at the start and at tick 27,000", "figure-3.8", early),
    Result("figure 3.9", "at ticks 100,000, 150,000 and 200,000", "figure-3.8", specialised),
    Result("figure 3.10", "minds of a farmer and of an artisan", "figure-3.8", minds),
    Result("figure 3.11", "at ticks 250,000 to 350,000: work against the calling", "figure-3.8",
           against_calling),
    Result("figure 3.12", "the mind of such an artisan", "figure-3.8", mind_of_it),
    Result("figure 3.13", "at ticks 400,000, 450,000 and 500,000", "figure-3.8", lasting),
    Result("figure 3.14", "another run, with fewer artisans", "figure-3.14", few),
)  # fmt: skip
