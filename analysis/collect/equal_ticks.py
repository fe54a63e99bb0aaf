"""Whether hierarchy and monolith have learned all they will: curves against ticks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import Interval, interval_of

from .curricula import EVEN_MORE, MORE, STILL_MORE
from .figures import short_of
from .tables import write_rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.learning import Training

NAME = "figure-6.5-equal-ticks"
COLLECT = ("Collect", MORE, STILL_MORE)
PANELS = (
    ("hierarchy_level", COLLECT, "hierarchy", 1500),
    ("monolith_level", (*COLLECT, EVEN_MORE), "one network", None),
    ("hierarchy_level_at_once", ("All at once",), "hierarchy, task alone", None),
    ("monolith_level_at_once", ("All at once",), "network, task alone", None),
)
"""The training, its lessons of the last task, the title of each panel, and the thesis's
generations where it tells them. Two beside each other have the same score."""
STEP = 10
"""Million ticks over whose generations a point of a curve is the mean."""
LAST = 4
"""The part of a curve, one in so many of its ticks, in which it is to have levelled off."""


@dataclass(frozen=True)
class Learned:
    """What the attempts of a training came to in its lessons of the last task.

    Attributes:
        title: of its panel.
        curves: for each attempt the score on common worlds, a number every `STEP` million ticks.
        finals: of each attempt.
        generations: the least and the most of an attempt.
        seams: million ticks after which each lesson but the first begins.
        thesis: the generations that the thesis gave it; None where it does not tell.
    """

    title: str
    curves: Mapping[int, np.ndarray]
    finals: Mapping[int, float]
    generations: tuple[int, int] = (0, 0)
    seams: tuple[int, ...] = ()
    thesis: int | None = None

    @property
    def late_gain(self) -> Interval:
        """What the last part of the last lesson added, in shares of the score, over attempts.

        The lesson before has other common worlds, and the first generations of the last one lose
        by its large steps.
        """
        own = self.seams[-1] // STEP if self.seams else 0
        return interval_of([gained(one[own:]) for one in self.curves.values()])


def thinned(ticks: np.ndarray, scores: np.ndarray, step: float = STEP * 1e6) -> np.ndarray:
    """Return the mean score of the generations that end within each step of ticks.

    Where none does, the one before stands.

    >>> thinned(np.array([4.0, 9.0, 12.0, 31.0]), np.array([1.0, 3.0, 5.0, 7.0]), step=10.0)
    array([2., 5., 5., 7.])
    """
    places = np.ceil(ticks / step).astype(int)
    means = [
        scores[places == place].mean() if (places == place).any() else np.nan
        for place in range(1, places[-1] + 1)
    ]
    for place in np.flatnonzero(np.isnan(means)):
        means[place] = means[place - 1]
    return np.array(means)


def gained(curve: np.ndarray) -> float:
    """Return how much of the score the last part of a curve adds to that before it.

    Each is the mean of a tenth of the points: of the last ones, and of those before the last part.
    What comes from nothing counts as no gain.

    >>> gained(np.array([1.0] * 15 + [1.1] * 5)).__round__(3)
    0.1
    """
    width = max(1, len(curve) // 10)
    before = curve[: len(curve) - len(curve) // LAST][-width:].mean()
    return float(curve[-width:].mean() / before - 1) if before else 0.0


def learned(
    training: Training, lessons: Sequence[str], title: str, thesis: int | None = None
) -> Learned:
    """Return what the attempts that have finished the last of some lessons came to in them.

    A lesson's part of a curve ends with its budget, whatever the last generation adds, so that the
    next one begins at the same ticks for all attempts.
    """
    told = training.lessons
    told = told[told["lesson"] == lessons[-1]]
    budgets = {one["name"]: one["budget"] for one in training.manifest.lessons}
    curve = training.curve
    parts_of: dict[int, list[np.ndarray]] = {}
    generations = []
    for attempt in told["attempt"].tolist():
        parts_of[attempt], count = [], 0
        for lesson in lessons:
            own = curve[(curve["attempt"] == attempt) & (curve["lesson"] == lesson)]
            count += len(own)
            part = thinned(own["ticks"].to_numpy(), own["validated"].to_numpy())
            points = len(part) if budgets[lesson] is None else int(budgets[lesson] / 1e6 / STEP)
            parts_of[attempt].append(part[:points])
        generations.append(count)
    # Small versions have no budgets: there the lessons before end with the shortest attempt.
    ends = [min(map(len, several)) for several in list(zip(*parts_of.values(), strict=True))[:-1]]
    curves = {
        attempt: np.concatenate(
            [*(part[:end] for part, end in zip(parts, ends, strict=False)), parts[-1]]
        )
        for attempt, parts in parts_of.items()
    }
    seams = tuple(STEP * sum(ends[: place + 1]) for place in range(len(ends)))
    finals = dict(zip(told["attempt"], told["score"], strict=True))
    between = (min(generations, default=0), max(generations, default=0))
    return Learned(title, curves, finals, between, seams, thesis)


def draw(all_learned: Sequence[Learned]) -> Figure:
    """Draw a panel for each training, with one scale for each kind of lesson."""
    down = -(-len(all_learned) // 2)
    with paper.style():
        drawn = paper.figure(paper.COLUMN, 46.0 * down + 8)
        panels = drawn.subplots(down, 2, squeeze=False, sharey="row")
        for place, axes in enumerate(panels.flat):
            if place >= len(all_learned):
                axes.set_visible(False)
                continue
            own = all_learned[place]
            failed = fallen_short(all_learned, place)
            paper.attempts(axes, list(own.curves.values()), failed, step=STEP)
            for seam in own.seams:
                axes.axvline(seam, color=paper.GREY, linewidth=0.6, linestyle=":")
            axes.set_ylim(bottom=-0.03 * axes.get_ylim()[1])  # who learns nothing is seen
            thesis = "not told" if own.thesis is None else f"{own.thesis:,}"
            axes.set_xlabel(
                f"million ticks of the task,\n{between(own)} generations\n(thesis: {thesis})"
            )
            axes.set_ylabel("" if place % 2 else "score, common worlds")
            paper.panel_title(axes, "abcd"[place], own.title)
        every = [one for own in all_learned for one in own.curves.values()]
        failed = [
            one for place in range(len(all_learned)) for one in fallen_short(all_learned, place)
        ]
        key = [one for one in paper.attempts_key(every, failed) if one.get_label()[:3] != "its"]
        drawn.legend(handles=key, loc="outside lower center", ncols=3, columnspacing=1.2,
                     handlelength=1.6)  # fmt: skip
    return drawn


def fallen_short(all_learned: Sequence[Learned], place: int) -> list[bool]:
    """Return which attempts of a panel fell short of what the better of its row usually learn."""
    beside = all_learned[place - place % 2 : place - place % 2 + 2]
    usual = max(float(np.median(list(own.finals.values()))) for own in beside)
    return short_of(list(all_learned[place].finals.values()), usual)


def between(own: Learned) -> str:
    """Return how many generations attempts had.

    >>> between(Learned("", {}, {}, (160, 170))), between(Learned("", {}, {}, (3, 3)))
    ('160–170', '3')
    """
    least, most = own.generations
    return f"{least:,}" if least == most else f"{least:,}–{most:,}"


def findings(all_learned: Sequence[Learned]) -> list[str]:
    """Return what can be said of each training, a line each."""
    lines = []
    for place, own in enumerate(all_learned):
        gain, finals = own.late_gain, list(own.finals.values())
        ticks = STEP * min(map(len, own.curves.values()))
        several = len(finals) > 1
        apart = f" ({gain.low:+.1%} to {gain.high:+.1%} over attempts)" if several else ""
        lines.append(
            f"{own.title}: {len(finals)} attempt{'s' if several else ''} of {ticks:,} million "
            f"ticks; the last quarter {'of the last lesson' if own.seams else 'of them'} added "
            f"{gain.mean:+.1%}{apart} to the score of the best individuals on common worlds. "
            f"Finals of {min(finals):.2f} to {max(finals):.2f}, "
            f"median {np.median(finals):.2f}; {sum(fallen_short(all_learned, place))} fell short. "
            f"{between(own)} generations; thesis: "
            + (
                "not told."
                if own.thesis is None
                else f"{own.thesis:,}, so **budgets are not equal**."
            )
        )
    return lines


def write(trainings: Mapping[str, Training], made: Sequence[str], out: Path) -> list[Path]:
    """Write the figure, what it says (Markdown), and its curves (CSV).

    Args:
        trainings: by plan; those with attempts that have come to the end.
        made: how they came about, a line each.
        out: the folder, made where it is missing.

    Returns:
        The files written.
    """
    shown = {
        plan: learned(trainings[plan], lessons, title, thesis)
        for plan, lessons, title, thesis in PANELS
        if plan in trainings
    }
    shown = {plan: own for plan, own in shown.items() if own.finals}
    written = paper.save({NAME: draw(list(shown.values()))}, out)
    page = out / f"{NAME}.md"
    lines = [
        "# Figure 6.5, equal ticks: whether more ticks would teach more",
        "",
        *made,
        "",
        *(f"- {line}" for line in findings(list(shown.values()))),
        "",
        "A grey line is an attempt, red where its final individual fell short: of 75 % of the "
        "median of the better of two panels beside each other. Blue is the median "
        "of the attempts. A point is the mean of the best individuals of the generations of "
        f"{STEP} million ticks, each judged on the same worlds, which no generation is trained in. "
        "Behind a dotted line is another lesson: steps begin large again, so that the best of a "
        "generation is worse for a while, and the common worlds are others.",
        "",
    ]
    page.write_text("\n".join(lines), encoding="utf-8")
    rows = [
        {
            "training": plan,
            "attempt": attempt,
            "lesson": 1 + sum(seam < STEP * place for seam in own.seams),
            "million_ticks": STEP * place,
            "score": f"{score:.5g}",
        }
        for plan, own in shown.items()
        for attempt, curve in own.curves.items()
        for place, score in enumerate(curve, 1)
    ]
    return [*written, page, write_rows(out / f"{NAME}.csv", rows)]
