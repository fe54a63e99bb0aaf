"""The page: what was found, section by section, with its figures and tables."""

from __future__ import annotations

import math
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numba
import numpy as np
import pandas as pd

import socialmind
from socialmind.catalogue import model_folder
from socialmind.mind import MindDescription

from . import farmers, html
from .societies import CONDITIONS, FULL, REFERENCE, SEED, SOCIETIES, Size
from .tables import MEASURED, beyond_both, mixed_of
from .words import capital, number, one_of, spread
from .worlds import EVERY

if TYPE_CHECKING:
    from matplotlib.figure import Figure


TITLE = "Programmed and learned specialisation"
FINDINGS = Path(__file__).with_name("findings.md")
"""What was found in the full study, written by hand: a section for each part of the page."""


def findings(section: str) -> str:
    """Return what is written about a part of the page, as a list."""
    text = FINDINGS.read_text(encoding="utf-8")
    own = text.split(f"\n## {section}\n", 1)[1].split("\n## ", 1)[0]
    return html.bullets(line.removeprefix("- ") for line in own.splitlines() if line)


def page_of(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], village: farmers.Found,
    size: Size, command: str,
) -> str:  # fmt: skip
    """Return the page."""
    seeds = f"{SEED} … {SEED + size.worlds - 1}"
    top = [
        html.paragraph(
            "Nine robots forage objects of two kinds, of which twice as many B are wanted as A. "
            "Who fetches which? A programmed mind, a learned one, and others that fall short of "
            "both decide about it in the same worlds, with the same market and the same decay; the "
            "same trained skills carry out what they decide. Then both minds in one society; then "
            "the farmers and artisans, with a learned mind in the place of their scheme.",
            lead=True,
        ),
        findings("summary"),
    ]
    if size != FULL:
        top.append(
            html.paragraph(
                f"This is a small version: {size.worlds} worlds of {number(size.ticks, 0)} ticks, "
                f"not {FULL.worlds} of {number(FULL.ticks, 0)}. What is said in words "
                "is of the full one."
            )
        )
    sections = [
        html.section("Who is compared", _compared(figures, size), "societies"),
        html.section("Left alone", _calm(tables, figures), "left-alone"),
        html.section("After shocks", _shocked(tables, figures, size), "shocks"),
        html.section("Both minds in one society", _mixed(tables, figures), "mixed"),
        html.section("The other way round: farmers and artisans",
                       _farmers(tables, figures, village, size), "farmers"),
        html.section("What is measured", _definitions(), "measures"),
        html.section("How it was made", _made(size, command, seeds), "method"),
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
            f"Each society meets the same {size.worlds} worlds under each condition, for "
            f"{number(size.ticks, 0)} ticks. How its robots begin is drawn for each world: all in "
            "A, all in B, undecided, or at random; fixed roles begin in the wanted split. After "
            "each delivery a robot is told what the object was worth to all, and nothing else."
        ),
        html.picture(
            figures["programmed"],
            "Figure 1. The scheme of the programmed robots: cognitons at the left, plans at the "
            "right. Numbers are the links’ weights.",
            "A cognitive scheme of four cognitons and two plans.",
        ),
    ]


def _calm(tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure]) -> list[str]:
    return [
        findings("undisturbed"),
        html.picture(
            figures["course"],
            "Figure 2. Distance to the wanted split; the share of robots that are specialised; "
            "both as means of all worlds with intervals of 95 %, the dashed line being the shock. "
            "Below, the share of worlds that have settled within one robot of the wanted split for "
            "5,000 ticks.",
            "Distance to the wanted split over time, for each society and condition.",
        ),
        _comparison(tables, "undisturbed", "Table 1. Undisturbed."),
    ]


def _shocked(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    parts = []
    for place, condition in enumerate((o for o in CONDITIONS.values() if o.parameter), 2):
        parts += [
            f"<h3>{capital(condition.title)}</h3>",
            findings(condition.name),
            _comparison(tables, condition.name, f"Table {place}. {condition.when}."),
        ]
    return [
        *parts,
        html.picture(
            figures["robots"],
            f"Figure 3. The role of each robot in the first world ({SEED}), in which the wanted "
            "ratio A : B is 1 : 2, and 2 : 1 after the dashed line.",
            "The roles of nine robots over time in six societies.",
        ),
        html.picture(
            figures["measures"],
            "Figure 4. Every measure, with intervals of 95 %. Grey strokes in g: what luck alone "
            "gives.",
            "Means with intervals of eight measures, for each society and condition.",
        ),
    ]


def _comparison(tables: Mapping[str, pd.DataFrame], condition: str, caption: str) -> str:
    """A table of societies under a condition, with differences from the learned one."""
    rows = []
    for name, measured in MEASURED.items():
        row: dict[str, object] = {"": f"{measured.title}\n{measured.unit}"}
        for one in SOCIETIES.values():
            where = {"society": one.name, "condition": condition}
            found = one_of(tables["means"], name, **where)
            cell = spread(found, measured.digits).replace(" (", "\n(")
            if one.name != REFERENCE:
                row[one.title] = f"{cell}\n{_effect(tables['differences'], name, where)}"
            else:
                row[one.title] = cell
        rows.append(row)
    return html.table(
        rows,
        f"{caption} Means with intervals of 95 %; g and δ compare with the learned society.",
        numbers=True,
    )


def _effect(differences: pd.DataFrame, name: str, where: Mapping[str, object]) -> str:
    """The effect sizes of a difference from the learned society."""
    found = one_of(differences, name, reference=REFERENCE, **where)
    size = f"g {number(found['g'], 1)}, " if math.isfinite(found["g"]) else ""
    return f"{size}δ {number(found['delta'], 2)}"


def _mixed(tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure]) -> list[str]:
    return [
        findings("mixed"),
        beyond_table(beyond_both(mixed_of(tables["worlds"]))),
        html.picture(
            figures["mixed"],
            "Figure 5. Over the share of programmed robots. Above: societies. Below: what becomes "
            "of either kind of robots. Means with intervals of 95 %.",
            "Measures of mixed societies over the share of programmed robots.",
        ),
    ]


