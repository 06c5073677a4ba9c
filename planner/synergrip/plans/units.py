"""Sizes that bring the unknowns of a task near 1 before solving; they change no answer."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.situation import Units
from synergrip.plans.analysis import Analysis
from synergrip.plans.task import Task
from synergrip.statics.motion import forces_at_start


def units_of(analysis: Analysis, task: Task) -> Units:
    """Return the force unit (the load, as the contacts feel it), the reference unit and the motion unit of a task."""
    response = analysis.response
    change = (task.wrench - analysis.grasp.w_0) @ response.right_inverse.T
    load = response.scale.largest_force(forces_at_start(response) - change)
    force = max(load, task.margin)
    reference = 1.0
    for limit in task.limits:
        if isinstance(limit, NormalForce) and np.isfinite(limit.upper) and task.goal == "margin":
            force = max(force, limit.upper)
        elif isinstance(limit, SynergyReference) and np.any(np.isfinite(limit.limit)):
            reference = float(np.max(limit.limit[np.isfinite(limit.limit)]))
    # objects are moved by millimetres; in metres, tight tolerances drown the free part of the rigid motion
    motion = max(task.tolerance, 1e-6) if task.tolerance > 0 else 1e-3
    return Units(force if force > 0 else _of_limits(analysis, task), reference, motion)


def _of_limits(analysis: Analysis, task: Task) -> float:
    """Return a force unit for a task without load and margin: the smallest force that a limit speaks of, else 1 N."""
    sizes = [1.0]
    for limit in task.limits:
        if isinstance(limit, NormalForce) and np.isfinite(limit.upper):
            sizes.append(limit.upper)
        elif isinstance(limit, JointTorque) and np.any(np.isfinite(limit.limit)):
            sizes.append(float(np.min(limit.limit)) / analysis.response.scale.length)
    return min(sizes)
