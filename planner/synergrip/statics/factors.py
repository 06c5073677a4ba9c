"""The inverse of many saddle matrices at once: Cholesky factors of the stack, whose inverses are made in blocks.

NumPy inverts small matrices of a stack one by one and slowly. It factorises and multiplies them quickly, and what is
left, the inverses of small triangles, is done entry by entry for all matrices of the stack.
"""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array, gram

SMALL = 16
"""Triangles up to this size are inverted entry by entry, larger ones in halves."""


def inverse_by_factors(C: Array, G: Array) -> Array:
    """Return the inverse (N, n + m, n + m) of ``[[C, G'], [G, 0]]`` for each of a stack.

    As ``C = L L'`` with ``L^-1 = T``, and ``(T G')' (T G') = R R'`` with ``R^-1 = W``, it is
    ``[[T' T - V' V, V' W], [W' V, -W' W]]``, ``V = W G T' T``. Units of rows and columns
    do not matter: factors take them with them.

    Args:
        C: (N, n, n) symmetric.
        G: (N, m, n).

    Raises:
        numpy.linalg.LinAlgError: of some C, or ``G C^-1 G'``, rounding leaves no sign.
    """
    n = C.shape[-1]
    T = _inverse_root(C)
    yields = T @ G.mT
    W = _inverse_root(gram(yields))
    of_wrench = np.concatenate([W @ (yields.mT @ T), -W], axis=-1)  # (V, -W)
    inverse = of_wrench.mT @ -of_wrench
    inverse[..., :n, :n] += gram(T)
    return np.asarray(inverse)


def _inverse_root(C: Array) -> Array:
    """Return the lower triangles T of ``C^-1 = T' T``."""
    return inverses_of_lower(np.asarray(np.linalg.cholesky(C), dtype=np.float64))


def inverses_of_lower(L: Array) -> Array:
    """Return the inverses of lower triangles (N, n, n)."""
    size = L.shape[-1]
    if size <= SMALL:
        return _entry_by_entry(L)
    half, inverse = size // 2, np.zeros_like(L)
    inverse[..., :half, :half] = upper = inverses_of_lower(L[..., :half, :half])
    inverse[..., half:, half:] = lower = inverses_of_lower(L[..., half:, half:])
    inverse[..., half:, :half] = -(lower @ (L[..., half:, :half] @ upper))
    return inverse


def _entry_by_entry(L: Array) -> Array:
    lanes = np.ascontiguousarray(np.moveaxis(L, 0, -1))  # the stack last: long rows, which NumPy is quick with
    inverse, diagonal = np.zeros_like(lanes), 1 / np.einsum("iiN->iN", lanes)
    np.einsum("iiN->iN", inverse)[...] = diagonal
    for k in range(1, len(lanes)):
        inverse[k, :k] = -diagonal[k] * np.einsum("jN,jiN->iN", lanes[k, :k], inverse[:k, :k])
    return np.ascontiguousarray(np.moveaxis(inverse, -1, 0))
