"""The example files of the thesis, A.1 to A.4, as tables of path and text."""

SENSORS_OF_A1 = """\
SENSORS
S1:proxSensor
S2:proxSensor
TARG_AZIM:TargetSensor:1
TARG_ELEV:TargetSensor:2
ACTUATORS
M1:propeller
M2:propeller
"""

VARIABLES_OF_A2 = """\
VAR_SIN: TickWaveSinVariableModule
VAR_BASE: VariableModule
#testComment
VAR_COUNT: CounterVariableModule
VAR_ROLE: VariableModule: 0.5
"""

COLLECT = """\
Collect
input:2
SE:SENSOBJ
SE:SENSDZ
output:3
SK:GTO+Avoid
SK:GTDZ+Avoid
SK: ClawControl
neural
layers:2
"""

MOVE_FORWARD = """\
moveForward
input:0
output:2
MO:MotL
MO:MotR
hardCoded
class:MoveForward
"""

AVOID = """\
Avoid
input:15
SE:US_1
SE:US_2
SE:US_3
SE:US_4
SE:US_5
SE:US_6
SE:US_7
SE:US_8
SE:US_9
SE:US_10
SD: US_10
SD:US_1
SD:US_2
VA: VAR_SIN
SE:DOF
output:4
SK:moveForward
SK:turnLeft
SK:turnRight
SK:moveBackwards
neural
layers:2
"""


def _sensed(number):
    """The three inputs of a sensor in figure A.2, its elided lines too."""
    return f"SE: S{number}\nSH:S{number}:5\nSH:S{number}:10\n"


AVOID_CNN = (
    "Avoid\ninput:36\n"
    + "".join(_sensed(number) for number in range(1, 11))
    + """\
SD: S1
SD: S2
SD:S10
SE:DOF
SD:DOF
VA: VAR_TIME
output:4
SK:moveForward
SK:turnLeft
SK: turnRight
SK:moveBackwards
neural
TYPE: CNN
LAYERS:2
CONVO_LAYER:3:10
CONVO_LAYER:3:10
CONVO_BYPASS:30:31:32:33:34:35
CONVO_LINK:0:0:0:1:2
CONVO_LINK:0:1:3:4:5
CONVO_LINK:0:2:6:7:8
CONVO_LINK:0:3:9:10:11
CONVO_LINK:0:4:12:13:14
CONVO_LINK:0:5:15:16:17
CONVO_LINK:0:6:18:19:20
CONVO_LINK:0:7:21:22:23
CONVO_LINK:0:8:24:25:26
CONVO_LINK:0:9:27:28:29
CONVO_LINK:1:0:0:1:2
CONVO_LINK:1:1:1:2:3
CONVO_LINK:1:2:2:3:4
CONVO_LINK:1:3:3:4:5
CONVO_LINK:1:4:4:5:6
CONVO_LINK:1:5:5:6:7
CONVO_LINK:1:6:6:7:8
CONVO_LINK:1:7:7:8:9
CONVO_LINK:1:8:8:9:0
CONVO_LINK: 1:9:9:0:1
"""
)

TASK = """\
TYPE:LEARNSIM
BOTMODEL:BotType6
BOTNAME:T6-NEAT
MASTERSKILL:Avoid
LEARNINGSKILL:Avoid
ENV: EXP_Avoid

LEARNINGMETHOD: NEAT
ROOTFOLDER: Minds

NUMGEN:50
EVALREP:3
TICKLIM:100000
"""


def _motor(name, left, right):
    """A programmed base skill like moveForward."""
    python = name[0].upper() + name[1:]
    text = MOVE_FORWARD.replace("moveForward", name).replace("MoveForward", python)
    function = "".join(f"_{one.lower()}" if one.isupper() else one for one in name)
    return {
        f"Skills/{name}/{name}.ades": text,
        f"Skills/{name}/{python}.py": f"def {function}():\n    return {left}, {right}\n",
    }


def _go_to(name, sensor):
    return {
        f"Skills/{name}/{name}.ades": (
            f"{name}\ninput:1\nSE:{sensor}\noutput:2\nSK:Avoid\nSK:moveForward\nneural\nlayers:2\n"
        )
    }


_MOTORS = {
    **_motor("moveForward", 1.0, 1.0),
    **_motor("moveBackwards", 0.0, 0.0),
    **_motor("turnLeft", 0.0, 1.0),
    **_motor("turnRight", 1.0, 0.0),
}

COLLECTOR = {
    "T6.botdesc": (
        "SENSORS\n"
        + "".join(f"US_{number}:proxSensor\n" for number in range(1, 11))
        + "DOF:dof\nSENSOBJ:objSensor\nSENSDZ:zoneSensor\nORIENT:TargetSensor:1\n"
        + "ACTUATORS\nMotL:wheel\nMotR:wheel\nClaw:claw:0\n"
    ),
    "T6.vardesc": "VAR_SIN: TickWaveSinVariableModule\n",
    "Skills/Collect/Collect.ades": COLLECT,
    "Skills/Avoid/Avoid.ades": AVOID,
    "Skills/ClawControl/ClawControl.ades": (
        "ClawControl\ninput:1\nSE:SENSOBJ\noutput:1\nMO:Claw\nneural\nlayers:2\n"
    ),
    "Tasks/Avoid.simbatch": TASK,
    **_go_to("GTO+Avoid", "ORIENT"),
    **_go_to("GTDZ+Avoid", "SENSDZ"),
    **_MOTORS,
}
"""A mind with the three skills of figure A.1, and what they name."""

CONVOLUTIONAL = {
    "T6.botdesc": (
        "SENSORS\n"
        + "".join(f"S{number}:proxSensor\n" for number in range(1, 11))
        + "DOF:dof\nACTUATORS\nMotL:wheel\nMotR:wheel\n"
    ),
    "T6.vardesc": "VAR_TIME: TickWaveSinVariableModule\n",
    "Skills/Avoid/Avoid.ades": AVOID_CNN,
    **_MOTORS,
}
"""A mind with the skill of figure A.2."""
