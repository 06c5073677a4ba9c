"""Limits and a goal, stacked into one sparse program."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import sparse

from synergrip.conic.box import LARGEST, box
from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Rows
from synergrip.conic.situation import Situation
from synergrip.linalg import frozen


def build(situation: Situation, limits: Sequence[Limit], goal: Goal) -> Program:
    """Return the program that looks for the best plan by `goal` among those that keep all `limits`."""
    rows = [part for limit in limits for part in limit.rows(situation)] + list(goal.rows(situation))
    cost = goal.objective(situation)
    extra = 0 if cost.epigraph is None else 1
    T = situation.knots
    n = T * situation.n_v + extra
    P = sparse.block_diag([sparse.kron(sparse.eye(T), cost.quadratic), sparse.csc_matrix((extra, extra))], format="csc")
    q = np.concatenate([np.asarray(cost.linear).ravel(), [cost.epigraph] if cost.epigraph is not None else []])
    A = sparse.vstack([_coefficients(part, T, extra) for part in rows], format="csc") if rows else _nothing(n)
    b = np.concatenate([part.constant.ravel() for part in rows]) if rows else np.zeros(0)
    blocks = tuple(_block(part, T) for part in rows)
    bounds = frozen(np.concatenate([np.tile(box(situation, limits), T), np.full(extra, LARGEST)]))
    return Program(sparse.csc_matrix(P), frozen(q), sparse.csc_matrix(A), frozen(b), blocks, T, situation.n_v, bounds)


def _coefficients(rows: Rows, knots: int, extra: int) -> sparse.csc_matrix:
    """Return A for one contribution: ``value = b - A x``, hence the signs."""
    here = sparse.csr_matrix(sparse.kron(sparse.eye(knots), sparse.csr_matrix(rows.matrix)))
    if rows.previous is not None:
        here = here + sparse.csr_matrix(sparse.kron(sparse.eye(knots, k=-1), sparse.csr_matrix(rows.previous)))
        here = here[len(rows.matrix) :]
    if not extra:
        return sparse.csc_matrix(-here)
    column = sparse.csc_matrix(np.tile(rows.epigraph, len(rows.constant))[:, None])
    return sparse.csc_matrix(sparse.hstack([-here, -column]))


def _block(rows: Rows, knots: int) -> Block:
    return Block(rows.limit, rows.kind, rows.dim, rows.items, knots - len(rows.constant), len(rows.constant))


def _nothing(n: int) -> sparse.csc_matrix:
    return sparse.csc_matrix((0, n))
