"""Tracking around a path: what is left to go at every knot, and which rigid motion of that knot goes it.

Near a singular posture (a straight finger, say) the rigid motion that is asked for takes joint motions without end.
There it is asked for in part only, as damped least squares have it, so that a step of the planner stays a small one;
what is left of the way is told, and is zero wherever the hand can follow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.limits.object_error import AXES, axis_weights
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.kept_dimensions import turned
from synergrip.statics.theorem1 import motion_coordinates
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import followed_axes


@dataclass(frozen=True)
class Steps:
    """What the way that is left says about the rigid motion at every knot."""

    each: tuple[Analysis, ...]
    """(T,) the grasp at every knot; beta of those directions that the program may choose comes first."""
    beta: Array  # (T, dim Gamma_ucs) [m]
    basis: Array
    """(dim Gamma_ucs, m) orthonormal directions in which beta is the program's choice."""
    joints: Array
    """(T,) how far the joints move for beta alone, rotations and translations (over the length) together."""
    beside: Array
    """(T, 6) the part of the way left that no rigid motion of the knot goes [m, rad]."""


def steps(each: Sequence[Analysis], start: Analysis, task: TimedTask, left: Array, damping: float) -> Steps:
    """Return the rigid motion at every knot that goes what is left of the way.

    Args:
        each: (T,) the grasp along the path.
        start: the grasp at the start.
        task: says what is tracked, and on which axes.
        left: (T, 6) twist from where the object is to where it is wanted [m, rad].
        damping: [m/rad] joint motions are as dear as this much of the way; 0 to go all of it whatever it takes.
    """
    dimension = start.spaces.Gamma_ucs.shape[1]
    reached = [motion_coordinates(at.response, at.spaces, way) for at, way in zip(each, left, strict=True)]
    beside = np.array([outside for _, outside in reached])
    beta, basis = np.array([own for own, _ in reached]).reshape(len(left), dimension), np.zeros((dimension, 0))
    if task.tracking == "compliant":
        beta, basis = np.zeros_like(beta), np.eye(dimension)
    elif len(task.axes) < len(AXES):
        seen = axis_weights(task.axes, start.response.scale.length)
        free = followed_axes(start, task)[1].shape[1]
        each, basis = [turned(at, seen, free) for at in each], np.eye(dimension)[:, :free]
        beta = np.array([_seen(at, seen, way, free) for at, way in zip(each, left, strict=True)])
    costs = [_joints_of(at) for at in each]
    damped = [
        np.linalg.solve(np.eye(dimension) + damping**2 * N.T @ N, own) for N, own in zip(costs, beta, strict=True)
    ]
    joints = [float(np.linalg.norm(N @ own)) for N, own in zip(costs, damped, strict=True)]
    return Steps(
        tuple(each), frozen(np.array(damped).reshape(beta.shape)), frozen(basis), frozen(joints), frozen(beside)
    )


def _seen(at: Analysis, seen: Array, way: Array, free: int) -> Array:
    """Return the least beta, along what is not free, that goes a way (6,) as far as it is seen."""
    motions = (seen @ at.spaces.Gamma_ucs)[:, free:]
    return np.concatenate([np.zeros(free), np.linalg.lstsq(motions, seen @ way, rcond=None)[0]])


def _joints_of(at: Analysis) -> Array:
    """Return how the joints move with beta (n_q, dim Gamma_ucs) [rad/m]."""
    forces, motions, _ = at.coordinates.dimensions
    return np.asarray(at.response.dq_dzr @ at.coordinates.inverse[:, forces : forces + motions])
