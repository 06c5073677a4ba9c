"""How far a motion strays: where it is wanted in directions in which no rigid motion of the hand goes by then."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.object_error import axis_weights
from synergrip.linalg import Array, frozen
from synergrip.planning.walk import Walk, Walker
from synergrip.statics.analysis import Analysis
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
    before, found = forces_at_start(start.response), []
    for at, left, forces in zip(way.each, walk.executed.left(walker.wanted), walk.executed.states.forces, strict=True):
        elastic = _elastic(at, forces - before)
        whole, of_springs = (_outside(seen @ at.spaces.Gamma_ucs, seen @ each) for each in (left + elastic, elastic))
        found.append(max(whole - OF_ELASTIC * of_springs, 0.0))
    return frozen(found)


def _elastic(at: Analysis, change: Array) -> Array:
    """Return a displacement (6,) of the object that goes with a change of the contact forces (n_l,)."""
    grasp = at.response.grasp
    strain = (grasp.C_s + grasp.J @ (grasp.C_q + grasp.S @ grasp.C_z @ grasp.S.T) @ grasp.J.T) @ change
    moved = np.linalg.lstsq(np.hstack([grasp.J @ grasp.S, -grasp.G.T]), strain, rcond=1e-12)[0]
    return np.asarray(moved[grasp.n_z :])


def _outside(directions: Array, vector: Array) -> float:
    """Return how much of a vector lies outside the span of directions."""
    return float(np.linalg.norm(vector - directions @ np.linalg.lstsq(directions, vector, rcond=1e-12)[0]))
