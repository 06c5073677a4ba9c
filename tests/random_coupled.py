"""Random programs of coupled knots for tests: maps alike or each knot's own, cones, bounds, rates, a scalar."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.linalg import Array, frozen


def random_coupled(
    seed: int, knots: int, n_v: int = 3, *, own: bool = False, scalar: bool = False, around: float = 1.0
) -> Program:
    """A feasible, bounded program: two cones, bounds, rates and accelerations, and squares of values and of rates.

    Args:
        seed: of the random numbers.
        knots: T.
        n_v: unknowns of a knot.
        own: whether each knot has maps of its own.
        around: size of what keeps all of it; 0 for unknowns that are all 0.
        scalar: whether the last unknown is one that the heads of all cones share, and is to be large.
    """
    rng = np.random.default_rng(seed)
    copies = knots if own else 1
    cones = np.broadcast_to(rng.normal(size=(copies, 2, 4, n_v)), (knots, 2, 4, n_v))
    bounds = np.broadcast_to(rng.normal(size=(copies, 5, n_v)), (knots, 5, n_v))
    inside = around * np.cumsum(rng.normal(size=(knots, n_v)), axis=0) / np.sqrt(knots)  # keeps all of them
    steps = rng.uniform(0.5, 1.5, knots - 1)
    rate, bend = _differences(steps)
    parts = [
        _rows(cones.reshape(knots, 8, n_v)), _rows(bounds), _rows(-bounds),
        *(sparse.kron(sign * each, sparse.eye_array(n_v)) for each in (rate, bend) for sign in (1, -1)),
    ]  # fmt: skip
    A = sparse.csc_matrix(sparse.vstack(parts))
    values = A @ inside.ravel()
    slack = rng.uniform(0.05, 0.5, A.shape[0])
    heads = np.arange(8 * knots) % 4 == 0
    slack[: 8 * knots] = np.where(heads, rng.uniform(0.5, 2, 8 * knots), 0.1 * slack[: 8 * knots])
    blocks = (
        Block("cones", Kind.SECOND_ORDER, 4, _items(2), 0, knots),
        *(Block(name, Kind.NONNEGATIVE, 1, _items(5), 0, knots) for name in ("lowest", "highest")),
        *(Block("rate", Kind.NONNEGATIVE, 1, _items(n_v), 1, knots - 1) for _ in range(2)),
        *(Block("bend", Kind.NONNEGATIVE, 1, _items(n_v), 2, knots - 2) for _ in range(2)),
    )
    travel = sparse.kron(rate.T @ rate, sparse.eye_array(n_v))
    P = sparse.csc_matrix(0.1 * sparse.eye_array(knots * n_v) + travel)
    q = rng.normal(size=knots * n_v)
    if scalar:
        column = sparse.csc_matrix(np.r_[heads, np.zeros(A.shape[0] - 8 * knots)][:, None].astype(float))
        A = sparse.csc_matrix(sparse.hstack([A, column]))
        P, q = sparse.csc_matrix((knots * n_v + 1, knots * n_v + 1)), np.r_[0.0 * q, -1.0]
    far = frozen(np.full(len(q), 1e3))
    return Program(P, frozen(q), A, frozen(values + slack), blocks, knots, n_v, far)


def _differences(steps: Array) -> tuple[sparse.csr_matrix, sparse.csr_matrix]:
    """First and second differences over uneven steps."""
    knots = len(steps) + 1
    first = sparse.diags_array([-1 / steps, 1 / steps], offsets=[0, 1], shape=(knots - 1, knots))
    second = sparse.diags_array([-np.ones(knots - 2), np.ones(knots - 2)], offsets=[0, 1], shape=(knots - 2, knots - 1))
    return sparse.csr_matrix(first), sparse.csr_matrix(second @ first)


def _rows(matrices: Array) -> sparse.coo_matrix:
    return sparse.block_diag([sparse.csr_matrix(each) for each in matrices])


def _items(count: int) -> tuple[Item, ...]:
    return tuple(Item(f"item {i}") for i in range(count))
