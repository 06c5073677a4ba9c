"""Distances to cones, and projections on their duals, for all cones of a program at once. NumPy only."""

from __future__ import annotations

import numpy as np

from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Kind
from synergrip.linalg import Array


def outside(block: Block, values: Array) -> Array:
    """Return how far values (rows,) of a block are outside each of its cones (cones,); below 0 inside."""
    return _beyond(block.kind, block.dim, values)


def _beyond(kind: Kind, dim: int, values: Array) -> Array:
    if kind is Kind.NONNEGATIVE and dim == 1:
        return -values.ravel()
    parts = values.reshape(-1, dim)
    if kind is Kind.ZERO:
        return np.asarray(np.abs(parts).max(axis=1, initial=0.0))
    if kind is Kind.NONNEGATIVE:
        return np.asarray(-parts.min(axis=1, initial=np.inf))
    return np.asarray(np.sqrt((parts[:, 1:] ** 2).sum(axis=1)) - parts[:, 0])


def distance_to_cones(program: Program, s: Array) -> float:
    """Return how far s (m,) is outside the program's cones: the largest over the cones, 0 inside."""
    parts = (_beyond(kind, dim, s[rows]) for kind, dim, rows in program.stretches)
    return max((float(part.max(initial=0.0)) for part in parts), default=0.0)


def row_sizes(program: Program) -> Array:
    """Return (m,) the largest entry of A in each row's cone; 1 where there is none."""
    entries = np.asarray(abs(program.A).max(axis=1).todense()).ravel()
    result = np.ones(len(entries))
    for block, rows in program.slices():
        if block.rows:
            largest = entries[rows].reshape(-1, block.dim).max(axis=1)
            result[rows] = np.repeat(np.where(largest > 0, largest, 1.0), block.dim)
    return result


def project_on_dual(program: Program, y: Array) -> Array:
    """Return the point of the dual cone nearest to y (m,): free, nonnegative and second-order parts."""
    result = np.array(y, dtype=float)
    for kind, dim, rows in program.stretches:
        if kind is Kind.NONNEGATIVE:
            np.maximum(result[rows], 0.0, out=result[rows])
        elif kind is Kind.SECOND_ORDER:
            result[rows] = project_second_order(result[rows].reshape(-1, dim)).ravel()
    return result


def project_second_order(points: Array) -> Array:
    """Project points (..., d) on the cone ``||x_1..|| <= x_0``, which is its own dual."""
    heads, tails = points[..., 0], points[..., 1:]
    lengths = np.sqrt((tails**2).sum(axis=-1))
    inside = lengths <= heads
    if inside.all():
        return points
    onto = np.where(inside, heads, np.where(lengths <= -heads, 0.0, (heads + lengths) / 2))
    with np.errstate(invalid="ignore"):
        factor = np.where(inside, 1.0, onto / np.where(lengths > 0, lengths, 1.0))
    # the head is taken from the tail it belongs to, so that rounding cannot leave the point outside
    shrunk = tails * factor[..., None]
    return np.concatenate([np.maximum(onto, np.sqrt((shrunk**2).sum(axis=-1)))[..., None], shrunk], axis=-1)
