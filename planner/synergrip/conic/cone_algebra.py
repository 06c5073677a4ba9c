"""The algebra of second-order cones that an interior-point method needs, for many cones at once.

Arrays are (N, cones, size): the first entry of a cone is its head. With J = diag(1, -1, ..., -1), the Nesterov-Todd
scaling of a pair (s, z) inside the cone is ``W = beta (2 v v' - J)`` with ``v'J v = 1`` and ``W z = W^-1 s = lambda``.
It is carried on from iteration to iteration in scaled coordinates, where s and z are equal and nothing cancels
(L. Vandenberghe, The CVXOPT linear and quadratic cone program solvers, 2010, sections 4 and 5).
"""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array


def dot(a: Array, b: Array) -> Array:
    """Return a'b of every cone."""
    return np.asarray((a * b).sum(axis=-1))


def flipped(a: Array) -> Array:
    """Return J a."""
    result = -a
    result[..., 0] = a[..., 0]
    return np.asarray(result)


def determinant(a: Array) -> Array:
    """Return ``a'J a``, without cancelling where a is near the boundary of its cone."""
    length = np.sqrt(dot(a[..., 1:], a[..., 1:]))
    return np.asarray((a[..., 0] - length) * (a[..., 0] + length))


def product(a: Array, b: Array) -> Array:
    """Return the Jordan product ``(a'b, a_0 b_1 + b_0 a_1)``."""
    result = a[..., :1] * b + b[..., :1] * a
    result[..., 0] = dot(a, b)
    return np.asarray(result)


def divided(b: Array, a: Array) -> Array:
    """Return c with ``product(a, c) = b``."""
    head = (a[..., 0] * b[..., 0] - dot(a[..., 1:], b[..., 1:])) / determinant(a)
    result = (b - head[..., None] * a) / a[..., :1]
    result[..., 0] = head
    return np.asarray(result)


def scaled(v: Array, beta: Array, x: Array) -> Array:
    """Return ``W x``."""
    return np.asarray(beta[..., None] * (2 * dot(v, x)[..., None] * v - flipped(x)))


def unscaled(v: Array, beta: Array, x: Array) -> Array:
    """Return ``W^-1 x``."""
    return flipped(2 * dot(v, flipped(x))[..., None] * v - x) / beta[..., None]


def unscaled_rows(v: Array, beta: Array, rows: Array) -> Array:
    """Return ``W^-1 A`` for rows (N, cones, size, n)."""
    turned = -rows
    turned[..., 0, :] = rows[..., 0, :]
    heads = (v[..., None, :] @ turned)[..., 0, :]
    opposite = flipped(v)
    return np.asarray((2 * opposite[..., :, None] * heads[..., None, :] - turned) / beta[..., None, None])


def longest_step(at: Array, step: Array) -> Array:
    """Return the inverse of how far a step may go before it leaves the cone (N, cones); 0 or less where it never does.

    The step is brought to the coordinates in which `at` is (1, 0, ..., 0): there it is ``|tail| - head``.
    """
    root = np.sqrt(determinant(at))
    unit = at / root[..., None]
    head = dot(unit, flipped(step)) / root
    factor = (head + step[..., 0] / root) / (unit[..., 0] + 1)
    tail = step[..., 1:] / root[..., None] - factor[..., None] * unit[..., 1:]
    return np.asarray(np.sqrt(dot(tail, tail)) - head)


def carried_on(v: Array, beta: Array, s: Array, z: Array) -> tuple[Array, Array, Array]:
    """Return v, beta and lambda of a pair that is s and z in the coordinates of the old scaling."""
    of_s, of_z = np.sqrt(determinant(s)), np.sqrt(determinant(z))
    s, z = s / of_s[..., None], z / of_z[..., None]
    half = np.sqrt((1 + dot(s, z)) / 2)
    with_s, with_z = dot(v, s), dot(v, flipped(z))
    middle, apart = (with_s + with_z) / (2 * half), with_s - with_z
    head = 2 * v[..., 0] * middle - (s[..., 0] + z[..., 0]) / (2 * half)
    turn = (v[..., 0] * apart - s[..., 0] / 2 + z[..., 0] / 2) / (head + 1)
    point = (
        (2 * (apart / 2 - turn * middle))[..., None] * v
        + (0.5 * (1 - turn / half))[..., None] * s
        + (0.5 * (1 + turn / half))[..., None] * z
    )
    point[..., 0] = half
    point *= np.sqrt(of_s * of_z)[..., None]
    middle_point = (s + flipped(z)) / (2 * half)[..., None]
    turned = 2 * dot(v, middle_point)[..., None] * v - flipped(middle_point)
    turned[..., 0] += 1
    return turned / np.sqrt(2 * turned[..., :1]), beta * np.sqrt(of_s / of_z), point


def squared_inverse(v: Array, beta: Array) -> Array:
    """Return the entries of ``W^-2`` (pairs, N, cones): the lower half, row after row."""
    size = v.shape[-1]
    opposite = [part if i == 0 else -part for i, part in enumerate(np.moveaxis(v, -1, 0))]
    inverse: dict[tuple[int, int], Array] = {}
    pairs = [(i, j) for i in range(size) for j in range(i + 1)]
    for i, j in pairs:
        entry = 2 * opposite[i] * opposite[j]
        if i == j:
            entry = entry - 1.0 if i == 0 else entry + 1.0
        inverse[i, j] = inverse[j, i] = entry / beta
    result = np.zeros((len(pairs), *beta.shape))
    for row, (i, j) in zip(result, pairs, strict=True):
        for k in range(size):
            row += inverse[i, k] * inverse[k, j]
    return result
