"""Which multipliers and which plans are as good as those of an optimum, to first order.

Optimal multipliers are ``z = W t``: along the one ray that a slack on the boundary of its cone leaves, free where the
slack is 0. Optimal plans change no slack but along itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.linalg import Array, frozen
from synergrip.margin.sensitivity.optimum import ACTIVE, Optimum
from synergrip.values import Value

RANK = 1e-8
"""Singular value, of the largest, below which directions count as dependent."""
FAR = 1e12


@dataclass(frozen=True, eq=False, repr=False)
class Faces(Value):
    """Multipliers ``W t`` with ``A' W t = -q``, t in a product of cones, and the plans that go with them."""

    W: sparse.csc_matrix  # (m, k) columns scaled so that those of `pulls` are near 1
    blocks: tuple[Block, ...]
    """The cones of t."""
    t: Array  # (k,)
    pulls: Array  # (n, k) A' W
    rank: int
    ranges: Array
    """(n, rank) orthonormal: what the pulls span."""
    open_: Array
    """(k, j) orthonormal: changes of t that leave the multipliers optimal, to first order."""
    seen: Array
    """(n, r) orthonormal: changes of the unknowns that some optimal plans do not share."""

    @property
    def z(self) -> Array:
        """(m,) multipliers."""
        return np.asarray(self.W @ self.t)


def faces(of: Optimum) -> Faces:
    """Return what else is optimal beside an optimum."""
    generators, tangents, blocks = _active(of.program, of.program.b - of.program.A @ of.x)
    W = sparse.csc_matrix(sparse.hstack([sparse.csc_matrix((len(of.program.b), 0)), *generators]))
    pulls = np.asarray((of.program.A.T @ W).todense())
    scale = _scale(pulls, blocks)
    W, pulls = sparse.csc_matrix(W @ sparse.diags_array(1 / scale)), pulls / scale
    weight = np.asarray(W.multiply(W).sum(axis=0)).ravel()
    t = np.asarray(W.T @ of.z) / weight
    left, values, right = np.linalg.svd(pulls, full_matrices=True)
    rank = int(np.sum(values > RANK * values.max(initial=1e-300)))
    missing = left[:, :rank].T @ (pulls @ t + of.program.q)
    t = t - right[:rank].T @ (missing / values[:rank])
    seen = np.concatenate([np.zeros((0, len(of.x))), *tangents])
    return Faces(W, blocks, t, pulls, rank, left[:, :rank], right[rank:].T, _row_space(seen))


def _row_space(rows: Array) -> Array:
    if not rows.size:
        return np.zeros((rows.shape[1], 0))
    _, values, right = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(right[: int(np.sum(values > RANK * values.max(initial=1e-300)))].T)


def _scale(pulls: Array, blocks: tuple[Block, ...]) -> Array:
    """Return (k,) the size of each pull, one for all of a cone; 1 where there is none."""
    size, scale, start = np.linalg.norm(pulls, axis=0), np.ones(pulls.shape[1]), 0
    for block in blocks:
        own = size[start : start + block.rows].reshape(-1, block.dim).max(axis=1, initial=0.0)
        scale[start : start + block.rows] = np.repeat(np.where(own > 0, own, 1.0), block.dim)
        start += block.rows
    return scale


def _active(
    program: Program, slack: Array
) -> tuple[list[sparse.csc_matrix], list[Array], tuple[Block, ...]]:  # fmt: skip
    """Return generators of multipliers, rows that optimal plans do not change, and the cones of the generators."""
    m, A = len(slack), sparse.csr_matrix(program.A)
    found: dict[tuple[Kind, int], list[sparse.csc_matrix]] = {}
    tangents: list[Array] = []
    for block, rows in program.slices():
        for start in range(rows.start, rows.stop, block.dim):
            own = slice(start, start + block.dim)
            kind, columns = _generators(block.kind, slack[own])
            if columns is None:
                continue
            cone, whole = (kind, columns.shape[1]), np.zeros((m, columns.shape[1]))
            whole[own] = columns
            found.setdefault(cone, []).append(sparse.csc_matrix(whole))
            tangents.append(_across(slack[own], kind) @ A[own].toarray())
    order = sorted(found, key=lambda cone: (list(Kind).index(cone[0]), cone[1]))
    blocks = tuple(
        Block("optimum", kind, size, tuple(Item("cone", str(i)) for i in range(len(found[kind, size]))), 0, 1)
        for kind, size in order
    )
    return [part for cone in order for part in found[cone]], tangents, blocks


def _generators(kind: Kind, slack: Array) -> tuple[Kind, Array | None]:
    """Return the cone of what multiplies generators (dim, k) of a cone's multipliers; None where these are 0."""
    if kind is Kind.ZERO:
        return Kind.ZERO, np.eye(len(slack))
    if kind is Kind.NONNEGATIVE:
        return kind, np.eye(1) if slack[0] <= ACTIVE else None
    if slack[0] <= ACTIVE:
        return kind, np.eye(len(slack))
    tail = float(np.linalg.norm(slack[1:]))
    if slack[0] - tail > ACTIVE:
        return kind, None
    return Kind.NONNEGATIVE, np.concatenate([[1.0], -slack[1:] / tail])[:, None]


def _across(slack: Array, kind: Kind) -> Array:
    """Return what a slack on the boundary of its cone may not change: all but itself; all where it is 0."""
    if len(slack) == 1 or kind is not Kind.NONNEGATIVE:
        return np.eye(len(slack))
    own = slack / np.linalg.norm(slack)
    return np.asarray(np.eye(len(slack)) - np.outer(own, own))


def steepest(of: Optimum, found: Faces, change: Array) -> Program:
    """Return the program of how the optimum answers to changes (m,) of its rows, at first; its value is that.

    ``min q'd`` with ``W'(change - A d)`` in the cone: limits that are reached stay kept, to first order.
    """
    q = found.ranges.T @ of.program.q
    count = len(q)
    return Program(
        sparse.csc_matrix((count, count)), frozen(q), sparse.csc_matrix(found.pulls.T @ found.ranges),
        frozen(found.W.T @ change), found.blocks, 1, count, frozen(np.full(count, FAR)),
    )  # fmt: skip
