"""What a task lets go: joint ranges, and where the plan leaves them; a part of the motion within its tolerance."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.conic.limits.joint_range import JointRange
from synergrip.documents.quantities import SHOWN_IN, in_mm
from synergrip.grasps.grasp import Grasp
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import RIGID_TOLERANCE, undone, wish_size

LEFT = 1e-9
"""[rad], [m] beyond its range from which on a joint counts as outside."""


def ranges_left(task: TimedTask, grasp: Grasp, joint: Array) -> Iterator[str]:
    """Yield a note when a task lets the ranges of a hand go.

    Args:
        task: with or without such a limit.
        grasp: of the task.
        joint: (T, n_q) joint displacements from the start that the plan takes [rad or m].
    """
    ranges = [limit for limit in task.limits if isinstance(limit, JointRange)]
    if grasp.held is None or not ranges or not all(limit.lets_go for limit in ranges):
        return
    joints = grasp.held.hand.joints
    lower, upper = (np.array([getattr(each, end) for each in joints]) for end in ("lower", "upper"))
    value = grasp.held.q + joint
    beyond = np.maximum(lower - value, value - upper)
    told = "the joint ranges that the hand states are let go"
    if beyond.max(initial=-np.inf) > LEFT:
        k, i = np.unravel_index(int(beyond.argmax()), beyond.shape)
        factor, unit = SHOWN_IN[SI_UNITS[joints[i].kind]]
        told += (
            f": joint '{joints[i].name}' would leave its own by {factor * beyond[k, i]:.3g} {unit} at t = "
            f"{task.times[k]:.3g} s"
        )
    yield told


def undone_notes(analysis: Analysis, task: TimedTask) -> Iterator[str]:
    """Yield how much of the wanted motion the tolerance lets a plan leave undone, as none of the hand's."""
    left = undone(analysis, task)
    if left and left > RIGID_TOLERANCE * (wish := wish_size(analysis, task)):
        yield (
            f"up to {in_mm(left)} of the {in_mm(wish)} that are wanted (rotations times length) are left "
            f"undone: no rigid motion of the hand does them, and task.tolerance allows it"
        )
