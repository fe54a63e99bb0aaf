"""Two minds in the same world: the turtle's own, and one that is changed."""

from functools import partial

from socialmind.studio.tutorials.goals import Decides, Link, Parts
from socialmind.studio.tutorials.showing import courses_of_scheme
from socialmind.studio.tutorials.step import Step, Tutorial
from socialmind.studio.tutorials.turtle import TURTLE

TWO_MINDS = Tutorial(
    word="two-minds",
    title="Two minds in one world",
    about="The turtle's mind against another one of yours: same world, same luck.",
    editor="mind",
    parts=Parts,
    courses=partial(courses_of_scheme, "tutorial", "turtles", "visits", 1000, beside=True),
    model="tutorial",
    population="turtles",
    begins=True,
    measure="visits",
    steps=(
        Step(
            "One mind",
            (
                "This is the mind of the turtle as the model has it, and below how often it has "
                "been at the green patch. You make a second mind of it, and see what it does in "
                "the same world, with the same luck.",
            ),
            goals=TURTLE.goals_of(len(TURTLE.steps) - 1),
            shows=True,
        ),
        Step(
            "Sooner tempted",
            (
                "Let what the turtle does feed back four times as strongly: both reinforcement "
                "links to wantGreen weigh 0.02.",
                "Guess first: will it be at the green patch four times as often?",
            ),
            "Click the number on a link and type, or select wantGreen and change it at the right.",
            (
                Link("reinforcement", "wantGreen", "goto-red", 0.02),
                Link("reinforcement", "wantGreen", "goto-blue", 0.02),
            ),
            shows=True,
        ),
        Step(
            "Why not four times?",
            (
                "It is there more often, but not four times: the wish is there sooner, the way is "
                "as long as before. What an agent does hangs on its mind and on its world.",
                "Now let it be less sure of itself. Choose WeightedStochastic as the decision "
                "maker: a plan is drawn in proportion to the weights, all moved up so that the "
                "least is 1.",
            ),
            "With nothing selected, the decision maker stands at the right.",
            (Decides("WeightedStochastic"),),
            shows=True,
        ),
        Step(
            "What you have done",
            (
                "You have compared minds as a study does: one thing changed, all else equal, the "
                "seed included. One seed is not yet a result: socialmind sweep tutorial --grid "
                "scheme=a.yaml,b.yaml --seeds 0:20 gives intervals.",
            ),
            shows=True,
        ),
    ),
)
