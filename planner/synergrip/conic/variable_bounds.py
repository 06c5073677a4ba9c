"""How large the unknowns can be at all: a box that the limits imply, used to prove infeasibility.

A ray that is exact but for rounding proves nothing about unbounded unknowns. But most limits bound them, and where
none does, no plan needs forces a million times those that the task asks for, over its friction where that is small.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.friction_cone import FrictionCone, least_cone_unit
from synergrip.conic.limits.limit import Limit
from synergrip.linalg import CLEAR, Array, gram, null_spaces

LARGEST = 1e6
"""In normalised units. The bound where no limit gives one, and part of the program's meaning."""

FARTHEST = 1e12
"""A limit that is farther away than this is none, but the rounding of what it looks at."""


def variable_bounds(formulation: Formulation, limits: Sequence[Limit]) -> Array:
    """Return bounds (n_v,), or (T, n_v), on |v_k| that hold for every v that keeps all the limits."""
    result = np.full(formulation.n_v, np.inf)
    cones_hold = any(isinstance(limit, FrictionCone) and limit.margin >= 0 for limit in limits)
    for limit in limits:
        pair = limit.bounded(formulation, cones_hold=cones_hold)
        if pair is not None:
            result = np.minimum(result, _implied(*pair))
    return np.where(result < FARTHEST, result, farthest(formulation))


def farthest(formulation: Formulation) -> float:
    """Return the bound where no limit gives one: `LARGEST`, over the least friction where that is small."""
    return LARGEST / least_cone_unit(formulation.response.grasp.contacts)


def _implied(value: Affine, limit: Array) -> Array:
    """Return bounds on |v| from ``|matrix v + constant| <= limit``; infinite where the matrix leaves v free.

    They are (n_v,) for one matrix, (T, n_v) for one at each knot.
    """
    rows = np.isfinite(limit)
    room = limit[rows] + np.abs(value.constant[:, rows]).max(axis=0, initial=0.0)
    matrices = value.matrix[..., rows, :]
    if not matrices.size:
        return np.full(value.matrix.shape[-1], np.inf)
    if matrices.ndim > 2 and (inverses := _clear_inverses(matrices)) is not None:
        return np.asarray(np.abs(inverses) @ room)
    normed = matrices / np.where(room > 0, room, 1.0)[:, None]
    fixed = np.linalg.norm(null_spaces(normed), axis=-1) < 1e-9  # entries that the matrix determines
    return np.where(fixed, np.abs(np.linalg.pinv(matrices, rcond=1e-9)) @ room, np.inf)


def _clear_inverses(matrices: Array) -> Array | None:
    """Return the pseudo-inverses (T, n, m) of matrices (T, m, n) with columns far from dependent, by their squares.

    Of one for each knot that is several times as fast as singular values; None where columns are not that far.
    """
    values, vectors = np.linalg.eigh(gram(matrices))
    if not np.all(values[:, :1] > CLEAR**2 * values[:, -1:]):
        return None
    return np.asarray((vectors / values[:, None]) @ vectors.mT @ matrices.mT)
