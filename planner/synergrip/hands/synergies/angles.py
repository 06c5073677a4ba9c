"""Two synergy sets against each other: principal angles between their ranges, and what each reproduces of the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.hands.synergies.span import Span, span
from synergrip.linalg import RANK_TOLERANCE, Array, frozen


@dataclass(frozen=True, eq=False)
class Side:
    """One of the two sets."""

    span: Span
    shares: Array
    """(n_z,) Share of the squared length of each column that lies in the range of the other set; NaN where it is 0."""
    share: float
    """The same of its range: the mean over all directions in it; NaN when no joint moves."""
    inside: bool
    """Whether its range lies in that of the other set."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """How the ranges of A and B lie to each other. The offsets of the sets have no part in it."""

    angles: Array
    """(min of the ranks,) principal angles [rad], ascending; 0 for each direction that they have in common."""
    first: Side
    second: Side


def compare(A: Array, B: Array) -> Comparison:
    """Compare the ranges of A (n_q, n_a) and B (n_q, n_b), whose rows are the same joints."""
    a, b = span(A), span(B)
    return Comparison(principal_angles(a.basis, b.basis), _side(A, a, b), _side(B, b, a))


def principal_angles(P: Array, Q: Array) -> Array:
    """Return the principal angles [rad], ascending, between the ranges of orthonormal P (n, p) and Q (n, q).

    Their cosines are the singular values of P' Q, their sines those of the smaller basis outside the other range
    (Bjoerck and Golub, 1973); from both together small and right angles come out to the last digits.
    """
    small, large = (P, Q) if P.shape[1] <= Q.shape[1] else (Q, P)
    if small.shape[1] == 0:
        return frozen(np.zeros(0))
    within = large.T @ small
    cosines = np.linalg.svd(within, compute_uv=False)
    sines = np.linalg.svd(small - large @ within, compute_uv=False)[::-1]
    return frozen(np.arctan2(sines, cosines))


def _side(S: Array, own: Span, other: Span) -> Side:
    held = np.linalg.norm(other.basis.T @ S, axis=0)
    shares = np.divide(held, own.norms, out=np.full(len(held), np.nan), where=own.norms > 0) ** 2
    within = other.basis.T @ own.basis
    share = float(np.sum(within**2) / own.rank) if own.rank else float("nan")
    outside = np.linalg.norm(own.basis - other.basis @ within, 2) if own.rank else 0.0
    return Side(own, frozen(shares), share, bool(outside <= RANK_TOLERANCE))
