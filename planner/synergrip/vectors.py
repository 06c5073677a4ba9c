"""Vectors of space in stacks."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array


def skews(vectors: Array) -> Array:
    """Return the skew matrices (..., 3, 3) of vectors (..., 3)."""
    x, y, z = np.moveaxis(vectors, -1, 0)
    found = np.zeros((*vectors.shape, 3))
    found[..., 0, 1], found[..., 0, 2], found[..., 1, 2] = -z, y, -x
    found[..., 1, 0], found[..., 2, 0], found[..., 2, 1] = z, -y, x
    return found


def crossed(left: Array, right: Array) -> Array:
    """Return the cross products (..., 3) of vectors (..., 3): for small stacks much sooner than `np.cross`."""
    left, right = np.broadcast_arrays(left, right)
    found = np.empty(left.shape)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        found[..., i] = left[..., j] * right[..., k] - left[..., k] * right[..., j]
    return found
