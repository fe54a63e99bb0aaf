"""How the robots come to their roles (thesis, 8.2): the mind, and the lesson of ForageRole.

Collect A and Collect B are duplicates of the Collect that is known. ForageRole, which says after
each delivery what the robot's role is to be, is what is learned, by all robots as one species.
"""

from socialmind.catalogue import model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.mind import InfluenceNetwork, MindDescription, Programmed, Skill, Variable
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.variants import duplicates

from .economy import Economy
from .model import ACTUATORS, SENSORS

MASTER, ROLE = "Forage", "ForageRole"
SETTLING = InfluenceNetwork(branches=1, passes=(1,))
"""The role as it is, or what a perceptron says, mixed by influence (thesis, 9.2.4)."""


# Minds ------------------------------------------------------------------------------------------


def forage(PAID):
    """Collect all the time; think about the role after a delivery."""
    return 1.0, PAID


def collect_select(ROLE):
    """Collect what the role says: A below 0.5, else B."""
    if ROLE < 0.5:
        return 1.0, 0.0
    return 0.0, 1.0


def foraging(known: MindDescription, settling: InternalFunction = SETTLING) -> MindDescription:
    """Return the mind of figure 8.5, its ForageRole not learned yet.

    Args:
        known: a mind that can Collect.
        settling: the internal function of ForageRole.
    """
    own = [
        Skill(MASTER, ["SE:PAID"], ["SK:CollectSelect", f"SK:{ROLE}"], Programmed(forage)),
        Skill(ROLE, ["SE:PAYOFF", "VA:ROLE"], ["VA:ROLE"], settling),
        Skill(
            "CollectSelect",
            ["VA:ROLE"],
            ["SK:CollectA", "SK:CollectB"],
            Programmed(collect_select),
        ),
    ]
    skills = {one.name: one for one in (*own, *collecting(known, "A"), *collecting(known, "B"))}
    variables = [*known.variables.values(), Variable("ROLE", default=0.5)]
    return MindDescription("Forager", SENSORS, ACTUATORS, variables, skills.values())


def collecting(known: MindDescription, kind: str) -> list[Skill]:
    """Return the skills of Collect with the sensors and the claw of a kind of objects."""
    modules = {"RADOBJ": f"RADOBJ{kind}", "SENSOBJ": f"SENSOBJ{kind}", "EMAG": f"EMAG{kind}"}

    def renamed(name: str) -> str:
        return name.replace("Object", kind) if "Object" in name else name + kind

    return duplicates(known, "Collect", modules, renamed)


# Lessons ----------------------------------------------------------------------------------------

lesson = Lesson(
    ROLE,
    Economy,
    master=MASTER,
    optimiser="CMAES",
    settings={"population": 40, "step": 0.5},
    repetitions=16,
    generations=300,
    finalists=20,
    finals=256,
)
"""Some 80 generations pass before robots are found that keep a role at all."""

curriculum = Curriculum(
    (lesson,), mind=foraging(MindDescription.load(model_folder("collect_retrained") / "mind"))
)
