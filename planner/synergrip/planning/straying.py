"""How far a motion strays: where it is wanted in directions in which no rigid motion of the hand goes by then."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.object_error import axis_weights
from synergrip.grasps.compliance import joint_compliance, total_compliance
from synergrip.linalg import Array, frozen
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each
from synergrip.statics.motion import forces_at_start

OF_ELASTIC = 0.1
"""Share of the elastic motion that its linear estimate may be off by."""


def strayed(walk: Walk, walker: Walker) -> Array:
    """Return how far (T,) the object is off the wanted motion, beyond what is elastic, where no rigid motion goes [m].

    What is left of the way outside of Gamma_ucs is elastic motion and sag, or wanted in vain. The first two follow from
    the forces: they strain the springs of contacts and joints by K^-1 (lambda - lambda_0), which a motion of synergies
    and object makes up for, J S dz - G' u, in one way but for Gamma_ucs.

    Args:
        walk: all of whose knots were reached.
        walker: whose task it is.
    """
    task, start, way = walker.task, walker.start, walk.way
    if way is None or task.target.kind == "hold" or task.tracking == "compliant":
        return np.zeros(len(task.times))
    seen = axis_weights(task.axes, start.response.scale.length)
    elastic = _elastic(way.each, start, walk.executed.states.forces - forces_at_start(start.response))
    directions = seen @ way.each.spaces.Gamma_ucs
    left = walk.executed.left(walker.wanted)
    whole, of_springs = (_outside(directions, each @ seen.T) for each in (left + elastic, elastic))
    return frozen(np.maximum(whole - OF_ELASTIC * of_springs, 0.0))


def _elastic(each: Each, start: Analysis, change: Array) -> Array:
    """Return displacements (T, 6) of the object that go with changes of the contact forces (T, n_l)."""
    grasp, there = start.grasp, each.grasp
    softness = total_compliance(grasp.C_s, there.J, joint_compliance(grasp.C_q, grasp.S, grasp.C_z))
    motions = np.concatenate([there.J @ grasp.S, -there.G.mT], axis=2)
    moved = np.linalg.pinv(motions, rcond=1e-12) @ softness @ change[:, :, None]
    return np.asarray(moved[:, grasp.n_z :, 0])


def _outside(directions: Array, vectors: Array) -> Array:
    """Return how much (T,) of vectors (T, m) lies outside the spans of directions (T, m, n)."""
    within = directions @ (np.linalg.pinv(directions, rcond=1e-12) @ vectors[:, :, None])
    return np.asarray(np.linalg.norm(vectors - within[:, :, 0], axis=1))
