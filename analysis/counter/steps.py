"""Figures 7.5 and 7.6 of the thesis: five steps of a robot that counts, and its variable."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from socialmind.catalogue import load_file, load_model, model_folder
from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments import run
from socialmind.experiments.pictures.picture_page import Style
from socialmind.experiments.pictures.rendering import draw_steps
from socialmind.experiments.studies import write_figure

FIGURES = load_file(model_folder("counter") / "figures.py")
SEEDS = range(75, 95)
"""Of the runs that are tried, one after another, until one has a correct sequence."""
TICKS = 6000
"""Of a run: two sequences or more."""
TRAIL = 600
"""Ticks of the path that are drawn."""
STEPS = (
    "it brings the first object to the drop zone",
    "it has just dropped the first object",
    "it brings the second object to the drop zone",
    "it has just dropped the second object",
    "it has just reached the validation zone",
)
PAGES = {"figure-7.5": slice(0, 3), "figure-7.6": slice(3, 5)}
"""Which steps are in which figure."""


def write_steps(out: Path) -> list[Path]:
    """Draw a sequence step by step, the world beside the hierarchy, and the variable over time.

    Args:
        out: the folder.

    Returns:
        Two figures of steps, one of the variable over the whole run, and the steps as CSV.

    Raises:
        SocialmindError: no run has a correct sequence.
    """
    for seed in SEEDS:
        memory = FIGURES.watched(load_model("counter")(seed=seed), TICKS)
        several = [one for one in FIGURES.sequences(memory) if len(one) == len(STEPS)]
        if several:
            break
    else:
        raise SocialmindError(f"no correct sequence in {len(SEEDS)} runs of {TICKS:,} ticks")
    shown = several[0]
    rows = [
        {
            "seed": seed,
            "step": number,
            "tick": int(memory.tick[place]),
            "variable": round(float(memory.value[place]), 4),
            **{name: round(float(sent[place]), 4) for name, sent in memory.influence.items()},
            "carrying": int(memory.carrying[place]),
            "delivered": int(memory.delivered[place]),
            "correct": int(memory.correct[place]),
        }
        for number, place in enumerate(shown, 1)
    ]
    captions = [
        f"Step {row['step']}: {what}; {FIGURES.VARIABLE} is {row['variable']:g}."
        for row, what in zip(rows, STEPS, strict=True)
    ]
    ticks = [row["tick"] for row in rows]
    style = Style(mind=True, trail=TRAIL, inputs=False, plane_first=True)
    written = []
    with TemporaryDirectory() as folder:
        made = run(load_model("counter"), ticks[-1], seed, out=Path(folder) / "run")
        for name, part in PAGES.items():
            written += draw_steps(made, out / name, ticks[part], style, captions[part], rows=3)
    with paper.style():
        drawn = FIGURES.over_time(memory)
    return [*written, *write_figure("figure-7.5-memory", drawn, rows, out)]
