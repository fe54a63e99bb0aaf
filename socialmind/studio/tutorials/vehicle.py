"""A vehicle of Braitenberg's (1984; thesis, figure 2.3): two eyes, two wheels, and two wires."""

from __future__ import annotations

import numpy as np

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.studio.tutorials.mind_goals import MindParts, Module, Plain, Wired
from socialmind.studio.tutorials.showing import SEED, YOURS, courses
from socialmind.studio.tutorials.step import Courses, Document, Step, Tutorial

TICKS = 300
EYES = ("LEFT", "RIGHT")
WHEELS = ("WHEEL_LEFT", "WHEEL_RIGHT")
WIRES = ("LeftWire", "RightWire")
STRAIGHT = dict(zip(EYES, WHEELS, strict=True))
CROSSED = dict(zip(EYES, reversed(WHEELS), strict=True))


def wires_of(document: Document) -> dict[str, str]:
    """Return to which wheel each eye is wired.

    Args:
        document: a mind, as the editor has it.

    Raises:
        SocialmindError: a skill that is no wire from an eye to a wheel.
    """
    found = {}
    for one in document["skills"]:
        read, told = one["inputs"], one["outputs"]
        eye, wheel = ("".join(some)[3:] for some in (read, told))
        if len(read) != 1 or len(told) != 1 or eye not in EYES or wheel not in WHEELS:
            raise SocialmindError(f"{one['name']} is no wire from an eye to a wheel yet")
        found[eye] = wheel
    return found


def vehicle(wires: dict[str, str]) -> MindDescription:
    """Return the mind of a vehicle for the model braitenberg.

    Args:
        wires: the wheel of each eye.
    """
    sensors = (*EYES, "CROSSED", "INHIBITING")
    skills = [
        Skill(f"{eye} eye", [f"SE:{eye}"], [f"MO:{wheel}"], Perceptron(layers=0), [1.0, 0.0])
        for eye, wheel in wires.items()
    ]
    parts = [f"SK:{one.name}" for one in skills]
    # One who influences all of them, fully: a bias of 1 and no weight.
    master = Skill("Body", ["SE:LEFT"], parts, Perceptron(layers=0), [0.0, 1.0] * len(parts))
    return MindDescription("vehicle", sensors, WHEELS, skills=[*skills, master])


def vehicles_away(document: Document) -> Courses:
    """Return how far vehicles are from the nearest light over time: those wired so, and others.

    Args:
        document: the mind of a vehicle, as the editor has it.

    Raises:
        SocialmindError: it is not wired yet.
    """
    model = load_model("braitenberg")
    wires = wires_of(document)
    minds = {YOURS: wires}
    if wires == CROSSED:
        minds["straight wires"] = STRAIGHT
    societies = {name: model(seed=SEED, hierarchy=vehicle(one)) for name, one in minds.items()}
    return courses(societies, lambda society: np.mean(society.distances()), TICKS)


VEHICLE = Tutorial(
    word="vehicle",
    title="A vehicle of Braitenberg's",
    about="Two eyes, two wheels, two wires: what looks like fear and aggression.",
    editor="skills",
    parts=MindParts,
    courses=vehicles_away,
    measure="patches to the nearest light",
    steps=(
        Step(
            "A body",
            (
                "A mind of skills does not decide, it steers. It reads sensors and commands "
                "motors, all of them numbers from 0 to 1.",
                "This body has two eyes, which see how bright it is, and two wheels. Make the "
                "sensors LEFT and RIGHT, and the motors WHEEL_LEFT and WHEEL_RIGHT.",
            ),
            "Press s for a sensor or m for a motor, type the name, press Enter.",
            (
                *(Module("sensors", name) for name in EYES),
                *(Module("actuators", name) for name in WHEELS),
            ),
        ),
        Step(
            "Two skills",
            (
                "A skill reads some inputs and gives some outputs; inside it is a function. Make "
                "two skills, LeftWire and RightWire. Inside each: a perceptron with 0 hidden "
                "layers, which is a single neuron. The more light, the faster the wheel.",
            ),
            "Press k, type the name, press Enter; then type 0 at hidden layers, at the right.",
            (*(Module("skills", name) for name in WIRES), *(Plain(name) for name in WIRES)),
        ),
        Step(
            "Straight wires",
            (
                "Each wire goes to the wheel on its own side: LeftWire reads LEFT and commands "
                "WHEEL_LEFT, RightWire reads RIGHT and commands WHEEL_RIGHT.",
                "What will forty such vehicles do among three lights? Guess before you draw the "
                "last link.",
            ),
            "Draw from the sensor's box to the skill's, and from the skill's to the motor's.",
            (Wired("LeftWire", "LEFT", "WHEEL_LEFT"), Wired("RightWire", "RIGHT", "WHEEL_RIGHT")),
            shows=True,
        ),
        Step(
            "Crossed wires",
            (
                "They keep away from lights: the wheel at the bright side is the faster one. "
                "Braitenberg calls it fear.",
                "Now cross the wires: LeftWire commands WHEEL_RIGHT, RightWire commands "
                "WHEEL_LEFT.",
            ),
            "Click a link and press Delete, then draw the other one.",
            (Wired("LeftWire", "LEFT", "WHEEL_RIGHT"), Wired("RightWire", "RIGHT", "WHEEL_LEFT")),
            shows=True,
        ),
        Step(
            "What you have seen",
            (
                "Nothing in these vehicles knows what a light is, and yet one kind flees it and "
                "the other charges at it. Save keeps the mind as a folder or a YAML file, without "
                "weights: here they were set to 1 for you, in a lesson they are learned. The "
                "model braitenberg, in the room Run, shows all four wirings at once.",
            ),
            shows=True,
        ),
    ),
)
