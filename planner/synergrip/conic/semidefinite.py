"""Programs with semidefinite matrices, by Clarabel: what comes of them is a proposal that its user judges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from synergrip.conic.solvers.interrupts import interruptible
from synergrip.linalg import Array, frozen
from synergrip.values import Value

TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False, repr=False)
class Semidefinite(Value):
    """``minimise q'y`` with nonnegative rows, second-order cones and semidefinite matrices, each affine in y (n,)."""

    q: Array  # (n,)
    nonnegative: tuple[Array, Array]
    """(m, n) and (m,): matrix and constant."""
    second_order: tuple[tuple[Array, Array], ...]
    """(d, n) and (d,) of each cone."""
    matrices: tuple[tuple[Array, Array], ...]
    """(k, k, n) and (k, k) symmetric, of each matrix."""


def solve_semidefinite(program: Semidefinite) -> Array | None:
    """Return y (n,) near an optimum; None where the solver has none.

    Raises:
        KeyboardInterrupt: somebody interrupted it.
    """
    with interruptible():
        import clarabel

    parts, cones = [program.nonnegative], [clarabel.NonnegativeConeT(len(program.nonnegative[1]))]
    for cone in program.second_order:
        parts.append(cone)
        cones.append(clarabel.SecondOrderConeT(len(cone[1])))
    for matrix, constant in program.matrices:
        parts.append((_triangle(matrix), _triangle(constant)))
        cones.append(clarabel.PSDTriangleConeT(len(constant)))
    options = clarabel.DefaultSettings()
    options.verbose = False
    options.tol_gap_abs = options.tol_gap_rel = options.tol_feas = TOLERANCE
    A = sparse.csc_matrix(-np.vstack([matrix for matrix, _ in parts]))
    b, n = np.concatenate([constant for _, constant in parts]), len(program.q)
    with interruptible() as stop:
        solver = clarabel.DefaultSolver(sparse.csc_matrix((n, n)), program.q, A, b, cones, options)
        solver.set_termination_callback(stop)
        found = solver.solve()
        del solver
    y = frozen(found.x)
    return y if str(found.status) in ("Solved", "AlmostSolved") and np.all(np.isfinite(y)) else None


def _triangle(matrix: Array) -> Array:
    """Return the upper triangle (k (k + 1) / 2, ...) of (k, k, ...) by columns, off the diagonal times root 2."""
    columns, rows = np.tril_indices(len(matrix))
    entries = matrix[rows, columns]
    weights = np.where(rows == columns, 1.0, np.sqrt(2.0))
    return np.asarray(entries * weights.reshape(-1, *[1] * (entries.ndim - 1)))
