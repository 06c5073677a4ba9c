"""Tracking around a path: what is left to go at every knot, and which rigid motion of that knot goes it.

Near a singular posture (a straight finger, say) the rigid motion that is asked for takes joint motions without end.
There it is asked for in part only, as damped least squares have it, so that a step of the planner stays a small one;
what is left of the way is told, and is zero wherever the hand can follow.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.conic.limits.object_error import AXES, axis_weights
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each
from synergrip.statics.kept_dimensions import turned
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import followed_axes
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Steps(Value):
    """What the way that is left says about the rigid motion at every knot."""

    each: Each
    """(T) the grasp at every knot; beta of those directions that the program may choose comes first."""
    beta: Array  # (T, dim Gamma_ucs) that goes all of it [m]
    basis: Array
    """(dim Gamma_ucs, m) orthonormal directions in which beta is the program's choice."""
    beside: Array
    """(T, 6) the part of the way left that no rigid motion of the knot goes [m, rad]."""

    @cached_property
    def behind(self) -> Array:
        """(T,) how far the object is behind, as far as rigid motions could bring it nearer [m]."""
        return np.asarray(np.linalg.norm(self.beta, axis=1))

    def damped(self, damping: float) -> tuple[Array, Array]:
        """Return beta (T, dim Gamma_ucs) [m] that is not dear, and how far (T,) the joints move for it.

        Args:
            damping: [m/rad] joint motions are as dear as this much of the way.
        """
        joints = joints_of(self.each)
        stiff = np.eye(self.beta.shape[1]) + damping**2 * joints.mT @ joints
        damped = np.linalg.solve(stiff, self.beta[:, :, None])
        return frozen(damped[:, :, 0]), frozen(np.linalg.norm((joints @ damped)[:, :, 0], axis=1))


def steps(each: Each, start: Analysis, task: TimedTask, left: Array) -> Steps:
    """Return the rigid motion at every knot that goes what is left of the way.

    Args:
        each: (T) the grasp along the path.
        start: the grasp at the start.
        task: says what is tracked, and on which axes.
        left: (T, 6) twist from where the object is to where it is wanted [m, rad].
    """
    dimension = start.spaces.Gamma_ucs.shape[1]
    beta, beside = each.split(left)
    basis = np.zeros((dimension, 0))
    if task.tracking == "compliant":
        beta, basis = np.zeros_like(beta), np.eye(dimension)
    elif len(task.axes) < len(AXES):
        seen = axis_weights(task.axes, start.response.scale.length)
        free = followed_axes(start, task)[1].shape[1]
        each, basis = turned(each, seen, free), np.eye(dimension)[:, :free]
        motions = (seen @ each.spaces.Gamma_ucs)[:, :, free:]  # the least beta, along what is not free, that is seen
        own = (np.linalg.pinv(motions) @ (left @ seen.T)[:, :, None])[:, :, 0]
        beta = np.hstack([np.zeros((len(left), free)), own])
    return Steps(each, frozen(beta), frozen(basis), frozen(beside))


def joints_of(at: Each | Analysis) -> Array:
    """Return how the joints move with beta, (n_q, dim Gamma_ucs) or (T, n_q, dim Gamma_ucs) at each knot [rad/m]."""
    forces, motions, _ = at.coordinates.dimensions
    return np.asarray(at.response.dq_dzr @ at.coordinates.inverse[..., forces : forces + motions])
