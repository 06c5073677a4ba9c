"""Refusals re-verified: the free twist, the count and the direction, each from the grasp's own matrices."""

from __future__ import annotations

import numpy as np

from synergrip.conic.certificate import Certificate
from synergrip.conic.limits.object_error import AXES
from synergrip.errors import MotionCountError, MotionDirectionError, NotRestrainedError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale, scale_of
from synergrip.linalg import RANK_TOLERANCE, Array
from synergrip.planning.free import needs_free
from synergrip.statics.analysis import Analysis
from synergrip.tasks.control import Control, ControlError, outside
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import RIGID_TOLERANCE, apart_by


def refusal_certificate(task: TimedTask, analysis: Analysis, refusal: Refusal) -> Certificate:
    """Return the verified proof behind a refusal; not verified when the numbers do not bear it out."""
    grasp = analysis.grasp
    scale = scale_of(grasp)
    if isinstance(refusal, NotRestrainedError):
        needed = needs_free(analysis, task, refusal.free_twists)
        return _free(grasp, scale, refusal.free_twists, needed=needed)
    if isinstance(refusal, MotionCountError):
        wish = scale.twist(task.target.values)
        size = float(np.linalg.norm(wish, axis=1).max(initial=0.0))
        counts = apart_by(wish, refusal.asked) > max(RIGID_TOLERANCE * size, task.tolerance)
        ratio = apart_by(wish, refusal.asked) / max(size, 1e-300)
        return Certificate("infeasible", bool(counts and refusal.asked > grasp.n_z), 0.0, 0.0, -ratio)
    if isinstance(refusal, MotionDirectionError):
        return _outside(task, analysis, scale, refusal)
    if isinstance(refusal, ControlError) and task.control is not None:
        return _uncontrolled(task.control, analysis, refusal)
    return Certificate("none", False)


def _uncontrolled(control: Control, analysis: Analysis, refusal: ControlError) -> Certificate:
    """Verify that more directions are asked for than there are, by the dimensions that add up to n_z (34)."""
    forces, motions, redundant = analysis.spaces.dimensions
    adds_up = forces + motions + redundant == analysis.grasp.n_z
    if refusal.stage == "count":
        short = control.asked > analysis.grasp.n_z
    else:
        short = control.forces > forces or control.reconfiguration > redundant
        short = short or bool(outside(analysis, control.motions))
    return Certificate("infeasible", bool(adds_up and short), 0.0, 0.0, -1.0)


def _free(grasp: Grasp, scale: Scale, twists: Array, *, needed: bool) -> Certificate:
    """Verify that the twists move no contact although they move the object, and that the task needs them held."""
    moved = grasp.G.T @ twists / scale.force[:, None]
    size = float(np.linalg.norm(grasp.G.T @ np.linalg.inv(scale.motion) / scale.force[:, None], 2))
    leak = float(np.abs(moved).max(initial=0.0)) / max(size, 1e-300)
    lengths = np.linalg.norm(scale.twist(twists.T), axis=1)
    free = leak <= 10 * RANK_TOLERANCE and np.all(lengths > 0.5)
    return Certificate("infeasible", bool(free and needed), leak, 0.0, -1.0)


def _outside(task: TimedTask, analysis: Analysis, scale: Scale, refusal: MotionDirectionError) -> Certificate:
    """Verify that a direction is orthogonal to what the synergies can move rigidly, and that the wish has a part in it.

    Every rigid motion u of the object that the synergies follow has ``G'u`` in the range of J S. The direction
    separates: it is orthogonal to all of them, not to the wish.
    """
    direction = scale.twist(refusal.residual)
    direction = direction / np.linalg.norm(direction)
    leak = float(np.abs(direction @ scale.motion @ analysis.spaces.Gamma_ucs).max(initial=0.0))
    wish = scale.twist(np.where(np.isin(AXES, task.axes), task.target.values, 0.0))
    reach = float(np.abs(wish @ direction).max())
    size = float(np.linalg.norm(wish, axis=1).max())
    counts = reach * (1 + RANK_TOLERANCE) > max(RIGID_TOLERANCE * size, task.tolerance)
    return Certificate("infeasible", bool(leak <= RANK_TOLERANCE and counts), leak, 0.0, -reach / size)
