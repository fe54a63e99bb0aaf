"""The page: what was found, section by section, with its figures and tables."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from typing import TYPE_CHECKING

import matplotlib
import numba
import numpy as np
import pandas as pd

import socialmind
from socialmind.catalogue import model_folder
from socialmind.experiments import html
from socialmind.mind import MindDescription

from . import farmers
from .budgets import TERMS, losses
from .claims import found
from .every_attempt import attempts
from .plots import KINDS
from .reading import REFERENCES, WORDS
from .societies import CONDITIONS, FULL, REFERENCE, SEED, SOCIETIES, Size
from .tables import MEASURED
from .words import capital, number, one_of, spread
from .worlds import EVERY

if TYPE_CHECKING:
    from matplotlib.figure import Figure


TITLE = "Programmed and learned specialisation"


def page_of(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size, command: str
) -> str:
    """Return the page."""
    seeds = f"{SEED} … {SEED + size.worlds - 1}"
    top = [
        html.paragraph(
            "Nine robots forage objects of two kinds, of which twice as many B are wanted as A. "
            "Who fetches which? A programmed mind, response thresholds, learned minds, and rules "
            "that fall short of all these decide about it in the same worlds; the same trained "
            "skills carry out what they decide. Then both kinds of minds in one society; then "
            "farmers and artisans, with a learned mind in the place of their programmed one. Terms "
            "are explained under “Words”, at the end.",
            lead=True,
        ),
        found("summary", tables, size),
    ]
    if size != FULL:
        top.append(
            html.paragraph(
                f"This is a small version, to see that all works: {size.worlds} worlds of "
                f"{number(size.ticks, 0)} ticks, not {FULL.worlds} of {number(FULL.ticks, 0)}, and "
                f"{size.attempts} attempts at each lesson. It draws no conclusions."
            )
        )
    sections = [
        html.section("Who is compared", _compared(figures, size), "societies"),
        html.section("Every attempt", attempts(tables, figures, size), "attempts"),
        html.section("Left alone", _calm(tables, figures, size), "left-alone"),
        html.section("After shocks", _shocked(tables, figures, size), "shocks"),
        html.section("Both minds in one society", _mixed(tables, figures, size), "mixed"),
        html.section("The other way round: farmers and artisans",
                     _farmers(tables, figures, size), "farmers"),
        html.section("What is measured", _definitions(), "measures"),
        html.section("How it was made", _made(tables, size, command, seeds), "method"),
        html.section("Words", [html.table(WORDS)], "words"),
        html.section("What this does not say", [found("limits", tables, size) or html.paragraph(
            "See the full study.")], "limits"),
        html.section("References", [html.bullets(REFERENCES)], "references"),
    ]  # fmt: skip
    return html.page(TITLE, top, sections)


def _compared(figures: Mapping[str, Figure], size: Size) -> list[str]:
    societies = [{"society": one.title, "who decides about roles": one.about}
                 for one in SOCIETIES.values()]  # fmt: skip
    half = number(size.half, 0)
    conditions = [
        {"condition": one.title, f"at tick {half}": one.about} for one in CONDITIONS.values()
    ]
    return [
        html.table(societies),
        html.table(conditions),
        html.paragraph(
            f"Each society meets the same {size.worlds} worlds under each condition, each attempt "
            f"at a lesson the first {size.attempt_worlds} of them, for {number(size.ticks, 0)} "
            "ticks. How its robots begin is drawn for each world: all in "
            "A, all in B, undecided, or at random; fixed roles begin in the wanted split. After "
            "each delivery a robot is told what the object was worth to all, and nothing else."
        ),
        html.picture(
            figures["programmed"],
            "Figure 1. The scheme of the programmed robots: cognitons at the left, callings in "
            "blue and plenty in red, plans at the right. Numbers are the links’ weights; in gold, "
            "what is added to a cogniton when a plan is carried out and pays, and taken from it "
            "when it does not. A plan that a cogniton opens is considered only where there is that "
            "cogniton.",
            "A cognitive scheme of four cognitons and two plans.",
        ),
        html.paragraph(
            "What a lesson is paid for. No lesson is told what robots are to do, but each is told "
            "the wanted split: by deliveries means that where a robot stands is seen by what it "
            "brings home, and not that objects alone are paid for. The loss that is made small is "
            "the sum of these, each times its number, over worlds of an economy without bodies; "
            "robots are told the payoff of what they delivered, and never the ratio."
        ),
        html.table(
            [
                {
                    "a loss": TERMS[str(term)],
                    **{
                        SOCIETIES[str(name)].title: number(value) if value else "–"
                        for name, value in row.items()
                    },
                }
                for term, row in losses().iterrows()
            ],
            "Of lessons with several parts that of the last. Supervised and by the counts, what "
            "role a robot has is read from its variable ROLE; the evolved scheme is its calling; "
            "else it is what the robot brought last.",
            numbers=True,
        ),
    ]


def _calm(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    return [
        found("undisturbed", tables, size),
        html.picture(
            figures["course"],
            "Figure 3. Distance to the wanted split over time, of what nobody learned (a–d), of "
            "learned robots beside the programmed ones (e–h), and where roles are fixed, drawn, "
            "greedy, or judged by the counts (m–p); i–l, the share of robots that are "
            "specialised. Means over all attempts and worlds, the vertical line being the "
            "shock; their intervals are in Tables 4 to 7. A robot counts as in A until it has "
            "brought a B, so that all begin 6 robots away, where a–h are cut off.",
            "Distance to the wanted split over time, for each society and condition.",
        ),
        _comparison(tables, "undisturbed", "Table 4. Undisturbed."),
    ]


def _shocked(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    parts = []
    for place, condition in enumerate((o for o in CONDITIONS.values() if o.parameter), 5):
        parts += [
            f"<h3>{capital(condition.title)}</h3>",
            found(condition.name, tables, size),
            _comparison(tables, condition.name, f"Table {place}. {condition.when}."),
        ]
    return [
        *parts,
        html.picture(
            figures["robots"],
            f"Figure 4. What each robot brings home, in the first world ({SEED}) and by the first "
            "attempt. The wanted ratio A : B is 1 : 2, and 2 : 1 after the dashed line.",
            "What nine robots bring home over time, a panel a society.",
        ),
        html.picture(
            figures["measures"],
            "Figure 5. Every measure: means with intervals of 95 % over attempts and worlds. In c "
            f"a world that never settles counts with {number(size.ticks, 0)} ticks undisturbed "
            f"and {number(size.half, 0)} after a shock. Grey "
            "strokes in g: what luck alone gives. The axes of h and i do not begin at 0. Intervals "
            "of what was learned by the counts, by three attempts, run out of the panels.",
            "Means with intervals of nine measures, for each society and condition.",
        ),
    ]


def _comparison(tables: Mapping[str, pd.DataFrame], condition: str, caption: str) -> str:
    """A table of societies under a condition, with differences from the programmed one."""
    rows = []
    for one in SOCIETIES.values():
        row: dict[str, object] = {"society": _in_lines(one.title)}
        where = {"society": one.name, "condition": condition}
        for name, measured in MEASURED.items():
            cell = spread(one_of(tables["means"], name, **where), measured.digits)
            if one.name != REFERENCE:
                away = one_of(tables["differences"], name, reference=REFERENCE, **where)
                told = spread({**away, "mean": away["difference"]}, measured.digits)
                cell = f"{cell}\nΔ {told}"
            row[f"{measured.title}\n{measured.unit}"] = cell.replace(" (", "\n(")
        rows.append(row)
    return html.table(
        rows,
        f"{caption} Means with intervals of 95 %; Δ is the difference from the programmed society "
        "in the worlds that both have met, which are fewer where a lesson has attempts: so it need "
        "not be the difference of the means shown. Fixed roles have changes since every robot "
        "counts as in A until its first B.",
        numbers=True,
    )


def _in_lines(title: str) -> str:
    """Return a title in two lines: at its comma, or after its first word."""
    return title.replace(", ", ",\n") if "," in title else title.replace(" ", "\n", 1)


def _mixed(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    rows = [
        {
            "condition": CONDITIONS[row["condition"]].title,
            "measure": " (".join(KINDS[row["measure"]]) + ")",
            "programmed less learned": spread({**row, "mean": row["difference"]}),
        }
        for row in tables["mixed-kinds-differences"].to_dict("records")
    ]
    rows.sort(key=lambda row: [one.title for one in CONDITIONS.values()].index(row["condition"]))
    return [
        found("mixed", tables, size),
        html.picture(
            figures["mixed"],
            "Figure 6. Over the share of programmed robots; the others are “learned by "
            "deliveries”, each of their attempts in the first "
            f"{size.mixed_worlds} worlds. Above: societies. Below: what becomes of either kind "
            "of robots; h does not begin at 0. Means with intervals of 95 % over attempts and "
            "worlds.",
            "Measures of mixed societies over the share of programmed robots.",
        ),
        html.table(rows, "Table 8. Programmed and learned robots in one society: differences with "
                   "intervals of 95 %.", numbers=True),
    ]  # fmt: skip


def _farmers(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    attempts = one_of(tables["farmers-means"], "prosperity", society="learned")["attempts"]
    rows = []
    for name, measured in farmers.MEASURED.items():
        found_in = {one: one_of(tables["farmers-means"], name, society=one)
                    for one in farmers.SOCIETIES}  # fmt: skip
        cells = {
            one: spread(row, measured.digits)
            + (f", {row['worlds']} seeds" if 0 < row["worlds"] < size.farmers else "")
            for one, row in found_in.items()
        }
        rows.append({"measure": f"{measured.title} ({measured.unit})", **cells})
    return [
        html.paragraph(
            "In the thesis’s society of farmers and artisans a scheme that somebody wrote decides. "
            "Here minds that were taught for wheat alone weigh the same plans, from the same "
            "cognitons; and from what each does a scheme of few links is distilled: the few links "
            "with which a scheme chooses most nearly as the mind does. "
            f"{attempts} attempts, taught in episodes of 4,000 ticks, and the mind of the model, "
            f"which is one more; {size.farmers} seeds, {number(size.farmers_ticks, 0)} ticks."
        ),
        found("farmers", tables, size),
        html.picture(
            figures["farmers"],
            "Figure 7. Societies on the same seeds: over time, and measure by measure, with "
            "intervals of 95 % over attempts and seeds; of the written scheme and the model’s mind "
            "over seeds. Grey strokes: what luck alone gives.",
            "Measures of four societies of farmers and artisans.",
        ),
        html.table(
            rows,
            "Table 9. Means with intervals of 95 %, over attempts and seeds where there are "
            "attempts. Changes of roles while settled are "
            "known of the seeds that settle in all attempts, whose number is told where it is not "
            "all; unknown where none does.",
            numbers=True,
        ),
        html.picture(
            figures["schemes"],
            "Figure 8. The scheme that was written, and the one distilled from the model’s mind: "
            "cognitons at the left, plans at the right, as in Figure 1; Habit is a cogniton that "
            "always is there. A line is the broader the larger its weight is beside the "
            "scheme’s largest.",
            "Two cognitive schemes with their links.",
        ),
    ]  # fmt: skip


def _definitions() -> list[str]:
    return [
        html.table(
            [
                {"measure": one.title, "unit": one.unit, "definition": one.definition}
                for one in MEASURED.values()
            ]
        ),
        html.paragraph("Of farmers and artisans:"),
        html.table(
            [
                {"measure": one.title, "unit": one.unit, "definition": one.definition}
                for one in farmers.MEASURED.values()
            ]
        ),
        html.paragraph(
            "Robots are known by what they bring home: one is in B from when it brings a B until "
            "it brings an A, and else in A, whatever its mind says of its role. Intervals are of "
            "95 %. Where a lesson has several attempts they are over attempts and worlds: both are "
            "drawn anew, each on its own (Owen, 2007); else they are over worlds, by the "
            "bias-corrected and accelerated bootstrap (Efron, 1987), those of shares by Wilson’s "
            "formula (1927), and by Newcombe’s (1998) those of differences of shares that are "
            "alike in all worlds. With fewer than six attempts or worlds a bootstrap is too "
            "narrow: there they are as many standard errors wide as Student’s t says, and may "
            "reach past what there can be. Societies are compared in the same worlds; two lessons "
            "too, whose "
            "attempts are drawn each on their own. Where all attempts come to the same in all "
            "worlds, a bootstrap gives no interval and none is told: that others would come to the "
            "same is not said by it. Intervals of single attempts in further worlds are Wilson’s. "
            "An interval that holds 0 does not show that there is no difference: it "
            "says how large one could be. One that ends within a seventieth of its width of 0 is "
            "taken to hold it, as another draw of the bootstrap might. Nothing is corrected for "
            "the number of comparisons."
        ),
    ]


def _made(tables: Mapping[str, pd.DataFrame], size: Size, command: str, seeds: str) -> list[str]:
    mind = MindDescription.load(model_folder("foraging_roles") / "mind")
    versions = {
        "socialmind": socialmind.__version__,
        "Python": platform.python_version(),
        "NumPy": np.__version__,
        "numba": numba.__version__,
        "Matplotlib": matplotlib.__version__,
    }
    software = ", ".join(f"{name} {version}" for name, version in versions.items())
    return [
        html.code(command),
        html.paragraph(
            f"Worlds of robots: seeds {seeds}, those of mixed societies the first "
            f"{size.mixed_worlds} of them; nothing was trained or chosen in them. No run was "
            f"excluded. `foraging_roles` with its mind of {len(mind.skills)} skills; what robots "
            f"bring home is recorded every {EVERY} ticks. Farmers and artisans: seeds 0 … "
            f"{size.farmers - 1}, recorded every {farmers.STUDY.EVERY} ticks. The same command "
            f"gives the same file, with the same versions: {software}."
        ),
        html.paragraph(
            "Lessons and their attempts, of seed 8. `analysis/foraging_roles` has what they were "
            "judged by, and the commands that make them again. Budgets are not equal: a lesson "
            "that begins anew until it succeeds has had more ticks."
        ),
        html.table(
            [
                {
                    "society": SOCIETIES[row["society"]].title,
                    "lesson, or choice": row["lesson"],
                    "attempts": row["attempts"],
                    "trainings": row["trainings"],
                    "ticks of an attempt, thousand million": number(row["median"], 1)
                    + (
                        f" ({number(row['least'], 1)} to {number(row['greatest'], 1)})"
                        if row["least"] < row["greatest"]
                        else ""
                    ),
                }
                for row in tables["budgets"].to_dict("records")
            ],
            "Table 10. What lessons were given: the median attempt, in brackets the least and the "
            "greatest, with all starts and trainings of theirs that were given up. Ticks are those "
            "of worlds of the economy. By deliveries, chosen: in bodies another "
            f"{number(1000 * tables['budgets']['choosing'].max(), 0)} million ticks an attempt "
            "were run to choose. Supervised, picked, is one attempt more, of another seed, at what "
            "`analysis/foraging_roles` calls `learned` where it is the model's.",
            numbers=True,
        ),
        html.paragraph(
            "The tables stand beside this page as CSV, the figures as PDF, in the folder "
            "`specialisation`; `worlds.csv` holds a row for each society, condition and world."
        ),
    ]
