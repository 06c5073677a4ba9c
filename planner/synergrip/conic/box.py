"""How large the unknowns can be at all: a box that the limits imply, used to prove infeasibility.

A ray that is exact but for rounding proves nothing about unbounded unknowns. But no plan needs forces
a million times the load, and most limits bound the unknowns far below that.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.situation import Affine, Situation
from synergrip.linalg import Array, split

LARGEST = 1e6
"""In normalised units. The bound where no limit gives a smaller one, and part of the program's meaning."""


def box(situation: Situation, limits: Sequence[Limit]) -> Array:
    """Return bounds (n_v,) on |v_k| that hold for every v that keeps all the limits."""
    result = np.full(situation.n_v, LARGEST)
    held = any(isinstance(limit, FrictionCone) and limit.margin >= 0 for limit in limits)
    for limit in limits:
        if isinstance(limit, NormalForce):
            if held and np.isfinite(limit.upper):
                result = np.minimum(result, _implied(situation.force, force_bounds(situation, limit.upper)))
        elif (pair := limit.bounded(situation)) is not None:
            result = np.minimum(result, _implied(*pair))
    return result


def force_bounds(situation: Situation, upper: float) -> Array:
    """Return (n_l,) bounds on |lambda| from a largest normal force and the friction cones."""
    bounds = []
    for contact in situation.response.grasp.contacts:
        sizes = np.diag(contact.cone)  # mu, 1, 1, mu / nu: the cone is ||rest|| <= mu n
        bounds += [upper, *(sizes[0] * upper / sizes[1:])]
    return np.array(bounds)


def _implied(value: Affine, limit: Array) -> Array:
    """Return bounds on |v| from ``|matrix v + constant| <= limit``; `LARGEST` where the matrix leaves v free."""
    rows = np.isfinite(limit)
    matrix, room = value.matrix[rows], limit[rows] + np.abs(value.constant[:, rows]).max(axis=0, initial=0.0)
    bounds = np.full(value.matrix.shape[1], LARGEST)
    if not matrix.size:
        return bounds
    normed = matrix / np.where(room > 0, room, 1.0)[:, None]
    fixed = np.linalg.norm(split(normed).null_space, axis=1) < 1e-9  # entries that the matrix determines
    bounds[fixed] = np.abs(np.linalg.pinv(matrix, rcond=1e-9)[fixed]) @ room
    return bounds
