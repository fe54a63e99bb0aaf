"""What the robot learns, one lesson at a time (thesis, 7.1.2).

All skills that steer stand on four constant base skills. GoToTarget and GoToTarget+Avoid are
learned before anything writes the variable Target: a drive module writes it meanwhile.
"""

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.mind import InfluenceNetwork, Input, MindDescription, Perceptron, Skill, Variable

from .model import TargetVariable

LESSONS = load_file(model_folder("collect") / "lessons.py")
MASTER = "CollectVariable"
BELOW = ("GoToTarget", "Avoid", "GoToTarget+Avoid")
TARGET = "VA:Target"

SELECTING = InfluenceNetwork(branches=1, passes=(2, 3), layers=0)
"""Lets one of the two orientations through as it is (thesis, 9.2.4)."""
MIXING = Perceptron(layers=2)
"""The function of all learned skills of the thesis."""


def follow_object(mind):
    """Write the direction of the object into the variable, as VarFeeder does in the thesis."""
    mind.set_variable("Target", mind.sensor("RADOBJ"))


# Minds ------------------------------------------------------------------------------------------


def hierarchy(function=SELECTING):
    """Return the hierarchy of figure 7.1, in which Avoid and the constant skills are known.

    Args:
        function: the internal function of CollectVariable.
    """
    known = MindDescription.load(model_folder("collect") / "mind_constant")
    goes, dodges = known.skills["GoToObject"], known.skills["GoToObject+Avoid"]
    read = [Input.parse(TARGET) if one.name == "RADOBJ" else one for one in dodges.inputs]
    skills = [
        Skill("GoToTarget", [TARGET], goes.outputs, goes.function),
        Skill("GoToTarget+Avoid", read, ["SK:GoToTarget", "SK:Avoid"], dodges.function),
        Skill(
            MASTER,
            ["SE:SENSOBJ", "SE:SENSDZ", "SE:RADOBJ", "SE:RADDZ"],
            ["SK:GoToTarget+Avoid", "SK:ClawControl", TARGET],
            function,
        ),
    ]
    left = ["GoToObject", "GoToDropZone", "GoToObject+Avoid", "GoToDropZone+Avoid", "Collect"]
    # Ahead is where nobody has said where to go.
    target = Variable("Target", default=0.5)
    whole = known.with_modules(variables=[target], skills=skills, without=left)
    return MindDescription(
        MASTER,
        whole.sensors.values(),
        whole.actuators.values(),
        whole.variables.values(),
        whole.skills.values(),
    )


# Lessons ----------------------------------------------------------------------------------------

lessons = (
    Lesson(
        "GoToTarget",
        LESSONS.GoToObject,
        repetitions=4,
        generations=75,
        settings=LESSONS.COARSE,
        drive=follow_object,
    ),
    Lesson(
        "GoToTarget+Avoid",
        LESSONS.GoToObjectAvoid,
        repetitions=10,
        generations=40,
        settings=LESSONS.FINE,
        drive=follow_object,
    ),
    Lesson(
        MASTER,
        TargetVariable,
        ticks=5000,
        repetitions=8,
        generations=20,
        settings=LESSONS.FINE,
    ),
    Lesson(
        "All in context",
        TargetVariable,
        skill=BELOW,
        master=MASTER,
        ticks=5000,
        repetitions=8,
        generations=1000,
        budget=200_000_000,
        settings={**LESSONS.FINE, "step": 0.5},
        start="known",
    ),
)
"""What is learned whatever the function of CollectVariable is."""

curriculum = Curriculum(lessons, mind=hierarchy())
