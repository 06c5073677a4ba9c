"""Vectors of space in stacks, and cubics between vectors."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array, frozen

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]
_SKEW = np.array([
    [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
    [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
    [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
], dtype=float).reshape(3, 9)  # fmt: skip
"""The skew matrices of the axes: one product makes those of a stack, where entry by entry takes longer."""

_SINES_AND_COSINE = np.column_stack([_SKEW.T / 2, np.eye(3).reshape(9) / 2])
"""What a rotation matrix, as nine numbers, is multiplied with: axis times sine of the angle, and cosine plus a half."""
FAR_ROUND = -0.5
"""Cosine of an angle from which on its sine tells too little of the axis."""


def skews(vectors: Array) -> Array:
    """Return the skew matrices (..., 3, 3) of vectors (..., 3)."""
    return np.asarray(vectors @ _SKEW).reshape(*vectors.shape, 3)


def lengths_of(vectors: Array) -> Array:
    """Return the lengths (...) of vectors (..., 3): for small stacks much sooner than `np.linalg.norm`."""
    return np.asarray(np.sqrt(np.einsum("...i,...i->...", vectors, vectors)))


def rotation_vectors(rotations: Array) -> Array:
    """Return rotation vectors (..., 3) of rotation matrices (..., 3, 3)."""
    parts = rotations.reshape(*rotations.shape[:-2], 9) @ _SINES_AND_COSINE
    sines, cosine = parts[..., :3], parts[..., 3] - 0.5
    sine = lengths_of(sines)
    found = sines * (np.arctan2(sine, cosine) / np.where(sine > 0, sine, 1.0) + (sine == 0))[..., None]
    if np.any(far := cosine < FAR_ROUND):
        found[far] = _vectors_of(_quaternions(rotations[far]))
    return np.asarray(found)


def rotation_matrices(vectors: Array) -> Array:
    """Return the rotation matrices (..., 3, 3) of rotation vectors (..., 3), by Rodrigues' formula."""
    angle = lengths_of(vectors)[..., None, None] / np.pi  # sinc(x) is sin(pi x) / (pi x)
    K = skews(vectors)
    return np.asarray(np.eye(3) + np.sinc(angle) * K + np.sinc(angle / 2) ** 2 / 2 * (K @ K))


def quaternions(rotations: Array) -> Array:
    """Return rotation matrices (T, 3, 3) as quaternions (T, 4), w first and never negative."""
    return frozen(_quaternions(rotations))


def _quaternions(rotations: Array) -> Array:
    """Return quaternions (T, 4), w first and never negative: the row of ``4 q q'`` whose own entry is the largest."""
    R, trace = rotations, np.trace(rotations, axis1=1, axis2=2)
    squares = np.column_stack([trace, *(R[:, i, i] for i in range(3))])
    products = np.empty((len(R), 4, 4))
    products[:, 0, 0] = 1 + trace
    for i in range(3):
        j, k = _NEXT[i], _LAST[i]
        products[:, i + 1, i + 1] = 1 + 2 * R[:, i, i] - trace
        products[:, 0, i + 1] = products[:, i + 1, 0] = R[:, k, j] - R[:, j, k]
        products[:, j + 1, k + 1] = products[:, k + 1, j + 1] = R[:, k, j] + R[:, j, k]
    found = products[np.arange(len(R)), squares.argmax(axis=1)]
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    return np.asarray(np.where(found[:, :1] < 0, -found, found))


def _vectors_of(quaternions: Array) -> Array:
    """Return rotation vectors (T, 3) of quaternions (T, 4) that turn by more than nothing, w first, never negative."""
    sine = lengths_of(quaternions[:, 1:])
    return np.asarray(quaternions[:, 1:] * (2 * np.arctan2(sine, quaternions[:, 0]) / sine)[:, None])


def times(matrices: Array, vectors: Array) -> Array:
    """Return matrices (..., 3, 3) times vectors (..., 3)."""
    return np.asarray((matrices @ vectors[..., None])[..., 0])


def crossed(left: Array, right: Array) -> Array:
    """Return the cross products (..., 3) of vectors (..., 3): for small stacks much sooner than `np.cross`."""
    return np.asarray(left[..., _NEXT] * right[..., _LAST] - left[..., _LAST] * right[..., _NEXT])


def off_chord(share: Array, chord: Array, leaving: Array, arriving: Array) -> Array:
    """Return how far Hermite's cubics (M, m) are off the chords from one value to the next.

    Args:
        share: (M, 1) how far along each it is, from 0 to 1.
        chord: (M, m) from the value before to the one after.
        leaving: (M, m) where the slope before would lead in the time of the chord.
        arriving: (M, m) the same of the slope after.
    """
    return np.asarray(share * (1 - share) * ((1 - share) * (leaving - chord) - share * (arriving - chord)))
