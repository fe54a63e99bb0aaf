"""The minds of foraging robots, built on the robot that collects (thesis, figure 8.2)."""

from dataclasses import replace

from socialmind.catalogue import model_folder
from socialmind.mind import Actuator, Input, MindDescription, Output, Perceptron, Programmed, Skill

RANGES = [f"SE:S{number}" for number in range(1, 11)]
WHEELS = ["MO:MotL", "MO:MotR"]
SIGNAL = ("GoToSignal", "ReachSignal")
SEARCH, SEARCH_AVOID, FORAGE = "Search", "Search+Avoid", "Forage"
SENSORS = ("ACTOBJ", "HOLDS", "RADBOT", "ACTBOT", "RADSIG", "ACTSIG")


def emit_signal(ACTOBJ):
    """Emit a signal as long as there are objects in sight."""
    return 1.0 if ACTOBJ > 0.5 else 0.0


def stand_still():
    """Stop both wheels."""
    return 0.5, 0.5


def walk_at_random(NOISE):
    """Go straight on, and turn on the spot for a while now and then."""
    if NOISE < 0.1:
        return 0.0, 1.0
    if NOISE < 0.2:
        return 1.0, 0.0
    return 1.0, 1.0


def collector() -> MindDescription:
    """Return the mind of the robot that collects alone."""
    return MindDescription.load(model_folder("collect_retrained") / "mind")


def reading(skill: Skill, name: str, was: str, reads: str, outputs: list[str]) -> Skill:
    """Return a copy of a skill that reads another sensor and commands other skills."""
    inputs = [Input.parse(reads) if str(one) == was else one for one in skill.inputs]
    return replace(skill, name=name, inputs=inputs, outputs=[Output.parse(one) for one in outputs])


def forager(mind: MindDescription | None = None) -> MindDescription:
    """Return the hierarchy of figure 8.2 on a mind that can collect.

    What goes to a signal begins as a copy of what goes to an object, and Search+Avoid as one of
    what goes to an object among obstacles; Search and Forage have no weights yet.

    Args:
        mind: the one that can collect; by default that of `collect_retrained`.
    """
    known = mind or collector()
    go, dodge = known.skills["GoToObject"], known.skills["GoToObject+Avoid"]
    skills = [
        reading(go, "GoToSignal", "SE:RADOBJ", "SE:RADSIG", WHEELS),
        reading(dodge, "ReachSignal", "SE:RADOBJ", "SE:RADSIG", ["SK:GoToSignal", "SK:Avoid"]),
        reading(dodge, SEARCH_AVOID, "SE:RADOBJ", "SE:RADBOT", [f"SK:{SEARCH}", "SK:Avoid"]),
        Skill(SEARCH, ["SE:RADBOT"], WHEELS, Perceptron(layers=2)),
        Skill("EmitSignal", ["SE:ACTOBJ"], ["MO:SIGNAL"], Programmed(emit_signal)),
        Skill("Idle", [], WHEELS, Programmed(stand_still)),
        Skill(
            FORAGE,
            ["SE:ACTBOT", "SE:ACTSIG", "SE:ACTOBJ", "SE:HOLDS"],
            [f"SK:{one}" for one in (SEARCH_AVOID, "EmitSignal", "ReachSignal", "Collect", "Idle")],
            Perceptron(layers=1),
        ),
    ]
    made = known.with_modules(
        sensors=SENSORS, actuators=[Actuator("SIGNAL", neutral=0.0)], skills=skills
    )
    return MindDescription(
        FORAGE,
        list(made.sensors.values()),
        list(made.actuators.values()),
        list(made.variables.values()),
        list(made.skills.values()),
    )


def walking_at_random(mind: MindDescription) -> MindDescription:
    """Return a foraging mind whose Search is a random walk."""
    walk = Skill(SEARCH, ["SE:NOISE"], WHEELS, Programmed(walk_at_random))
    return mind.with_modules(sensors=["NOISE"], skills=[walk])
