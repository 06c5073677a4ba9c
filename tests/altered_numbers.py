"""The numbers of a task that tests alter: each by a factor, written down without the planner's dials."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.tasks.timed_task import TimedTask

BOUNDS: dict[str, type[Any]] = {
    "torque": JointTorque, "effort": ActuatorEffort, "synergy_range": SynergyReference, "rate": SynergyRate,
    "acceleration": SynergyAcceleration, "drift": ObjectError, "elastic": ElasticMotion,
}  # fmt: skip
"""Number -> the limit whose bounds it multiplies; "elastic" is a second kind of drift."""
DOWN = ("margin", "load", "amplitude", "floor")
"""Numbers that leave more room when they are smaller."""
CAUSES = {"elastic": "drift", "floor": "force_cap"}
"""Number -> what the planner calls it, where that is another word."""


def size(factor: float) -> float:
    """Return how large a change by a factor is."""
    return abs(float(np.log(factor))) if factor > 0 else np.inf


def turned(grasp: Grasp, task: TimedTask, number: str, factor: float) -> tuple[Grasp, TimedTask]:
    """Return the same task with one of its numbers multiplied by a factor."""
    if number == "friction":
        kinds = {contact.name: contact.kind.slippery(factor) for contact in grasp.contacts}
        return grasp.replace(contact=kinds), task
    if number == "load":
        return grasp, replace(task, wrench=frozen(factor * task.wrench))
    if number == "amplitude":
        return grasp, replace(task, target=replace(task.target, values=frozen(factor * task.target.values)))
    if number in ("margin", "tolerance"):
        return grasp, replace(task, **{number: factor * getattr(task, number)})
    return grasp, replace(task, limits=tuple(_turned(limit, number, factor) for limit in task.limits))


def _turned(limit: Limit, number: str, factor: float) -> Limit:
    if isinstance(limit, NormalForce) and number in ("force_cap", "floor"):
        end = "upper" if number == "force_cap" else "lower"
        return replace(limit, **{end: factor * getattr(limit, end)})
    if isinstance(limit, JointRange) and number == "joint_range":
        more = (factor - 1) * (limit.upper - limit.lower) / 2
        return replace(limit, lower=limit.lower - more, upper=limit.upper + more)
    kind = BOUNDS.get(number)
    return replace(limit, limit=factor * limit.limit) if kind and isinstance(limit, kind) else limit
