"""The loads and targets that ship with the package. A new one is listed here."""

from __future__ import annotations

from synergrip.tasks.gravity import Gravity
from synergrip.tasks.hold import Hold
from synergrip.tasks.motion_tables import ModesTable, MotionTable
from synergrip.tasks.moves import ModeMove, Move, Moves
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.pushes import Push
from synergrip.tasks.stated import Load, Motion
from synergrip.tasks.waypoints import Waypoints
from synergrip.tasks.wrenches import Wrench, WrenchTable

LOADS: tuple[type[Load], ...] = (Gravity, Wrench, WrenchTable, Push, Palm, PalmPath)
TARGETS: tuple[type[Motion], ...] = (Hold, Move, ModeMove, Moves, Waypoints, MotionTable, ModesTable)
