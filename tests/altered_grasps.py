"""Grasps and tasks with one number altered, written anew: for differences that judge derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen
from synergrip.margin.sensitivity.sensitivity import Sensitivity
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.tasks.timed_task import TimedTask

Question = tuple[Grasp, TimedTask]
COMPLIANCES = {"contact stiffness": "C_s", "joint stiffness": "C_q", "synergy stiffness": "C_z"}
AXES = {"along the normal": 0, "along t": 1, "along o": 2, "about t": 1, "about o": 2}


def altered(grasp: Grasp, task: TimedTask, by: Sensitivity, change: float) -> Question | None:
    """Return grasp and task with the number of a sensitivity altered, by a share, a length or an angle."""
    if change == 0.0:
        return grasp, task
    if by.name == "friction":
        names = [contact.name for contact in grasp.contacts if by.of in (contact.name, "all contacts")]
        rough = {each.name: each.kind.slippery(1 + change) for each in grasp.contacts if each.name in names}
        return grasp.replace(contact=rough), task
    if by.name == "load":
        return grasp, replace(task, wrench=frozen((1 + change) * task.wrench))
    if by.name in COMPLIANCES:
        return _stiffer(grasp, by, 1 + change), task
    if by.name == "normal":
        return _tilted(grasp, by, change), task
    if by.name == "position":
        return _shifted(grasp, by, change), task
    limits = tuple(
        _wider(limit, f"drift limit of {by.of}" if by.name == "drift limit" else by.name, 1 + change)
        for limit in task.limits
    )
    return None if limits == task.limits else (grasp, replace(task, limits=limits))


def largest_margin(grasp: Grasp, task: TimedTask) -> float:
    """Return the largest margin [N] in the linear model of the start posture; nan where there is none."""
    found = plan_of_start_posture(grasp, replace(task, goals=(LargestMargin(),), margin=0.0))
    return float(found.largest_margin) if isinstance(found, Plan) and found.largest_margin is not None else np.nan


def _stiffer(grasp: Grasp, by: Sensitivity, factor: float) -> Grasp:
    names = {"contact stiffness": [name for name, _ in grasp.components], "joint stiffness": grasp.joints}
    own = np.array([by.of in (name, *ALL) for name in names.get(by.name, grasp.synergies)])
    half = np.where(own, factor**-0.5, 1.0)
    field = COMPLIANCES[by.name]
    return grasp.replace(**{field: half[:, None] * getattr(grasp, field) * half})


ALL = ("all contacts", "all joints", "all synergies")


def _wider(limit: object, name: str, factor: float) -> object:
    names = {"torque": "torque limit", "effort": "effort limit", "rate": "rate limit",
             "acceleration": "acceleration limit", "synergy_range": "reference limit"}  # fmt: skip
    if isinstance(limit, NormalForce) and name == "force cap":
        return replace(limit, upper=factor * limit.upper)
    if isinstance(limit, NormalForce) and name == "least normal force":
        return replace(limit, lower=factor * limit.lower)
    if isinstance(limit, Symmetric) and names.get(limit.cause) == name:
        return replace(limit, limit=frozen(factor * np.asarray(limit.limit)))
    if isinstance(limit, ElasticMotion | ObjectError) and name == f"drift limit of {limit.key}":
        return replace(limit, limit=factor * limit.limit)
    if isinstance(limit, JointRange) and name == "joint range":
        return limit.loosened(factor - 1)
    return limit


def _place(grasp: Grasp, by: Sensitivity) -> tuple[int, Contact, Array]:
    index = [contact.name for contact in grasp.contacts].index(by.of)
    contact = grasp.contacts[index]
    return index, contact, contact.frame[:, AXES[by.direction]]


def _tilted(grasp: Grasp, by: Sensitivity, angle: float) -> Grasp:
    """The frame turned about an axis of its own; rows of J go by what they are components of."""
    index, contact, axis = _place(grasp, by)
    turn = Rotation.from_rotvec(angle * axis).as_matrix()
    new = replace(contact, frame=frozen(turn @ contact.frame))
    return _with(grasp, index, new, np.zeros(3))


def _shifted(grasp: Grasp, by: Sensitivity, length: float) -> Grasp:
    index, contact, axis = _place(grasp, by)
    return _with(grasp, index, replace(contact, point=frozen(contact.point + length * axis)), length * axis)


def _with(grasp: Grasp, index: int, contact: Contact, arm: Array) -> Grasp:
    """The hand's motion at a contact taken from its whole Jacobian, or from the three rows that matrices have."""
    contacts = tuple(contact if i == index else each for i, each in enumerate(grasp.contacts))
    old, rows, J = grasp.contacts[index], grasp.rows[index], np.array(grasp.J)
    start = None if grasp.lambda_0 is None else np.array(grasp.lambda_0)
    if grasp.held is None:
        J[rows] = contact.frame.T @ old.frame @ J[rows]
        if start is not None:
            start[rows] = contact.frame.T @ old.frame @ start[rows]
    else:
        touch, held = grasp.held.touches[index], grasp.held
        (motion,) = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point)])
        reach = contact.point + held.body.position - motion.position
        velocity = motion.jacobian[:3] + np.cross(motion.jacobian[3:].T, reach).T
        J[rows] = (np.vstack([contact.frame.T @ velocity, contact.frame.T @ motion.jacobian[3:]]))[: contact.n_rows]
    return replace(grasp, contacts=contacts, G=grasp_matrix(contacts), J=frozen(J), lambda_0=start)
