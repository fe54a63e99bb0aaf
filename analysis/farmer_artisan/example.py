"""The example of figure 3.1: two cognitons, two plans, and the weights that come of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coglogo_py import CognitiveScheme, Cogniton, Society
from socialmind.drawing import style as paper
from socialmind.drawing.scheme import draw_scheme, key

if TYPE_CHECKING:
    from matplotlib.figure import Figure

VALUES = {"A": 3.0, "B": 2.0}
"""Of the cognitons."""
SCHEME = CognitiveScheme(
    "example",
    (
        Cogniton("A", influence={"Plan 1": 4.0, "Plan 2": -1.0}, conditional=("Plan 1", "Plan 2")),
        Cogniton("B", influence={"Plan 2": 6.0}),
    ),
)
"""Each plan is opened by A, so that both can be weighed."""


def weights() -> list[dict[str, object]]:
    """Return the weight of each plan, as a mind of the engine weighs it (equation 3.2)."""
    mind = Society(SCHEME, seed=0).new_mind()
    for name, value in VALUES.items():
        mind.activate_cogniton(name)
        mind.set_cogniton_value(name, value)
    return [{"plan": plan, "weight": weight} for plan, weight in mind.plan_weights().items()]


def draw() -> Figure:
    """Draw the scheme with the values of its cognitons and the weights of its plans."""
    with paper.style():
        figure = paper.figure(paper.COLUMN, 50)
        axes = figure.subplots()
        draw_scheme(SCHEME, axes)
        values = ", ".join(f"{name} has the value {value:g}" for name, value in VALUES.items())
        plans = ", ".join(f"{row['plan']} weighs {row['weight']:g}" for row in weights())
        axes.set_title(f"{values};\n{plans}", fontsize=7)
        figure.legend(handles=key(SCHEME), loc="outside lower center", ncols=2)
    return figure
