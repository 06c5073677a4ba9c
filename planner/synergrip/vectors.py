"""Vectors of space in stacks."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]
_SKEW = np.array([
    [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
    [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
    [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
], dtype=float).reshape(3, 9)  # fmt: skip
"""The skew matrices of the axes: one product makes those of a stack, where entry by entry takes longer."""


def skews(vectors: Array) -> Array:
    """Return the skew matrices (..., 3, 3) of vectors (..., 3)."""
    return np.asarray(vectors @ _SKEW).reshape(*vectors.shape, 3)


def crossed(left: Array, right: Array) -> Array:
    """Return the cross products (..., 3) of vectors (..., 3): for small stacks much sooner than `np.cross`."""
    return np.asarray(left[..., _NEXT] * right[..., _LAST] - left[..., _LAST] * right[..., _NEXT])
