"""The plane: bodies that move, sense and act in an arena with obstacles (thesis, 5.1.4 and 5.3).

What each file says in its `__all__` is the package's.
"""

from socialmind.worlds.plane.bodies import *
from socialmind.worlds.plane.devices.actuators import *
from socialmind.worlds.plane.devices.device import *
from socialmind.worlds.plane.devices.interruptions import *
from socialmind.worlds.plane.devices.measures import *
from socialmind.worlds.plane.devices.rewards import *
from socialmind.worlds.plane.devices.sensors import *
from socialmind.worlds.plane.plane import *
