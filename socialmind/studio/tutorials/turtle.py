"""The tutorial of CogLogo's manual (thesis, A.7): the mind of a turtle, from an empty page."""

from functools import partial

from socialmind.studio.tutorials.goals import Called, Cogniton, Decides, Link, Parts, Plan
from socialmind.studio.tutorials.showing import courses_of_scheme
from socialmind.studio.tutorials.step import Step, Tutorial

DRAW = (
    "Draw it from the dot at the right side of the cogniton's box to the plan's box, then type "
    "the weight at the right. Or select the cogniton and type the plan's name under Links."
)


def _wish(cogniton: str, plan: str, other: str) -> tuple[Link, Link]:
    return Link("influence", cogniton, plan, 1.0), Link("influence", cogniton, other, -1.0)


TURTLE = Tutorial(
    word="turtle",
    title="The mind of a turtle",
    about="The tutorial of CogLogo's manual: a turtle between a red, a blue and a green patch.",
    editor="mind",
    parts=Parts,
    courses=partial(courses_of_scheme, "tutorial", "turtles", "visits", 1000),
    model="tutorial",
    population="turtles",
    measure="visits",
    steps=(
        Step(
            "A scheme of one's own",
            (
                "A turtle runs to and fro between a red and a blue patch. Every step makes it "
                "fonder of a green one, until it goes there, and everything begins again. Its "
                "mind is a scheme, which you draw.",
                "The scheme is for the turtles of the model tutorial: call it turtles.",
            ),
            "With nothing selected, the name stands at the top of the right side.",
            (Called("turtles"), Decides("MaximumWeight")),
        ),
        Step(
            "Two plans",
            (
                "A plan is what a turtle can do. The model knows how to go to a patch: its rules "
                "are called goto-red and goto-blue. Make a plan for each, with that name.",
            ),
            "Press p, type the name, press Enter.",
            (Plan("goto-red"), Plan("goto-blue")),
        ),
        Step(
            "A wish",
            (
                "A cogniton is a number in the turtle's mind. wantRed is to be 1 when the turtle "
                "wants to go to red, else 0: the model sets it. It is there at birth, and starts "
                "at 0.",
            ),
            "Press c, type wantRed, press Enter.",
            (Cogniton("wantRed"),),
        ),
        Step(
            "What the wish speaks for",
            (
                "An influence link adds the cogniton's value, times its weight, to a plan's "
                "weight. Who wants red goes to red (1), and not to blue (−1).",
            ),
            DRAW,
            _wish("wantRed", "goto-red", "goto-blue"),
        ),
        Step(
            "What the wish opens",
            (
                "A plan can be chosen only if a conditional link opens it, whatever its weight. "
                "Whoever has the cogniton wantRed can go to red.",
            ),
            "Choose conditional above the canvas (key 2), then draw from wantRed to goto-red.",
            (Link("conditional", "wantRed", "goto-red"),),
        ),
        Step(
            "The wish for blue",
            (
                "The same the other way round: wantBlue speaks for goto-blue (1), against "
                "goto-red (−1), and opens goto-blue. It starts at 1: the turtle goes to blue "
                "first.",
            ),
            "The start value is at the right while wantBlue is selected. Key 1 draws influence "
            "again.",
            (
                Cogniton("wantBlue", 1.0),
                *_wish("wantBlue", "goto-blue", "goto-red"),
                Link("conditional", "wantBlue", "goto-blue"),
            ),
        ),
        Step(
            "A third wish",
            (
                "wantGreen starts at 0. It speaks for goto-green (1) and against both others (−1 "
                "each), and opens goto-green.",
            ),
            "Under Links at the right, a plan's name that is not there yet makes the plan.",
            (
                Plan("goto-green"),
                Cogniton("wantGreen"),
                Link("influence", "wantGreen", "goto-green", 1.0),
                Link("influence", "wantGreen", "goto-red", -1.0),
                Link("influence", "wantGreen", "goto-blue", -1.0),
                Link("conditional", "wantGreen", "goto-green"),
            ),
        ),
        Step(
            "What is done changes the mind",
            (
                "A reinforcement link lets a plan feed back into a cogniton. Each step to red or "
                "blue is worth 1.1 to the model; a weight of 0.005 lets wantGreen grow by 0.0055.",
                "Draw one from goto-red and one from goto-blue to wantGreen, each with the weight "
                "0.005.",
            ),
            "A line that is drawn from a plan to a cogniton is a reinforcement link.",
            (
                Link("reinforcement", "wantGreen", "goto-red", 0.005),
                Link("reinforcement", "wantGreen", "goto-blue", 0.005),
            ),
        ),
        Step(
            "Let it run",
            (
                "The mind is whole. Below is how often the turtle has been at the green patch in "
                "a thousand ticks: it comes back every 109 ticks or so, some time after wantGreen "
                "has passed 0.5.",
                "Run with this scheme, above, shows it in the world, and Save keeps the scheme as "
                "a file that socialmind run tutorial --scheme FILE takes.",
            ),
            shows=True,
        ),
    ),
)
