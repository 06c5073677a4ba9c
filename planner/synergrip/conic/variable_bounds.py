"""How large the unknowns can be at all: a box that the limits imply, used to prove infeasibility.

A ray that is exact but for rounding proves nothing about unbounded unknowns. But most limits bound them, and where
none does, no plan needs forces a million times those that the task asks for, over its friction where that is small.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.affine import Affine
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.limit import Limit
from synergrip.linalg import Array, Places, gram, null_spaces

LARGEST = 1e6
"""In normalised units. The bound where no limit gives one, and part of the program's meaning."""

FARTHEST = 1e12
"""A limit that is farther away than this is none, but the rounding of what it looks at."""

NEAR = 1e3
"""In normalised units. A box of this size is small enough to prove with: no other limit is asked for a smaller one."""

FAR_FROM_DEPENDENT = 1e5
"""Ratio of the eigenvalues of the squares of a matrix up to which its columns are."""


def variable_bounds(formulation: Formulation, limits: Sequence[Limit], knots: Places | None = None) -> Array:
    """Return bounds (n_v,), or (T, n_v), on |v_k| that hold for every v that keeps all the limits; at some `knots`."""
    result = np.full(formulation.n_v, np.inf)
    cones_hold = any(isinstance(limit, FrictionCone) and limit.margin >= 0 for limit in limits)
    for limit in limits:
        pair = limit.bounded(formulation, cones_hold=cones_hold)
        if pair is not None:
            value, most = pair
            result = np.minimum(result, _implied(value if knots is None else value.at_knots(knots), most))
            if np.all(result <= NEAR):
                break
    return np.where(result < FARTHEST, result, farthest(formulation))


def farthest(formulation: Formulation) -> float:
    """Return the bound where no limit gives one: `LARGEST`, over the least friction where that is small."""
    return LARGEST / formulation.response.grasp.least_cone_unit


def _implied(value: Affine, limit: Array) -> Array:
    """Return bounds on |v| from ``|matrix v + constant| <= limit``; infinite where the matrix leaves v free.

    They are (n_v,) for one matrix, (T, n_v) for one at each knot.
    """
    rows = np.isfinite(limit)
    room = limit[rows] + np.abs(value.constant[:, rows]).max(axis=0, initial=0.0)
    matrices = value.matrix[..., rows, :] if not rows.all() else value.matrix
    if not matrices.size:
        return np.full(value.matrix.shape[-1], np.inf)
    each = matrices.reshape(-1, *matrices.shape[-2:])
    inverses, clear = _by_squares(each)
    result = np.abs(inverses) @ room
    if not clear.all():
        result[~clear] = _by_singular_values(each[~clear], room)
    return np.asarray(result if matrices.ndim > 2 else result[0])


def _by_singular_values(matrices: Array, room: Array) -> Array:
    normed = matrices / np.where(room > 0, room, 1.0)[:, None]
    fixed = np.linalg.norm(null_spaces(normed), axis=-1) < 1e-9  # entries that the matrix determines
    return np.where(fixed, np.abs(np.linalg.pinv(matrices, rcond=1e-9)) @ room, np.inf)


def _by_squares(matrices: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return the pseudo-inverses (T, n, m) of matrices (T, m, n) by their squares, and where these do.

    That is where columns are far from dependent; it is several times as fast as singular values. The ratio of the
    eigenvalues is at most the product of the sizes of the squares and of their inverse.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # in tiny units squares are beyond all numbers: not clear
        squares = gram(matrices)
        try:
            inverses = np.linalg.inv(squares)
        except np.linalg.LinAlgError:  # of one of them or more
            return np.zeros(matrices.mT.shape), np.zeros(len(matrices), dtype=bool)
        ratio = (squares**2).sum(axis=(-2, -1)) * (inverses**2).sum(axis=(-2, -1))
        return inverses @ matrices.mT, np.asarray(ratio < FAR_FROM_DEPENDENT**2)
