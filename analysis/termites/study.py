"""Whether termites gather chips into piles, and sort them, beside what chance would do.

    python -m analysis.termites.study
    python -m analysis.termites.study --seeds 5 --out /tmp/termites

Writes piles.csv (a row for each society and moment), tables.md, and the figure as study.pdf and
.png.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of
from socialmind.work.side_by_side import side_by_side

from .mounds import MOMENTS, SETTINGS, gathered
from .plots import draw

HERE = Path(__file__).parent / "results"
SHOWN = {
    "piles": ("piles", 1),
    "scattered_piles": ("scattered anew", 1),
    "largest": ("chips of the largest", 0),
    "scattered_largest": ("scattered anew", 0),
    "heaps": ("heaps of any kinds", 1),
    "largest_heap": ("chips of the largest", 0),
    "together": ("share of the patches around a chip that have its kind", 3),
    "by_chance": ("by chance", 3),
    "carried": ("chips carried", 1),
}


def cell(values: pd.Series, digits: int) -> str:
    """Return a mean with its interval."""
    one, form = interval_of(values), f",.{digits}f"
    return f"{one.mean:{form}} ({one.low:{form}} … {one.high:{form}})"


def as_markdown(table: pd.DataFrame) -> str:
    """Return a table for each setting: means, in brackets intervals of 95 %."""
    lines = [
        f"{table['seed'].nunique()} seeds; means, in brackets intervals of 95 % over seeds. 51 × "
        "51 patches, 520 chips.",
    ]
    titles = " | ".join(title for title, _ in SHOWN.values())
    for setting, own in table.groupby("setting", sort=False):
        lines += ["", f"## {str(setting).capitalize()}", "", f"| tick | {titles} |"]
        lines.append("|---|" + "---|" * len(SHOWN))
        for tick, rows in own.groupby("tick"):
            cells = [cell(rows[name], digits) for name, (_, digits) in SHOWN.items()]
            lines.append(f"| {tick:,} | {' | '.join(cells)} |")
        last = own[own["tick"] == MOMENTS[-1]]
        fewer = int((last["piles"] < last["scattered_piles"]).sum())
        closer = int((last["together"] > last["by_chance"]).sum())
        lines += [
            "",
            f"At tick {MOMENTS[-1]:,}: fewer piles than scattered anew in {fewer} of {len(last)} "
            f"seeds, chips closer together than by chance in {closer}.",
        ]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--workers", type=int, help="processes at a time")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for what is written")
    arguments = parser.parse_args()
    if arguments.seeds < 2:
        parser.error("at least two seeds")
    calls = [(setting, seed) for setting in SETTINGS for seed in range(arguments.seeds)]
    found = side_by_side(gathered, calls, arguments.workers, together=5)
    table = pd.DataFrame([row for rows in found for row in rows])
    arguments.out.mkdir(parents=True, exist_ok=True)
    table.to_csv(arguments.out / "piles.csv", index=False, float_format="%.5g")
    text = as_markdown(table)
    (arguments.out / "tables.md").write_text(text, encoding="utf-8")
    paper.save({"study": draw(table)}, arguments.out)
    print(text)


if __name__ == "__main__":
    main()