def beyond_table(beyond: Mapping[tuple[str, str], Sequence[tuple[float, int]]]) -> str:
    """A table of the mixtures that lie beyond both kinds alone, by condition and measure."""
    rows = [
        {
            "condition": CONDITIONS[condition].title,
            "measure": MEASURED[name].title,
            "programmed robots": ", ".join(f"{round(9 * share)}" for share, _ in several),
            "than either kind alone": ", ".join(
                "more" if side > 0 else "less" for _, side in several
            ),
        }
        for (condition, name), several in beyond.items()
        if several
    ]
    return html.table(rows, "Mixtures beyond both kinds alone, of nine robots.") if rows else ""


def _farmers(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], village: farmers.Found,
    size: Size,
) -> list[str]:  # fmt: skip
    rows = []
    for name, measured in farmers.MEASURED.items():
        cells = {
            one: spread(one_of(tables["farmers-means"], name, society=one), measured.digits)
            for one in farmers.SOCIETIES
        }
        rows.append({"measure": f"{measured.title} ({measured.unit})", **cells})
    return [
        html.paragraph(
            "Where trade confirms callings, farmers and artisans specialise by the scheme that "
            "somebody wrote. Here a mind that was taught for wheat alone weighs the same plans, "
            "from the same cognitons; and from what it does a scheme of few links is distilled. "
            f"{size.farmers} seeds, {number(size.farmers_ticks, 0)} ticks."
        ),
        findings("farmers"),
        html.picture(
            figures["farmers"],
            "Figure 6. Three societies on the same seeds: over time, and measure by measure, with "
            "intervals of 95 %. Grey strokes: what luck alone gives.",
            "Measures of three societies of farmers and artisans.",
        ),
        html.table(rows, "Table 5. Means with intervals of 95 %; unknown where none settled.",
                     numbers=True),
        html.picture(
            figures["schemes"],
            "Figure 7. The scheme that was written, and the one distilled from the learned mind: "
            "cognitons at the left, plans at the right. Numbers are the links’ weights; a line is "
            "the broader the larger its weight is beside the scheme’s largest.",
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
            "Intervals are of 95 %, by the bias-corrected and accelerated bootstrap over worlds "
            "(Efron, 1987). Societies that met the same worlds are compared in pairs: the interval "
            "is that of the mean difference; g is Hedges’ g for pairs, by the mean standard "
            "deviation of the two; δ is Cliff’s delta for pairs, the share of worlds in which the "
            "number is larger less that in which it is smaller. An interval that holds 0 does "
            "not show that there is no difference; nothing is corrected for the number of "
            "comparisons, so the effects are what to read."
        ),
    ]


def _made(size: Size, command: str, seeds: str) -> list[str]:
    mind = MindDescription.load(model_folder("foraging_roles") / "mind")
    versions = {
        "socialmind": socialmind.__version__,
        "Python": platform.python_version(),
        "NumPy": np.__version__,
        "numba": numba.__version__,
        "Matplotlib": matplotlib.__version__,
    }
    told = ", ".join(f"{name} {version}" for name, version in versions.items())
    return [
        html.code(command),
        html.paragraph(
            f"Worlds of robots: seeds {seeds}, `foraging_roles` with its mind of "
            f"{len(mind.skills)} skills; roles and deliveries are recorded every {EVERY} ticks. "
            f"Farmers and artisans: seeds 0 … {size.farmers - 1}, recorded every {farmers.EVERY} "
            f"ticks. The same command gives the same file, with the same versions: {told}."
        ),
        html.paragraph(
            "The tables stand beside this page as CSV, the figures as PDF, in the folder "
            "`specialisation`; `worlds.csv` holds a row for each society, condition and world."
        ),
    ]
