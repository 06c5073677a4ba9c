"""How far an extra wrench may go before a cone is left: along rays, and in every direction at once.

The value of a cone is ``s(w) = a + B w`` with s(0) in the cone: ``s_0 >= ||s_1..||``, or ``s_0 >= 0`` where there is
one row. Along a ray the end is a root of a quadratic. For the ball ``||w|| <= r`` let ``q(w) = s_0^2 - ||s_1..||^2 =
w'M w + 2 m'w + c``. The ball is inside exactly when q is nowhere negative in it, and by the S-lemma (Yakubovich) that
is so exactly when for some tau >= 0

    q(w) >= tau (r^2 - ||w||^2) for all w,   that is   [[M + tau I, m], [m', c - tau r^2]] >= 0.

With sigma = 1 / tau the largest such r^2 is that of the concave ``sigma c - sigma^2 m' (I + sigma M)^-1 m``, in the
eigenvectors of M a sum over six terms. Every sigma proves its r; a wrench at which q is 0 bounds r from above.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array, frozen
from synergrip.values import Value

STEPS = 60
"""Halvings of the interval of sigma."""
WIDEST = 60.0
"""Where the logarithm of sigma / (its end - sigma) is looked for: from less this to this."""
ALMOST = 1e-12
"""Share of the largest eigenvalue of M below which it has no negative one: sigma has no end then."""
SHORT = 1e-9
"""Share by which a proven end stays short of where rounding would have it."""
SAME = 1e-11
"""Share of its largest entry down to which the smallest eigenvalue of a proof may be rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class Balls(Value):
    """The largest ball in each of N cones."""

    lower: Array
    """(N,) radius that is proven."""
    upper: Array
    """(N,) radius at which a wrench leaves the cone; infinite where none does."""
    towards: Array
    """(N, n) unit vectors along which that is."""
    sigma: Array
    """(N,) 1 / tau of the proof."""


