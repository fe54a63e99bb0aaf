"""How the robot learns to count (thesis, 7.2), on top of what the one of `collect_retrained` knows.

GoToValid is GoToDropZone with another sensor: what is known of the one is taken over. CountObjects
alone is learned, by what its robot does: no reward and no rule ever reads the variable Count. The
first lesson is the task in outline, without bodies; the second one is the task itself.
"""

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.mind import Counter as CounterVariable
from socialmind.mind import (
    InfluenceNetwork,
    Input,
    MindDescription,
    Output,
    Perceptron,
    Skill,
    Variable,
)

from .model import Counter
from .sketch import STAND_INS, Sketch

LESSONS = load_file(model_folder("collect") / "lessons.py")
MASTER = "CountObjects"
WANTED = ("SE:WANTED",)
"""What CountObjects reads besides, where the number of objects varies."""
COUNTING = CounterVariable()
"""The variable of the thesis: it counts in tenths."""
DECIDING = Perceptron(layers=0)
"""A line between two numbers is all that a count takes."""
HOLDING = InfluenceNetwork(branches=1, passes=(3,), layers=0)
"""Lets the variable through as it is, and so holds it: for a variable that does not count."""


# Minds ------------------------------------------------------------------------------------------


def hierarchy(regulation=COUNTING, function=DECIDING, inputs=(), folder="collect_retrained"):
    """Return the hierarchy of figure 7.4, in which all but CountObjects is known.

    Args:
        regulation: of the variable Count.
        function: the internal function of CountObjects.
        inputs: sensors that CountObjects reads beside three presence sensors and the variable.
        folder: the model whose mind it stands on.
    """
    known = MindDescription.load(model_folder(folder) / "mind")
    goes, dodges = known.skills["GoToDropZone"], known.skills["GoToDropZone+Avoid"]
    read = [Input.parse("SE:RADVZ") if one.name == "RADDZ" else one for one in dodges.inputs]
    skills = [
        Skill("GoToValid", ["SE:RADVZ"], goes.outputs, goes.function, goes.genome),
        Skill(
            "GoToValid+Avoid",
            read,
            [
                Output.parse("SK:GoToValid") if one.name == "GoToDropZone" else one
                for one in dodges.outputs
            ],
            dodges.function,
            dodges.genome,
        ),
        Skill(
            MASTER,
            ["SE:SENSOBJ", "SE:SENSDZ", "SE:SENSVZ", "VA:Count", *inputs],
            ["SK:Collect", "SK:GoToValid+Avoid", "VA:Count"],
            function,
        ),
    ]
    whole = known.with_modules(
        sensors=["RADVZ", "SENSVZ", *(Input.parse(one).name for one in inputs)],
        variables=[Variable("Count", regulation)],
        skills=skills,
    )
    return MindDescription(
        MASTER,
        whole.sensors.values(),
        whole.actuators.values(),
        whole.variables.values(),
        whole.skills.values(),
    )


# Lessons ----------------------------------------------------------------------------------------

FEW = {
    "population": 400, "selected": 0.03, "elite": 5, "mutation": 0.3, "step": 2.0, "narrowing": 0.98
}  # fmt: skip
"""Few parents: most individuals never validate, and they are all alike."""
FINAL = {"population": 20, "selected": 0.2, "elite": 5, "mutation": 0.3, "step": 0.2}


def lessons(wanted=2):
    """Return the lessons of CountObjects.

    Args:
        wanted: how many objects a sequence has; 0 for a number drawn anew for each.
    """
    parameters = {"wanted": wanted}
    return (
        Lesson("In outline", Sketch, skill=MASTER, stand_ins=STAND_INS, repetitions=4,
               generations=100, settings=FEW, parameters=parameters),
        Lesson("In the arena", Counter, skill=MASTER, repetitions=4, generations=3,
               settings=FINAL, start="known", parameters=parameters),
    )  # fmt: skip


curriculum = Curriculum(lessons(), mind=hierarchy())
