"""Sizes of forces, references and motions in a task: those in which weights are stated, and those of its unknowns.

The second kind changes no answer. It is taken from what a plan cannot do without: the load, the margin, the least
normal force, the forces that a wanted motion takes. A largest force that does not bind says nothing about them. What
only the answer shows, solving again in its units takes care of (`plans/solvers.py`).
"""

from __future__ import annotations

import numpy as np

from synergrip.conic.formulation import Formulation, Units
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.linalg import Array, split
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import forces_at_start
from synergrip.tasks.timed_task import TimedTask


def units_of(analysis: Analysis, task: TimedTask) -> Units:
    """Return the units in which the weights of a task are stated: of force, references and motion."""
    return _stated(analysis, task, _asked(analysis, task))


def _stated(analysis: Analysis, task: TimedTask, force: float) -> Units:
    reference = 1.0
    for limit in task.limits:
        if isinstance(limit, SynergyReference) and np.any(np.isfinite(limit.limit)):
            reference = float(np.max(limit.limit[np.isfinite(limit.limit)]))
    return Units(force if force > 0 else smallest_cap(analysis, task), reference, _motion(task))


def expected_and_stated(
    analysis: Analysis, task: TimedTask, beta: Array, target: Array, known: float = 0.0
) -> tuple[Units, Units]:
    """Return the sizes near which the unknowns of a task are expected, and the units in which its weights are stated.

    Args:
        analysis: of the grasp.
        task: its loads and limits.
        beta: (T, dim Gamma_ucs) the rigid motion as far as it is given [m].
        target: (T, 6) wanted displacement of the object [m, rad].
        known: [N] forces that there are whatever is asked, and beside which the unknowns must not drown.
    """
    least = max((limit.lower for limit in task.limits if isinstance(limit, NormalForce)), default=0.0)
    asked = _asked(analysis, task)
    force = max(asked, least, _of_motion(analysis, task, target), known)
    if not force > 0:
        force = smallest_cap(analysis, task)
    of_forces, of_motions = analysis.coordinates.reach
    moving = np.abs(beta).max(axis=0, initial=0.0)
    if task.tracking == "compliant":
        farthest = np.linalg.norm(analysis.response.scale.twist(target), axis=1).max(initial=0.0)
        moving = np.full(of_motions.shape[1], farthest)
    reference = float((force * of_forces + of_motions @ moving).max(initial=0.0))
    expected = Units(force, reference if reference > 0 else 1.0, _motion(task))
    return expected, _stated(analysis, task, asked)


def smallest_cap(analysis: Analysis, task: TimedTask) -> float:
    """Return the smallest force that a limit of a task allows at most [N]; 1 N when none allows less."""
    return min([1.0, *_caps(analysis, task)])


def caps(analysis: Analysis, task: TimedTask) -> tuple[float, ...]:
    """Return the forces [N] that the limits of a task allow at most, the smallest first."""
    return tuple(sorted(set(_caps(analysis, task))))


def grips(formulation: Formulation) -> tuple[float, ...]:
    """Return the squeeze [N] that the least friction takes to hold what the task asks; none when that is no more."""
    least = formulation.response.grasp.least_cone_unit
    return (formulation.load_size / least,) if least < 1.0 else ()


def _caps(analysis: Analysis, task: TimedTask) -> list[float]:
    length, response = analysis.response.scale.length, analysis.response
    found: list[float] = []
    for limit in task.limits:
        if isinstance(limit, NormalForce):
            found.append(limit.upper)
        elif isinstance(limit, JointTorque | ActuatorEffort):
            found.append(float(np.min(limit.limit)) / length)
        elif isinstance(limit, SynergyReference):
            forces = np.abs(response.scale.force[:, None] * response.dlambda_dzr)
            found.append(float((forces * np.where(forces > 0, limit.limit, 0.0)).max(initial=0.0)))
    return [size for size in found if 0 < size < np.inf]


def _asked(analysis: Analysis, task: TimedTask) -> float:
    """Return the largest contact force that the load causes by itself, or the margin [N]; moments over the length."""
    response = analysis.response
    change = (task.wrench - analysis.grasp.w_0) @ response.dlambda_dw.T
    return max(response.scale.largest_force(forces_at_start(response) + change), task.margin)


def _of_motion(analysis: Analysis, task: TimedTask, target: Array) -> float:
    """Return the largest contact force [N] that compliant tracking takes because the motion leaves Gamma_ucs."""
    response, spaces, scale = analysis.response, analysis.spaces, analysis.response.scale
    n_alpha = spaces.E_s.shape[1]
    if task.tracking != "compliant" or not n_alpha:
        return 0.0
    sag = (task.wrench - analysis.grasp.w_0) @ response.du_dw.T
    missing = scale.twist(target - sag)
    rigid = scale.motion @ spaces.Gamma_ucs  # orthonormal columns
    missing = missing - missing @ rigid @ rigid.T
    if not np.linalg.norm(missing, axis=1).max(initial=0.0) > task.tolerance:
        return 0.0
    whole = scale.motion @ response.du_dzr @ analysis.coordinates.inverse[:, :n_alpha]
    elastic = split((whole - rigid @ (rigid.T @ whole)).T, float(np.linalg.norm(whole, 2)))
    if not elastic.decision.rank:
        return 0.0
    made = elastic.row_space.T @ whole  # by alpha, in the directions that it moves the object in
    alpha = missing @ elastic.row_space @ np.linalg.pinv(made).T
    stiffest = float(np.linalg.norm(scale.force[:, None] * response.K * scale.force, 2))
    return min(scale.largest_force(alpha @ spaces.E_s.T), stiffest * float(np.abs(missing).max()))


def _motion(task: TimedTask) -> float:
    # objects are moved by millimetres; in metres, tight tolerances drown the free part of the rigid motion
    return task.tolerance if task.tolerance > 0 else 1e-3