def along(start: Array, change: Array) -> Array:
    """Return the largest f (...) with ``start + f change`` in the cone; infinite where the ray stays in it.

    Args:
        start: (..., d) in the cone, or at its edge but for rounding.
        change: (..., d).
    """
    head, by = start[..., 0], change[..., 0]
    if start.shape[-1] == 1:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.where(by < 0, np.maximum(head, 0.0) / -by, np.inf))
    tail = np.linalg.norm(start[..., 1:], axis=-1)
    c = np.maximum(head - tail, 0.0) * (head + tail)
    b = head * by - np.sum(start[..., 1:] * change[..., 1:], axis=-1)
    a = by**2 - np.sum(change[..., 1:] ** 2, axis=-1)
    square = b**2 - a * c
    root = np.sqrt(np.maximum(square, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        falling = np.where(square >= 0, c / (root - b), np.inf)
        rising = np.where(a < 0, (b + root) / -a, np.inf)
    moves = np.any(change != 0, axis=-1)
    return np.asarray(np.where(moves, np.where(b < 0, falling, rising), np.inf))


def balls(start: Array, change: Array) -> Balls:
    """Return the largest ball of w with ``start + change w`` in the cone, of each of N cones.

    Args:
        start: (N, d) in its cone.
        change: (N, d, n).
    """
    if start.shape[-1] == 1:
        size = np.linalg.norm(change[:, 0], axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = np.where(size > 0, np.maximum(start[:, 0], 0.0) / size, np.inf)
            towards = np.where(size[:, None] > 0, -change[:, 0] / size[:, None], 0.0)
        return Balls(radius * (1 - SHORT), radius, towards, np.full(len(start), np.nan))
    M, m, c = quadratic(start, change)
    mu, V = np.linalg.eigh(M)
    inner = (V.mT @ m[..., None])[..., 0]
    end, has_end = _end_of_sigma(mu)
    sigma, last = _best_sigma(mu, inner, c, end, has_end)
    divisor = _divisors(mu, sigma, last, has_end)
    square = sigma * c - sigma**2 * np.sum(inner**2 / divisor, axis=-1)
    lower = np.sqrt(np.maximum(square, 0.0)) * (1 - SHORT)
    upper, towards = _attained(start, change, -(sigma[:, None] * inner / divisor), V)
    moves = np.any(change != 0, axis=(-2, -1))
    lower, upper = np.where(moves, np.minimum(lower, upper), np.inf), np.where(moves, upper, np.inf)
    return Balls(frozen(lower), frozen(upper), frozen(towards), frozen(sigma))


def quadratic(start: Array, change: Array) -> tuple[Array, Array, Array]:
    """Return M (N, n, n), m (N, n) and c (N,) of ``q(w) = s_0^2 - ||s_1..||^2``."""
    head, tail, b, T = start[:, 0], start[:, 1:], change[:, 0], change[:, 1:]
    size = np.linalg.norm(tail, axis=-1)
    M = b[:, :, None] * b[:, None, :] - T.mT @ T
    return M, head[:, None] * b - (T.mT @ tail[..., None])[..., 0], np.maximum(head - size, 0.0) * (head + size)


def proven(start: Array, change: Array, sigma: Array, radius: Array) -> NDArray[np.bool_]:
    """Return of which (N,) cones multipliers 1 / sigma prove that a ball is inside: a matrix is semidefinite.

    It is scaled such that the ball has radius 1, so that all entries are comparable. A ball of radius 0, or of any
    radius in a cone that nothing touches, is not asked about.

    Args:
        start: (N, d).
        change: (N, d, n).
        sigma: (N,), of `balls`.
        radius: (N,).
    """
    asked = (radius > 0) & np.any(change != 0, axis=(-2, -1)) & np.isfinite(radius)
    radius = np.where(asked, radius, 1.0)
    if start.shape[-1] == 1:
        return np.asarray(~asked | (start[:, 0] >= radius * np.linalg.norm(change[:, 0], axis=-1)))
    M, m, c = quadratic(start, change * radius[:, None, None])
    tau, n = radius**2 / sigma, m.shape[1]
    whole = np.zeros((len(c), n + 1, n + 1))
    whole[:, :n, :n] = M + tau[:, None, None] * np.eye(n)
    whole[:, :n, n] = whole[:, n, :n] = m
    whole[:, n, n] = c - tau
    least = np.linalg.eigvalsh(whole)[:, 0]
    return np.asarray(~asked | (least >= -SAME * np.abs(whole).max(axis=(1, 2))))


def _end_of_sigma(mu: Array) -> tuple[Array, Array]:
    """Return up to where sigma may go, and whether that is a pole; else it is a size to measure it by."""
    largest = np.abs(mu).max(axis=-1)
    has_end = mu[:, 0] < -ALMOST * largest
    size = np.where(largest > 0, largest, 1.0)
    return np.where(has_end, -1.0 / np.where(has_end, mu[:, 0], -1.0), 1.0 / size), has_end


def _best_sigma(mu: Array, inner: Array, c: Array, end: Array, has_end: Array) -> tuple[Array, Array]:
    """Return the best sigma (N,) of the concave r^2, by halving, and the share of its interval that is left beyond."""
    low, high = np.full(len(c), -WIDEST), np.full(len(c), WIDEST)
    for _ in range(STEPS):
        middle = (low + high) / 2
        sigma, last = _at(middle, end, has_end)
        divisor = _divisors(mu, sigma, last, has_end)
        slope = c - np.sum(inner**2 * sigma[:, None] * (1 + divisor) / divisor**2, axis=-1)
        low, high = np.where(slope > 0, middle, low), np.where(slope > 0, high, middle)
    return _at(low, end, has_end)


def _at(place: Array, end: Array, has_end: Array) -> tuple[Array, Array]:
    """Return sigma at ``log(sigma / (end - sigma))``, or at ``log(sigma / end)``; and ``1 - sigma / end``."""
    last = 1 / (1 + np.exp(place))
    return end * np.exp(place) * np.where(has_end, last, 1.0), last


def _divisors(mu: Array, sigma: Array, last: Array, has_end: Array) -> Array:
    """Return ``1 + sigma mu`` (N, n), to all digits at the pole."""
    of_pole = last[:, None] + sigma[:, None] * (mu - mu[:, :1])
    return np.where(has_end[:, None], of_pole, 1 + sigma[:, None] * mu)


def _attained(start: Array, change: Array, inner: Array, V: Array) -> tuple[Array, Array]:
    """Return how near (N,) a wrench leaves each cone, and along which unit vector (N, n).

    Tried are the stationary point of the Lagrangian, the directions of the eigenvector of the pole, and what of that
    eigenvector brings the stationary point to the edge of the cone: one of them is the nearest.

    Args:
        start: (N, d).
        change: (N, d, n).
        inner: (N, n) the stationary point, in the eigenvectors.
        V: (N, n, n) the eigenvectors of M, that of the pole first.
    """
    point, pole = (V @ inner[..., None])[..., 0], V[..., 0]
    there = start + (change @ point[..., None])[..., 0]
    sideways = (change @ pole[..., None])[..., 0]
    a, b, c = (
        x[:, 0] * y[:, 0] - np.sum(x[:, 1:] * y[:, 1:], axis=-1)
        for x, y in ((sideways, sideways), (there, sideways), (there, there))
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(np.maximum(b**2 - a * c, 0.0))
        steps = [np.nan_to_num((-b + sign * root) / a, nan=0.0, posinf=0.0, neginf=0.0) for sign in (1.0, -1.0)]
    candidates = [point, pole, -pole, *(point + step[:, None] * pole for step in steps)]
    best, towards = np.full(len(start), np.inf), np.zeros_like(point)
    for candidate in candidates:
        size = np.linalg.norm(candidate, axis=-1)
        unit = candidate / np.where(size > 0, size, 1.0)[:, None]
        reach = along(start, (change @ unit[..., None])[..., 0])
        towards = np.where((reach < best)[:, None], unit, towards)
        best = np.minimum(best, reach)
    return best, towards
