"""What the thesis reports of cognitons and of farmers and artisans (3.2, 3.3), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.overview import Finding, Result, row_of, rows_of

TOPIC = Path(__file__).parent
KEPT = TOPIC / "results"
SEEDS = TOPIC / "results.csv"
"""A row for each of thirty runs of 500,000 ticks."""
ALMOST_ALL = 0.9
"""Mean specialisation of the lands from which on almost all have specialised."""
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
    special, nearer = float(now["specialisation"]), numbers("correlation_mind")
    return [
        Finding(
            "specialisation is visible at tick 27,000",
            "seen in the lands' colours",
            f"|t − w| / (t + w) of the lands is {special:.2f} on the mean",
            special > 0.1,
        ),
        Finding(
            "whose land is nearer the village specialises sooner",
            "said of the right panel",
            f"rank correlation of distance and tick {min(nearer):.2f} to {max(nearer):.2f}, above "
            f"0 in {sum(one > 0 for one in nearer)} of {len(nearer)} runs ({MANY_SEEDS})",
            min(nearer) > 0,
        ),
    ]


def specialised() -> list[Finding]:
    special, now = numbers("specialisation_at_early"), moment("figure-3.8", 200_000)
    one_kind = int(now["tool_lands"]) + int(now["wheat_lands"])
    least = 0.9 * int(now["people"])
    tools = [float(moment("figure-3.8", tick)["village_tools"]) for tick in (100_000, 200_000)]
    start = float(moment("figure-3.8", 0)["village_tools"])
    return [
        Finding(
            "from tick 100,000 to 200,000 almost all specialise",
            "almost all of 25",
            f"{one_kind} of {now['people']} lands are of one kind of work at tick 200,000; over "
            f"{len(special)} runs the lands' specialisation is {min(special):.2f} to "
            f"{max(special):.2f} then ({MANY_SEEDS})",
            one_kind >= least and sum(special) / len(special) >= ALMOST_ALL,
        ),
        Finding(
            "a slight surplus of tools",
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
        found.append(
            Finding(
                f"a specialised {kind}: its calling, and the plan that weighs most",
                f"{kind.capitalize()} above {other.capitalize()}",
                f"{len(own)} people with {kind.capitalize()} above {other.capitalize()} at tick "
                f"200,000; in {len(sure)} {plan} weighs more than {rival}",
                len(sure) > len(own) / 2,
            )
        )
    return found


def weight(row: dict[str, str], plan: str) -> float:
    """Return the weight of a plan in a row of minds; −∞ where it is closed."""
    value = row[f"weight_{plan}"]
    return float(value) if value not in ("", "nan") else float("-inf")


def against_calling() -> list[Finding]:
    (row,) = rows_of(KEPT / "figure-3.12.csv")
    grown, made = float(row["weight_GrowWheat"]), float(row["weight_ProduceTools"])
    return [
        Finding(
            "an artisan grows wheat although its land is one of tools",
            "agent 6 at tick 350,000",
            f"agent {row['agent']} at tick {int(row['tick']):,}; {row['growing_wheat']} of "
            f"{int(row['records_of_artisans']):,} records of artisans",
            int(row["growing_wheat"]) > 0,
        ),
        Finding(
            "by the market's demands and its own needs, growing wheat weighs more for it",
            "said of agent 6's mind",
            f"GrowWheat weighs {grown:.0f}, ProduceTools {made:.0f}; Artisan is "
            f"{float(row['artisan']):.0f}, Farmer {float(row['farmer']):.0f}",
            grown > made,
        ),
    ]


def lasting() -> list[Finding]:
    last, changes = moment("figure-3.8", 500_000), numbers("role_changes")
    return [
        Finding(
            "who is specialised stays so, but for some",
            "lands keep their colours; some individuals change",
            f"{sum(changes) / len(changes):.3f} changes of calling for each agent and 10,000 "
            f"ticks, over {len(changes)} runs ({MANY_SEEDS})",
            0 < sum(changes) / len(changes) < 0.1,
        ),
        Finding(
            "about six of 25 make tools full-time",
            "6",
            f"{last['tool_lands']} lands of tools at tick 500,000; "
            f"{min(numbers('artisans')):.0f} to {max(numbers('artisans')):.0f} artisans over "
            f"{len(numbers('artisans'))} runs, 6 in {numbers('artisans').count(6)}",
            6 in numbers("artisans"),
        ),
        Finding(
            "artisans who grow wheat make a dent in the stock of tools",
            "a dent in the curve",
            "`figure-3.13-stocks`",
            apart="an event of one run; no number is told",
        ),
    ]


def few() -> list[Finding]:
    artisans, then = numbers("artisans"), moment("figure-3.14", 300_000)
    later = moment("figure-3.14", 500_000)
    return [
        Finding(
            "some runs have fewer artisans: four lands of tools at tick 300,000",
            "4 in one of two runs",
            f"{then['tool_lands']} lands of tools, {then['artisans']} artisans with seed "
            f"{then['seed']}; at the end 4 artisans in {artisans.count(4)} of {len(artisans)} runs",
            int(then["artisans"]) == 4 and 4 in artisans,
        ),
        Finding(
            "the deficit is about to correct itself: a farmer is turning artisan",
            "agent 12, in transition",
            f"{later['artisans']} artisans at tick 500,000, {then['artisans']} at 300,000",
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
           lambda: against_calling()[:1]),
    Result("figure 3.12", "the mind of such an artisan", "figure-3.8", against_calling),
    Result("figure 3.13", "at ticks 400,000, 450,000 and 500,000", "figure-3.8", lasting),
    Result("figure 3.14", "another run, with fewer artisans", "figure-3.14", few),
)  # fmt: skip
